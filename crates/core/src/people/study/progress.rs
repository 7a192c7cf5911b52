//! Progress of a session: what comes next, from the plan and the answers so far.
//!
//! To resume a session is to [`replay`] its events. If an answer is missing, for example because its line of a log is
//! damaged, its trial is asked again. A staircase goes on from the levels that were presented.

mod error;
mod part_progress;

use std::sync::Arc;

use crate::people::study::answer::{Event, Response, check};
use crate::people::study::plan::{Plan, check_plan};
use crate::people::study::schedule::part_order;
use crate::people::study::staircase::Staircase;
use crate::people::study::trial::Trial;

pub use error::ProgressError;

use self::part_progress::PartProgress;

/// Progress of one participant.
#[derive(Clone, Debug)]
pub struct Progress {
    plan: Arc<Plan>,
    /// Number of the participant, from 1.
    participant: usize,
    /// Parts in the order of presentation.
    parts: Vec<PartProgress>,
    has_consented: bool,
    has_refused: bool,
    /// Index into `parts` of the last answer, and the number of its answers since the last break, without practice.
    since_break: (usize, usize),
}

/// What a session does next.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// Show the consent text, and go on only if the participant agrees.
    Consent,
    /// Offer a break.
    Break,
    /// Present a trial.
    Trial(Trial),
    /// Nothing: all trials are answered, or the participant did not agree to the consent text.
    Done,
}

/// Where the next trial is within the session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Index of the part in the plan.
    pub part: usize,
    /// Number of the part in the order of presentation, from 1.
    pub part_number: usize,
    /// Number of parts.
    pub n_parts: usize,
    /// Number of answered trials of the part.
    pub n_answered: usize,
    /// Number of trials of the part; `None` for a staircase, whose number depends on the answers.
    pub n_trials: Option<usize>,
    /// Whether the trial is for practice.
    pub is_practice: bool,
    /// Whether the trial is the first one after the practice.
    pub is_after_practice: bool,
}

/// A session after its events.
#[derive(Clone, Debug)]
pub struct Replayed {
    /// Progress after the events.
    pub progress: Progress,
    /// Sentences for the experimenter, one for each irregularity.
    pub warnings: Vec<String>,
}

/// What became of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// It answers the expected trial.
    Expected,
    /// It answers a trial of a staircase at another level than follows from the answers before it: one of them is missing.
    OtherLevel,
}

/// Progress after the events of a session, in their order.
///
/// # Errors
/// The plan has problems, or an answer does not belong to it. A second answer to a trial is a warning: the first one counts.
pub fn replay(plan: Arc<Plan>, participant: usize, events: &[Event]) -> Result<Replayed, ProgressError> {
    let mut progress = Progress::new(plan, participant)?;
    let mut warnings = Vec::new();
    for event in events {
        match event {
            Event::Consented => progress.consent(),
            Event::Refused => progress.refuse(),
            Event::Rested => progress.rest(),
            Event::Answered(answer) => match progress.answer(&answer.trial, &answer.response) {
                Ok(Taken::Expected) => {}
                Ok(Taken::OtherLevel) => warnings.push(format!(
                    "part \"{}\", trial {}: an answer before it is missing; the staircase goes on from this level",
                    answer.trial.part, answer.trial.number
                )),
                Err(error @ ProgressError::Twice { .. }) => warnings.push(error.to_string()),
                Err(error) => return Err(error),
            },
            Event::SetUp(_) | Event::Resumed | Event::Ended => {}
        }
    }
    Ok(Replayed { progress, warnings })
}

impl Progress {
    /// Session before its first answer. Participants are numbered from 1.
    ///
    /// # Errors
    /// [`ProgressError::Plan`] if the plan has problems, [`ProgressError::Participant`] for the number 0.
    pub fn new(plan: Arc<Plan>, participant: usize) -> Result<Self, ProgressError> {
        if participant == 0 {
            return Err(ProgressError::Participant);
        }
        check_plan(&plan)?;
        let parts = part_order(&plan, participant)
            .into_iter()
            .map(|index| PartProgress::new(&plan, index, participant))
            .collect();
        let (has_consented, has_refused) = (false, false);
        Ok(Self { plan, participant, parts, has_consented, has_refused, since_break: (0, 0) })
    }

    /// The plan.
    pub fn plan(&self) -> &Arc<Plan> {
        &self.plan
    }

    /// Number of the participant, from 1.
    pub fn participant(&self) -> usize {
        self.participant
    }

    /// What comes next.
    pub fn step(&self) -> Step {
        if !self.has_consented && !self.has_refused && !self.plan.consent.trim().is_empty() {
            return Step::Consent;
        }
        match self.next_trial() {
            None => Step::Done,
            Some((position, _)) if self.is_break_due(position) => Step::Break,
            Some((_, trial)) => Step::Trial(trial),
        }
    }

    /// Where the next trial is; `None` if there is none.
    pub fn place(&self) -> Option<Place> {
        let (position, trial) = self.next_trial()?;
        let part = &self.parts[position];
        let n_practice = self.plan.parts[part.index()].n_practice;
        Some(Place {
            part: part.index(),
            part_number: position + 1,
            n_parts: self.parts.len(),
            n_answered: part.n_answered(),
            n_trials: part.n_trials(),
            is_practice: trial.is_practice,
            is_after_practice: n_practice > 0 && trial.number == n_practice + 1,
        })
    }

    /// The participant agrees to the consent text.
    pub fn consent(&mut self) {
        self.has_consented = true;
    }

    /// The participant does not agree to the consent text, so that no trial follows.
    pub fn refuse(&mut self) {
        self.has_refused = true;
    }

    /// Whether the participant did not agree to the consent text.
    pub fn has_refused(&self) -> bool {
        self.has_refused
    }

    /// The participant ends a break.
    pub fn rest(&mut self) {
        self.since_break.1 = 0;
    }

    /// Takes the answer to a trial, which is usually the next one.
    ///
    /// # Errors
    /// The trial is not one of this session, it is answered already, or the response does not answer it. The progress is then
    /// unchanged.
    pub fn answer(&mut self, trial: &Trial, response: &Response) -> Result<Taken, ProgressError> {
        let is_of = |part: &PartProgress| self.plan.parts[part.index()].id == trial.part;
        let Some(position) = self.parts.iter().position(is_of) else {
            return Err(ProgressError::UnknownPart { part: trial.part.clone() });
        };
        let index = self.parts[position].index();
        check(response, &trial.task, &self.plan.parts[index].design).map_err(|source| {
            ProgressError::Response { part: trial.part.clone(), number: trial.number, source }
        })?;
        let taken = self.parts[position].answer(&self.plan, self.participant, trial, response)?;
        let n_before = if self.since_break.0 == position { self.since_break.1 } else { 0 };
        self.since_break = (position, n_before + usize::from(!trial.is_practice));
        Ok(taken)
    }

    /// Staircases of a part, by its index in the plan; none if it has another design.
    pub fn staircases(&self, part: usize) -> &[Staircase] {
        self.parts.iter().find(|of| of.index() == part).map_or(&[][..], PartProgress::staircases)
    }

    /// Index into `parts`, and the trial.
    fn next_trial(&self) -> Option<(usize, Trial)> {
        if self.has_refused {
            return None;
        }
        let next = |(position, part): (usize, &PartProgress)| {
            Some((position, part.next(&self.plan, self.participant)?))
        };
        self.parts.iter().enumerate().find_map(next)
    }

    fn is_break_due(&self, position: usize) -> bool {
        let every = self.plan.parts[self.parts[position].index()].break_every;
        self.since_break.0 == position && every.is_some_and(|n| self.since_break.1 >= n)
    }
}

#[cfg(test)]
mod tests;
