//! AHAP patterns: events with parameters, and curves that change them, as the haptic engine of phones by Apple reads them.
//!
//! Intensities and sharpnesses are from 0 to 1, without a unit. Readers treat an intensity as the root of an amplitude
//! ([`of_clip`]). A curve acts on all events of its pattern, so short events that must not change have a pattern of their own.

mod file;
pub mod of_clip;
mod parameter_ids;

pub use self::parameter_ids::{ControlId, EventParameterId};

use self::file::PatternFileV1;
use crate::first_faults::FirstFaults;
use crate::imported::Imported;
use crate::layout;
use crate::own_json::check_density;
use crate::parser_words::plain;

/// Longest continuous event that players accept, in s.
pub const MAX_EVENT_SECS: f64 = 30.0;
/// Largest number of points of a curve that is written. Sources disagree on the limit of players; this is the lowest that one
/// of them states.
pub const MAX_CURVE_POINTS: usize = 16;
/// Levels of objects and lists that are written over several lines: one line for each event or curve.
const OPEN_DEPTH: usize = 2;

/// A pattern.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AhapPattern {
    /// Events in the order of the file.
    pub events: Vec<AhapEvent>,
    /// Curves of parameters, in the order of the file.
    pub curves: Vec<ParameterCurve>,
    /// Single changes of parameters, in the order of the file.
    pub parameters: Vec<DynamicParameter>,
}

/// An event.
#[derive(Clone, Debug, PartialEq)]
pub struct AhapEvent {
    /// Its kind.
    pub kind: AhapEventKind,
    /// Time at which it begins, in s, at least 0.
    pub time_secs: f64,
    /// Duration in s, at least 0. It has a meaning for continuous events only.
    pub duration_secs: f64,
    /// Parameters that are set, each within its range ([`EventParameterId::range`]).
    pub parameters: Vec<(EventParameterId, f64)>,
}

/// Kind of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AhapEventKind {
    /// Short tap.
    HapticTransient,
    /// Vibration that lasts.
    HapticContinuous,
    /// Tone.
    AudioContinuous,
    /// Sound from a file.
    AudioCustom,
}

/// Change of a parameter over time, linear between points. Before the first point the parameter is neutral; after the last one
/// it keeps that value.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterCurve {
    /// The parameter.
    pub id: ControlId,
    /// Start of the curve in s, at least 0.
    pub time_secs: f64,
    /// Points in the order of their times, at least one.
    pub points: Vec<ControlPoint>,
}

/// Point of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoint {
    /// Time from the start of the curve in s, at least 0.
    pub time_secs: f64,
    /// Value within the range of the parameter ([`ControlId::range`]).
    pub value: f64,
}

/// Value that a parameter has from a time on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DynamicParameter {
    /// The parameter.
    pub id: ControlId,
    /// The time in s, at least 0.
    pub time_secs: f64,
    /// Value within the range of the parameter.
    pub value: f64,
}

/// Why bytes are no pattern. Entries are numbered from 1 in the order of the list `Pattern`.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AhapError {
    /// The bytes are not JSON, or fields are missing.
    #[error("the file is not an AHAP pattern: {0}. Export the pattern again")]
    Json(String),
    /// The file has more values than a pattern of its length.
    #[error(
        "the file is not an AHAP pattern: it has too many values for its {n_bytes} bytes. Export the pattern again"
    )]
    TooDense {
        /// Length of the file in bytes.
        n_bytes: usize,
    },
    /// Another version.
    #[error("the pattern has version {version}, but only version 1 can be read; export it as version 1")]
    Version {
        /// Version of the file.
        version: f64,
    },
    /// An entry is no event, no parameter and no curve, or several of them.
    #[error(
        "entry {number} of \"Pattern\" must have one of \"Event\", \"Parameter\" and \"ParameterCurve\"; correct its name, or remove it"
    )]
    Entry {
        /// Number of the entry.
        number: usize,
    },
    /// An event has an unknown kind.
    #[error(
        "entry {number} of \"Pattern\" has the event type \"{kind}\"; use HapticTransient, HapticContinuous, AudioContinuous or AudioCustom"
    )]
    Kind {
        /// Number of the entry.
        number: usize,
        /// First characters of the type.
        kind: String,
    },
    /// A time or duration is negative or not finite.
    #[error(
        "entry {number} of \"Pattern\" has a time or duration of {secs} s, but must be at 0 or later; correct it"
    )]
    Time {
        /// Number of the entry.
        number: usize,
        /// The time in s.
        secs: f64,
    },
    /// A point of a curve is earlier than the one before it.
    #[error(
        "entry {number} of \"Pattern\": point {point} of the curve is at {secs} s, which is before the previous point; sort the points by time"
    )]
    Order {
        /// Number of the entry.
        number: usize,
        /// Number of the point, the first 1.
        point: usize,
        /// Its time in s.
        secs: f64,
    },
}

impl AhapPattern {
    /// Reads a pattern. Missing times and durations are 0, and values outside their range are clamped. A warning names what was
    /// clamped or ignored, and a curve whose times seem to be counted from the start of the pattern.
    ///
    /// # Errors
    /// The bytes are no pattern, or an entry is not one that players know.
    pub fn from_json(bytes: &[u8]) -> Result<Imported<Self>, AhapError> {
        let (read, faults) = Self::with_faults(bytes)?;
        faults.or_first(read)
    }

    /// Reads the entries of a pattern as [`AhapPattern::from_json`] does, and returns the faults of the others: of each entry the
    /// first.
    ///
    /// # Errors
    /// The bytes are no pattern of version 1.
    pub fn with_faults(bytes: &[u8]) -> Result<(Imported<Self>, FirstFaults<AhapError>), AhapError> {
        check_density(bytes).map_err(|_| AhapError::TooDense { n_bytes: bytes.len() })?;
        let damaged = |error: serde_json::Error| AhapError::Json(plain(&error.to_string()));
        let file: PatternFileV1 = serde_json::from_slice(bytes).map_err(damaged)?;
        file.pattern()
    }

    /// Returns the bytes of a file: curves, parameters, then events. Players ignore the description.
    pub fn to_json(&self, description: &str) -> Vec<u8> {
        layout::to_bytes(&PatternFileV1::of(self, description), OPEN_DEPTH)
    }

    /// End of the last event in s; 0 without events.
    pub fn end_secs(&self) -> f64 {
        self.events.iter().map(|event| event.time_secs + event.duration_secs).fold(0.0, f64::max)
    }
}

impl AhapEvent {
    /// Value of a parameter, or `None` if the event does not set it.
    pub fn value(&self, id: EventParameterId) -> Option<f64> {
        self.parameters.iter().find(|(known, _)| *known == id).map(|(_, value)| *value)
    }
}

#[cfg(test)]
mod tests;
