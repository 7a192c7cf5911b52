//! Nodes across and along a known lay, from the directions that were measured.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::recording::fit::FitError;
use crate::recording::fit::directional::groups::{difference, nearest};
use crate::recording::fit::directional::power_law::PowerLaw;
use crate::recording::fit::directional::unmixed;
use crate::recording::fit::pieces::Piece;
use crate::recording::fit::surface::Surface;
use crate::texture::{GrainNode, TextureModel};

/// Largest angle in rad, 12°, at which the spectrum and level of a measured direction are used for another one. The
/// power of the law changes by at most 9 % of its amplitude over this angle.
const NEAR_RAD: f64 = 12.0 / 180.0 * PI;

/// Texture model with grain across and along the lay, and the rotation of the lay. Its nodes have the speeds and forces
/// of the model of all directions.
pub(super) fn model(
    strokes: &[Vec<Piece>],
    axes_rad: &[f64],
    across_rad: f64,
    pooled: &TextureModel,
    order: usize,
) -> Result<TextureModel, FitError> {
    let surfaces: Vec<Surface<'_>> =
        strokes.iter().map(|pieces| Surface::new(pieces.iter().collect())).collect();
    let (mut across, mut along) = (Vec::new(), Vec::new());
    for node in pooled.nodes() {
        let measured = surfaces
            .iter()
            .map(|surface| surface.node(node.speed.0, node.force.0, order))
            .collect::<Result<Vec<GrainNode>, FitError>>()?;
        let measured = Measured::new(axes_rad, measured, across_rad);
        across.push(measured.at(across_rad));
        along.push(measured.at(across_rad + FRAC_PI_2));
    }
    let model = TextureModel::new(pooled.rate(), across, None)?;
    let model = match pooled.interpolation() {
        Some(interpolation) => model.with_interpolation(interpolation)?,
        None => model,
    };
    Ok(model.with_along(Some(along))?.with_turn_rad(across_rad))
}

/// Strokes measured at one speed and force, and the law of their power.
struct Measured<'a> {
    axes_rad: &'a [f64],
    /// Node of each axis; at least one.
    nodes: Vec<GrainNode>,
    /// Direction across the lay.
    across_rad: f64,
    /// `None` if the axes do not determine it.
    law: Option<PowerLaw>,
}

impl<'a> Measured<'a> {
    fn new(axes_rad: &'a [f64], nodes: Vec<GrainNode>, across_rad: f64) -> Self {
        let powers: Vec<f64> = nodes.iter().map(|node| node.level_mps2.powi(2)).collect();
        let law = PowerLaw::fit_across(axes_rad, &powers, across_rad);
        Self { axes_rad, nodes, across_rad, law }
    }

    /// Node in a direction.
    ///
    /// Within [`NEAR_RAD`] of a measured axis, it has the spectrum of that axis, and its power times the change of the
    /// law over the angle. Farther from all axes, it has the spectrum and the power of the law.
    fn at(&self, direction_rad: f64) -> GrainNode {
        let closest = nearest(self.axes_rad, direction_rad, PI);
        let (axis_rad, node) = (self.axes_rad[closest], &self.nodes[closest]);
        // Without a law, the closest axis is used as it is.
        let Some(law) = self.law else { return node.clone() };
        let change = law.at(direction_rad) / law.at(axis_rad);
        let near = || GrainNode { level_mps2: node.level_mps2 * change.sqrt(), ..node.clone() };
        if difference(axis_rad, direction_rad, PI).abs() <= NEAR_RAD {
            return near();
        }
        let shares = law.shares(self.axes_rad, self.across_rad, direction_rad);
        match shares.and_then(|shares| unmixed::lsf(&self.nodes, &shares)) {
            Some(lsf) => GrainNode { lsf, level_mps2: law.at(direction_rad).sqrt(), ..node.clone() },
            None => near(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Measured;
    use crate::texture::GrainNode;
    use crate::units::{MetersPerSecond, Newtons};
    use std::f64::consts::FRAC_1_SQRT_2;

    fn node(lsf: [f64; 2], level_mps2: f64) -> GrainNode {
        GrainNode { speed: MetersPerSecond(0.1), force: Newtons(1.0), lsf: lsf.to_vec(), level_mps2 }
    }

    #[test]
    fn near_a_measured_axis_its_spectrum_is_used_and_between_axes_that_of_the_law() {
        let axes = [0.0, 45.0, 90.0, 135.0].map(f64::to_radians);
        // The power is 2.5 + 1.5 cos 2θ: 4 at 0° and 1 at 90°.
        let nodes = vec![
            node([1.0, 2.0], 2.0),
            node([1.2, 2.2], 2.5_f64.sqrt()),
            node([1.4, 2.4], 1.0),
            node([1.2, 2.2], 2.5_f64.sqrt()),
        ];
        let measured = Measured::new(&axes, nodes, 0.0);
        let at = |degrees: f64| measured.at(degrees.to_radians());
        for degrees in [0.0, -10.0, 170.0] {
            assert_eq!(at(degrees).lsf, [1.0, 2.0], "{degrees}");
        }
        for (degrees, cosine) in [(0.0, 1.0), (170.0, 20_f64.to_radians().cos()), (22.5, FRAC_1_SQRT_2)] {
            let expected = (2.5_f64 + 1.5 * cosine).sqrt();
            let level = at(degrees).level_mps2;
            assert!((level - expected).abs() < 1e-6, "{level} at {degrees}, expected {expected}");
        }
        // Between both neighbors, also around half a turn, since their powers are similar.
        for degrees in [22.5, 157.5] {
            let between = at(degrees);
            assert!(
                (1.0..1.2).contains(&between.lsf[0]) && (2.0..2.2).contains(&between.lsf[1]),
                "{between:?}"
            );
        }
    }
}
