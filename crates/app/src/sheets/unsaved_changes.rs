//! Question before unsaved work would be lost.

use egui::{Button, Context, Label, RichText};

use crate::command::{Command, FileCommand};
use crate::look::sheet_frame::{is_left, sheet};
use crate::look::theme::{GAP, tokens};
use crate::state::leave::Leave;
use crate::strings::document as strings;

/// Draws the question over the window; returns the requested commands.
pub(crate) fn leaving_ui(ctx: &Context, leave: Leave, project: &str) -> Vec<Command> {
    let t = tokens(ctx);
    let mut commands = Vec::new();
    sheet(ctx, "leaving", |ui| {
        ui.set_width(420.0);
        ui.add(Label::new(RichText::new(strings::LEAVE_TITLE).heading().strong()).selectable(false));
        ui.add_space(GAP);
        ui.add(Label::new(strings::would_be_lost(project)).wrap());
        ui.add_space(GAP);
        ui.horizontal(|ui| {
            let save = Button::new(RichText::new(strings::SAVE_FIRST).color(t.on_accent)).fill(t.accent);
            let save = ui.add(save);
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
    if is_left(ctx) {
        commands.push(Command::CloseSheet);
    }
    commands
}
