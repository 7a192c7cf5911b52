//! Texture of a material from its own height field: what its picture shows is what a hand feels.
//!
//! | layer | source |
//! |---|---|
//! | height map | the pattern of the material, as the pen meets it (`pattern_relief`) |
//! | grain, across and along the lay | simulated strokes over the same height field without the pattern ([`stroked_grain`]) |
//! | tap transient | Hertz impact ([`landing`]) |
//! | friction, stick-slip | the material |
//!
//! The grain leaves the pattern out, so that it is not felt twice. The height map has the origin of the picture: its first
//! row is the lower edge, where y is 0.

mod pattern_relief;

use std::sync::Arc;

use crate::surfaces::contact_model::landing::{REFERENCE_LANDING, landing};
use crate::surfaces::contact_model::{PEN, StrokeError};
use crate::surfaces::felt_material::pattern_relief::{N_SPEEDS, pattern_relief};
use crate::surfaces::height_field::{Tile, synthesize};
use crate::surfaces::material::{Material, MaterialError, validate};
use crate::surfaces::stroked_grain::{GrainError, n_strokes, prepare_strokes, stroked_grain};
use crate::texture::TextureModel;
use crate::texture::height_map::HeightMapError;

/// Reasons why a material gives no texture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FeltError {
    /// A material parameter is invalid.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// The strokes give no grain.
    #[error(transparent)]
    Grain(#[from] GrainError),
    /// A stroke over the pattern could not be simulated.
    #[error(transparent)]
    Stroke(#[from] StrokeError),
    /// The pattern gives no height map.
    #[error("the pattern of the material gives no height map")]
    HeightMap(#[from] HeightMapError),
}

impl FeltError {
    /// Whether the caller stopped the simulation.
    pub fn is_stop(&self) -> bool {
        matches!(self, Self::Grain(GrainError::Stopped))
    }
}

/// Returns the number of steps of [`felt`].
pub fn n_steps(material: &Material) -> usize {
    n_strokes(&without_pattern(material)) + pattern_relief::of(material).map_or(0, |_| N_SPEEDS)
}

/// Returns the texture of a material, deterministic for a seed; takes some seconds.
///
/// It is felt as its picture looks if `tile` and `seed` are those of the pictured height field
/// ([`synthesize`]). `step` is called after each of the [`n_steps`] and returns whether to continue.
///
/// # Errors
/// See the variants of [`FeltError`]; [`FeltError::is_stop`] if `step` returned `false`.
pub fn felt(
    material: &Material,
    tile: Tile,
    seed: u64,
    step: &dyn Fn() -> bool,
) -> Result<TextureModel, FeltError> {
    validate(material)?;
    let bare = without_pattern(material);
    // The random numbers of each part of a field depend on the seed alone, so the rest of the field stays the same.
    let surfaces = prepare_strokes(&bare, &synthesize(&bare, tile, seed), seed);
    let grain = stroked_grain(&bare, &surfaces, seed, step)?;
    let height_map = match pattern_relief::of(material) {
        Some(pattern) => Some(Arc::new(pattern_relief(material, pattern, tile, seed, step)?)),
        None => None,
    };
    Ok(grain
        .with_tap(Some(landing(material, &PEN, REFERENCE_LANDING)))
        .with_height_map(height_map)
        .with_stick_slip(material.stick_slip))
}

fn without_pattern(material: &Material) -> Material {
    Material { pattern: None, ..material.clone() }
}

#[cfg(test)]
mod tests;
