//! How large everything is drawn.

use std::ops::RangeInclusive;

use egui::{Vec2, vec2};

/// How much larger than usual everything may be drawn.
const SCALES: RangeInclusive<f32> = 0.75..=2.5;
/// Size of the window in points that is left at least where everything is drawn larger than usual.
const LEAST_SIZE: Vec2 = vec2(1000.0, 600.0);

/// The scale that is nearest to a remembered one.
pub(crate) fn possible_scale(scale: f32) -> f32 {
    scale.clamp(*SCALES.start(), *SCALES.end())
}

/// The scale that is nearest to the present one, of a window that has this `size` in points by it: larger, nothing would be
/// found any more.
pub(crate) fn fitting_scale(scale: f32, size: Vec2) -> f32 {
    let most = (scale * size / LEAST_SIZE).min_elem().max(1.0);
    possible_scale(scale.min(most))
}

#[cfg(test)]
mod tests {
    use super::{fitting_scale, possible_scale};
    use egui::vec2;

    #[test]
    fn a_scale_fits_its_window() {
        let screen = |scale: f32, width: f32, height: f32| fitting_scale(scale, vec2(width, height) / scale);
        for (scale, width, height, fits) in [
            (1.0, 1280.0, 720.0, 1.0),
            (2.0, 2560.0, 1440.0, 2.0),
            (2.0, 1280.0, 720.0, 1.2),
            (1.5, 800.0, 600.0, 1.0),
            (9.0, 5000.0, 5000.0, 2.5),
            (0.5, 1280.0, 720.0, 0.75),
        ] {
            assert!((screen(scale, width, height) - fits).abs() < 1e-6, "{scale} at {width} by {height}");
        }
        assert_eq!([0.1, 1.5, 40.0].map(possible_scale), [0.75, 1.5, 2.5]);
    }
}
