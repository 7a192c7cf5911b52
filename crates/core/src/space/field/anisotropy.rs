//! Differences of the grains across and along the lay of a point from the field across the lay of every texture, as a
//! function over a space.
//!
//! It is the sum of the textures' differences in ln density, with the weights that the textures have in the field.
//! Across and along the lay the field is therefore equally smooth, and only directional textures make it directional.
//! Separate fields for both grains would select their own components and ridges; the textures that they give for
//! isotropic neighbors would differ along and across a lay that nobody has measured.
//!
//! A texture whose lay is rotated against that of the point contributes a part of its difference across it, too
//! ([`crate::space::mean_axes`]).

use crate::maths::sums::add_times;
use crate::space::field::Site;
use crate::space::mean_axes::MeanAxes;

/// Differences of the directional textures of a field.
#[derive(Clone, Debug)]
pub(super) struct Anisotropy {
    sites: Vec<Directional>,
    /// Lowest and highest difference of all sites, including the zero of isotropic ones. Weights of a field can be
    /// negative or above one; no texture may become more directional than its parents.
    limits: Vec<(f32, f32)>,
}

/// Directional texture.
#[derive(Clone, Debug)]
struct Directional {
    /// Index of its site.
    index: usize,
    turn_rad: f64,
    /// ln density along its lay minus that across it, contact by contact, bin by bin.
    difference: Vec<f32>,
}

impl Anisotropy {
    /// Differences of the sites of a field; `None` if all of them are isotropic.
    pub(super) fn new(sites: &[Site<'_>]) -> Option<Self> {
        let mut directional: Vec<Directional> = Vec::new();
        for (index, site) in sites.iter().enumerate() {
            let of = |difference| Directional { index, turn_rad: site.turn_rad, difference };
            directional.extend(difference(site).map(of));
        }
        let mut limits = vec![(0.0_f32, 0.0_f32); directional.first()?.difference.len()];
        for Directional { difference, .. } in &directional {
            for ((low, high), value) in limits.iter_mut().zip(difference) {
                (*low, *high) = (low.min(*value), high.max(*value));
            }
        }
        Some(Self { sites: directional, limits })
    }

    /// Differences across and along the lay of `axes`, at a point where the sites have these weights, optionally moved by a
    /// weight of 0..1 towards those of one site.
    pub(super) fn at(
        &self,
        weights: &[f64],
        axes: &MeanAxes,
        towards: Option<(Site<'_>, f64)>,
    ) -> [Vec<f32>; 2] {
        [0, 1].map(|direction| {
            let mut sum = vec![0.0_f32; self.limits.len()];
            for Directional { index, turn_rad, difference } in &self.sites {
                let weight = weights.get(*index).map_or(0.0, |weight| *weight);
                let share = axes.shares_along(*turn_rad)[direction];
                add_times(difference, (weight * share) as f32, &mut sum);
            }
            for (sum, (low, high)) in sum.iter_mut().zip(&self.limits) {
                *sum = sum.clamp(*low, *high);
            }
            if let Some((own, towards)) = towards {
                let share = axes.shares_along(own.turn_rad)[direction] as f32;
                let own = difference(&own).unwrap_or_else(|| vec![0.0; sum.len()]);
                for (field, own) in sum.iter_mut().zip(own) {
                    *field += towards as f32 * (share * own - *field);
                }
            }
            sum
        })
    }
}

/// ln density along the lay minus that across it; `None` for an isotropic texture.
fn difference(site: &Site<'_>) -> Option<Vec<f32>> {
    let along = site.along?.ln_psd.iter();
    Some(along.zip(&site.grain.ln_psd).map(|(along, across)| along - across).collect())
}

#[cfg(test)]
mod tests {
    use super::{Anisotropy, Site};
    use crate::space::mean_axes::MeanAxes;
    use crate::space::sampled::SampledGrain;

    fn grain(ln_psd: [f32; 2]) -> SampledGrain {
        SampledGrain { ln_psd: ln_psd.to_vec(), lsf: Vec::new(), ln_level: Vec::new() }
    }

    fn site<'a>(grain: &'a SampledGrain, along: Option<&'a SampledGrain>) -> Site<'a> {
        Site { at: [0.0; 6], grain, along, turn_rad: 0.3, friction: None, tap: None }
    }

    const AXES: MeanAxes = MeanAxes::at(0.3);

    #[test]
    fn only_directional_textures_make_a_field_directional() {
        let (across, along) = (grain([1.0, 2.0]), grain([0.0, 5.0]));
        let isotropic = site(&across, None);
        assert!(Anisotropy::new(&[isotropic, isotropic]).is_none());
        assert!(Anisotropy::new(&[]).is_none());
        let field = Anisotropy::new(&[isotropic, site(&across, Some(&along)), isotropic]).unwrap();
        assert_eq!(field.at(&[0.5, 0.0, 0.5], &AXES, None), [[0.0; 2]; 2]);
        assert_eq!(field.at(&[0.5, 0.5, 0.0], &AXES, None), [[0.0, 0.0], [-0.5, 1.5]]);
    }

    #[test]
    fn no_weight_makes_a_texture_more_directional_than_its_parents() {
        let (across, along) = (grain([1.0, 2.0]), grain([0.0, 5.0]));
        let field = Anisotropy::new(&[site(&across, Some(&along)), site(&across, None)]).unwrap();
        assert_eq!(field.at(&[1.25, -0.25], &AXES, None)[1], [-1.0, 3.0]);
        assert_eq!(field.at(&[-0.25, 1.25], &AXES, None)[1], [0.0, 0.0]);
    }

    #[test]
    fn a_pinned_texture_keeps_its_own_difference() {
        let (across, along) = (grain([1.0, 2.0]), grain([0.0, 5.0]));
        let (directional, isotropic) = (site(&across, Some(&along)), site(&across, None));
        let field = Anisotropy::new(&[directional, isotropic]).unwrap();
        let at = |pinned, share| field.at(&[0.5, 0.5], &AXES, Some((pinned, share)));
        assert_eq!(at(directional, 1.0), [[0.0, 0.0], [-1.0, 3.0]]);
        assert_eq!(at(isotropic, 1.0), [[0.0; 2]; 2]);
        assert_eq!(at(directional, 0.5)[1], [-0.75, 2.25]);
    }

    #[test]
    fn equal_textures_at_right_angles_differ_alike_across_and_along() {
        let (across, along) = (grain([1.0, 2.0]), grain([0.0, 5.0]));
        let upright = site(&across, Some(&along));
        let turned = Site { turn_rad: 0.3 + std::f64::consts::FRAC_PI_2, ..upright };
        let field = Anisotropy::new(&[upright, turned]).unwrap();
        let axes = MeanAxes::mean([upright, turned].into_iter().map(|site| (site.turn_rad, 0.5)));
        for found in field.at(&[0.5, 0.5], &axes, None) {
            assert!((found[0] + 0.5).abs() < 1e-6 && (found[1] - 1.5).abs() < 1e-6, "{found:?}");
        }
        // The grain of the turned texture across the lay of the other one is that along its own lay.
        let [found, along] = field.at(&[0.0, 1.0], &AXES, None);
        assert!((found[0] + 1.0).abs() < 1e-6 && (found[1] - 3.0).abs() < 1e-6, "{found:?}");
        assert!(along.iter().all(|difference| difference.abs() < 1e-6), "{along:?}");
    }
}
