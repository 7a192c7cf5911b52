//! Sessions of the open study, from their logs.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::Context;
use shagreen_core::people::study::answer::Event;
use shagreen_core::people::study::plan::Plan;
use shagreen_studio::file::{one_line, shown_name};
use shagreen_studio::study::logs::{ListedLog, list_logs};

use crate::state::background::in_background;
use crate::strings::studies as strings;

/// A session, as the list shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ListedSession {
    /// Path of the log.
    pub path: PathBuf,
    /// Pseudonym of the participant, or the name of a file that is no log.
    pub participant: String,
    /// Number of answered trials.
    pub n_answers: usize,
    /// Whether the participant is simulated.
    pub is_simulated: bool,
    /// How far the session is.
    pub state: SessionState,
    /// Why the session cannot go on, or what is wrong with its log.
    pub problem: Option<String>,
}

/// How far a session is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SessionState {
    /// Trials are left, and nobody has agreed to the consent text yet.
    BeforeConsent,
    /// Trials are left.
    Open,
    /// All trials are answered.
    Done,
    /// The participant did not agree to the consent text.
    Refused,
    /// The log is one of another plan.
    OtherPlan,
    /// The file is no log that can be read.
    Unreadable,
}

impl ListedSession {
    /// Whether the session can be resumed.
    pub fn can_resume(&self) -> bool {
        matches!(self.state, SessionState::BeforeConsent | SessionState::Open)
    }
}

/// The sessions of a study, read in the background.
#[derive(Default)]
pub(super) struct Sessions {
    pub(super) listed: Vec<ListedSession>,
    /// Why the logs cannot be listed.
    pub(super) failure: Option<String>,
    reading: Option<Receiver<Result<Vec<ListedSession>, String>>>,
}

impl Sessions {
    /// Reads the logs of a folder again.
    pub(super) fn read(&mut self, folder: PathBuf, plan: Plan, ctx: &Context) {
        self.reading = Some(in_background(ctx.clone(), move || {
            let logs = list_logs(&folder).map_err(|error| one_line(&error))?;
            Ok(logs.iter().map(|log| listed(log, &plan)).collect())
        }));
    }

    /// Forgets the sessions of another study.
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Whether the logs are being read.
    pub(super) fn is_reading(&self) -> bool {
        self.reading.is_some()
    }

    /// Takes in the sessions that were read.
    pub(super) fn collect(&mut self) {
        let Some(reading) = &self.reading else { return };
        match reading.try_recv() {
            Err(TryRecvError::Empty) => return,
            Err(TryRecvError::Disconnected) => self.failure = Some(strings::BROKEN_OFF.to_owned()),
            Ok(Ok(listed)) => (self.listed, self.failure) = (listed, None),
            Ok(Err(reason)) => self.failure = Some(reason),
        }
        self.reading = None;
    }

    /// Whether logs of another plan lie in the folder, so that no session can be added to it.
    pub(super) fn has_other_plan(&self) -> bool {
        self.listed.iter().any(|session| session.state == SessionState::OtherPlan)
    }

    /// Whether the participant of a log would read the consent text after a resume.
    pub(super) fn needs_consent(&self, log: &Path) -> bool {
        let is_before = |session: &ListedSession| session.state == SessionState::BeforeConsent;
        self.listed.iter().any(|session| session.path == log && is_before(session))
    }

    /// Log of an interrupted session of a simulated participant, if there is one.
    pub(super) fn interrupted_simulation(&self) -> Option<&PathBuf> {
        let is_it = |session: &&ListedSession| session.is_simulated && session.can_resume();
        self.listed.iter().find(is_it).map(|session| &session.path)
    }
}

fn listed(log: &ListedLog, plan: &Plan) -> ListedSession {
    let path = log.path.clone();
    match &log.log {
        Ok(read) => {
            let has = |event: &Event| read.events.iter().any(|timed| timed.event == *event);
            let state = if read.plan != *plan {
                SessionState::OtherPlan
            } else if has(&Event::Refused) {
                SessionState::Refused
            } else if has(&Event::Ended) {
                SessionState::Done
            } else if has(&Event::Consented) {
                SessionState::Open
            } else {
                SessionState::BeforeConsent
            };
            let n_problems = read.problems.len();
            let problem = if state == SessionState::OtherPlan {
                Some(strings::OTHER_PLAN.to_owned())
            } else {
                (n_problems > 0).then(|| strings::damaged_lines(n_problems))
            };
            ListedSession {
                path,
                participant: read.header.participant().to_owned(),
                n_answers: read.record().answers.len(),
                is_simulated: read.header.is_simulated(),
                state,
                problem,
            }
        }
        Err(reason) => ListedSession {
            participant: shown_name(&path),
            path,
            n_answers: 0,
            is_simulated: false,
            state: SessionState::Unreadable,
            problem: Some(reason.clone()),
        },
    }
}
