//! Mel-frequency cepstral coefficients (MFCC): framing, window, spectrum, mel filter bank, logarithm, cosine transform.
//!
//! Common implementations differ in every step: python_speech_features, librosa with either mel scale, and scripts
//! modeled on the Hidden Markov Model Toolkit (HTK). One routine covers them; [`MfccOptions`] selects the variant.
//! Golden vectors check it against the first two. An [`MfccPlan`] precomputes all that does not depend on the signal.
//!
//! ```
//! use shagreen_core::dsp::mfcc::{MfccPlan, recommended};
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

pub use crate::dsp::mfcc::error::{MfccError, MfccPlanError};
pub use crate::dsp::mfcc::filter_bank::filter_bank;
pub use crate::dsp::mfcc::options::{
    Dct, FilterShape, FirstCoefficient, Framing, Lifter, Logarithm, MAX_SAMPLE, MAX_TRANSFORM, MelScale,
    MfccOptions, Spectrum, TransformLength, Window, htk, paper, recommended,
};
pub use crate::dsp::mfcc::plan::MfccPlan;

#[cfg(test)]
mod tests;
