//! A running session: the trials of one participant, with each answer on the disk before the next trial.
//!
//! The steps are those of `core::people::study::progress`. If an answer cannot be saved, for example because the disk is full,
//! the session keeps it, stays at its trial, and [`StudySession::retry`] saves it later.

mod begin;
mod error;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

use shagreen_core::people::study::answer::{Answer, Event, Measured, Response, check, is_right};
use shagreen_core::people::study::plan::{Part, Plan};
use shagreen_core::people::study::progress::{Place, Progress, Step};
use shagreen_core::people::study::setup::Setup;
use shagreen_core::people::study::trial::Task;
use shagreen_formats::study_log::{LogHeader, StudyLog, TimedEvent};

use crate::study::program;

pub use begin::{LogPlace, NewSession};
pub use error::SessionError;

/// A session of one participant. Its log is locked until this is dropped.
#[derive(Debug)]
pub struct StudySession {
    plan: Arc<Plan>,
    participant: String,
    number: usize,
    is_simulated: bool,
    /// `None` if the session is only for practice.
    log: Option<StudyLog>,
    progress: Progress,
    /// Further parts of a session that is only for practice, the next one last.
    further_practice: Vec<Progress>,
    n_answered: usize,
    has_ended: bool,
    /// Devices that the log states, since this session began or went on.
    setup: Option<Setup>,
    /// Event that could not be saved.
    unsaved: Option<TimedEvent>,
    warnings: Vec<String>,
}

/// Number of answered trials and of all trials of a session, practice included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SessionCounts {
    /// Number of answered trials.
    pub n_answered: usize,
    /// Number of trials; `None` if the plan has staircases, whose number depends on the answers.
    pub n_trials: Option<usize>,
}

impl StudySession {
    fn of(header: &LogHeader, log: Option<StudyLog>, progress: Progress) -> Self {
        Self {
            plan: Arc::clone(progress.plan()),
            participant: header.participant().to_owned(),
            number: header.number(),
            is_simulated: header.is_simulated(),
            log,
            progress,
            further_practice: Vec::new(),
            n_answered: 0,
            has_ended: false,
            setup: None,
            unsaved: None,
            warnings: Vec::new(),
        }
    }

    /// The plan of the session.
    pub fn plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// Pseudonym of the participant.
    pub fn participant(&self) -> &str {
        &self.participant
    }

    /// Number of the participant, from 1.
    pub fn number(&self) -> usize {
        self.number
    }

    /// Whether the participant is simulated.
    pub fn is_simulated(&self) -> bool {
        self.is_simulated
    }

    /// Whether the session has practice trials only, and saves nothing.
    pub fn is_practice(&self) -> bool {
        self.log.is_none()
    }

    /// Path of the log; `None` for a session that is only for practice.
    pub fn log_path(&self) -> Option<PathBuf> {
        self.log.as_ref().map(|log| log.path().to_owned())
    }

    /// Sentences for the experimenter about a resumed log: torn and damaged lines, missing answers.
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// What comes next.
    pub fn step(&self) -> Step {
        match self.progress.step() {
            Step::Trial(trial) if self.is_practice() && !trial.is_practice => Step::Done,
            step => step,
        }
    }

    /// Where the next trial is; `None` if all are answered. [`StudySession::next_part`] is its part.
    pub fn place(&self) -> Option<Place> {
        self.progress.place()
    }

    /// Part of the next trial; `None` if all are answered.
    pub fn next_part(&self) -> Option<&Part> {
        self.progress.plan().parts.get(self.place()?.part)
    }

    /// Number of answered trials, and of all.
    pub fn counts(&self) -> SessionCounts {
        let of_part = |part: &Part| {
            let n_scored = if self.is_practice() { Some(0) } else { part.design.n_trials() };
            n_scored.map(|n| n * part.n_repeats + part.n_practice)
        };
        SessionCounts { n_answered: self.n_answered, n_trials: self.plan.parts.iter().map(of_part).sum() }
    }

    /// Whether an event is not saved yet; see [`StudySession::retry`].
    pub fn has_unsaved(&self) -> bool {
        self.unsaved.is_some()
    }

    /// The participant agrees to the consent text.
    ///
    /// # Errors
    /// [`SessionError::Log`] if this cannot be saved, [`SessionError::Unsaved`].
    pub fn consent(&mut self) -> Result<(), SessionError> {
        self.keep(Event::Consented).map(|_| ())
    }

    /// The participant does not agree to the consent text. The session is over: nothing else is stored.
    ///
    /// # Errors
    /// As [`StudySession::consent`]; [`SessionError::NoConsent`] if the session does not ask for it.
    pub fn refuse(&mut self) -> Result<(), SessionError> {
        if self.step() != Step::Consent {
            return Err(SessionError::NoConsent);
        }
        self.keep(Event::Refused).map(|_| ())
    }

    /// Whether the participant did not agree to the consent text.
    pub fn has_refused(&self) -> bool {
        self.progress.has_refused()
    }

    /// Notes the devices in the log, if they differ from those that it states. Call it before the first step, and again whenever
    /// the devices may have changed: equal ones cost a comparison. [`Setup::program`] is filled in here. Nothing is noted in a
    /// session that is only for practice or is over, nor while an event is not saved.
    ///
    /// # Errors
    /// As [`StudySession::consent`].
    pub fn set_up(&mut self, setup: &Setup) -> Result<(), SessionError> {
        let setup = Setup { program: program(), ..setup.clone() };
        let is_noted = self.setup.as_ref() == Some(&setup);
        if is_noted || self.is_practice() || self.has_unsaved() || self.step() == Step::Done {
            return Ok(());
        }
        self.keep(Event::SetUp(Box::new(setup))).map(|_| ())
    }

    /// The participant ends a break.
    ///
    /// # Errors
    /// As [`StudySession::consent`].
    pub fn rest(&mut self) -> Result<(), SessionError> {
        self.keep(Event::Rested).map(|_| ())
    }

    /// Takes the response to the trial of the present step, and returns when it is on the disk: whether it was right, if the
    /// participant is to learn this. A response without the touch that its part requires is taken, because only the window knows
    /// what can still be felt ([`shagreen_core::people::study::touch`]); the analysis counts it.
    ///
    /// # Errors
    /// [`SessionError::Response`] and [`SessionError::NoTrial`] leave everything as it was. With [`SessionError::Log`], the
    /// session keeps the answer and stays at its trial.
    pub fn answer(&mut self, response: Response, measured: Measured) -> Result<Option<bool>, SessionError> {
        if self.unsaved.is_some() {
            return Err(SessionError::Unsaved);
        }
        let (Step::Trial(trial), Some(part)) = (self.step(), self.next_part()) else {
            return Err(SessionError::NoTrial);
        };
        check(&response, &trial.task, &part.design)?;
        self.keep(Event::Answered(Box::new(Answer { trial, response, measured })))
    }

    /// Notes that the session is over, once; it can also be left without.
    ///
    /// # Errors
    /// As [`StudySession::consent`]. All answers are saved already.
    pub fn end(&mut self) -> Result<(), SessionError> {
        if self.has_ended || self.has_refused() || self.step() != Step::Done {
            return Ok(());
        }
        self.keep(Event::Ended).map(|_| ())
    }

    /// Saves the event that could not be saved, and goes on after it; does nothing if there is none. Returns what
    /// [`StudySession::answer`] returns.
    ///
    /// # Errors
    /// [`SessionError::Log`] if it still cannot be saved.
    pub fn retry(&mut self) -> Result<Option<bool>, SessionError> {
        let Some(timed) = &self.unsaved else { return Ok(None) };
        if let Some(log) = &mut self.log {
            log.append(timed)?;
        }
        match self.unsaved.take() {
            Some(timed) => self.go_on_after(timed.event),
            None => Ok(None),
        }
    }

    /// Saves an event and goes on after it.
    fn keep(&mut self, event: Event) -> Result<Option<bool>, SessionError> {
        if self.unsaved.is_some() {
            return Err(SessionError::Unsaved);
        }
        self.unsaved = Some(TimedEvent { unix_secs: unix_secs(), event });
        self.retry()
    }

    fn go_on_after(&mut self, event: Event) -> Result<Option<bool>, SessionError> {
        match event {
            Event::SetUp(setup) => self.setup = Some(*setup),
            Event::Consented => self.progress.consent(),
            Event::Refused => self.progress.refuse(),
            Event::Rested => self.progress.rest(),
            Event::Answered(answer) => {
                self.progress.answer(&answer.trial, &answer.response)?;
                self.n_answered += 1;
                self.go_to_next_practice();
                return Ok(feedback(&answer));
            }
            Event::Resumed => {}
            Event::Ended => self.has_ended = true,
        }
        Ok(None)
    }

    /// In a session that is only for practice, leaves a part whose practice is over.
    fn go_to_next_practice(&mut self) {
        if self.is_practice()
            && self.step() == Step::Done
            && let Some(next) = self.further_practice.pop()
        {
            self.progress = next;
        }
    }
}

/// Whether an answer is right, if the participant is to learn it.
fn feedback(answer: &Answer) -> Option<bool> {
    match answer.trial.task {
        Task::Detect { has_feedback: true, .. } => is_right(&answer.trial.task, &answer.response),
        _ => None,
    }
}

/// Time in s since 1970.
fn unix_secs() -> f64 {
    // A clock before 1970 is wrong in any case.
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0.0, |time| time.as_secs_f64())
}

#[cfg(test)]
mod tests;
