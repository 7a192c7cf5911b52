//! Where a drag is, and where it ended.

use egui::{Event, PointerButton, Pos2, Response, Ui};

/// Returns where the pointer has dragged `response` to in this frame, or `None` where it is not dragged. In the frame
/// of the release that is the place of the release itself: a slow frame may also hold moves that came after it.
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
