//! What is asked while a file is read.

use shagreen_core::recording::{Fault, RawRecording};

use crate::recording::column_map::ColumnMap;
use crate::recording::question::{Ask, Question};
use crate::recording::{NeedsAnswers, RecordingFile, RecordingFileError};

/// The map as it becomes complete, and what had to be asked for it.
pub(super) struct Inquiry {
    pub(super) map: ColumnMap,
    pub(super) questions: Vec<Question>,
    pub(super) warnings: Vec<String>,
}

impl Inquiry {
    pub(super) fn new(map: ColumnMap) -> Self {
        Self { map, questions: Vec::new(), warnings: Vec::new() }
    }

    /// Asks without a guess.
    pub(super) fn ask(&mut self, what: Ask, choices: &[&str], text: String) {
        let choices = choices.iter().map(|&choice| choice.to_owned()).collect();
        self.questions.push(Question { what, guess: None, choices, text });
    }

    /// Asks, and goes on with a guess; gives false, and asks only, where the map cannot hold the guess.
    pub(super) fn guess(&mut self, what: Ask, guess: &str, choices: &[&str], text: String) -> bool {
        let taken = self.map.answer(what, guess).is_ok();
        let choices = choices.iter().map(|&choice| choice.to_owned()).collect();
        self.questions.push(Question { what, guess: taken.then(|| guess.to_owned()), choices, text });
        taken
    }

    /// The recording, where nothing is left to be answered.
    pub(super) fn close(
        self,
        raw: Option<RawRecording>,
        faults: Vec<Fault>,
    ) -> Result<RecordingFile, RecordingFileError> {
        let Self { map, questions, warnings } = self;
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
