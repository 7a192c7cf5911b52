//! Logs of sessions of a study: one JSON object a line, appended and flushed to disk after each answer.
//!
//! The first line states the format, the participant and the whole plan, so that a log can be analyzed by itself:
//!
//! ```json
//! {"format":"shagreen-study-log","version":"1.0","participant":"p03","number":3,"simulated":false,"seed":7,
//!  "program":"shagreen 0.1.0","unix_s":1764000000,"plan_sha256":"…","plan":"format = \"shagreen-study\"\n…"}
//! ```
//!
//! (here on two lines). Each further line is an event: `consent`, `rest`, `resume`, `end`, or `answer` with the trial, the
//! response and what was measured; units are mm, mm/s, N, ms and s. Pseudonyms identify participants. If one is simulated, the
//! header and the pseudonym say so.
//!
//! A log only grows: nothing in it is overwritten or removed. What damages it, and what becomes of the answers:
//!
//! - The program is killed while it writes: the last line is torn. It stays, its trial counts as unanswered, and the next
//!   event begins a new line.
//! - The disk is full: [`StudyLog::append`] returns an error, and the same event can be appended again later.
//! - Lines in the middle are damaged: they are named with their number and skipped.
//! - A second session begins on the same log: it is refused while the first one runs, by a lock. On a file system without locks, the
//!   session that finds lines of the other one stops writing.

mod append;
mod header;
mod line;
mod read;
mod task_line;
mod write;

pub use append::{LogError, StudyLog};
pub use header::{LogHeader, LogHeaderError};
pub use read::{LineProblem, ReadLog, ReadLogError, read_study_log};
pub use write::write_study_log;

use shagreen_core::people::study::answer::Event;

/// Value of the `format` field.
pub const FORMAT: &str = "shagreen-study-log";
/// Version that this program writes; it reads all versions 1.
pub const VERSION: &str = "1.0";

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
