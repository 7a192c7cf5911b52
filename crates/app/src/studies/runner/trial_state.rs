//! A trial while it is on the screen.

use std::sync::Arc;
use std::time::Instant;

use shagreen_core::people::study::answer::{Measured, Response};
use shagreen_core::people::study::plan::Part;
use shagreen_core::people::study::touch::{Felt, is_passive, n_touched, untouched};
use shagreen_core::people::study::trial::{Shown, Task, Trial};
use shagreen_device::touch::Touch;

use super::draft::{Draft, Entry};
use super::loaded_stimuli::TrialStimuli;
use super::motion_meter::MotionMeter;
use super::presenter::{Presentation, Presenter};
use super::text_texture::TextTexture;
use crate::session::{PresentedTexture, Session};

/// A trial while it is on the screen.
pub(super) struct TrialState {
    pub(super) trial: Trial,
    pub(super) part: Part,
    /// Stimuli with their blind labels.
    pub(super) shown: Vec<Shown>,
    pub(super) presenter: Presenter,
    pub(super) draft: Draft,
    /// Text and texture of a question.
    pub(super) text: Option<TextTexture>,
    /// Entry of a list that the keyboard selects.
    pub(super) selected: usize,
    stimuli: TrialStimuli,
    motion: MotionMeter,
    /// Movement over each stimulus, over each side of a detection, or over the texture of a question, while it could be felt.
    over: Vec<MotionMeter>,
    /// First and last frame.
    frames: Option<(Instant, Instant)>,
}

impl TrialState {
    /// State before the first frame of a trial of this part.
    pub(super) fn new(trial: Trial, part: &Part, stimuli: TrialStimuli, text: Option<TextTexture>) -> Self {
        let shown = trial.task.shown();
        let presentation = match &trial.task {
            _ if is_passive(part) => Presentation::Succession,
            Task::Detect { .. } => Presentation::Alone,
            _ if shown.len() == 1 => Presentation::Alone,
            _ => Presentation::Free,
        };
        // Both sides of a detection are one surface.
        let n_stimuli = if matches!(trial.task, Task::Detect { .. }) { 1 } else { shown.len() };
        Self {
            presenter: Presenter::new(presentation, n_stimuli, part.timing, part.max_plays),
            draft: Draft::new(&trial.task, &part.design),
            part: part.clone(),
            shown,
            text,
            selected: 0,
            stimuli,
            motion: MotionMeter::default(),
            over: vec![MotionMeter::default(); n_touched(&trial.task)],
            frames: None,
            trial,
        }
    }

    /// Follows the time and the tip, once a frame.
    pub(super) fn follow(&mut self, touch: Touch, now: Instant) {
        let (first, last) = *self.frames.get_or_insert((now, now));
        let secs = now.duration_since(last).as_secs_f64();
        self.motion.add(touch, secs);
        self.frames = Some((first, now));
        self.presenter.follow(now.duration_since(first).as_secs_f64());
        let felt = self.felt_at(touch);
        if let Some(over) = felt.and_then(|index| self.over.get_mut(index)) {
            over.add(touch, secs);
        }
    }

    /// Time since the first frame, in s.
    pub(super) fn now_secs(&self) -> f64 {
        self.frames.map_or(0.0, |(first, last)| last.duration_since(first).as_secs_f64())
    }

    /// Whether this is the first frame, in which the first field takes the keyboard focus.
    pub(super) fn is_first_frame(&self) -> bool {
        self.frames.is_some_and(|(first, last)| first == last)
    }

    /// Stimulus that is audible at this place of the tip.
    pub(super) fn audible(&self, touch: Touch) -> Option<&Arc<PresentedTexture>> {
        self.stimuli.textures.get(self.felt_at(touch)?)
    }

    /// Index of what the tip would feel at this place: a stimulus, a side of a detection, or the texture of a question.
    fn felt_at(&self, touch: Touch) -> Option<usize> {
        if let Some(text) = &self.text {
            return text.authored().map(|_| 0);
        }
        let playing = self.presenter.audible(self.now_secs())?;
        // The left half of the surface is the first side.
        Some(if self.is_detection() { usize::from(touch.x_m >= 0.0) } else { playing })
    }

    /// Indices of what the participant still has to touch before the answer, in the order of the screen.
    pub(super) fn untouched(&self) -> Vec<usize> {
        let can_be_felt = |index: usize| match &self.text {
            Some(text) => text.authored().is_some(),
            None => self.presenter.can_be_felt(if self.is_detection() { 0 } else { index }),
        };
        let over = self.over.iter().enumerate();
        let felt: Vec<Felt> = over
            .map(|(index, over)| Felt { distance_m: over.distance_m(), can_be_felt: can_be_felt(index) })
            .collect();
        untouched(&self.part, &felt)
    }

    /// Whether the two sides of the surface differ.
    pub(super) fn is_detection(&self) -> bool {
        matches!(self.trial.task, Task::Detect { .. })
    }

    /// Takes a value, as soon as everything was presented where it is the whole answer.
    pub(super) fn enter(&mut self, entry: Entry) {
        if !self.draft.is_single_choice() || self.can_answer() {
            self.draft.enter(entry);
        }
    }

    /// Whether the participant can answer: everything was presented and touched, and the texture of a question is made.
    pub(super) fn can_answer(&self) -> bool {
        let has_texture = self.text.as_ref().is_none_or(|text| text.authored().is_some());
        has_texture && self.presenter.has_presented_all() && self.untouched().is_empty()
    }

    /// The response, once all values are entered and the participant can answer.
    pub(super) fn response(&self) -> Option<Response> {
        let text = self.text.as_ref().map_or("", TextTexture::text);
        self.draft.response(text.trim()).filter(|_| self.can_answer())
    }

    /// What was measured until now.
    pub(super) fn measured(&self, session: &Session) -> Measured {
        let response_secs = self.now_secs() - self.presenter.counts_from_secs();
        let latency = session.status().map(|status| status.latency).filter(|latency| latency.n_touches > 0);
        let n_plays = self.presenter.n_plays();
        Measured {
            response_secs: Some(response_secs.max(0.0)),
            motion: self.motion.motion(),
            touched_m: self.over.iter().map(|over| over.distance_m()).collect(),
            latency_secs: latency.map(|latency| f64::from(latency.stroke_secs)),
            device: session.rig().actuator().map_or_else(String::new, |actuator| actuator.id.clone()),
            stimulus_hashes: self.stimuli.hashes.clone(),
            // Both sides of a detection are presented together.
            n_plays: if n_plays.len() == 1 {
                vec![n_plays[0]; self.stimuli.hashes.len().max(1)]
            } else {
                n_plays.to_vec()
            },
        }
    }
}
