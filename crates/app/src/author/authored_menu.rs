//! Context menu of an authored texture, in the list and on the canvas.

use egui::{Key, Modifiers, Response, Ui};
use shagreen_formats::project::AuthoredTexture;

use crate::author::context_menu::{context_menu, menu_entry};
use crate::author::new_texture::copy_of;
use crate::author::whole_space::{own_textures, whole_space_switch};
use crate::command::Command;
use crate::command::clipboard::ClipboardCommand;
use crate::command::relief::{ReliefCommand, ReliefOf};
use crate::panel::Panel;
use crate::state::compare::Side;
use crate::state::edit::Edit;
use crate::strings::{authored as words, clipboard, compare, export, relief};

/// Command of the keys F2 and Delete on the row or the point of an authored texture with the keyboard focus.
pub(crate) fn authored_keys(
    response: &Response,
    panel: &Panel<'_>,
    texture: &AuthoredTexture,
) -> Option<Command> {
    if !response.has_focus() {
        return None;
    }
    let is_pressed = |key| response.ctx.input_mut(|i| i.consume_key(Modifiers::NONE, key));
    if is_pressed(Key::F2) {
        return Some(Command::RenameAuthored(texture.key));
    }
    let can_go = panel.project.authored.len() > 1;
    (can_go && is_pressed(Key::Delete)).then(|| Command::Edit(Edit::Remove(texture.key)))
}

/// Draws the menu while it is open; returns the requested command.
pub(crate) fn authored_menu(
    response: &Response,
    panel: &Panel<'_>,
    texture: &AuthoredTexture,
) -> Option<Command> {
    let mut asked = None;
    context_menu(response, |ui| asked = content_ui(ui, panel, texture));
    asked
}

fn content_ui(ui: &mut Ui, panel: &Panel<'_>, texture: &AuthoredTexture) -> Option<Command> {
    let key = texture.key;
    let is_selected = key == panel.project.texture().key;
    let mut asked = menu_entry(ui, words::RENAME, words::RENAME_HELP, Command::RenameAuthored(key));
    // The shortcut duplicates the selected texture.
    let duplicate = if is_selected {
        Command::DuplicateTexture
    } else {
        Command::Edit(Edit::Author(Box::new(copy_of(panel, texture))))
    };
    asked = menu_entry(ui, words::DUPLICATE, words::DUPLICATE_HELP, duplicate).or(asked);
    let begin = Command::Relief(ReliefCommand::Begin(Some(ReliefOf::Authored(key)), None));
    asked = menu_entry(ui, relief::MENU, relief::MENU_HELP, begin).or(asked);
    for own in own_textures(panel, texture) {
        if let Some(switch) = whole_space_switch(ui, panel, own) {
            asked = Some(switch);
            ui.close();
        }
    }
    ui.separator();
    let copy = Command::Clipboard(ClipboardCommand::Copy(Some(key)));
    asked = menu_entry(ui, clipboard::COPY, clipboard::COPY_HELP, copy).or(asked);
    let can_go = panel.project.authored.len() > 1;
    ui.add_enabled_ui(can_go, |ui| {
        let cut = Command::Clipboard(ClipboardCommand::Cut(Some(key)));
        asked = menu_entry(ui, clipboard::CUT, clipboard::CUT_HELP, cut).or(asked.take());
    });
    let paste = Command::Clipboard(ClipboardCommand::Paste);
    asked = menu_entry(ui, clipboard::PASTE, clipboard::PASTE_HELP, paste).or(asked);
    ui.separator();
    ui.add_enabled_ui(can_go, |ui| {
        let delete = Command::Edit(Edit::Remove(key));
        asked = menu_entry(ui, words::DELETE, "", delete).or(asked.take());
    });
    ui.separator();
    for side in [Side::A, Side::B] {
        let is_there = panel.compare.side_of(key) == Some(side);
        ui.add_enabled_ui(can_go && !is_there, |ui| {
            let assign = Command::Edit(Edit::SetCompared(panel.compare.assigned(side, key)));
            asked = menu_entry(ui, &compare::compare_as(side.letter()), "", assign).or(asked.take());
        });
    }
    ui.separator();
    menu_entry(ui, export::EXPORT, export::EXPORT_HELP, Command::ExportAuthored(key)).or(asked)
}
