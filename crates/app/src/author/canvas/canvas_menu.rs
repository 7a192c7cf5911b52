//! Context menu of the canvas.

use egui::{Button, Popup, Response};
use shagreen_core::space::heat_map::Quantity;

use super::{ShownMap, move_to};
use crate::author::context_menu::{context_menu, listed_entry, menu_entry};
use crate::author::new_texture::fresh;
use crate::command::Command;
use crate::command::axes::AxesCommand;
use crate::command::clipboard::ClipboardCommand;
use crate::look::axes::Axes;
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::{authored, clipboard, map as map_words};

/// Draws the menu while it is open; returns the requested commands. They apply where the pointer opened the menu, or at the
/// center of the view if the keyboard opened it.
pub(super) fn canvas_menu(
    background: &Response,
    axes: Axes,
    panel: &Panel<'_>,
    map: Option<&ShownMap>,
) -> Vec<Command> {
    let mut commands = Vec::new();
    let opened_at = Popup::position_of_id(&background.ctx, Popup::default_response_id(background));
    let at = axes.space_from_ui(opened_at.unwrap_or(axes.rect.center()));
    context_menu(background, |ui| {
        let added = Command::Edit(Edit::Author(Box::new(fresh(panel, at))));
        commands.extend(menu_entry(ui, authored::ADD_HERE, authored::ADD_HERE_HELP, added));
        let moved = move_to(panel.on_slice(at));
        commands.extend(menu_entry(ui, authored::MOVE_HERE, authored::MOVE_HERE_HELP, moved));
        let paste = Command::Clipboard(ClipboardCommand::Paste);
        commands.extend(menu_entry(ui, clipboard::PASTE, clipboard::PASTE_HELP, paste));
        ui.separator();
        commands.extend(listed_entry(ui, Command::TogglePathTool));
        commands.extend(listed_entry(ui, Command::Axes(AxesCommand::Open)));
        let shown = map.map(|map| map.quantity);
        ui.menu_button(map_words::MAP, |ui| {
            for each in std::iter::once(None).chain(Quantity::ALL.map(Some)) {
                let entry = ui.add(Button::selectable(shown == each, map_words::name(each)));
                if entry.on_hover_text(map_words::help(each)).clicked() {
                    commands.push(Command::ShowMap(each));
                }
            }
        });
    });
    commands
}
