use serde_json::Value;

use super::{cases, cells, check, check_interval, check_t, check_unit, name, number, vectors};
use crate::maths::hypothesis_tests::f_test::FTest;
use crate::maths::hypothesis_tests::groups::Groups;
use crate::maths::hypothesis_tests::intervals::Confidence;
use crate::maths::hypothesis_tests::levene::{Center, levene};
use crate::maths::hypothesis_tests::one_way::one_way;
use crate::maths::hypothesis_tests::t_tests::welch_t;
use crate::maths::hypothesis_tests::tukey::{TukeyHsd, tukey_hsd};

/// Groups of a case without their missing cells, spread of its values, and confidence level.
fn read(case: &Value) -> (Groups, f64, Confidence) {
    let values = case["values"].as_array().unwrap();
    let groups: Vec<Vec<f64>> =
        values.iter().map(|group| cells(group).into_iter().flatten().collect()).collect();
    let confidence = Confidence::new(number(&case["confidence"])).unwrap();
    (Groups::new(groups).unwrap(), number(&case["spread"]), confidence)
}

#[test]
fn one_way_analyses_are_those_of_scipy() {
    let vectors = vectors();
    for case in cases(&vectors, "groups") {
        let (groups, spread, _) = read(case);
        let (anova, expected) = (one_way(&groups), &case["one_way"]);
        check_unit(anova.squares_between, &expected["between"], spread * spread, name(case));
        check_unit(anova.squares_within, &expected["within"], spread * spread, name(case));
        assert_eq!(
            anova.dof.map(|dof| Value::from(dof as u64)).to_vec(),
            *expected["dof"].as_array().unwrap()
        );
        let Some(test) = anova.test else {
            assert!(expected["f"].is_null() && expected["p"].is_null(), "{}", name(case));
            continue;
        };
        check(test.f_test.f, &expected["f"], name(case));
        check(test.f_test.p_value, &expected["p"], name(case));
        check(test.eta_squared, &expected["eta_squared"], name(case));
        check(test.omega_squared, &expected["omega_squared"], name(case));
    }
}

fn check_levene(test: Option<FTest>, expected: &Value, what: &str) {
    let Some(test) = test else {
        assert!(expected.is_null(), "{what}");
        return;
    };
    check(test.f, &expected["f"], what);
    check(test.p_value, &expected["p"], what);
}

#[test]
fn variances_are_compared_as_by_scipy() {
    let vectors = vectors();
    for case in cases(&vectors, "groups") {
        let (groups, _, _) = read(case);
        check_levene(levene(&groups, Center::Mean), &case["levene_mean"], name(case));
        check_levene(levene(&groups, Center::Median), &case["levene_median"], name(case));
    }
}

/// Compares pairs of means with rows of indices, difference, lower end, upper end and probability.
pub(super) fn check_tukey(found: Option<&TukeyHsd>, expected: &Value, spread: f64, what: &str) {
    let Some(found) = found else {
        assert!(expected.is_null(), "{what}");
        return;
    };
    let rows = expected.as_array().unwrap();
    assert_eq!(found.pairs.len(), rows.len(), "{what}");
    for (pair, row) in found.pairs.iter().zip(rows) {
        assert_eq!(pair.means.map(|index| index as u64), [0, 1].map(|i| row[i].as_u64().unwrap()), "{what}");
        check_unit(pair.difference, &row[2], spread, what);
        check_unit(pair.interval.low, &row[3], spread, what);
        check_unit(pair.interval.high, &row[4], spread, what);
        check(pair.p_value, &row[5], what);
    }
}

#[test]
fn pairs_of_means_are_compared_as_by_scipy() {
    let vectors = vectors();
    for case in cases(&vectors, "groups") {
        let (groups, spread, confidence) = read(case);
        check_tukey(tukey_hsd(&groups, confidence).as_ref(), &case["tukey"], spread, name(case));
    }
}

#[test]
fn two_groups_are_compared_as_by_scipy() {
    let vectors = vectors();
    for case in cases(&vectors, "groups") {
        let (groups, spread, confidence) = read(case);
        let (test, expected) =
            (welch_t(&groups.values()[0], &groups.values()[1], confidence), &case["welch"]);
        let Ok(test) = test else {
            assert!(expected.is_null(), "{}", name(case));
            continue;
        };
        check_t(&test, expected, "cohens_d", name(case));
        check_interval(&test, expected, spread, name(case));
    }
}
