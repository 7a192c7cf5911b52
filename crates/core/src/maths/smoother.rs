//! Thin-plate smoothing spline over scattered points, in any number of dimensions.
//!
//! The surface minimizes `Σ (s(q_i) - y_i)² + ρ ∫∫ (s_xx² + 2 s_xy² + s_yy²)`, up to a constant factor of the smoothing
//! parameter `ρ`, here called the ridge (J. Duchon 1977; G. Wahba, "Spline models for observational data", 1990). Its
//! value at any position is a weighted sum of the measurements. The weights depend on the positions only.
//!
//! In more than two dimensions the kernel stays `r² ln r`. It is conditionally positive definite in all of them, so that the
//! surface is unique and exact for linear functions, but it no longer minimizes this integral.

use nalgebra::{DMatrix, SymmetricEigen};

use crate::maths::radial_basis::{Basis, Kernel};
use crate::maths::rng::Random;
use crate::maths::sums::add_columns;

/// Ridges to select from, for points in the unit square.
const RIDGES: [f64; 7] = [0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0];
/// Default ridge, used unless cross-validation prefers another.
const USUAL_RIDGE: f64 = 0.1;
/// Highest ratio of a ridge's score to the lowest score at which the ridge is still eligible; the eligible ridge
/// nearest to the default is used. With two dozen points the score curve is flat, so that its minimum is a matter of
/// chance.
const SCORE_TOLERANCE: f64 = 1.06;
/// Maximum number of points used to select the ridge; a random subset if there are more. The cost is cubic in this
/// number.
const MOST_FOR_RIDGE: usize = 200;

/// Smoothing spline as weights of the measurements.
#[derive(Clone, Debug)]
pub(crate) struct Smoother<const N: usize> {
    basis: Basis<N>,
    n_points: usize,
    /// Inverse of the linear system, one row and column for each term.
    inverse: DMatrix<f64>,
}

impl<const N: usize> Smoother<N> {
    /// Fits the spline to `points`. A ridge of zero interpolates the measurements; a large ridge approaches a plane.
    ///
    /// Returns `None` if there are no points or the points are too close for a unique solution. Cost: cubic in the
    /// number of points.
    pub(crate) fn new(points: &[[f64; N]], ridge: f64) -> Option<Self> {
        let n_points = points.len();
        if n_points == 0 {
            return None;
        }
        let basis = Basis::new(points, Kernel::ThinPlate);
        let inverse = system(&basis, points, ridge).try_inverse()?;
        inverse.iter().all(|x| x.is_finite()).then_some(Self { basis, n_points, inverse })
    }

    /// Fits the spline with the ridge from [`chosen_ridge`].
    pub(crate) fn fitted(points: &[[f64; N]], values: &DMatrix<f64>) -> Option<Self> {
        Self::new(points, chosen_ridge(points, values))
    }

    /// Weights of the measurements at a position, in point order. They sum to one and can be negative.
    pub(crate) fn weights(&self, at: [f64; N]) -> Vec<f64> {
        let mut weights = vec![0.0; self.n_points];
        let terms = self.basis.terms(at);
        add_columns(self.inverse.as_slice(), &terms, terms.len(), &mut weights);
        weights
    }

    /// Surface through `values`: one row for each point, one column for each quantity.
    pub(crate) fn surface(&self, values: &DMatrix<f64>) -> Surface<N> {
        let coefficients = self.inverse.columns(0, self.n_points) * values;
        Surface { basis: self.basis.clone(), coefficients: coefficients.transpose() }
    }
}

/// Several smooth surfaces over the same points.
#[derive(Clone, Debug)]
pub(crate) struct Surface<const N: usize> {
    basis: Basis<N>,
    /// One row for each quantity, one column for each term.
    coefficients: DMatrix<f64>,
}

impl<const N: usize> Surface<N> {
    /// Values of all quantities at a position.
    pub(crate) fn at(&self, at: [f64; N]) -> Vec<f64> {
        let mut sum = vec![0.0; self.coefficients.nrows()];
        for (column, term) in self.coefficients.column_iter().zip(self.basis.terms(at)) {
            for (s, c) in sum.iter_mut().zip(column.iter()) {
                *s += term * c;
            }
        }
        sum
    }
}

/// Selects the ridge by generalized cross-validation (P. Craven and G. Wahba 1979).
///
/// The score is `(‖(I - S) Y‖² / n) / (tr(I - S) / n)²`. The result is the ridge nearest to [`USUAL_RIDGE`] whose score
/// is at most [`SCORE_TOLERANCE`] times the lowest. With too few points for a score it is [`USUAL_RIDGE`].
pub(crate) fn chosen_ridge<const N: usize>(points: &[[f64; N]], values: &DMatrix<f64>) -> f64 {
    let kept = scattered(points.len(), MOST_FOR_RIDGE);
    let points: Vec<[f64; N]> = kept.iter().map(|i| points[*i]).collect();
    let values = DMatrix::from_fn(kept.len(), values.ncols(), |i, j| values[(kept[i], j)]);
    let Some(scores) = scores(&points, &values) else { return USUAL_RIDGE };
    let lowest = scores.iter().copied().fold(f64::INFINITY, f64::min);
    let distance = |ridge: f64| (ridge / USUAL_RIDGE).ln().abs();
    let good = RIDGES.iter().zip(&scores).filter(|(_, score)| **score <= SCORE_TOLERANCE * lowest);
    good.map(|(ridge, _)| *ridge).min_by(|a, b| distance(*a).total_cmp(&distance(*b))).unwrap_or(USUAL_RIDGE)
}

/// Ascending indices below `n`: all of them, or `most` of them by stratified random sampling with a fixed seed. Random,
/// because a library can have a periodic order.
pub(crate) fn scattered(n: usize, most: usize) -> Vec<usize> {
    if n <= most {
        return (0..n).collect();
    }
    let part = n as f64 / most as f64;
    let mut random = Random::new(1);
    (0..most).map(|i| (((i as f64 + random.uniform()) * part) as usize).min(n - 1)).collect()
}

/// Cross-validation score of each of [`RIDGES`]; `None` if there are at most as many points as linear terms plus one.
fn scores<const N: usize>(points: &[[f64; N]], values: &DMatrix<f64>) -> Option<Vec<f64>> {
    let n = points.len();
    let basis = Basis::new(points, Kernel::ThinPlate);
    let n_slopes = basis.n_terms() - n;
    if n <= n_slopes + 1 {
        return None;
    }
    let system = system(&basis, points, 0.0);
    let kernel = system.view((0, 0), (n, n)).into_owned();
    let slopes = system.view((0, n), (n, n_slopes)).into_owned().qr().q();
    // Restricts the kernel to the complement of the linear terms. The linear terms get a large eigenvalue, which
    // identifies them.
    let onto = &slopes * slopes.transpose();
    let off = DMatrix::identity(n, n) - &onto;
    let high = 1.0 + 2.0 * kernel.norm();
    let lifted = &off * kernel * &off + onto * high;
    let eigen = SymmetricEigen::new(lifted);
    let seen = eigen.eigenvectors.transpose() * values;
    let kept: Vec<usize> = (0..n).filter(|i| eigen.eigenvalues[*i] < 0.5 * high).collect();
    let score = |ridge: &f64| {
        let left = |i: &usize| ridge / (eigen.eigenvalues[*i].max(0.0) + ridge);
        let residual: f64 = kept.iter().map(|i| left(i).powi(2) * seen.row(*i).norm_squared()).sum();
        let freedom: f64 = kept.iter().map(left).sum();
        residual / (freedom * freedom)
    };
    let scores: Vec<f64> = RIDGES.iter().map(score).collect();
    scores.iter().all(|s| s.is_finite()).then_some(scores)
}

/// Linear system of all terms: kernels with the ridge on the diagonal, and linear terms, to which the weights must be
/// orthogonal.
fn system<const N: usize>(basis: &Basis<N>, points: &[[f64; N]], ridge: f64) -> DMatrix<f64> {
    let (n, size) = (points.len(), basis.n_terms());
    let mut matrix = DMatrix::zeros(size, size);
    for (i, point) in points.iter().enumerate() {
        for (j, term) in basis.terms(*point).into_iter().enumerate() {
            matrix[(i, j)] = term;
            if j >= n {
                matrix[(j, i)] = term;
            }
        }
        matrix[(i, i)] += ridge;
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::{Smoother, chosen_ridge, scattered};
    use crate::maths::rng::Random;
    use crate::maths::triangulation::Xy;
    use nalgebra::DMatrix;
    use proptest::prelude::{prop, prop_assert, prop_assume, proptest};

    fn random_points(n: usize, seed: u64) -> Vec<Xy> {
        let mut random = Random::new(seed);
        (0..n).map(|_| [random.uniform(), random.uniform()]).collect()
    }

    #[test]
    fn parts_of_many_are_ascending_and_without_a_period() {
        assert_eq!(scattered(5, 8), [0, 1, 2, 3, 4]);
        let some = scattered(1000, 200);
        assert!(some.len() == 200 && some.windows(2).all(|w| w[0] < w[1]) && some[199] < 1000);
        let rests: std::collections::BTreeSet<usize> = some.iter().map(|i| i % 25).collect();
        assert_eq!(rests.len(), 25, "the sample must cover every remainder modulo 25");
    }

    #[test]
    fn few_points_have_the_plane_through_them() {
        let one = Smoother::new(&[[0.2, 0.3]], 0.1).unwrap();
        assert!((one.weights([0.9, 0.9])[0] - 1.0).abs() < 1e-12);
        let three = Smoother::new(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], 0.1).unwrap();
        for (weight, want) in three.weights([0.25, 0.25]).iter().zip([0.5, 0.25, 0.25]) {
            assert!((weight - want).abs() < 1e-12, "got {weight}, expected {want}");
        }
        let line = Smoother::new(&[[0.0, 0.0], [0.5, 0.5], [1.0, 1.0]], 0.0).unwrap();
        assert!((line.weights([0.5, 0.5])[1] - 1.0).abs() < 1e-9);
        assert!(Smoother::<2>::new(&[], 0.1).is_none());
        assert!(Smoother::new(&[[0.5, 0.5]; 3], 0.0).is_none());
    }

    /// A noisy plane wave selects a high ridge, a noise-free one a low ridge.
    #[test]
    fn noise_asks_for_a_higher_ridge() {
        let points = random_points(120, 3);
        let mut random = Random::new(4);
        let wave = |p: &Xy| (7.0 * p[0]).sin() + (5.0 * p[1]).cos();
        let mut ridge = |noise: f64| {
            let values = DMatrix::from_fn(120, 1, |i, _| wave(&points[i]) + noise * random.normal());
            chosen_ridge(&points, &values)
        };
        let (clean, noisy) = (ridge(0.0), ridge(1.0));
        assert!(clean <= 0.01 && noisy >= 0.1, "{clean} and {noisy}");
    }

    /// Compares the closed form of the leave-one-out prediction with the explicit computation.
    #[test]
    fn smoothing_agrees_with_leaving_one_out() {
        let points = random_points(15, 8);
        let whole = Smoother::new(&points, 0.1).unwrap();
        let mut random = Random::new(9);
        let y: Vec<f64> = points.iter().map(|_| random.normal()).collect();
        let sum = |weights: Vec<f64>, y: &[f64]| weights.iter().zip(y).map(|(w, y)| w * y).sum::<f64>();
        for i in 0..points.len() {
            let weights = whole.weights(points[i]);
            let leverage = weights[i];
            let closed = y[i] - (y[i] - sum(weights, &y)) / (1.0 - leverage);
            let (mut rest, mut left) = (points.clone(), y.clone());
            rest.remove(i);
            left.remove(i);
            let done = sum(Smoother::new(&rest, 0.1).unwrap().weights(points[i]), &left);
            assert!((closed - done).abs() < 1e-9, "closed form {closed}, explicit {done}");
        }
    }

    /// The sum over the columns in blocks has the bits of the plain one, for any number of columns modulo four.
    #[test]
    fn weights_are_the_plain_sum_over_the_columns() {
        for n in 4..9 {
            let smoother = Smoother::new(&random_points(n, 5), 0.1).unwrap();
            let mut plain = vec![0.0; n];
            for (column, term) in smoother.inverse.column_iter().zip(smoother.basis.terms([0.3, 0.6])) {
                plain.iter_mut().zip(column.iter()).for_each(|(sum, x)| *sum += term * x);
            }
            assert_eq!(smoother.weights([0.3, 0.6]), plain);
        }
    }

    proptest! {
        /// Weights sum to one, have linear precision and agree with the surface. Without a ridge the spline
        /// interpolates.
        #[test]
        fn weights_reproduce_what_is_linear(
            points in prop::collection::vec([0.0_f64..1.0, 0.0_f64..1.0], 4..40),
            at in [-0.3_f64..1.3, -0.3_f64..1.3],
        ) {
            for (i, p) in points.iter().enumerate() {
                prop_assume!(points[..i].iter().all(|q| (p[0] - q[0]).hypot(p[1] - q[1]) > 1e-2));
            }
            let smoother = Smoother::new(&points, 0.1).unwrap();
            let weights = smoother.weights(at);
            prop_assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-8);
            let values = DMatrix::from_fn(points.len(), 2, |i, axis| points[i][axis]);
            let surface = smoother.surface(&values).at(at);
            for axis in 0..2 {
                let place: f64 = weights.iter().zip(&points).map(|(w, p)| w * p[axis]).sum();
                prop_assert!((place - at[axis]).abs() < 1e-7 && (surface[axis] - at[axis]).abs() < 1e-7);
            }
            let exact = Smoother::new(&points, 0.0).unwrap().weights(points[0]);
            prop_assert!((exact[0] - 1.0).abs() < 1e-6);
        }
    }
}
