//! A profile made to fit a spectrogram better, step by step.

use rustfft::num_complex::Complex;

use super::{SpatialSpectrogram, Transform, lifted};

/// How far each step goes beyond the last (fast Griffin-Lim, Perraudin et al. 2013).
const MOMENTUM: f64 = 0.99;

/// Why a profile cannot be refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RefineError {
    /// The profile is not as long as that of the spectrogram, or the spectrogram was cut in another way.
    #[error(
        "the profile or the windows are not those of the spectrogram; begin with the profile that was made of it"
    )]
    Mismatch,
}

/// A profile whose spectrogram is nearer to the wanted one, from a `start` that is near already (the profile of
/// [`super::profile_of`]; from random phases the signs of local means do not come right), by `n_steps` of the fast
/// Griffin-Lim algorithm.
///
/// A better spectrum is not always a better place: an envelope can be worse than that of the start.
///
/// # Errors
/// [`RefineError::Mismatch`].
pub fn refine(
    spectrogram: &SpatialSpectrogram,
    transform: &Transform,
    start: &[f64],
    n_steps: usize,
) -> Result<Vec<f64>, RefineError> {
    let power = &spectrogram.power;
    if start.len() != power.n_samples || transform.framing() != power.framing {
        return Err(RefineError::Mismatch);
    }
    let sizes: Vec<f64> = power.values.iter().map(|power| power.max(0.0).sqrt()).collect();
    let weights = transform.weights(power.n_samples, power.n_frames());
    let mut profile = lifted(start, spectrogram.offset);
    let mut ahead = transform.empty(power.n_samples, power.n_frames());
    transform.analyze(&profile, &mut ahead);
    let mut before = ahead.clone();
    let mut now = ahead.clone();
    for _ in 0..n_steps {
        for (bin, size) in ahead.values.iter_mut().zip(&sizes) {
            let norm = bin.norm();
            *bin = if norm > 0.0 { *bin * (size / norm) } else { Complex::new(*size, 0.0) };
        }
        profile = transform.synthesize(&ahead, &weights);
        transform.analyze(&profile, &mut now);
        for ((ahead, now), before) in ahead.values.iter_mut().zip(&now.values).zip(&before.values) {
            *ahead = *now + (*now - *before) * MOMENTUM;
        }
        std::mem::swap(&mut before, &mut now);
    }
    Ok(lifted(&profile, -spectrogram.offset))
}
