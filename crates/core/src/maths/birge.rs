//! Weighted mean of independent estimates of one quantity that may disagree by more than they state.

use crate::maths::gaussian_process::Estimate;

/// Smallest standard deviation that is used for a weight, so that an exact estimate has a finite one.
const LEAST_DEVIATION: f64 = 1e-6;

/// Weighted mean of several estimates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BirgeMean {
    /// Mean with its standard deviation.
    pub estimate: Estimate,
    /// Birge ratio, 0 or more; 0 for a single estimate. Above 1, the estimates differ by more than their standard deviations
    /// explain.
    pub ratio: f64,
}

/// Returns the mean of the estimates, weighted by their precision `w = 1 / σ²`; `None` without estimates.
///
/// The Birge ratio is `R = √(Σ w (x - mean)² / (n - 1))` (R. T. Birge, "The calculation of errors by the method of least
/// squares", 1932). The standard deviation of the mean is `max(1, R) / √(Σ w)`.
pub fn birge_mean(estimates: &[Estimate]) -> Option<BirgeMean> {
    let n_others = estimates.len().checked_sub(1)?;
    let precision = |estimate: &Estimate| {
        let deviation = estimate.deviation.max(LEAST_DEVIATION);
        1.0 / (deviation * deviation)
    };
    let total: f64 = estimates.iter().map(precision).sum();
    let mean = estimates.iter().map(|estimate| precision(estimate) * estimate.mean).sum::<f64>() / total;
    let off: f64 =
        estimates.iter().map(|estimate| precision(estimate) * (estimate.mean - mean).powi(2)).sum();
    // A single estimate cannot disagree, up to rounding.
    let square = off / n_others.max(1) as f64;
    Some(BirgeMean {
        estimate: Estimate { mean, deviation: (square.max(1.0) / total).sqrt() },
        ratio: if n_others == 0 { 0.0 } else { square.sqrt() },
    })
}

#[cfg(test)]
mod tests {
    use super::birge_mean;
    use crate::maths::gaussian_process::Estimate;
    use proptest::prelude::{prop_assert, proptest};

    fn of(values: &[(f64, f64)]) -> Vec<Estimate> {
        values.iter().map(|(mean, deviation)| Estimate { mean: *mean, deviation: *deviation }).collect()
    }

    #[test]
    fn two_estimates_have_the_closed_form() {
        // The Birge ratio of two estimates is their distance over the standard deviation of their difference.
        let near = birge_mean(&of(&[(40.0, 10.0), (50.0, 5.0)])).unwrap();
        assert!((near.estimate.mean - 48.0).abs() < 1e-12);
        assert!((near.estimate.deviation - 20.0_f64.sqrt()).abs() < 1e-12, "{near:?}");
        assert!((near.ratio - 10.0 / 125.0_f64.sqrt()).abs() < 1e-12);
        let far = birge_mean(&of(&[(40.0, 3.0), (60.0, 4.0)])).unwrap();
        assert!((far.ratio - 4.0).abs() < 1e-12);
        // Four times 3 · 4 / 5.
        assert!((far.estimate.deviation - 9.6).abs() < 1e-12, "{far:?}");
    }

    #[test]
    fn one_estimate_stays_as_it_is_and_none_has_no_mean() {
        let one = birge_mean(&of(&[(37.0, 9.0)])).unwrap();
        assert!((one.estimate.mean - 37.0).abs() < 1e-12 && (one.estimate.deviation - 9.0).abs() < 1e-12);
        assert_eq!(one.ratio, 0.0);
        assert_eq!(birge_mean(&[]), None);
        let exact = birge_mean(&of(&[(20.0, 0.0), (90.0, 10.0)])).unwrap();
        assert!((exact.estimate.mean - 20.0).abs() < 1e-6, "{exact:?}");
    }

    proptest! {
        /// The mean minimizes the weighted squares, as a search over a grid finds it, and does not depend on the order.
        #[test]
        fn the_mean_has_the_least_weighted_squares(
            values in proptest::collection::vec((0.0..100.0_f64, 1.0..30.0_f64), 1..6),
        ) {
            let estimates = of(&values);
            let found = birge_mean(&estimates).unwrap();
            let squares = |at: f64| -> f64 {
                values.iter().map(|(mean, deviation)| ((at - mean) / deviation).powi(2)).sum()
            };
            let grid = (0..=10_000).map(|i| 0.01 * f64::from(i));
            let best = grid.min_by(|a, b| squares(*a).total_cmp(&squares(*b))).unwrap();
            prop_assert!((found.estimate.mean - best).abs() <= 0.0051, "{} for {best}", found.estimate.mean);
            let least = values.iter().map(|(_, deviation)| deviation.powi(-2)).sum::<f64>().powf(-0.5);
            prop_assert!(found.estimate.deviation >= least - 1e-9);
            let reversed: Vec<Estimate> = estimates.iter().rev().copied().collect();
            prop_assert!((birge_mean(&reversed).unwrap().estimate.mean - found.estimate.mean).abs() < 1e-9);
        }
    }
}
