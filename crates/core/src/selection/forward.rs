//! Sequential forward selection: one feature after the other, as long as the newcomer's partial F is significant.
//!
//! `F = (RSS₀ - RSS₁) / (RSS₁ / (n - k - 1))` with 1 and `n - k - 1` degrees of freedom, k counting the newcomer. The
//! published rule, "error significantly increased, p >= 0.01", cannot be meant literally, since a regressor never
//! raises the error of training: selection stops where it no longer falls significantly.
//!
//! Greedy selection needs, for every feature, its product with the residual and what is left of its length. Both are
//! kept up to date by one product with the newest direction, so that a step is one pass over the features.

use super::Standardized;
use crate::least_squares::take_off;
use crate::statistics::{centered, dot, f_upper_tail};

/// Significance that a newcomer has to stay below.
pub(super) const P_STOP: f64 = 0.01;

/// Share of a feature's squared length that must be left beside the features before it: below, it follows from them.
const LEAST_LEFT: f64 = 1e-10;
/// Share of the variance below which nothing is left to explain.
const EXPLAINED: f64 = 1e-12;

/// Who comes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The feature with the largest partial F.
    Greedy,
    /// The next in the order of correlation with the target, settled once.
    Ranked,
}

/// What forward selection did.
#[derive(Clone, Debug, PartialEq)]
pub struct Forward {
    /// The selected features, in order.
    pub features: Vec<usize>,
    /// Significance of every newcomer: those of the selected, then that of the one that ended the selection, if one did.
    pub p_values: Vec<f64>,
}

/// Selects features for a target, 0..100, at most so many.
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
            // Rounding must not bring back who is in.
            lengths_squared[candidate] = 0.0;
        }
        basis.push(direction);
    }
    forward
}

/// Features by the size of their correlation, the first of equals first.
pub(super) fn ranked(products: &[f64]) -> Vec<usize> {
    let mut ranking: Vec<usize> = (0..products.len()).collect();
    ranking.sort_by(|a, b| products[*b].abs().total_cmp(&products[*a].abs()));
    ranking
}

/// The feature that explains most of the residual.
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

/// The unit vector of what a column has beside the basis; `None` where that is nothing.
fn direction(column: &[f64], basis: &[Vec<f64>]) -> Option<Vec<f64>> {
    let mut rest = column.to_vec();
    take_off(&mut rest, basis);
    let squared = dot(&rest, &rest);
    if squared <= LEAST_LEFT {
        return None;
    }
    // Once more: the first time leaves rounding of the size of the column, not of the rest.
    take_off(&mut rest, basis);
    let length = dot(&rest, &rest).sqrt();
    Some(rest.iter().map(|r| r / length).collect())
}
