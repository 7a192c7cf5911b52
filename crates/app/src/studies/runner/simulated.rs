//! Simulated participant who answers the trials in the window, instead of a person. It does what a person does: it starts each
//! stimulus, moves the tip over it until it is felt, enters its values one by one and answers.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

use egui::Context;
use shagreen_core::people::study::answer::Response;
use shagreen_core::people::study::plan::Plan;
use shagreen_core::people::study::simulated::{Observers, SimulatedParticipant};
use shagreen_core::people::study::trial::Trial;
use shagreen_studio::study::simulation::Simulation;

use super::actions::Action;
use super::draft::{Entry, entries_of};
use super::trial_state::TrialState;
use crate::strings::studies as strings;

/// A simulated participant on a thread of its own, which keeps its habits between trials.
pub(super) struct Simulated {
    trials: Sender<Trial>,
    responses: Receiver<Result<Response, String>>,
    /// Trial that is being answered, by its part and number.
    asked: Option<(String, usize)>,
    /// Values that are not entered yet.
    entries: VecDeque<Entry>,
    /// Text of a question, until it is written.
    text: Option<String>,
    /// Whether the response to the trial has come.
    has_response: bool,
    failure: Option<String>,
}

impl Simulated {
    /// Participant with this number and seed, who has answered these trials already. The answers are those of
    /// [`shagreen_core::people::study::simulated::simulated_session`], whether the session was interrupted or not.
    pub(super) fn begin(
        plan: Arc<Plan>,
        number: usize,
        seed: u64,
        answered: Vec<Trial>,
        ctx: Context,
    ) -> Self {
        let (trials, incoming) = channel::<Trial>();
        let (outgoing, responses) = channel();
        std::thread::spawn(move || {
            let world = Simulation::usual(1, seed).world(&plan);
            let mut participant =
                match SimulatedParticipant::new(&plan, &world, Observers::usual(), number, seed) {
                    Ok(participant) => participant,
                    Err(error) => {
                        // If the window has closed meanwhile, nobody receives the reason.
                        let _ = outgoing.send(Err(error.to_string()));
                        return;
                    }
                };
            for trial in answered {
                participant.answer(trial);
            }
            while let Ok(trial) = incoming.recv() {
                if outgoing.send(Ok(participant.answer(trial).response)).is_err() {
                    return;
                }
                ctx.request_repaint();
            }
        });
        Self {
            trials,
            responses,
            asked: None,
            entries: VecDeque::new(),
            text: None,
            has_response: false,
            failure: None,
        }
    }

    /// Why the participant cannot answer.
    pub(super) fn failure(&self) -> Option<&str> {
        self.failure.as_deref()
    }

    /// What the participant does next in a trial.
    pub(super) fn act(&mut self, state: &TrialState, is_stroking: bool) -> Option<Action> {
        self.follow(&state.trial);
        if !is_stroking && !state.presenter.is_passive() {
            return Some(Action::ToggleStroke);
        }
        let untouched = state.untouched();
        let is_felt_now = |playing: usize| state.is_detection() || untouched.contains(&playing);
        if state.presenter.playing().is_some_and(|playing| is_felt_now(playing) && !untouched.is_empty()) {
            // The tip moves over it.
            return None;
        }
        if let Some(next) = state.presenter.not_started().first().or(untouched.first()) {
            if state.presenter.can_repeat() {
                return Some(Action::Repeat);
            }
            let can_start = state.presenter.can_start(*next, state.now_secs());
            return can_start.then_some(Action::Play(*next));
        }
        if !self.has_response {
            return None;
        }
        if let Some(texture) = state.text.as_ref().filter(|texture| texture.is_writing()) {
            if let Some(text) = self.text.take().filter(|text| text != texture.text()) {
                return Some(Action::Write(text));
            }
            return texture.failure().is_none().then_some(Action::Describe);
        }
        if !state.can_answer() {
            return None;
        }
        match self.entries.pop_front() {
            Some(entry) => Some(Action::Enter(entry)),
            None => state.response().map(|_| Action::Answer),
        }
    }

    /// Asks for the response to a new trial, and takes it in.
    fn follow(&mut self, trial: &Trial) {
        let this = (trial.part.clone(), trial.number);
        if self.asked.as_ref() != Some(&this) {
            self.asked = Some(this);
            (self.has_response, self.text) = (false, None);
            self.entries.clear();
            if self.trials.send(trial.clone()).is_err() && self.failure.is_none() {
                self.failure = Some(strings::SIMULATION_FAILED.to_owned());
            }
        }
        match self.responses.try_recv() {
            Ok(Ok(response)) => {
                self.entries = entries_of(&response).into();
                if let Response::Grades { prompt, .. } = response {
                    self.text = Some(prompt);
                }
                self.has_response = true;
            }
            Ok(Err(reason)) => self.failure = Some(reason),
            Err(TryRecvError::Empty | TryRecvError::Disconnected) => {}
        }
    }
}
