//! How far a stroke has come along a path.

use std::time::Instant;

use shagreen_core::texture_path::{Along, TexturePath, Traveler};
use shagreen_core::units::{Contact, MetersPerSecond, Newtons};
use shagreen_device::touch::Touch;

/// The place of the stroke on a path that is played.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathWalk {
    traveler: Traveler,
    last: Option<Instant>,
}

impl PathWalk {
    /// Before the stroke.
    pub(super) fn new(along: Along) -> Self {
        Self { traveler: Traveler::new(along), last: None }
    }

    /// What is counted.
    pub(super) fn along(&self) -> Along {
        self.traveler.along()
    }

    /// How far the stroke has come, in m or s.
    pub(super) fn traveled(&self) -> f64 {
        self.traveler.traveled()
    }

    /// Goes on to where the stroke is at `now`.
    pub(super) fn advance(&mut self, touch: Touch, now: Instant) {
        let secs = self.last.map_or(0.0, |last| now.duration_since(last).as_secs_f64());
        self.last = Some(now);
        let contact = Contact {
            speed: MetersPerSecond(f64::from(touch.contact.speed_mps)),
            force: Newtons(f64::from(touch.contact.force_n)),
        };
        self.traveler.go(contact, secs);
    }

    /// The key of a path that is nearest to where the stroke is: keys lie so close that a fade from one to the next is
    /// as good as what lies between.
    pub(super) fn nearest_key(&self, path: &TexturePath) -> usize {
        let (key, share) = path.between(self.traveled());
        key + usize::from(share >= 0.5)
    }
}
