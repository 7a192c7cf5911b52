//! Recorded strokes from files, with questions and warnings.

use std::path::{Path, PathBuf};

use anyhow::bail;
use shagreen_core::recording::{Finding, RawRecording, Recording, RecordingError, ThreeAxisRecording};
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::recording::{ColumnMap, Question, RecordingFileError, read_recording};

use crate::cli::output;
use crate::cli::recording_answers::sidecar;
use shagreen_studio::file::{self, file_name};

/// Result of reading a recording.
pub(crate) struct RecordingRead<T = Recording> {
    /// The recording, or the reason why it cannot be used.
    pub(crate) recording: Result<T, String>,
    /// Properties that the file does not state, each with a guess if there is one.
    pub(crate) questions: Vec<Question>,
    /// Warnings, including the guesses.
    pub(crate) warnings: Vec<String>,
    /// Ordinary steps of the conversion.
    pub(crate) notes: Vec<String>,
}

/// Reads a recording, and its sidecar with units if there is one.
pub(crate) fn read_recording_file(file: &Path, map: &ColumnMap) -> RecordingRead {
    read_as(file, map, Recording::from_raw)
}

/// As [`read_recording_file`], and keeps the three axes of acceleration.
pub(crate) fn read_three_axis_file(file: &Path, map: &ColumnMap) -> RecordingRead<ThreeAxisRecording> {
    read_as(file, map, ThreeAxisRecording::from_raw)
}

/// Reads several recordings by `read`, one of the functions above, and prints their warnings and notes. The first that
/// cannot be used is the error.
pub(crate) fn read_recording_files<T>(
    files: &[PathBuf],
    map: &ColumnMap,
    read: impl Fn(&Path, &ColumnMap) -> RecordingRead<T>,
) -> anyhow::Result<Vec<T>> {
    let mut recordings = Vec::new();
    for file in files {
        let read = read(file, map);
        for warning in &read.warnings {
            output::warn(&format!("{warning}: {}", file.display()));
        }
        for note in &read.notes {
            output::note(&format!("{note}: {}", file.display()));
        }
        match read.recording {
            Ok(recording) => recordings.push(recording),
            Err(reason) => bail!("{reason}: {}", file.display()),
        }
    }
    Ok(recordings)
}

fn read_as<T>(
    file: &Path,
    map: &ColumnMap,
    convert: impl FnOnce(RawRecording) -> Result<(T, Vec<Finding>), RecordingError>,
) -> RecordingRead<T> {
    let failed = |reason: String| RecordingRead {
        recording: Err(reason),
        questions: Vec::new(),
        warnings: Vec::new(),
        notes: Vec::new(),
    };
    // The caller adds the name of the file.
    let bytes = match file::read_file(file, FileKind::Recording) {
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
            let (recording, findings) = match convert(read.raw) {
                Ok((recording, findings)) => (Ok(recording), findings),
                Err(error) => (Err(error.to_string()), error.findings),
            };
            let (ordinary, others): (Vec<_>, Vec<_>) =
                findings.iter().partition(|finding| finding.is_ordinary());
            warnings.extend(others.into_iter().map(ToString::to_string));
            let notes = ordinary.into_iter().map(ToString::to_string).collect();
            RecordingRead { recording, questions: read.questions, warnings, notes }
        }
        Err(RecordingFileError::NeedsAnswers(needed)) => {
            let mut warnings = guessed(&needed.questions);
            warnings.extend(needed.warnings.iter().cloned());
            let reason = format!("{needed}; state this with --set KEY=VALUE or --map MAP.toml");
            RecordingRead { recording: Err(reason), questions: needed.questions, warnings, notes: Vec::new() }
        }
        Err(error) => failed(error.to_string()),
    }
}
