//! Errors of MFCC computation.

use crate::dsp::mfcc::options::{MAX_SAMPLE, MAX_TRANSFORM};

/// Error of creating a plan from options.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MfccPlanError {
    /// A single number is out of its range.
    #[error("{what} is {value:?}; it must lie between {low:?} and {high:?}")]
    Value {
        /// Quantity that is out of range, with its unit.
        what: &'static str,
        /// Value of the quantity.
        value: f64,
        /// Lowest valid value.
        low: f64,
        /// Highest valid value.
        high: f64,
    },
    /// A frame or a hop is shorter than a sample.
    #[error("a {what} of {secs} s is shorter than one sample at {rate_hz} Hz; make it longer")]
    Duration {
        /// `frame` or `hop`.
        what: &'static str,
        /// Length in seconds.
        secs: f64,
        /// Sample rate in Hz.
        rate_hz: f64,
    },
    /// The filters do not lie between zero and the Nyquist frequency.
    #[error(
        "mel filters from {low_hz} to {high_hz} Hz do not fit between 0 and {nyquist_hz} Hz, the Nyquist frequency; \
         lower the upper edge or use a higher sample rate"
    )]
    Edges {
        /// Lower edge of the first filter, in Hz.
        low_hz: f64,
        /// Upper edge of the last filter, in Hz.
        high_hz: f64,
        /// Nyquist frequency, half of the sample rate, in Hz.
        nyquist_hz: f64,
    },
    /// The number of coefficients is zero or exceeds the number of filters.
    #[error("{n_filters} mel filters have 1 to {n_filters} coefficients, got {n_coefficients}")]
    Coefficients {
        /// Requested number of coefficients.
        n_coefficients: usize,
        /// Number of filters.
        n_filters: usize,
    },
    /// The number of filters is zero or exceeds the number of bins of the longest transform.
    #[error("the number of mel filters must lie between 1 and {max}, got {n}", max = MAX_TRANSFORM / 2)]
    Filters {
        /// Requested number of filters.
        n: usize,
    },
    /// The transform is shorter than a frame, or too long.
    #[error(
        "a transform of {n_transform} samples does not fit a frame of {n_frame} samples; use from {n_frame} to {max} samples",
        max = MAX_TRANSFORM
    )]
    Transform {
        /// Number of samples of the transform.
        n_transform: usize,
        /// Number of samples of a frame.
        n_frame: usize,
    },
}

/// Error of computing the coefficients of a signal.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MfccError {
    /// The signal is empty, or shorter than a frame although the framing does not pad.
    #[error("the signal has {n} samples, but one frame needs {needed}; use a longer signal")]
    TooShort {
        /// Number of samples of the signal.
        n: usize,
        /// Number of samples needed.
        needed: usize,
    },
    /// A sample is not finite, or so large that its square overflows.
    #[error("sample {index} is {value:?}; samples must be finite with a magnitude of at most {max:e}", max = MAX_SAMPLE)]
    Sample {
        /// Index of the first invalid sample.
        index: usize,
        /// Value of this sample.
        value: f64,
    },
}
