//! Multidimensional scaling of the perceptual space, with a metric solution in place of a degenerate one.
//!
//! Sorts of few textures often fall into clusters, for which nonmetric scaling has degenerate solutions
//! ([`crate::people::mds::degeneracy()`]). The remedy in the literature is a transformation with less freedom (Borg and
//! Groenen, *Modern Multidimensional Scaling*, chapter 13). Secondary ties are not enough: most dissimilarities from
//! sorts are not tied. Interval scaling is.

use crate::people::dissimilarities::Dissimilarities;
use crate::people::mds::{
    ByDimension, Degeneracy, Mds, MdsError, MdsOptions, ShepardPair, Transform, degeneracy, shepard,
};
use crate::space::space_build::SpaceOptions;

/// Sum of squares on the last axis, relative to the first, below which the points do not span all dimensions.
const FLAT: f64 = 1e-6;

/// A degenerate solution of the perceptual space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DegenerateScaling {
    /// Transformation that gave it.
    pub transform: Transform,
    /// Signs that it is degenerate.
    pub signs: Degeneracy,
    /// Whether interval scaling replaced it. If not, it is the perceptual space.
    pub is_replaced: bool,
    /// Whether interval scaling was tried and gave points in fewer dimensions, so that it did not replace it.
    pub is_flat: bool,
}

/// Perceptual space for one to the requested number of dimensions.
pub(super) struct Scaled<'a> {
    /// Scaling for further numbers of dimensions.
    pub(super) scaling: ByDimension<'a>,
    /// Options that were used.
    pub(super) options: MdsOptions,
    pub(super) by_dimension: Vec<Mds>,
    /// The configuration in the requested number of dimensions.
    pub(super) perceptual: Mds,
    pub(super) shepard: Vec<ShepardPair>,
    pub(super) degenerate: Option<DegenerateScaling>,
}

/// Scales the dissimilarities to `options.n_dims` dimensions, which must be 1 or more. Interval scaling replaces a
/// degenerate solution, unless [`SpaceOptions::transform`] states the transformation or the textures lie in fewer
/// dimensions.
///
/// # Errors
/// See [`MdsError`].
pub(super) fn scaled<'a>(
    dissimilarities: &'a Dissimilarities,
    options: &SpaceOptions,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<Scaled<'a>, MdsError> {
    let transform = options.transform.unwrap_or(options.mds.transform);
    let first = by(transform, dissimilarities, options, go_on)?;
    let Some(degenerate) = first.degenerate.filter(|_| options.transform.is_none()) else {
        return Ok(first);
    };
    let metric = by(Transform::Interval, dissimilarities, options, go_on)?;
    if is_flat(&metric.perceptual) {
        return Ok(Scaled { degenerate: Some(DegenerateScaling { is_flat: true, ..degenerate }), ..first });
    }
    Ok(Scaled { degenerate: Some(DegenerateScaling { is_replaced: true, ..degenerate }), ..metric })
}

fn by<'a>(
    transform: Transform,
    dissimilarities: &'a Dissimilarities,
    options: &SpaceOptions,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<Scaled<'a>, MdsError> {
    let mds = MdsOptions { transform, ..options.mds.clone() };
    let scaling = ByDimension::new(dissimilarities, &mds)?;
    let by_dimension = scaling.best(1..=options.n_dims, None, go_on)?;
    let perceptual = by_dimension[options.n_dims - 1].clone();
    let shepard = shepard(dissimilarities, &perceptual.points, transform)?;
    let signs = match transform {
        Transform::PrimaryTies | Transform::SecondaryTies => degeneracy(&shepard, perceptual.stress),
        Transform::Interval => None,
    };
    let degenerate =
        signs.map(|signs| DegenerateScaling { transform, signs, is_replaced: false, is_flat: false });
    Ok(Scaled { scaling, options: mds, by_dimension, perceptual, shepard, degenerate })
}

/// Whether the points span fewer dimensions than they have coordinates. Their axes are principal axes, the longest
/// first.
fn is_flat(mds: &Mds) -> bool {
    let on = |axis: fn(&[f64]) -> Option<&f64>| -> f64 {
        mds.points.iter().filter_map(|point| axis(point)).map(|x| x * x).sum()
    };
    on(<[f64]>::last) < FLAT * on(<[f64]>::first)
}

#[cfg(test)]
mod tests {
    use super::scaled;
    use crate::people::dissimilarities::Dissimilarities;
    use crate::people::mds::{MdsOptions, Transform};
    use crate::space::space_build::SpaceOptions;

    /// Three clusters of four items, whose dissimilarities differ within and between the clusters.
    fn clusters() -> Dissimilarities {
        let value = |i: usize, j: usize| {
            if i / 4 == j / 4 {
                10.0 + 7.0 * ((i + 2 * j) % 4) as f64
            } else {
                75.0 + 8.0 * ((i + j) % 3) as f64
            }
        };
        let pairs = (0..12).flat_map(|i| (i + 1..12).map(move |j| Some(value(i, j))));
        Dissimilarities::from_condensed(12, pairs.collect()).unwrap()
    }

    /// Dissimilarities of points on a line with unequal gaps: no remedy gives them two dimensions.
    fn two_clusters_on_a_line() -> Dissimilarities {
        let at = |i: usize| [0.0, 0.0, 0.0, 0.0, 20.0, 100.0][i];
        let pairs = (0..6).flat_map(|i| (i + 1..6).map(move |j| Some(f64::abs(at(i) - at(j)))));
        Dissimilarities::from_condensed(6, pairs.collect()).unwrap()
    }

    #[test]
    fn a_degenerate_solution_is_replaced_unless_its_transformation_is_stated() {
        let items = clusters();
        let usual = SpaceOptions::usual(1);
        let found = scaled(&items, &usual, &|| true).unwrap();
        let degenerate = found.degenerate.unwrap();
        assert!(degenerate.is_replaced && degenerate.transform == Transform::PrimaryTies);
        assert_eq!(found.options.transform, Transform::Interval);
        assert!(found.perceptual.stress > 0.01 && found.by_dimension.len() == 2);
        for transform in [Transform::PrimaryTies, Transform::SecondaryTies] {
            let options = SpaceOptions { transform: Some(transform), ..usual.clone() };
            let found = scaled(&items, &options, &|| true).unwrap();
            assert_eq!(found.options.transform, transform);
            assert!(found.degenerate.is_some_and(|degenerate| !degenerate.is_replaced), "{transform:?}");
        }
        let options = SpaceOptions { transform: Some(Transform::Interval), ..usual };
        assert_eq!(scaled(&items, &options, &|| true).unwrap().degenerate, None);
    }

    #[test]
    fn textures_on_a_line_keep_their_nonmetric_solution() {
        let items = two_clusters_on_a_line();
        let options = SpaceOptions { mds: MdsOptions::usual(2), ..SpaceOptions::usual(2) };
        let found = scaled(&items, &options, &|| true).unwrap();
        assert_eq!(found.options.transform, Transform::PrimaryTies);
        assert!(found.degenerate.is_none_or(|degenerate| degenerate.is_flat && !degenerate.is_replaced));
    }
}
