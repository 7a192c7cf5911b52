//! Logs to analyze: of one plan, read with everything that is wrong with them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::bail;
use shagreen_core::people::study::answer::Record;
use shagreen_core::people::study::plan::Plan;
use shagreen_core::people::study::progress::replay;
use shagreen_formats::study_log::ReadLog;

use crate::file::{file_name, one_line};
use crate::study::logs::{ListedLog, list_logs, load_log, log_warnings, recover_log};
use crate::study::plans::StudyPlan;

/// Kind of participants of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParticipantKind {
    /// People.
    People,
    /// Simulated participants.
    Simulated,
}

/// Logs of one plan.
#[derive(Clone, Debug)]
pub struct StudyLogs {
    plan: Arc<Plan>,
    logs: Vec<(PathBuf, ReadLog)>,
    /// Sentences about files that could not be read.
    unreadable: Vec<String>,
}

/// A participant whose answers are analyzed.
#[derive(Clone, Debug)]
pub(super) struct Participant {
    /// Path of the log.
    pub(super) path: PathBuf,
    pub(super) record: Record,
    /// Whether all trials are answered.
    pub(super) is_complete: bool,
}

/// Reads logs, and all logs of folders. A file of a folder that cannot be read is named in the warnings of the result. A log
/// whose first line is damaged is read with the plan of the others.
///
/// # Errors
/// There is no log, a log that is named cannot be read, the logs have different plans, or two of them the same participant.
pub fn read_logs(paths: &[PathBuf]) -> anyhow::Result<StudyLogs> {
    read_logs_with(paths, None)
}

/// Reads logs as [`read_logs`] does. A log whose first line is damaged is read with this plan, or else
/// with that of the others.
///
/// # Errors
/// As [`read_logs`].
pub fn read_logs_with(paths: &[PathBuf], plan: Option<&StudyPlan>) -> anyhow::Result<StudyLogs> {
    let mut logs: Vec<(PathBuf, ReadLog)> = Vec::new();
    let mut damaged: Vec<Damaged> = Vec::new();
    for path in paths {
        if path.is_dir() {
            for ListedLog { path, log } in list_logs(path)? {
                match log {
                    Ok(log) => logs.push((path, *log)),
                    Err(reason) => damaged.push(Damaged { path, reason, error: None }),
                }
            }
        } else {
            match load_log(path) {
                Ok(log) => logs.push((path.clone(), log)),
                Err(error) => {
                    let reason = one_line(&error);
                    damaged.push(Damaged { path: path.clone(), reason, error: Some(error) });
                }
            }
        }
    }
    let of_logs = logs.first().map(|(_, log)| log.header.plan_text().to_owned());
    let plan_texts: Vec<String> = plan.map(|plan| plan.text.clone()).into_iter().chain(of_logs).collect();
    let mut unreadable = Vec::new();
    for Damaged { path, reason, error } in damaged {
        // If it cannot be recovered either, the reason stays that of the first attempt.
        let recovered = plan_texts.iter().find_map(|text| recover_log(&path, text).ok());
        match (recovered, error) {
            (Some(log), _) => logs.push((path, log)),
            // A log that was named must be read; others of its folder are only mentioned.
            (None, Some(error)) => return Err(error),
            (None, None) => unreadable.push(format!("the answers of a file are left out: {reason}")),
        }
    }
    // The recovered ones were added last.
    logs.sort_by(|(one, _), (other, _)| one.cmp(other));
    let Some((first, ReadLog { plan, .. })) = logs.first() else {
        let named: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
        let named = named.join(", ");
        if let (Some(reason), true) = (unreadable.first(), plan_texts.is_empty()) {
            bail!(
                "no log can be read ({reason}); if only its first line is damaged, state the plan of the study too (on the command line: --plan): {named}"
            );
        }
        let why = unreadable.first().map_or_else(String::new, |reason| format!(" ({reason})"));
        bail!(
            "there are no logs of a study{why}; run a session first, or give the folder of its logs: {named}"
        );
    };
    if let Some((other, _)) = logs.iter().find(|(_, log)| log.plan != *plan) {
        bail!(
            "two logs have different plans, so their answers cannot be compared; analyze them one by one: {} and {}",
            first.display(),
            other.display()
        );
    }
    check_participants(&logs)?;
    Ok(StudyLogs { plan: Arc::new(plan.clone()), logs, unreadable })
}

/// A file that could not be read as a log.
struct Damaged {
    path: PathBuf,
    /// Why, in one line.
    reason: String,
    /// The error, if the file was named.
    error: Option<anyhow::Error>,
}

fn check_participants(logs: &[(PathBuf, ReadLog)]) -> anyhow::Result<()> {
    let mut seen: BTreeMap<&str, &Path> = BTreeMap::new();
    for (path, log) in logs {
        let participant = log.header.participant();
        if let Some(other) = seen.insert(participant, path) {
            bail!(
                "two logs have the participant \"{participant}\"; leave out the copy: {} and {}",
                other.display(),
                path.display()
            );
        }
    }
    Ok(())
}

impl StudyLogs {
    /// The plan of all logs.
    pub fn plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// Paths of the logs.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.logs.iter().map(|(path, _)| path.as_path())
    }

    /// Number of logs of people, and of simulated participants, without those of participants who refused.
    pub fn counts(&self) -> [usize; 2] {
        let taking_part = || self.logs.iter().filter(|(_, log)| !log.has_refused());
        let n_simulated = taking_part().filter(|(_, log)| log.header.is_simulated()).count();
        [taking_part().count() - n_simulated, n_simulated]
    }

    /// Number of participants of a kind who did not agree to the consent text.
    pub fn n_refused(&self, kind: ParticipantKind) -> usize {
        let is_simulated = kind == ParticipantKind::Simulated;
        self.logs
            .iter()
            .filter(|(_, log)| log.has_refused() && log.header.is_simulated() == is_simulated)
            .count()
    }

    /// Kind of the participants to analyze.
    pub(super) fn chosen(&self, kind: Option<ParticipantKind>) -> anyhow::Result<ParticipantKind> {
        match (self.counts(), kind) {
            ([n_people, n_simulated], None) if n_people > 0 && n_simulated > 0 => bail!(
                "there are logs of people ({n_people}) and of simulated participants ({n_simulated}), which are never mixed in one result; choose one of the two"
            ),
            ([_, 0], None) => Ok(ParticipantKind::People),
            ([_, _], None) => Ok(ParticipantKind::Simulated),
            ([0, _], Some(ParticipantKind::People)) => {
                bail!("all participants are simulated; there are no answers of people to analyze")
            }
            ([_, 0], Some(ParticipantKind::Simulated)) => {
                bail!("none of the participants is simulated; there are only answers of people to analyze")
            }
            (_, Some(kind)) => Ok(kind),
        }
    }

    /// Participants of a kind who have answers, and sentences about what is wrong with the logs.
    pub(super) fn participants(&self, kind: ParticipantKind) -> (Vec<Participant>, Vec<String>) {
        let mut warnings = self.unreadable.clone();
        let mut participants = Vec::new();
        let is_simulated = kind == ParticipantKind::Simulated;
        for (path, log) in self.logs.iter().filter(|(_, log)| log.header.is_simulated() == is_simulated) {
            warnings.extend(log_warnings(path, log));
            if log.has_refused() {
                continue;
            }
            let record = log.record();
            let replayed = match replay(Arc::clone(&self.plan), record.number, &log.events()) {
                Ok(replayed) => replayed,
                Err(error) => {
                    warnings.push(format!("{}, the whole log is left out: {error}", file_name(path)));
                    continue;
                }
            };
            warnings.extend(replayed.warnings.iter().map(|text| format!("{}, {text}", file_name(path))));
            if record.answers.is_empty() {
                warnings.push(format!("{} has no answers", file_name(path)));
                continue;
            }
            let is_complete = replayed.progress.place().is_none();
            if !is_complete {
                let n_answers = record.answers.len();
                warnings
                    .push(format!("{}: the session is not complete ({n_answers} answers)", file_name(path)));
            }
            participants.push(Participant { path: path.clone(), record, is_complete });
        }
        (participants, warnings)
    }
}
