//! Pieces to their bins and back, by plans that were made for them.

use realfft::{ComplexToReal, RealToComplex};
use rustfft::num_complex::Complex;

/// The bins of a piece with silence behind it up to the length of the plan, not scaled.
pub(super) fn bins_of(plan: &dyn RealToComplex<f64>, piece: &[f64]) -> Vec<Complex<f64>> {
    let (mut samples, mut bins) = (plan.make_input_vec(), plan.make_output_vec());
    samples[..piece.len()].copy_from_slice(piece);
    let done = plan.process(&mut samples, &mut bins);
    debug_assert!(done.is_ok(), "the lengths are those of the plan");
    bins
}

/// The samples of bins, as many times as large as the plan is long.
pub(super) fn samples_of(plan: &dyn ComplexToReal<f64>, mut bins: Vec<Complex<f64>>) -> Vec<f64> {
    let mut samples = plan.make_output_vec();
    let done = plan.process(&mut bins, &mut samples);
    debug_assert!(done.is_ok(), "the lengths are those of the plan, and the ends are real");
    samples
}
