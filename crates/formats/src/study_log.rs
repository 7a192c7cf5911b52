//! Logs of sessions of a study: one JSON object a line, appended and flushed to disk after each answer.
//!
//! The first line states the format, the participant and the whole plan, so that a log can be analyzed by itself:
//!
//! ```json
//! {"format":"shagreen-study-log","version":"1.1","participant":"p03","number":3,"simulated":false,"seed":7,
//!  "program":"shagreen 0.1.0","unix_s":1764000000,"plan_sha256":"…","plan":"format = \"shagreen-study\"\n…"}
//! ```
//!
//! (here on two lines). The second line is a copy of it. Each further line is an event: `setup` with the devices from here on,
//! `consent` or `refuse`, `rest`, `resume`, `end`, or `answer` with the trial, the response and what was measured; units are
//! mm, mm/s, N, ms and s. Pseudonyms identify participants. If one is simulated, the header and the pseudonym say so.
//! Version 1.0 had neither the copy nor the lines `setup` and `refuse`, nor `touched_mm`.
//!
//! A log only grows: nothing in it is overwritten or removed. What damages it, and what becomes of the answers:
//!
//! - The program is killed while it writes: the last line is torn. It stays, its trial counts as unanswered, and the next
//!   event begins a new line.
//! - The disk is full: [`StudyLog::append`] returns an error, and the same event can be appended again later.
//! - Lines in the middle are damaged: they are named with their number and skipped.
//! - The first line is damaged: its copy counts. Without one, [`recover_study_log`] reads the answers with the plan of the
//!   study, and finds the number of the participant from the seeds of the trials.
//! - A second session begins on the same log: it is refused while the first one runs, by a lock. On a file system without locks, the
//!   session that finds lines of the other one stops writing.

mod append;
mod header;
mod line;
mod lines;
mod read;
mod read_log;
mod recover;
mod setup_line;
mod task_line;
mod write;

pub use append::{LogError, StudyLog};
pub use header::{LogHeader, LogHeaderError};
pub use read::{ReadLogError, read_study_log};
pub use read_log::{LineProblem, ReadLog};
pub use recover::recover_study_log;
pub(crate) use setup_line::NO_OUTPUT;
pub use write::write_study_log;

use shagreen_core::people::study::answer::Event;

/// Value of the `format` field.
pub const FORMAT: &str = "shagreen-study-log";
/// Version that this program writes; it reads all versions 1.
pub const VERSION: &str = "1.1";

/// An event with its time.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedEvent {
    /// Time of the event, in s since 1970 (Unix time).
    pub unix_secs: f64,
    /// The event.
    pub event: Event,
}

#[cfg(test)]
mod tests;
