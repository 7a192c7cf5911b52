//! Least squares over a few columns, by orthogonalizing them one after the other.
//!
//! Each column is orthogonalized twice against those before it, which leaves it orthogonal to rounding (Giraud, Langou
//! and Rozloznik 2005, "twice is enough").

use crate::statistics::dot;

/// Share of a column's length that must be left once the columns before it are taken off it.
const LEAST_LEFT: f64 = 1e-10;

/// The fit of a target by columns.
#[derive(Clone, Debug, PartialEq)]
pub struct LeastSquares {
    /// One coefficient a column.
    pub coefficients: Vec<f64>,
    /// What the columns do not explain, one value a row.
    pub residuals: Vec<f64>,
}

/// Why columns have no coefficients.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LeastSquaresError {
    /// A column is a sum of those before it.
    #[error("column {column} follows from the columns before it; leave it out")]
    Dependent {
        /// Its index.
        column: usize,
    },
}

/// The coefficients that make `Σ coefficient · column` nearest to `target`. An intercept is a column of ones.
///
/// # Errors
/// A column that is zero or follows from those before it.
///
/// # Panics
/// If a column and the target differ in length.
pub fn least_squares(columns: &[Vec<f64>], target: &[f64]) -> Result<LeastSquares, LeastSquaresError> {
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(columns.len());
    let mut triangle: Vec<Vec<f64>> = Vec::with_capacity(columns.len());
    for (index, column) in columns.iter().enumerate() {
        assert_eq!(column.len(), target.len(), "columns of one table have one length");
        let mut rest = column.clone();
        let mut shares = take_off(&mut rest, &basis);
        for (share, again) in shares.iter_mut().zip(take_off(&mut rest, &basis)) {
            *share += again;
        }
        let left = dot(&rest, &rest).sqrt();
        // A column that is not a number is refused too.
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

/// Takes the parts along the unit vectors off `vector`, and returns how long they were.
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

/// Solves the upper triangle, given column by column.
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
    use crate::rng::lcg_noise;
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
                // Random square matrices have condition numbers up to some hundreds.
                assert!((a - b).abs() < 1e-10 * (1.0 + b.abs()), "{a} is not {b}");
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
