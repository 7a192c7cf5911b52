//! Position of a drag, and of its release.

use egui::{Event, PointerButton, Pos2, Response, Ui};

/// Returns the position to which the pointer has dragged `response` in this frame, or `None` if it is not dragged. In
/// the frame of the release this is the position of the release: a slow frame may also hold later moves.
pub(crate) fn dragged_to(ui: &Ui, response: &Response) -> Option<Pos2> {
    if response.drag_stopped() {
        let released = |event: &Event| match event {
            Event::PointerButton { pos, button: PointerButton::Primary, pressed: false, .. } => Some(*pos),
            _ => None,
        };
        let at_release = ui.input(|i| i.events.iter().find_map(released));
        return at_release.or(response.interact_pointer_pos());
    }
    response.interact_pointer_pos().filter(|_| response.dragged())
}
