//! Regression by a Gaussian process: what follows for a new place from a few known ones, and how sure that is.
//!
//! The kernel of two places `x`, `z` of `d` features, each brought to mean 0 and deviation 1 over the known places, is
//! `s² ((1 - l) exp(-|x - z|² / (2 r² d)) + l x·z / d)`, on top of noise of variance `s² n`: near places are alike, and
//! what lies beyond all of them follows the trend. `s²` has a closed form; reach `r`, trend `l` and noise `n` are those
//! of a grid with the highest marginal likelihood (Rasmussen and Williams 2006, equations 2.25, 2.26, 5.8 and 5.12).

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::statistics::{dot, is_constant, mean, standard_deviation};

/// Reaches that are tried, in deviations of a feature.
const REACHES: [f64; 5] = [0.5, 0.9, 1.5, 2.5, 4.5];
/// Shares of the trend that are tried.
const TRENDS: [f64; 4] = [0.0, 0.3, 0.7, 0.95];
/// Variances of the noise that are tried, as shares of that of the signal.
const NOISES: [f64; 6] = [0.003, 0.01, 0.03, 0.1, 0.3, 1.0];

/// Variance that is left to values that are all equal: as sure as a number can be that says nothing of its scale.
const LEAST_VARIANCE: f64 = 1e-12;

/// A number that is not known exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Its mean, in the unit of the values that were learned.
    pub mean: f64,
    /// Its standard deviation, in the same unit.
    pub deviation: f64,
}

/// Why nothing was learned.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GaussianProcessError {
    /// There is nothing to tell places apart by, or too few places.
    #[error("{n} examples are too few to learn from; at least {LEAST_EXAMPLES} are needed")]
    TooFew {
        /// How many there are.
        n: usize,
    },
    /// Rows of features are not equally long, or there is none for each value.
    #[error("example {index} has {n} features, {expected} are expected")]
    Shape {
        /// Its index.
        index: usize,
        /// How many it has.
        n: usize,
        /// How many the first has.
        expected: usize,
    },
    /// A feature or a value is not a number.
    #[error("example {index} is not finite")]
    NotFinite {
        /// Its index.
        index: usize,
    },
    /// No feature tells the examples apart.
    #[error("all examples have the same features; nothing can be learned from them")]
    Alike,
}

/// Examples below which no kernel can be told from another.
pub const LEAST_EXAMPLES: usize = 4;

/// What a kernel is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel {
    /// Distance at which places are still alike, in deviations of a feature, above 0.
    pub reach: f64,
    /// Share of the signal that follows a straight line, 0 to 1.
    pub trend: f64,
    /// Variance of the noise as a share of that of the signal, above 0.
    pub noise: f64,
}

/// Features brought to mean 0 and deviation 1; those that say nothing are left out.
#[derive(Clone, Debug, PartialEq)]
struct Scaling {
    /// Index, mean and deviation of each feature that is used.
    used: Vec<(usize, f64, f64)>,
}

/// What was learned.
#[derive(Clone, Debug)]
pub struct GaussianProcess {
    n_features: usize,
    scaling: Scaling,
    /// Known places, scaled.
    places: Vec<Vec<f64>>,
    kernel: Kernel,
    mean: f64,
    signal_variance: f64,
    cholesky: Cholesky<f64, Dyn>,
    /// The inverse of the kernel times the values.
    weights: DVector<f64>,
}

impl GaussianProcess {
    /// Learns `values` of places with these `features` (examples × features), with the likeliest kernel of the grid.
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
        // Noise on the diagonal makes every matrix of the grid definite, if its numbers are finite.
        best.map(|(_, learned)| learned).ok_or(GaussianProcessError::NotFinite { index: 0 })
    }

    /// The kernel that was likeliest.
    pub fn kernel(&self) -> Kernel {
        self.kernel
    }

    /// What a new place has, its noise included: what one more measurement there would show.
    ///
    /// # Panics
    /// If it has another number of features.
    pub fn at(&self, features: &[f64]) -> Estimate {
        assert_eq!(features.len(), self.n_features, "a place has the features that were learned");
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

    /// What each known place would be taken for if it alone were not known, with this kernel and scale.
    pub fn leave_one_out(&self) -> Vec<Estimate> {
        let inverse = self.cholesky.inverse();
        let of = |(index, value): (usize, f64)| Estimate {
            mean: self.mean + value - self.weights[index] / inverse[(index, index)],
            deviation: (self.signal_variance / inverse[(index, index)]).sqrt(),
        };
        // The values themselves: the kernel times its inverse times them.
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

/// Mean squares of differences and mean products of all pairs of places: every kernel is made of them.
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

/// Logarithm of the marginal likelihood at the likeliest variance, but for constants.
fn log_likelihood(cholesky: &Cholesky<f64, Dyn>, variance: f64) -> f64 {
    let triangle = cholesky.l_dirty();
    let n = triangle.nrows();
    let half_log_determinant: f64 = (0..n).map(|i| triangle[(i, i)].ln()).sum();
    -0.5 * n as f64 * variance.ln() - half_log_determinant
}

impl Scaling {
    /// `None` where no feature differs from place to place.
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
    assert_eq!(features.len(), values.len(), "every example has a value");
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
