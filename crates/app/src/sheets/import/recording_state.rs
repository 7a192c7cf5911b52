//! Recording in the import sheet: its column map, its questions and the result of reading it.

use shagreen_formats::recording::{ColumnMap, Question};

use crate::sheets::import::worker::{ReadOutcome, RecordingInput};

/// Recording, its column map and its questions.
pub struct RecordingState {
    pub(super) input: RecordingInput,
    pub(super) map: ColumnMap,
    pub(super) generation: u64,
    pub(super) is_reading: bool,
    /// Result of the last reading.
    pub outcome: ReadOutcome,
    /// Answered questions with their answers.
    pub answered: Vec<(Question, String)>,
    /// What is wrong with the last answer.
    pub answer_error: Option<String>,
}

impl RecordingState {
    pub(super) fn new(input: RecordingInput, map: ColumnMap, outcome: ReadOutcome) -> Self {
        Self {
            input,
            map,
            generation: 0,
            is_reading: false,
            outcome,
            answered: Vec::new(),
            answer_error: None,
        }
    }

    /// Whether the recording asks this question, answered or not.
    pub(super) fn asks(&self, question: &Question) -> bool {
        let same = |other: &Question| other.what == question.what && other.choices == question.choices;
        self.outcome.questions.iter().any(same) || self.answered.iter().any(|(other, _)| same(other))
    }

    /// Whether unanswered questions are filled with guesses.
    pub(super) fn is_guessed(&self) -> bool {
        let is_answered = |q: &Question| self.answered.iter().any(|(other, _)| other.what == q.what);
        self.outcome.questions.iter().any(|q| q.guess.is_some() && !is_answered(q))
    }

    /// Applies an answer; returns whether the recording must be read again.
    pub(super) fn answer(&mut self, question: &Question, answer: &str) -> bool {
        let mut map = self.map.clone();
        if let Err(error) = map.answer(question.what, answer) {
            self.answer_error = Some(error.to_string());
            return false;
        }
        self.answer_error = None;
        self.map = map;
        self.generation += 1;
        self.is_reading = true;
        match self.answered.iter_mut().find(|(other, _)| other.what == question.what) {
            Some((_, old)) => answer.clone_into(old),
            None => self.answered.push((question.clone(), answer.to_owned())),
        }
        true
    }
}
