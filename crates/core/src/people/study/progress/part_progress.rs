//! Progress within one part.

use crate::maths::rng::Random;
use crate::people::study::answer::{Response, is_right};
use crate::people::study::plan::{Design, Part, Plan};
use crate::people::study::progress::{ProgressError, Taken};
use crate::people::study::schedule::{trial_seed, trials};
use crate::people::study::staircase::Staircase;
use crate::people::study::trial::{Side, Task, Trial};

/// Progress within one part.
#[derive(Clone, Debug)]
pub(super) struct PartProgress {
    /// Index of the part in the plan.
    index: usize,
    state: State,
}

#[derive(Clone, Debug)]
enum State {
    /// Trials that are known from the beginning, and whether each is answered.
    Fixed { trials: Vec<Trial>, is_answered: Vec<bool> },
    /// Staircases, one after the other, and the highest number of an answered trial.
    Adaptive { staircases: Vec<Staircase>, last: usize },
}

impl PartProgress {
    pub(super) fn new(plan: &Plan, index: usize, participant: usize) -> Self {
        let part = &plan.parts[index];
        let state = if let Design::Staircase { rule, .. } = &part.design {
            State::Adaptive { staircases: vec![Staircase::new(rule.clone()); part.n_repeats], last: 0 }
        } else {
            let trials = trials(plan, part, participant);
            State::Fixed { is_answered: vec![false; trials.len()], trials }
        };
        Self { index, state }
    }

    pub(super) fn index(&self) -> usize {
        self.index
    }

    /// Number of answered trials; for a staircase, the number of the last one.
    pub(super) fn n_answered(&self) -> usize {
        match &self.state {
            State::Fixed { is_answered, .. } => {
                is_answered.iter().filter(|is_answered| **is_answered).count()
            }
            State::Adaptive { last, .. } => *last,
        }
    }

    pub(super) fn n_trials(&self) -> Option<usize> {
        match &self.state {
            State::Fixed { trials, .. } => Some(trials.len()),
            State::Adaptive { .. } => None,
        }
    }

    pub(super) fn staircases(&self) -> &[Staircase] {
        match &self.state {
            State::Fixed { .. } => &[],
            State::Adaptive { staircases, .. } => staircases,
        }
    }

    /// The first trial without an answer.
    pub(super) fn next(&self, plan: &Plan, participant: usize) -> Option<Trial> {
        match &self.state {
            State::Fixed { trials, is_answered } => {
                let open = is_answered.iter().position(|is_answered| !is_answered)?;
                Some(trials[open].clone())
            }
            State::Adaptive { staircases, last } => {
                let part = &plan.parts[self.index];
                let number = last + 1;
                // Practice is at the level of the start.
                let track = if number <= part.n_practice {
                    0
                } else {
                    staircases.iter().position(|of| !of.is_over())?
                };
                Some(detection(plan, part, participant, number, (track, staircases.get(track)?)))
            }
        }
    }

    /// Takes an answer that is checked against its task.
    pub(super) fn answer(
        &mut self,
        plan: &Plan,
        participant: usize,
        trial: &Trial,
        response: &Response,
    ) -> Result<Taken, ProgressError> {
        let (part, number) = (trial.part.clone(), trial.number);
        match &mut self.state {
            State::Fixed { trials, is_answered } => {
                let index = number.checked_sub(1).filter(|index| trials.get(*index) == Some(trial));
                let Some(index) = index else { return Err(ProgressError::OtherTrial { part, number }) };
                if std::mem::replace(&mut is_answered[index], true) {
                    return Err(ProgressError::Twice { part, number });
                }
                Ok(Taken::Expected)
            }
            State::Adaptive { staircases, last } => {
                if number <= *last {
                    return Err(ProgressError::Twice { part, number });
                }
                let of_plan = &plan.parts[self.index];
                let is_practice = number <= of_plan.n_practice;
                let seed = trial_seed(plan, of_plan, participant, number);
                let right = is_right(&trial.task, response);
                let (Task::Detect { track, level, target, .. }, Some(right)) = (&trial.task, right) else {
                    return Err(ProgressError::OtherTrial { part, number });
                };
                let is_of_plan =
                    trial.is_practice == is_practice && trial.seed == seed && *target == target_of(seed);
                let Some(staircase) = staircases.get_mut(*track).filter(|_| is_of_plan) else {
                    return Err(ProgressError::OtherTrial { part, number });
                };
                *last = number;
                if is_practice || staircase.answer(*level, right) {
                    Ok(Taken::Expected)
                } else {
                    Ok(Taken::OtherLevel)
                }
            }
        }
    }
}

/// The trial of this number at the level of a staircase, which comes with its index.
fn detection(
    plan: &Plan,
    part: &Part,
    participant: usize,
    number: usize,
    (track, staircase): (usize, &Staircase),
) -> Trial {
    let seed = trial_seed(plan, part, participant, number);
    let is_practice = number <= part.n_practice;
    let n_taught = match &part.design {
        Design::Staircase { feedback_reversals, .. } => *feedback_reversals,
        _ => 0,
    };
    let has_feedback = is_practice || staircase.reversals().len() < n_taught;
    let task = Task::Detect { track, level: staircase.level(), target: target_of(seed), has_feedback };
    Trial { part: part.id.clone(), number, is_practice, seed, task }
}

/// Where the target of a trial is.
fn target_of(seed: u64) -> Side {
    Side::second_if(Random::new(seed).below(2) == 1)
}
