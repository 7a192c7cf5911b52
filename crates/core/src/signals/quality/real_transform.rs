//! Real FFT of segments and its inverse, with precomputed plans.

use realfft::{ComplexToReal, RealToComplex};
use rustfft::num_complex::Complex;

/// Returns the spectrum of a segment, zero-padded to the length of the plan, not normalized.
pub(super) fn bins_of(plan: &dyn RealToComplex<f64>, piece: &[f64]) -> Vec<Complex<f64>> {
    let (mut samples, mut bins) = (plan.make_input_vec(), plan.make_output_vec());
    samples[..piece.len()].copy_from_slice(piece);
    let done = plan.process(&mut samples, &mut bins);
    debug_assert!(done.is_ok(), "buffer lengths must come from the plan");
    bins
}

/// Returns the inverse transform of a spectrum, scaled by the length of the plan.
pub(super) fn samples_of(plan: &dyn ComplexToReal<f64>, mut bins: Vec<Complex<f64>>) -> Vec<f64> {
    let mut samples = plan.make_output_vec();
    let done = plan.process(&mut bins, &mut samples);
    debug_assert!(done.is_ok(), "buffer lengths must come from the plan, and DC and Nyquist must be real");
    samples
}
