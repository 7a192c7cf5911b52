//! Simulated participants of a study: they answer every design from hidden positions of the stimuli.
//!
//! They test a plan before people are invited, and estimate how many people it needs; nothing else follows from their
//! answers. They are named `simulated-01` and so on. Their perception is a model with chosen numbers: a position in a
//! [`World`], noise, habits on each scale, a threshold, and lapses, in which they guess.

mod anchors;
mod ends;
mod observers;
mod participant;
mod world;

use std::sync::Arc;

use crate::people::panel::simulated_name;
use crate::people::study::answer::{Answer, Event, Measured, Motion, Record};
use crate::people::study::plan::Plan;
use crate::people::study::progress::{Progress, ProgressError, Step};
use crate::people::study::touch::n_touched;
use crate::people::study::trial::Trial;

pub use observers::Observers;
pub use participant::SimulatedParticipant;
pub use world::World;

/// Reasons why a study cannot be simulated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimulationError {
    /// The plan cannot be run.
    #[error(transparent)]
    Progress(#[from] ProgressError),
    /// A parameter of the observers is out of range.
    #[error("{what} of the simulated participants is {value}; it must be from {low} to {high}")]
    Observers {
        /// Name of the parameter.
        what: &'static str,
        /// Its value.
        value: f64,
        /// Lowest possible value.
        low: f64,
        /// Highest possible value.
        high: f64,
    },
    /// A stimulus has no position, or one with a wrong number of coordinates.
    #[error(
        "stimulus \"{stimulus}\" has {n} coordinates, but the simulated world has {n_dimensions} dimensions; give one for each"
    )]
    Position {
        /// Identifier of the stimulus.
        stimulus: String,
        /// Number of its coordinates.
        n: usize,
        /// Number of dimensions.
        n_dimensions: usize,
    },
}

/// Device that measurements of simulated participants name.
pub const SIMULATED_DEVICE: &str = "simulated";

/// Distance that simulated participants move over each stimulus, in m, or more if the part requires more.
const STROKE_M: f64 = 0.125;
/// Speed in m/s and force in N of their strokes.
const STROKE_SPEED_MPS: f64 = 0.125;
const STROKE_FORCE_N: f64 = 1.0;

/// Events of the whole session of one simulated participant, numbered from 1. The same seed gives the same events.
///
/// # Errors
/// See [`SimulationError`].
pub fn simulated_session(
    plan: &Arc<Plan>,
    world: &World,
    observers: &Observers,
    number: usize,
    seed: u64,
) -> Result<Vec<Event>, SimulationError> {
    let mut progress = Progress::new(Arc::clone(plan), number)?;
    let mut participant = SimulatedParticipant::new(plan, world, *observers, number, seed)?;
    let mut events = Vec::new();
    loop {
        match progress.step() {
            Step::Consent => {
                progress.consent();
                events.push(Event::Consented);
            }
            Step::Break => {
                progress.rest();
                events.push(Event::Rested);
            }
            Step::Trial(trial) => {
                let answer = participant.answer(trial);
                progress.answer(&answer.trial, &answer.response)?;
                events.push(Event::Answered(Box::new(answer)));
            }
            Step::Done => {
                events.push(Event::Ended);
                return Ok(events);
            }
        }
    }
}

/// Records of a study with this number of simulated participants.
///
/// # Errors
/// See [`SimulationError`].
pub fn simulated_study(
    plan: &Arc<Plan>,
    world: &World,
    observers: &Observers,
    n_participants: usize,
    seed: u64,
) -> Result<Vec<Record>, SimulationError> {
    let record = |number: usize| -> Result<Record, SimulationError> {
        let events = simulated_session(plan, world, observers, number, seed)?;
        Ok(Record::of(simulated_name(number), number, true, &events))
    };
    (1..=n_participants).map(record).collect()
}

impl SimulatedParticipant<'_> {
    /// Answers a trial of the plan, with a response time, and with one play and one stroke of each stimulus.
    pub fn answer(&mut self, trial: Trial) -> Answer {
        let response = self.respond(&trial);
        let distance_m = STROKE_M.max(1e-3 * self.required_mm(&trial));
        let touched_m = vec![distance_m; n_touched(&trial.task)];
        let measured = Measured {
            response_secs: Some(self.response_secs()),
            motion: Some(Motion {
                distance_m: touched_m.iter().sum(),
                mean_speed_mps: STROKE_SPEED_MPS,
                mean_force_n: STROKE_FORCE_N,
            }),
            touched_m,
            device: SIMULATED_DEVICE.to_owned(),
            n_plays: vec![1; trial.task.shown().len()],
            ..Measured::default()
        };
        Answer { trial, response, measured }
    }
}

#[cfg(test)]
mod tests;
