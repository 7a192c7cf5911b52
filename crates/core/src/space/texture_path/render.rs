//! Offline rendering of a texture path.

use shagreen_synth::renderer::{Blend, Mix, Parent, TextureId};

use crate::space::texture_path::{PrecomputedProgress, TexturePath};
use crate::texture::plane::Prepared;
use crate::texture::render::{Hand, MIX_STEP_SECS, RenderError, VaryingPlan, render_varying};
use crate::units::Hertz;

/// Input and options for rendering a path.
#[derive(Clone, Copy, Debug)]
pub struct PathPlan<'a> {
    /// Path to render.
    pub path: &'a TexturePath,
    /// Prepared textures, one per key.
    pub prepared: &'a [Prepared],
    /// Sample rate of the output; at least that of the textures.
    pub rate: Hertz,
    /// Length of the output, in seconds.
    pub seconds: f64,
    /// Seed of all noise.
    pub seed: u64,
}

/// Acceleration in m/s² at the tip of a stylus on a texture that changes along the stroke. Each new contact starts a
/// new stroke.
///
/// # Errors
/// See [`RenderError`].
pub fn render_path(plan: &PathPlan<'_>, hand: &mut dyn Hand) -> Result<Vec<f32>, RenderError> {
    let keys = plan.path.keys().len();
    if plan.prepared.len() != keys {
        return Err(RenderError::Keys { n: plan.prepared.len(), keys });
    }
    // Computed in advance, because the mix and the contact are requested alternately.
    let ahead = PrecomputedProgress::new(plan.path.along(), plan.seconds, MIX_STEP_SECS, &mut |secs| {
        hand.contact_at(secs)
    });
    let mut mix_at = |time_secs: f64| path_mix(plan.path, ahead.at(time_secs));
    let varying = VaryingPlan {
        prepared: plan.prepared.iter().collect(),
        rate: plan.rate,
        seconds: plan.seconds,
        seed: plan.seed,
    };
    render_varying(&varying, &mut mix_at, hand)
}

/// Mix of the path's textures (identified by key index) after the given traveled distance or time, in m or s.
pub fn path_mix(path: &TexturePath, traveled: f64) -> Mix {
    let (key, share) = path.between(traveled);
    let mut mix = Mix::silent(Blend::Shared);
    mix.parents[0] = Parent { id: key as TextureId, weight: 1.0 - share as f32 };
    if share > 0.0 {
        mix.parents[1] = Parent { id: key as TextureId + 1, weight: share as f32 };
    }
    mix
}

#[cfg(test)]
mod tests;
