//! Which signal is played as it was recorded, as far as the output tells.

use super::slot::Slot;

/// Frames in which an output says that it plays, or never will.
const PATIENCE_FRAMES: u32 = 60;

/// A signal that is played as it was recorded.
#[derive(Clone, Copy)]
pub(super) struct Playing {
    slot: Slot,
    /// Whether the output said so.
    was_seen: bool,
    /// How long it may take to.
    frames_left: u32,
}

impl Playing {
    /// A signal that is on its way to the output.
    pub(super) fn new(slot: Slot) -> Self {
        Self { slot, was_seen: false, frames_left: PATIENCE_FRAMES }
    }

    /// Which signal it is.
    pub(super) fn slot(self) -> Slot {
        self.slot
    }

    /// A frame later; `None` once it is over. An output tells that it plays a block later than it was asked.
    pub(super) fn followed(self, plays_signal: bool) -> Option<Self> {
        let was_seen = self.was_seen || plays_signal;
        let frames_left = self.frames_left.saturating_sub(1);
        let is_over = !plays_signal && (was_seen || frames_left == 0);
        (!is_over).then_some(Self { was_seen, frames_left, ..self })
    }
}
