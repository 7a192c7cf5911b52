//! Row above the stroke pad: the automatic stroke, its settings, and recording.

use std::ops::RangeInclusive;

use egui::{Button, ComboBox, DragValue, Label, PointerButton, Response, RichText, Slider, Ui, vec2};
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
const PERCENTS: RangeInclusive<f32> = 25.0..=400.0;
/// Width of each of the two buttons, in points.
const BUTTON_WIDTH: f32 = 60.0;
/// Width of the path choice, in points.
const PATH_WIDTH: f32 = 86.0;
/// Width that both sliders need in addition to their rails, in points.
const VALUES_WIDTH: f32 = 158.0;
/// Range of widths of a rail, in points. Where there is less room, the row has numbers with names instead.
const RAIL_WIDTHS: RangeInclusive<f32> = 60.0..=90.0;
/// Change of a number per dragged point, as a share of its range.
const DRAG_SHARE: f32 = 0.004;

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
        let room = (ui.available_width() - VALUES_WIDTH) / 2.0;
        let rail = (room >= *RAIL_WIDTHS.start()).then(|| room.min(*RAIL_WIDTHS.end()));
        if state.repeats {
            let tempo = (stroke::SPEED, stroke::TEMPO, stroke::TEMPO_HELP);
            factor_ui(ui, rail, &mut state.repeat.tempo, tempo);
            let force = (stroke::NORMAL_FORCE, stroke::FORCE, stroke::FORCE_HELP);
            factor_ui(ui, rail, &mut state.repeat.force, force);
        } else {
            hand_ui(ui, rail, state);
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

/// Quantity of the automatic stroke.
struct Quantity {
    /// Name beside its number.
    word: &'static str,
    /// Accessible name.
    name: &'static str,
    help: &'static str,
    range: RangeInclusive<f32>,
    n_decimals: usize,
    /// Unit, with the space before it.
    suffix: &'static str,
    is_logarithmic: bool,
}

/// Draws a slider with a rail of this width, in points; without a rail, a number after its name.
fn quantity_ui(ui: &mut Ui, rail: Option<f32>, value: &mut f32, quantity: Quantity) -> Response {
    let Quantity { word, name, help, range, n_decimals, suffix, is_logarithmic } = quantity;
    let written = move |value: f64, _| format!("{value:.n_decimals$}");
    let response = if let Some(rail) = rail {
        ui.spacing_mut().slider_width = rail;
        let slider = Slider::new(value, range).logarithmic(is_logarithmic).custom_formatter(written);
        ui.add(slider.suffix(suffix).smart_aim(false))
    } else {
        let speed = DRAG_SHARE * (range.end() - range.start());
        let number = DragValue::new(value).range(range).speed(speed).custom_formatter(written).suffix(suffix);
        let word = RichText::new(word).small().color(tokens(ui.ctx()).text_weak);
        let both = ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            ui.add(Label::new(word).selectable(false)).on_hover_text(help);
            ui.add(number)
        });
        both.inner
    };
    response.accessible_name(name).on_hover_text(help)
}

/// Draws speed and normal force of the automatic stroke.
fn hand_ui(ui: &mut Ui, rail: Option<f32>, state: &mut PadState) {
    let speed = Quantity {
        word: stroke::SPEED,
        name: strings::HAND_SPEED,
        help: strings::HAND_SPEED,
        range: SPEEDS_MM_PER_S,
        n_decimals: 0,
        suffix: " mm/s",
        is_logarithmic: false,
    };
    let mut mm_per_s = state.hand.speed_mps * 1e3;
    quantity_ui(ui, rail, &mut mm_per_s, speed);
    state.hand.speed_mps = mm_per_s * 1e-3;
    let force = Quantity {
        word: stroke::NORMAL_FORCE,
        name: strings::HAND_FORCE,
        help: strings::HAND_FORCE,
        range: FORCES_N,
        n_decimals: 2,
        suffix: " N",
        is_logarithmic: false,
    };
    quantity_ui(ui, rail, &mut state.hand.force_n, force);
}

/// Draws a factor of the repeated stroke, in percent, with its short name, its accessible name and its tooltip.
fn factor_ui(
    ui: &mut Ui,
    rail: Option<f32>,
    factor: &mut f32,
    (word, name, help): (&'static str, &'static str, &'static str),
) {
    let mut percent = *factor * 1e2;
    let (range, n_decimals, suffix, is_logarithmic) = (PERCENTS, 0, " %", true);
    let quantity = Quantity { word, name, help, range, n_decimals, suffix, is_logarithmic };
    // Only the user changes the factor: rounding would make it drift, and every change causes a fade.
    if quantity_ui(ui, rail, &mut percent, quantity).changed() {
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
