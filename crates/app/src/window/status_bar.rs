//! Status bar: output, latency and messages.

use egui::text::LayoutJob;
use egui::{Align, Color32, Label, Layout, Response, RichText, Sense, TextStyle, Ui, vec2};
use shagreen_device::status::{LinkState, Status};

use crate::command::Command;
use crate::look::notice::notice;
use crate::look::primary::primary_ui;
use crate::look::theme::tokens;
use crate::panel::Panel;
use crate::session::Session;
use crate::sheets::devices::output_choice_ui::output_choice_ui;
use crate::strings;

/// Greatest width of a message, in points. Its tooltip has the whole text.
const MESSAGE_WIDTH: f32 = 600.0;
/// Greatest number of lines of a message.
const MESSAGE_LINES: usize = 2;
/// Width of the status bar below which the figures of the output leave their place to a message, in points.
const FIGURES_WIDTH: f32 = 1100.0;
/// Time for which an output must have stalled before the status bar says so, in seconds: opening it again takes less.
const STALLED_SECS: f64 = 2.0;

/// Whether the output has stalled for [`STALLED_SECS`].
fn has_stalled_for_long(ui: &Ui, is_stalled: bool) -> bool {
    let id = egui::Id::unique("stalled since");
    let now = ui.input(|i| i.time);
    ui.data_mut(|data| {
        if !is_stalled {
            data.remove::<f64>(id);
            return false;
        }
        now - *data.get_temp_mut_or(id, now) >= STALLED_SECS
    })
}

/// Draws that the output with this id is lost, and the button that opens it again; returns the requested command.
fn lost_ui(ui: &mut Ui, id: &str) -> Option<Command> {
    let t = tokens(ui.ctx());
    ui.colored_label(t.error, strings::OUTPUT_LOST);
    let again = primary_ui(ui, strings::OPEN_AGAIN, true).on_hover_text(strings::OPEN_AGAIN_HELP);
    again.clicked().then(|| Command::OpenOutput(id.to_owned()))
}

/// Draws a message in at most [`MESSAGE_LINES`] lines of [`MESSAGE_WIDTH`]. A longer text is cut off; the caller's
/// tooltip has the whole.
fn message_ui(ui: &mut Ui, text: &str, color: Color32, sense: Sense) -> Response {
    let size = vec2(ui.available_width().min(MESSAGE_WIDTH), ui.available_height());
    let mut job = LayoutJob::simple(text.to_owned(), TextStyle::Small.resolve(ui.style()), color, size.x);
    job.wrap.max_rows = MESSAGE_LINES;
    let label = Label::new(job).wrap().halign(Align::LEFT).show_tooltip_when_elided(false);
    let label = label.selectable(sense != Sense::hover());
    let layout = Layout::right_to_left(Align::Center);
    ui.allocate_ui_with_layout(size, layout, |ui| ui.add(label.sense(sense))).inner
}

/// Draws latency, load, dropouts and level of the open output.
fn figures_ui(ui: &mut Ui, session: &Session, status: &Status) {
    let late = session.latency_ms().map_or(String::new(), |ms| format!("latency about {ms:.0} ms"));
    weak(ui, late, strings::LATENCY_HELP);
    ui.separator();
    weak(ui, format!("load {:.1} %", 100.0 * status.load), strings::LOAD_HELP);
    ui.separator();
    weak(ui, strings::dropouts(status.underruns), strings::DROPOUTS_HELP);
    // The level would reveal the texture in a blind comparison.
    if !session.is_hidden() {
        ui.separator();
        // Rounded first, to avoid "-0 dB".
        let level = (20.0 * f64::from(status.level_mps2.max(1e-4)).log10()).round() + 0.0;
        weak(ui, format!("{level:.0} dB re 1 m/s²"), strings::LEVEL_HELP);
    }
}

/// Draws secondary text with a tooltip.
fn weak(ui: &mut Ui, text: String, help: &str) {
    let text = RichText::new(text).small().color(tokens(ui.ctx()).text_weak);
    ui.add(Label::new(text).selectable(false)).on_hover_text(help);
}

/// Draws the status bar and returns the commands of the user. `says_source` tells that the canvas states the source of
/// the positions.
pub fn status_ui(ui: &mut Ui, panel: &Panel<'_>, says_source: bool) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    ui.horizontal_centered(|ui| {
        let session = panel.session;
        // In a narrow window, a message needs the place of the figures.
        let has_figures = ui.available_width() >= FIGURES_WIDTH || session.messages().next().is_none();
        commands.extend(output_choice_ui(ui, session));
        if let Some(status) = session.status() {
            // The most important status comes first.
            if status.tripped {
                ui.colored_label(t.error, strings::TRIPPED);
                if ui.button(strings::RESET_LIMITER).clicked() {
                    commands.push(Command::ResetLimiter);
                }
            } else if session.is_limiting() {
                ui.colored_label(t.warning, strings::LIMITING).on_hover_text(strings::LIMITING_HELP);
            }
            if has_stalled_for_long(ui, status.state == LinkState::Stalled) {
                ui.colored_label(t.warning, strings::STALLED);
            }
            if status.state == LinkState::Lost
                && let Some(id) = session.output_id()
            {
                commands.extend(lost_ui(ui, id));
            }
            if has_figures {
                figures_ui(ui, session, status);
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if let Some(text) = notice(ui.ctx()) {
                message_ui(ui, &text, t.accent, Sense::hover()).on_hover_text(&text);
            }
            // In a blind comparison, it would tell which texture was not played before.
            if session.is_long_preparing() && !session.is_hidden() {
                let label = Label::new(RichText::new(strings::PREPARING).color(t.accent)).selectable(false);
                ui.add(label).on_hover_text(strings::PREPARING_HELP);
            }
            if !says_source {
                weak(ui, format!("positions: {}", session.label_source()), strings::SOURCE_HELP);
            }
            if session.claimed_output().is_some() {
                let button = ui.button(strings::TAKE_OVER).on_hover_text(strings::TAKE_OVER_HELP);
                if button.clicked() {
                    commands.push(Command::TakeOverOutput);
                }
            }
            for message in session.messages() {
                let help = format!("{message}\n{}", strings::DISMISS);
                if message_ui(ui, message, t.error, Sense::click()).on_hover_text(help).clicked() {
                    commands.push(Command::DismissMessage);
                }
            }
        });
    });
    commands
}

#[cfg(test)]
mod tests {
    use super::{has_stalled_for_long, lost_ui};
    use crate::command::Command;
    use crate::strings;
    use egui::{Context, RawInput};
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    /// An output that is opened again stalls for a moment, which is not worth a message.
    #[test]
    fn a_stall_is_said_after_two_seconds() {
        let ctx = Context::default();
        let is_said_at = |time_secs: f64, is_stalled: bool| {
            let mut is_said = false;
            let input = RawInput { time: Some(time_secs), ..RawInput::default() };
            let mut output = ctx.run_ui(input, |ui| is_said = has_stalled_for_long(ui, is_stalled));
            output.textures_delta.clear();
            is_said
        };
        let stalls =
            [(0.0, true), (1.9, true), (2.1, true), (3.0, false), (4.0, true), (5.5, true), (6.5, true)];
        let said = stalls.map(|(time_secs, is_stalled)| is_said_at(time_secs, is_stalled));
        assert_eq!(said, [false, false, true, false, false, false, true]);
    }

    #[test]
    fn a_lost_output_is_named_so_and_opened_again_with_one_click() {
        let mut harness = Harness::builder().build_ui_state(
            |ui, asked: &mut Option<Command>| {
                if let Some(command) = lost_ui(ui, "pulse:ci") {
                    *asked = Some(command);
                }
            },
            None,
        );
        assert!(harness.query_by_label(strings::OUTPUT_LOST).is_some());
        harness.get_by_label(strings::OPEN_AGAIN).click();
        harness.run_steps(2);
        assert!(matches!(harness.state(), Some(Command::OpenOutput(id)) if id == "pulse:ci"));
    }
}
