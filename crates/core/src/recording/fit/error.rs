//! Errors of fitting a texture model to recordings.

use crate::dsp::ar::ArError;
use crate::texture::TextureModelError;

/// Error of fitting a texture model to recordings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// There are no recordings.
    #[error("there is no recording to fit; give at least one")]
    Empty,
    /// The columns of a recording are inconsistent.
    #[error(
        "recording {recording}: the columns differ in length, or the usable ranges are out of order or outside the columns"
    )]
    Columns {
        /// Index of the recording.
        recording: usize,
    },
    /// A usable value is not finite.
    #[error("recording {recording}: {column} is not finite in row {row}; leave this row out")]
    NotFinite {
        /// Index of the recording.
        recording: usize,
        /// Name of the column.
        column: &'static str,
        /// Index of the row, from 0.
        row: usize,
    },
    /// The direction of a recording is not finite.
    #[error("recording {recording}: the direction is not a finite angle; state it")]
    Direction {
        /// Index of the recording.
        recording: usize,
    },
    /// The sample rate of a recording is too low for vibrations.
    #[error(
        "recording {recording} has a sample rate of {rate_hz} Hz; use recordings with at least {lowest_hz} Hz"
    )]
    RecordingRate {
        /// Index of the recording.
        recording: usize,
        /// Sample rate of the recording, in Hz.
        rate_hz: f64,
        /// Lowest valid rate, in Hz.
        lowest_hz: f64,
    },
    /// The requested model rate is out of range, or above the rate of a recording.
    #[error(
        "the requested model rate is {rate_hz} Hz, but the recordings have {highest_hz} Hz; use 200 to 4000 Hz, and at most the rate of the recordings"
    )]
    RateAsked {
        /// Requested model rate, in Hz.
        rate_hz: f64,
        /// Lowest sample rate of the recordings, in Hz.
        highest_hz: f64,
    },
    /// The requested model order is out of range.
    #[error("the requested model order is {order}; it must lie between 1 and {highest}")]
    OrderAsked {
        /// Requested order.
        order: usize,
        /// Highest valid order.
        highest: usize,
    },
    /// The usable signal is too short.
    #[error("only {seconds:.2} s are usable; record several seconds of strokes, preferably 10 s or more")]
    TooShort {
        /// Usable duration, in seconds.
        seconds: f64,
    },
    /// The force never reaches the contact threshold.
    #[error(
        "the force never exceeds {strongest_n:.3} N; press harder, or check the unit and the sign of the force column"
    )]
    NoContact {
        /// Highest force, in N.
        strongest_n: f64,
    },
    /// The tip never moves fast enough in contact.
    #[error(
        "the tip never moves faster than {fastest_mm_per_s:.2} mm/s in contact; stroke faster, or check the unit of the speed column"
    )]
    NoMotion {
        /// Highest speed in contact, in mm/s.
        fastest_mm_per_s: f64,
    },
    /// Speed or force changes all the time.
    #[error("speed and force are never constant for {shortest_secs} s; stroke more evenly")]
    NotStationary {
        /// Minimum duration of a stationary segment, in seconds.
        shortest_secs: f64,
    },
    /// The acceleration is zero in all strokes.
    #[error("the acceleration is zero in all strokes; check the acceleration column")]
    Silent,
    /// A segment has no predictor.
    #[error("no predictor can be fitted to the strokes near {:.0} mm/s and {force_n:.2} N: {source}", 1e3 * speed_mps)]
    Predictor {
        /// Tip speed, in m/s.
        speed_mps: f64,
        /// Normal force, in N.
        force_n: f64,
        /// Underlying error.
        source: ArError,
    },
    /// A predictor is at the limit of stability.
    #[error("the strokes near {:.0} mm/s and {force_n:.2} N are a pure tone, not a texture; check the recording for hum", 1e3 * speed_mps)]
    Unstable {
        /// Tip speed, in m/s.
        speed_mps: f64,
        /// Normal force, in N.
        force_n: f64,
    },
    /// The fitted numbers do not form a valid model.
    #[error(transparent)]
    Model(#[from] TextureModelError),
}

impl FitError {
    /// Whether a lower order can help: the peaks of the spectrum are too sharp for a filter in single precision.
    pub(super) fn is_too_sharp(&self) -> bool {
        let is_filter = |error: &TextureModelError| {
            matches!(error, TextureModelError::Unstable { .. } | TextureModelError::Frequencies { .. })
        };
        match self {
            Self::Unstable { .. } => true,
            Self::Model(TextureModelError::InAlong(error)) => is_filter(error.as_ref()),
            Self::Model(error) => is_filter(error),
            _ => false,
        }
    }
}
