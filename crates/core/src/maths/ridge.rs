//! Ridge regression: linear regression with a penalty on the squares of the coefficients (A. Hoerl and R. Kennard
//! 1970).

use nalgebra::{Cholesky, DMatrix, DVector};
use ndarray::{Array2, aview1};

use crate::maths::statistics::dot;

/// Linear function of the features.
#[derive(Clone, Debug, PartialEq)]
pub struct Ridge {
    /// One coefficient for each feature.
    pub coefficients: Vec<f64>,
    /// Value where all features are zero.
    pub intercept: f64,
}

/// Reasons why there is no regression.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RidgeError {
    /// The penalty is not a number above 0.
    #[error("the penalty of a ridge regression is {penalty}; use a number above 0")]
    Penalty {
        /// Given penalty.
        penalty: f64,
    },
    /// A feature, a target or a weight is not finite, or all weights are zero.
    #[error("a feature, target or weight is not finite, or all weights are zero; correct the examples")]
    NotFinite,
}

/// Returns the linear function `f` that minimizes `Σ weight (target - f(row))² + penalty |coefficients|²`. Its intercept
/// is not penalized. `rows` is examples × features; weights are 0 or more.
///
/// # Errors
/// See [`RidgeError`].
///
/// # Panics
/// If there is not one target and one weight for each row.
pub fn ridge(
    rows: &Array2<f64>,
    targets: &[f64],
    weights: &[f64],
    penalty: f64,
) -> Result<Ridge, RidgeError> {
    assert_eq!([targets.len(), weights.len()], [rows.nrows(); 2], "each row needs one target and one weight");
    if !(penalty.is_finite() && penalty > 0.0) {
        return Err(RidgeError::Penalty { penalty });
    }
    let total: f64 = weights.iter().sum();
    if !(total.is_finite() && total > 0.0) {
        return Err(RidgeError::NotFinite);
    }
    let means: Vec<f64> = (rows.t().dot(&aview1(weights)) / total).to_vec();
    let target_mean = dot(targets, weights) / total;
    // Centered about the weighted means, the intercept drops out.
    let mut centered = rows.clone();
    for (mut row, weight) in centered.rows_mut().into_iter().zip(weights) {
        let root = weight.sqrt();
        for (x, mean) in row.iter_mut().zip(&means) {
            *x = root * (*x - mean);
        }
    }
    let of_targets: Vec<f64> =
        targets.iter().zip(weights).map(|(target, weight)| weight.sqrt() * (target - target_mean)).collect();
    let products = centered.t().dot(&centered);
    let right = centered.t().dot(&aview1(&of_targets));
    let n = rows.ncols();
    let matrix = DMatrix::from_fn(n, n, |i, j| products[[i, j]] + if i == j { penalty } else { 0.0 });
    // With a penalty the matrix is positive definite, unless an entry is not finite.
    let cholesky = Cholesky::new(matrix).ok_or(RidgeError::NotFinite)?;
    let coefficients: Vec<f64> = cholesky.solve(&DVector::from_iterator(n, right)).iter().copied().collect();
    let intercept = target_mean - dot(&coefficients, &means);
    if intercept.is_finite() && coefficients.iter().all(|x| x.is_finite()) {
        Ok(Ridge { coefficients, intercept })
    } else {
        Err(RidgeError::NotFinite)
    }
}

impl Ridge {
    /// Returns the value for one row of features.
    pub fn at(&self, row: &[f64]) -> f64 {
        self.intercept + dot(&self.coefficients, row)
    }
}

#[cfg(test)]
mod tests {
    use super::{RidgeError, ridge};
    use crate::maths::least_squares::least_squares;
    use crate::maths::rng::lcg_noise;
    use ndarray::Array2;

    #[test]
    fn one_feature_has_its_closed_form() {
        let rows = Array2::from_shape_vec((3, 1), vec![1.0, 2.0, 6.0]).unwrap();
        let (targets, weights, penalty) = ([2.0, 1.0, 9.0], [1.0, 2.0, 1.0], 3.0);
        let fit = ridge(&rows, &targets, &weights, penalty).unwrap();
        // Weighted means of 11/4 and 13/4.
        let (x, y) = (2.75, 3.25);
        let (mut products, mut squares) = (0.0, 0.0);
        for ((feature, target), weight) in rows.iter().zip(targets).zip(weights) {
            products += weight * (feature - x) * (target - y);
            squares += weight * (feature - x).powi(2);
        }
        let slope = products / (squares + penalty);
        assert!((fit.coefficients[0] - slope).abs() < 1e-12, "{fit:?}");
        assert!((fit.intercept - (y - slope * x)).abs() < 1e-12 && (fit.at(&[2.75]) - y).abs() < 1e-12);
    }

    #[test]
    fn a_vanishing_penalty_gives_least_squares() {
        let (n, k) = (40, 5);
        let values = lcg_noise(n * (k + 1), 3);
        let rows = Array2::from_shape_fn((n, k), |(i, j)| values[j * n + i]);
        let targets = &values[n * k..];
        let fit = ridge(&rows, targets, &vec![1.0; n], 1e-9).unwrap();
        let mut columns: Vec<Vec<f64>> = values[..n * k].chunks(n).map(<[f64]>::to_vec).collect();
        columns.push(vec![1.0; n]);
        let oracle = least_squares(&columns, targets).unwrap().coefficients;
        for (got, expected) in fit.coefficients.iter().chain([&fit.intercept]).zip(&oracle) {
            // The penalty changes the coefficients by about 1e-9 / 40.
            assert!((got - expected).abs() < 1e-8, "{got} {expected}");
        }
    }

    #[test]
    fn a_weight_counts_as_that_many_rows_and_a_large_penalty_leaves_the_mean() {
        let values = lcg_noise(30, 8);
        let rows = Array2::from_shape_fn((10, 2), |(i, j)| values[2 * i + j]);
        let twice = Array2::from_shape_fn((11, 2), |(i, j)| rows[[i.min(9), j]]);
        let targets = &values[20..];
        let mut weights = vec![1.0; 10];
        weights[9] = 2.0;
        let weighted = ridge(&rows, targets, &weights, 0.7).unwrap();
        let longer = [targets, &targets[9..]].concat();
        let repeated = ridge(&twice, &longer, &[1.0; 11], 0.7).unwrap();
        for (a, b) in weighted.coefficients.iter().zip(&repeated.coefficients) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        let flat = ridge(&rows, targets, &[1.0; 10], 1e12).unwrap();
        let mean = targets.iter().sum::<f64>() / 10.0;
        assert!((flat.at(&[3.0, -4.0]) - mean).abs() < 1e-9, "{flat:?}");
    }

    #[test]
    fn impossible_input_is_refused() {
        let rows = Array2::from_shape_vec((2, 1), vec![1.0, 2.0]).unwrap();
        for penalty in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(ridge(&rows, &[1.0; 2], &[1.0; 2], penalty), Err(RidgeError::Penalty { .. })));
        }
        assert_eq!(ridge(&rows, &[1.0; 2], &[0.0; 2], 1.0), Err(RidgeError::NotFinite));
        assert_eq!(ridge(&rows, &[1.0, f64::NAN], &[1.0; 2], 1.0), Err(RidgeError::NotFinite));
        let broken = Array2::from_shape_vec((2, 1), vec![1.0, f64::NAN]).unwrap();
        assert_eq!(ridge(&broken, &[1.0; 2], &[1.0; 2], 1.0), Err(RidgeError::NotFinite));
    }
}
