//! Answers: what participants respond to trials, checked against what was asked.

mod check;

pub use check::{ResponseError, check};

use crate::people::study::setup::Setup;
use crate::people::study::trial::{Side, Task, Trial};

/// Response to a task.
#[derive(Clone, Debug, PartialEq)]
pub enum Response {
    /// Group of each stimulus of a sort, from 0, in the order of the task.
    Groups(Vec<usize>),
    /// Whether each adjective of the part describes the stimulus.
    Votes(Vec<bool>),
    /// Positions of sliders, 0 to 100: one for each adjective pair of the part, for each stimulus of a page, or one between two
    /// anchors.
    Sliders(Vec<f64>),
    /// Dissimilarity, 0 or more, on a scale of the participant's own.
    Magnitude(f64),
    /// Whether two stimuli differ.
    IsDifferent(bool),
    /// The chosen alternative.
    Side(Side),
    /// Grade, from 1.
    Grade(u32),
    /// Grades of the statements of the part, from 1.
    Grades {
        /// Text from which the texture was made.
        prompt: String,
        /// One grade for each statement.
        grades: Vec<u32>,
    },
}

/// What was measured while a participant answered. Anything that was not measured is missing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measured {
    /// Time from the end of the presentation, or its start where participants explore freely, to the response, in s.
    pub response_secs: Option<f64>,
    /// Movement of the hand during the trial; `None` without contact.
    pub motion: Option<Motion>,
    /// Distance that the tip moved in contact over each stimulus, in m, in the order of [`Task::shown`]; two for the sides of
    /// a detection, one for the texture of a question.
    pub touched_m: Vec<f64>,
    /// Latency of the output, as measured last, in s.
    pub latency_secs: Option<f64>,
    /// Identifier of the actuator profile.
    pub device: String,
    /// Hash of each signal or texture that was presented, in the order of [`Task::shown`].
    pub stimulus_hashes: Vec<String>,
    /// How often each stimulus was started, in the order of [`Task::shown`].
    pub n_plays: Vec<u32>,
}

/// Movement of the hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Distance that the tip moved in contact, in m.
    pub distance_m: f64,
    /// Mean speed of the tip in contact, in m/s.
    pub mean_speed_mps: f64,
    /// Mean normal force in contact, in N.
    pub mean_force_n: f64,
}

/// An answered trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// What was asked.
    pub trial: Trial,
    /// What was answered.
    pub response: Response,
    /// What was measured meanwhile.
    pub measured: Measured,
}

/// Something that happens in a session and that its log keeps.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// The devices are these from here on.
    SetUp(Box<Setup>),
    /// The participant agreed to the consent text.
    Consented,
    /// The participant did not agree to the consent text. The session is over.
    Refused,
    /// The participant ended a break.
    Rested,
    /// The participant answered a trial.
    Answered(Box<Answer>),
    /// The session goes on after the program ended.
    Resumed,
    /// The session is over: all trials are answered.
    Ended,
}

/// All answers of a participant.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Pseudonym of the participant.
    pub participant: String,
    /// Number of the participant, from 1, which determines all orders.
    pub number: usize,
    /// Whether the participant is simulated.
    pub is_simulated: bool,
    /// Answers, in the order of the session.
    pub answers: Vec<Answer>,
    /// Setups of the devices, in the order of the session.
    pub setups: Vec<SetupFrom>,
}

/// Setup of the devices from an answer on.
#[derive(Clone, Debug, PartialEq)]
pub struct SetupFrom {
    /// Index of the first answer with it.
    pub first_answer: usize,
    /// The setup; `None` if it is not known, as after a resume by an older version of the program.
    pub setup: Option<Setup>,
}

impl Record {
    /// Record of the answers among these events. If a trial is answered twice, the first answer counts.
    pub fn of(participant: String, number: usize, is_simulated: bool, events: &[Event]) -> Self {
        let mut answers: Vec<Answer> = Vec::new();
        let mut setups: Vec<SetupFrom> = Vec::new();
        let mut seen = std::collections::BTreeSet::new();
        for event in events {
            let first_answer = answers.len();
            match event {
                Event::Answered(answer) => {
                    if seen.insert((answer.trial.part.as_str(), answer.trial.number)) {
                        answers.push(Answer::clone(answer));
                    }
                }
                Event::SetUp(setup) => {
                    setups.push(SetupFrom { first_answer, setup: Some(Setup::clone(setup)) });
                }
                // The devices may be others meanwhile.
                Event::Resumed => setups.push(SetupFrom { first_answer, setup: None }),
                Event::Consented | Event::Refused | Event::Rested | Event::Ended => {}
            }
        }
        Self { participant, number, is_simulated, answers, setups }
    }

    /// Setup of the devices at an answer, by its index; `None` if the log does not state it.
    pub fn setup_at(&self, answer: usize) -> Option<&Setup> {
        let before = self.setups.iter().rev().find(|from| from.first_answer <= answer)?;
        before.setup.as_ref()
    }
}

/// Whether a response is right; `None` for tasks without a right answer.
pub fn is_right(task: &Task, response: &Response) -> Option<bool> {
    match (task, response) {
        (Task::Detect { target, .. }, Response::Side(side)) => Some(target == side),
        (Task::Match { x, .. }, Response::Side(side)) => Some(x == side),
        (Task::Discriminate { is_different, .. }, Response::IsDifferent(answered)) => {
            Some(is_different == answered)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests;
