//! Commands about the clipboard of the system.

use egui::text_selection::LabelSelectionState;
use egui::{Context, Event};

/// Command about the clipboard. Authored textures are given by their keys; `None` is the one that is shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ClipboardCommand {
    /// Copies an authored texture.
    Copy(Option<u32>),
    /// Copies an authored texture, then deletes it.
    Cut(Option<u32>),
    /// Requests the text of the clipboard. It arrives later, as an event.
    Paste,
    /// Adds the authored texture that this text describes.
    Read(String),
}

/// Clipboard commands of this frame. The window system reports the shortcuts as events. While a text field has the
/// keyboard focus, they apply to its text. Selected text of a label is copied instead of a texture.
pub(super) fn pressed(ctx: &Context) -> Vec<ClipboardCommand> {
    if ctx.text_edit_focused() {
        return Vec::new();
    }
    let is_text_selected = has_selected_text(ctx);
    let command = |event: &Event| match event {
        Event::Copy if !is_text_selected => Some(ClipboardCommand::Copy(None)),
        Event::Cut if !is_text_selected => Some(ClipboardCommand::Cut(None)),
        Event::Paste(text) => Some(ClipboardCommand::Read(text.clone())),
        _ => None,
    };
    ctx.input(|i| i.events.iter().filter_map(command).collect())
}

fn has_selected_text(ctx: &Context) -> bool {
    ctx.plugin_opt::<LabelSelectionState>().is_some_and(|state| state.lock().has_selection())
}
