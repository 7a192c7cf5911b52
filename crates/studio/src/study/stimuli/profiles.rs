//! Published profiles over the position, their reconstructions, and profiles with gaps.

use std::sync::Arc;

use anyhow::{Context as _, bail};
use shagreen_core::dsp::spectrum::rms;
use shagreen_core::maths::statistics::{centered, mean};
use shagreen_core::people::study::plan::Variant;
use shagreen_core::signals::codec::CODEC_RATE;
use shagreen_core::signals::profile_stimuli::{STEP_M, gap_pair};
use shagreen_core::signals::spatial_spectrogram::{Framing, SpatialSpectrogram, Transform, profile_of};
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::profile::Profile;
use shagreen_core::texture::relief::Relief;
use shagreen_core::units::Newtons;

use super::StimulusSound;
use crate::study::textures::profile;

/// Root mean square acceleration of a profile at a normal force of 1 N, in m/s². The published profiles are friction, which has
/// no acceleration; the level is ours.
pub const PROFILE_LEVEL_MPS2: f64 = 1.0;
/// Force at which a profile has its level.
const PROFILE_FORCE: Newtons = Newtons(1.0);
/// Length of a profile: 80 mm.
const N_SAMPLES: usize = 8000;

/// A published profile, or its reconstruction.
pub(super) fn profile_sound(name: &str, variant: Variant) -> anyhow::Result<StimulusSound> {
    let texture =
        profile(name).with_context(|| format!("there is no profile \"{name}\"; use A, B, C or D"))?;
    let values = texture.profile(N_SAMPLES);
    let presented = match variant {
        Variant::Original => values.clone(),
        Variant::Reconstructed { window_mm } => reconstruction(&values, STEP_M, window_mm)?,
        Variant::Authored | Variant::Coded { .. } => {
            bail!("a profile can be original or reconstructed only; change `variant`, or use a texture")
        }
    };
    of_values(&presented, &values)
}

/// Noise with gaps of this width in mm, and noise of the same spectrum without gaps, at the same level.
pub(super) fn gap_sounds(gap_mm: f64, seed: u64) -> anyhow::Result<[StimulusSound; 2]> {
    let pair = gap_pair(1e-3 * gap_mm, N_SAMPLES, STEP_M, seed);
    Ok([of_values(&pair.gapped, &pair.gapped)?, of_values(&pair.distractor, &pair.gapped)?])
}

/// Reconstruction of a profile from its spatial spectrogram with this window.
pub(super) fn reconstruction(values: &[f64], step_m: f64, window_mm: f64) -> anyhow::Result<Vec<f64>> {
    let transform = Transform::new(Framing::of_length(1e-3 * window_mm, step_m));
    let spectrogram = SpatialSpectrogram::of(values, &transform)
        .with_context(|| format!("a window of {window_mm} mm does not fit; change `window_mm`"))?;
    Ok(profile_of(&spectrogram, &transform))
}

/// Relief of a profile, by the factor and the mean that give `original` its level.
fn of_values(values: &[f64], original: &[f64]) -> anyhow::Result<StimulusSound> {
    let (middle, level) = (mean(original), rms(&centered(original)));
    let scaled = values.iter().map(|value| PROFILE_LEVEL_MPS2 * (value - middle) / level).collect();
    let relief = Relief::new(Profile::new(STEP_M, scaled)?, PROFILE_FORCE)?;
    Ok(StimulusSound::of_model(TextureModel::of_relief(Arc::new(relief), CODEC_RATE)?))
}
