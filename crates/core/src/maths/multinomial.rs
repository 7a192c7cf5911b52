//! Multinomial logistic regression: class probabilities as the softmax of linear functions of the features (D. Böhning
//! 1992; C. Bishop 2006, section 4.3.4).

use ndarray::{Array2, aview1};

use crate::maths::minimize::{Stop, minimize};

/// Linear function of each class, of which the softmax gives the probabilities.
#[derive(Clone, Debug, PartialEq)]
pub struct MultinomialLogistic {
    /// Classes × features.
    pub coefficients: Array2<f64>,
    /// One for each class.
    pub intercepts: Vec<f64>,
}

/// Reasons why there is no regression.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MultinomialError {
    /// A class has no example, so its probability has no finite estimate.
    #[error("class {class} (from 0) has no example with a weight above 0; leave the class out")]
    Empty {
        /// Index of the class.
        class: usize,
    },
    /// The penalty is not a number above 0.
    #[error("the penalty of a logistic regression is {penalty}; use a number above 0")]
    Penalty {
        /// Given penalty.
        penalty: f64,
    },
    /// A feature or a weight is not finite.
    #[error("a feature or weight is not finite; correct the examples")]
    NotFinite,
}

/// Examples to learn from.
#[derive(Clone, Copy, Debug)]
pub struct Examples<'a> {
    /// Examples × features.
    pub rows: &'a Array2<f64>,
    /// Class of each example, from 0.
    pub classes: &'a [usize],
    /// Weight of each example, 0 or more.
    pub weights: &'a [f64],
}

impl MultinomialLogistic {
    /// Returns the regression with the smallest weighted mean of `-ln p(class)` plus `penalty / 2` times the sum of squared
    /// coefficients. Intercepts are not penalized.
    ///
    /// # Errors
    /// See [`MultinomialError`].
    ///
    /// # Panics
    /// If there is not one class below `n_classes` and one weight for each row.
    pub fn learn(
        examples: Examples<'_>,
        n_classes: usize,
        penalty: f64,
        stop: Stop,
    ) -> Result<Self, MultinomialError> {
        let Examples { rows, classes, weights } = examples;
        assert_eq!(
            [classes.len(), weights.len()],
            [rows.nrows(); 2],
            "each row needs one class and one weight"
        );
        if !(penalty.is_finite() && penalty > 0.0) {
            return Err(MultinomialError::Penalty { penalty });
        }
        let mut totals = vec![0.0; n_classes];
        for (class, weight) in classes.iter().zip(weights) {
            totals[*class] += weight;
        }
        let total: f64 = totals.iter().sum();
        if !(total.is_finite() && rows.iter().all(|x| x.is_finite())) {
            return Err(MultinomialError::NotFinite);
        }
        if let Some(class) = totals.iter().position(|total| *total <= 0.0) {
            return Err(MultinomialError::Empty { class });
        }
        // Begins at the shares of the classes, which are the solution if no feature carries information.
        let n_features = rows.ncols();
        let mut start = vec![0.0; n_classes * n_features];
        start.extend(totals.iter().map(|of_class| (of_class / total).ln()));
        let at = minimize(start, stop, |parameters| objective(parameters, examples, total, penalty));
        let learned = Self::of_parameters(&at, n_classes, n_features);
        // Finite input has a finite minimum, but its path can overflow.
        if at.iter().all(|x| x.is_finite()) { Ok(learned) } else { Err(MultinomialError::NotFinite) }
    }

    /// Returns the probability of each class for one row of features.
    pub fn probabilities(&self, row: &[f64]) -> Vec<f64> {
        let scores = self.coefficients.dot(&aview1(row));
        let mut scores: Vec<f64> =
            scores.iter().zip(&self.intercepts).map(|(score, intercept)| score + intercept).collect();
        softmax(&mut scores);
        scores
    }

    /// Reads the parameters in the order of the optimization: coefficients class by class, then intercepts.
    fn of_parameters(parameters: &[f64], n_classes: usize, n_features: usize) -> Self {
        let (coefficients, intercepts) = parameters.split_at(n_classes * n_features);
        let at = |(class, feature): (usize, usize)| coefficients[class * n_features + feature];
        Self {
            coefficients: Array2::from_shape_fn((n_classes, n_features), at),
            intercepts: intercepts.to_vec(),
        }
    }
}

/// Replaces scores by their softmax, and returns the logarithm of the sum of their exponentials.
fn softmax(scores: &mut [f64]) -> f64 {
    let most = scores.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut sum = 0.0;
    for score in scores.iter_mut() {
        *score = (*score - most).exp();
        sum += *score;
    }
    for share in scores.iter_mut() {
        *share /= sum;
    }
    most + sum.ln()
}

/// Returns the penalized mean of `-ln p` and its gradient.
fn objective(parameters: &[f64], examples: Examples<'_>, total: f64, penalty: f64) -> (f64, Vec<f64>) {
    let Examples { rows, classes, weights } = examples;
    let n_features = rows.ncols();
    let n_classes = parameters.len() / (n_features + 1);
    let MultinomialLogistic { coefficients, intercepts } =
        MultinomialLogistic::of_parameters(parameters, n_classes, n_features);
    // Examples × classes: scores, then the derivative of the mean by each score.
    let scores = rows.dot(&coefficients.t());
    let mut slopes = Array2::zeros((rows.nrows(), n_classes));
    let mut of_intercepts = vec![0.0; n_classes];
    let mut value = 0.0;
    let mut shares = vec![0.0; n_classes];
    let of_examples = scores.rows().into_iter().zip(classes).zip(weights);
    for (((scores, class), weight), mut slopes) in of_examples.zip(slopes.rows_mut()) {
        for ((share, score), intercept) in shares.iter_mut().zip(scores).zip(&intercepts) {
            *share = score + intercept;
        }
        let of_class = shares[*class];
        value += weight * (softmax(&mut shares) - of_class) / total;
        shares[*class] -= 1.0;
        for ((slope, sum), share) in slopes.iter_mut().zip(&mut of_intercepts).zip(&shares) {
            *slope = weight * share / total;
            *sum += *slope;
        }
    }
    let of_coefficients = slopes.t().dot(rows);
    let mut gradient = Vec::with_capacity(parameters.len());
    for (slope, coefficient) in of_coefficients.iter().zip(&coefficients) {
        value += 0.5 * penalty * coefficient * coefficient;
        gradient.push(slope + penalty * coefficient);
    }
    gradient.extend(of_intercepts);
    (value, gradient)
}

#[cfg(test)]
mod tests {
    use super::{Examples, MultinomialError, MultinomialLogistic, objective};
    use crate::maths::minimize::Stop;
    use crate::maths::rng::{Random, lcg_noise};
    use ndarray::Array2;

    const STOP: Stop = Stop { slope: 1e-8, n_steps: 1000 };

    /// Three classes around three corners, with weights.
    fn corners() -> (Array2<f64>, Vec<usize>, Vec<f64>) {
        let mut random = Random::new(4);
        let classes: Vec<usize> = (0..90).map(|i| i % 3).collect();
        let rows = Array2::from_shape_fn((90, 2), |(i, j)| {
            f64::from(u8::from(classes[i] == j)) * 2.0 + random.normal()
        });
        let weights = (0..90).map(|i| if i % 3 == 0 { 2.0 } else { 0.5 }).collect();
        (rows, classes, weights)
    }

    #[test]
    fn without_information_the_probabilities_are_the_shares() {
        let rows = Array2::zeros((5, 2));
        let (classes, weights) = ([0, 0, 1, 2, 2], [1.0, 1.0, 1.0, 1.0, 6.0]);
        let examples = Examples { rows: &rows, classes: &classes, weights: &weights };
        let learned = MultinomialLogistic::learn(examples, 3, 0.1, STOP).unwrap();
        for (got, expected) in learned.probabilities(&[4.0, -9.0]).iter().zip([0.2, 0.1, 0.7]) {
            assert!((got - expected).abs() < 1e-9, "{got} {expected}");
        }
    }

    #[test]
    fn the_gradient_is_the_slope_of_the_objective() {
        let (rows, classes, weights) = corners();
        let examples = Examples { rows: &rows, classes: &classes, weights: &weights };
        let total = weights.iter().sum();
        let at = lcg_noise(9, 2);
        let (_, gradient) = objective(&at, examples, total, 0.3);
        for (i, slope) in gradient.iter().enumerate() {
            let value = |shift: f64| {
                let mut moved = at.clone();
                moved[i] += shift;
                objective(&moved, examples, total, 0.3).0
            };
            // Central differences have an error of the order of the squared shift.
            let expected = (value(1e-5) - value(-1e-5)) / 2e-5;
            assert!((slope - expected).abs() < 1e-8, "{i}: {slope} {expected}");
        }
    }

    #[test]
    fn at_the_optimum_each_class_has_its_share_of_the_probability() {
        let (rows, classes, weights) = corners();
        let examples = Examples { rows: &rows, classes: &classes, weights: &weights };
        let learned = MultinomialLogistic::learn(examples, 3, 0.05, STOP).unwrap();
        let mut off = [0.0; 3];
        let mut n_right = 0;
        for ((row, class), weight) in rows.rows().into_iter().zip(&classes).zip(&weights) {
            let shares = learned.probabilities(&row.to_vec());
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            for (of_class, (off, share)) in off.iter_mut().zip(&shares).enumerate() {
                *off += weight * (share - f64::from(u8::from(of_class == *class)));
            }
            let best = (0..3).max_by(|a, b| shares[*a].total_cmp(&shares[*b])).unwrap();
            n_right += usize::from(best == *class);
        }
        // The intercepts are not penalized, so their slope vanishes: 1e-8 of a total weight of 90.
        assert!(off.iter().all(|off| off.abs() < 1e-5), "{off:?}");
        assert!(n_right > 55, "{n_right}");
    }

    #[test]
    fn impossible_input_is_refused() {
        let (rows, classes, weights) = corners();
        let examples = Examples { rows: &rows, classes: &classes, weights: &weights };
        let of = |examples, n, penalty| MultinomialLogistic::learn(examples, n, penalty, STOP);
        assert_eq!(of(examples, 4, 0.1), Err(MultinomialError::Empty { class: 3 }));
        assert_eq!(of(examples, 3, 0.0), Err(MultinomialError::Penalty { penalty: 0.0 }));
        let mut broken = rows.clone();
        broken[[3, 1]] = f64::NAN;
        assert_eq!(of(Examples { rows: &broken, ..examples }, 3, 0.1), Err(MultinomialError::NotFinite));
    }
}
