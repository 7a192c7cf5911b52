//! Strokes that are recorded on the pad, and the automatic hand that repeats them.

use std::sync::Arc;

use shagreen_device::controls::Input;
use shagreen_device::track::PenSample;

use super::Session;
use crate::pad::MouseReport;
use crate::recorded_stroke::RecordedStroke;
use crate::recorder::{LONGEST_SECS, Recorder};
use crate::strings::stroke as strings;

impl Session {
    /// Whether the automatic hand strokes.
    pub fn hand_is_running(&self) -> bool {
        self.hand.is_some()
    }

    /// Starts, changes or stops the automatic hand.
    pub fn set_hand(&mut self, hand: Option<Input>) {
        if self.hand != hand {
            self.hand = hand;
            self.player.set_hand(hand, self.stroke.as_ref());
        }
    }

    /// The stroke that the hand can repeat.
    pub fn stroke(&self) -> Option<&RecordedStroke> {
        self.stroke.as_deref()
    }

    /// How many strokes there were: it changes with the stroke.
    pub fn n_strokes(&self) -> u64 {
        self.n_strokes
    }

    /// Takes a stroke in the place of the one before, and returns whether there was one; a hand that repeats begins it anew.
    pub fn set_stroke(&mut self, stroke: RecordedStroke) -> bool {
        self.n_strokes += 1;
        self.stroke.replace(Arc::new(stroke)).is_some()
    }

    /// Begins a recording; the hand does not stroke meanwhile.
    pub fn begin_recording(&mut self) {
        self.set_hand(None);
        // What was said of the recording before is over.
        let full = strings::full(LONGEST_SECS);
        self.player.message.take_if(|message| message.starts_with(&full) || *message == strings::REPLACED);
        self.recorder = Some(Recorder::new());
    }

    /// Ends the recording; where nothing has touched, the stroke before it stays.
    pub fn end_recording(&mut self) {
        let is_full = self.recorder.as_ref().is_some_and(Recorder::is_full);
        let outcome = match self.recorder.take().and_then(Recorder::finish).map(RecordedStroke::new) {
            Some(Ok(stroke)) => {
                let is_other_replaced = self.set_stroke(stroke);
                let outcome = if is_other_replaced { strings::REPLACED } else { strings::KEPT };
                // What was to be expected is not said.
                (is_full || is_other_replaced).then(|| outcome.to_owned())
            }
            Some(Err(error)) => Some(error.to_string()),
            None => None,
        };
        let full = is_full.then(|| strings::full(LONGEST_SECS));
        let notes: Vec<String> = full.into_iter().chain(outcome).collect();
        if !notes.is_empty() {
            self.say(notes.join("; "));
        }
    }

    /// The same where the pointer has pressed a button for it: a pen's tap on that is no part of the stroke.
    pub fn end_recording_by_pointer(&mut self) {
        if let Some(recorder) = &mut self.recorder {
            recorder.drop_tap();
        }
        self.end_recording();
    }

    /// What is recorded at the moment and how long it is in seconds, none before the first touch; `None` where nothing is
    /// being recorded.
    pub fn recording(&self) -> Option<(&[PenSample], Option<f64>)> {
        self.recorder.as_ref().map(|recorder| (recorder.samples(), recorder.secs()))
    }

    /// Records what the mouse does, where something is being recorded.
    pub(super) fn record_mouse(&mut self, report: MouseReport, force_n: f64) {
        if let Some(recorder) = &mut self.recorder {
            let MouseReport { x_m, y_m, pressed, .. } = report;
            let force_n = if pressed { force_n } else { 0.0 };
            recorder.take_mouse(PenSample { time_secs: 0.0, x_m, y_m, force_n, touching: pressed });
        }
    }

    /// Once a frame: records what the pen has done, and gives the stroke to an output that does not have it.
    pub(super) fn follow_strokes(&mut self) {
        if let Some(recorder) = &mut self.recorder {
            recorder.take_pen(&self.pen.fresh);
            if recorder.is_full() {
                self.end_recording();
            }
        }
        let stroke = self.stroke.as_ref();
        if matches!(self.hand, Some(Input::Repeat(_))) && !self.player.has_stroke(stroke) {
            self.player.set_hand(self.hand, stroke);
        }
    }
}
