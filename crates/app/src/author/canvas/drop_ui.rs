//! Drop of a texture of the list onto the canvas, which adds an authored texture.

use egui::{Align2, CursorIcon, FontId, Id, LayerId, Order, Painter, Pos2, Rect, Shape, Stroke, Ui, vec2};

use super::site_radius;
use super::sites_ui::picture_disc;
use crate::author::exact::authored_exactly;
use crate::author::texture_drag::dragged_texture;
use crate::command::Command;
use crate::look::axes::Axes;
use crate::look::theme::Tokens;
use crate::panel::Panel;
use crate::strings::authored as words;

/// Draws the dragged texture at the pointer and, over the canvas, a line to its position in the space. Returns the command
/// of a drop inside `area`.
pub(super) fn drop_ui(ui: &Ui, axes: Axes, area: Rect, panel: &Panel<'_>, t: &Tokens) -> Option<Command> {
    let texture = dragged_texture(ui.ctx(), panel)?;
    let pointer = ui.input(|i| i.pointer.latest_pos())?;
    let name = &panel.session.textures()[texture].name;
    let edit = authored_exactly(panel, texture);
    let place = panel.session.position(texture).map(|at| axes.ui_from_space(at));
    let radius = site_radius(axes);
    let painter = ui.ctx().layer_painter(LayerId::new(Order::Tooltip, Id::unique("dragged texture")));
    let is_over = ui.rect_contains_pointer(area);
    if is_over && let Some(place) = place {
        let inside = painter.with_clip_rect(area);
        let line = Stroke::new(2.0, t.accent);
        inside.extend(Shape::dashed_line(&[pointer, place], line, 6.0, 4.0));
        inside.circle_stroke(place, radius + 4.0, line);
    }
    ghost_ui(&painter, panel, texture, pointer, radius, t);
    let (text, color) = match (is_over, place) {
        (false, _) => (name.clone(), t.text),
        (true, Some(_)) => (words::drop_adds(name), t.text),
        (true, None) => (words::cannot_drop(name), t.warning),
    };
    label_ui(&painter, ui.ctx().content_rect(), pointer, radius, text, color, t);
    if is_over && edit.is_none() {
        ui.ctx().set_cursor_icon(CursorIcon::NotAllowed);
    }
    let is_dropped = is_over && ui.input(|i| i.pointer.primary_released());
    edit.filter(|_| is_dropped).map(Command::Edit)
}

/// Draws the picture of the texture as on the canvas, half transparent.
fn ghost_ui(painter: &Painter, panel: &Panel<'_>, texture: usize, at: Pos2, radius: f32, t: &Tokens) {
    match picture_disc(panel, texture, at, radius) {
        Some(mut disc) => {
            disc.fill = disc.fill.gamma_multiply(0.8);
            painter.add(disc);
        }
        None => {
            painter.circle_filled(at, radius, t.text_weak.gamma_multiply(0.8));
        }
    }
    painter.circle_stroke(at, radius, Stroke::new(2.0, t.text));
}

/// Draws a text below the ghost, inside `screen`.
fn label_ui(
    painter: &Painter,
    screen: Rect,
    pointer: Pos2,
    radius: f32,
    text: String,
    color: egui::Color32,
    t: &Tokens,
) {
    let galley = painter.layout_no_wrap(text, FontId::proportional(12.5), color);
    let middle = pointer + vec2(0.0, radius + 8.0);
    let area = Align2::CENTER_TOP.anchor_size(middle, galley.size()).expand2(vec2(5.0, 2.0));
    let left = (screen.left() - area.left()).max(0.0);
    let area = area.translate(vec2(left + (screen.right() - area.right() - left).min(0.0), 0.0));
    painter.rect_filled(area, 3.0, t.background.gamma_multiply(0.9));
    painter.galley(area.min + vec2(5.0, 2.0), galley, color);
}
