//! Difference between the grain along and across the lay, as a function over a space.
//!
//! It is the sum of the textures' differences in ln density, with the weights that the textures have in the field.
//! Across and along the lay the field is therefore equally smooth, and only directional textures make it directional.
//! Separate fields for both grains would select their own components and ridges; the textures that they give for
//! isotropic neighbors would differ along and across a lay that nobody has measured.

use crate::space::field::Site;

/// Differences of the directional textures of a field.
#[derive(Clone, Debug)]
pub(super) struct Anisotropy {
    /// Index of each directional site, and ln density along its lay minus that across it, contact by contact, bin by
    /// bin.
    sites: Vec<(usize, Vec<f32>)>,
    /// Lowest and highest difference of all sites, including the zero of isotropic ones. Weights of a field can be
    /// negative or above one; no texture may become more directional than its parents.
    limits: Vec<(f32, f32)>,
}

impl Anisotropy {
    /// Differences of the sites of a field; `None` if all of them are isotropic.
    pub(super) fn new(sites: &[Site<'_>]) -> Option<Self> {
        let mut directional: Vec<(usize, Vec<f32>)> = Vec::new();
        for (index, site) in sites.iter().enumerate() {
            directional.extend(difference(site).map(|difference| (index, difference)));
        }
        let mut limits = vec![(0.0_f32, 0.0_f32); directional.first()?.1.len()];
        for (_, difference) in &directional {
            for ((low, high), value) in limits.iter_mut().zip(difference) {
                (*low, *high) = (low.min(*value), high.max(*value));
            }
        }
        Some(Self { sites: directional, limits })
    }

    /// Difference at a point where the sites have these weights, optionally moved by a weight of 0..1 towards that of
    /// one site.
    pub(super) fn at(&self, weights: &[f64], towards: Option<(Site<'_>, f64)>) -> Vec<f32> {
        let mut sum = vec![0.0_f32; self.limits.len()];
        for (index, difference) in &self.sites {
            let weight = weights.get(*index).map_or(0.0, |weight| *weight as f32);
            for (sum, value) in sum.iter_mut().zip(difference) {
                *sum += weight * value;
            }
        }
        for (sum, (low, high)) in sum.iter_mut().zip(&self.limits) {
            *sum = sum.clamp(*low, *high);
        }
        if let Some((own, share)) = towards {
            let own = difference(&own).unwrap_or_else(|| vec![0.0; sum.len()]);
            for (field, own) in sum.iter_mut().zip(own) {
                *field += share as f32 * (own - *field);
            }
        }
        sum
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
    use crate::space::sampled::SampledGrain;

    fn grain(ln_psd: [f32; 2]) -> SampledGrain {
        SampledGrain { ln_psd: ln_psd.to_vec(), lsf: Vec::new(), ln_level: Vec::new() }
    }

    fn site<'a>(grain: &'a SampledGrain, along: Option<&'a SampledGrain>) -> Site<'a> {
        Site { at: [0.0, 0.0], grain, along, friction: None, tap: None }
    }

    #[test]
    fn only_directional_textures_make_a_field_directional() {
        let (across, along) = (grain([1.0, 2.0]), grain([0.0, 5.0]));
        let isotropic = site(&across, None);
        assert!(Anisotropy::new(&[isotropic, isotropic]).is_none());
        assert!(Anisotropy::new(&[]).is_none());
        let field = Anisotropy::new(&[isotropic, site(&across, Some(&along)), isotropic]).unwrap();
        assert_eq!(field.at(&[0.5, 0.0, 0.5], None), [0.0, 0.0]);
        assert_eq!(field.at(&[0.5, 0.5, 0.0], None), [-0.5, 1.5]);
    }

    #[test]
    fn no_weight_makes_a_texture_more_directional_than_its_parents() {
        let (across, along) = (grain([1.0, 2.0]), grain([0.0, 5.0]));
        let field = Anisotropy::new(&[site(&across, Some(&along)), site(&across, None)]).unwrap();
        assert_eq!(field.at(&[1.25, -0.25], None), [-1.0, 3.0]);
        assert_eq!(field.at(&[-0.25, 1.25], None), [0.0, 0.0]);
    }

    #[test]
    fn a_pinned_texture_keeps_its_own_difference() {
        let (across, along) = (grain([1.0, 2.0]), grain([0.0, 5.0]));
        let (directional, isotropic) = (site(&across, Some(&along)), site(&across, None));
        let field = Anisotropy::new(&[directional, isotropic]).unwrap();
        assert_eq!(field.at(&[0.5, 0.5], Some((directional, 1.0))), [-1.0, 3.0]);
        assert_eq!(field.at(&[0.5, 0.5], Some((isotropic, 1.0))), [0.0, 0.0]);
        assert_eq!(field.at(&[0.5, 0.5], Some((directional, 0.5))), [-0.75, 2.25]);
    }
}
