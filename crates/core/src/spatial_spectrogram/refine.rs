//! A profile made to fit a spectrogram better, step by step.

use rustfft::num_complex::Complex;

use super::{SpatialSpectrogram, Transform};

/// How far each step goes beyond the last (fast Griffin-Lim, Perraudin et al. 2013).
const MOMENTUM: f32 = 0.99;

/// Why a profile cannot be refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RefineError {
    /// The profile is not as long as that of the spectrogram.
    #[error(
        "the profile is not as long as that of the spectrogram; begin with the profile that was made of it"
    )]
    Mismatch,
}

/// A profile whose spectrogram is nearer to the wanted one, from a `start` that is near already (the profile of
/// [`super::profile_of`]; from random phases the signs of local means do not come right), by `n_steps` of the fast
/// Griffin-Lim algorithm.
///
/// A better spectrum is not always a better place: an envelope can be worse than that of the start. Steps are made in
/// singles, which is twice as fast: what is a millionth of the largest local mean is lost in them.
///
/// # Errors
/// [`RefineError::Mismatch`].
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
    // Whatever the unit is, singles have room for squares of what is about one.
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
        // Window by window, there and back: what belongs to one is at hand then.
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
