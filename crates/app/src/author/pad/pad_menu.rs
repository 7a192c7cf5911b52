//! Context menu of the stroke pad.

use egui::Response;
use shagreen_studio::export::WAV;

use crate::author::context_menu::{context_menu, listed_entry, menu_entry};
use crate::command::stroke::StrokeCommand;
use crate::command::{Command, FileCommand};
use crate::panel::Panel;
use crate::strings::stroke;

/// Draws the menu while it is open; returns the requested commands.
pub(super) fn pad_menu(pad: &Response, panel: &Panel<'_>) -> Vec<Command> {
    let mut commands = Vec::new();
    context_menu(pad, |ui| {
        commands.extend(listed_entry(ui, Command::ToggleHand));
        let (name, help, record) = if panel.session.recording().is_some() {
            (stroke::FINISH, stroke::FINISH_HELP, StrokeCommand::FinishByPointer)
        } else {
            (stroke::RECORD, stroke::RECORD_HELP, StrokeCommand::Record)
        };
        commands.extend(menu_entry(ui, name, help, Command::Stroke(record)));
        let open = Command::Stroke(StrokeCommand::AskWhatToOpen);
        commands.extend(menu_entry(ui, stroke::OPEN, stroke::OPEN_HELP, open));
        ui.add_enabled_ui(panel.session.stroke().is_some(), |ui| {
            let save = Command::Stroke(StrokeCommand::Save);
            commands.extend(menu_entry(ui, stroke::SAVE, stroke::SAVE_HELP, save));
        });
        ui.separator();
        commands.extend(listed_entry(ui, Command::ToggleMute));
        commands.extend(listed_entry(ui, Command::File(FileCommand::Export(WAV.id))));
    });
    commands
}
