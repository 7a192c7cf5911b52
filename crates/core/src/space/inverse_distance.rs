//! Inverse-distance weights, as in the authoring paper ([`crate::space`]).

use crate::space::{Location, Space};

/// Distance below which a point coincides with a texture, in points of the axes.
const AT_A_TEXTURE: f64 = 1e-7;

/// Weights `d_i^-1 / Σ d_j^-1` over the corners of the triangle; at the position of a texture, that texture alone.
pub(crate) fn inverse_distance(space: &Space, location: &Location) -> Vec<(usize, f64)> {
    let distance =
        |texture: usize| space.position(texture).map_or(f64::INFINITY, |p| p.distance(location.at));
    if let Some((texture, _)) = location.corners.iter().find(|(t, _)| distance(*t) < AT_A_TEXTURE) {
        return vec![(*texture, 1.0)];
    }
    let sum: f64 = location.corners.iter().map(|(t, _)| 1.0 / distance(*t)).sum();
    location.corners.iter().map(|(t, _)| (*t, 1.0 / distance(*t) / sum)).collect()
}
