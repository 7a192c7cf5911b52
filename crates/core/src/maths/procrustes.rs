//! Procrustes alignment: similarity of two point configurations, independent of position, size and orientation.

use nalgebra::DMatrix;

/// Result of aligning a configuration to a target.
#[derive(Clone, Debug, PartialEq)]
pub struct Procrustes {
    /// Share of the target's variance explained by the aligned configuration, 0 to 1.
    pub r_squared: f64,
    /// Points after translation, rotation, possible reflection, and scaling; one row for each, as in the target.
    pub aligned: Vec<Vec<f64>>,
}

/// Error of a Procrustes alignment.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProcrustesError {
    /// The configurations differ in shape.
    #[error(
        "the configurations differ in shape: {points} points with {dims} dimensions, target {target_points} points with {target_dims}; all rows need the same length"
    )]
    Shape {
        /// Number of points to align.
        points: usize,
        /// Number of dimensions of these points.
        dims: usize,
        /// Number of target points.
        target_points: usize,
        /// Number of dimensions of the target.
        target_dims: usize,
    },
    /// A coordinate is not finite.
    #[error("point {point} has a coordinate that is not finite; remove or correct the point")]
    NotFinite {
        /// Index of the point, in either configuration.
        point: usize,
    },
    /// All points of one configuration coincide.
    #[error("all points of one configuration coincide; alignment needs at least two distinct points")]
    OnePoint,
}

/// Aligns `points` to `target` (one row for each point) by the translation, orthogonal transform and scale of least
/// squares.
///
/// # Errors
/// See [`ProcrustesError`].
pub fn procrustes(points: &[Vec<f64>], target: &[Vec<f64>]) -> Result<Procrustes, ProcrustesError> {
    let dims = |rows: &[Vec<f64>]| rows.first().map_or(0, Vec::len);
    let (n, d) = (points.len(), dims(target));
    if n != target.len() || points.iter().chain(target).any(|row| row.len() != d) || n * d == 0 {
        let (points, dims, target_points) = (n, dims(points), target.len());
        return Err(ProcrustesError::Shape { points, dims, target_points, target_dims: d });
    }
    for rows in [points, target] {
        if let Some(point) = rows.iter().position(|row| row.iter().any(|v| !v.is_finite())) {
            return Err(ProcrustesError::NotFinite { point });
        }
    }
    let (moving, _) = centered(points);
    let (fixed, middle) = centered(target);
    let (square, variance) = (moving.norm_squared(), fixed.norm_squared());
    if square == 0.0 || variance == 0.0 {
        return Err(ProcrustesError::OnePoint);
    }
    let decomposition = (moving.transpose() * &fixed).svd(true, true);
    let (Some(u), Some(v_t)) = (&decomposition.u, &decomposition.v_t) else {
        unreachable!("both singular vector matrices were requested");
    };
    let scale = decomposition.singular_values.sum() / square;
    let aligned = moving * (u * v_t) * scale;
    let r_squared = 1.0 - (&aligned - &fixed).norm_squared() / variance;
    let rows = (0..n).map(|i| (0..d).map(|k| aligned[(i, k)] + middle[k]).collect()).collect();
    Ok(Procrustes { r_squared, aligned: rows })
}

/// Rows minus their mean, and the mean.
fn centered(rows: &[Vec<f64>]) -> (DMatrix<f64>, Vec<f64>) {
    let mut matrix = DMatrix::from_fn(rows.len(), rows[0].len(), |i, k| rows[i][k]);
    let middle: Vec<f64> = matrix.column_iter().map(|column| column.mean()).collect();
    for (mut column, mean) in matrix.column_iter_mut().zip(&middle) {
        column.add_scalar_mut(-mean);
    }
    (matrix, middle)
}

#[cfg(test)]
mod tests {
    use super::{ProcrustesError, procrustes};
    use crate::maths::rng::lcg_noise;

    fn rows(values: &[f64], dims: usize) -> Vec<Vec<f64>> {
        values.chunks_exact(dims).map(<[f64]>::to_vec).collect()
    }

    #[test]
    fn a_moved_turned_mirrored_and_scaled_copy_is_the_same() {
        let target = rows(&lcg_noise(40, 3), 2);
        let (sin, cos) = 0.7_f64.sin_cos();
        let moved = |p: &Vec<f64>| {
            let (x, y) = (3.0 * p[0], -3.0 * p[1]);
            vec![x * cos - y * sin + 11.0, x * sin + y * cos - 4.0]
        };
        let found = procrustes(&target.iter().map(moved).collect::<Vec<_>>(), &target).unwrap();
        // Coordinates near 10 keep 15 digits; `1 - r_squared` is a sum of squared rounding errors.
        assert!((found.r_squared - 1.0).abs() < 1e-13);
        for (a, t) in found.aligned.iter().flatten().zip(target.iter().flatten()) {
            assert!((a - t).abs() < 1e-13);
        }
    }

    #[test]
    fn on_a_line_it_is_the_squared_correlation() {
        let (a, b) = (lcg_noise(30, 1), lcg_noise(30, 2));
        let mean = |v: &[f64]| v.iter().sum::<f64>() / 30.0;
        let product =
            |v: &[f64], w: &[f64]| v.iter().zip(w).map(|(x, y)| (x - mean(v)) * (y - mean(w))).sum::<f64>();
        let correlation = product(&a, &b) / (product(&a, &a) * product(&b, &b)).sqrt();
        let found = procrustes(&rows(&a, 1), &rows(&b, 1)).unwrap().r_squared;
        assert!((found - correlation * correlation).abs() < 1e-14);
    }

    #[test]
    fn what_cannot_be_aligned_is_named() {
        let target = rows(&lcg_noise(8, 3), 2);
        let shape = ProcrustesError::Shape { points: 3, dims: 2, target_points: 4, target_dims: 2 };
        assert_eq!(procrustes(&target[..3], &target), Err(shape));
        assert_eq!(procrustes(&vec![vec![1.0, 2.0]; 4], &target), Err(ProcrustesError::OnePoint));
        let mut broken = target.clone();
        broken[2][1] = f64::NAN;
        assert_eq!(procrustes(&broken, &target), Err(ProcrustesError::NotFinite { point: 2 }));
    }
}
