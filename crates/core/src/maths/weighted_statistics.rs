//! Means and correlations of values with weights.

/// Weighted arithmetic mean; 0 if the weights sum to zero.
///
/// # Panics
/// If the lengths differ.
pub fn weighted_mean(values: &[f64], weights: &[f64]) -> f64 {
    assert_eq!(values.len(), weights.len(), "each value needs a weight");
    let total: f64 = weights.iter().sum();
    let sum: f64 = values.iter().zip(weights).map(|(value, weight)| weight * value).sum();
    if total > 0.0 { sum / total } else { 0.0 }
}

/// Weighted variance about the weighted mean, with the sum of the weights as divisor; 0 if it is zero.
///
/// # Panics
/// If the lengths differ.
pub fn weighted_variance(values: &[f64], weights: &[f64]) -> f64 {
    let mean = weighted_mean(values, weights);
    let squares: Vec<f64> = values.iter().map(|value| (value - mean).powi(2)).collect();
    weighted_mean(&squares, weights)
}

/// Pearson's correlation coefficient with weights, -1 to 1; `None` if either input is constant.
///
/// # Panics
/// If the lengths differ.
pub fn weighted_correlation(a: &[f64], b: &[f64], weights: &[f64]) -> Option<f64> {
    let (mean_a, mean_b) = (weighted_mean(a, weights), weighted_mean(b, weights));
    let products: Vec<f64> = a.iter().zip(b).map(|(x, y)| (x - mean_a) * (y - mean_b)).collect();
    let scale = (weighted_variance(a, weights) * weighted_variance(b, weights)).sqrt();
    // Equal numbers leave rounding error of this size.
    let rounding = 1e-12 * (1.0 + mean_a.abs()) * (1.0 + mean_b.abs());
    (scale > rounding).then(|| (weighted_mean(&products, weights) / scale).clamp(-1.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::{weighted_correlation, weighted_mean, weighted_variance};
    use crate::maths::statistics::{correlation, mean};

    const A: [f64; 4] = [1.0, 2.0, 5.0, 3.0];
    const B: [f64; 4] = [2.0, 1.0, 4.0, 4.0];

    #[test]
    fn equal_weights_give_the_plain_statistics() {
        assert_eq!(weighted_mean(&A, &[0.5; 4]), mean(&A));
        assert!((weighted_variance(&A, &[2.0; 4]) - 35.0 / 16.0).abs() < 1e-12);
        let plain = correlation(&A, &B).unwrap();
        assert!((weighted_correlation(&A, &B, &[3.0; 4]).unwrap() - plain).abs() < 1e-12);
    }

    #[test]
    fn a_weight_counts_as_that_many_values() {
        let weights = [1.0, 3.0, 0.0, 2.0];
        let repeat = |values: [f64; 4]| {
            let [a, b, _, d] = values;
            [a, b, b, b, d, d]
        };
        assert!((weighted_mean(&A, &weights) - mean(&repeat(A))).abs() < 1e-12);
        let plain = correlation(&repeat(A), &repeat(B)).unwrap();
        assert!((weighted_correlation(&A, &B, &weights).unwrap() - plain).abs() < 1e-12);
    }

    #[test]
    fn constants_have_no_correlation_and_no_weight_no_mean() {
        assert_eq!(weighted_correlation(&A, &[7.3; 4], &[1.0; 4]), None);
        assert_eq!((weighted_mean(&A, &[0.0; 4]), weighted_mean(&[], &[])), (0.0, 0.0));
    }
}
