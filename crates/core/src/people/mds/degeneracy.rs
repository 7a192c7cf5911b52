//! Detection of degenerate solutions of nonmetric multidimensional scaling.
//!
//! If the items form clusters in which all dissimilarities are lower than between them, a nonmetric solution can place
//! each cluster at one point. Its stress is then nearly 0, whatever the dissimilarities within and between the clusters
//! (Shepard 1974; Borg and Groenen, *Modern Multidimensional Scaling*, chapter 13). In another degenerate solution, all
//! distances are equal. With many ties, the primary approach can fit very different configurations exactly.
//! A low stress of such solutions says nothing about the fit. The remedy is a transformation with less freedom, such as
//! [`Transform::Interval`](crate::people::mds::Transform::Interval).

use crate::people::mds::ShepardPair;

/// Stress below which a solution can be degenerate. Solutions that collapse only partly have a higher stress, which
/// still describes their fit.
const HARDLY_ANY_STRESS: f64 = 0.01;

/// Stress of a fit that is practically exact.
const NO_STRESS: f64 = 1e-3;

/// Distance, relative to the root mean square of all distances, below which two points coincide, and difference below
/// which two disparities are the same.
const COINCIDENT: f64 = 0.01;

/// Dissimilarity, relative to the root mean square of all dissimilarities, from which two items clearly differ.
const DISTINCT: f64 = 0.1;

/// Signs that a solution is degenerate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Degeneracy {
    /// Number of pairs at nearly the same point, although their dissimilarity is neither the lowest nor small.
    pub n_coincident: usize,
    /// Largest dissimilarity of a pair at nearly the same point.
    pub largest_coincident: f64,
    /// Number of different disparities: steps of the Shepard diagram.
    pub n_steps: usize,
    /// Number of different dissimilarities.
    pub n_levels: usize,
    /// Number of pairs.
    pub n_pairs: usize,
}

/// Signs that a solution with this stress-1 is degenerate; `None` if it is not. `pairs` is its Shepard diagram, in the
/// order of dissimilarity.
///
/// A solution is degenerate if its stress is below 0.01, and clearly different items coincide or all disparities are
/// equal. It is also degenerate if its stress is below 0.001, although each dissimilarity is shared by more than two
/// pairs on average.
pub fn degeneracy(pairs: &[ShepardPair], stress: f64) -> Option<Degeneracy> {
    let lowest = pairs.first()?.dissimilarity;
    if stress >= HARDLY_ANY_STRESS {
        return None;
    }
    let typical = root_mean_square(pairs, |pair| pair.distance);
    let different = DISTINCT * root_mean_square(pairs, |pair| pair.dissimilarity);
    let is_coincident = |pair: &&ShepardPair| {
        let is_different = pair.dissimilarity > lowest && pair.dissimilarity > different;
        is_different && pair.distance < COINCIDENT * typical
    };
    let coincident: Vec<f64> = pairs.iter().filter(is_coincident).map(|pair| pair.dissimilarity).collect();
    let n_steps = 1 + pairs.windows(2).filter(|two| rises(two, COINCIDENT * typical)).count();
    let n_levels = 1 + pairs.windows(2).filter(|two| two[0].dissimilarity < two[1].dissimilarity).count();
    let found = Degeneracy {
        n_coincident: coincident.len(),
        largest_coincident: coincident.into_iter().fold(0.0, f64::max),
        n_steps,
        n_levels,
        n_pairs: pairs.len(),
    };
    let is_one_step = n_steps == 1 && n_levels > 1;
    let is_loose = stress < NO_STRESS && 2 * n_levels < pairs.len();
    (found.n_coincident > 0 || is_one_step || is_loose).then_some(found)
}

fn root_mean_square(pairs: &[ShepardPair], of: impl Fn(&ShepardPair) -> f64) -> f64 {
    (pairs.iter().map(|pair| of(pair) * of(pair)).sum::<f64>() / pairs.len() as f64).sqrt()
}

/// Whether the disparity of the second pair exceeds that of the first by more than `least`.
fn rises(two: &[ShepardPair], least: f64) -> bool {
    two[1].disparity - two[0].disparity > least
}

#[cfg(test)]
mod tests {
    use proptest::prelude::{ProptestConfig, prop_assert, proptest};

    use super::{Degeneracy, degeneracy};
    use crate::maths::rng::lcg_noise;
    use crate::people::dissimilarities::Dissimilarities;
    use crate::people::mds::{MdsOptions, ShepardPair, Transform, nonmetric, shepard};

    /// Three clusters of three items. Dissimilarities are 10, 20 or 30 within a cluster and 80 or 90 between two.
    fn clusters() -> Dissimilarities {
        let value = |i: usize, j: usize| {
            if i / 3 == j / 3 { 10.0 * ((i + j) % 3 + 1) as f64 } else { 80.0 + 10.0 * ((i + j) % 2) as f64 }
        };
        let pairs = (0..9).flat_map(|i| (i + 1..9).map(move |j| Some(value(i, j))));
        Dissimilarities::from_condensed(9, pairs.collect()).unwrap()
    }

    fn of(items: &Dissimilarities, transform: Transform) -> (f64, Option<Degeneracy>, Vec<ShepardPair>) {
        let found = nonmetric(items, 2, &MdsOptions { transform, ..MdsOptions::usual(1) }).unwrap();
        let pairs = shepard(items, &found.points, transform).unwrap();
        (found.stress, degeneracy(&pairs, found.stress), pairs)
    }

    #[test]
    fn clusters_collapse_with_ordinal_transformations_but_not_with_interval_scaling() {
        // Three points with equal distances satisfy every order within and between the clusters.
        for transform in [Transform::PrimaryTies, Transform::SecondaryTies] {
            let (stress, found, _) = of(&clusters(), transform);
            let found = found.unwrap();
            assert!(stress < 1e-4, "{transform:?}: {stress}");
            assert!(found.n_coincident > 0 && found.largest_coincident >= 20.0, "{transform:?}: {found:?}");
            assert_eq!(found.n_levels, 5);
        }
        let (stress, found, pairs) = of(&clusters(), Transform::Interval);
        assert_eq!(found, None);
        // Items of a cluster stay apart, and clusters are farther apart.
        let mean = |is_within: bool| {
            let chosen = pairs.iter().filter(|pair| (pair.dissimilarity < 50.0) == is_within);
            let (sum, n) = chosen.fold((0.0, 0.0), |(sum, n), pair| (sum + pair.distance, n + 1.0));
            sum / n
        };
        assert!(stress > 0.01 && mean(true) > 0.05 * mean(false), "{stress}: {} {}", mean(true), mean(false));
    }

    #[test]
    fn signs_are_those_of_the_shepard_diagram() {
        let pair = |dissimilarity: f64, distance: f64| ShepardPair {
            items: [0, 1],
            dissimilarity,
            distance,
            disparity: distance,
        };
        let collapsed = [pair(5.0, 0.0), pair(20.0, 0.0), pair(30.0, 0.0), pair(70.0, 1.0), pair(90.0, 1.0)];
        let signs =
            Degeneracy { n_coincident: 2, largest_coincident: 30.0, n_steps: 2, n_levels: 5, n_pairs: 5 };
        assert_eq!(degeneracy(&collapsed, 0.0), Some(signs));
        // A stress that describes the fit is no sign, and items that do not differ may coincide.
        assert_eq!(degeneracy(&collapsed, 0.01), None);
        assert_eq!(degeneracy(&[pair(0.0, 0.0), pair(20.0, 0.2), pair(90.0, 0.9)], 0.0), None);
        assert_eq!(degeneracy(&[pair(30.0, 0.0), pair(30.0, 0.0), pair(90.0, 0.9)], 0.0), None);
        let equal = [pair(10.0, 1.0), pair(50.0, 1.0), pair(90.0, 1.0)];
        assert_eq!(degeneracy(&equal, 0.0).map(|signs| (signs.n_steps, signs.n_levels)), Some((1, 3)));
        assert_eq!(degeneracy(&equal[..1], 0.0), None, "one pair has one distance");
        // Seven pairs of three dissimilarities are fitted exactly by many configurations.
        let tied: Vec<ShepardPair> = [20.0, 20.0, 20.0, 50.0, 50.0, 90.0, 90.0]
            .iter()
            .zip(2..)
            .map(|(d, k)| pair(*d, f64::from(k)))
            .collect();
        assert!(degeneracy(&tied, 1e-4).is_some() && degeneracy(&tied, 2e-3).is_none());
        assert_eq!(degeneracy(&[], 0.0), None);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(16))]

        /// Noise-free distances have a stress of nearly 0 as well, but their solution is not degenerate.
        #[test]
        fn distances_of_scattered_points_are_not_degenerate(seed in 0_u64..1000) {
            // Points of a jittered grid: none coincide.
            let jitter = lcg_noise(24, seed);
            let point = |i: usize| [(i % 4) as f64 + 0.3 * jitter[2 * i], (i / 4) as f64 + 0.3 * jitter[2 * i + 1]];
            let distance = |i: usize, j: usize| {
                let ([a, b], [c, d]) = (point(i), point(j));
                (a - c).hypot(b - d)
            };
            let pairs = (0..12).flat_map(|i| (i + 1..12).map(move |j| (i, j)));
            let condensed = pairs.map(|(i, j)| Some(distance(i, j))).collect();
            let items = Dissimilarities::from_condensed(12, condensed).unwrap();
            let (_, found, _) = of(&items, Transform::PrimaryTies);
            prop_assert!(found.is_none(), "{:?}", found);
        }
    }
}
