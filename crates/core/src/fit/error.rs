//! Why recordings do not make a texture.

use crate::ar::ArError;
use crate::texture::TextureModelError;

/// Why recordings do not make a texture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// There is nothing to fit.
    #[error("there is no recording to fit")]
    Empty,
    /// The columns of a recording do not belong together.
    #[error("recording {recording}: its columns differ in length, or what is usable lies outside them")]
    Columns {
        /// Index of the recording.
        recording: usize,
    },
    /// Something usable is not a number.
    #[error("recording {recording}: {column} is not a finite number in row {row}; leave that row out")]
    NotFinite {
        /// Index of the recording.
        recording: usize,
        /// The column.
        column: &'static str,
        /// The row, from 0.
        row: usize,
    },
    /// A recording is too coarse for vibrations.
    #[error("recording {recording} has {rate_hz} samples a second; vibrations need at least {lowest_hz}")]
    RecordingRate {
        /// Index of the recording.
        recording: usize,
        /// Its rate.
        rate_hz: f64,
        /// The lowest that is possible.
        lowest_hz: f64,
    },
    /// The rate that was asked for is above that of a recording.
    #[error(
        "a model at {rate_hz} Hz was asked for, but the recordings have {highest_hz} Hz; ask for 200 to 4000 Hz, at most that of the recordings"
    )]
    RateAsked {
        /// The rate asked for.
        rate_hz: f64,
        /// The lowest rate of the recordings.
        highest_hz: f64,
    },
    /// The order that was asked for cannot be rendered.
    #[error("an order of {order} was asked for; it must lie between 1 and {highest}")]
    OrderAsked {
        /// The order asked for.
        order: usize,
        /// The highest that is possible at the rate of the model.
        highest: usize,
    },
    /// There is too little signal.
    #[error("only {seconds:.2} s are usable; record strokes of some seconds, best 10 s or more")]
    TooShort {
        /// What is usable.
        seconds: f64,
    },
    /// The tip never pressed.
    #[error(
        "the force never exceeds {strongest_n:.3} N: press, or check the unit and the sign of the force column"
    )]
    NoContact {
        /// The highest force.
        strongest_n: f64,
    },
    /// The tip never moved.
    #[error(
        "the tip never moves faster than {fastest_mm_per_s:.2} mm/s in contact: stroke faster, or check the unit of the speed column"
    )]
    NoMotion {
        /// The highest speed in contact.
        fastest_mm_per_s: f64,
    },
    /// Speed or force always changes.
    #[error("nowhere do speed and force stay the same for {shortest_secs} s: stroke more evenly")]
    NotStationary {
        /// Shortest stretch that counts.
        shortest_secs: f64,
    },
    /// There is no vibration at all.
    #[error("the acceleration is zero in all strokes: check the acceleration column")]
    Silent,
    /// A stretch has no predictor.
    #[error("the strokes near {:.0} mm/s and {force_n:.2} N have no predictor: {source}", 1e3 * speed_mps)]
    Predictor {
        /// Speed, in m/s.
        speed_mps: f64,
        /// Force, in N.
        force_n: f64,
        /// Why.
        source: ArError,
    },
    /// A predictor is on the edge of stability.
    #[error("the strokes near {:.0} mm/s and {force_n:.2} N are a pure tone, not a texture: look for hum", 1e3 * speed_mps)]
    Unstable {
        /// Speed, in m/s.
        speed_mps: f64,
        /// Force, in N.
        force_n: f64,
    },
    /// The fitted numbers make no model.
    #[error(transparent)]
    Model(#[from] TextureModelError),
}
