//! The main button of a sheet or column.

use egui::{Button, Response, RichText, Ui};

use crate::look::theme::tokens;

/// Draws a button in the accent color, or a plain one while it is not enabled.
pub(crate) fn primary_ui(ui: &mut Ui, text: &str, is_enabled: bool) -> Response {
    let t = tokens(ui.ctx());
    let color = if is_enabled { t.on_accent } else { t.text_weak };
    let button = Button::new(RichText::new(text).color(color));
    let button = if is_enabled { button.fill(t.accent) } else { button };
    ui.add_enabled(is_enabled, button)
}
