//! Before work would be lost, a question.

use egui::{Button, Context, Key, Label, Modal, Modifiers, RichText};

use crate::command::{Command, FileCommand};
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
    Gallery(usize),
    /// The program ends.
    Quit,
}

/// Draws the question over the window and returns what the user wants.
pub(crate) fn leaving_ui(ctx: &Context, leave: Leave, project: &str) -> Vec<Command> {
    let t = tokens(ctx);
    let frame = egui::Frame::popup(&ctx.global_style()).fill(t.panel).inner_margin(14.0);
    let mut commands = Vec::new();
    Modal::new(egui::Id::unique("leaving")).frame(frame).show(ctx, |ui| {
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
    if ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape)) {
        commands.push(Command::CloseSheet);
    }
    commands
}
