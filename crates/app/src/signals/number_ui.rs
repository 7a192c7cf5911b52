//! Number that can be dragged or typed, with a label beside it.

use egui::{DragValue, Label, RichText, Ui};

use crate::look::theme::tokens;

/// Draws the label and the number; `name` is the accessible name of the number.
pub(super) fn number_ui(ui: &mut Ui, word: &str, name: &str, help: &str, value: DragValue<'_>) {
    let text = RichText::new(word).small().color(tokens(ui.ctx()).text_weak);
    ui.add(Label::new(text).selectable(false)).on_hover_text(help);
    ui.add(value).accessible_name(name).on_hover_text(help);
}
