//! Ring around the widget with the keyboard focus. Many widgets paint no background, or one that hardly differs when
//! they have the focus.

use egui::{Context, Stroke, StrokeKind};

use crate::look::theme::tokens;

/// Gap between a widget and the ring, in points.
const GAP: f32 = 1.5;
/// Width of the ring, in points.
const WIDTH: f32 = 1.5;

/// Draws the ring, on the layer of the widget. A text field is left out, because its cursor shows the focus.
pub(super) fn focus_ring_ui(ctx: &Context) {
    let Some(id) = ctx.memory(egui::Memory::focused).filter(|_| !ctx.text_edit_focused()) else { return };
    let Some(widget) = ctx.read_response(id) else { return };
    // What scrolls is visible within this area only.
    let visible = widget.interact_rect.expand(GAP + WIDTH);
    let painter = ctx.layer_painter(widget.layer_id).with_clip_rect(visible);
    let stroke = Stroke::new(WIDTH, tokens(ctx).accent);
    painter.rect_stroke(widget.rect.expand(GAP), 3.0, stroke, StrokeKind::Middle);
}
