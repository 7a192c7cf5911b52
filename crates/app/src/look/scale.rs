//! Scale of the whole window: as chosen by the user, as far as the window is large enough.

use std::ops::RangeInclusive;

use egui::{Vec2, vec2};

/// Range of the scale; 1 is the usual size.
const SCALES: RangeInclusive<f32> = 0.75..=2.5;
/// Minimum size of the window in points that must remain at a scale above 1.
const LEAST_SIZE: Vec2 = vec2(1000.0, 600.0);

/// Scale chosen by the user, and scale that was set last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    wanted: f32,
    set: f32,
}

impl Scale {
    /// Scale from the saved settings, or 1.
    pub(crate) fn new(remembered: Option<f32>) -> Self {
        let wanted = remembered.unwrap_or(1.0).clamp(*SCALES.start(), *SCALES.end());
        Self { wanted, set: wanted }
    }

    /// Scale chosen by the user, to be saved; `None` is the usual one.
    pub(crate) fn wanted(self) -> Option<f32> {
        (self.wanted != 1.0).then_some(self.wanted)
    }

    /// Scale that was set last.
    pub(crate) fn set(self) -> f32 {
        self.set
    }

    /// Called once per frame. Takes over the scale `now` if the user has changed it. Returns the scale to set in a
    /// window that is `size` points large at present, limited so that the controls still fit.
    pub(crate) fn follow(&mut self, now: f32, size: Vec2) -> f32 {
        if (now - self.set).abs() > 1e-3 {
            self.wanted = now.clamp(*SCALES.start(), *SCALES.end());
        }
        let most = (now * size / LEAST_SIZE).min_elem().max(1.0);
        self.set = self.wanted.min(most);
        self.set
    }
}

#[cfg(test)]
mod tests {
    use super::Scale;
    use egui::{Vec2, vec2};

    /// Runs a few frames of a window of this size in pixels, until the scale no longer changes.
    fn settled(scale: &mut Scale, mut now: f32, pixels: Vec2) -> f32 {
        for _ in 0..3 {
            now = scale.follow(now, pixels / now);
        }
        now
    }

    #[test]
    fn a_scale_fits_its_window() {
        for (wanted, width, height, fits) in [
            (1.0, 1280.0, 720.0, 1.0),
            (2.0, 2560.0, 1440.0, 2.0),
            (2.0, 1280.0, 720.0, 1.2),
            (1.5, 800.0, 600.0, 1.0),
            (9.0, 5000.0, 5000.0, 2.5),
            (0.5, 1280.0, 720.0, 0.75),
        ] {
            let mut scale = Scale::new(Some(wanted));
            let begun = scale.set();
            let now = settled(&mut scale, begun, vec2(width, height));
            assert!((now - fits).abs() < 1e-6, "{wanted} at {width} by {height}: {now}");
        }
    }

    /// The scale returns after the window was small for a while. A change by keyboard becomes the chosen scale.
    #[test]
    fn what_is_wanted_outlives_a_small_window() {
        let mut scale = Scale::new(Some(2.0));
        let small = settled(&mut scale, 2.0, vec2(1280.0, 720.0));
        assert_eq!((small, scale.wanted()), (1.2, Some(2.0)));
        let large = settled(&mut scale, small, vec2(2560.0, 1440.0));
        assert_eq!((large, scale.wanted()), (2.0, Some(2.0)));
        settled(&mut scale, 1.5, vec2(2560.0, 1440.0));
        assert_eq!(scale.wanted(), Some(1.5));
        settled(&mut scale, 1.0, vec2(2560.0, 1440.0));
        assert_eq!(scale.wanted(), None);
    }
}
