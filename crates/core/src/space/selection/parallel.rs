//! Parallel analysis: tests whether the selected features predict better than random features.
//!
//! Every group of three selected features predicts the target linearly. A group wins if its multiple correlation
//! exceeds the threshold for random features. Features are kept if they appear in at least half as many winning groups
//! as the most frequent feature. The threshold is the 95th percentile, over 200 random draws, of the highest multiple
//! correlation of a group in a draw. The published version uses a single draw, which makes the threshold itself random.
//!
//! Random normal features have no preferred direction, so the threshold depends only on the numbers of textures and
//! features, not on the target. It is computed once for each pair of numbers.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use super::Standardized;
use crate::maths::rng::{Random, derive_seed};
use crate::maths::statistics::{centered, dot, quantile};

/// Number of features in a group.
const GROUP: usize = 3;
/// Number of random draws.
const N_DRAWS: usize = 200;
/// Quantile of the draws that is the threshold.
const RANK: f64 = 0.95;
/// Minimum count of a kept feature, relative to the highest count.
const FREQUENT: f64 = 0.5;
/// Squared length of a feature orthogonal to the others of its group below which it adds nothing.
const LEAST_LEFT: f64 = 1e-10;

/// Result of parallel analysis.
#[derive(Clone, Debug, PartialEq)]
pub struct Parallel {
    /// Multiple correlation that a group must exceed, 0..1.
    pub threshold: f64,
    /// Number of winning groups.
    pub n_winning: usize,
    /// Number of winning groups that contain each feature, in the order of the given features.
    pub counts: Vec<usize>,
    /// Indices of the kept features; empty if no group exceeds the threshold.
    pub kept: Vec<usize>,
}

/// Analyzes a selection of features; `None` with fewer than three, which form no group.
pub(super) fn analyze(
    train: &Standardized,
    target: &[f64],
    selected: &[usize],
    thresholds: &Thresholds,
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

/// Multiple correlations of a centered target with every group of three centered columns.
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
/// those with the target, by successive orthogonalization.
fn multiple_correlation([ab, ac, bc]: [f64; 3], [a, b, c]: [f64; 3]) -> f64 {
    let gain = |product: f64, left: f64| if left > LEAST_LEFT { product * product / left } else { 0.0 };
    let (b_left, b_along) = (1.0 - ab * ab, b - ab * a);
    let bc_left = bc - ab * ac;
    // If the second feature depends on the first, the third is orthogonalized against the first alone.
    let share = if b_left > LEAST_LEFT { bc_left / b_left } else { 0.0 };
    let c_left = 1.0 - ac * ac - share * bc_left;
    let c_along = c - ac * a - share * b_along;
    (a * a + gain(b_along, b_left) + gain(c_along, c_left)).clamp(0.0, 1.0).sqrt()
}

/// Best multiple correlation in each draw of `n_features` random features over `n_textures` textures.
pub(super) fn random_bests(n_textures: usize, n_features: usize, n_draws: usize, seed: u64) -> Vec<f64> {
    let mut random = Random::new(derive_seed(seed, &format!("parallel {n_textures} {n_features}")));
    // Centered features of n textures are normal in n - 1 dimensions; by symmetry any target works, here the first
    // axis.
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

/// Thresholds by numbers of textures and features, computed on first use.
pub(super) struct Thresholds {
    seed: u64,
    known: Mutex<BTreeMap<(usize, usize), f64>>,
}

impl Thresholds {
    pub(super) fn new(seed: u64) -> Self {
        Self { seed, known: Mutex::default() }
    }

    fn get(&self, n_textures: usize, n_features: usize) -> f64 {
        let seed = self.seed;
        // Held while a threshold is computed, so that no other thread computes it too.
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        *known.entry((n_textures, n_features)).or_insert_with(|| {
            // There is at least one draw, so the quantile exists; no correlation exceeds 1.
            quantile(&random_bests(n_textures, n_features, N_DRAWS, seed), RANK).unwrap_or(1.0)
        })
    }
}
