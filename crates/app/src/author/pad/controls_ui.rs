//! Row above the stroke pad: the automatic stroke, its settings, and recording.

use egui::{Button, ComboBox, PointerButton, RichText, Slider, Ui, vec2};
use shagreen_device::hand::Path;

use super::{FORCES_N, PadState, SPEEDS_MM_PER_S};
use crate::command::Command;
use crate::command::stroke::StrokeCommand;
use crate::look::list::ShowList as _;
use crate::look::theme::{GAP, tokens};
use crate::panel::Panel;
use crate::session::Session;
use crate::strings::{self, stroke};

/// Range of tempo and force of a repeated stroke, in percent of the recording.
const PERCENTS: std::ops::RangeInclusive<f32> = 25.0..=400.0;
/// Width of each of the two buttons, in points.
const BUTTON_WIDTH: f32 = 60.0;
/// Width of the path choice, in points.
const PATH_WIDTH: f32 = 86.0;
/// Width that both sliders need in addition to their rails, in points.
const VALUES_WIDTH: f32 = 158.0;

/// Draws the row; returns the requested commands.
pub(super) fn controls_ui(ui: &mut Ui, panel: &Panel<'_>, state: &mut PadState) -> Vec<Command> {
    let mut commands = Vec::new();
    let session = panel.session;
    ui.horizontal(|ui| {
        // The stroke of a preview ends by itself; the button starts one that does not.
        let running = session.hand_is_running() && !state.is_preview;
        let text = if running { strings::HAND_STOP } else { strings::HAND_START };
        // The one primary action of the page.
        let t = tokens(ui.ctx());
        let button = if running {
            Button::new(text).selected(true)
        } else {
            Button::new(RichText::new(text).strong().color(t.on_accent)).fill(t.accent)
        };
        let button = button.min_size(vec2(BUTTON_WIDTH, 0.0));
        if ui.add(button).on_hover_text(strings::HAND_HELP).clicked() {
            commands.push(Command::ToggleHand);
        }
        commands.extend(path_ui(ui, session, state));
        let is_recording = session.recording().is_some();
        let (text, help) = if is_recording {
            (stroke::FINISH, stroke::FINISH_HELP)
        } else {
            (stroke::RECORD, stroke::RECORD_HELP)
        };
        let button = Button::new(text).selected(is_recording).min_size(vec2(BUTTON_WIDTH, 0.0));
        let button = ui.add(button).on_hover_text(help);
        if is_recording && button.clicked_by(PointerButton::Primary) {
            commands.push(Command::Stroke(StrokeCommand::FinishByPointer));
        } else if button.clicked() {
            commands.push(Command::Stroke(StrokeCommand::Record));
        }
        ui.spacing_mut().slider_width = ((ui.available_width() - VALUES_WIDTH) / 2.0).clamp(24.0, 90.0);
        if state.repeats {
            factor_ui(ui, &mut state.repeat.tempo, stroke::TEMPO, stroke::TEMPO_HELP);
            factor_ui(ui, &mut state.repeat.force, stroke::FORCE, stroke::FORCE_HELP);
        } else {
            hand_ui(ui, state);
        }
    });
    ui.add_space(GAP / 2.0);
    commands
}

/// Draws the choice of the path, including the recorded stroke and its file commands.
fn path_ui(ui: &mut Ui, session: &Session, state: &mut PadState) -> Option<Command> {
    let mut command = None;
    let chosen = if state.repeats { stroke::RECORDED } else { path_name(state.hand.path) };
    let combo = ComboBox::from_id_salt("path of the hand").width(PATH_WIDTH).truncate();
    let shown = combo.selected_text(chosen).show_list(ui, |ui| {
        for path in [Path::Line, Path::Circle, Path::Scribble] {
            let is_chosen = !state.repeats && state.hand.path == path;
            if ui.selectable_label(is_chosen, path_name(path)).clicked() {
                (state.hand.path, state.repeats) = (path, false);
            }
        }
        let has_stroke = session.stroke().is_some();
        if has_stroke {
            ui.selectable_value(&mut state.repeats, true, stroke::RECORDED);
        }
        ui.separator();
        if ui.button(stroke::OPEN).on_hover_text(stroke::OPEN_HELP).clicked() {
            command = Some(Command::Stroke(StrokeCommand::AskWhatToOpen));
        }
        let save = ui.add_enabled(has_stroke, Button::new(stroke::SAVE));
        if save.on_hover_text(stroke::SAVE_HELP).clicked() {
            command = Some(Command::Stroke(StrokeCommand::Save));
        }
    });
    shown.response.accessible_name(strings::HAND_PATH).on_hover_text(stroke::PATH_HELP);
    command
}

/// Draws the sliders for speed and normal force of the automatic stroke.
fn hand_ui(ui: &mut Ui, state: &mut PadState) {
    let mut mm_per_s = state.hand.speed_mps * 1e3;
    let whole = |value: f64, _| format!("{value:.0}");
    let speed =
        Slider::new(&mut mm_per_s, SPEEDS_MM_PER_S).custom_formatter(whole).suffix(" mm/s").smart_aim(false);
    ui.add(speed).accessible_name(strings::HAND_SPEED).on_hover_text(strings::HAND_SPEED);
    state.hand.speed_mps = mm_per_s * 1e-3;
    let hundredths = |value: f64, _| format!("{value:.2}");
    let force = Slider::new(&mut state.hand.force_n, FORCES_N)
        .custom_formatter(hundredths)
        .suffix(" N")
        .smart_aim(false);
    ui.add(force).accessible_name(strings::HAND_FORCE).on_hover_text(strings::HAND_FORCE);
}

/// Draws the slider of a factor of the repeated stroke, in percent.
fn factor_ui(ui: &mut Ui, factor: &mut f32, name: &str, help: &str) {
    let mut percent = *factor * 1e2;
    let whole = |value: f64, _| format!("{value:.0}");
    let slider = Slider::new(&mut percent, PERCENTS).logarithmic(true).custom_formatter(whole).suffix(" %");
    let slider = ui.add(slider.smart_aim(false)).accessible_name(name).on_hover_text(help);
    // Only a moved slider changes the factor: rounding would make it drift, and every change causes a fade.
    if slider.changed() {
        *factor = percent * 1e-2;
    }
}

fn path_name(path: Path) -> &'static str {
    match path {
        Path::Line => strings::LINE,
        Path::Circle => strings::CIRCLE,
        Path::Scribble => strings::SCRIBBLE,
    }
}
