//! A recording as a file holds it: columns in SI units on whatever clock there was.

use crate::units::Hertz;

/// Columns of a file, converted to SI units and otherwise as they stand. Rows that lack a value have NaN there.
#[derive(Clone, Debug, PartialEq)]
pub struct RawRecording {
    /// When the rows were taken.
    pub clock: RawClock,
    /// One to three axes of acceleration in m/s², each with a value for every row.
    pub acceleration_mps2: Vec<Vec<f64>>,
    /// How the tip moved.
    pub motion: RawMotion,
    /// Normal force in N.
    pub force_n: RawTrack,
    /// Acceleration at which the converter or the file saturates, in m/s², where that is known: clipping is looked for there.
    pub full_scale_mps2: Option<f64>,
}

/// When rows were taken.
#[derive(Clone, Debug, PartialEq)]
pub enum RawClock {
    /// Evenly, at a rate that was stated.
    Rate(Hertz),
    /// At these times in seconds, as written: they may repeat, go back or be missing (NaN).
    Times(Vec<f64>),
}

/// How the tip moved along the surface.
#[derive(Clone, Debug, PartialEq)]
pub enum RawMotion {
    /// Speed in m/s.
    Speed(RawTrack),
    /// Position along one to three axes in m, each with a value for every row; speed follows from them.
    Positions(Vec<Vec<f64>>),
}

/// A quantity of a recording.
#[derive(Clone, Debug, PartialEq)]
pub enum RawTrack {
    /// Not in the file, and nobody said it.
    Missing,
    /// The same all the time, as somebody said.
    Constant(f64),
    /// A value for every row.
    Column(Vec<f64>),
}
