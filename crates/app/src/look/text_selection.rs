//! Selection of text in a field, so that typing replaces it.

use std::ops::Range;

use egui::text::{CCursor, CCursorRange};
use egui::{Context, Id, TextEdit};

/// Selects all of the text of the field with this widget id. The field must have the keyboard focus or have requested it:
/// another one drops its selection.
pub(crate) fn select_all(ctx: &Context, field: Id, text: &str) {
    select_chars(ctx, field, 0..text.chars().count());
}

/// The same with a range of characters.
pub(crate) fn select_chars(ctx: &Context, field: Id, chars: Range<usize>) {
    let mut state = TextEdit::load_state(ctx, field).unwrap_or_default();
    let ends = CCursorRange::two(CCursor::new(chars.start), CCursor::new(chars.end));
    state.cursor.set_char_range(Some(ends));
    state.store(ctx, field);
}
