//! Offline rendering of mixtures and paths to samples, for any motion of the tip.

use std::borrow::Borrow;

use shagreen_core::space::texture_path::{PathPlan, TexturePath, render_path};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::{Plane, Prepared};
use shagreen_core::texture::render::{Hand, RenderError, RenderPlan, render};
use shagreen_core::units::Hertz;

/// Rate, length and seed of rendered samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleFormat {
    /// Rate of the samples, at least that of the textures.
    pub rate: Hertz,
    /// Length in seconds.
    pub seconds: f64,
    /// Random seed of the noise.
    pub seed: u64,
}

/// Renders the acceleration in m/s² of a weighted mixture of textures.
///
/// # Errors
/// See [`RenderError`].
pub fn render_mixture<P: Borrow<Plane>>(
    voices: &[(P, f64)],
    mode: Mode,
    format: SampleFormat,
    hand: &mut dyn Hand,
) -> Result<Vec<f32>, RenderError> {
    let SampleFormat { rate, seconds, seed } = format;
    let prepared: Vec<(Prepared, f64)> =
        voices.iter().map(|(plane, weight)| (plane.borrow().prepare(), *weight)).collect();
    let parents: Vec<(&Prepared, f64)> = prepared.iter().map(|(p, weight)| (p, *weight)).collect();
    render(&RenderPlan { parents: &parents, mode, rate, seconds, seed }, hand)
}

/// Renders the acceleration in m/s² of a texture that changes along the stroke.
///
/// # Errors
/// See [`RenderError`].
pub fn render_along(
    path: &TexturePath,
    format: SampleFormat,
    hand: &mut dyn Hand,
) -> Result<Vec<f32>, RenderError> {
    let SampleFormat { rate, seconds, seed } = format;
    let prepared: Vec<Prepared> = path.keys().iter().map(|key| Plane::new(&key.model).prepare()).collect();
    render_path(&PathPlan { path, prepared: &prepared, rate, seconds, seed }, hand)
}
