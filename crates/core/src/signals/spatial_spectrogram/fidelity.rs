//! Fidelity of profiles reconstructed from spectrograms, by window length.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use crate::maths::statistics::correlation;

use super::{Framing, FramingError, SpatialSpectrogram, Transform, lifted, profile_of, spectral_convergence};

/// Lowest spatial frequency in 1/m that counts as texture.
const TEXTURE_PER_M: f64 = 200.0;
/// Upper band limit of texture envelopes, in 1/m.
const ENVELOPE_PER_M: f64 = 500.0;
/// Number of bins that hold the local mean, which the window spreads over two.
const N_MEAN_BINS: usize = 2;

/// Fidelity of a profile reconstructed from its spectrogram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfileFidelity {
    /// Window length in m.
    pub window_m: f64,
    /// Correlation of both profiles, -1 to 1.
    pub correlation: f64,
    /// Correlation of the envelopes of detail finer than 5 mm, low-passed at 2 mm: whether texture stays in position.
    pub envelope_correlation: f64,
    /// [`spectral_convergence`] without the local mean; 0 if the spectrograms are equal.
    pub spectral_convergence: f64,
}

/// Returns the fidelity of a profile for each framing; samples are `step_m` apart.
///
/// # Errors
/// [`FramingError`] for a sample that is not finite, or a length that does not fit a framing.
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

/// Returns the fidelity of the profile `made` from a spectrogram of `original`.
///
/// # Errors
/// [`FramingError`] for a sample that is not finite, or a length that does not fit the framing.
pub fn fidelity(
    original: &[f64],
    made: &[f64],
    step_m: f64,
    spectrogram: &SpatialSpectrogram,
    transform: &Transform,
) -> Result<ProfileFidelity, FramingError> {
    let power = transform.power(&lifted(made, spectrogram.offset))?;
    // A constant profile has no correlation.
    let correlation = |a: &[f64], b: &[f64]| correlation(a, b).unwrap_or(0.0);
    Ok(ProfileFidelity {
        window_m: transform.framing().window() as f64 * step_m,
        correlation: correlation(original, made),
        envelope_correlation: correlation(&envelope(original, step_m), &envelope(made, step_m)),
        spectral_convergence: spectral_convergence(spectrogram.power(), &power, N_MEAN_BINS),
    })
}

/// Low-passed magnitude of the analytic signal of the texture band.
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
