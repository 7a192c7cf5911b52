//! Iterative refinement of a profile to match a spectrogram (fast Griffin-Lim).

use rustfft::num_complex::Complex;

use super::{SpatialSpectrogram, Transform};

/// Momentum of each iteration (fast Griffin-Lim, Perraudin et al. 2013).
const MOMENTUM: f32 = 0.99;

/// Reasons why a profile cannot be refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RefineError {
    /// The start profile and the spectrogram differ in length.
    #[error(
        "start profile and spectrogram differ in length; start from the profile made from this spectrogram"
    )]
    Mismatch,
}

/// Returns a profile whose spectrogram is closer to the given one, after `n_steps` iterations of fast Griffin-Lim.
///
/// `start` should be close already, such as the profile of [`super::profile_of`]: from random phases, the signs of
/// local means come out wrong.
///
/// A better spectrum does not always improve position: the envelope can become worse than that of the start. Iterations
/// run in single precision, which is twice as fast. Detail below a millionth of the largest local mean is lost.
///
/// # Errors
/// [`RefineError::Mismatch`] if the lengths differ.
pub fn refine(
    spectrogram: &SpatialSpectrogram,
    start: &[f64],
    n_steps: usize,
) -> Result<Vec<f64>, RefineError> {
    let power = &spectrogram.power;
    if start.len() != power.n_samples {
        return Err(RefineError::Mismatch);
    }
    let transform = Transform::<f32>::new(power.framing);
    let sizes: Vec<f64> = power.values.iter().map(|power| power.max(0.0).sqrt()).collect();
    // Normalized to about one, so that squares fit single precision in any unit.
    let unit = sizes.iter().fold(0.0_f64, |most, size| most.max(*size));
    if n_steps == 0 {
        return Ok(start.to_vec());
    }
    if unit == 0.0 {
        return Ok(vec![-spectrogram.offset; start.len()]);
    }
    let sizes: Vec<f32> = sizes.iter().map(|size| (size / unit) as f32).collect();
    let weights = transform.weights(power.n_samples, power.n_frames());
    let mut profile: Vec<f32> = start.iter().map(|x| ((x + spectrogram.offset) / unit) as f32).collect();
    let mut added = vec![0.0; profile.len()];
    let mut before = vec![Complex::default(); sizes.len()];
    let n_bins = power.framing.n_bins();
    let (mut bins, mut work) = (vec![Complex::default(); n_bins], transform.work());
    for step in 0..n_steps {
        let momentum = if step == 0 { 0.0 } else { MOMENTUM };
        added.fill(0.0);
        // Forward and inverse transform per window, so that its data stays in cache.
        let windows = before.chunks_exact_mut(n_bins).zip(sizes.chunks_exact(n_bins));
        for (frame, (before, sizes)) in windows.enumerate() {
            transform.analyze_window(&profile, frame, &mut bins, &mut work);
            for ((bin, before), size) in bins.iter_mut().zip(before).zip(sizes) {
                let now = *bin;
                let ahead = now + (now - *before) * momentum;
                *before = now;
                let norm = ahead.norm_sqr().sqrt();
                *bin = if norm > 0.0 { ahead * (size / norm) } else { Complex::new(*size, 0.0) };
            }
            transform.add_window(&mut bins, frame, &mut added, &mut work);
        }
        transform.weigh(&mut added, &weights);
        std::mem::swap(&mut profile, &mut added);
    }
    Ok(profile.into_iter().map(|x| unit * f64::from(x) - spectrogram.offset).collect())
}
