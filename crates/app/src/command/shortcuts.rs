//! Commands whose keyboard shortcuts were pressed.

use egui::{Event, Key, Modifiers};

use super::{Command, clipboard, listed};

fn was_writing_id() -> egui::Id {
    egui::Id::unique("a text field had the focus")
}

/// Whether a text field had the keyboard focus when [`pressed`] was last called.
pub(crate) fn was_writing(ctx: &egui::Context) -> bool {
    ctx.data(|data| data.get_temp(was_writing_id())).unwrap_or(false)
}

/// Commands whose shortcuts were pressed in this frame. Shortcuts without modifiers apply only if nothing or `canvas`
/// has the keyboard focus, because buttons and text fields use those keys themselves. They do not apply in the frame
/// after a text field lost the focus either: the key was still meant for the field.
pub fn pressed(ctx: &egui::Context, canvas: egui::Id) -> Vec<Command> {
    let focused = ctx.memory(egui::Memory::focused);
    let is_writing = ctx.text_edit_focused();
    let was_writing =
        ctx.data_mut(|data| std::mem::replace(data.get_temp_mut_or_default(was_writing_id()), is_writing));
    let plain_keys_are_ours = focused.is_none_or(|f| f == canvas) && !was_writing;
    // The shortcut of redo contains that of undo, and that of "save as" contains that of "save". Longer ones come
    // first.
    let has_shift = |c: &Command| c.shortcut().is_some_and(|s| s.modifiers.shift);
    let mut commands: Vec<Command> = listed().collect();
    commands.sort_by_key(|c| !has_shift(c));
    let keys = keys_in_order(ctx);
    let mut found: Vec<(usize, Command)> = Vec::new();
    for command in commands {
        let Some(shortcut) = command.shortcut() else { continue };
        let plain = shortcut.modifiers == Modifiers::NONE;
        let is_event = matches!(command, Command::Clipboard(_));
        if !is_event && (plain_keys_are_ours || !plain) && ctx.input_mut(|i| i.consume_shortcut(&shortcut)) {
            let place = keys.iter().position(|(modifiers, key)| {
                *key == shortcut.logical_key && modifiers.matches_logically(shortcut.modifiers)
            });
            found.push((place.unwrap_or(keys.len()), command));
        }
    }
    // A slow frame has several keys: what was undone first is not saved.
    found.sort_by_key(|(place, _)| *place);
    let commands = found.into_iter().map(|(_, command)| command);
    commands.chain(clipboard::pressed(ctx).into_iter().map(Command::Clipboard)).collect()
}

/// Keys pressed in this frame with their modifiers, in the order in which they were pressed.
fn keys_in_order(ctx: &egui::Context) -> Vec<(Modifiers, Key)> {
    let key = |event: &Event| match event {
        Event::Key { key, modifiers, pressed: true, .. } => Some((*modifiers, *key)),
        _ => None,
    };
    ctx.input(|i| i.events.iter().filter_map(key).collect())
}
