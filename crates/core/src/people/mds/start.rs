//! Starting configurations for multidimensional scaling.

use nalgebra::{DMatrix, Dyn, SymmetricEigen};

use crate::maths::rng::{Random, derive_seed};
use crate::people::dissimilarities::Dissimilarities;
use crate::people::mds::axes::by_size;

/// Eigenvalue, relative to the largest, below which it counts as rounding error.
const NOTHING: f64 = 1e-9;

/// Standard deviation of the random values on an axis without data, relative to the standard deviation of the main
/// axis. It must not be 0, because a descent never leaves an axis on which all coordinates are 0.
const LITTLE: f64 = 0.01;

/// Standard deviation of the noise that separates coincident starting points, relative to that of the main axis.
const HARDLY_ANY: f64 = 1e-6;

/// Classical scaling (Torgerson 1952), decomposed once for every number of dimensions.
pub(super) struct Classical {
    eigen: SymmetricEigen<f64, Dyn>,
    /// Indices of the eigenvalues in descending order.
    order: Vec<usize>,
}

impl Classical {
    /// Decomposes the centered products of the dissimilarities. Missing pairs are replaced by the mean.
    pub(super) fn new(dissimilarities: &Dissimilarities) -> Self {
        let n = dissimilarities.n_items();
        let (sum, n_pairs) =
            dissimilarities.pairs().fold((0.0, 0.0), |(s, n), (_, _, value)| (s + value, n + 1.0));
        let mean = sum / n_pairs;
        let squares = DMatrix::from_fn(n, n, |i, j| dissimilarities.between(i, j).unwrap_or(mean).powi(2));
        let row_means: Vec<f64> = squares.row_iter().map(|row| row.mean()).collect();
        let all = squares.mean();
        let products =
            DMatrix::from_fn(n, n, |i, j| -0.5 * (squares[(i, j)] - row_means[i] - row_means[j] + all));
        let eigen = SymmetricEigen::new(products);
        let order = by_size(&eigen.eigenvalues);
        Self { eigen, order }
    }

    /// Configuration in `dims` dimensions as a flat vector, point by point.
    pub(super) fn in_dims(&self, dims: usize, seed: u64) -> Vec<f64> {
        let Self { eigen, order } = self;
        let n = eigen.eigenvalues.len();
        let largest = eigen.eigenvalues[order[0]];
        let spread = (largest / n as f64).sqrt();
        let mut random = Random::new(seed);
        let mut points = vec![0.0; n * dims];
        for (axis, column) in order.iter().take(dims).enumerate() {
            let length = eigen.eigenvalues[*column];
            for (i, row) in points.chunks_exact_mut(dims).enumerate() {
                row[axis] = if length > NOTHING * largest {
                    eigen.eigenvectors[(i, *column)] * length.sqrt()
                } else {
                    LITTLE * spread * random.normal()
                };
            }
        }
        if any_coincide(&points, dims) {
            for value in &mut points {
                *value += HARDLY_ANY * spread * random.normal();
            }
        }
        points
    }
}

/// Normally distributed points as a flat vector, point by point; each `index` has its own random stream.
pub(super) fn random(n_items: usize, dims: usize, seed: u64, index: usize) -> Vec<f64> {
    let mut random = Random::new(derive_seed(seed, &format!("random start {index}")));
    (0..n_items * dims).map(|_| random.normal()).collect()
}

/// A configuration with one more axis of small random values, as a flat vector, point by point.
pub(super) fn with_axis(points: &[Vec<f64>], seed: u64) -> Vec<f64> {
    let squares: f64 = points.iter().map(|row| row[0] * row[0]).sum();
    let spread = (squares / points.len() as f64).sqrt();
    let mut random = Random::new(seed);
    let mut out = Vec::new();
    for row in points {
        out.extend_from_slice(row);
        out.push(LITTLE * spread * random.normal());
    }
    out
}

fn any_coincide(points: &[f64], dims: usize) -> bool {
    let mut rows: Vec<&[f64]> = points.chunks_exact(dims).collect();
    rows.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    rows.windows(2).any(|two| two[0] == two[1])
}

#[cfg(test)]
mod tests {
    use super::{Classical, any_coincide, random, with_axis};
    use crate::people::dissimilarities::Dissimilarities;

    #[test]
    fn classical_scaling_of_distances_is_exact() {
        // A rectangle with sides 3 and 4.
        let condensed = [3.0, 4.0, 5.0, 5.0, 4.0, 3.0].map(Some).to_vec();
        let rectangle = Dissimilarities::from_condensed(4, condensed).unwrap();
        let classical = Classical::new(&rectangle);
        let points = classical.in_dims(2, 1);
        for (first, second, value) in rectangle.pairs() {
            let [p, q] = [first, second].map(|i| &points[2 * i..2 * i + 2]);
            assert!(((p[0] - q[0]).hypot(p[1] - q[1]) - value).abs() < 1e-13);
        }
        // The third axis holds only small random values.
        let deep = classical.in_dims(3, 1);
        let third: Vec<f64> = deep.chunks_exact(3).map(|p| p[2]).collect();
        assert!(third.iter().all(|z| *z != 0.0 && z.abs() < 0.1), "{third:?}");
    }

    #[test]
    fn items_with_equal_rows_are_parted() {
        // Items 0 and 1 have equal dissimilarities to all others, and one axis does not separate them.
        let condensed = [1.0, 5.0, 6.0, 5.0, 6.0, 7.0].map(Some).to_vec();
        let points = Classical::new(&Dissimilarities::from_condensed(4, condensed).unwrap()).in_dims(1, 1);
        assert!(!any_coincide(&points, 1));
        assert!(any_coincide(&[1.0, 2.0, 3.0, 4.0, 1.0, 2.0], 2));
    }

    #[test]
    fn starts_are_a_function_of_their_seed() {
        assert_eq!(random(5, 2, 1, 3), random(5, 2, 1, 3));
        assert_ne!(random(5, 2, 1, 3), random(5, 2, 1, 4));
        assert_ne!(random(5, 2, 1, 3), random(5, 2, 2, 3));
        let deeper = with_axis(&[vec![1.0], vec![-1.0]], 1);
        assert_eq!((deeper.len(), deeper[0], deeper[2]), (4, 1.0, -1.0));
    }
}
