//! The map between the space and the screen.

use egui::{Pos2, Rect, pos2};
use shagreen_core::space::SpacePoint;

/// Places the square of the space in a rectangle of the screen: smooth to the right, soft to the top.
#[derive(Clone, Copy, Debug)]
pub struct Axes {
    /// Where the square lies, in ui points.
    pub rect: Rect,
}

impl Axes {
    /// Where a point of the space is on the screen.
    pub fn ui_from_space(self, point: SpacePoint) -> Pos2 {
        pos2(
            self.rect.left() + self.rect.width() * (point.rough_smooth / 100.0) as f32,
            self.rect.bottom() - self.rect.height() * (point.hard_soft / 100.0) as f32,
        )
    }

    /// The point of the square nearest to a place on the screen.
    pub fn space_from_ui(self, pos: Pos2) -> SpacePoint {
        let share =
            |x: f32, from: f32, to: f32| f64::from(100.0 * (x - from) / (to - from)).clamp(0.0, 100.0);
        SpacePoint {
            rough_smooth: share(pos.x, self.rect.left(), self.rect.right()),
            hard_soft: share(pos.y, self.rect.bottom(), self.rect.top()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Axes;
    use egui::{Rect, pos2};
    use shagreen_core::space::SpacePoint;

    #[test]
    fn there_and_back_and_clamped() {
        let axes = Axes { rect: Rect::from_min_max(pos2(10.0, 20.0), pos2(210.0, 120.0)) };
        let point = SpacePoint { rough_smooth: 25.0, hard_soft: 75.0 };
        assert_eq!(axes.ui_from_space(point), pos2(60.0, 45.0));
        assert!(axes.space_from_ui(pos2(60.0, 45.0)).distance(point) < 1e-4);
        let outside = axes.space_from_ui(pos2(-50.0, 500.0));
        assert_eq!((outside.rough_smooth, outside.hard_soft), (0.0, 0.0));
    }
}
