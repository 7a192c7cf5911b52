//! Context menus: opened by a right click or, on the focused widget, by the menu key or Shift+F10.

use egui::{Button, Context, Id, Key, Modifiers, Popup, Rect, Response, SetOpenCommand, Ui, vec2};

use crate::command::Command;

/// Largest part of a widget, around its center, beside which the menu opens by the keyboard, in points.
const BESIDE: egui::Vec2 = vec2(240.0, 36.0);
/// Width of a menu, in points.
const WIDTH: f32 = 150.0;

/// Shows the context menu of a widget while it is open.
pub(crate) fn context_menu(response: &Response, content: impl FnOnce(&mut Ui)) {
    let menu = Popup::context_menu(response);
    let is_asked = response.has_focus()
        && response.ctx.input_mut(|i| {
            i.consume_key(Modifiers::NONE, Key::Menu) || i.consume_key(Modifiers::SHIFT, Key::F10)
        });
    // A menu that was opened by the keyboard has no position of the pointer.
    let is_open_by_key = menu.is_open()
        && !response.secondary_clicked()
        && Popup::position_of_id(&response.ctx, menu.get_id()).is_none();
    let menu = if is_asked || is_open_by_key {
        let area = response.interact_rect;
        menu.anchor(Rect::from_center_size(area.center(), area.size().min(BESIDE)))
    } else {
        menu
    };
    let menu = if is_asked { menu.open_memory(SetOpenCommand::Bool(true)) } else { menu };
    menu.show(|ui| {
        ui.set_min_width(WIDTH);
        content(ui);
    });
}

/// Menu entry with the shortcut of its command.
pub(crate) fn menu_entry(ui: &mut Ui, name: &str, help: &str, command: Command) -> Option<Command> {
    let keys = command.shortcut_text(ui.ctx());
    let response = ui.add(Button::new(name).shortcut_text(keys)).accessible_name(name);
    let is_clicked = response.clicked();
    if is_clicked {
        // By the keyboard too.
        ui.close();
    }
    if !help.is_empty() {
        response.on_hover_text(help);
    }
    is_clicked.then_some(command)
}

/// Menu entry of a command with its own label and shortcut; none if it is not listed.
pub(crate) fn listed_entry(ui: &mut Ui, command: Command) -> Option<Command> {
    let name = command.entry()?.label;
    menu_entry(ui, name, "", command)
}

fn open_menu_id() -> Id {
    Id::unique("menu open at the begin of the frame")
}

/// Remembers whether a menu is open. Called before anything is drawn: a click beside a menu closes it while it is drawn.
pub(crate) fn note_open_menu(ctx: &Context) {
    let is_open = Popup::is_any_open(ctx);
    ctx.data_mut(|data| data.insert_temp(open_menu_id(), is_open));
}

/// Whether a menu was open when the frame began. A click beside it only closes it.
pub(crate) fn had_open_menu(ctx: &Context) -> bool {
    ctx.data(|data| data.get_temp(open_menu_id())).unwrap_or(false)
}
