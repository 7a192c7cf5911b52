//! Stroke recordings: measured acceleration, tip speed and normal force on one clock.

mod axis;
mod bounds;
mod clock;
mod dropout;
mod fault;
mod finding;
pub mod fit;
mod from_raw;
mod hum;
mod missing;
mod motion;
mod plausible;
mod raw;
mod resample;
pub mod segment;
mod spike;
mod stretch;
pub mod tap_transients;
mod three_axes;

use std::ops::Range;

pub use crate::recording::clock::check_clock;
pub use crate::recording::dropout::check_signal;
pub use crate::recording::fault::{Fault, MAX_RATE_HZ, MIN_RATE_HZ, MIN_USABLE_SECS, RecordingError};
pub use crate::recording::finding::{Finding, Where};
pub use crate::recording::motion::{SPEED_CUTOFF_HZ, speed_from_positions};
pub use crate::recording::raw::{RawClock, RawMotion, RawRecording, RawTrack};
pub use crate::recording::three_axes::ThreeAxisRecording;

use crate::units::Hertz;

/// Recording with a regular clock, in SI units. All columns have the same length.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Sample rate of all columns.
    pub rate: Hertz,
    /// Acceleration in m/s², one axis; several axes are combined by DFT321.
    pub acceleration_mps2: Vec<f64>,
    /// Tip speed along the surface, in m/s.
    pub speed_mps: Vec<f64>,
    /// Normal force in N; about zero while the tip is lifted.
    pub force_n: Vec<f64>,
    /// Ranges of valid samples, ascending and separated from each other. The samples between them were missing, stuck
    /// or clipped; they are NaN in every column and are ignored.
    pub usable: Vec<Range<usize>>,
}

impl Recording {
    /// Duration in seconds.
    pub fn seconds(&self) -> f64 {
        self.acceleration_mps2.len() as f64 / self.rate.0
    }

    /// Duration of the valid samples, in seconds.
    pub fn usable_seconds(&self) -> f64 {
        self.usable.iter().map(Range::len).sum::<usize>() as f64 / self.rate.0
    }
}
