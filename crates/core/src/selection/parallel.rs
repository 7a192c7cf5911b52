//! Parallel analysis: are features better than random ones?
//!
//! All groups of three of the selected features predict the target linearly. Those whose multiple correlation exceeds
//! what random features reach are kept, and of them the features that appear in at least half as many groups as the
//! most frequent one. What random features reach is the 95th percentile, over 200 draws, of the best group of a draw:
//! the published single draw makes the threshold itself random.
//!
//! Random normal features look the same from every direction, so the threshold depends on the numbers of textures and
//! features alone, not on the target; it is worked out once for each pair of numbers.

use super::Standardized;
use crate::rng::{Random, derive_seed};
use crate::statistics::{centered, dot, quantile};

/// Features in a group.
const GROUP: usize = 3;
/// Draws of random features.
const N_DRAWS: usize = 200;
/// Rank of the threshold among the draws.
const RANK: f64 = 0.95;
/// Share of the highest count from which a feature is frequent.
const FREQUENT: f64 = 0.5;
/// Squared length of what a feature has beside the others of its group, below which it adds nothing.
const LEAST_LEFT: f64 = 1e-10;

/// What parallel analysis found.
#[derive(Clone, Debug, PartialEq)]
pub struct Parallel {
    /// Multiple correlation that a group had to exceed, 0..1.
    pub threshold: f64,
    /// How many groups did.
    pub n_winning: usize,
    /// In how many of those each feature is, in the order of the features given.
    pub counts: Vec<usize>,
    /// The features that are frequent; none where no group was better than random ones.
    pub kept: Vec<usize>,
}

/// Analyzes a selection of features; `None` with fewer than three, which make no group.
pub(super) fn analyze(
    train: &Standardized,
    target: &[f64],
    selected: &[usize],
    thresholds: &mut Thresholds,
) -> Option<Parallel> {
    (selected.len() >= GROUP).then(|| {
        let threshold = thresholds.get(train.n, selected.len());
        let columns: Vec<&[f64]> = selected.iter().map(|f| train.column(*f)).collect();
        frequent(&group_correlations(&columns, &centered(target)), selected, threshold)
    })
}

fn frequent(groups: &[([usize; GROUP], f64)], selected: &[usize], threshold: f64) -> Parallel {
    let mut counts = vec![0; selected.len()];
    let mut n_winning = 0;
    for (group, _) in groups.iter().filter(|(_, r)| *r > threshold) {
        n_winning += 1;
        for member in group {
            counts[*member] += 1;
        }
    }
    let least = FREQUENT * counts.iter().copied().max().unwrap_or(0) as f64;
    let is_frequent = |count: usize| count > 0 && count as f64 >= least;
    let kept = selected.iter().zip(&counts).filter(|(_, c)| is_frequent(**c)).map(|(f, _)| *f).collect();
    Parallel { threshold, n_winning, counts, kept }
}

/// Multiple correlations of a centered target with every group of centered columns.
pub(super) fn group_correlations(columns: &[&[f64]], target: &[f64]) -> Vec<([usize; GROUP], f64)> {
    let length = |v: &[f64]| dot(v, v).sqrt().max(f64::MIN_POSITIVE);
    let lengths: Vec<f64> = columns.iter().map(|c| length(c)).collect();
    let along: Vec<f64> =
        columns.iter().zip(&lengths).map(|(c, l)| dot(c, target) / (l * length(target))).collect();
    let k = columns.len();
    let mut between = vec![0.0; k * k];
    for i in 0..k {
        for j in 0..i {
            between[i * k + j] = dot(columns[i], columns[j]) / (lengths[i] * lengths[j]);
        }
    }
    let mut groups = Vec::with_capacity(k * k * k / 6);
    for c in 2..k {
        for b in 1..c {
            for a in 0..b {
                let products = [between[b * k + a], between[c * k + a], between[c * k + b]];
                let r = multiple_correlation(products, [along[a], along[b], along[c]]);
                groups.push(([a, b, c], r));
            }
        }
    }
    groups
}

/// Multiple correlation from the correlations between three features (first-second, first-third, second-third) and
/// with the target: each feature less what the ones before it hold.
fn multiple_correlation([ab, ac, bc]: [f64; 3], [a, b, c]: [f64; 3]) -> f64 {
    let gain = |product: f64, left: f64| if left > LEAST_LEFT { product * product / left } else { 0.0 };
    let (b_left, b_along) = (1.0 - ab * ab, b - ab * a);
    let bc_left = bc - ab * ac;
    // Where the second follows from the first, the third is beside the first alone.
    let share = if b_left > LEAST_LEFT { bc_left / b_left } else { 0.0 };
    let c_left = 1.0 - ac * ac - share * bc_left;
    let c_along = c - ac * a - share * b_along;
    (a * a + gain(b_along, b_left) + gain(c_along, c_left)).clamp(0.0, 1.0).sqrt()
}

/// The best groups of draws of `n_features` random features over `n_textures`.
pub(super) fn random_bests(n_textures: usize, n_features: usize, n_draws: usize, seed: u64) -> Vec<f64> {
    let mut random = Random::new(derive_seed(seed, &format!("parallel {n_textures} {n_features}")));
    // Centered features of n textures are normal in n - 1 dimensions, and any target will do: the first axis.
    let n = n_textures - 1;
    let mut target = vec![0.0; n];
    target[0] = 1.0;
    let mut best = || {
        let values: Vec<f64> = (0..n * n_features).map(|_| random.normal()).collect();
        let columns: Vec<&[f64]> = values.chunks_exact(n).collect();
        group_correlations(&columns, &target).iter().map(|(_, r)| *r).fold(0.0, f64::max)
    };
    (0..n_draws).map(|_| best()).collect()
}

/// Thresholds by numbers of textures and features, worked out when first asked for.
pub(super) struct Thresholds {
    seed: u64,
    known: std::collections::BTreeMap<(usize, usize), f64>,
}

impl Thresholds {
    pub(super) fn new(seed: u64) -> Self {
        Self { seed, known: std::collections::BTreeMap::new() }
    }

    fn get(&mut self, n_textures: usize, n_features: usize) -> f64 {
        let seed = self.seed;
        *self.known.entry((n_textures, n_features)).or_insert_with(|| {
            // There are draws, so there is a quantile; nothing exceeds a correlation of one.
            quantile(&random_bests(n_textures, n_features, N_DRAWS, seed), RANK).unwrap_or(1.0)
        })
    }
}
