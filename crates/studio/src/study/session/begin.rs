//! Beginning a session, and going on with one.

use std::path::Path;
use std::sync::Arc;

use anyhow::Context as _;
use shagreen_core::people::study::answer::Event;
use shagreen_core::people::study::plan::{Part, Plan};
use shagreen_core::people::study::progress::{Progress, Step, replay};
use shagreen_formats::study_log::{LogError, LogHeader, StudyLog};

use crate::file::in_file;
use crate::study::logs::{
    check_same_study, free_pseudonym, list_logs, log_path, log_warnings, next_number, pseudonym,
};
use crate::study::plans::StudyPlan;
use crate::study::program;
use crate::study::session::{StudySession, unix_secs};

/// What a new session needs.
#[derive(Clone, Copy, Debug)]
pub struct NewSession<'a> {
    /// The plan.
    pub plan: &'a StudyPlan,
    /// Where its log is created.
    pub place: LogPlace<'a>,
    /// Pseudonym of the participant; `None` for the next free one. That of a simulated participant contains "simulated".
    pub participant: Option<&'a str>,
    /// Seed of the simulation if the participant is simulated; `None` for a person.
    pub simulation_seed: Option<u64>,
}

/// Where a log is created.
#[derive(Clone, Copy, Debug)]
pub enum LogPlace<'a> {
    /// A folder, which is made if it does not exist; the file has the name of the participant.
    Folder(&'a Path),
    /// This file, which must not exist.
    File(&'a Path),
}

impl StudySession {
    /// Begins the session of a new participant, and creates its log. The number of the participant, which determines all
    /// orders, follows those of the other logs in the folder, or is that of a participant who refused.
    ///
    /// # Errors
    /// The folder cannot be made or read, or has logs of another plan; the participant has a log already; the pseudonym is
    /// not allowed; or the log cannot be written.
    pub fn begin(new: &NewSession<'_>) -> anyhow::Result<Self> {
        let NewSession { plan, place, participant, simulation_seed } = *new;
        let is_simulated = simulation_seed.is_some();
        let folder = match place {
            LogPlace::Folder(folder) => folder,
            LogPlace::File(path) => path.parent().unwrap_or(Path::new("")),
        };
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        std::fs::create_dir_all(folder)
            .context("cannot create the folder of the logs; choose another")
            .with_context(|| in_file(folder))?;
        let mut n_taken = 0;
        loop {
            let logs = list_logs(folder)?;
            check_same_study(&plan.plan, &logs)?;
            let number = next_number(&logs, is_simulated);
            let name = participant
                .map_or_else(|| free_pseudonym(&logs, number + n_taken, is_simulated), str::to_owned);
            let path = match place {
                LogPlace::Folder(folder) => log_path(folder, &name),
                LogPlace::File(path) => path.to_owned(),
            };
            let seed = simulation_seed.unwrap_or(plan.plan.seed);
            let header =
                LogHeader::new(&name, number, is_simulated, seed, &program(), unix_secs(), &plan.text)?;
            // The plan is checked before there is a file.
            let progress = Progress::new(Arc::clone(&plan.plan), number)?;
            match StudyLog::create(&path, &header) {
                Ok(log) => return Ok(Self::of(&header, Some(log), progress)),
                // Another session took the name meanwhile, and perhaps the number.
                Err(LogError::Exists { .. })
                    if participant.is_none() && matches!(place, LogPlace::Folder(_)) =>
                {
                    n_taken += 1;
                }
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// Goes on with the session of a log, at the first trial without an answer. The log contains the plan.
    ///
    /// # Errors
    /// Another session uses the log, it cannot be read or written, or its answers do not belong to its plan.
    pub fn resume(path: &Path) -> anyhow::Result<Self> {
        let (log, read) = StudyLog::resume(path)?;
        let plan = Arc::new(read.plan.clone());
        let replayed = replay(plan, read.header.number(), &read.events()).with_context(|| in_file(path))?;
        let mut session = Self::of(&read.header, Some(log), replayed.progress);
        session.n_answered = read.record().answers.len();
        session.has_ended = read.events.iter().any(|timed| timed.event == Event::Ended);
        session.warnings = log_warnings(path, &read);
        session.warnings.extend(replayed.warnings);
        if session.step() != Step::Done {
            session.keep(Event::Resumed)?;
        }
        Ok(session)
    }

    /// A session with the practice trials of a plan only, of the participant with this number, from 1. Its answers are not
    /// saved.
    ///
    /// # Errors
    /// The plan cannot be run, or has no practice trials.
    pub fn practice(plan: &StudyPlan, number: usize) -> anyhow::Result<Self> {
        let alone = |part: &Part| {
            let only = Plan { parts: vec![part.clone()], consent: String::new(), ..Plan::clone(&plan.plan) };
            Progress::new(Arc::new(only), number)
        };
        let with_practice = plan.plan.parts.iter().filter(|part| part.n_practice > 0);
        let mut further: Vec<Progress> = with_practice.rev().map(alone).collect::<Result<_, _>>()?;
        let first = further.pop().context(
            "the plan has no practice trials; state `practice` in one of its parts, or start the session",
        )?;
        let name = pseudonym(number, false);
        let header =
            LogHeader::new(&name, number, false, plan.plan.seed, &program(), unix_secs(), &plan.text)?;
        let mut session = Self::of(&header, None, first);
        session.plan = Arc::clone(&plan.plan);
        session.further_practice = further;
        Ok(session)
    }
}
