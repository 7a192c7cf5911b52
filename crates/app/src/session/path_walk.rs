//! Progress of a stroke along a path.

use std::time::Instant;

use shagreen_core::space::texture_path::{Along, PathProgress, TexturePath};
use shagreen_device::touch::Touch;

/// Position of the stroke on a path that is played.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathWalk {
    traveler: PathProgress,
    last: Option<Instant>,
}

impl PathWalk {
    /// At the start of the path.
    pub(super) fn new(along: Along) -> Self {
        Self { traveler: PathProgress::new(along), last: None }
    }

    /// Quantity that is measured along the path.
    pub(super) fn along(&self) -> Along {
        self.traveler.along()
    }

    /// Traveled distance in m or time in s.
    pub(super) fn traveled(&self) -> f64 {
        self.traveler.traveled()
    }

    /// Advances to `now` with the speed and force of `touch`.
    pub(super) fn advance(&mut self, touch: Touch, now: Instant) {
        let secs = self.last.map_or(0.0, |last| now.duration_since(last).as_secs_f64());
        self.last = Some(now);
        self.traveler.go(touch.contact.into(), secs);
    }

    /// Index of the key that is nearest to the stroke. Keys are so close that a fade between neighbors replaces
    /// interpolation.
    pub(super) fn nearest_key(&self, path: &TexturePath) -> usize {
        let (key, share) = path.between(self.traveled());
        key + usize::from(share >= 0.5)
    }
}
