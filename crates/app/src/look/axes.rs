//! Transform between the space and the screen, with zoom and pan.

use egui::{Pos2, Rect, pos2};
use shagreen_core::space::SpacePoint;

/// Maximum zoom factor.
const MAX_ZOOM: f64 = 16.0;

/// Visible part of the space, a square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Corner with the lowest coordinates.
    low: SpacePoint,
    /// Side of the square, in axis units (0 to 100).
    side: f64,
}

impl Default for View {
    fn default() -> Self {
        Self { low: SpacePoint::plane(0.0, 0.0), side: 100.0 }
    }
}

impl View {
    /// Zoom factor relative to the whole space.
    pub fn zoom(self) -> f64 {
        100.0 / self.side
    }

    /// Returns the view zoomed by `factor`, with the point `fixed` at the same place on the screen.
    #[must_use]
    pub fn zoomed(self, factor: f64, fixed: SpacePoint) -> Self {
        let side = (self.side / factor).clamp(100.0 / MAX_ZOOM, 100.0);
        let share = side / self.side;
        let low = |at: f64, low: f64| at - share * (at - low);
        Self { low: SpacePoint::plane(low(fixed.x(), self.low.x()), low(fixed.y(), self.low.y())), side }
            .within()
    }

    /// Returns the view moved along both axes, in axis units (0 to 100).
    #[must_use]
    pub fn moved(self, along: f64, up: f64) -> Self {
        let low = SpacePoint::plane(self.low.x() + along, self.low.y() + up);
        Self { low, ..self }.within()
    }

    /// Returns the smallest view that shows all points with a margin; the whole space if there are none.
    pub fn around(points: &[SpacePoint]) -> Self {
        let range = |of: fn(&SpacePoint) -> f64| {
            let low = points.iter().map(of).fold(f64::INFINITY, f64::min);
            let high = points.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
            (low, high)
        };
        let (across, up) = (range(|p| p.x()), range(|p| p.y()));
        if across.0 > across.1 {
            return Self::default();
        }
        let spread = (across.1 - across.0).max(up.1 - up.0);
        let side = (1.2 * spread).clamp(100.0 / MAX_ZOOM, 100.0);
        let low = |(low, high): (f64, f64)| 0.5 * (low + high) - 0.5 * side;
        Self { low: SpacePoint::plane(low(across), low(up)), side }.within()
    }

    /// Moves the view so that nothing beyond the space is visible.
    fn within(self) -> Self {
        let most = 100.0 - self.side;
        let low = SpacePoint::plane(self.low.x().clamp(0.0, most), self.low.y().clamp(0.0, most));
        Self { low, ..self }
    }
}

/// Transform of the view to a rectangle of the screen: smooth is right, soft is up.
#[derive(Clone, Copy, Debug)]
pub struct Axes {
    /// Rectangle of the view, in UI points.
    pub rect: Rect,
    /// Visible part of the space.
    pub view: View,
}

impl Axes {
    /// Returns the screen position of a point of the space.
    pub fn ui_from_space(self, point: SpacePoint) -> Pos2 {
        let share = |at: f64, low: f64| ((at - low) / self.view.side) as f32;
        pos2(
            self.rect.left() + self.rect.width() * share(point.x(), self.view.low.x()),
            self.rect.bottom() - self.rect.height() * share(point.y(), self.view.low.y()),
        )
    }

    /// Returns the point of the space nearest to a screen position.
    pub fn space_from_ui(self, pos: Pos2) -> SpacePoint {
        let at = |x: f32, from: f32, to: f32, low: f64| {
            (low + self.view.side * f64::from((x - from) / (to - from))).clamp(0.0, 100.0)
        };
        SpacePoint::plane(
            at(pos.x, self.rect.left(), self.rect.right(), self.view.low.x()),
            at(pos.y, self.rect.bottom(), self.rect.top(), self.view.low.y()),
        )
    }

    /// Converts a displacement on the screen to axis units (0 to 100), the second one upwards.
    pub fn space_step_from_ui(self, step: egui::Vec2) -> (f64, f64) {
        let share = |step: f32, length: f32| self.view.side * f64::from(step / length);
        (share(step.x, self.rect.width()), share(-step.y, self.rect.height()))
    }

    /// Rectangle that the whole space would take on the screen.
    pub fn whole(self) -> Rect {
        let low = self.ui_from_space(SpacePoint::plane(0.0, 0.0));
        let high = self.ui_from_space(SpacePoint::plane(100.0, 100.0));
        Rect::from_two_pos(low, high)
    }
}

#[cfg(test)]
mod tests {
    use super::{Axes, MAX_ZOOM, View};
    use egui::{Rect, pos2, vec2};
    use shagreen_core::space::SpacePoint;

    fn at(rough_smooth: f64, hard_soft: f64) -> SpacePoint {
        SpacePoint::plane(rough_smooth, hard_soft)
    }

    fn axes(view: View) -> Axes {
        Axes { rect: Rect::from_min_max(pos2(10.0, 20.0), pos2(210.0, 120.0)), view }
    }

    #[test]
    fn there_and_back_and_clamped() {
        let whole = axes(View::default());
        let point = at(25.0, 75.0);
        assert_eq!(whole.ui_from_space(point), pos2(60.0, 45.0));
        assert!(whole.space_from_ui(pos2(60.0, 45.0)).distance(point) < 1e-4);
        assert_eq!(whole.space_from_ui(pos2(-50.0, 500.0)), at(0.0, 0.0));
        assert_eq!(whole.whole(), whole.rect);
    }

    #[test]
    fn zoom_keeps_a_point_where_it_is_and_the_view_within_the_space() {
        let fixed = at(30.0, 60.0);
        let before = axes(View::default()).ui_from_space(fixed);
        let near = axes(View::default().zoomed(4.0, fixed));
        assert!(
            (near.ui_from_space(fixed) - before).length() < 1e-3 && (near.view.zoom() - 4.0).abs() < 1e-12
        );
        assert!(near.space_from_ui(before).distance(fixed) < 1e-4);
        assert_eq!(near.view.zoomed(1e-3, fixed), View::default());
        assert!((near.view.zoomed(1e3, fixed).zoom() - MAX_ZOOM).abs() < 1e-9);
        let corner = near.view.moved(1e3, 1e3);
        assert!((axes(corner).ui_from_space(at(100.0, 100.0)) - pos2(210.0, 20.0)).length() < 1e-3);
        let (along, up) = near.space_step_from_ui(vec2(200.0, 100.0));
        assert!((along - 25.0).abs() < 1e-4 && (up + 25.0).abs() < 1e-4);
    }

    #[test]
    fn a_view_fits_points() {
        let points = [at(40.0, 10.0), at(60.0, 20.0)];
        let view = View::around(&points);
        assert!((view.zoom() - 100.0 / 24.0).abs() < 1e-9);
        assert!(points.iter().all(|p| axes(view).rect.contains(axes(view).ui_from_space(*p))));
        assert_eq!(View::around(&[]), View::default());
        assert!((View::around(&[at(0.0, 100.0)]).zoom() - MAX_ZOOM).abs() < 1e-9);
    }
}
