//! Kernel ridge regression (C. Saunders and others 1998): a smooth function of the features that follows examples nearby and
//! returns to their mean far from all of them.
//!
//! The kernel is Gaussian and sees the first principal components of the features, each scaled to a variance of one.

use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};
use ndarray::{Array1, Array2, ArrayView1, Axis, aview1};

use crate::maths::statistics::dot;

/// Components with less than this share of the largest variance are noise of rounding.
const LEAST_SHARE: f64 = 1e-9;

/// Settings of a kernel ridge regression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KernelRidgeConfig {
    /// Number of principal components, at least 1.
    pub n_components: usize,
    /// Decay of the kernel `exp(-decay d²)`, where `d²` is the mean squared difference of the scaled components; above 0.
    pub decay: f64,
    /// Penalty of an example of mean weight; above 0.
    pub penalty: f64,
}

impl KernelRidgeConfig {
    /// Returns whether the settings are usable.
    pub fn is_sound(&self) -> bool {
        let is_positive = |x: f64| x.is_finite() && x > 0.0;
        self.n_components > 0 && is_positive(self.decay) && is_positive(self.penalty)
    }
}

/// Function of the features.
#[derive(Clone, Debug, PartialEq)]
pub struct KernelRidge {
    /// Mean of each feature.
    pub means: Vec<f64>,
    /// Components × features: directions of the principal components, divided by their standard deviations.
    pub directions: Array2<f64>,
    /// Examples × components: scaled components of the examples.
    pub centers: Array2<f64>,
    /// One coefficient for each example.
    pub coefficients: Vec<f64>,
    /// Value far from all examples.
    pub intercept: f64,
    /// Decay of the kernel.
    pub decay: f64,
}

/// Reasons why there is no regression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum KernelRidgeError {
    /// The settings are impossible.
    #[error("the number of components, the decay and the penalty of a kernel regression must be above 0")]
    Settings,
    /// A feature, a target or a weight is not finite, a weight is not above 0, or the features do not scatter.
    #[error(
        "a feature, target or weight of the kernel regression is not finite, a weight is not above 0, or all features are constant; correct the examples"
    )]
    Degenerate,
}

impl KernelRidge {
    /// Returns the function of examples (rows × features) with a target and a weight each. The principal components are
    /// those of `scatter`, rows of the same features with a weight each, such as variations of the examples. Takes time in
    /// proportion to the cube of the number of examples, and of features.
    ///
    /// # Errors
    /// [`KernelRidgeError`].
    ///
    /// # Panics
    /// If there is not one weight for each row and one target for each example, or the numbers of features differ.
    pub fn learn(
        (scatter, scatter_weights): (&Array2<f64>, &[f64]),
        (examples, targets, weights): (&Array2<f64>, &[f64], &[f64]),
        config: KernelRidgeConfig,
    ) -> Result<Self, KernelRidgeError> {
        assert_eq!(scatter.nrows(), scatter_weights.len(), "each row needs one weight");
        assert_eq!(
            [targets.len(), weights.len()],
            [examples.nrows(); 2],
            "each example needs a target and a weight"
        );
        assert_eq!(scatter.ncols(), examples.ncols(), "rows and examples need the same features");
        if !config.is_sound() {
            return Err(KernelRidgeError::Settings);
        }
        let is_weight = |weight: &f64| weight.is_finite() && *weight > 0.0;
        if weights.is_empty() || !weights.iter().chain(scatter_weights).all(is_weight) {
            return Err(KernelRidgeError::Degenerate);
        }
        let (means, directions) = principal_components(scatter, scatter_weights, config.n_components)?;
        let total: f64 = weights.iter().sum();
        let intercept = dot(targets, weights) / total;
        let centers = (examples - &aview1(&means)).dot(&directions.t());
        let n = targets.len();
        let mean_weight = total / n as f64;
        let kernel = DMatrix::from_fn(n, n, |i, j| {
            let penalty = if i == j { config.penalty * mean_weight / weights[i] } else { 0.0 };
            kernel(&centers.row(i), &centers.row(j), config.decay) + penalty
        });
        let off = DVector::from_iterator(n, targets.iter().map(|target| target - intercept));
        // With a penalty the matrix is positive definite, unless an entry is not finite.
        let coefficients = Cholesky::new(kernel).ok_or(KernelRidgeError::Degenerate)?.solve(&off);
        let coefficients: Vec<f64> = coefficients.iter().copied().collect();
        if !intercept.is_finite() || coefficients.iter().any(|x| !x.is_finite()) {
            return Err(KernelRidgeError::Degenerate);
        }
        Ok(Self { means, directions, centers, coefficients, intercept, decay: config.decay })
    }

    /// Returns the value for one row of features.
    pub fn at(&self, row: &[f64]) -> f64 {
        let off: Array1<f64> = &aview1(row) - &aview1(&self.means);
        let components = self.directions.dot(&off);
        let near = |center: ArrayView1<'_, f64>| kernel(&components.view(), &center, self.decay);
        let kernels: Vec<f64> = self.centers.axis_iter(Axis(0)).map(near).collect();
        self.intercept + dot(&self.coefficients, &kernels)
    }
}

fn kernel(a: &ArrayView1<'_, f64>, b: &ArrayView1<'_, f64>, decay: f64) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    (-decay * squares / a.len() as f64).exp()
}

/// Returns the weighted means of the features, and the directions of up to `n` principal components, divided by the standard
/// deviations along them.
fn principal_components(
    rows: &Array2<f64>,
    weights: &[f64],
    n: usize,
) -> Result<(Vec<f64>, Array2<f64>), KernelRidgeError> {
    let total: f64 = weights.iter().sum();
    let means: Vec<f64> = (rows.t().dot(&aview1(weights)) / total).to_vec();
    let mut off = rows - &aview1(&means);
    for (mut row, weight) in off.rows_mut().into_iter().zip(weights) {
        row *= (weight / total).sqrt();
    }
    let covariance = off.t().dot(&off);
    if covariance.iter().any(|x| !x.is_finite()) {
        return Err(KernelRidgeError::Degenerate);
    }
    let n_features = rows.ncols();
    let eigen = SymmetricEigen::new(DMatrix::from_fn(n_features, n_features, |i, j| covariance[[i, j]]));
    let mut order: Vec<usize> = (0..n_features).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let largest = order.first().map_or(0.0, |first| eigen.eigenvalues[*first]);
    let is_used = |index: &usize| largest > 0.0 && eigen.eigenvalues[*index] > LEAST_SHARE * largest;
    let used: Vec<usize> = order.into_iter().filter(is_used).take(n).collect();
    if used.is_empty() {
        return Err(KernelRidgeError::Degenerate);
    }
    let directions = Array2::from_shape_fn((used.len(), n_features), |(component, feature)| {
        eigen.eigenvectors[(feature, used[component])] / eigen.eigenvalues[used[component]].sqrt()
    });
    Ok((means, directions))
}

#[cfg(test)]
mod tests {
    use super::{KernelRidge, KernelRidgeConfig, KernelRidgeError};
    use crate::maths::rng::Random;
    use ndarray::{Array2, array};

    const CONFIG: KernelRidgeConfig = KernelRidgeConfig { n_components: 2, decay: 0.5, penalty: 0.1 };

    fn learn(
        rows: &Array2<f64>,
        targets: &[f64],
        weights: &[f64],
        config: KernelRidgeConfig,
    ) -> Result<KernelRidge, KernelRidgeError> {
        KernelRidge::learn((rows, weights), (rows, targets, weights), config)
    }

    #[test]
    fn two_examples_have_a_closed_form() {
        // One feature of variance 1, so that the scaled component is the feature.
        let rows = array![[-1.0], [1.0]];
        let learned = learn(&rows, &[2.0, 6.0], &[1.0; 2], CONFIG).unwrap();
        // By symmetry the coefficients are ∓c with c (1 + penalty - exp(-0.5 · 4)) = 2.
        let c = 2.0 / (1.1 - (-2.0_f64).exp());
        let at = |x: f64| 4.0 + c * ((-0.5 * (x - 1.0).powi(2)).exp() - (-0.5 * (x + 1.0).powi(2)).exp());
        for x in [-2.0, -1.0, 0.0, 0.3, 1.0, 40.0] {
            assert!((learned.at(&[x]) - at(x)).abs() < 1e-12, "{x}");
        }
        assert!((learned.at(&[40.0]) - 4.0).abs() < 1e-12, "the mean far from all examples");
    }

    /// A smooth function of two of five features, with noise in the others.
    fn examples(n: usize, seed: u64) -> (Array2<f64>, Vec<f64>) {
        let mut random = Random::new(seed);
        let rows = Array2::from_shape_fn((n, 5), |(_, j)| if j < 2 { 3.0 } else { 0.1 } * random.normal());
        let targets =
            rows.rows().into_iter().map(|row| 10.0 * (row[0] / 3.0).sin() + row[1] * row[1]).collect();
        (rows, targets)
    }

    #[test]
    fn a_smooth_function_is_learned_where_a_line_is_not_enough() {
        let ((rows, targets), (others, wanted)) = (examples(400, 1), examples(100, 2));
        let config = KernelRidgeConfig { penalty: 1e-3, ..CONFIG };
        let learned = learn(&rows, &targets, &[1.0; 400], config).unwrap();
        let line = crate::maths::ridge::ridge(&rows, &targets, &[1.0; 400], 1e-3).unwrap();
        let error = |at: &dyn Fn(&[f64]) -> f64| -> f64 {
            others
                .rows()
                .into_iter()
                .zip(&wanted)
                .map(|(row, wanted)| (at(&row.to_vec()) - wanted).abs())
                .sum()
        };
        let [of_kernel, of_line] = [error(&|row| learned.at(row)), error(&|row| line.at(row))];
        assert!(of_kernel < 0.4 * of_line, "{of_kernel} {of_line}");
    }

    #[test]
    fn an_example_of_double_weight_counts_as_two_examples() {
        let (rows, targets) = examples(30, 3);
        let mut weights = vec![1.0; 30];
        weights[4] = 2.0;
        let heavy = learn(&rows, &targets, &weights, CONFIG).unwrap();
        let mut twice = rows.clone();
        twice.push_row(rows.row(4)).unwrap();
        let targets = [targets.clone(), vec![targets[4]]].concat();
        // The penalty is that of an example of mean weight: 1 here, and 31 / 30 there.
        let config = KernelRidgeConfig { penalty: CONFIG.penalty * 31.0 / 30.0, ..CONFIG };
        let doubled = learn(&twice, &targets, &[1.0; 31], config).unwrap();
        for row in examples(10, 4).0.rows() {
            let row = row.to_vec();
            assert!((heavy.at(&row) - doubled.at(&row)).abs() < 1e-8);
        }
    }

    #[test]
    fn what_cannot_be_learned_is_refused() {
        let (rows, targets) = examples(6, 5);
        let refused =
            |targets: &[f64], weights: &[f64], config| learn(&rows, targets, weights, config).unwrap_err();
        for config in [
            KernelRidgeConfig { n_components: 0, ..CONFIG },
            KernelRidgeConfig { decay: 0.0, ..CONFIG },
            KernelRidgeConfig { penalty: f64::NAN, ..CONFIG },
        ] {
            assert_eq!(refused(&targets, &[1.0; 6], config), KernelRidgeError::Settings);
        }
        assert_eq!(refused(&[f64::NAN; 6], &[1.0; 6], CONFIG), KernelRidgeError::Degenerate);
        assert_eq!(refused(&targets, &[1.0, 1.0, 1.0, 0.0, 1.0, 1.0], CONFIG), KernelRidgeError::Degenerate);
        let constant = Array2::from_elem((6, 5), 3.0);
        assert_eq!(learn(&constant, &targets, &[1.0; 6], CONFIG), Err(KernelRidgeError::Degenerate));
        let mut broken = rows.clone();
        broken[[2, 3]] = f64::INFINITY;
        assert_eq!(learn(&broken, &targets, &[1.0; 6], CONFIG), Err(KernelRidgeError::Degenerate));
    }
}
