//! Recordings of strokes: tables and WAV files to columns in SI units.
//!
//! A file seldom says everything of itself. What it does not say is a [`Question`]: where the reader can tell the answer
//! from the numbers it goes on with a guess and says so; where it cannot, it stops and asks. It never makes a number up.
//! The answers are a [`ColumnMap`], from the window, the command line or a file ([`crate::map_toml`]).

mod column_map;
mod from_table;
mod from_wav;
mod inquiry;
mod names;
mod question;
mod sidecar;
mod table;
mod told;
mod units;
mod wav;

use std::fmt;

use shagreen_core::recording::{Fault, RawRecording};

use crate::recording::from_table::recording_of_table;
use crate::recording::from_wav::recording_of_wav;
use crate::recording::table::read_table;
use crate::recording::wav::is_wav;

pub use crate::recording::column_map::{Channel, Column, ColumnMap, Separator};
pub use crate::recording::question::{AnswerError, Ask, Question};
pub use crate::recording::units::{AccelerationUnit, ForceUnit, PositionUnit, SpeedUnit, TimeUnit};

/// A recording as its file holds it.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordingFile {
    /// Its columns in SI units.
    pub raw: RawRecording,
    /// What the columns were taken for, complete.
    pub map: ColumnMap,
    /// What the file did not say; each has a guess that was gone on with.
    pub questions: Vec<Question>,
    /// Sentences for people, one for each thing that was odd but usable.
    pub warnings: Vec<String>,
}

/// Why a file is no recording.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RecordingFileError {
    /// The table cannot be read.
    #[error("{problem}{}; correct the file", line.map(|line| format!(" in line {line}")).unwrap_or_default())]
    Table {
        /// What is wrong.
        problem: String,
        /// Where, from one.
        line: Option<usize>,
    },
    /// The WAV file cannot be read.
    #[error("the WAV file {problem}; export it again as PCM or float WAV")]
    Wav {
        /// What is wrong.
        problem: String,
    },
    /// The sidecar of a WAV file cannot be read.
    #[error("the sidecar cannot be read: {reason}; correct it, or take it away and answer by a map")]
    Sidecar {
        /// What is wrong, with the line where it is known.
        reason: String,
    },
    /// The map does not fit the file.
    #[error("the map does not fit the file: {problem}")]
    Map {
        /// What is wrong.
        problem: String,
    },
    /// No column can be acceleration.
    #[error("{}", no_acceleration(columns, faults))]
    NoAcceleration {
        /// The columns that there are.
        columns: Vec<String>,
        /// What else would keep the recording from being used.
        faults: Vec<Fault>,
    },
    /// The file does not say what it takes to read it.
    #[error("{0}")]
    NeedsAnswers(Box<NeedsAnswers>),
}

/// What a file does not say, and what is known of it so far.
#[derive(Clone, Debug, PartialEq)]
pub struct NeedsAnswers {
    /// All questions, those with a guess too; at least one has none.
    pub questions: Vec<Question>,
    /// What would keep the recording from being used whatever the answers are.
    pub faults: Vec<Fault>,
    /// What the columns were taken for so far.
    pub map: ColumnMap,
    /// Sentences for people.
    pub warnings: Vec<String>,
}

impl fmt::Display for NeedsAnswers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let open = self.questions.iter().filter(|question| question.guess.is_none());
        let questions: Vec<String> = open.map(Question::to_string).collect();
        // What no answer mends comes first.
        for fault in &self.faults {
            write!(f, "{fault}; ")?;
        }
        let noun = if questions.len() == 1 { "answer is" } else { "answers are" };
        write!(f, "{} {noun} needed: {}", questions.len(), questions.join("; "))
    }
}

fn no_acceleration(columns: &[String], faults: &[Fault]) -> String {
    let columns: Vec<String> = columns.iter().map(|name| format!("{name:?}")).collect();
    let mut sentences = vec![format!(
        "no acceleration: the columns are {}; name those of acceleration in the map, or record acceleration",
        columns.join(", ")
    )];
    sentences.extend(faults.iter().map(Fault::to_string));
    sentences.join("; ")
}

/// Channels of a WAV file as far as its head says them; 0 where it does not.
pub(crate) fn n_channels(wav: &[u8]) -> usize {
    wav::n_channels(wav)
}

/// Reads a recording: a WAV file by its first bytes, anything else as a table. `file_name` is for messages, `sidecar` the
/// bytes of the `.json` beside a WAV file, `map` what is known already.
///
/// # Errors
/// See [`RecordingFileError`].
pub fn read_recording(
    file_name: &str,
    bytes: &[u8],
    sidecar: Option<&[u8]>,
    map: &ColumnMap,
) -> Result<RecordingFile, RecordingFileError> {
    if is_wav(bytes) {
        recording_of_wav(bytes, sidecar, map)
    } else if file_name.to_lowercase().ends_with(".wav") {
        let problem = "does not begin as WAV files do".to_owned();
        Err(RecordingFileError::Wav { problem })
    } else {
        recording_of_table(read_table(bytes, map)?, map)
    }
}

#[cfg(test)]
mod tests;
