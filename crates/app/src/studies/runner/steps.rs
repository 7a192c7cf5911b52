//! From one step of a session to the next: what actions do, and what comes on the screen after them.

use std::time::{Duration, Instant};

use egui::Context;
use shagreen_core::maths::rng::derive_seed;
use shagreen_core::people::study::plan::{Condition, Design, Part, Prompts as PromptsOfPlan, ShownControls};
use shagreen_core::people::study::progress::Step;
use shagreen_core::people::study::trial::{Task, Trial};
use shagreen_studio::study::session::SessionError;

use super::actions::Action;
use super::text_texture::TextTexture;
use super::trial_state::TrialState;
use super::{Runner, RunnerInput, Screen, Unsaved};

/// Time for which the participant sees whether an answer was right, in s.
const FEEDBACK_SECS: f64 = 1.2;

impl Runner {
    /// Carries out an action of the participant.
    pub(super) fn carry_out(&mut self, action: Action, input: &RunnerInput<'_>, ctx: &Context) {
        match action {
            Action::AskToLeave => self.ask_to_leave(),
            Action::Stay => self.is_asked_to_leave = false,
            Action::Leave => self.has_left = true,
            // Below a question, nothing changes.
            _ if self.is_asked_to_leave => {}
            Action::TryAgain => self.try_again(),
            _ if self.unsaved.is_some() => {}
            Action::GoOn => self.end_screen(),
            Action::Refuse => {
                if matches!(self.screen, Screen::Consent) {
                    let refused = self.session.refuse();
                    self.take(refused.map(|()| None));
                }
            }
            Action::ToggleStroke => self.is_stroking ^= true,
            Action::Answer => self.answer(input),
            other => self.carry_out_in_trial(other, input, ctx),
        }
    }

    /// Carries out an action about the trial on the screen.
    fn carry_out_in_trial(&mut self, action: Action, input: &RunnerInput<'_>, ctx: &Context) {
        let Screen::Trial(state) = &mut self.screen else { return };
        self.problem = None;
        let now_secs = state.now_secs();
        match action {
            Action::Play(stimulus) => {
                state.selected = stimulus;
                state.presenter.toggle(stimulus, now_secs);
            }
            Action::Repeat => state.presenter.repeat(now_secs),
            Action::Select(entry) => state.selected = entry,
            Action::Enter(entry) => {
                state.enter(entry);
                if state.draft.is_single_choice() {
                    self.answer(input);
                }
            }
            Action::Write(text) => {
                if let Some(texture) = &mut state.text {
                    texture.write(text);
                }
            }
            Action::Describe => self.describe(input, ctx),
            Action::Move(axis, value) => {
                if let Some(texture) = &mut state.text {
                    texture.go_to(axis, value);
                }
            }
            Action::GoOn
            | Action::Refuse
            | Action::ToggleStroke
            | Action::Answer
            | Action::TryAgain
            | Action::AskToLeave
            | Action::Leave
            | Action::Stay => {}
        }
    }

    /// Ends a page of text.
    fn end_screen(&mut self) {
        match &self.screen {
            Screen::Consent => {
                let consented = self.session.consent();
                self.take(consented.map(|()| None));
            }
            Screen::Break => {
                let rested = self.session.rest();
                self.take(rested.map(|()| None));
            }
            Screen::Instructions => {
                self.read = self.session.next_part().map(|part| (part.id.clone(), false));
                self.go_on();
            }
            Screen::PracticeOver => {
                self.read = self.session.next_part().map(|part| (part.id.clone(), true));
                self.go_on();
            }
            Screen::Trial(_) | Screen::Pause { .. } | Screen::Done | Screen::Refused | Screen::Broken(_) => {}
        }
    }

    /// Saves once more what could not be saved.
    fn try_again(&mut self) {
        let retried = self.session.retry();
        if retried.is_ok() && self.unsaved.take_if(|unsaved| unsaved.is_setup).is_some() {
            return;
        }
        self.take(retried);
    }

    /// Answers the trial on the screen, if everything is entered.
    fn answer(&mut self, input: &RunnerInput<'_>) {
        let Screen::Trial(state) = &self.screen else { return };
        let Some(response) = state.response() else { return };
        let answered = self.session.answer(response, state.measured(input.session));
        self.take(answered);
    }

    /// Goes on after an event is saved, or says why it is not.
    fn take(&mut self, saved: Result<Option<bool>, SessionError>) {
        match saved {
            Ok(is_right) => {
                (self.unsaved, self.problem) = (None, None);
                self.pause(is_right);
            }
            Err(error @ (SessionError::Log(_) | SessionError::Unsaved)) => {
                let is_setup = self.unsaved.as_ref().is_some_and(|unsaved| unsaved.is_setup);
                self.unsaved = Some(Unsaved { reason: error.to_string(), is_setup });
            }
            Err(error) => self.problem = Some(error.to_string()),
        }
    }

    /// Waits until the next step, as long as the plan says after an answer.
    fn pause(&mut self, is_right: Option<bool>) {
        let Screen::Trial(state) = &self.screen else { return self.go_on() };
        let part = self.session.plan().part(&state.trial.part);
        let pause_secs = part.map_or(0.0, |part| part.timing.pause_secs);
        let secs = if is_right.is_some() { pause_secs.max(FEEDBACK_SECS) } else { pause_secs };
        if secs > 0.0 {
            let until = Instant::now() + Duration::from_secs_f64(secs);
            self.screen = Screen::Pause { until, is_right };
        } else {
            self.go_on();
        }
    }

    /// Shows the next step of the session.
    pub(super) fn go_on(&mut self) {
        self.screen = match self.session.step() {
            Step::Consent => Screen::Consent,
            Step::Break => Screen::Break,
            Step::Done if self.session.has_refused() => Screen::Refused,
            Step::Done => {
                if let Err(error) = self.session.end() {
                    self.unsaved = Some(Unsaved { reason: error.to_string(), is_setup: false });
                }
                Screen::Done
            }
            Step::Trial(trial) => self.before(trial),
        };
    }

    /// Screen before a trial, or the trial.
    fn before(&mut self, trial: Trial) -> Screen {
        let (Some(place), Some(part)) = (self.session.place(), self.session.next_part()) else {
            return Screen::Done;
        };
        let stimuli = match self.stimuli.of_trial(&trial) {
            Ok(stimuli) => stimuli,
            Err(reason) => return Screen::Broken(reason),
        };
        self.rate = stimuli.textures.first().map(|texture| texture.rate());
        match self.read.as_ref().filter(|(of, _)| *of == part.id) {
            None => Screen::Instructions,
            Some((_, false)) if place.is_after_practice => Screen::PracticeOver,
            Some(_) => {
                let text = self.text_of(&trial, part);
                Screen::Trial(Box::new(TrialState::new(trial, part, stimuli, text)))
            }
        }
    }

    /// Text of a question, if the trial is one.
    fn text_of(&self, trial: &Trial, part: &Part) -> Option<TextTexture> {
        let (Task::Question { prompt, condition }, Design::Likert { conditions, prompts, .. }) =
            (&trial.task, &part.design)
        else {
            return None;
        };
        let is_it = |of: &&Condition| of.id == *condition;
        let shown = conditions.iter().find(is_it).map_or(ShownControls::Nothing, |of| of.shown);
        let key = (trial.part.clone(), *prompt, trial.is_practice);
        let known = match prompts {
            PromptsOfPlan::Given(texts) => texts.get(*prompt).cloned(),
            PromptsOfPlan::Own(_) => self.texts.get(&key).cloned(),
        };
        Some(known.map_or_else(|| TextTexture::to_write(shown), |text| TextTexture::of_text(text, shown)))
    }

    /// Makes the texture of a text that is known already.
    pub(super) fn describe_known(&mut self, input: &RunnerInput<'_>, ctx: &Context) {
        let Screen::Trial(state) = &self.screen else { return };
        let Some(texture) = &state.text else { return };
        let key = text_key(&state.trial);
        let is_own = matches!(&state.part.design, Design::Likert { prompts: PromptsOfPlan::Own(_), .. });
        let is_known = !is_own || key.is_some_and(|key| self.texts.contains_key(&key));
        if is_known && texture.is_writing() && texture.failure().is_none() {
            self.describe(input, ctx);
        }
    }

    /// Makes the texture of the text on the screen, and keeps the text for the other conditions.
    fn describe(&mut self, input: &RunnerInput<'_>, ctx: &Context) {
        let seed = self.session.plan().seed;
        let Screen::Trial(state) = &mut self.screen else { return };
        let (Some(key), Some(texture)) = (text_key(&state.trial), &mut state.text) else { return };
        if texture.text().trim().is_empty() {
            return;
        }
        let seed = derive_seed(seed, &format!("picture of text {} of part {}", key.1, key.0));
        texture.describe(input.prompts, input.session, seed, ctx);
        self.texts.insert(key, texture.text().to_owned());
    }
}

/// Part and number of the text of a question, and whether it is for practice.
fn text_key(trial: &Trial) -> Option<(String, usize, bool)> {
    match &trial.task {
        Task::Question { prompt, .. } => Some((trial.part.clone(), *prompt, trial.is_practice)),
        _ => None,
    }
}
