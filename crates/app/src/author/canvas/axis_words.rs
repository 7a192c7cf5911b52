//! Grid lines of the canvas, and the words at the ends of its axes.

use std::sync::Arc;

use egui::epaint::TextShape;
use egui::{Align2, FontId, Galley, Painter, Pos2, Rect, Stroke, Ui, pos2};
use shagreen_core::space::SpacePoint;

use super::site_labels::backing_ui;
use super::site_radius;
use crate::look::axes::Axes;
use crate::look::theme::Tokens;

/// Font size of the words, in points.
const SIZE: f32 = 13.0;

/// Word at an end of an axis.
pub(super) struct AxisWord {
    /// Area that it covers.
    pub(super) area: Rect,
    galley: Arc<Galley>,
    /// Position of the upper left corner of the text, and its angle in radians.
    pos: Pos2,
    angle: f32,
}

impl AxisWord {
    /// Draws the word over whatever lies there.
    pub(super) fn show(self, painter: &Painter, t: &Tokens) {
        backing_ui(painter, self.area, t);
        painter.add(TextShape::new(self.pos, self.galley, t.text_weak).with_angle(self.angle));
    }
}

/// Draws the grid lines.
pub(super) fn grid_ui(ui: &Ui, axes: Axes, t: &Tokens) {
    let painter = ui.painter();
    let faint = Stroke::new(1.0, t.line.gamma_multiply(0.5));
    let r = axes.rect;
    for i in 0..=4 {
        let line = axes.ui_from_space(SpacePoint::plane(25.0 * f64::from(i), 25.0 * f64::from(i)));
        if r.x_range().expand(1.0).contains(line.x) {
            painter.vline(line.x, r.y_range(), faint);
        }
        if r.y_range().expand(1.0).contains(line.y) {
            painter.hline(r.x_range(), line.y, faint);
        }
    }
}

/// Returns the words at the ends of the axes of the canvas `outer`, those of the x axis first.
pub(super) fn axis_words(
    ui: &Ui,
    axes: Axes,
    outer: Rect,
    poles: &[[String; 2]],
    t: &Tokens,
) -> Vec<AxisWord> {
    let painter = ui.painter();
    let layout =
        |text: &str| painter.layout_no_wrap(text.to_owned(), FontId::proportional(SIZE), t.text_weak);
    let r = axes.rect;
    let bottom = outer.bottom() - 6.0;
    let across = poles.first().into_iter().flat_map(|[low, high]| {
        [(r.left(), Align2::LEFT_BOTTOM, low), (r.right(), Align2::RIGHT_BOTTOM, high)]
    });
    let across = across.map(|(x, align, text)| {
        let galley = layout(text);
        let area = align.anchor_size(pos2(x, bottom), galley.size());
        AxisWord { area, galley, pos: area.min, angle: 0.0 }
    });
    // A space with one axis has no vertical one.
    let up = poles.get(1).into_iter().flat_map(|[low, high]| [(high, r.top()), (low, r.bottom())]);
    let up = up.map(|(text, y)| {
        let galley = layout(text);
        let size = galley.size();
        // Beside the corner, where the picture of a texture may lie.
        let y = if y == r.top() { y + size.x } else { y - site_radius(axes) - 6.0 };
        let pos = pos2(outer.left() + 8.0, y);
        let area = Rect::from_min_max(pos2(pos.x, y - size.x), pos2(pos.x + size.y, y));
        AxisWord { area, galley, pos, angle: -std::f32::consts::FRAC_PI_2 }
    });
    across.chain(up).collect()
}
