//! Touches of a block as a motion over time.

use super::Touch;
use super::contacts::Contacts;
use crate::contact::{Contact, ContactSource, Place};
use crate::stream::REQUEST_SECS;

/// Touches of a block, evenly spaced up to its last frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stroke<'a, T> {
    /// Last touch of the block before.
    before: Touch,
    touches: &'a [T],
    /// Frame of the touch before.
    begin_frame: f64,
    /// Touches in a frame.
    per_frame: f64,
}

impl<'a, T: Copy + Into<Touch>> Stroke<'a, T> {
    /// The motion in a block that begins at a frame.
    pub(super) fn new(before: Touch, touches: &'a [T], first_frame: u64, n_frames: usize) -> Self {
        let per_frame = touches.len() as f64 / n_frames.max(1) as f64;
        Self { before, touches, begin_frame: first_frame as f64 - 1.0, per_frame }
    }

    /// The touch at a frame, which is held at the ends of the block.
    pub(super) fn at(&self, frame: f64) -> Touch {
        let n = self.touches.len();
        let place = ((frame - self.begin_frame) * self.per_frame).clamp(0.0, n as f64);
        let index = (place as usize).min(n.saturating_sub(1));
        let touch = |index: Option<usize>| {
            let touch = index.and_then(|index| self.touches.get(index));
            touch.map_or(self.before, |touch| (*touch).into())
        };
        let (from, to) = (touch(index.checked_sub(1)), touch(Some(index)));
        if from.contact.sanitized().force_n == 0.0 {
            return to;
        }
        let share = place - index as f64;
        let between = |from: f64, to: f64| from + share * (to - from);
        let narrow = |from: f32, to: f32| from + share as f32 * (to - from);
        Touch {
            x_m: between(from.x_m, to.x_m),
            y_m: between(from.y_m, to.y_m),
            contact: Contact {
                speed_mps: narrow(from.contact.speed_mps, to.contact.speed_mps),
                force_n: narrow(from.contact.force_n, to.contact.force_n),
            },
        }
    }
}

/// Source of the contacts of a block.
pub(super) struct Follow<'a, T> {
    stroke: &'a Stroke<'a, T>,
    rate_hz: f64,
    tick_frames: f64,
    contacts: &'a mut Contacts,
    place: Place,
}

impl<'a, T> Follow<'a, T> {
    /// A source at a sample rate in Hz, with this number of frames in a tick.
    pub(super) fn new(
        stroke: &'a Stroke<'a, T>,
        (rate_hz, tick_frames): (f64, f64),
        contacts: &'a mut Contacts,
    ) -> Self {
        Self { stroke, rate_hz, tick_frames, contacts, place: Place::default() }
    }
}

impl<T: Copy + Into<Touch>> ContactSource for Follow<'_, T> {
    /// Returns the contact at the begin of the tick that ends at this time: the touches reach no further.
    fn contact_at(&mut self, time_secs: f64) -> Contact {
        let end_frame = time_secs * self.rate_hz;
        let begin_frame = end_frame - self.tick_frames;
        let touch = self.stroke.at(begin_frame);
        self.place = Place { x_m: touch.x_m, y_m: touch.y_m, n_jumps: 0 };
        let contact = touch.contact.sanitized();
        // The level rises from zero within the tick.
        let from_frame = begin_frame + REQUEST_SECS * self.rate_hz;
        self.contacts.note_tick(contact.force_n > 0.0, from_frame, end_frame);
        contact
    }

    fn place(&self) -> Place {
        self.place
    }
}
