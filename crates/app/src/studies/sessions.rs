//! Sessions of the open study, from their logs.

use std::path::PathBuf;
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
    /// Whether all trials are answered.
    pub is_done: bool,
    /// Why the session cannot go on, or what is wrong with its log.
    pub problem: Option<String>,
    /// Whether the session can be resumed.
    pub can_resume: bool,
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

    /// Log of an interrupted session of a simulated participant, if there is one.
    pub(super) fn interrupted_simulation(&self) -> Option<&PathBuf> {
        let is_it = |session: &&ListedSession| session.is_simulated && session.can_resume;
        self.listed.iter().find(is_it).map(|session| &session.path)
    }
}

fn listed(log: &ListedLog, plan: &Plan) -> ListedSession {
    let path = log.path.clone();
    match &log.log {
        Ok(read) => {
            let is_done = read.events.iter().any(|timed| timed.event == Event::Ended);
            let is_other = read.plan != *plan;
            let n_problems = read.problems.len();
            let problem = if is_other {
                Some(strings::OTHER_PLAN.to_owned())
            } else {
                (n_problems > 0).then(|| strings::damaged_lines(n_problems))
            };
            ListedSession {
                path,
                participant: read.header.participant().to_owned(),
                n_answers: read.record().answers.len(),
                is_simulated: read.header.is_simulated(),
                is_done,
                problem,
                can_resume: !is_done && !is_other,
            }
        }
        Err(reason) => ListedSession {
            participant: shown_name(&path),
            path,
            n_answers: 0,
            is_simulated: false,
            is_done: false,
            problem: Some(reason.clone()),
            can_resume: false,
        },
    }
}
