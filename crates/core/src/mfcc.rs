//! Mel-frequency cepstral coefficients (MFCC): frame, window, spectrum, mel filters, logarithm, cosine transform.
//!
//! One routine stands for the common ways to do this, which differ in every step: python_speech_features, librosa with
//! either of its mel scales, and scripts in the manner of the Hidden Markov Model Toolkit (HTK). [`MfccOptions`] names
//! each step; golden vectors hold the routine to the first two. A [`MfccPlan`] does once what does not depend on the
//! signal.
//!
//! ```
//! use shagreen_core::mfcc::{MfccPlan, recommended};
//! use shagreen_core::units::Hertz;
//!
//! let plan = MfccPlan::new(&recommended(), Hertz(1000.0))?;
//! let signal: Vec<f64> = (0..1000).map(|i| (0.3 * f64::from(i)).sin()).collect();
//! let coefficients = plan.coefficients(&signal)?;
//! assert_eq!(coefficients.dim(), (66, 13));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod filter_bank;
mod lags;
mod logarithm;
mod options;
mod plan;
mod transform;

pub use crate::mfcc::error::{MfccError, MfccPlanError};
pub use crate::mfcc::filter_bank::filter_bank;
pub use crate::mfcc::options::{
    Dct, FilterShape, FirstCoefficient, Framing, Lifter, Logarithm, MelScale, MfccOptions, Spectrum,
    TransformLength, Window, htk, paper, recommended,
};
pub use crate::mfcc::plan::{MAX_SAMPLE, MAX_TRANSFORM, MfccPlan};

#[cfg(test)]
mod tests;
