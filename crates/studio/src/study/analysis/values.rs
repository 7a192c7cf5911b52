//! Numbers and names of a report: JSON of intervals, words for probabilities, file names.

use serde_json::{Value, json};
use shagreen_core::maths::hypothesis_tests::intervals::Interval;
use shagreen_formats::library::id_from_name;

/// An interval as JSON: its two ends.
pub(super) fn interval(interval: Interval) -> Value {
    json!([interval.low, interval.high])
}

/// A probability in words: `p = 0.034`, `p < 0.001`.
pub(super) fn probability(p: f64) -> String {
    if p < 0.001 { "p < 0.001".to_owned() } else { format!("p = {p:.3}") }
}

/// A statistic in words: two decimals; infinite if the error is zero.
pub(super) fn statistic(value: f64) -> String {
    if value.is_finite() { format!("{value:.2}") } else { "infinite".to_owned() }
}

/// Name of the file of a figure, without its ending: number of the part, its identifier, and the name of the figure.
pub(super) fn file_name(part_number: usize, part: &str, name: &str) -> String {
    format!("{part_number}-{}-{}", id_from_name(part), id_from_name(name))
}

#[cfg(test)]
mod tests {
    use super::{file_name, probability, statistic};

    #[test]
    fn names_of_files_are_plain() {
        assert_eq!(file_name(1, "../A", "rough-smooth means"), "1-a-rough-smooth-means");
    }

    #[test]
    fn small_probabilities_have_a_limit() {
        assert_eq!([probability(0.034_2), probability(2e-9)], ["p = 0.034", "p < 0.001"]);
        assert_eq!([statistic(2.0), statistic(f64::INFINITY)], ["2.00", "infinite"]);
    }
}
