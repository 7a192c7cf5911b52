//! Faults: reasons why a recording cannot be used.

use std::fmt;

use crate::recording::Finding;
use crate::recording::bounds::SPEED;
use crate::recording::finding::micro;

/// Lowest sample rate at which a model can be fitted, in Hz.
pub const MIN_RATE_HZ: f64 = 500.0;
/// Highest sample rate of a recording, in Hz.
pub const MAX_RATE_HZ: f64 = 48_000.0;
/// Shortest usable recording, in seconds of valid samples.
pub const MIN_USABLE_SECS: f64 = 0.1;

/// Fault that prevents the use of a recording.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// The recording has fewer than two rows.
    TooFewRows {
        /// Number of rows.
        n_rows: usize,
    },
    /// There is no axis of acceleration.
    NoAcceleration,
    /// Three axes of acceleration are required, but the recording has another number.
    NotThreeAxes {
        /// Number of axes of the recording.
        n_axes: usize,
    },
    /// There is no speed: no column, and no constant.
    NoSpeed,
    /// There is no force: no column, and no constant.
    NoForce,
    /// A column has another number of rows than the clock or the first axis of acceleration.
    UnequalColumns {
        /// Name of the column.
        column: String,
        /// Number of rows of the column.
        n_rows: usize,
        /// Number of rows of the recording.
        of_rows: usize,
    },
    /// The sample rate is below [`MIN_RATE_HZ`].
    RateTooLow {
        /// Sample rate in Hz.
        rate_hz: f64,
    },
    /// The sample rate is above [`MAX_RATE_HZ`] or not finite.
    RateTooHigh {
        /// Sample rate in Hz.
        rate_hz: f64,
    },
    /// The timestamps do not form a clock, so the samples cannot be interpolated.
    BadClock {
        /// What is wrong with the timestamps.
        reason: String,
    },
    /// A constant quantity is out of range.
    BadConstant {
        /// Name of the quantity, with its unit.
        what: &'static str,
        /// Value of the quantity.
        value: f64,
        /// Highest valid value.
        most: f64,
    },
    /// All axes of acceleration are constant.
    NoSignal {
        /// Whether all of them are 0.
        is_zero: bool,
    },
    /// The positions imply an impossible tip speed.
    ImpossibleSpeed {
        /// Highest tip speed, in m/s.
        most_mps: f64,
    },
    /// The valid samples are too short after unusable ones are removed.
    NothingUsable {
        /// Duration of the valid samples, in seconds.
        usable_secs: f64,
    },
}

/// Faults of a recording, and the findings so far; the error message lists the faults only.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub struct RecordingError {
    /// Faults, at least one.
    pub faults: Vec<Fault>,
    /// Findings collected before the conversion stopped.
    pub findings: Vec<Finding>,
}

impl Fault {
    /// Short name, stable for scripts.
    pub fn name(&self) -> &'static str {
        match self {
            Self::TooFewRows { .. } => "too few rows",
            Self::NoAcceleration => "no acceleration",
            Self::NotThreeAxes { .. } => "not three axes",
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
    /// Whether this fault explains why too little is usable, so that [`Fault::NothingUsable`] is redundant.
    pub(super) fn leaves_nothing(&self) -> bool {
        matches!(self, Self::NoSignal { .. } | Self::RateTooHigh { .. } | Self::TooFewRows { .. })
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.name())?;
        match self {
            Self::TooFewRows { n_rows } => {
                write!(f, "a recording needs at least 2 rows with different times, got {n_rows}")
            }
            Self::NoAcceleration => write!(f, "a recording needs one to three columns of acceleration"),
            Self::NotThreeAxes { n_axes } => {
                write!(
                    f,
                    "three columns of acceleration are needed, but the recording has {n_axes}; name all three in a column map, or record three axes"
                )
            }
            Self::NoSpeed => write!(f, "add a column of speed or positions, or give a constant speed"),
            Self::NoForce => write!(f, "add a column of normal force, or give a constant force"),
            Self::UnequalColumns { column, n_rows, of_rows } => {
                write!(
                    f,
                    "{column} has {n_rows} rows, but the recording has {of_rows}; all columns need the same number of rows"
                )
            }
            Self::RateTooLow { rate_hz } => {
                write!(
                    f,
                    "{} Hz, a model needs at least {MIN_RATE_HZ} Hz; correct the unit of time or the rate if one is wrong, or else record at a higher rate",
                    tenths(*rate_hz)
                )
            }
            Self::RateTooHigh { rate_hz } => {
                write!(
                    f,
                    "{} Hz, at most {MAX_RATE_HZ} Hz is supported; correct the unit of time or the rate if one is wrong, or else resample the recording",
                    tenths(*rate_hz)
                )
            }
            Self::BadClock { reason } => {
                write!(
                    f,
                    "{reason}; record the timestamps of the sensor, or give the sample rate if it is known"
                )
            }
            Self::BadConstant { what, value, most } => {
                write!(f, "{what} is {}; it must lie between 0 and {most}", micro(*value))
            }
            Self::NoSignal { is_zero } => {
                let value = if *is_zero { "is 0" } else { "has the same value" };
                write!(f, "acceleration {value} in every row; check the sensor, its cable and the column")
            }
            Self::ImpossibleSpeed { most_mps } => {
                write!(
                    f,
                    "the tip speed computed from the positions reaches {most_mps:.0} m/s, but at most {} m/s is possible; correct the unit of the positions or of time",
                    SPEED.most
                )
            }
            Self::NothingUsable { usable_secs } => {
                write!(
                    f,
                    "only {usable_secs:.3} s are usable, at least {MIN_USABLE_SECS} s are needed; record longer, or correct the reported problems"
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

/// Rounds to tenths, for readable sample rates in messages.
fn tenths(value: f64) -> f64 {
    (10.0 * value).round() / 10.0
}
