//! Differences that rounding errors alone can cause, and sums that avoid such errors.

use crate::maths::statistics::standard_deviation;

/// Rounding error of a computed value, such as 0.1 + 0.2, in units in the last place of the largest value.
const ULPS: f64 = 8.0;

/// Difference of two of these values that rounding errors explain.
pub(super) fn rounding_error(values: impl Iterator<Item = f64>) -> f64 {
    ULPS * f64::EPSILON * values.fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

/// Sum of squared deviations of these values that rounding errors explain.
pub(super) fn rounding_of_squares(rows: &[Vec<f64>]) -> f64 {
    let n: usize = rows.iter().map(Vec::len).sum();
    let error = rounding_error(rows.iter().flatten().copied());
    n as f64 * error * error
}

/// Standard deviation with divisor `n - 1`; 0 if the values differ by rounding errors only, compared with `magnitudes`,
/// from which they were computed.
pub(super) fn deviation_beyond_rounding(values: &[f64], magnitudes: impl Iterator<Item = f64>) -> f64 {
    let deviation = standard_deviation(values);
    if deviation > rounding_error(magnitudes) { deviation } else { 0.0 }
}

/// Returns the first value and all values minus it. These differences are exact if the values are close to each other,
/// so that a large common offset costs no digits.
pub(super) fn from_first(rows: &[Vec<f64>]) -> (f64, Vec<Vec<f64>>) {
    let first = rows.iter().flatten().next().copied().unwrap_or(0.0);
    (first, rows.iter().map(|row| row.iter().map(|value| value - first).collect()).collect())
}

#[cfg(test)]
mod tests {
    use super::{deviation_beyond_rounding, from_first, rounding_error, rounding_of_squares};

    #[test]
    fn computed_tenths_are_equal_and_neighboring_ratings_are_not() {
        let tenths = [0.1 + 0.2, 0.3, 0.4 - 0.1];
        let rounding = rounding_error(tenths.into_iter());
        assert!((tenths[0] - tenths[1]).abs() < rounding && (tenths[0] - tenths[2]).abs() < rounding);
        assert_eq!(deviation_beyond_rounding(&tenths, tenths.into_iter()), 0.0);
        assert!((deviation_beyond_rounding(&[1.0, 3.0], [3.0].into_iter()) - 2.0_f64.sqrt()).abs() < 1e-12);
        // Ratings in millionths of 1e8 still differ.
        assert!(rounding_error([1e8].into_iter()) < 1e-6);
        assert_eq!(rounding_error(std::iter::empty()), 0.0);
        assert_eq!(rounding_of_squares(&[vec![0.5; 3], vec![-1.0]]), 4.0 * (8.0 * f64::EPSILON).powi(2));
    }

    #[test]
    fn an_offset_leaves_the_differences() {
        let (first, rows) = from_first(&[vec![1e8 + 0.5, 1e8 + 2.0], vec![1e8]]);
        assert_eq!((first, rows), (1e8 + 0.5, vec![vec![0.0, 1.5], vec![-0.5]]));
        assert_eq!(from_first(&[]), (0.0, vec![]));
    }
}
