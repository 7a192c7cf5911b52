//! Status bar: output, latency and messages.

use egui::{Button, Label, RichText, Sense, Ui};
use shagreen_device::status::LinkState;

use crate::command::Command;
use crate::look::theme::tokens;
use crate::panel::Panel;
use crate::sheets::devices::output_choice_ui::output_choice_ui;
use crate::strings;

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

/// Draws the status bar and returns the commands of the user. `has_canvas` tells that the canvas is visible, which states
/// the source of the positions itself.
pub fn status_ui(ui: &mut Ui, panel: &Panel<'_>, has_canvas: bool) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    ui.horizontal_centered(|ui| {
        let session = panel.session;
        commands.extend(output_choice_ui(ui, session));
        let weak = |ui: &mut Ui, text: String, help: &str| {
            ui.add(Label::new(RichText::new(text).small().color(t.text_weak)).selectable(false))
                .on_hover_text(help);
        };
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
                let again = Button::new(RichText::new(strings::OPEN_AGAIN).color(t.on_accent)).fill(t.accent);
                if ui.add(again).on_hover_text(strings::OPEN_AGAIN_HELP).clicked() {
                    commands.push(Command::OpenOutput(id.to_owned()));
                }
            }
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
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if session.is_long_preparing() {
                let label = Label::new(RichText::new(strings::PREPARING).color(t.accent)).selectable(false);
                ui.add(label).on_hover_text(strings::PREPARING_HELP);
            }
            if !has_canvas {
                weak(ui, format!("positions: {}", session.label_source()), strings::SOURCE_HELP);
            }
            if session.claimed_output().is_some() {
                let button = ui.button(strings::TAKE_OVER).on_hover_text(strings::TAKE_OVER_HELP);
                if button.clicked() {
                    commands.push(Command::TakeOverOutput);
                }
            }
            for message in [session.output_message(), session.pen_message()].into_iter().flatten() {
                let label = Label::new(RichText::new(message).color(t.error))
                    .truncate()
                    .show_tooltip_when_elided(false)
                    .sense(Sense::click());
                let help = format!("{message}\n{}", strings::DISMISS);
                if ui.add(label).on_hover_text(help).clicked() {
                    commands.push(Command::DismissMessage);
                }
            }
        });
    });
    commands
}
