//! Linear least squares with few columns, by Gram-Schmidt orthogonalization.
//!
//! Each column is orthogonalized twice against those before it. This makes the basis orthogonal to rounding error
//! (Giraud, Langou and Rozloznik 2005, "twice is enough").

use crate::maths::statistics::dot;

/// Minimum ratio of a column's norm after orthogonalization to its norm before.
const LEAST_LEFT: f64 = 1e-10;

/// Least-squares fit of a target vector.
#[derive(Clone, Debug, PartialEq)]
pub struct LeastSquares {
    /// One coefficient for each column.
    pub coefficients: Vec<f64>,
    /// Residuals: target minus fit, one for each row.
    pub residuals: Vec<f64>,
}

/// Error of a least-squares fit.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LeastSquaresError {
    /// A column is a linear combination of the columns before it.
    #[error(
        "column {column} is zero, not finite or a linear combination of the columns before it; remove it"
    )]
    Dependent {
        /// Index of the column.
        column: usize,
    },
}

/// Returns the coefficients that minimize `‖target - Σ coefficient · column‖²`. For an intercept, include a column of
/// ones.
///
/// # Errors
/// A column is zero, not finite or a linear combination of the columns before it.
///
/// # Panics
/// If a column and the target differ in length.
pub fn least_squares(columns: &[Vec<f64>], target: &[f64]) -> Result<LeastSquares, LeastSquaresError> {
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(columns.len());
    let mut triangle: Vec<Vec<f64>> = Vec::with_capacity(columns.len());
    for (index, column) in columns.iter().enumerate() {
        assert_eq!(column.len(), target.len(), "every column must have the length of the target");
        let mut rest = column.clone();
        let mut shares = take_off(&mut rest, &basis);
        for (share, again) in shares.iter_mut().zip(take_off(&mut rest, &basis)) {
            *share += again;
        }
        let left = dot(&rest, &rest).sqrt();
        // A NaN norm, from a column with NaN, is an error too.
        if left.is_nan() || left <= LEAST_LEFT * dot(column, column).sqrt() {
            return Err(LeastSquaresError::Dependent { column: index });
        }
        basis.push(rest.iter().map(|r| r / left).collect());
        shares.push(left);
        triangle.push(shares);
    }
    let mut residuals = target.to_vec();
    let mut heights = take_off(&mut residuals, &basis);
    for (height, again) in heights.iter_mut().zip(take_off(&mut residuals, &basis)) {
        *height += again;
    }
    Ok(LeastSquares { coefficients: back_substitute(&triangle, heights), residuals })
}

/// Subtracts the projections onto the unit vectors of `basis` from `vector`, and returns their signed lengths.
pub(crate) fn take_off(vector: &mut [f64], basis: &[Vec<f64>]) -> Vec<f64> {
    let mut parts = Vec::with_capacity(basis.len() + 1);
    for unit in basis {
        let part = dot(unit, vector);
        for (v, u) in vector.iter_mut().zip(unit) {
            *v -= part * u;
        }
        parts.push(part);
    }
    parts
}

/// Solves the upper triangular system, stored column by column.
fn back_substitute(triangle: &[Vec<f64>], mut heights: Vec<f64>) -> Vec<f64> {
    for column in (0..heights.len()).rev() {
        heights[column] /= triangle[column][column];
        for row in 0..column {
            heights[row] -= heights[column] * triangle[column][row];
        }
    }
    heights
}

#[cfg(test)]
mod tests {
    use super::{LeastSquaresError, least_squares};
    use crate::maths::rng::lcg_noise;
    use nalgebra::{DMatrix, DVector};

    #[test]
    fn coefficients_are_those_of_a_singular_value_decomposition() {
        for (n, k, seed) in [(25, 3, 1), (25, 17, 2), (8, 8, 3), (5, 1, 4)] {
            let values = lcg_noise(n * k + n, seed);
            let columns: Vec<Vec<f64>> = values[..n * k].chunks(n).map(<[f64]>::to_vec).collect();
            let target = &values[n * k..];
            let fit = least_squares(&columns, target).unwrap();
            let matrix = DMatrix::from_column_slice(n, k, &values[..n * k]);
            let oracle =
                matrix.clone().svd(true, true).solve(&DVector::from_column_slice(target), 0.0).unwrap();
            for (a, b) in fit.coefficients.iter().zip(oracle.iter()) {
                // Random square matrices have condition numbers up to several hundred.
                assert!((a - b).abs() < 1e-10 * (1.0 + b.abs()), "got {a}, expected {b}");
            }
            let orthogonal = matrix.transpose() * DVector::from_column_slice(&fit.residuals);
            assert!(orthogonal.amax() < 1e-12, "{orthogonal}");
        }
    }

    #[test]
    fn columns_that_follow_from_others_are_named() {
        let (a, b) = (lcg_noise(9, 5), lcg_noise(9, 6));
        let sum: Vec<f64> = a.iter().zip(&b).map(|(x, y)| 2.0 * x - y).collect();
        let dependent = |column| Err(LeastSquaresError::Dependent { column });
        assert_eq!(least_squares(&[a.clone(), b, sum], &a), dependent(2));
        assert_eq!(least_squares(&[vec![0.0; 9]], &a), dependent(0));
        assert_eq!(least_squares(&[a.clone(), vec![f64::NAN; 9]], &a), dependent(1));
    }
}
