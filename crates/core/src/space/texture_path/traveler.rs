//! Progress of a stroke along a path.

use crate::space::texture_path::Along;
use crate::units::Contact;

/// Progress of a stroke along a path. It advances during contact, stops while the tip is lifted, and restarts at each
/// new contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathProgress {
    along: Along,
    traveled: f64,
    touches: bool,
}

impl PathProgress {
    /// Progress before the first contact.
    pub fn new(along: Along) -> Self {
        Self { along, traveled: 0.0, touches: false }
    }

    /// Quantity that is measured.
    pub fn along(&self) -> Along {
        self.along
    }

    /// Traveled distance or time of the current stroke, in m or s.
    pub fn traveled(&self) -> f64 {
        self.traveled
    }

    /// Advances by `secs` with the given contact.
    pub fn go(&mut self, contact: Contact, secs: f64) {
        let touches = contact.force.0 > 0.0;
        if touches && !self.touches {
            self.traveled = 0.0;
        }
        self.touches = touches;
        if touches {
            self.traveled += match self.along {
                Along::Distance => contact.speed.0.abs() * secs,
                Along::Time => secs,
            };
        }
    }
}

/// Progress of a stroke along a path, computed in advance in time steps.
#[derive(Clone, Debug, PartialEq)]
pub struct PrecomputedProgress {
    step_secs: f64,
    /// Progress at the beginning of each step, in m or s; has at least one entry.
    traveled: Vec<f64>,
}

impl PrecomputedProgress {
    /// Progress of a stroke of this duration whose contact at a time in seconds is `contact_at`.
    pub fn new(
        along: Along,
        length_secs: f64,
        step_secs: f64,
        contact_at: &mut dyn FnMut(f64) -> Contact,
    ) -> Self {
        let mut traveler = PathProgress::new(along);
        let step = |step: usize| {
            let now = traveler.traveled();
            traveler.go(contact_at(step_secs * (step as f64 + 0.5)), step_secs);
            now
        };
        Self { step_secs, traveled: (0..=(length_secs / step_secs).ceil() as usize).map(step).collect() }
    }

    /// Progress at a time, to the nearest step, in m or s.
    pub fn at(&self, time_secs: f64) -> f64 {
        let step = (time_secs.max(0.0) / self.step_secs).round() as usize;
        self.traveled[step.min(self.traveled.len() - 1)]
    }
}
