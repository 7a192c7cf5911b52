//! Recording as stored in a file: columns in SI units on the file's clock.

use crate::units::Hertz;

/// Columns of a file, converted to SI units and otherwise unchanged. Rows with a missing value have NaN.
#[derive(Clone, Debug, PartialEq)]
pub struct RawRecording {
    /// Times of the rows.
    pub clock: RawClock,
    /// One to three axes of acceleration in m/s², each with one value for every row.
    pub acceleration_mps2: Vec<Vec<f64>>,
    /// Tip motion.
    pub motion: RawMotion,
    /// Normal force in N.
    pub force_n: RawTrack,
    /// Acceleration in m/s² at which the converter or the file saturates, if known; used to detect clipping.
    pub full_scale_mps2: Option<f64>,
}

/// Times of the rows.
#[derive(Clone, Debug, PartialEq)]
pub enum RawClock {
    /// Equidistant, at a given sample rate.
    Rate(Hertz),
    /// Timestamps in seconds as stored: they can repeat, go back or be missing (NaN).
    Times(Vec<f64>),
}

/// Tip motion along the surface.
#[derive(Clone, Debug, PartialEq)]
pub enum RawMotion {
    /// Speed in m/s.
    Speed(RawTrack),
    /// Position along one to three axes in m, each with one value for every row; the speed is computed from it.
    Positions(Vec<Vec<f64>>),
}

/// Quantity of a recording.
#[derive(Clone, Debug, PartialEq)]
pub enum RawTrack {
    /// Neither in the file nor given as a constant.
    Missing,
    /// Constant value, given by the user.
    Constant(f64),
    /// One value for every row.
    Column(Vec<f64>),
}
