//! Standard deviation of an attribute predicted from a photo, scaled so that it holds on photos that were left out of the
//! training.
//!
//! The variance is a sum of terms: a constant, and what makes a prediction uncertain, such as heads and views that
//! disagree. Their coefficients maximize the likelihood of the errors of left-out photos
//! ([`shagreen_core::maths::variance_components`]). The standard deviation is never below that of the labels of the likely
//! classes, grows with the distance from the training photos and with doubts, and never exceeds that of an unknown
//! attribute.

use serde::{Deserialize, Serialize};
use shagreen_core::maths::variance_components::{ErrorTerms, variance_components};
use shagreen_core::surfaces::picture_doubts::{PictureDoubt, widened};
use shagreen_core::surfaces::prompt::OPEN;

/// Number of terms of the variance.
pub(crate) const N_TERMS: usize = 4;

/// Prediction of one attribute from one photo, with the terms of its variance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Evidence {
    /// Predicted value, 0 to 100.
    pub(crate) mean: f64,
    /// Terms of the variance, 0 or more, in squared points; the first is constant.
    pub(crate) terms: [f64; N_TERMS],
    /// Standard deviation of the labels of the likely classes, in points.
    pub(crate) of_labels: f64,
}

/// Evidence about a photo that was left out of the training, with its error.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LeftOutError {
    pub(crate) evidence: Evidence,
    /// Squared error, in squared points.
    pub(crate) squared: f64,
    /// Weight of the photo.
    pub(crate) weight: f64,
    /// Distance from the training photos; 1 is usual.
    pub(crate) unlikeness: f64,
    pub(crate) doubts: Vec<PictureDoubt>,
}

/// Coefficients of the terms of the variance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct DeviationModel {
    coefficients: [f64; N_TERMS],
}

impl DeviationModel {
    /// Returns the model whose standard deviations fit the errors: the weighted mean of squared error over variance is one,
    /// unless limits prevent it. `None` without any error.
    pub(crate) fn fit(errors: &[LeftOutError]) -> Option<Self> {
        let without_distance = |error: &LeftOutError| ErrorTerms {
            // The standard deviation is multiplied by the unlikeness afterward.
            squared: error.squared / error.unlikeness.max(1.0).powi(2),
            terms: error.evidence.terms,
            weight: error.weight,
        };
        let terms: Vec<ErrorTerms<N_TERMS>> = errors.iter().map(without_distance).collect();
        let unscaled = Self { coefficients: variance_components(&terms)? };
        // Limits and doubts change the ratio. It falls with the scale, so the scale is found by bisection.
        let (mut low, mut high) = (SCALES[0].ln(), SCALES[1].ln());
        for _ in 0..N_BISECTIONS {
            let middle = 0.5 * (low + high);
            let is_too_small = unscaled.scaled(middle.exp()).ratio(errors).is_some_and(|ratio| ratio > 1.0);
            if is_too_small { low = middle } else { high = middle }
        }
        Some(unscaled.scaled((0.5 * (low + high)).exp()))
    }

    /// Returns the model with standard deviations that are `scale` times as large, within their limits.
    fn scaled(self, scale: f64) -> Self {
        Self { coefficients: self.coefficients.map(|coefficient| scale * scale * coefficient) }
    }

    /// Returns the root of the weighted mean of squared error over variance; `None` if all weights are zero.
    pub(crate) fn ratio(self, errors: &[LeftOutError]) -> Option<f64> {
        let total: f64 = errors.iter().map(|error| error.weight).sum();
        let of = |error: &LeftOutError| {
            let deviation = self.deviation(&error.evidence, error.unlikeness, &error.doubts);
            error.weight * error.squared / (deviation * deviation)
        };
        (total > 0.0).then(|| (errors.iter().map(of).sum::<f64>() / total).sqrt())
    }

    /// Returns the standard deviation of a prediction, in points: above 0, at most that of an unknown attribute.
    pub(crate) fn deviation(self, evidence: &Evidence, unlikeness: f64, doubts: &[PictureDoubt]) -> f64 {
        let variance: f64 =
            self.coefficients.iter().zip(evidence.terms).map(|(coefficient, term)| coefficient * term).sum();
        let usual = variance.sqrt().max(evidence.of_labels).max(LEAST);
        widened((usual * unlikeness.max(1.0)).min(OPEN.deviation), doubts)
    }

    /// Returns whether the coefficients are possible.
    pub(crate) fn is_sound(self) -> bool {
        self.coefficients.iter().all(|coefficient| coefficient.is_finite() && *coefficient >= 0.0)
    }
}

/// Smallest standard deviation, in points.
const LEAST: f64 = 1.0;
/// Range of the scale of the standard deviations.
const SCALES: [f64; 2] = [1e-2, 1e2];
/// Number of bisections of the scale: it is then exact to nine digits.
const N_BISECTIONS: usize = 40;

#[cfg(test)]
mod tests {
    use super::{DeviationModel, Evidence, LeftOutError};
    use shagreen_core::maths::rng::Random;
    use shagreen_core::surfaces::picture_doubts::PictureDoubt;
    use shagreen_core::surfaces::prompt::OPEN;

    /// Errors of a standard deviation of 5 points where the heads agree, and up to 12 where they do not.
    fn errors(of_labels: f64) -> Vec<LeftOutError> {
        let mut random = Random::new(2);
        let error = |index: usize| {
            let spread = 60.0 * random.uniform();
            let unlikeness: f64 = if index.is_multiple_of(10) { 1.5 } else { 0.8 };
            let deviation = (25.0 + 2.0 * spread).sqrt() * unlikeness.max(1.0);
            LeftOutError {
                evidence: Evidence { mean: 50.0, terms: [1.0, spread, 0.0, 3.0], of_labels },
                squared: (deviation * random.normal()).powi(2),
                weight: 0.5,
                unlikeness,
                doubts: Vec::new(),
            }
        };
        (0..4000).map(error).collect()
    }

    #[test]
    fn the_deviation_is_that_of_the_errors_where_heads_agree_and_where_they_do_not() {
        let errors = errors(2.0);
        let model = DeviationModel::fit(&errors).unwrap();
        assert!((model.ratio(&errors).unwrap() - 1.0).abs() < 1e-6);
        for (spread, expected) in [(0.0, 5.0), (50.0, 125.0_f64.sqrt())] {
            let evidence = Evidence { mean: 50.0, terms: [1.0, spread, 0.0, 3.0], of_labels: 2.0 };
            let deviation = model.deviation(&evidence, 0.5, &[]);
            // 4,000 errors determine a variance within 2 to 3 %.
            assert!((deviation / expected - 1.0).abs() < 0.06, "{spread}: {deviation}");
        }
    }

    #[test]
    fn the_deviation_stays_within_its_limits_and_grows_with_distance_and_doubts() {
        let model = DeviationModel::fit(&errors(2.0)).unwrap();
        let evidence = Evidence { mean: 50.0, terms: [1.0, 10.0, 0.0, 3.0], of_labels: 2.0 };
        let usual = model.deviation(&evidence, 1.0, &[]);
        assert!((model.deviation(&evidence, 2.0, &[]) / usual - 2.0).abs() < 1e-9);
        assert!(model.deviation(&evidence, 1.0, &[PictureDoubt::Blurred]) > usual);
        assert!((model.deviation(&evidence, 1e9, &[]) - OPEN.deviation).abs() < 1e-9);
        let wide = Evidence { of_labels: 17.0, ..evidence };
        assert!((model.deviation(&wide, 1.0, &[]) - 17.0).abs() < 1e-9);
        assert!(model.is_sound());
    }

    #[test]
    fn wide_labels_leave_the_deviations_too_cautious_and_the_ratio_says_so() {
        let errors = errors(25.0);
        let model = DeviationModel::fit(&errors).unwrap();
        assert!(model.ratio(&errors).unwrap() < 0.6);
        assert!(DeviationModel::fit(&[]).is_none() && model.ratio(&[]).is_none());
    }
}
