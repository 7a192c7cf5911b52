//! Signal processing: linear prediction, line spectral frequencies, filters, spectra, cepstra and detection thresholds.
//!
//! Input: acceleration samples in m/s² at one sample rate. Output: coefficients, spectra in (m/s²)²/Hz and filtered
//! samples.

pub mod ar;
pub mod arma;
pub mod band_power;
pub mod contact_patch;
pub mod dft321;
pub mod filter;
pub mod lsf;
pub mod mfcc;
pub mod spectrum;
pub(crate) mod square_transform;
pub mod threshold;
