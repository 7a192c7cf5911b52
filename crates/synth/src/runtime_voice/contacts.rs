//! The contact of a tip in frames, for the gate after lift-off.

use crate::lift_gate::Touching;

/// Last contact so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Contacts {
    /// Whether the tip touched in the last tick.
    is_touching: bool,
    /// Frames of the last onset and of the last contact.
    span: Option<(u64, u64)>,
}

impl Contacts {
    /// Notes a tick between two frames.
    pub(super) fn note_tick(&mut self, is_touching: bool, from: f64, to: f64) {
        if is_touching {
            self.note_frames(libm::round(from) as u64, libm::round(to) as u64);
        }
        self.is_touching = is_touching;
    }

    /// Notes a contact between two frames; they are equal for a tap between two ticks.
    pub(super) fn note_frames(&mut self, from: u64, to: u64) {
        let (landed, touched) = self.span.unwrap_or((from, to));
        let landed = if self.is_touching { landed.min(from) } else { from };
        self.span = Some((landed, touched.max(to)));
    }

    /// Last contact of the tip.
    pub(super) fn touching(&self) -> Touching {
        self.span.map_or(Touching::Never, |(landed, touched)| Touching::Span { landed, touched })
    }
}
