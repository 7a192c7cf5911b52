//! Reduction of several features to one: the first principal component of z-scores, and a cubic polynomial of it.
//!
//! The component does not depend on the target. If most variance of the kept features is unrelated to the target, the
//! component misses the related part. This weakness of the published chain is one reason for the practical method.

use nalgebra::{DMatrix, SymmetricEigen};

use super::{AxisModel, Standardized, Term};
use crate::maths::least_squares::least_squares;
use crate::maths::statistics::{dot, mean};

/// First principal component of a set of features.
pub(super) struct Component {
    /// Loadings of the z-scores: a unit vector whose entry of largest magnitude is positive.
    pub loadings: Vec<f64>,
    /// Score of each texture, from z-scores.
    pub scores: Vec<f64>,
    /// Fraction of the variance that it explains, 0..1.
    pub explained: f64,
}

/// First principal component; `None` without features or if all of them are constant.
pub(super) fn first(train: &Standardized, features: &[usize]) -> Option<Component> {
    let k = features.len();
    if k == 0 {
        return None;
    }
    let correlations =
        DMatrix::from_fn(k, k, |i, j| dot(train.column(features[i]), train.column(features[j])));
    let eigen = SymmetricEigen::new(correlations);
    let total: f64 = eigen.eigenvalues.iter().sum();
    let first = (0..k).max_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]))?;
    if total <= 0.0 {
        return None;
    }
    let mut loadings: Vec<f64> = eigen.eigenvectors.column(first).iter().copied().collect();
    if loadings.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).is_some_and(|l| l < 0.0) {
        for loading in &mut loadings {
            *loading = -*loading;
        }
    }
    let z = ((train.n - 1) as f64).sqrt();
    let mut scores = vec![0.0; train.n];
    for (feature, loading) in features.iter().zip(&loadings) {
        for (score, value) in scores.iter_mut().zip(train.column(*feature)) {
            *score += z * loading * value;
        }
    }
    Some(Component { loadings, scores, explained: eigen.eigenvalues[first] / total })
}

/// Cubic model of the first principal component, whose scores are scaled to a maximum magnitude of 1.
pub(super) fn cubic_model(train: &Standardized, target: &[f64], features: &[usize]) -> AxisModel {
    let Some(component) = first(train, features) else { return AxisModel::constant(mean(target)) };
    let largest = component.scores.iter().fold(0.0_f64, |l, s| l.max(s.abs()));
    if largest <= 0.0 {
        return AxisModel::constant(mean(target));
    }
    let scaled: Vec<f64> = component.scores.iter().map(|s| s / largest).collect();
    let z = ((train.n - 1) as f64).sqrt();
    let term = |(feature, loading): (&usize, &f64)| Term {
        feature: *feature,
        mean: train.means[*feature],
        weight: z * loading / (largest * train.lengths[*feature]),
    };
    let terms = features.iter().zip(&component.loadings).map(term).collect();
    AxisModel { terms, polynomial: polynomial(&scaled, target) }
}

/// Coefficients of the cubic fitted to the points, or of a lower-order polynomial if the positions do not determine it.
fn polynomial(places: &[f64], target: &[f64]) -> [f64; 4] {
    let mut coefficients = [mean(target), 0.0, 0.0, 0.0];
    let mut columns: Vec<Vec<f64>> = vec![vec![1.0; places.len()]];
    for power in 1..4 {
        columns.push(places.iter().map(|t| t.powi(power)).collect());
        let Ok(fit) = least_squares(&columns, target) else { break };
        coefficients[..columns.len()].copy_from_slice(&fit.coefficients);
    }
    coefficients
}
