//! Reader of logs, which keeps every line that is whole.

use shagreen_core::people::study::plan::Plan;

use super::header::HeaderV1;
use super::lines::{Lines, header_in, lines_of, reason_of};
use super::read_log::ReadLog;
use super::{FORMAT, LogHeader, LogHeaderError};
use crate::own_json::{self, HeaderFault};
use crate::study_plan::{StudyPlanError, read_logged_plan};

/// Why bytes are not a log.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadLogError {
    /// The header and its copy are missing or damaged.
    #[error(
        "the first line of the log is damaged: {reason}; analyze the log together with others of its study or with the plan file, or restore it from a backup"
    )]
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
    /// A log without its header has no answers to trials of the plan.
    #[error(
        "the first line of the log is damaged, and the log has no answers to trials of this plan; use the plan with which the session began"
    )]
    OtherPlan,
}

/// Reads a log. Lines that are not whole are reported and skipped.
///
/// # Errors
/// See [`ReadLogError`]. A log without its header and the copy of it can be read by [`super::recover_study_log`].
pub fn read_study_log(bytes: &[u8]) -> Result<ReadLog, ReadLogError> {
    // There is a piece even in an empty file.
    let (_, first) = lines_of(bytes).next().unwrap_or_default();
    let mut problem = None;
    let FoundHeader { header, plan, is_changed } = match header_of(first) {
        Ok(found) => found,
        Err(error) => {
            let Some((line, copy)) = copy_of_header(bytes) else {
                return Err(if has_events(bytes) { without_header(error) } else { error });
            };
            let text = format!("it is damaged; its copy in line {line} counts, and nothing is lost");
            problem = Some(text);
            copy
        }
    };
    let mut lines = Lines::of(bytes, &plan);
    if is_changed {
        lines.add_problem(0, "the plan was changed after the session began; compare it with the plan file");
    }
    if let Some(text) = problem {
        lines.add_problem(0, &text);
    }
    for (index, line) in lines.take_headers() {
        match header_of(line) {
            Ok(copy) if copy.header == header => {}
            Ok(_) => lines.add_problem(
                index,
                "it is a copy of another first line than that of this log, which counts; compare the two",
            ),
            Err(_) => lines.add_problem(index, "the copy of the first line is damaged; nothing is lost"),
        }
    }
    Ok(lines.into_log(header, plan))
}

/// What a header says.
struct FoundHeader {
    header: LogHeader,
    plan: Plan,
    /// Whether the plan differs from its hash.
    is_changed: bool,
}

fn header_of(line: &[u8]) -> Result<FoundHeader, ReadLogError> {
    own_json::minor_version(line, FORMAT, 1).map_err(error_of)?;
    let wire: HeaderV1 =
        serde_json::from_slice(line).map_err(|error| ReadLogError::Damaged { reason: reason_of(&error) })?;
    let stated_hash = wire.plan_sha256.clone();
    let header = wire.into_header()?;
    let plan = read_logged_plan(header.plan_text().as_bytes())?;
    let is_changed = header.plan_sha256() != stated_hash;
    Ok(FoundHeader { header, plan, is_changed })
}

/// The first whole header in any line, with the number of its line from one.
fn copy_of_header(bytes: &[u8]) -> Option<(usize, FoundHeader)> {
    // A header that cannot be read is damaged too, and the next one is tried.
    lines_of(bytes).find_map(|(index, line)| Some((index + 1, header_of(header_in(line)?).ok()?)))
}

/// Whether a line looks like an event of a log.
fn has_events(bytes: &[u8]) -> bool {
    lines_of(bytes).any(|(_, line)| line.starts_with(b"{\"event\":"))
}

/// A first line that is not of a log is a damaged one, if there are events.
fn without_header(error: ReadLogError) -> ReadLogError {
    match error {
        ReadLogError::Format(_) => ReadLogError::Damaged { reason: "it is not that of a log".to_owned() },
        error => error,
    }
}

fn error_of(fault: HeaderFault) -> ReadLogError {
    match fault {
        HeaderFault::TooDense(reason) | HeaderFault::Damaged(reason) => ReadLogError::Damaged { reason },
        HeaderFault::Format(found) => ReadLogError::Format(found.instead_of("the log of a study", FORMAT)),
        HeaderFault::Version(found) | HeaderFault::Major(found) => ReadLogError::Version { found },
    }
}
