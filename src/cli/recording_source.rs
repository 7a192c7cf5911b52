//! Recorded strokes from a file, with what there is to say of them.

use std::path::Path;

use shagreen_core::recording::Recording;
use shagreen_formats::recording::{ColumnMap, Question, RecordingFileError, read_recording};

use crate::cli::output::{self, file_name};
use crate::cli::recording_answers::sidecar;

/// What became of a file.
pub(crate) struct RecordingRead {
    /// The recording, or why there is none.
    pub(crate) recording: Result<Recording, String>,
    /// What the file did not say: with a guess where there is one.
    pub(crate) questions: Vec<Question>,
    /// Sentences, the guesses among them.
    pub(crate) warnings: Vec<String>,
}

/// Reads a recording, with its file of units if there is one.
pub(crate) fn read_recording_file(file: &Path, map: &ColumnMap) -> RecordingRead {
    let failed = |reason: String| RecordingRead {
        recording: Err(reason),
        questions: Vec::new(),
        warnings: Vec::new(),
    };
    // The file is named beside it.
    let bytes = match output::read_file(file) {
        Ok(bytes) => bytes,
        Err(error) => return failed(error.root_cause().to_string()),
    };
    let sidecar = match sidecar(file) {
        Ok(sidecar) => sidecar,
        Err(reason) => return failed(reason),
    };
    let guessed = |questions: &[Question]| -> Vec<String> {
        let guesses = questions.iter().filter(|question| question.guess.is_some());
        guesses.map(|question| format!("guessed {question}")).collect()
    };
    match read_recording(&file_name(file), &bytes, sidecar.as_deref(), map) {
        Ok(read) => {
            let mut warnings = guessed(&read.questions);
            warnings.extend(read.warnings);
            let (recording, findings) = match Recording::from_raw(read.raw) {
                Ok((recording, findings)) => (Ok(recording), findings),
                Err(error) => (Err(error.to_string()), error.findings),
            };
            warnings.extend(findings.iter().map(ToString::to_string));
            RecordingRead { recording, questions: read.questions, warnings }
        }
        Err(RecordingFileError::NeedsAnswers(needed)) => {
            let mut warnings = guessed(&needed.questions);
            warnings.extend(needed.warnings.iter().cloned());
            let reason = format!("{needed}; answer by --set KEY=VALUE or --map MAP.toml");
            RecordingRead { recording: Err(reason), questions: needed.questions, warnings }
        }
        Err(error) => failed(error.to_string()),
    }
}
