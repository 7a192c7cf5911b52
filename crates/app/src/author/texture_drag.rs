//! Drag of a texture from the list.

use std::sync::Arc;

use egui::{Context, DragAndDrop, PointerButton, Response, Sense, Ui};

use crate::panel::Panel;

/// Texture that is dragged, by its identifier.
struct DraggedTexture(String);

/// Interaction of a row of the list. On a touch screen a drag scrolls the list instead.
pub(crate) fn row_sense(ui: &Ui) -> Sense {
    if ui.input(egui::InputState::has_touch_screen) { Sense::click() } else { Sense::click_and_drag() }
}

/// Begins the drag of a row with the primary button. Escape ends it.
pub(crate) fn follow_row_drag(response: &Response, id: &str) {
    if response.drag_started_by(PointerButton::Primary) {
        DragAndDrop::set_payload(&response.ctx, DraggedTexture(id.to_owned()));
    }
}

/// Index of the texture that is dragged, also in the frame of its release.
pub(crate) fn dragged_texture(ctx: &Context, panel: &Panel<'_>) -> Option<usize> {
    let dragged: Arc<DraggedTexture> = DragAndDrop::payload(ctx)?;
    panel.session.index_of(&dragged.0)
}
