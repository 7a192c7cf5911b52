//! Confidence intervals of means and proportions.

use statrs::distribution::{ContinuousCDF as _, Normal};
use statrs::function::beta::inv_beta_reg;

use crate::maths::statistics::{mean, standard_deviation, t_quantile_two_sided};

/// Confidence level of an interval: the share of such intervals that contain the true value, above 0 and below 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Confidence(f64);

/// Reason why a number is no confidence level.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("the confidence level is {level}; it must be above 0 and below 1, such as 0.95")]
pub struct ConfidenceError {
    /// The number.
    pub level: f64,
}

impl Confidence {
    /// The usual level, 95 %.
    pub const NINETY_FIVE: Self = Self(0.95);

    /// Checks a level, above 0 and below 1.
    ///
    /// # Errors
    /// [`ConfidenceError`] for any other number.
    pub fn new(level: f64) -> Result<Self, ConfidenceError> {
        if level > 0.0 && level < 1.0 { Ok(Self(level)) } else { Err(ConfidenceError { level }) }
    }

    /// The level, above 0 and below 1.
    pub fn level(self) -> f64 {
        self.0
    }

    /// Share of the intervals that do not contain the true value, above 0 and below 1.
    pub fn outside(self) -> f64 {
        1.0 - self.0
    }
}

/// Interval between two values, in their unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end, not below the lower one.
    pub high: f64,
}

impl Interval {
    /// Interval of this half width, 0 or more, around a center.
    pub(super) fn around(center: f64, half_width: f64) -> Self {
        Self { low: center - half_width, high: center + half_width }
    }
}

/// Mean with its confidence interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanInterval {
    /// Arithmetic mean.
    pub mean: f64,
    /// Standard error of the mean, 0 or more.
    pub standard_error: f64,
    /// Half width of the confidence interval by Student's t, 0 or more.
    pub half_width: f64,
    /// Interval of this half width around the mean. It can extend beyond the ends of a rating scale.
    pub interval: Interval,
}

/// Mean of values with its confidence interval by Student's t, which assumes a normal mean; `None` for fewer than two
/// values.
pub fn mean_interval(values: &[f64], confidence: Confidence) -> Option<MeanInterval> {
    let first = *values.first()?;
    let dof = values.len() - 1;
    if dof == 0 {
        return None;
    }
    // Differences from a value cost no digits if all have a large offset.
    let shifted: Vec<f64> = values.iter().map(|value| value - first).collect();
    let mean = first + mean(&shifted);
    let standard_error = standard_deviation(&shifted) / (values.len() as f64).sqrt();
    let half_width = t_quantile_two_sided(confidence.outside(), dof as f64) * standard_error;
    Some(MeanInterval { mean, standard_error, half_width, interval: Interval::around(mean, half_width) })
}

/// Interval of a proportion of `n_right` in `n` trials by E. B. Wilson (1927), without correction for continuity;
/// `None` if there are no trials, or more successes than trials.
///
/// Its coverage is near the confidence level on average, also for few trials and proportions near 0 and 1.
pub fn wilson_interval(n_right: u64, n: u64, confidence: Confidence) -> Option<Interval> {
    if n == 0 || n_right > n {
        return None;
    }
    let (share, n) = (n_right as f64 / n as f64, n as f64);
    let z = -Normal::standard().inverse_cdf(0.5 * confidence.outside());
    let scale = 1.0 + z * z / n;
    let center = (share + 0.5 * z * z / n) / scale;
    let half_width = z * (share * (1.0 - share) / n + 0.25 * z * z / (n * n)).sqrt() / scale;
    let interval = Interval::around(center, half_width);
    // Rounding may move an end out of the range.
    Some(Interval { low: interval.low.max(0.0), high: interval.high.min(1.0) })
}

/// Interval of a proportion of `n_right` in `n` trials by C. J. Clopper and E. S. Pearson (1934); `None` if there are
/// no trials, or more successes than trials.
///
/// Its coverage is never below the confidence level, and often clearly above it.
pub fn clopper_pearson_interval(n_right: u64, n: u64, confidence: Confidence) -> Option<Interval> {
    if n == 0 || n_right > n {
        return None;
    }
    let (right, wrong) = (n_right as f64, (n - n_right) as f64);
    let tail = 0.5 * confidence.outside();
    // Proportion at which as many successes, or more, have the probability of one tail; for the upper end, as many or
    // fewer.
    let low = if n_right == 0 { 0.0 } else { inv_beta_reg(right, wrong + 1.0, tail) };
    let high = if n_right == n { 1.0 } else { 1.0 - inv_beta_reg(wrong, right + 1.0, tail) };
    Some(Interval { low, high })
}

#[cfg(test)]
mod tests {
    use super::{Confidence, ConfidenceError, clopper_pearson_interval, mean_interval, wilson_interval};
    use crate::maths::rng::Random;
    use crate::maths::statistics::binomial_upper_tail;
    use proptest::prelude::{prop_assert, proptest};

    #[test]
    fn levels_lie_between_zero_and_one() {
        assert_eq!(Confidence::new(0.95), Ok(Confidence::NINETY_FIVE));
        for level in [0.0, 1.0, -0.5, 95.0] {
            assert_eq!(Confidence::new(level), Err(ConfidenceError { level }));
        }
        assert!(Confidence::new(f64::NAN).is_err());
    }

    #[test]
    fn a_mean_of_two_has_the_closed_form() {
        // With one degree of freedom, t at 95 % is tan(0.95 π / 2), and the standard error of 1 and 3 is 1.
        let found = mean_interval(&[1.0, 3.0], Confidence::NINETY_FIVE).unwrap();
        let t = (0.95 * std::f64::consts::FRAC_PI_2).tan();
        assert!((found.mean - 2.0).abs() < 1e-12 && (found.standard_error - 1.0).abs() < 1e-12, "{found:?}");
        assert!((found.half_width - t).abs() < 1e-8 && (found.interval.high - 2.0 - t).abs() < 1e-8);
        let equal = mean_interval(&[0.1; 5], Confidence::NINETY_FIVE).unwrap();
        assert_eq!((equal.interval.low, equal.interval.high), (0.1, 0.1));
        assert_eq!(mean_interval(&[1.0], Confidence::NINETY_FIVE), None);
        assert_eq!(mean_interval(&[], Confidence::NINETY_FIVE), None);
    }

    #[test]
    fn intervals_of_normal_means_contain_the_true_mean_as_often_as_stated() {
        let mut random = Random::new(3);
        let confidence = Confidence::new(0.8).unwrap();
        let n_runs = 4000;
        let contains = (0..n_runs).filter(|_| {
            let values: Vec<f64> = (0..5).map(|_| random.normal()).collect();
            let interval = mean_interval(&values, confidence).unwrap().interval;
            interval.low < 0.0 && interval.high > 0.0
        });
        // Four standard deviations of a binomial count are 101.
        let n = contains.count();
        assert!(n.abs_diff(3200) < 101, "{n} of {n_runs}");
    }

    #[test]
    fn proportions_of_no_or_all_trials_have_closed_forms() {
        let z = 1.959_963_984_540_054_f64;
        let wilson = wilson_interval(0, 10, Confidence::NINETY_FIVE).unwrap();
        assert!(wilson.low < 1e-15 && (wilson.high - z * z / (10.0 + z * z)).abs() < 1e-12, "{wilson:?}");
        // (1 - p)^10 is 2.5 %.
        let exact = clopper_pearson_interval(0, 10, Confidence::NINETY_FIVE).unwrap();
        assert!(exact.low == 0.0 && (exact.high - (1.0 - 0.025_f64.powf(0.1))).abs() < 1e-10, "{exact:?}");
        let all = clopper_pearson_interval(10, 10, Confidence::NINETY_FIVE).unwrap();
        assert!(all.high == 1.0 && (all.low - 0.025_f64.powf(0.1)).abs() < 1e-10, "{all:?}");
        assert_eq!(wilson_interval(0, 0, Confidence::NINETY_FIVE), None);
        assert_eq!(clopper_pearson_interval(3, 2, Confidence::NINETY_FIVE), None);
    }

    proptest! {
        /// The ends of the exact interval are the proportions at which a binomial tail is half of what lies outside.
        #[test]
        fn exact_ends_have_the_tails_of_the_binomial_distribution(n in 1_u64..200, share in 0.0..1.0_f64) {
            let n_right = (share * n as f64).round() as u64;
            let interval = clopper_pearson_interval(n_right, n, Confidence::NINETY_FIVE).unwrap();
            if n_right > 0 {
                prop_assert!((binomial_upper_tail(n_right, n, interval.low) - 0.025).abs() < 1e-9);
            }
            if n_right < n {
                prop_assert!((1.0 - binomial_upper_tail(n_right + 1, n, interval.high) - 0.025).abs() < 1e-9);
            }
            let wilson = wilson_interval(n_right, n, Confidence::NINETY_FIVE).unwrap();
            let share = n_right as f64 / n as f64;
            for ends in [interval, wilson] {
                prop_assert!(ends.low <= share + 1e-12 && share <= ends.high + 1e-12, "{ends:?}");
            }
        }
    }
}
