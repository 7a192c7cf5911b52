//! Stroke pad: the texture is stroked with mouse or pen, by the automatic stroke, or by a recorded stroke.

mod controls_ui;
mod pad_menu;
mod picture;
pub(crate) mod surface;
mod trail_ui;

use egui::{FontId, Rect, Role, Sense, Stroke, Ui, WidgetInfo, vec2};
use shagreen_core::units::{Contact, MetersPerSecond, Newtons, Radians};
use shagreen_device::controls::Input;
use shagreen_device::hand::{Hand, Path};
use shagreen_device::repeat::Repeat;
use shagreen_device::touch::Touch;

use crate::author::pad::controls_ui::controls_ui;
use crate::author::pad::pad_menu::pad_menu;
pub use crate::author::pad::picture::PadPicture;
use crate::author::pad::surface::{CURSOR, ReportedPressure, scale_bar, stroke_report, tip_ui};
use crate::author::pad::trail_ui::{LiveTrail, trail_ui};
use crate::command::Command;
use crate::look::theme::{RADIUS, tokens};
use crate::look::tooltips::{Hint, is_learned, learn};
use crate::panel::Panel;
use crate::session::Session;
use crate::state::mouse_report::MouseReport;
use crate::strings;

/// Range of the speed of the automatic stroke, in mm/s.
const SPEEDS_MM_PER_S: std::ops::RangeInclusive<f32> = 5.0..=300.0;
/// Range of the normal force, in N.
const FORCES_N: std::ops::RangeInclusive<f32> = 0.05..=4.0;
/// Length of the automatic stroke, in m.
const EXTENT_M: f32 = 0.08;

/// State of the pad: the automatic stroke, the repeated stroke, and the pressure of a pen or finger.
#[derive(Clone, Copy, Debug)]
pub struct PadState {
    /// Path, speed and force of the automatic stroke.
    pub hand: Hand,
    /// Whether the recorded stroke is repeated instead of the automatic stroke.
    pub repeats: bool,
    /// Tempo and force of the repeated stroke, relative to the recording.
    pub repeat: Repeat,
    /// Whether the running stroke is a preview, which ends by itself.
    pub(crate) is_preview: bool,
    /// Number of stroke recordings when last checked, to detect a new one.
    n_strokes: u64,
    /// Pressure of a pen or finger on the pad.
    pressure: ReportedPressure,
    trail: LiveTrail,
}

impl Default for PadState {
    fn default() -> Self {
        Self {
            hand: Hand { path: Path::Line, speed_mps: 0.1, force_n: 0.8, extent_m: EXTENT_M },
            repeats: false,
            repeat: Repeat::AS_RECORDED,
            is_preview: false,
            n_strokes: 0,
            pressure: ReportedPressure::default(),
            trail: LiveTrail::default(),
        }
    }
}

impl PadState {
    /// Input of the automatic stroke: its path, or the recorded stroke.
    pub fn input(&self) -> Input {
        if self.repeats { Input::Repeat(self.repeat) } else { Input::Hand(self.hand) }
    }

    /// Typical tip speed and normal force of that input.
    pub fn contact(&self, session: &Session) -> Contact {
        let Hand { speed_mps, force_n, .. } = self.hand;
        let of_hand = || Contact::from_mm_per_s_and_n(1e3 * f64::from(speed_mps), f64::from(force_n));
        let Some(stroke) = session.stroke().filter(|_| self.repeats) else { return of_hand() };
        // Limited to the lowest speed and force of the sliders: a recording of taps only then shows a slow, light
        // stroke.
        let Contact { speed, force } = stroke.usual_contact(self.repeat);
        let least = (1e-3 * f64::from(*SPEEDS_MM_PER_S.start()), f64::from(*FORCES_N.start()));
        Contact { speed: MetersPerSecond(speed.0.max(least.0)), force: Newtons(force.0.max(least.1)) }
    }

    /// Selects a stroke that was just recorded or read, with its original tempo and force.
    fn follow_strokes(&mut self, session: &Session) {
        if self.n_strokes != session.n_strokes() {
            self.n_strokes = session.n_strokes();
            (self.repeats, self.repeat) = (true, Repeat::AS_RECORDED);
        }
    }
}

/// Result of one frame of the pad.
#[derive(Debug, Default)]
pub struct PadOutcome {
    /// Requested commands.
    pub commands: Vec<Command>,
    /// Pointer position while it strokes, and once more on release.
    pub mouse: Option<MouseReport>,
}

/// Draws the controls and the pad, with the picture of the audible texture.
pub fn pad_ui(
    ui: &mut Ui,
    panel: &Panel<'_>,
    state: &mut PadState,
    picture: Option<PadPicture>,
) -> PadOutcome {
    let mut outcome = PadOutcome::default();
    state.follow_strokes(panel.session);
    outcome.commands.extend(controls_ui(ui, panel, state));
    let t = tokens(ui.ctx());
    let (area, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, strings::PAD));
    match picture {
        Some(picture) => picture.show(ui.painter(), area),
        None => {
            ui.painter().rect_filled(area, f32::from(RADIUS), t.background);
        }
    }
    ui.painter().rect_stroke(area, f32::from(RADIUS), Stroke::new(1.0, t.line), egui::StrokeKind::Inside);
    trail_ui(ui, area, panel.session, state);
    let now_secs = ui.input(|i| i.time);
    state.trail.follow(now_secs, panel.session.touch());
    state.trail.show(ui, area, now_secs);
    if let Some(lay) = panel.session.lay() {
        lay_mark(ui, area, lay);
    }
    scale_bar(ui, area);
    tip_ui(ui, area, panel.session.touch());
    touch_label(ui, area, panel.session.touch());
    ui.input(|i| state.pressure.follow(&i.events));
    if response.hovered() {
        let scrolled = ui.input(|i| i.smooth_scroll_delta.y);
        let force_n = state.hand.force_n * (scrolled * 0.0015).exp();
        state.hand.force_n = force_n.clamp(*FORCES_N.start(), *FORCES_N.end());
    }
    outcome.mouse = stroke_report(ui, area, &response, state.pressure);
    if outcome.mouse.is_some() {
        learn(ui.ctx(), Hint::StrokePad);
    }
    outcome.commands.extend(pad_menu(&response, panel));
    let response = response.on_hover_cursor(CURSOR);
    if panel.session.touch().contact.force_n <= 0.0 && !is_learned(ui.ctx(), Hint::StrokePad) {
        response.on_hover_text(strings::PAD_HELP);
    }
    outcome
}

/// Draws three lines along the lay in the lower left corner.
fn lay_mark(ui: &Ui, area: Rect, lay: Radians) {
    let t = tokens(ui.ctx());
    let size = vec2(26.0, 26.0);
    let back = Rect::from_min_size(area.left_bottom() + vec2(4.0, -4.0 - size.y), size);
    let response = ui.interact(back, ui.scope_id().with("lay"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, strings::LAY));
    response.on_hover_text(strings::LAY_HELP);
    ui.painter().rect_filled(back, 3.0, t.background.gamma_multiply(0.75));
    let along = vec2(lay.0.cos() as f32, -lay.0.sin() as f32);
    for line in [-1.0, 0.0, 1.0] {
        let middle = back.center() + 5.0 * line * along.rot90();
        ui.painter().line_segment([middle - 8.0 * along, middle + 8.0 * along], Stroke::new(1.5, t.text));
    }
}

/// Writes the speed and force of the tip as reported by the audio callback.
fn touch_label(ui: &Ui, area: Rect, touch: Touch) {
    if touch.contact.force_n <= 0.0 {
        return;
    }
    let t = tokens(ui.ctx());
    let painter = ui.painter().with_clip_rect(area);
    let text = format!("{:.0} mm/s  {:.2} N", touch.contact.speed_mps * 1e3, touch.contact.force_n);
    let galley = painter.layout_no_wrap(text, FontId::proportional(11.5), t.text);
    let at = Rect::from_min_size(area.left_top() + vec2(6.0, 6.0), galley.size() + vec2(10.0, 4.0));
    painter.rect_filled(at, 3.0, t.background.gamma_multiply(0.75));
    painter.galley(at.min + vec2(5.0, 2.0), galley, t.text);
}
