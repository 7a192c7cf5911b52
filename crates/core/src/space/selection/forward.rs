//! Sequential forward selection: adds one feature after the other while the partial F of the new feature is
//! significant.
//!
//! `F = (RSS₀ - RSS₁) / (RSS₁ / (n - k - 1))` with 1 and `n - k - 1` degrees of freedom, where k includes the new
//! feature. The published rule, "error significantly increased, p >= 0.01", cannot be meant literally, because an added
//! regressor never raises the training error. Selection therefore stops when the error no longer decreases
//! significantly.
//!
//! For every feature, greedy selection needs its product with the residual and its squared length orthogonal to the
//! selected features. Both are updated from one product with the newest direction, so each step is one pass over the
//! features.

use super::Standardized;
use crate::maths::least_squares::take_off;
use crate::maths::statistics::{centered, dot, f_upper_tail};

/// Significance level: a new feature needs a smaller p-value.
pub(super) const P_STOP: f64 = 0.01;

/// Minimum fraction of a feature's squared length orthogonal to the selected features; below it, the feature is
/// dependent.
const LEAST_LEFT: f64 = 1e-10;
/// Fraction of the variance below which the target counts as fully explained.
const EXPLAINED: f64 = 1e-12;

/// Rule that chooses the next feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The feature with the largest partial F.
    Greedy,
    /// The next feature in a fixed ranking by correlation with the target.
    Ranked,
}

/// Result of forward selection.
#[derive(Clone, Debug, PartialEq)]
pub struct Forward {
    /// Indices of the selected features, in order of selection.
    pub features: Vec<usize>,
    /// p-values of all candidates: those of the selected features, then that of the rejected candidate that ended the
    /// selection, if any.
    pub p_values: Vec<f64>,
}

/// Selects at most `most` features for a target, 0..100.
pub(super) fn select(train: &Standardized, target: &[f64], order: Order, most: usize) -> Forward {
    let mut residual = centered(target);
    let total = dot(&residual, &residual);
    let mut left_over = total;
    let mut products: Vec<f64> = train.columns().map(|c| dot(c, &residual)).collect();
    let mut lengths_squared = vec![1.0; products.len()];
    let ranking = match order {
        Order::Greedy => Vec::new(),
        Order::Ranked => ranked(&products),
    };
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut forward = Forward { features: Vec::new(), p_values: Vec::new() };
    while forward.features.len() < most && left_over > EXPLAINED * total {
        let candidate = match order {
            Order::Greedy => strongest(&products, &lengths_squared),
            Order::Ranked => ranking.get(forward.features.len()).copied(),
        };
        let Some(candidate) = candidate else { break };
        let dof = (train.n - 2 - forward.features.len()) as f64;
        let direction = direction(train.column(candidate), &basis);
        let step = direction.as_ref().map_or(0.0, |d| dot(d, &residual));
        let after = (left_over - step * step).max(0.0);
        let p = f_upper_tail((left_over - after) / (after / dof), 1.0, dof);
        forward.p_values.push(p);
        let Some(direction) = direction.filter(|_| p < P_STOP) else { break };
        for (value, d) in residual.iter_mut().zip(&direction) {
            *value -= step * d;
        }
        left_over = dot(&residual, &residual);
        forward.features.push(candidate);
        if order == Order::Greedy {
            for ((column, product), length) in train.columns().zip(&mut products).zip(&mut lengths_squared) {
                let along = dot(column, &direction);
                *product -= step * along;
                *length -= along * along;
            }
            // Rounding must not make a selected feature a candidate again.
            lengths_squared[candidate] = 0.0;
        }
        basis.push(direction);
    }
    forward
}

/// Feature indices in descending order of the magnitude of their correlation; ties keep their order.
pub(super) fn ranked(products: &[f64]) -> Vec<usize> {
    let mut ranking: Vec<usize> = (0..products.len()).collect();
    ranking.sort_by(|a, b| products[*b].abs().total_cmp(&products[*a].abs()));
    ranking
}

/// Feature that explains most of the residual.
fn strongest(products: &[f64], lengths_squared: &[f64]) -> Option<usize> {
    let mut best = (0.0, None);
    for (feature, (product, length)) in products.iter().zip(lengths_squared).enumerate() {
        let gain = product * product;
        if *length > LEAST_LEFT && gain > best.0 * length {
            best = (gain / length, Some(feature));
        }
    }
    best.1
}

/// Unit vector of the part of a column orthogonal to the basis; `None` if that part is zero.
fn direction(column: &[f64], basis: &[Vec<f64>]) -> Option<Vec<f64>> {
    let mut rest = column.to_vec();
    take_off(&mut rest, basis);
    let squared = dot(&rest, &rest);
    if squared <= LEAST_LEFT {
        return None;
    }
    // Orthogonalizes twice: the first pass leaves rounding errors relative to the column, not to the remainder.
    take_off(&mut rest, basis);
    let length = dot(&rest, &rest).sqrt();
    Some(rest.iter().map(|r| r / length).collect())
}
