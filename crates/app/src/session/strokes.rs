//! Stroke recordings, and the automatic stroke that repeats them.

use std::sync::Arc;

use shagreen_device::controls::Input;
use shagreen_device::track::PenSample;

use super::Session;
use crate::state::mouse_report::MouseReport;
use crate::state::recorded_stroke::RecordedStroke;
use crate::state::recorder::{LONGEST_SECS, Recorder};
use crate::strings::stroke as strings;

impl Session {
    /// Whether the automatic stroke is running.
    pub fn hand_is_running(&self) -> bool {
        self.hand.automatic.is_some()
    }

    /// Starts, changes or stops the automatic stroke.
    pub fn set_hand(&mut self, hand: Option<Input>) {
        if self.hand.automatic != hand {
            self.hand.automatic = hand;
            self.sound.player.set_hand(hand, self.hand.stroke.as_ref());
        }
    }

    /// Stroke recording that the automatic stroke can repeat.
    pub fn stroke(&self) -> Option<&RecordedStroke> {
        self.hand.stroke.as_deref()
    }

    /// Number of stroke recordings so far; it changes with the present recording.
    pub fn n_strokes(&self) -> u64 {
        self.hand.n_strokes
    }

    /// Replaces the stroke recording and returns whether there was one. An automatic stroke that repeats it restarts.
    pub fn set_stroke(&mut self, stroke: RecordedStroke) -> bool {
        self.hand.n_strokes += 1;
        self.hand.stroke.replace(Arc::new(stroke)).is_some()
    }

    /// Starts a recording and stops the automatic stroke.
    pub fn begin_recording(&mut self) {
        self.set_hand(None);
        // Messages about the previous recording are obsolete.
        let full = strings::full(LONGEST_SECS);
        self.said.take_if(|said| said.text.starts_with(&full) || said.text == strings::REPLACED);
        self.hand.recorder = Some(Recorder::new());
    }

    /// Finishes the recording. Without a touch, the previous recording is kept.
    pub fn end_recording(&mut self) {
        let is_full = self.hand.recorder.as_ref().is_some_and(Recorder::is_full);
        let outcome = match self.hand.recorder.take().and_then(Recorder::finish).map(RecordedStroke::new) {
            Some(Ok(stroke)) => {
                let is_other_replaced = self.set_stroke(stroke);
                let outcome = if is_other_replaced { strings::REPLACED } else { strings::KEPT };
                // An expected outcome needs no message.
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

    /// Finishes the recording after a click on the button. If a pen clicked, its tap on the button is removed from the
    /// stroke.
    pub fn end_recording_by_pointer(&mut self) {
        if let Some(recorder) = &mut self.hand.recorder {
            recorder.drop_tap();
        }
        self.end_recording();
    }

    /// Samples of the recording in progress and its duration in seconds, which is `None` before the first touch. `None`
    /// if nothing is being recorded.
    pub fn recording(&self) -> Option<(&[PenSample], Option<f64>)> {
        self.hand.recorder.as_ref().map(|recorder| (recorder.samples(), recorder.secs()))
    }

    /// Adds a mouse report to the recording, if one is in progress.
    pub(super) fn record_mouse(&mut self, report: MouseReport, force_n: f64) {
        if let Some(recorder) = &mut self.hand.recorder {
            let MouseReport { x_m, y_m, pressed, .. } = report;
            let force_n = if pressed { force_n } else { 0.0 };
            let sample = PenSample { x_m, y_m, force_n, touching: pressed, ..PenSample::default() };
            recorder.take_mouse(sample);
        }
    }

    /// Adds pen samples to the recording and sends the stroke recording to an output that needs it, once a frame.
    pub(super) fn follow_strokes(&mut self) {
        if let Some(recorder) = &mut self.hand.recorder {
            recorder.take_pen(&self.hand.pen.fresh);
            if recorder.is_full() {
                self.end_recording();
            }
        }
        let stroke = self.hand.stroke.as_ref();
        if matches!(self.hand.automatic, Some(Input::Repeat(_))) && !self.sound.player.has_stroke(stroke) {
            self.sound.player.set_hand(self.hand.automatic, stroke);
        }
    }
}
