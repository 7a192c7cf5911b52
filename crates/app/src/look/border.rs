//! Borders of panels, which a drag moves and a double click puts back.

use egui::{CursorIcon, Id, Rect, Sense, Stroke, Ui};

use crate::look::theme::tokens;

/// Width of the strip beside a border that can be dragged, outside and inside its panel, in points.
const OUTSIDE: f32 = 5.0;
const INSIDE: f32 = 2.0;

/// Edge of a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Edge {
    Left,
    Right,
    Top,
}

/// Follows a drag of the border at an edge of the panel with this area. `size` becomes the width of the panel, or its height
/// for the upper edge, in points; `None` is its usual size. Called after everything beside the panel is drawn.
pub(crate) fn border_ui(ui: &Ui, name: &str, panel: Rect, edge: Edge, size: &mut Option<f32>) {
    let (area, line, cursor) = match edge {
        Edge::Left => {
            let x_range = panel.left() - OUTSIDE..=panel.left() + INSIDE;
            let line = [panel.left_top(), panel.left_bottom()];
            (Rect::from_x_y_ranges(x_range, panel.y_range()), line, CursorIcon::ResizeHorizontal)
        }
        Edge::Right => {
            let x_range = panel.right() - INSIDE..=panel.right() + OUTSIDE;
            let line = [panel.right_top(), panel.right_bottom()];
            (Rect::from_x_y_ranges(x_range, panel.y_range()), line, CursorIcon::ResizeHorizontal)
        }
        Edge::Top => {
            let y_range = panel.top() - OUTSIDE..=panel.top() + INSIDE;
            let line = [panel.left_top(), panel.right_top()];
            (Rect::from_x_y_ranges(panel.x_range(), y_range), line, CursorIcon::ResizeVertical)
        }
    };
    // Without the keyboard focus.
    let response = ui.interact(area, Id::unique(("border of a panel", name)), Sense::CLICK | Sense::DRAG);
    let response = response.on_hover_and_drag_cursor(cursor);
    if response.hovered() || response.dragged() {
        ui.painter().line_segment(line, Stroke::new(2.0, tokens(ui.ctx()).accent));
    }
    if let Some(pos) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        *size = Some(match edge {
            Edge::Left => panel.right() - pos.x,
            Edge::Right => pos.x - panel.left(),
            Edge::Top => panel.bottom() - pos.y,
        });
    }
    if response.double_clicked() {
        *size = None;
    }
}
