//! How many digits of a number a library keeps, and the rounding to them.

/// Significant digits of levels and labels in a file, far finer than any measurement.
pub(crate) const DIGITS: usize = 6;

/// Significant digits of speeds, forces and rates: removes only the rounding errors of unit conversion.
pub(crate) const CONVERSION_DIGITS: usize = 12;

/// Decimals of line spectral frequencies and positions in a file.
const DECIMALS: usize = 6;

/// Distance in rad below which line spectral frequencies are written in full. Rounding them would change the narrow
/// resonance between them by more than a thousandth, and the minimum gap that a model needs.
const CLOSE_RAD: f64 = 1e-3;

/// Rounds frequencies to [`DECIMALS`]; returns them in full if two, or one and an end of the range, are closer than
/// [`CLOSE_RAD`].
pub(crate) fn frequencies(lsf: &[f64]) -> Vec<f64> {
    let ends = [0.0, std::f64::consts::PI];
    let above = ends[..1].iter().chain(lsf).zip(lsf.iter().chain(&ends[1..]));
    let is_close = above.into_iter().any(|(low, high)| high - low < CLOSE_RAD);
    if is_close { lsf.to_vec() } else { lsf.iter().map(|w| decimals(*w)).collect() }
}

/// Rounds to [`DECIMALS`] decimals. Rounding through text gives the value that prints shortest.
pub(super) fn decimals(value: f64) -> f64 {
    format!("{value:.DECIMALS$}").parse().unwrap_or(value)
}

/// Rounds to `n` significant digits.
pub(crate) fn digits(value: f64, n: usize) -> f64 {
    let after_point = n - 1;
    format!("{value:.after_point$e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::{DIGITS, decimals, digits, frequencies};

    #[test]
    fn rounds_as_text_does() {
        assert_eq!(decimals(0.123_456_49), 0.123_456);
        assert_eq!(digits(0.000_123_456_789, DIGITS), 0.000_123_457);
        assert_eq!(digits(0.0, DIGITS), 0.0);
        assert_eq!(digits(30.000_000_000_000_004, 12), 30.0);
    }

    #[test]
    fn close_frequencies_stay_apart() {
        let close = [1e-8, 0.5, 0.5 + 1e-8, 3.0];
        assert_eq!(frequencies(&close), close);
        assert_eq!(frequencies(&[0.500_000_04, 0.6]), [0.5, 0.6]);
    }
}
