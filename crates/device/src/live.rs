//! The way of a person's touches into the engine.

use std::time::Instant;

use rtrb::{Producer, PushError};

use crate::touch::Touch;

/// A touch and when it was.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TimedTouch {
    pub(crate) touch: Touch,
    pub(crate) time: Instant,
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
        self.touches.push(TimedTouch { touch, time }).map_err(|PushError::Full(timed)| timed.touch)
    }
}
