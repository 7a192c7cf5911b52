//! Reliefs and height maps in a shape.

use std::sync::Arc;

use crate::texture::height_map::HeightMap;
use crate::texture::profile::Profile;
use crate::texture::relief::{MAX_MPS2, Relief, STEPS_M};

/// A relief with `stretch` times the spatial scale and `scale` times the acceleration; `None` if that is zero. Steps and
/// accelerations beyond those of a relief are limited to them.
pub(super) fn shaped_relief(relief: &Relief, stretch: f64, scale: f64) -> Option<Arc<Relief>> {
    if scale == 0.0 {
        return None;
    }
    let profile = relief.profile();
    let step_m = (stretch * profile.step_m()).clamp(*STEPS_M.start(), *STEPS_M.end());
    let scaled = |value: &f64| (scale * value).clamp(-MAX_MPS2, MAX_MPS2);
    // All values are in range, so that there is always a relief.
    let profile = Profile::new(step_m, profile.values().iter().map(scaled).collect()).ok()?;
    Relief::new(profile, relief.force()).ok().map(Arc::new)
}

/// A height map with `stretch` times the side and `scale` times the acceleration; `None` if that is zero.
///
/// The acceleration is a second derivative of the height. On a tile that is `stretch` times as wide, the same heights
/// would give `1 / stretch²` of it, so that the heights are scaled by `stretch²`. The contact patch stays.
pub(super) fn shaped_height_map(map: &HeightMap, stretch: f64, scale: f64) -> Option<Arc<HeightMap>> {
    if scale == 0.0 {
        return None;
    }
    let factor = scale * (map.stretched_side_m(stretch) / map.side_m()).powi(2);
    // A smaller tile is steeper and a larger one flatter: in this order, nothing on the way exceeds the limits.
    let shaped = if stretch < 1.0 {
        map.scaled(factor).stretched(stretch)
    } else {
        map.stretched(stretch).scaled(factor)
    };
    Some(Arc::new(shaped))
}
