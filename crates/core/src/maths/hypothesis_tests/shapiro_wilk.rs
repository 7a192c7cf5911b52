//! Test of Shapiro and Wilk: whether values come from a normal distribution.
//!
//! W and its probability are approximated as in P. Royston, "Remark AS R94: A remark on algorithm AS 181: the W-test
//! for normality" (1995). The normal quantiles are exact, as in R. scipy approximates them: W differs by less than
//! 1e-8, and the probability by less than 2e-7 up to 2000 values and by up to 1e-6 for 5000.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use statrs::distribution::{ContinuousCDF as _, Normal};

use crate::maths::hypothesis_tests::rounding::rounding_error;
use crate::maths::statistics::{centered, dot};

/// Fewest and most values for which the approximation holds.
pub const SIZES: [usize; 2] = [3, 5000];

/// Result of the test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapiroWilk {
    /// Squared correlation of the ordered values with those expected from a normal distribution, above 0 to 1 (normal).
    pub w: f64,
    /// Probability of a W at most this large for normal values.
    pub p_value: f64,
}

/// Reasons why the test is undefined.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapiroWilkError {
    /// There are too few or too many values for the approximation.
    #[error("the test of normality takes {} to {} values, got {n}", SIZES[0], SIZES[1])]
    Size {
        /// Number of values.
        n: usize,
    },
    /// A value is not finite.
    #[error("value {index} is not a finite number; leave it out")]
    NotFinite {
        /// Index of the value.
        index: usize,
    },
    /// All values are equal; scipy returns W = 1 and a probability of 1, with a warning.
    #[error("all values are equal, so the test of normality is undefined; state that they are equal")]
    Equal,
}

/// Polynomials of AS R94, the constant term first.
const FIRST_WEIGHT: [f64; 6] = [0.0, 0.221_157, -0.147_981, -2.071_19, 4.434_685, -2.706_056];
const SECOND_WEIGHT: [f64; 6] = [0.0, 0.042_981, -0.293_762, -1.752_461, 5.682_633, -3.582_633];
const SMALL_LIMIT: [f64; 2] = [-2.273, 0.459];
const SMALL_MEAN: [f64; 4] = [0.544, -0.399_78, 0.025_054, -6.714e-4];
const SMALL_LOG_DEVIATION: [f64; 4] = [1.3822, -0.778_57, 0.062_767, -0.002_032_2];
const LARGE_MEAN: [f64; 4] = [-1.5861, -0.310_82, -0.083_751, 0.003_891_5];
const LARGE_LOG_DEVIATION: [f64; 3] = [-0.4803, -0.082_676, 0.003_030_2];

/// Most values for which the polynomials of small samples hold.
const MOST_SMALL: usize = 11;

/// Probability that AS R94 returns where its transformation ends.
const LEAST_PROBABILITY: f64 = 1e-19;

/// Test of values, in any order.
///
/// # Errors
/// See [`ShapiroWilkError`].
pub fn shapiro_wilk(values: &[f64]) -> Result<ShapiroWilk, ShapiroWilkError> {
    let n = values.len();
    if !(SIZES[0]..=SIZES[1]).contains(&n) {
        return Err(ShapiroWilkError::Size { n });
    }
    if let Some(index) = values.iter().position(|value| !value.is_finite()) {
        return Err(ShapiroWilkError::NotFinite { index });
    }
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let range = sorted[n - 1] - sorted[0];
    if range <= rounding_error(values.iter().copied()) {
        return Err(ShapiroWilkError::Equal);
    }
    // Differences from the middle value, in units of the range, cost no digits.
    let middle = sorted[n / 2];
    let scaled: Vec<f64> = sorted.iter().map(|value| (value - middle) / range).collect();
    let (values, weights) = (centered(&scaled), centered(&weights(n)));
    let (of_values, of_weights, product) =
        (dot(&values, &values), dot(&weights, &weights), dot(&values, &weights));
    // 1 - W from the difference of roots: W itself is near 1 and would lose its last digits.
    let root = (of_values * of_weights).sqrt();
    // Rounding may move it below 0.
    let off = ((root - product) * (root + product) / (of_values * of_weights)).max(0.0);
    Ok(ShapiroWilk { w: 1.0 - off, p_value: probability(off, n) })
}

/// Weights of the ordered values, antisymmetric; their squares sum to 1.
fn weights(n: usize) -> Vec<f64> {
    let upper = if n == 3 { vec![FRAC_1_SQRT_2] } else { upper_weights(n) };
    let mut weights = vec![0.0; n];
    for (i, weight) in upper.into_iter().enumerate() {
        weights[i] = -weight;
        weights[n - 1 - i] = weight;
    }
    weights
}

/// Weights of the largest half of the values, the largest first; for 4 or more values.
fn upper_weights(n: usize) -> Vec<f64> {
    let normal = Normal::standard();
    let scores: Vec<f64> =
        (0..n / 2).map(|i| -normal.inverse_cdf((i as f64 + 0.625) / (n as f64 + 0.25))).collect();
    let sum = 2.0 * dot(&scores, &scores);
    let root = 1.0 / (n as f64).sqrt();
    let polynomials: &[[f64; 6]] = if n > 5 { &[FIRST_WEIGHT, SECOND_WEIGHT] } else { &[FIRST_WEIGHT] };
    let mut weights: Vec<f64> = polynomials
        .iter()
        .zip(&scores)
        .map(|(coefficients, score)| polynomial(coefficients, root) + score / sum.sqrt())
        .collect();
    let n_fitted = weights.len();
    // The other weights are proportional to their scores, so that all squares sum to 1.
    let rest = sum - 2.0 * dot(&scores[..n_fitted], &scores[..n_fitted]);
    let scale = (rest / (1.0 - 2.0 * dot(&weights, &weights))).sqrt();
    weights.extend(scores[n_fitted..].iter().map(|score| score / scale));
    weights
}

/// Probability of a larger `1 - W` of `n` normal values.
fn probability(off: f64, n: usize) -> f64 {
    if n == 3 {
        // Exact: W of three values is at least 3/4, up to rounding.
        return (1.0 - 6.0 / PI * (1.0 - off).max(0.75).sqrt().acos()).max(0.0);
    }
    let size = n as f64;
    let (score, mean, log_deviation) = if n <= MOST_SMALL {
        let limit = polynomial(&SMALL_LIMIT, size);
        if off.ln() >= limit {
            return LEAST_PROBABILITY;
        }
        (-(limit - off.ln()).ln(), polynomial(&SMALL_MEAN, size), polynomial(&SMALL_LOG_DEVIATION, size))
    } else {
        (off.ln(), polynomial(&LARGE_MEAN, size.ln()), polynomial(&LARGE_LOG_DEVIATION, size.ln()))
    };
    Normal::standard().sf((score - mean) / log_deviation.exp())
}

/// Polynomial at `x`, the constant term first.
fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

#[cfg(test)]
mod tests {
    use super::{ShapiroWilkError, shapiro_wilk, weights};
    use crate::maths::statistics::dot;
    use proptest::prelude::{prop, prop_assert, proptest};

    #[test]
    fn weights_have_unit_length_and_approach_normal_scores() {
        for n in [3, 4, 5, 6, 7, 11, 12, 50, 2000] {
            let weights = weights(n);
            assert!((dot(&weights, &weights) - 1.0).abs() < 1e-12, "{n} values");
            assert!(weights.windows(2).all(|pair| pair[0] <= pair[1]), "{n} values: {weights:?}");
        }
        // Weights of Shapiro and Wilk (1965) for 4 values, four decimals; AS R94 approximates them within 0.002.
        assert!((weights(4)[3] - 0.6872).abs() < 2e-3 && (weights(4)[2] - 0.1677).abs() < 2e-3);
    }

    #[test]
    fn three_values_have_the_closed_form() {
        // W = (x3 - x1)² / (2 S), and 2 of 3 equal values have the least, 3/4, with a probability of 0.
        let least = shapiro_wilk(&[2.0, 2.0, 3.0]).unwrap();
        assert!((least.w - 0.75).abs() < 1e-12 && least.p_value.abs() < 1e-7, "{least:?}");
        let even = shapiro_wilk(&[3.0, 1.0, 2.0]).unwrap();
        // Where W is 1, the arc cosine has half of the digits.
        assert!((even.w - 1.0).abs() < 1e-12 && (even.p_value - 1.0).abs() < 1e-7, "{even:?}");
        // 0, 1 and 3: W = 9 / (2 · 14 / 3).
        let skewed = shapiro_wilk(&[0.0, 1.0, 3.0]).unwrap();
        assert!((skewed.w - 27.0 / 28.0).abs() < 1e-12, "{skewed:?}");
    }

    #[test]
    fn values_without_a_test_are_refused() {
        assert_eq!(shapiro_wilk(&[1.0, 2.0]), Err(ShapiroWilkError::Size { n: 2 }));
        assert_eq!(shapiro_wilk(&vec![0.0; 5001]), Err(ShapiroWilkError::Size { n: 5001 }));
        assert_eq!(shapiro_wilk(&[1.0, f64::NAN, 2.0]), Err(ShapiroWilkError::NotFinite { index: 1 }));
        assert_eq!(shapiro_wilk(&[0.3, 0.1 + 0.2, 0.3]), Err(ShapiroWilkError::Equal));
    }

    proptest! {
        /// Unit, offset, sign and order of the values do not matter.
        #[test]
        fn w_does_not_depend_on_unit_offset_or_order(
            values in prop::collection::vec(-1.0..1.0_f64, 3..40),
            shift in -100.0..100.0_f64,
            factor in 0.01..100.0_f64,
        ) {
            let plain = shapiro_wilk(&values).unwrap();
            let other: Vec<f64> = values.iter().rev().map(|value| -factor * (value + shift)).collect();
            let changed = shapiro_wilk(&other).unwrap();
            // Values up to a hundred times their spread lose two of sixteen digits.
            prop_assert!((plain.w - changed.w).abs() < 1e-9, "{plain:?} {changed:?}");
            prop_assert!((0.0..=1.0 + 1e-12).contains(&plain.w) && (0.0..=1.0).contains(&plain.p_value));
        }
    }
}
