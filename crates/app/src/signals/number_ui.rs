//! A number that can be dragged or written, with its word beside it.

use egui::{DragValue, Label, RichText, Ui};

use crate::theme::tokens;

/// Draws the word and the number, which a screen reader calls by its `name`.
pub(super) fn number_ui(ui: &mut Ui, word: &str, name: &str, help: &str, value: DragValue<'_>) {
    let text = RichText::new(word).small().color(tokens(ui.ctx()).text_weak);
    ui.add(Label::new(text).selectable(false)).on_hover_text(help);
    ui.add(value).accessible_name(name).on_hover_text(help);
}
