//! Before work would be lost, a question.

use egui::{Button, Context, Label, RichText};
use shagreen_formats::gallery::GalleryProject;

use crate::command::{Command, FileCommand};
use crate::sheet_frame::{is_left, sheet};
use crate::strings::document as strings;
use crate::theme::{GAP, tokens};

/// What leaves the project that is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leave {
    /// A new project begins.
    New,
    /// A project that was read takes its place.
    Open,
    /// One of the gallery does.
    Gallery(GalleryProject),
    /// The program ends.
    Quit,
}

/// Draws the question over the window and returns what the user wants.
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
