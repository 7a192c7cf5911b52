//! The main button of a sheet or column.

use egui::{Button, Response, RichText, Ui};

use crate::look::theme::{Tokens, tokens};

/// Draws a button in the accent color, or a plain one while it is not enabled.
pub(crate) fn primary_ui(ui: &mut Ui, text: &str, is_enabled: bool) -> Response {
    ui.add_enabled(is_enabled, primary_button(tokens(ui.ctx()), text, is_enabled))
}

/// The button of [`primary_ui`], for places that give it a size.
pub(crate) fn primary_button(t: &Tokens, text: impl Into<RichText>, is_enabled: bool) -> Button<'static> {
    let color = if is_enabled { t.on_accent } else { t.text_weak };
    let button = Button::new(text.into().color(color));
    if is_enabled { button.fill(t.accent) } else { button }
}
