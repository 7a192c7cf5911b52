//! Why there are no coefficients.

use crate::mfcc::plan::{MAX_SAMPLE, MAX_TRANSFORM};

/// Why options make no plan.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MfccPlanError {
    /// A number that stands alone is out of its range.
    #[error("{what} is {value:?}; it must lie between {low:?} and {high:?}")]
    Value {
        /// What is wrong, with its unit.
        what: &'static str,
        /// Its value.
        value: f64,
        /// Lowest that is possible.
        low: f64,
        /// Highest that is possible.
        high: f64,
    },
    /// A frame or a hop is shorter than a sample.
    #[error("a {what} of {secs} s is shorter than one sample at {rate_hz} Hz; make it longer")]
    Duration {
        /// `frame` or `hop`.
        what: &'static str,
        /// Its length in seconds.
        secs: f64,
        /// The rate in Hz.
        rate_hz: f64,
    },
    /// The filters do not lie between zero and half of the rate.
    #[error(
        "mel filters from {low_hz} to {high_hz} Hz do not fit between 0 and {nyquist_hz} Hz, half of the rate; \
         lower the upper edge or take a higher rate"
    )]
    Edges {
        /// Lower edge of the first filter, in Hz.
        low_hz: f64,
        /// Upper edge of the last filter, in Hz.
        high_hz: f64,
        /// Half of the rate, in Hz.
        nyquist_hz: f64,
    },
    /// There are more coefficients than filters, or none.
    #[error("{n_filters} mel filters have 1 to {n_filters} coefficients, asked for {n_coefficients}")]
    Coefficients {
        /// The number of coefficients.
        n_coefficients: usize,
        /// The number of filters.
        n_filters: usize,
    },
    /// The number of filters is zero, or so large that each holds less than a bin of the longest transform.
    #[error("the number of mel filters must lie between 1 and {max}, got {n}", max = MAX_TRANSFORM / 2)]
    Filters {
        /// The number of filters.
        n: usize,
    },
    /// The transform does not hold a frame, or is too long.
    #[error(
        "a transform of {n_transform} samples does not suit a frame of {n_frame}; it must have from {n_frame} to {max}",
        max = MAX_TRANSFORM
    )]
    Transform {
        /// Samples of the transform.
        n_transform: usize,
        /// Samples of a frame.
        n_frame: usize,
    },
}

/// Why a signal has no coefficients.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MfccError {
    /// The signal is shorter than a frame, where only whole frames count, or empty.
    #[error("the signal has {n} samples; one frame needs {needed}")]
    TooShort {
        /// Samples of the signal.
        n: usize,
        /// Samples that are needed.
        needed: usize,
    },
    /// A sample is no finite number, or so large that its square is none.
    #[error("sample {index} is {value:?}; samples must be finite numbers within {max:e} of zero", max = MAX_SAMPLE)]
    Sample {
        /// Index of the first such sample.
        index: usize,
        /// Its value.
        value: f64,
    },
}
