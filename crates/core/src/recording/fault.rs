//! Why a recording as a file holds it cannot be used.

use std::fmt;

use crate::recording::Finding;
use crate::recording::missing::SPEED;

/// Lowest rate that a model can be fitted at.
pub const MIN_RATE_HZ: f64 = 500.0;
/// Highest rate of a recording.
pub const MAX_RATE_HZ: f64 = 48_000.0;
/// Shortest recording that says anything, in seconds of usable samples.
pub const MIN_USABLE_SECS: f64 = 0.1;

/// Something that keeps a recording from being used.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// There is no row at all, or only one.
    TooFewRows {
        /// How many there are.
        n_rows: usize,
    },
    /// There is no axis of acceleration.
    NoAcceleration,
    /// Nobody measured or said the speed.
    NoSpeed,
    /// Nobody measured or said the force.
    NoForce,
    /// A column has another number of rows than the clock, or than the first axis of acceleration.
    UnequalColumns {
        /// The column.
        column: String,
        /// Its rows.
        n_rows: usize,
        /// The rows of the recording.
        of_rows: usize,
    },
    /// The rate is below [`MIN_RATE_HZ`].
    RateTooLow {
        /// The rate, in Hz.
        rate_hz: f64,
    },
    /// The rate is above [`MAX_RATE_HZ`], or no number.
    RateTooHigh {
        /// The rate, in Hz.
        rate_hz: f64,
    },
    /// The timestamps are no clock: what happened between the rows cannot be worked out.
    BadClock {
        /// What is wrong with them.
        reason: String,
    },
    /// A quantity that was said to be constant has no meaning.
    BadConstant {
        /// The quantity, with its unit.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The highest that it can have.
        most: f64,
    },
    /// No axis of acceleration ever changes.
    NoSignal {
        /// Whether all of them are 0.
        is_zero: bool,
    },
    /// Positions change faster than anything that could have been measured.
    ImpossibleSpeed {
        /// The highest speed, in m/s.
        most_mps: f64,
    },
    /// Too little is left of the recording when what cannot be used is taken away.
    NothingUsable {
        /// What is left, in seconds.
        usable_secs: f64,
    },
}

/// All that keeps a recording from being used, and what else was found on the way, which is not part of the sentence.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub struct RecordingError {
    /// At least one.
    pub faults: Vec<Fault>,
    /// What else is not as it should be.
    pub findings: Vec<Finding>,
}

impl Fault {
    /// A short name that scripts can look for.
    pub fn name(&self) -> &'static str {
        match self {
            Self::TooFewRows { .. } => "too few rows",
            Self::NoAcceleration => "no acceleration",
            Self::NoSpeed => "no speed",
            Self::NoForce => "no force",
            Self::UnequalColumns { .. } => "unequal columns",
            Self::RateTooLow { .. } => "rate too low",
            Self::RateTooHigh { .. } => "rate too high",
            Self::BadClock { .. } => "bad clock",
            Self::BadConstant { .. } => "bad constant",
            Self::NoSignal { .. } => "no signal",
            Self::ImpossibleSpeed { .. } => "impossible speed",
            Self::NothingUsable { .. } => "nothing usable",
        }
    }
}

impl Fault {
    /// Whether it is the reason that too little is usable, so that this needs not be said.
    pub(super) fn leaves_nothing(&self) -> bool {
        matches!(self, Self::NoSignal { .. } | Self::RateTooHigh { .. } | Self::TooFewRows { .. })
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.name())?;
        match self {
            Self::TooFewRows { n_rows } => write!(f, "{n_rows} rows are no recording"),
            Self::NoAcceleration => write!(f, "a recording needs one to three axes of acceleration"),
            Self::NoSpeed => write!(f, "record the speed or the positions too, or say the constant speed"),
            Self::NoForce => write!(f, "record the normal force too, or say the constant force"),
            Self::UnequalColumns { column, n_rows, of_rows } => {
                write!(f, "{column} has {n_rows} rows, the recording {of_rows}")
            }
            Self::RateTooLow { rate_hz } => {
                write!(
                    f,
                    "{} Hz, a model needs at least {MIN_RATE_HZ} Hz; correct the unit of time or the rate if one is wrong, else record faster",
                    tenths(*rate_hz)
                )
            }
            Self::RateTooHigh { rate_hz } => {
                write!(
                    f,
                    "{} Hz, at most {MAX_RATE_HZ} Hz are read; correct the unit of time or the rate if one is wrong, else resample the recording",
                    tenths(*rate_hz)
                )
            }
            Self::BadClock { reason } => {
                write!(f, "{reason}; record with a clock of the sensor, or state the rate if it is known")
            }
            Self::BadConstant { what, value, most } => {
                write!(f, "{what} is {}, needs a number from 0 to {most}", micro(*value))
            }
            Self::NoSignal { is_zero } => {
                let value = if *is_zero { "is 0" } else { "has one value" };
                write!(f, "acceleration {value} in every row; check the sensor, its cable and the column")
            }
            Self::ImpossibleSpeed { most_mps } => {
                write!(
                    f,
                    "by its positions the tip reaches {most_mps:.0} m/s, at most {} m/s can be; correct the unit of the positions or of time",
                    SPEED.most
                )
            }
            Self::NothingUsable { usable_secs } => {
                write!(
                    f,
                    "{usable_secs:.3} s are left without what cannot be used, needs at least {MIN_USABLE_SECS} s; record longer, or correct what was found"
                )
            }
        }
    }
}

impl fmt::Display for RecordingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sentences: Vec<String> = self.faults.iter().map(Fault::to_string).collect();
        f.write_str(&sentences.join("; "))
    }
}

/// Rounded to tenths, so that a measured rate reads as a person says it.
fn tenths(value: f64) -> f64 {
    (10.0 * value).round() / 10.0
}

/// Rounded to millionths, so that a converted number has no dust.
pub(super) fn micro(value: f64) -> f64 {
    (1e6 * value).round() * 1e-6
}
