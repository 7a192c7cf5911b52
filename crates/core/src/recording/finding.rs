//! What is not as it should be in a recording, by name.

use std::fmt;

use crate::recording::fault::micro;

/// How much of a recording something concerns, and where it happens first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Where {
    /// How many rows.
    pub n_rows: usize,
    /// Of how many.
    pub of_rows: usize,
    /// Time of the first, in seconds from the start of the recording.
    pub first_secs: f64,
}

/// Something about a recording that its owner should know. None of it was mended silently: what a finding does to the
/// data is part of its sentence.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// Rows have the same time as the row before; the first of each is kept.
    RepeatedTimes(Where),
    /// Rows are earlier than the row before; they are left out.
    BackwardTimes(Where),
    /// Rows are missing: stretches longer than one and a half steps of the clock. Nothing is put in their place.
    Gaps {
        /// Where the rows after gaps are.
        at: Where,
        /// Length of the longest, in seconds.
        longest_secs: f64,
    },
    /// The clock jitters; the columns were resampled to the regular clock at its mean rate.
    Jitter {
        /// 95th percentile of the deviation of a step from the middle one, as a share of it.
        share: f64,
        /// The regular rate in Hz.
        rate_hz: f64,
    },
    /// The clock runs slower or faster at the end than at the beginning.
    Drift {
        /// Change of the step from the first to the last quarter, as a share of it.
        share: f64,
    },
    /// Values are missing or not numbers; those rows are left out.
    NotANumber {
        /// The column.
        column: String,
        /// Where.
        at: Where,
    },
    /// Values are larger than anything that could have been measured; those rows are left out.
    Impossible {
        /// The column.
        column: String,
        /// Where.
        at: Where,
        /// The largest magnitude that is taken, in `unit`.
        most: f64,
        /// The SI unit of the column.
        unit: &'static str,
    },
    /// Glitches: a few rows far above everything around them, that do not ring as what a tip feels does. Left out.
    Spikes {
        /// The column.
        column: String,
        /// How many glitches.
        n: usize,
        /// Their rows.
        at: Where,
        /// The value of the highest, in m/s².
        value: f64,
        /// How many robust standard deviations it is away from what is around it.
        times: f64,
    },
    /// A column of speed, position or force has values in some of the rows only, as a slower sensor has; straight lines
    /// were put between them.
    SlowerTrack {
        /// The column.
        column: String,
        /// The mean rate of its values, in Hz.
        rate_hz: f64,
    },
    /// A column does not change for suspiciously long: the sensor, or its cable, was stuck. Left out.
    Stuck {
        /// The column.
        column: String,
        /// Where.
        at: Where,
    },
    /// A column of acceleration holds each value for several rows: the sensor was slower than the file.
    Held {
        /// The column.
        column: String,
        /// Mean number of rows with the same value.
        n_rows: f64,
        /// The rate that the sensor seems to have had, in Hz.
        true_rate_hz: f64,
    },
    /// An axis of acceleration never changes; it is not one of the axes.
    DeadAxis {
        /// The column.
        column: String,
        /// The value it has, in m/s².
        value: f64,
    },
    /// The signal stays at its largest value: the sensor or the converter was driven over its range. Left out.
    Clipped {
        /// The column.
        column: String,
        /// Where.
        at: Where,
        /// The value it stays at, in the unit of the column.
        value: f64,
    },
    /// Several axes became one by DFT321.
    AxesCombined {
        /// How many.
        n_axes: usize,
    },
    /// Speeds have a sign; their magnitude was taken.
    SignedSpeed(Where),
    /// Force is below zero, and not just about it.
    SignedForce(Where),
    /// Speeds that no hand strokes a surface at: their unit may be wrong.
    ImplausibleSpeed {
        /// Median while the tip moves, in m/s.
        median_mps: f64,
    },
    /// Forces that no stylus is pressed with: their unit may be wrong.
    ImplausibleForce {
        /// The highest, in N.
        most_n: f64,
    },
    /// Stretches too short to say anything about low frequencies; they are left out.
    Fragments {
        /// How many.
        n: usize,
        /// Their length in all, in seconds.
        seconds: f64,
    },
    /// Speed was worked out from positions.
    SpeedFromPositions,
    /// A quantity was said to be constant, not measured.
    Constant {
        /// The quantity, with its unit.
        what: &'static str,
        /// Its value.
        value: f64,
    },
}

impl Finding {
    /// A short name that scripts can look for.
    pub fn name(&self) -> &'static str {
        match self {
            Self::RepeatedTimes(_) => "repeated timestamps",
            Self::BackwardTimes(_) => "backward timestamps",
            Self::Gaps { .. } => "gaps",
            Self::Jitter { .. } => "irregular timestamps",
            Self::Drift { .. } => "clock drift",
            Self::NotANumber { .. } => "not a number",
            Self::Impossible { .. } => "impossible values",
            Self::Spikes { .. } => "spikes",
            Self::SlowerTrack { .. } => "slower track",
            Self::Stuck { .. } => "stuck sensor",
            Self::Held { .. } => "repeated values",
            Self::DeadAxis { .. } => "dead axis",
            Self::Clipped { .. } => "clipping",
            Self::AxesCombined { .. } => "axes combined",
            Self::SignedSpeed(_) => "signed speed",
            Self::SignedForce(_) => "signed force",
            Self::ImplausibleSpeed { .. } => "implausible speed",
            Self::ImplausibleForce { .. } => "implausible force",
            Self::Fragments { .. } => "fragments",
            Self::SpeedFromPositions => "speed from positions",
            Self::Constant { .. } => "constant",
        }
    }
}

impl fmt::Display for Where {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {} rows, first at {:.3} s", self.n_rows, self.of_rows, self.first_secs)
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.name())?;
        match self {
            Self::RepeatedTimes(at) => write!(f, "{at}; the first row of each time was kept"),
            Self::BackwardTimes(at) => write!(f, "{at}; those rows were left out"),
            Self::Gaps { at, longest_secs } => {
                write!(f, "{at}, the longest {longest_secs:.3} s; nothing was put in their place")
            }
            Self::Jitter { share, rate_hz } => write!(
                f,
                "steps of the clock differ by {:.0} %; the columns were resampled to {rate_hz:.1} Hz",
                100.0 * share
            ),
            Self::Drift { share } => {
                write!(f, "the step of the clock changes by {:.2} % from beginning to end", 100.0 * share)
            }
            Self::Held { column, n_rows, true_rate_hz } => write!(
                f,
                "{column} holds each value for {n_rows:.1} rows; its true rate seems to be {true_rate_hz:.0} Hz"
            ),
            Self::DeadAxis { column, value } => {
                write!(f, "{column} is {value} in every row; it was not taken as an axis")
            }
            Self::NotANumber { column, at } => write!(f, "{column}, {at}; those rows were left out"),
            Self::Impossible { column, at, most, unit } => write!(
                f,
                "{column} is beyond {most} {unit}, {at}; those rows were left out; where they are many, the unit is wrong"
            ),
            Self::Spikes { column, n, at, value, times } => {
                let glitches = if *n == 1 { "1 glitch" } else { &format!("{n} glitches") };
                write!(
                    f,
                    "{glitches} of the electronics in {column}, up to {value:.1} m/s², {times:.0} times what is around, {at}; left out"
                )
            }
            Self::SlowerTrack { column, rate_hz } => {
                write!(f, "{column} has values at {rate_hz:.1} Hz only; straight lines were put between them")
            }
            Self::Stuck { column, at } => write!(f, "{column} does not change, {at}; left out"),
            Self::Clipped { column, at, value } => {
                write!(f, "{column} stays at {value:.4}, {at}; left out")
            }
            Self::AxesCombined { n_axes } => write!(f, "{n_axes} axes became one by DFT321"),
            Self::SignedSpeed(at) => write!(f, "below 0 in {at}; the magnitude was taken"),
            Self::SignedForce(at) => write!(
                f,
                "below 0 in {at}; the tip counts as lifted there; check the zero and the direction of the sensor"
            ),
            Self::ImplausibleSpeed { median_mps } => write!(
                f,
                "half of the time that the tip moves it is slower than {:.3} mm/s, the other half faster; hands stroke at 10 to 1000 mm/s, check the unit",
                1e3 * median_mps
            ),
            Self::ImplausibleForce { most_n } => {
                write!(f, "it reaches {most_n:.0} N; a stylus is pressed with up to 10 N, check the unit")
            }
            Self::Fragments { n, seconds } => {
                write!(
                    f,
                    "{n} stretches between what is left out, {seconds:.3} s in all, are too short to use"
                )
            }
            Self::SpeedFromPositions => write!(f, "the file has no speed; it follows from the positions"),
            Self::Constant { what, value } => write!(f, "{what} was taken as {} throughout", micro(*value)),
        }
    }
}
