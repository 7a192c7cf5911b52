//! Parsers of quantities on the command line: finite numbers that are not negative.

use shagreen_core::texture::{FORCES_N, SPEEDS_MPS};

/// Parses a finite number of at least 0.
pub(crate) fn quantity(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() && value >= 0.0 => Ok(value),
        _ => Err("it must be a number, 0 or greater".to_owned()),
    }
}

/// Parses a quantity within a range; `unit` completes the error message, as in "0.8 to 60 seconds".
pub(crate) fn within(text: &str, range: &std::ops::RangeInclusive<f64>, unit: &str) -> Result<f64, String> {
    let value = quantity(text)?;
    if range.contains(&value) {
        Ok(value)
    } else {
        Err(format!("it must be {} to {} {unit}", range.start(), range.end()))
    }
}

/// Parses a tip speed in mm/s, up to the highest that a texture model may have.
pub(crate) fn speed(text: &str) -> Result<f64, String> {
    within(text, &(0.0..=1e3 * *SPEEDS_MPS.end()), "mm/s")
}

/// Parses a normal force in N, up to the highest that a texture model may have.
pub(crate) fn force(text: &str) -> Result<f64, String> {
    within(text, &(0.0..=*FORCES_N.end()), "N")
}

/// Returns a parser of a count within a range.
pub(crate) fn count(
    range: std::ops::RangeInclusive<usize>,
) -> impl Fn(&str) -> Result<usize, String> + Clone + Send + Sync {
    move |text| match text.parse::<usize>() {
        Ok(value) if range.contains(&value) => Ok(value),
        _ => Err(format!("it must be a whole number from {} to {}", range.start(), range.end())),
    }
}

/// Parses a quantity above 0.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    let value = quantity(text)?;
    if value > 0.0 { Ok(value) } else { Err("it must be above 0".to_owned()) }
}
