//! Phase reconstruction from the steps of the local mean.

use rustfft::num_complex::Complex;

use super::{SpatialSpectrogram, Spectra, Transform, lifted};

/// Fraction of the largest local mean below which a phase would only be round-off.
const ILL: f64 = 1e-9;

/// Returns a profile reconstructed from a spectrogram.
///
/// The local means form a staircase profile, which supplies the phases: eqs. (2) to (6).
///
/// # Panics
/// If `transform` has another framing than the spectrogram.
pub fn profile_of(spectrogram: &SpatialSpectrogram, transform: &Transform) -> Vec<f64> {
    assert_eq!(transform.framing(), spectrogram.power.framing, "transform and spectrogram differ in framing");
    let profile = transform.profile(&with_phases(spectrogram, transform));
    lifted(&profile, -spectrogram.offset)
}

/// Returns the spectrogram with the phases of its staircase, which includes the offset.
pub(super) fn with_phases(spectrogram: &SpatialSpectrogram, transform: &Transform) -> Spectra {
    let power = &spectrogram.power;
    let staircase = staircase(spectrogram, transform);
    let mut spectra = transform.empty(power.n_samples, power.n_frames());
    transform.analyze(&staircase, &mut spectra);
    let largest = spectra.frames().map(|bins| bins[0].norm()).fold(0.0, f64::max);
    let last = power.framing.n_bins() - 1;
    for (bins, power) in spectra.frames_mut().zip(power.frames()) {
        for (k, (bin, power)) in bins.iter_mut().zip(power).enumerate() {
            let size = bin.norm();
            let phase = if size < ILL * largest || size == 0.0 { Complex::ONE } else { *bin / size };
            let is_real = k == 0 || k == last;
            let phase = if is_real { Complex::new(sign(phase.re), 0.0) } else { phase };
            *bin = phase * power.max(0.0).sqrt();
        }
    }
    spectra
}

/// Returns the mean of the local means of all windows over each sample, eq. (2): a staircase with steps of one hop.
///
/// Where fewer windows overlap, each has more weight.
pub(super) fn staircase(spectrogram: &SpatialSpectrogram, transform: &Transform) -> Vec<f64> {
    let power = &spectrogram.power;
    // Σ w = N/2.
    let weight = 2.0 / transform.framing().window() as f64;
    let mut sums = vec![(0.0, 0.0); power.n_samples];
    for (frame, bins) in power.frames().enumerate() {
        let mean = weight * bins[0].max(0.0).sqrt();
        for (sum, n) in &mut sums[transform.inside(frame, power.n_samples).0] {
            *sum += mean;
            *n += 1.0;
        }
    }
    sums.into_iter().map(|(sum, n)| if n > 0.0 { sum / n } else { 0.0 }).collect()
}

fn sign(x: f64) -> f64 {
    if x < 0.0 { -1.0 } else { 1.0 }
}
