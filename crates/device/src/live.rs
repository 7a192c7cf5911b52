//! Input of live touches to the engine.

use std::time::Instant;

use rtrb::{Producer, PushError};

use crate::touch::Touch;

/// A touch with its time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TimedTouch {
    pub(crate) touch: Touch,
    pub(crate) time: Instant,
    /// Impact speed of the tip in m/s, if known.
    pub(crate) landing_mps: Option<f32>,
    /// Whether the stylus touches or is in proximity.
    pub(crate) is_near: bool,
}

impl TimedTouch {
    /// A touch of a stylus that is near only while it touches.
    pub(crate) fn new(touch: Touch, time: Instant, landing_mps: Option<f32>) -> Self {
        Self { touch, time, landing_mps, is_near: touch.contact.force_n > 0.0 }
    }
}

/// Sender of live touches through a bounded queue, for the reader of a stylus on any thread.
#[derive(Debug)]
pub struct LiveInput {
    pub(crate) touches: Producer<TimedTouch>,
}

impl LiveInput {
    /// Sends the touch of the stylus at `time`. It applies until the next touch; if none follows, its speed decays
    /// ([`crate::kinematics::held_speed`]).
    ///
    /// # Errors
    /// Returns the touch if the queue is full, which happens only when the output has stopped.
    pub fn send(&mut self, touch: Touch, time: Instant) -> Result<(), Touch> {
        self.push(TimedTouch::new(touch, time, None))
    }

    /// Sends a touch that may be a contact onset, with its impact speed in m/s if the stylus provides it. A touch is a
    /// contact onset if the previous one was lifted.
    ///
    /// # Errors
    /// As [`LiveInput::send`].
    pub fn land(&mut self, touch: Touch, time: Instant, landing_mps: Option<f32>) -> Result<(), Touch> {
        self.push(TimedTouch::new(touch, time, landing_mps))
    }

    /// Reports that the stylus is in proximity, above the position of `touch`. Live input takes over from now on if the
    /// controls permit it ([`crate::controls::Takeover`]).
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
