//! Gaussian process regression: a predicted mean and standard deviation for a new feature vector.
//!
//! Features are standardized to mean 0 and standard deviation 1 over the examples. The kernel of two examples `x`, `z`
//! with `d` features is `s² ((1 - l) exp(-|x - z|² / (2 r² d)) + l x·z / d)`, plus noise of variance `s² n`. The first
//! term makes near examples similar; the second extrapolates linearly beyond all examples. The signal variance `s²` has
//! a closed form. Length scale `r`, linear share `l` and noise ratio `n` are the grid values with the highest marginal
//! likelihood (Rasmussen and Williams 2006, equations 2.25, 2.26, 5.8 and 5.12).

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::maths::statistics::{dot, is_constant, mean, standard_deviation};

/// Length scales of the grid, in standard deviations of a feature.
const REACHES: [f64; 5] = [0.5, 0.9, 1.5, 2.5, 4.5];
/// Shares of the linear kernel in the grid, dimensionless.
const TRENDS: [f64; 4] = [0.0, 0.3, 0.7, 0.95];
/// Noise variances of the grid, as ratios to the signal variance.
const NOISES: [f64; 6] = [0.003, 0.01, 0.03, 0.1, 0.3, 1.0];

/// Lower limit of the signal variance. It applies if all values are equal, which leaves the scale of the values
/// unknown.
const LEAST_VARIANCE: f64 = 1e-12;

/// Predicted value with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Mean, in the unit of the training values.
    pub mean: f64,
    /// Standard deviation, in the same unit.
    pub deviation: f64,
}

/// Error of fitting a Gaussian process.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GaussianProcessError {
    /// There are fewer than [`LEAST_EXAMPLES`] examples.
    #[error("a Gaussian process needs at least {LEAST_EXAMPLES} examples, got {n}; add examples")]
    TooFew {
        /// Number of examples.
        n: usize,
    },
    /// A row has another number of features than the first row.
    #[error("example {index} has {n} features, expected {expected} as in the first example")]
    Shape {
        /// Index of the example.
        index: usize,
        /// Number of features of this example.
        n: usize,
        /// Number of features of the first example.
        expected: usize,
    },
    /// A feature or a value is not finite.
    #[error("example {index} has a feature or value that is not finite; remove or correct it")]
    NotFinite {
        /// Index of the example.
        index: usize,
    },
    /// Every feature is constant over the examples.
    #[error("all examples have the same features; add examples that differ")]
    Alike,
}

/// Minimum number of examples; with fewer, the marginal likelihood cannot distinguish kernels.
pub const LEAST_EXAMPLES: usize = 4;

/// Hyperparameters of the kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel {
    /// Length scale, in standard deviations of a feature; above 0.
    pub reach: f64,
    /// Share of the linear kernel in the signal, 0 to 1.
    pub trend: f64,
    /// Ratio of noise variance to signal variance, above 0.
    pub noise: f64,
}

/// Standardization of features to mean 0 and standard deviation 1; constant features are dropped.
#[derive(Clone, Debug, PartialEq)]
struct Scaling {
    /// Index, mean and standard deviation of each feature in use.
    used: Vec<(usize, f64, f64)>,
}

/// Fitted Gaussian process.
#[derive(Clone, Debug)]
pub struct GaussianProcess {
    n_features: usize,
    scaling: Scaling,
    /// Standardized feature vectors of the examples.
    places: Vec<Vec<f64>>,
    kernel: Kernel,
    mean: f64,
    signal_variance: f64,
    cholesky: Cholesky<f64, Dyn>,
    /// Inverse kernel matrix times the centered values.
    weights: DVector<f64>,
}

impl GaussianProcess {
    /// Fits a Gaussian process to `values` at `features` (examples × features), with the kernel of highest marginal
    /// likelihood in the grid.
    ///
    /// # Errors
    /// See [`GaussianProcessError`].
    pub fn learn(features: &[Vec<f64>], values: &[f64]) -> Result<Self, GaussianProcessError> {
        check(features, values)?;
        let scaling = Scaling::of(features).ok_or(GaussianProcessError::Alike)?;
        let places: Vec<Vec<f64>> = features.iter().map(|row| scaling.apply(row)).collect();
        let grams = Grams::of(&places);
        let mean = mean(values);
        let centered = DVector::from_iterator(values.len(), values.iter().map(|value| value - mean));
        let mut best: Option<(f64, Self)> = None;
        for reach in REACHES {
            for trend in TRENDS {
                for noise in NOISES {
                    let kernel = Kernel { reach, trend, noise };
                    let Some(cholesky) = grams.matrix(kernel).cholesky() else { continue };
                    let weights = cholesky.solve(&centered);
                    let variance = centered.dot(&weights) / values.len() as f64;
                    let variance = variance.max(LEAST_VARIANCE);
                    let likelihood = log_likelihood(&cholesky, variance);
                    if best.as_ref().is_none_or(|(most, _)| likelihood > *most) {
                        let (scaling, places) = (scaling.clone(), places.clone());
                        let n_features = features[0].len();
                        let signal_variance = variance;
                        let learned = Self {
                            n_features,
                            scaling,
                            places,
                            kernel,
                            mean,
                            signal_variance,
                            cholesky,
                            weights,
                        };
                        best = Some((likelihood, learned));
                    }
                }
            }
        }
        // Noise on the diagonal makes every kernel matrix of the grid positive definite if its entries are finite.
        best.map(|(_, learned)| learned).ok_or(GaussianProcessError::NotFinite { index: 0 })
    }

    /// Selected kernel, the one with the highest marginal likelihood.
    pub fn kernel(&self) -> Kernel {
        self.kernel
    }

    /// Predictive distribution at a new feature vector. It includes the noise, so it describes one further measurement.
    ///
    /// # Panics
    /// If the number of features differs from that of the training examples.
    pub fn at(&self, features: &[f64]) -> Estimate {
        assert_eq!(
            features.len(),
            self.n_features,
            "the number of features must equal that of the training examples"
        );
        let place = self.scaling.apply(features);
        let likeness = self.places.iter().map(|known| self.kernel.of(&place, known));
        let likeness = DVector::from_iterator(self.places.len(), likeness);
        let explained = likeness.dot(&self.cholesky.solve(&likeness));
        let share = self.kernel.of(&place, &place) + self.kernel.noise - explained;
        Estimate {
            mean: self.mean + likeness.dot(&self.weights),
            deviation: (self.signal_variance * share.max(0.0)).sqrt(),
        }
    }

    /// Leave-one-out prediction of each training value, with this kernel and signal variance.
    pub fn leave_one_out(&self) -> Vec<Estimate> {
        let inverse = self.cholesky.inverse();
        let of = |(index, value): (usize, f64)| Estimate {
            mean: self.mean + value - self.weights[index] / inverse[(index, index)],
            deviation: (self.signal_variance / inverse[(index, index)]).sqrt(),
        };
        // Recovers the centered values: kernel matrix times weights, by the Cholesky factor.
        let values = self.cholesky.l_dirty().lower_triangle();
        let values = &values * (values.transpose() * &self.weights);
        values.iter().copied().enumerate().map(of).collect()
    }
}

impl Kernel {
    fn of(self, x: &[f64], z: &[f64]) -> f64 {
        let n = x.len() as f64;
        let square: f64 = x.iter().zip(z).map(|(x, z)| (x - z).powi(2)).sum();
        self.mixed(square / n, dot(x, z) / n)
    }

    fn mixed(self, mean_square: f64, mean_product: f64) -> f64 {
        let near = (-mean_square / (2.0 * self.reach * self.reach)).exp();
        (1.0 - self.trend) * near + self.trend * mean_product
    }
}

/// Mean squared differences and mean products of all pairs of examples; every kernel of the grid is computed from them.
struct Grams {
    squares: DMatrix<f64>,
    products: DMatrix<f64>,
}

impl Grams {
    fn of(places: &[Vec<f64>]) -> Self {
        let (n, n_features) = (places.len(), places[0].len() as f64);
        let products = DMatrix::from_fn(n, n, |i, j| dot(&places[i], &places[j]) / n_features);
        let squares = DMatrix::from_fn(n, n, |i, j| {
            places[i].iter().zip(&places[j]).map(|(x, z)| (x - z).powi(2)).sum::<f64>() / n_features
        });
        Self { squares, products }
    }

    fn matrix(&self, kernel: Kernel) -> DMatrix<f64> {
        let mut matrix =
            self.squares.zip_map(&self.products, |square, product| kernel.mixed(square, product));
        for i in 0..matrix.nrows() {
            matrix[(i, i)] += kernel.noise;
        }
        matrix
    }
}

/// Log marginal likelihood at the maximum-likelihood signal variance, without additive constants.
fn log_likelihood(cholesky: &Cholesky<f64, Dyn>, variance: f64) -> f64 {
    let triangle = cholesky.l_dirty();
    let n = triangle.nrows();
    let half_log_determinant: f64 = (0..n).map(|i| triangle[(i, i)].ln()).sum();
    -0.5 * n as f64 * variance.ln() - half_log_determinant
}

impl Scaling {
    /// Returns `None` if every feature is constant.
    fn of(features: &[Vec<f64>]) -> Option<Self> {
        let column = |feature: usize| features.iter().map(|row| row[feature]).collect::<Vec<f64>>();
        let used: Vec<(usize, f64, f64)> = (0..features[0].len())
            .map(|feature| (feature, column(feature)))
            .filter(|(_, column)| !is_constant(column))
            .map(|(feature, column)| (feature, mean(&column), standard_deviation(&column)))
            .collect();
        (!used.is_empty()).then_some(Self { used })
    }

    fn apply(&self, row: &[f64]) -> Vec<f64> {
        self.used.iter().map(|(feature, mean, deviation)| (row[*feature] - mean) / deviation).collect()
    }
}

fn check(features: &[Vec<f64>], values: &[f64]) -> Result<(), GaussianProcessError> {
    assert_eq!(features.len(), values.len(), "every example needs one value");
    let n = values.len();
    if n < LEAST_EXAMPLES {
        return Err(GaussianProcessError::TooFew { n });
    }
    let expected = features[0].len();
    for (index, (row, value)) in features.iter().zip(values).enumerate() {
        if row.len() != expected {
            return Err(GaussianProcessError::Shape { index, n: row.len(), expected });
        }
        if !value.is_finite() || row.iter().any(|x| !x.is_finite()) {
            return Err(GaussianProcessError::NotFinite { index });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
