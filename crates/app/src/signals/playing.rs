//! Tracks which signal is being played at its own speed, as far as the output reports it.

use crate::choices::signals::Slot;

/// Number of frames within which an output reports that it plays a signal.
const PATIENCE_FRAMES: u32 = 60;

/// Signal that is played at its own speed.
#[derive(Clone, Copy)]
pub(super) struct Playing {
    slot: Slot,
    /// Whether the output has reported it.
    was_seen: bool,
    /// Number of frames left for that report.
    frames_left: u32,
}

impl Playing {
    /// Signal that was just sent to the output.
    pub(super) fn new(slot: Slot) -> Self {
        Self { slot, was_seen: false, frames_left: PATIENCE_FRAMES }
    }

    pub(super) fn slot(self) -> Slot {
        self.slot
    }

    /// State one frame later; `None` once playing has ended. An output reports a signal one block after the request.
    pub(super) fn followed(self, plays_signal: bool) -> Option<Self> {
        let was_seen = self.was_seen || plays_signal;
        let frames_left = self.frames_left.saturating_sub(1);
        let is_over = !plays_signal && (was_seen || frames_left == 0);
        (!is_over).then_some(Self { was_seen, frames_left, ..self })
    }
}
