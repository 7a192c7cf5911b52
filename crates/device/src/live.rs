//! The way of a person's touches into the engine.

use std::time::Instant;

use rtrb::{Producer, PushError};

use crate::touch::Touch;

/// A touch and when it was.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TimedTouch {
    pub(crate) touch: Touch,
    pub(crate) time: Instant,
    /// How fast the tip landed, in m/s, where that is known.
    pub(crate) landing_mps: Option<f32>,
    /// Whether the stylus touches or is about to.
    pub(crate) is_near: bool,
}

impl TimedTouch {
    /// A stylus that touches is near, and one that does not is not.
    pub(crate) fn new(touch: Touch, time: Instant, landing_mps: Option<f32>) -> Self {
        Self { touch, time, landing_mps, is_near: touch.contact.force_n > 0.0 }
    }
}

/// The sender's end of a bounded ring of touches: it belongs to whoever reads the stylus, on any thread.
#[derive(Debug)]
pub struct LiveInput {
    pub(crate) touches: Producer<TimedTouch>,
}

impl LiveInput {
    /// Sends what the stylus did at `time`; the newest counts, and its speed decays when no other follows.
    ///
    /// # Errors
    /// Gives the touch back while the ring is full, which it is only when the output has stopped.
    pub fn send(&mut self, touch: Touch, time: Instant) -> Result<(), Touch> {
        self.push(TimedTouch::new(touch, time, None))
    }

    /// Sends a touch that may be a landing, and how fast it was, in m/s, as far as the stylus tells. A touch is a landing
    /// where the one before was lifted.
    ///
    /// # Errors
    /// As [`LiveInput::send`].
    pub fn land(&mut self, touch: Touch, time: Instant, landing_mps: Option<f32>) -> Result<(), Touch> {
        self.push(TimedTouch::new(touch, time, landing_mps))
    }

    /// Sends that the stylus is near, above the place of `touch`: it is nobody's turn but the person's from now on where the
    /// controls let the hand take over ([`crate::controls::Takeover`]).
    ///
    /// # Errors
    /// As [`LiveInput::send`].
    pub fn hover(&mut self, touch: Touch, time: Instant) -> Result<(), Touch> {
        self.push(TimedTouch { is_near: true, ..TimedTouch::new(touch.lifted(), time, None) })
    }

    fn push(&mut self, touch: TimedTouch) -> Result<(), Touch> {
        self.touches.push(touch).map_err(|PushError::Full(timed)| timed.touch)
    }
}
