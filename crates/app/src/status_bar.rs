//! The line at the foot of the window: what is driven, how late, and whether anything is wrong.

use egui::{ComboBox, Label, RichText, Sense, Ui};
use shagreen_device::status::LinkState;

use crate::command::Command;
use crate::panel::Panel;
use crate::session::Session;
use crate::strings;
use crate::theme::tokens;

/// Draws the line and returns what the user asked of it.
pub fn status_ui(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    ui.horizontal_centered(|ui| {
        let session = panel.session;
        commands.extend(output_ui(ui, session));
        let weak = |ui: &mut Ui, text: String, help: &str| {
            ui.add(Label::new(RichText::new(text).small().color(t.text_weak)).selectable(false))
                .on_hover_text(help);
        };
        if let Some(status) = session.status() {
            // What must not be missed comes first.
            if status.tripped {
                ui.colored_label(t.error, strings::TRIPPED);
                if ui.button(strings::RESET_LIMITER).clicked() {
                    commands.push(Command::ResetLimiter);
                }
            } else if session.is_limiting() {
                ui.colored_label(t.warning, strings::LIMITING).on_hover_text(strings::LIMITING_HELP);
            }
            if status.state == LinkState::Stalled {
                ui.colored_label(t.warning, strings::STALLED);
            }
            let late = session.latency_ms().map_or(String::new(), |ms| format!("about {ms:.0} ms late"));
            weak(ui, late, strings::LATENCY_HELP);
            ui.separator();
            weak(ui, format!("load {:.1} %", 100.0 * status.load), strings::LOAD_HELP);
            ui.separator();
            weak(ui, strings::dropouts(status.underruns), strings::DROPOUTS_HELP);
            // The level would tell what is heard blind.
            if !session.is_hidden() {
                ui.separator();
                // Rounded first, so that nothing reads "-0 dB".
                let level = (20.0 * f64::from(status.level_mps2.max(1e-4)).log10()).round() + 0.0;
                weak(ui, format!("{level:.0} dB re 1 m/s²"), strings::LEVEL_HELP);
            }
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if session.is_long_preparing() {
                let label = Label::new(RichText::new(strings::PREPARING).color(t.accent)).selectable(false);
                ui.add(label).on_hover_text(strings::PREPARING_HELP);
            }
            weak(ui, format!("positions: {}", session.label_source()), strings::SOURCE_HELP);
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

/// The choice of outputs.
pub(crate) fn output_ui(ui: &mut Ui, session: &Session) -> Option<Command> {
    let mut chosen = None;
    let current = session.output_name().unwrap_or(if session.is_opening() {
        strings::OPENING
    } else {
        strings::NO_OUTPUT
    });
    let combo = ComboBox::from_id_salt("output").width(210.0).truncate().selected_text(current);
    let shown = combo.show_ui(ui, |ui| {
        for output in session.outputs() {
            let selected = session.output_id() == Some(output.id.as_str());
            if ui.selectable_label(selected, &output.name).on_hover_text(&output.id).clicked() {
                chosen = Some(Command::OpenOutput(output.id.clone()));
            }
        }
    });
    if shown.response.clicked() {
        // Looked for again: something may have been plugged in since.
        chosen = Some(Command::ListOutputs);
    }
    shown.response.accessible_name(strings::OUTPUT).on_hover_text(strings::OUTPUT_HELP);
    chosen
}
