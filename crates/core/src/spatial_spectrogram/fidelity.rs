//! How much of a profile its spectrogram keeps, by the width of the windows.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use crate::statistics::correlation;

use super::{Framing, FramingError, SpatialSpectrogram, Transform, lifted, profile_of, spectral_convergence};

/// Spatial frequency in 1/m above which there is texture, whose envelope is looked at.
const TEXTURE_PER_M: f64 = 200.0;
/// Spatial frequency in 1/m up to which an envelope is followed.
const ENVELOPE_PER_M: f64 = 500.0;
/// Bins of the local mean, which the window spreads over two.
const N_MEAN_BINS: usize = 2;

/// What became of a profile that was made of its spectrogram alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileFidelity {
    /// Length of the windows in m.
    pub window_m: f64,
    /// Correlation of both profiles, -1 to 1.
    pub correlation: f64,
    /// Correlation of the envelopes of what is finer than 5 mm, followed to 2 mm: whether texture is where it was.
    pub envelope_correlation: f64,
    /// [`spectral_convergence`] of all but the local mean: 0 where the spectrograms are equal.
    pub spectral_convergence: f64,
}

/// What windows of each framing keep of a profile, whose samples lie `step_m` apart.
///
/// # Errors
/// See [`FramingError`].
pub fn fidelity_by_window(
    profile: &[f64],
    step_m: f64,
    framings: &[Framing],
) -> Result<Vec<ProfileFidelity>, FramingError> {
    framings
        .iter()
        .map(|framing| {
            let transform = Transform::new(*framing);
            let spectrogram = SpatialSpectrogram::of(profile, &transform)?;
            let made = profile_of(&spectrogram, &transform);
            fidelity(profile, &made, step_m, &spectrogram, &transform)
        })
        .collect()
}

/// How near a profile that was `made` of a spectrogram is to the original.
///
/// # Errors
/// See [`FramingError`].
pub fn fidelity(
    original: &[f64],
    made: &[f64],
    step_m: f64,
    spectrogram: &SpatialSpectrogram,
    transform: &Transform,
) -> Result<ProfileFidelity, FramingError> {
    let power = transform.power(&lifted(made, spectrogram.offset))?;
    // What does not vary goes with nothing.
    let correlation = |a: &[f64], b: &[f64]| correlation(a, b).unwrap_or(0.0);
    Ok(ProfileFidelity {
        window_m: transform.framing().window() as f64 * step_m,
        correlation: correlation(original, made),
        envelope_correlation: correlation(&envelope(original, step_m), &envelope(made, step_m)),
        spectral_convergence: spectral_convergence(spectrogram.power(), &power, N_MEAN_BINS),
    })
}

/// The slow part of the magnitude of the analytic signal of what is fine.
fn envelope(profile: &[f64], step_m: f64) -> Vec<f64> {
    let n = profile.len();
    let mut planner = FftPlanner::new();
    let (forward, inverse) = (planner.plan_fft_forward(n), planner.plan_fft_inverse(n));
    let mut values: Vec<Complex<f64>> = profile.iter().map(|x| Complex::new(*x, 0.0)).collect();
    let per_m = |k: usize| k.min(n - k) as f64 / (n as f64 * step_m);
    forward.process(&mut values);
    for (k, value) in values.iter_mut().enumerate() {
        let is_positive = k > 0 && 2 * k < n;
        *value *= if is_positive && per_m(k) >= TEXTURE_PER_M { 2.0 / n as f64 } else { 0.0 };
    }
    inverse.process(&mut values);
    for value in &mut values {
        *value = Complex::new(value.norm(), 0.0);
    }
    forward.process(&mut values);
    for (k, value) in values.iter_mut().enumerate() {
        *value *= if per_m(k) > ENVELOPE_PER_M { 0.0 } else { 1.0 / n as f64 };
    }
    inverse.process(&mut values);
    values.into_iter().map(|value| value.re).collect()
}
