//! Questions that arise while a file is read.

use shagreen_core::recording::{Fault, RawRecording, check_signal};

use crate::recording::column_map::ColumnMap;
use crate::recording::question::{Ask, Question};
use crate::recording::{NeedsAnswers, RecordingFile, RecordingFileError};

/// The map as it is completed, with the questions so far.
pub(super) struct MapBuilder {
    pub(super) map: ColumnMap,
    pub(super) questions: Vec<Question>,
    pub(super) warnings: Vec<String>,
}

impl MapBuilder {
    pub(super) fn new(map: ColumnMap) -> Self {
        Self { map, questions: Vec::new(), warnings: Vec::new() }
    }

    /// Adds a question without a guess.
    pub(super) fn ask(&mut self, what: Ask, choices: &[&str], text: String) {
        let choices = choices.iter().map(|&choice| choice.to_owned()).collect();
        self.questions.push(Question { what, guess: None, choices, text });
    }

    /// Adds a question and applies a guess. Returns false, without a guess, if the map rejects it.
    pub(super) fn guess(&mut self, what: Ask, guess: &str, choices: &[&str], text: String) -> bool {
        let taken = self.map.answer(what, guess).is_ok();
        let choices = choices.iter().map(|&choice| choice.to_owned()).collect();
        self.questions.push(Question { what, guess: taken.then(|| guess.to_owned()), choices, text });
        taken
    }

    /// Combines a stated and a found value: the map takes precedence over the file, and a difference raises a warning.
    /// `name` formats a value.
    pub(super) fn settle<T: PartialEq>(
        &mut self,
        what: &str,
        by_map: Option<T>,
        by_file: Option<T>,
        name: impl Fn(&T) -> String,
    ) -> Option<T> {
        if let (Some(ours), Some(theirs)) = (&by_map, &by_file)
            && ours != theirs
        {
            let (ours, theirs) = (name(ours), name(theirs));
            self.warnings.push(format!(
                "in the file, {what} is {theirs}; the column map states {ours}, which is used"
            ));
        }
        by_map.or(by_file)
    }

    /// Returns the recording if every question has a guess.
    pub(super) fn close(
        self,
        raw: Option<RawRecording>,
        mut faults: Vec<Fault>,
    ) -> Result<RecordingFile, RecordingFileError> {
        let Self { map, questions, warnings } = self;
        // A missing signal is the first fault to report.
        if let Some(fault) = raw.as_ref().and_then(|raw| check_signal(&raw.acceleration_mps2)) {
            faults.insert(0, fault);
        }
        match raw {
            Some(raw) if questions.iter().all(|question| question.guess.is_some()) => {
                Ok(RecordingFile { raw, map, questions, warnings })
            }
            _ => Err(RecordingFileError::NeedsAnswers(Box::new(NeedsAnswers {
                questions,
                faults,
                map,
                warnings,
            }))),
        }
    }
}
