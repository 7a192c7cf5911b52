//! Recordings of strokes: tables, WAV files and haptic clips, converted to columns in SI units.
//!
//! A file rarely describes itself completely. Each missing fact is a [`Question`]. If the numbers imply an answer, the
//! reader uses that guess and reports it; otherwise it stops and asks. It never invents a number. The answers form a
//! [`ColumnMap`], from the window, the command line or a file ([`crate::map_toml`]).

mod column_map;
pub mod directional;
mod from_clip;
mod from_table;
mod from_wav;
mod infer_units;
mod map_builder;
mod names;
mod question;
mod sidecar;
mod table;
mod units;
mod wav;

use std::fmt;

use shagreen_core::recording::{Fault, RawRecording};

use crate::clip::ClipKind;
use crate::recording::from_clip::recording_of_clip;
use crate::recording::from_table::recording_of_table;
use crate::recording::from_wav::recording_of_wav;
use crate::recording::table::read_table;
use crate::recording::wav::is_wav;

pub use crate::recording::column_map::{Channel, Column, ColumnMap, Separator};
pub use crate::recording::question::{AnswerError, Ask, Question};
pub use crate::recording::units::{AccelerationUnit, ForceUnit, PositionUnit, SpeedUnit, TimeUnit};

/// The contents of a recording file.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordingFile {
    /// Its columns in SI units.
    pub raw: RawRecording,
    /// The complete interpretation of the columns.
    pub map: ColumnMap,
    /// Facts that the file does not state; each has a guess that was used.
    pub questions: Vec<Question>,
    /// Sentences for the user, one for each imperfection that leaves the data usable.
    pub warnings: Vec<String>,
}

/// Why a file is not a recording.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RecordingFileError {
    /// The table cannot be read.
    #[error("{problem}{}; correct the file", line.map(|line| format!(" in line {line}")).unwrap_or_default())]
    Table {
        /// What is wrong.
        problem: String,
        /// The line, from one.
        line: Option<usize>,
    },
    /// The WAV file cannot be read.
    #[error("the WAV file {problem}; export it again as PCM or float WAV")]
    Wav {
        /// What is wrong.
        problem: String,
    },
    /// The sidecar file of a WAV file cannot be read.
    #[error("cannot read the sidecar file: {reason}; correct it, or remove it and use a column map")]
    Sidecar {
        /// What is wrong, with the line if known.
        reason: String,
    },
    /// A haptic clip, or a table of an envelope, cannot be made into a signal.
    #[error("{reason}")]
    Clip {
        /// What is wrong, where, and what to do.
        reason: String,
    },
    /// The column map does not fit the file.
    #[error("the column map does not fit the file: {problem}")]
    Map {
        /// What is wrong.
        problem: String,
    },
    /// No column can be acceleration.
    #[error("{}", no_acceleration(columns, faults))]
    NoAcceleration {
        /// Names of the columns.
        columns: Vec<String>,
        /// Further faults that would make the recording unusable.
        faults: Vec<Fault>,
    },
    /// The file lacks facts that are necessary to read it.
    #[error("{0}")]
    NeedsAnswers(Box<NeedsAnswers>),
}

/// Facts that a file does not state, and what is known so far.
#[derive(Clone, Debug, PartialEq)]
pub struct NeedsAnswers {
    /// All questions, including those with a guess; at least one has none.
    pub questions: Vec<Question>,
    /// Faults that make the recording unusable whatever the answers are.
    pub faults: Vec<Fault>,
    /// The interpretation of the columns so far.
    pub map: ColumnMap,
    /// Sentences for the user.
    pub warnings: Vec<String>,
}

impl fmt::Display for NeedsAnswers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let open = self.questions.iter().filter(|question| question.guess.is_none());
        let questions: Vec<String> = open.map(Question::to_string).collect();
        // Faults that no answer can fix come first.
        for fault in &self.faults {
            write!(f, "{fault}; ")?;
        }
        let noun = if questions.len() == 1 { "property is" } else { "properties are" };
        write!(f, "{} {noun} not stated: {}", questions.len(), questions.join("; "))
    }
}

fn no_acceleration(columns: &[String], faults: &[Fault]) -> String {
    let columns: Vec<String> = columns.iter().map(|name| format!("{name:?}")).collect();
    let mut sentences = vec![format!(
        "no acceleration: the columns are {}; name the acceleration columns in the column map, or record acceleration",
        columns.join(", ")
    )];
    sentences.extend(faults.iter().map(Fault::to_string));
    sentences.join("; ")
}

/// Number of channels that the header of a WAV file states; 0 if it does not.
pub(crate) fn n_channels(wav: &[u8]) -> usize {
    wav::n_channels(wav)
}

/// Reads a recording: a WAV file or a haptic clip if its content says so, otherwise a table. `file_name` is for messages, `sidecar`
/// holds the bytes of the `.json` file next to a WAV file, and `map` holds known answers.
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
        let problem = "does not begin with a WAV header".to_owned();
        Err(RecordingFileError::Wav { problem })
    } else if let Some(kind) = ClipKind::of(file_name, bytes) {
        recording_of_clip(kind, bytes, map)
    } else {
        recording_of_table(read_table(bytes, map)?, map)
    }
}

#[cfg(test)]
mod tests;
