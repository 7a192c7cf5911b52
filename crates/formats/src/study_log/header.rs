//! First line of a log.

use serde::{Deserialize, Serialize};
use shagreen_core::people::panel::is_simulated;

use super::{FORMAT, VERSION};
use crate::project::sha256_hex;

/// Who takes part in which study.
#[derive(Clone, Debug, PartialEq)]
pub struct LogHeader {
    participant: String,
    number: usize,
    is_simulated: bool,
    seed: u64,
    program: String,
    unix_secs: f64,
    plan_text: String,
}

/// Longest pseudonym, in characters.
const MAX_PSEUDONYM: usize = 40;

/// Why a session cannot have such a header.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LogHeaderError {
    /// The pseudonym has other characters.
    #[error(
        "\"{participant}\" is not a pseudonym; use up to {MAX_PSEUDONYM} letters, digits and hyphens, such as p03, and never a name"
    )]
    Pseudonym {
        /// The pseudonym given.
        participant: String,
    },
    /// The pseudonym and the kind of participant disagree.
    #[error(
        "the name \"{participant}\" of a participant contains \"simulated\" exactly if the participant is; choose another name"
    )]
    Simulated {
        /// The pseudonym given.
        participant: String,
    },
    /// The participant has no number.
    #[error("participants are numbered from 1; choose a number of 1 or more")]
    Number,
}

impl LogHeader {
    /// Header of a session. `seed` is that of the plan, or that of the simulation; `plan_text` is the plan file.
    ///
    /// # Errors
    /// See [`LogHeaderError`].
    pub fn new(
        participant: &str,
        number: usize,
        is_simulated_participant: bool,
        seed: u64,
        program: &str,
        unix_secs: f64,
        plan_text: &str,
    ) -> Result<Self, LogHeaderError> {
        let is_allowed = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if participant.is_empty() || participant.len() > MAX_PSEUDONYM || !participant.chars().all(is_allowed)
        {
            return Err(LogHeaderError::Pseudonym { participant: participant.to_owned() });
        }
        if is_simulated(participant) != is_simulated_participant {
            return Err(LogHeaderError::Simulated { participant: participant.to_owned() });
        }
        if number == 0 {
            return Err(LogHeaderError::Number);
        }
        Ok(Self {
            participant: participant.to_owned(),
            number,
            is_simulated: is_simulated_participant,
            seed,
            program: program.to_owned(),
            unix_secs,
            plan_text: plan_text.to_owned(),
        })
    }

    /// Pseudonym of the participant.
    pub fn participant(&self) -> &str {
        &self.participant
    }

    /// Number of the participant, from 1, which determines all orders.
    pub fn number(&self) -> usize {
        self.number
    }

    /// Whether the participant is simulated.
    pub fn is_simulated(&self) -> bool {
        self.is_simulated
    }

    /// Seed of the plan, or of the simulation.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// Name and version of the program that began the session.
    pub fn program(&self) -> &str {
        &self.program
    }

    /// Begin of the session, in s since 1970 (Unix time).
    pub fn unix_secs(&self) -> f64 {
        self.unix_secs
    }

    /// The plan file.
    pub fn plan_text(&self) -> &str {
        &self.plan_text
    }

    /// Hash of the plan file (SHA-256, hexadecimal), which all sessions of a study share.
    pub fn plan_sha256(&self) -> String {
        sha256_hex(self.plan_text.as_bytes())
    }
}

/// The first line of a log, and its copy, without line breaks.
pub(super) fn header_lines(header: &LogHeader) -> [Vec<u8>; 2] {
    // Keys are strings, and numbers that are not finite become null.
    let line = serde_json::to_vec(&HeaderV1::of(header)).unwrap_or_default();
    [line.clone(), line]
}

#[derive(Serialize, Deserialize)]
pub(super) struct HeaderV1 {
    format: String,
    version: String,
    participant: String,
    number: usize,
    simulated: bool,
    seed: u64,
    program: String,
    unix_s: f64,
    pub(super) plan_sha256: String,
    plan: String,
}

impl HeaderV1 {
    fn of(header: &LogHeader) -> Self {
        Self {
            format: FORMAT.to_owned(),
            version: VERSION.to_owned(),
            participant: header.participant.clone(),
            number: header.number,
            simulated: header.is_simulated,
            seed: header.seed,
            program: header.program.clone(),
            unix_s: header.unix_secs,
            plan_sha256: header.plan_sha256(),
            plan: header.plan_text.clone(),
        }
    }

    pub(super) fn into_header(self) -> Result<LogHeader, LogHeaderError> {
        let Self { participant, number, simulated, seed, program, unix_s, plan, .. } = self;
        LogHeader::new(&participant, number, simulated, seed, &program, unix_s, &plan)
    }
}
