//! Projects that a crashed program left behind, to be opened or discarded.

use std::time::SystemTime;

use egui::{Context, Label, RichText};

use crate::command::{Command, FileCommand};
use crate::look::sheet_frame::{foot_ui, sheet};
use crate::look::theme::{GAP, tokens};
use crate::state::recovery::Leftover;
use crate::strings::document as strings;

/// Draws the sheet; returns the requested commands.
pub(crate) fn recovered_ui(ctx: &Context, leftovers: &[Leftover]) -> Vec<Command> {
    let t = tokens(ctx);
    let mut commands = Vec::new();
    sheet(ctx, "recovered", |ui| {
        ui.set_width(520.0);
        ui.add(Label::new(RichText::new(strings::RECOVERED_TITLE).heading().strong()).selectable(false));
        ui.add_space(GAP);
        let help =
            if leftovers.len() > 1 { strings::RECOVERED_SEVERAL_HELP } else { strings::RECOVERED_HELP };
        ui.add(Label::new(help).wrap());
        ui.add_space(GAP);
        for (index, leftover) in leftovers.iter().enumerate() {
            let stem = leftover.origin.as_ref().and_then(|file| file.path.file_stem());
            let name = stem.map_or(strings::UNTITLED.to_owned(), |stem| stem.to_string_lossy().into_owned());
            // If the system clock was set back, the age is zero.
            let age = SystemTime::now().duration_since(leftover.written).unwrap_or_default();
            ui.horizontal(|ui| {
                ui.add(Label::new(RichText::new(&name).strong()).selectable(false));
                ui.add(
                    Label::new(RichText::new(strings::ago(age.as_secs())).color(t.text_weak))
                        .selectable(false),
                );
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    let about = |verb: &str| strings::about(verb, &name);
                    let discard = ui.button(strings::DISCARD).accessible_name(about(strings::DISCARD));
                    if discard.clicked() {
                        commands.push(Command::File(FileCommand::Discard(index)));
                    }
                    let recover = ui.button(strings::RECOVER).accessible_name(about(strings::RECOVER));
                    if index == 0 && ui.memory(|memory| memory.focused().is_none()) {
                        recover.request_focus();
                    }
                    if recover.clicked() {
                        commands.push(Command::File(FileCommand::Recover(index)));
                    }
                });
            });
        }
        ui.add_space(GAP);
        if foot_ui(ui, |ui| ui.button(strings::LATER).clicked()) {
            commands.push(Command::CloseSheet);
        }
    });
    commands
}
