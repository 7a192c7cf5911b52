//! Reader of logs, which keeps every line that is whole.

use std::collections::BTreeSet;

use shagreen_core::people::study::answer::{Event, Record, check};
use shagreen_core::people::study::plan::Plan;

use super::header::HeaderV1;
use super::line::LineV1;
use super::{FORMAT, LogHeader, LogHeaderError, TimedEvent};
use crate::own_json::{self, HeaderFault};
use crate::parser_words::plain;
use crate::study_plan::{StudyPlanError, read_study_plan};

/// A log, and what is wrong with it.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadLog {
    /// The first line.
    pub header: LogHeader,
    /// The plan in the header.
    pub plan: Plan,
    /// Events of all whole lines, in their order. If a trial is answered twice, only the first answer is among them.
    pub events: Vec<TimedEvent>,
    /// Lines that were skipped, the first thousand.
    pub problems: Vec<LineProblem>,
    /// Whether the last line is torn: the program ended while it was written, and its event is lost.
    pub is_torn: bool,
}

/// A line that was skipped, or that needs a look.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LineProblem {
    /// Number of the line, from one.
    pub line: usize,
    /// What is wrong with it, and what became of it.
    pub text: String,
}

impl std::fmt::Display for LineProblem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "line {}: {}", self.line, self.text)
    }
}

/// Why bytes are not a log.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadLogError {
    /// The header is missing or damaged.
    #[error("the first line of the log is damaged: {reason}; restore it from a copy, or begin a new session")]
    Damaged {
        /// What is wrong.
        reason: String,
    },
    /// The file has another format.
    #[error("{0}")]
    Format(String),
    /// The file has an unsupported version.
    #[error("the log has version {found}, but this program reads version 1; use a newer version of Shagreen")]
    Version {
        /// Value of the `version` field.
        found: String,
    },
    /// The header makes no sense.
    #[error("the first line of the log: {0}")]
    Header(#[from] LogHeaderError),
    /// The plan in the header cannot be read.
    #[error("the plan in the first line of the log: {0}")]
    Plan(#[from] StudyPlanError),
}

/// Longest line of an event, in bytes. The longest sorts have some 100 kB.
const MAX_LINE_BYTES: usize = 1 << 20;

/// Number of damaged lines that are listed.
const MOST_PROBLEMS: usize = 1000;

impl ReadLog {
    /// The events without their times.
    pub fn events(&self) -> Vec<Event> {
        self.events.iter().map(|timed| timed.event.clone()).collect()
    }

    /// Answers of the participant, for the analysis.
    pub fn record(&self) -> Record {
        let header = &self.header;
        Record::of(header.participant().to_owned(), header.number(), header.is_simulated(), &self.events())
    }
}

/// Reads a log. Lines that are not whole are reported and skipped.
///
/// # Errors
/// See [`ReadLogError`]: without its header, a log means nothing.
pub fn read_study_log(bytes: &[u8]) -> Result<ReadLog, ReadLogError> {
    let pieces = || bytes.split(|byte| *byte == b'\n').enumerate();
    let n_pieces = pieces().count();
    let mut lines = pieces();
    // There is a piece even in an empty file.
    let (_, first) = lines.next().unwrap_or_default();
    own_json::minor_version(first, FORMAT, 1).map_err(error_of)?;
    let wire: HeaderV1 =
        serde_json::from_slice(first).map_err(|error| ReadLogError::Damaged { reason: reason_of(&error) })?;
    let stated_hash = wire.plan_sha256.clone();
    let header = wire.into_header()?;
    let plan = read_study_plan(header.plan_text().as_bytes())?;
    let mut log = ReadLog { header, plan, events: Vec::new(), problems: Vec::new(), is_torn: false };
    if log.header.plan_sha256() != stated_hash {
        log.add_problem(0, "the plan was changed after the session began; compare it with the plan file");
    }
    let mut answered = BTreeSet::new();
    for (index, line) in lines {
        let line = line.trim_ascii();
        if line.is_empty() {
            continue;
        }
        match event_of(line, &log.plan) {
            Ok(timed) => {
                if let Event::Answered(answer) = &timed.event
                    && !answered.insert((answer.trial.part.clone(), answer.trial.number))
                {
                    let (part, number) = (&answer.trial.part, answer.trial.number);
                    let text = format!(
                        "part \"{part}\", trial {number} is answered before; the first answer counts"
                    );
                    log.add_problem(index, &text);
                    continue;
                }
                log.events.push(timed);
            }
            // Whole lines have a line break, which leaves an empty piece at the end.
            Err(_) if index + 1 == n_pieces => {
                log.is_torn = true;
                log.add_problem(
                    index,
                    "it is torn: the program ended while it was written, and its event is lost",
                );
            }
            Err(reason) => log.add_problem(index, &format!("it is skipped: {reason}")),
        }
    }
    Ok(log)
}

impl ReadLog {
    /// Adds a problem of a line by its index, unless there are too many to list.
    fn add_problem(&mut self, index: usize, text: &str) {
        if self.problems.len() < MOST_PROBLEMS {
            self.problems.push(LineProblem { line: index + 1, text: text.to_owned() });
        }
    }
}

/// The event of a line, or what is wrong with it.
fn event_of(line: &[u8], plan: &Plan) -> Result<TimedEvent, String> {
    if line.len() > MAX_LINE_BYTES {
        return Err(format!("it has more than {MAX_LINE_BYTES} bytes"));
    }
    let wire: LineV1 = serde_json::from_slice(line).map_err(|error| reason_of(&error))?;
    let timed = TimedEvent::from(wire);
    if let Event::Answered(answer) = &timed.event {
        let Some(part) = plan.part(&answer.trial.part) else {
            return Err(format!("the plan has no part \"{}\"", answer.trial.part));
        };
        check(&answer.response, &answer.trial.task, &part.design).map_err(|error| error.to_string())?;
        if let Some(shown) =
            answer.trial.task.shown().iter().find(|shown| plan.stimulus(&shown.stimulus).is_none())
        {
            return Err(format!("the plan has no stimulus \"{}\"", shown.stimulus));
        }
    }
    Ok(timed)
}

/// The message of the parser without its line, which is that of the log.
fn reason_of(error: &serde_json::Error) -> String {
    let message = error.to_string();
    plain(message.rsplit_once(" at line ").map_or(message.as_str(), |(words, _)| words))
}

fn error_of(fault: HeaderFault) -> ReadLogError {
    match fault {
        HeaderFault::TooDense(reason) | HeaderFault::Damaged(reason) => ReadLogError::Damaged { reason },
        HeaderFault::Format(found) => ReadLogError::Format(found.instead_of("the log of a study", FORMAT)),
        HeaderFault::Version(found) | HeaderFault::Major(found) => ReadLogError::Version { found },
    }
}
