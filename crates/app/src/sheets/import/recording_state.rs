//! Recording in the import sheet: its column map, its questions and the result of reading it.

use std::collections::BTreeMap;

use shagreen_formats::recording::{Ask, ColumnMap, Question};

use crate::sheets::import::worker::{ReadOutcome, RecordingInput};
use crate::strings::import as strings;

/// Recording, its column map and its questions.
pub struct RecordingState {
    pub(super) input: RecordingInput,
    pub(super) map: ColumnMap,
    /// Column map without the answers.
    unanswered: ColumnMap,
    pub(super) generation: u64,
    pub(super) is_reading: bool,
    /// Result of the last reading.
    pub outcome: ReadOutcome,
    /// Answered questions with their answers.
    pub answered: Vec<(Question, String)>,
    /// Questions whose last answer cannot be used.
    pub wrong: Vec<WrongAnswer>,
    /// Typed texts by the key of their question, until they are answers.
    pub(super) typed: BTreeMap<&'static str, String>,
    /// Question that was answered last.
    last: Option<Ask>,
}

/// Answer that cannot be used.
#[derive(Clone, Debug, PartialEq)]
pub struct WrongAnswer {
    /// The question.
    pub question: Question,
    /// Why the answer cannot be used, with an example of one that can.
    pub reason: String,
}

impl RecordingState {
    pub(super) fn new(input: RecordingInput, map: ColumnMap, outcome: ReadOutcome) -> Self {
        Self {
            input,
            unanswered: map.clone(),
            map,
            generation: 0,
            is_reading: false,
            outcome,
            answered: Vec::new(),
            wrong: Vec::new(),
            typed: BTreeMap::new(),
            last: None,
        }
    }

    /// Whether the recording asks this question, answered or not.
    pub(super) fn asks(&self, question: &Question) -> bool {
        let same = |other: &Question| other.what == question.what && other.choices == question.choices;
        let wrong = self.wrong.iter().map(|wrong| &wrong.question);
        self.outcome.questions.iter().chain(wrong).any(same)
            || self.answered.iter().any(|(other, _)| same(other))
    }

    /// Whether unanswered questions are filled with guesses.
    pub(super) fn is_guessed(&self) -> bool {
        let is_answered = |q: &Question| self.answered.iter().any(|(other, _)| other.what == q.what);
        self.outcome.questions.iter().any(|q| q.guess.is_some() && !is_answered(q))
    }

    /// Applies an answer, or marks it as wrong; returns whether the recording must be read again.
    pub(super) fn answer(&mut self, question: &Question, answer: &str) -> bool {
        self.wrong.retain(|wrong| wrong.question.what != question.what);
        match self.applied(question, answer) {
            Err(reason) => self.reject(question.clone(), answer, reason),
            Ok(map) => {
                self.map = map;
                self.typed.remove(question.what.key());
                self.last = Some(question.what);
                match self.answered.iter_mut().find(|(other, _)| other.what == question.what) {
                    Some((_, old)) => answer.clone_into(old),
                    None => self.answered.push((question.clone(), answer.to_owned())),
                }
                self.read_again();
                true
            }
        }
    }

    /// Takes in the result of reading. An answer that does not fit the file is marked as wrong; returns whether the
    /// recording must be read again, because of that.
    pub(super) fn take(&mut self, outcome: ReadOutcome) -> bool {
        self.is_reading = false;
        let last = self.answered.iter().find(|(question, _)| Some(question.what) == self.last).cloned();
        if let (Some(problem), Some((question, answer))) = (&outcome.misfit, last) {
            let reason = strings::misfit(question.what, problem);
            return self.reject(question, &answer, reason);
        }
        self.outcome = outcome;
        false
    }

    /// The column map with an answer.
    fn applied(&self, question: &Question, answer: &str) -> Result<ColumnMap, String> {
        let mut map = self.map.clone();
        let taken = map.answer(question.what, answer);
        // A WAV file and a clip have no columns, so a speed or force that is no quantity is nothing.
        let is_quantity = match question.what {
            Ask::Speed => taken.is_ok() && map.constant_speed.is_some(),
            Ask::Force => taken.is_ok() && map.constant_force.is_some(),
            _ => true,
        };
        match taken {
            _ if self.input.lacks_columns() && !is_quantity => {
                Err(strings::no_quantity(question.what, answer))
            }
            Ok(()) => Ok(map),
            Err(error) => Err(strings::not_understood(question.what, answer, &error.needs)),
        }
    }

    /// Marks an answer as wrong and takes it back; returns whether the recording must be read again.
    fn reject(&mut self, question: Question, answer: &str, reason: String) -> bool {
        let what = question.what;
        self.typed.insert(what.key(), answer.to_owned());
        self.wrong.push(WrongAnswer { question, reason });
        let n_before = self.answered.len();
        self.answered.retain(|(other, _)| other.what != what);
        if self.answered.len() == n_before {
            return false;
        }
        self.map = self.unanswered.clone();
        for (question, answer) in &self.answered {
            // It was accepted before.
            drop(self.map.answer(question.what, answer));
        }
        self.last = None;
        self.read_again();
        true
    }

    fn read_again(&mut self) {
        self.generation += 1;
        self.is_reading = true;
    }
}

#[cfg(test)]
mod tests {
    use super::{ReadOutcome, RecordingInput, RecordingState};
    use shagreen_formats::recording::{Ask, ColumnMap, Question};

    fn question(what: Ask) -> Question {
        Question { what, guess: None, choices: Vec::new(), text: "not stated".to_owned() }
    }

    fn outcome(misfit: Option<&str>) -> ReadOutcome {
        ReadOutcome {
            questions: Vec::new(),
            warnings: Vec::new(),
            recording: None,
            misfit: misfit.map(str::to_owned),
        }
    }

    fn state(name: &str, bytes: &[u8]) -> RecordingState {
        let input = RecordingInput::new(name.to_owned(), bytes.to_vec(), None);
        RecordingState::new(input, ColumnMap::default(), outcome(None))
    }

    #[test]
    fn a_wav_file_takes_no_column_for_its_force() {
        let mut state = state("a.wav", b"RIFF");
        assert!(!state.answer(&question(Ask::Force), "20fast"), "there is nothing new to read");
        assert!(state.answered.is_empty() && state.map == ColumnMap::default());
        assert!(state.wrong[0].reason.contains("20fast") && state.wrong[0].reason.contains("1 N"));
        assert!(!state.answer(&question(Ask::FullScale), "much"));
        assert!(state.wrong[1].reason.contains("such as 20"), "{}", state.wrong[1].reason);
        assert!(state.answer(&question(Ask::Force), "2 N"));
        assert_eq!((state.wrong.len(), state.answered.len()), (1, 1));
        assert!(state.typed.contains_key("full_scale") && !state.typed.contains_key("force"));
        // A wrong answer takes the place of a right one.
        assert!(state.answer(&question(Ask::Force), "heavy"));
        assert!(state.answered.is_empty() && state.map.constant_force.is_none() && state.map.force.is_none());
    }

    #[test]
    fn an_answer_that_does_not_fit_a_table_is_wrong() {
        let mut state = state("a.csv", b"time,acc");
        assert!(state.answer(&question(Ask::SpeedUnit), "mm/s"));
        assert!(!state.take(outcome(None)));
        assert!(state.answer(&question(Ask::Force), "20fast"));
        assert!(state.take(outcome(Some("there is no column \"20fast\""))), "it is read without the answer");
        assert_eq!((state.wrong.len(), state.answered.len(), state.map.force.is_none()), (1, 1, true));
        assert!(state.map.speed_unit.is_some(), "other answers stay");
        // A column map that does not fit by itself is no answer.
        assert!(!state.take(outcome(Some("there is no column 9"))));
        assert_eq!(state.outcome.misfit.as_deref(), Some("there is no column 9"));
    }
}
