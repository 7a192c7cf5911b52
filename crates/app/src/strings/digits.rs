//! Numbers as text.

/// Number of significant digits.
const N_DIGITS: i32 = 3;
/// Magnitude below which a number is shown as 0.
const LEAST: f64 = 5e-4;

/// Number with three significant digits.
pub fn three_digits(value: f64) -> String {
    if !value.is_finite() {
        return value.to_string();
    }
    if value.abs() < LEAST {
        return "0".to_owned();
    }
    let exponent = |value: f64| value.abs().log10().floor() as i32;
    let step = 10.0_f64.powi(exponent(value) + 1 - N_DIGITS);
    // Rounded first: 9.996 becomes 10.0, which has one decimal.
    let rounded = (value / step).round() * step;
    let decimals = (N_DIGITS - 1 - exponent(rounded)).max(0) as usize;
    format!("{rounded:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::three_digits;

    #[test]
    fn numbers_have_three_significant_digits() {
        for (value, text) in [
            (481.038, "481"),
            (12_345.0, "12300"),
            (999.6, "1000"),
            (9.996, "10.0"),
            (2.0, "2.00"),
            (-1.2345, "-1.23"),
            (0.099_96, "0.100"),
            (0.012_34, "0.0123"),
            (-1e-9, "0"),
            (0.0, "0"),
        ] {
            assert_eq!(three_digits(value), text, "{value}");
        }
    }
}
