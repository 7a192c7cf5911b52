//! What a stylus felt, measured: acceleration, speed and force on one clock.

mod clock;
mod dropout;
mod fault;
mod finding;
mod from_raw;
mod missing;
mod motion;
mod plausible;
mod raw;
mod resample;
mod spike;
mod stretch;

use std::ops::Range;

pub use crate::recording::clock::check_clock;
pub use crate::recording::dropout::check_signal;
pub use crate::recording::fault::{Fault, MAX_RATE_HZ, MIN_RATE_HZ, MIN_USABLE_SECS, RecordingError};
pub use crate::recording::finding::{Finding, Where};
pub use crate::recording::motion::{SPEED_CUTOFF_HZ, speed_from_positions};
pub use crate::recording::raw::{RawClock, RawMotion, RawRecording, RawTrack};

use crate::units::Hertz;

/// A recording on one regular clock, in SI units. All columns have one length.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Samples a second of every column.
    pub rate: Hertz,
    /// Acceleration in m/s², one axis: three were made one by DFT321.
    pub acceleration_mps2: Vec<f64>,
    /// Speed of the tip along the surface, in m/s.
    pub speed_mps: Vec<f64>,
    /// Normal force in N; about zero while lifted.
    pub force_n: Vec<f64>,
    /// Stretches of samples that were really measured, ascending, apart from each other. What lies between was missing,
    /// stuck or clipped, counts for nothing and is NaN in every column.
    pub usable: Vec<Range<usize>>,
}

impl Recording {
    /// Length in seconds.
    pub fn seconds(&self) -> f64 {
        self.acceleration_mps2.len() as f64 / self.rate.0
    }

    /// Length of what is usable, in seconds.
    pub fn usable_seconds(&self) -> f64 {
        self.usable.iter().map(Range::len).sum::<usize>() as f64 / self.rate.0
    }
}
