//! Question before unsaved work would be lost.

use egui::{Context, Label, RichText};

use crate::command::{Command, FileCommand};
use crate::look::primary::primary_ui;
use crate::look::sheet_frame::{foot_ui, sheet};
use crate::look::theme::GAP;
use crate::state::leave::Leave;
use crate::strings::document as strings;

/// Draws the question over the window; returns the requested commands. `is_changed` states whether the project has
/// unsaved changes; otherwise only painted signals would be lost, which are not part of a project.
pub(crate) fn leaving_ui(ctx: &Context, leave: Leave, project: &str, is_changed: bool) -> Vec<Command> {
    let mut commands = Vec::new();
    sheet(ctx, "leaving", |ui| {
        ui.set_width(420.0);
        let title = if is_changed { strings::LEAVE_TITLE } else { strings::LEAVE_PAINTING };
        ui.add(Label::new(RichText::new(title).heading().strong()).selectable(false));
        ui.add_space(GAP);
        let lost =
            if is_changed { strings::would_be_lost(project) } else { strings::PAINTING_LOST.to_owned() };
        ui.add(Label::new(lost).wrap());
        ui.add_space(GAP);
        foot_ui(ui, |ui| {
            if !is_changed {
                if ui.button(strings::LEAVE_IT).clicked() {
                    commands.push(Command::File(FileCommand::LeaveUnsaved(leave)));
                }
                if ui.button(strings::CANCEL).clicked() {
                    commands.push(Command::CloseSheet);
                }
                return;
            }
            let save = primary_ui(ui, strings::SAVE_FIRST, true);
            if ui.memory(|memory| memory.focused().is_none()) {
                save.request_focus();
            }
            if save.clicked() {
                commands.push(Command::File(FileCommand::SaveAndLeave(leave)));
            }
            if ui.button(strings::DO_NOT_SAVE).clicked() {
                commands.push(Command::File(FileCommand::LeaveUnsaved(leave)));
            }
            if ui.button(strings::CANCEL).clicked() {
                commands.push(Command::CloseSheet);
            }
        });
    });
    commands
}
