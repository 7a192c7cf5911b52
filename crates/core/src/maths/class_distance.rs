//! Distance of a feature vector from the nearest class, relative to the scatter within the classes: the Mahalanobis
//! distance with a pooled covariance (K. Lee and others 2018), which is large for what no class resembles.

use nalgebra::{Cholesky, DMatrix};
use ndarray::{Array1, Array2, aview1};

/// Centers of classes, and the transform after which the scatter within them is the same in all directions.
#[derive(Clone, Debug, PartialEq)]
pub struct ClassDistance {
    /// Features × features: the transform.
    pub whitening: Array2<f64>,
    /// Classes × features: transformed centers.
    pub centers: Array2<f64>,
}

/// Reasons why there is no distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ClassDistanceError {
    /// A feature or weight is not finite, a class is empty, or the examples do not scatter.
    #[error(
        "a feature or weight is not finite, a class has no example, or all examples of a class are equal"
    )]
    Degenerate,
}

impl ClassDistance {
    /// Returns the distance for examples (rows × features) of classes below `n_classes`.
    ///
    /// The pooled covariance is mixed with a multiple of the identity of the same trace, with the weight `shrinkage` (0 to
    /// 1), since it has more entries than the examples determine (O. Ledoit and M. Wolf 2004).
    ///
    /// # Errors
    /// [`ClassDistanceError`].
    ///
    /// # Panics
    /// If there is not one class below `n_classes` and one weight for each row.
    pub fn learn(
        rows: &Array2<f64>,
        classes: &[usize],
        weights: &[f64],
        n_classes: usize,
        shrinkage: f64,
    ) -> Result<Self, ClassDistanceError> {
        assert_eq!(
            [classes.len(), weights.len()],
            [rows.nrows(); 2],
            "each row needs one class and one weight"
        );
        let n = rows.ncols();
        let mut means = Array2::<f64>::zeros((n_classes, n));
        let mut totals = vec![0.0; n_classes];
        for ((row, class), weight) in rows.rows().into_iter().zip(classes).zip(weights) {
            means.row_mut(*class).scaled_add(*weight, &row);
            totals[*class] += weight;
        }
        if totals.iter().any(|total| !(total.is_finite() && *total > 0.0)) {
            return Err(ClassDistanceError::Degenerate);
        }
        for (mut mean, total) in means.rows_mut().into_iter().zip(&totals) {
            mean.mapv_inplace(|x| x / total);
        }
        let mut off = rows.clone();
        for ((mut row, class), weight) in off.rows_mut().into_iter().zip(classes).zip(weights) {
            row -= &means.row(*class);
            let root = weight.sqrt();
            row.mapv_inplace(|x| root * x);
        }
        let total: f64 = totals.iter().sum();
        let covariance = off.t().dot(&off) / total;
        let variance = (0..n).map(|i| covariance[[i, i]]).sum::<f64>() / n.max(1) as f64;
        let matrix = DMatrix::from_fn(n, n, |i, j| {
            (1.0 - shrinkage) * covariance[[i, j]] + if i == j { shrinkage * variance } else { 0.0 }
        });
        let lower = Cholesky::new(matrix).ok_or(ClassDistanceError::Degenerate)?.l();
        let inverse =
            lower.solve_lower_triangular(&DMatrix::identity(n, n)).ok_or(ClassDistanceError::Degenerate)?;
        let whitening = Array2::from_shape_fn((n, n), |(i, j)| inverse[(i, j)]);
        if whitening.iter().chain(&means).any(|x| !x.is_finite()) {
            return Err(ClassDistanceError::Degenerate);
        }
        let centers = means.dot(&whitening.t());
        Ok(Self { whitening, centers })
    }

    /// Returns the distance of a row from the nearest center, as a root mean square over the features: about one for an
    /// example of a class.
    pub fn at(&self, row: &[f64]) -> f64 {
        let moved: Array1<f64> = self.whitening.dot(&aview1(row));
        let squared = |center: ndarray::ArrayView1<'_, f64>| -> f64 {
            center.iter().zip(&moved).map(|(center, x)| (x - center).powi(2)).sum()
        };
        let nearest = self.centers.rows().into_iter().map(squared).fold(f64::INFINITY, f64::min);
        (nearest / row.len().max(1) as f64).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::{ClassDistance, ClassDistanceError};
    use crate::maths::rng::Random;
    use ndarray::Array2;

    /// Two classes of three features, which scatter by 1, 5 and 0.2 about their centers.
    fn two_classes(n: usize) -> (Array2<f64>, Vec<usize>) {
        let mut random = Random::new(6);
        let classes: Vec<usize> = (0..n).map(|i| i % 2).collect();
        let rows = Array2::from_shape_fn((n, 3), |(i, j)| {
            10.0 * classes[i] as f64 + [1.0, 5.0, 0.2][j] * random.normal()
        });
        (rows, classes)
    }

    #[test]
    fn what_belongs_to_a_class_is_about_one_away_and_other_things_are_farther() {
        let (rows, classes) = two_classes(4000);
        let learned = ClassDistance::learn(&rows, &classes, &vec![1.0; 4000], 2, 0.0).unwrap();
        let squares: f64 = rows.rows().into_iter().map(|row| learned.at(&row.to_vec()).powi(2)).sum();
        // 12,000 squared normal deviates: a standard error of 1.3 %. Centers are fitted too, and few examples are
        // nearer to the other center.
        assert!((squares / 4000.0 - 1.0).abs() < 0.05, "{}", squares / 4000.0);
        // Along the feature that scatters least, a small shift is already far: 2 / 0.2 over √3.
        assert!((learned.at(&[0.0, 0.0, 2.0]) - 10.0 / 3.0_f64.sqrt()).abs() < 0.4);
        assert!(learned.at(&[10.0, 10.0, 10.0]) < 0.1 && learned.at(&[0.0, 5.0, 0.0]) < 0.7);
    }

    #[test]
    fn full_shrinkage_gives_the_scaled_euclidean_distance() {
        let (rows, classes) = two_classes(400);
        let learned = ClassDistance::learn(&rows, &classes, &[1.0; 400], 2, 1.0).unwrap();
        // The transform is one over the root of the mean variance, which the features scatter about.
        let scale = learned.whitening[[0, 0]];
        for (index, x) in learned.whitening.indexed_iter() {
            assert!((x - if index.0 == index.1 { scale } else { 0.0 }).abs() < 1e-12);
        }
        let centers = learned.centers.mapv(|x| x / scale);
        let row = [3.0, 1.0, -2.0];
        let distance = |class: usize| {
            let squares = (0..3).map(|j| (row[j] - centers[[class, j]]).powi(2)).sum::<f64>();
            scale * (squares / 3.0).sqrt()
        };
        assert!((learned.at(&row) - distance(0).min(distance(1))).abs() < 1e-12);
    }

    #[test]
    fn examples_without_scatter_are_refused() {
        let rows = Array2::zeros((4, 2));
        let learn = |classes: &[usize], n| ClassDistance::learn(&rows, classes, &[1.0; 4], n, 0.1);
        assert_eq!(learn(&[0, 0, 1, 1], 2), Err(ClassDistanceError::Degenerate));
        assert_eq!(learn(&[0; 4], 2), Err(ClassDistanceError::Degenerate));
    }
}
