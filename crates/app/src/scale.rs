//! How large everything is drawn: as the user wants it, as far as the window has room.

use std::ops::RangeInclusive;

use egui::{Vec2, vec2};

/// How much larger than usual everything may be drawn.
const SCALES: RangeInclusive<f32> = 0.75..=2.5;
/// Size of the window in points that is left at least where everything is drawn larger than usual.
const LEAST_SIZE: Vec2 = vec2(1000.0, 600.0);

/// The scale that is wanted, and the one that was set last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    wanted: f32,
    set: f32,
}

impl Scale {
    /// The scale that is remembered, or the usual one.
    pub(crate) fn new(remembered: Option<f32>) -> Self {
        let wanted = remembered.unwrap_or(1.0).clamp(*SCALES.start(), *SCALES.end());
        Self { wanted, set: wanted }
    }

    /// What the user wants, to be remembered; `None` is as usual.
    pub(crate) fn wanted(self) -> Option<f32> {
        (self.wanted != 1.0).then_some(self.wanted)
    }

    /// The scale that was set last.
    pub(crate) fn set(self) -> f32 {
        self.set
    }

    /// Once a frame: takes over the scale that is `now` where the user has changed it, and returns the one to set in a
    /// window that has this `size` in points now: larger, nothing would be found any more.
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

    /// Frames of a window of this size in pixels, until nothing changes any more.
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

    /// A window that was small for a while has its scale back in the large one; what the keyboard changes is wanted from
    /// then on.
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
