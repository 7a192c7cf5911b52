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
        self.push(TimedTouch { touch, time, landing_mps: None })
    }

    /// Sends a touch that may be a landing, and how fast it was, in m/s, as far as the stylus tells. A touch is a landing
    /// where the one before was lifted.
    ///
    /// # Errors
    /// As [`LiveInput::send`].
    pub fn land(&mut self, touch: Touch, time: Instant, landing_mps: Option<f32>) -> Result<(), Touch> {
        self.push(TimedTouch { touch, time, landing_mps })
    }

    fn push(&mut self, touch: TimedTouch) -> Result<(), Touch> {
        self.touches.push(touch).map_err(|PushError::Full(timed)| timed.touch)
    }
}
