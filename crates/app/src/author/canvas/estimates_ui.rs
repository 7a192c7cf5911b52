//! Ellipses around estimated positions: one standard deviation along each axis.

use egui::{Color32, Pos2, Shape, Stroke, Ui};
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::space::SpacePoint;

use super::slice::{Slice, is_named};
use crate::look::axes::Axes;
use crate::look::theme::Tokens;
use crate::panel::Panel;

/// Number of vertices of an ellipse.
const N_POINTS: usize = 96;

/// Draws an ellipse around a position estimated along both axes, for example from a prompt or photo.
pub(super) fn ellipse_ui(ui: &Ui, axes: Axes, [across, up]: [Estimate; 2], color: Color32) {
    let at = |angle: f64| {
        axes.ui_from_space(SpacePoint::plane(
            across.mean + across.deviation * angle.cos(),
            up.mean + up.deviation * angle.sin(),
        ))
    };
    let n = N_POINTS;
    let mut outline: Vec<Pos2> = (0..n).map(|i| at(std::f64::consts::TAU * i as f64 / n as f64)).collect();
    let fill = color.gamma_multiply(0.07);
    ui.painter().add(Shape::convex_polygon(outline.clone(), fill, Stroke::NONE));
    outline.extend(outline.first().copied());
    ui.painter().extend(Shape::dashed_line(&outline, Stroke::new(1.4, color.gamma_multiply(0.8)), 6.0, 4.0));
}

/// Draws an ellipse around each texture of the selected authored texture whose position was estimated with a standard
/// deviation, unless it is far from the slice that the canvas shows.
pub(super) fn site_ellipses_ui(ui: &Ui, axes: Axes, panel: &Panel<'_>, t: &Tokens) {
    let slice = panel.session.is_sliced().then(|| Slice::of(panel));
    for (texture, at) in panel.session.placed_for(&panel.project.texture().blend) {
        if slice.is_some_and(|slice| !is_named(slice.nearness(at))) {
            continue;
        }
        let Some([across, up]) = panel.session.place_deviation(texture) else { continue };
        let estimates =
            [Estimate { mean: at.x(), deviation: across }, Estimate { mean: at.y(), deviation: up }];
        ellipse_ui(ui, axes, estimates, t.text_weak);
    }
}
