//! Normalization of translation, rotation, reflection and scale, which stress does not determine.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Centered points along their principal axes, scaled by `size`: one row per point, `dims` coordinates each. Axes come
/// in order of decreasing variance, and the coordinate of largest magnitude on each axis is positive.
pub(super) fn settle(points: &[f64], dims: usize, size: f64) -> Vec<Vec<f64>> {
    let mut matrix = DMatrix::from_row_slice(points.len() / dims, dims, points);
    for mut column in matrix.column_iter_mut() {
        let mean = column.mean();
        column.add_scalar_mut(-mean);
    }
    let eigen = SymmetricEigen::new(matrix.tr_mul(&matrix));
    let mut axes = eigen.eigenvectors.select_columns(&by_size(&eigen.eigenvalues));
    axes *= size;
    let mut turned = matrix * axes;
    for mut column in turned.column_iter_mut() {
        if column[column.iamax()] < 0.0 {
            column.neg_mut();
        }
    }
    turned.row_iter().map(|row| row.iter().copied().collect()).collect()
}

/// Indices of the values in descending order.
pub(super) fn by_size(values: &DVector<f64>) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*b].total_cmp(&values[*a]));
    order
}

#[cfg(test)]
mod tests {
    use super::settle;

    #[test]
    fn a_slanted_cross_stands_upright() {
        // The points are centered and their axes uncorrelated. The coordinates of largest magnitude are 3 and 2.
        let upright = [(3.0, 0.0), (-1.0, 2.0), (-1.0, -1.0), (-1.0, -1.0)];
        let (sin, cos) = 2.0_f64.sin_cos();
        let points: Vec<f64> =
            upright.iter().flat_map(|(x, y)| [x * cos - y * sin + 7.0, x * sin + y * cos - 3.0]).collect();
        for (row, (x, y)) in settle(&points, 2, 10.0).iter().zip(upright) {
            // Coordinates of up to 30 have 15 correct digits.
            assert!((row[0] - 10.0 * x).abs() < 1e-13 && (row[1] - 10.0 * y).abs() < 1e-13, "{row:?}");
        }
    }
}
