//! Why a session cannot go on with an answer.

use crate::people::study::answer::ResponseError;
use crate::people::study::plan::PlanError;

/// Reasons why a session cannot begin, or cannot take an answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProgressError {
    /// The plan has problems.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The participant has no number.
    #[error("participants are numbered from 1; choose a number of 1 or more")]
    Participant,
    /// The plan has no such part.
    #[error("there is no part \"{part}\" in the plan; use the plan with which the session began")]
    UnknownPart {
        /// Identifier of the part.
        part: String,
    },
    /// The trial differs from the one that the plan gives this participant.
    #[error(
        "part \"{part}\", trial {number} is not what the plan gives this participant; use the plan, the number of the participant and the version of the program with which the session began"
    )]
    OtherTrial {
        /// Identifier of the part.
        part: String,
        /// Number of the trial.
        number: usize,
    },
    /// The trial is answered already.
    #[error("part \"{part}\", trial {number} is answered twice; the first answer counts")]
    Twice {
        /// Identifier of the part.
        part: String,
        /// Number of the trial.
        number: usize,
    },
    /// The response does not answer the trial.
    #[error("part \"{part}\", trial {number}: {source}")]
    Response {
        /// Identifier of the part.
        part: String,
        /// Number of the trial.
        number: usize,
        /// What is wrong.
        source: ResponseError,
    },
}
