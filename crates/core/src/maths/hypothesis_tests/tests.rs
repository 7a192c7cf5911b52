//! Comparison of all tests with scipy, statsmodels and pingouin on saved data sets (`vectors/statistics`).

use serde_json::Value;

use super::t_tests::TTest;

mod distributions;
mod groups;
mod samples;
mod tables;

/// Relative tolerance, and absolute tolerance of numbers below 1: a hundred times the rounding error of the references
/// for data with a large offset, which is about 1e-8.
const TOLERANCE: f64 = 1e-6;

fn vectors() -> Value {
    serde_json::from_str(include_str!("../../../../../vectors/statistics/statistics.json")).unwrap()
}

fn cases<'a>(vectors: &'a Value, kind: &str) -> &'a Vec<Value> {
    vectors[kind].as_array().unwrap()
}

/// A number of the references, which may be infinite.
fn number(value: &Value) -> f64 {
    match value.as_str() {
        Some("infinite") => f64::INFINITY,
        Some("minus infinite") => f64::NEG_INFINITY,
        _ => value.as_f64().unwrap(),
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

/// Cells of the data, `None` where one is missing.
fn cells(value: &Value) -> Vec<Option<f64>> {
    value.as_array().unwrap().iter().map(Value::as_f64).collect()
}

fn name(case: &Value) -> &str {
    case["name"].as_str().unwrap()
}

/// Whether a number is that of the reference within the tolerance.
fn is_near(got: f64, expected: f64, tolerance: f64) -> bool {
    got == expected || (got - expected).abs() <= tolerance
}

/// Compares a number without a unit.
fn check(got: f64, expected: &Value, what: &str) {
    let expected = number(expected);
    let tolerance = TOLERANCE * expected.abs().max(1.0);
    assert!(is_near(got, expected, tolerance), "{what}: got {got}, expected {expected}");
}

/// Compares a t test; `d` is the name of its standardized difference.
fn check_t(test: &TTest, expected: &Value, d: &str, what: &str) {
    check(test.dof, &expected["dof"], what);
    match test.ratio {
        Some(ratio) => {
            check(ratio.t, &expected["t"], what);
            check(ratio.p_value, &expected["p"], what);
        }
        None => assert!(expected["t"].is_null() && expected["p"].is_null(), "{what}"),
    }
    match test.effect {
        Some(effect) => {
            check(effect.d, &expected[d], what);
            check(effect.hedges_g, &expected["hedges_g"], what);
        }
        None => assert!(expected[d].is_null(), "{what}"),
    }
}

/// Compares the interval of a t test of two means.
fn check_interval(test: &TTest, expected: &Value, spread: f64, what: &str) {
    check_unit(test.interval.low, &expected["low"], spread, what);
    check_unit(test.interval.high, &expected["high"], spread, what);
}

/// Compares a number in the unit of the values, or a power of it. Its tolerance is relative to their `spread`, to the
/// same power: tiny values are not compared with 1, and large offsets not with their size.
fn check_unit(got: f64, expected: &Value, spread: f64, what: &str) {
    let expected = number(expected);
    let rounding = 8.0 * f64::EPSILON * expected.abs();
    let tolerance = (TOLERANCE * spread.min(expected.abs().max(1.0))).max(rounding);
    assert!(is_near(got, expected, tolerance), "{what}: got {got}, expected {expected}, spread {spread}");
}

#[test]
fn there_are_more_than_fifty_data_sets_of_every_kind() {
    let vectors = vectors();
    let n_cases = ["groups", "tables", "samples"].map(|kind| cases(&vectors, kind).len());
    assert!(n_cases.iter().sum::<usize>() >= 50 && n_cases.iter().all(|n| *n > 10), "{n_cases:?}");
}

/// Negative control: a number that is off by little more than the tolerance is found.
#[test]
fn a_wrong_number_is_found() {
    let expected = [0.0, 1e-9, 0.5, 7.0, 1e5];
    for expected in expected {
        let tolerance = TOLERANCE * f64::max(expected, 1.0);
        assert!(is_near(expected + 0.9 * tolerance, expected, tolerance));
        assert!(!is_near(expected + 1.1 * tolerance, expected, tolerance));
        assert!(!is_near(f64::NAN, expected, tolerance) && !is_near(f64::INFINITY, expected, tolerance));
    }
    assert!(is_near(f64::INFINITY, f64::INFINITY, 1.0) && !is_near(f64::INFINITY, f64::NEG_INFINITY, 1.0));
    let off = std::panic::catch_unwind(|| check_unit(1.0e-9, &Value::from(1.1e-9), 1e-9, "tiny"));
    assert!(off.is_err(), "tiny values are compared with their spread");
}
