//! What is not as it should be in a recording, by name.

use std::fmt;

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
    /// Values are missing or not numbers; those rows are left out.
    NotANumber {
        /// The column.
        column: String,
        /// Where.
        at: Where,
    },
    /// A column does not change for suspiciously long: the sensor, or its cable, was stuck. Left out.
    Stuck {
        /// The column.
        column: String,
        /// Where.
        at: Where,
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
            Self::NotANumber { .. } => "not a number",
            Self::Stuck { .. } => "stuck sensor",
            Self::Clipped { .. } => "clipping",
            Self::AxesCombined { .. } => "axes combined",
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
            Self::NotANumber { column, at } => write!(f, "{column}, {at}; those rows were left out"),
            Self::Stuck { column, at } => write!(f, "{column} does not change, {at}; left out"),
            Self::Clipped { column, at, value } => {
                write!(f, "{column} stays at {value:.4}, {at}; left out")
            }
            Self::AxesCombined { n_axes } => write!(f, "{n_axes} axes became one by DFT321"),
            Self::SpeedFromPositions => write!(f, "the file has no speed; it follows from the positions"),
            Self::Constant { what, value } => write!(f, "{what} was taken as {value} throughout"),
        }
    }
}
