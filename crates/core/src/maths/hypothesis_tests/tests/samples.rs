use serde_json::Value;

use super::{cases, cells, check, check_t, check_unit, name, number, vectors};
use crate::maths::hypothesis_tests::intervals::{Confidence, mean_interval};
use crate::maths::hypothesis_tests::shapiro_wilk::{ShapiroWilkError, shapiro_wilk};
use crate::maths::hypothesis_tests::t_tests::one_sample_t;
use crate::maths::rng::lcg_noise;

/// Values of a case without missing ones, or portable noise of a stated number and seed.
fn values(case: &Value) -> Vec<f64> {
    if case["values"].is_array() {
        return cells(&case["values"]).into_iter().flatten().collect();
    }
    let [n, seed] = [0, 1].map(|i| case["lcg"][i].as_u64().unwrap());
    lcg_noise(n as usize, seed)
}

#[test]
fn normality_is_tested_as_by_scipy() {
    let vectors = vectors();
    for case in cases(&vectors, "samples") {
        match shapiro_wilk(&values(case)) {
            Ok(test) => {
                check(test.w, &case["shapiro"][0], name(case));
                check(test.p_value, &case["shapiro"][1], name(case));
            }
            Err(error) => {
                assert!(case["shapiro"].is_null(), "{}", name(case));
                let is_expected = matches!(error, ShapiroWilkError::Equal | ShapiroWilkError::Size { n: 2 });
                assert!(is_expected, "{}: {error}", name(case));
            }
        }
    }
}

#[test]
fn means_are_tested_as_by_scipy() {
    let vectors = vectors();
    for case in cases(&vectors, "samples") {
        let expected = &case["t_test"];
        let mean = number(&case["expected_mean"]);
        let test = one_sample_t(&values(case), mean, Confidence::NINETY_FIVE).unwrap();
        check_t(&test, expected, "d", name(case));
    }
}

#[test]
fn intervals_of_means_are_those_of_statsmodels() {
    let vectors = vectors();
    for case in cases(&vectors, "samples") {
        let confidence = Confidence::new(number(&case["confidence"])).unwrap();
        let interval = mean_interval(&values(case), confidence).unwrap().interval;
        let spread = number(&case["spread"]);
        check_unit(interval.low, &case["interval"][0], spread, name(case));
        check_unit(interval.high, &case["interval"][1], spread, name(case));
    }
}
