//! Bootstrap: confidence interval of any statistic, by drawing from the values.

use crate::maths::hypothesis_tests::intervals::{Confidence, Interval};
use crate::maths::rng::Random;
use crate::maths::statistics::quantile;

/// Percentile interval of a statistic (Efron 1979): its quantiles over `n_draws` samples, each as large as `values` and
/// drawn from them with replacement. The same seed gives the same interval.
///
/// `None` without values or draws, or if the statistic of a sample is not finite. For few values, the interval is
/// narrower than its confidence level states; the mean has [`super::intervals::mean_interval`].
pub fn bootstrap_interval(
    values: &[f64],
    statistic: impl Fn(&[f64]) -> f64,
    confidence: Confidence,
    n_draws: usize,
    seed: u64,
) -> Option<Interval> {
    if values.is_empty() {
        return None;
    }
    let mut random = Random::new(seed);
    let mut sample = vec![0.0; values.len()];
    let mut draw = || {
        sample.fill_with(|| values[random.below(values.len())]);
        statistic(&sample)
    };
    let drawn: Vec<f64> = (0..n_draws).map(|_| draw()).collect();
    if drawn.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let tail = 0.5 * confidence.outside();
    Some(Interval { low: quantile(&drawn, tail)?, high: quantile(&drawn, 1.0 - tail)? })
}

#[cfg(test)]
mod tests {
    use super::bootstrap_interval;
    use crate::maths::hypothesis_tests::intervals::{Confidence, mean_interval};
    use crate::maths::rng::lcg_noise;
    use crate::maths::statistics::mean;

    #[test]
    fn three_values_have_the_quantiles_of_their_27_samples() {
        // Sums of three draws from 0, 1 and 5, in order: 0 (once of 27), 1 (3), 2 (3), 3, 5, 6, 7, 10, 11 (3), 15
        // (once). The sums 1 and 11 contain the quantiles at 10 % and 90 %.
        let confidence = Confidence::new(0.8).unwrap();
        let found = bootstrap_interval(&[0.0, 1.0, 5.0], mean, confidence, 5000, 9).unwrap();
        assert!(
            (found.low - 1.0 / 3.0).abs() < 1e-12 && (found.high - 11.0 / 3.0).abs() < 1e-12,
            "{found:?}"
        );
        let again = bootstrap_interval(&[0.0, 1.0, 5.0], mean, confidence, 5000, 9);
        assert_eq!(again, Some(found));
    }

    #[test]
    fn many_normal_values_have_nearly_the_interval_of_the_mean() {
        let values = lcg_noise(400, 5);
        let bootstrap = bootstrap_interval(&values, mean, Confidence::NINETY_FIVE, 4000, 1).unwrap();
        let normal = mean_interval(&values, Confidence::NINETY_FIVE).unwrap().interval;
        // The quantile at 2.5 % of 4000 draws has a standard error of 0.042 of the standard error of the mean, which is
        // 0.05.
        assert!((bootstrap.low - normal.low).abs() < 0.01, "{bootstrap:?} {normal:?}");
        assert!((bootstrap.high - normal.high).abs() < 0.01, "{bootstrap:?} {normal:?}");
    }

    #[test]
    fn without_values_draws_or_a_finite_statistic_there_is_no_interval() {
        let interval = |values: &[f64], n_draws: usize| {
            bootstrap_interval(values, mean, Confidence::NINETY_FIVE, n_draws, 1)
        };
        assert_eq!((interval(&[], 10), interval(&[1.0], 0)), (None, None));
        assert_eq!(interval(&[1.0, f64::NAN], 50), None);
        let equal = interval(&[7.0; 4], 50).unwrap();
        assert_eq!((equal.low, equal.high), (7.0, 7.0));
    }
}
