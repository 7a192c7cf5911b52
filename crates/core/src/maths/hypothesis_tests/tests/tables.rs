use serde_json::Value;

use super::groups::check_tukey;
use super::{cases, cells, check, check_interval, check_t, check_unit, name, number, numbers, vectors};
use crate::maths::hypothesis_tests::friedman::{friedman, friedman_pairs};
use crate::maths::hypothesis_tests::intervals::Confidence;
use crate::maths::hypothesis_tests::repeated_measures::{SphericityCorrection, repeated_measures};
use crate::maths::hypothesis_tests::subject_table::SubjectTable;
use crate::maths::hypothesis_tests::t_tests::paired_t;
use crate::maths::hypothesis_tests::tukey::tukey_hsd_repeated;

/// Table of a case, spread of its values, and confidence level.
fn read(case: &Value) -> (SubjectTable, f64, Confidence) {
    let rows: Vec<Vec<Option<f64>>> = case["values"].as_array().unwrap().iter().map(cells).collect();
    let confidence = Confidence::new(number(&case["confidence"])).unwrap();
    (SubjectTable::new(&rows).unwrap(), number(&case["spread"]), confidence)
}

fn check_correction(correction: Option<SphericityCorrection>, expected: &Value, what: &str) {
    // Undefined numbers of these tables are not written.
    let Some(correction) = correction else {
        assert!(expected.is_null(), "{what}");
        return;
    };
    check(correction.epsilon, &expected[0], what);
    check(correction.p_value, &expected[1], what);
}

#[test]
fn repeated_measures_are_analyzed_as_by_statsmodels_and_pingouin() {
    let vectors = vectors();
    for case in cases(&vectors, "tables") {
        let (table, spread, _) = read(case);
        let (anova, expected) = (repeated_measures(&table), &case["repeated_measures"]);
        assert_eq!(anova.n_left_out as u64, case["n_left_out"].as_u64().unwrap(), "{}", name(case));
        let squares = [
            (anova.squares_conditions, "conditions"),
            (anova.squares_subjects, "subjects"),
            (anova.squares_error, "error"),
        ];
        for (got, key) in squares {
            check_unit(got, &expected["squares"][key], spread * spread, name(case));
        }
        assert_eq!(anova.dof.map(|dof| dof as f64).to_vec(), numbers(&expected["dof"]), "{}", name(case));
        let Some(test) = anova.test else {
            assert!(expected["f"].is_null(), "{}", name(case));
            continue;
        };
        check(test.f_test.f, &expected["f"], name(case));
        if test.f_test.f.is_infinite() {
            assert_eq!(test.f_test.p_value, 0.0);
            assert_eq!((test.greenhouse_geisser, test.huynh_feldt), (None, None), "{}", name(case));
            continue;
        }
        check(test.f_test.p_value, &expected["p"], name(case));
        check(test.partial_eta_squared, &expected["partial_eta_squared"], name(case));
        check(test.generalized_eta_squared, &expected["generalized_eta_squared"], name(case));
        check_correction(test.greenhouse_geisser, &expected["greenhouse_geisser"], name(case));
        check_correction(test.huynh_feldt, &expected["huynh_feldt"], name(case));
    }
}

#[test]
fn ranks_are_compared_as_by_scipy() {
    let vectors = vectors();
    for case in cases(&vectors, "tables") {
        let (table, ..) = read(case);
        let (found, expected) = (friedman(&table), &case["friedman"]);
        let Some(test) = found.test else {
            assert!(expected.is_null(), "{}", name(case));
            continue;
        };
        check(test.chi_squared, &expected["chi_squared"], name(case));
        check(test.p_value, &expected["p"], name(case));
        check(test.kendalls_w, &expected["kendalls_w"], name(case));
    }
}

#[test]
fn pairs_of_conditions_are_compared_as_by_scipy_and_statsmodels() {
    let vectors = vectors();
    for case in cases(&vectors, "tables") {
        let (table, ..) = read(case);
        let rows = case["post_hoc"].as_array().unwrap();
        let pairs = friedman_pairs(&table);
        assert_eq!(pairs.len(), rows.len(), "{}", name(case));
        for (pair, row) in pairs.iter().zip(rows) {
            assert_eq!(pair.conditions.map(|index| index as u64), [0, 1].map(|i| row[i].as_u64().unwrap()));
            match pair.signed_rank {
                Some(test) => {
                    check(test.positive.min(test.negative), &row[2], name(case));
                    check(test.p_value, &row[3], name(case));
                }
                None => assert!(row[2].is_null(), "{}", name(case)),
            }
            check(pair.adjusted_p_value, &row[4], name(case));
        }
    }
}

#[test]
fn pairs_of_means_are_compared_with_the_distribution_of_scipy() {
    let vectors = vectors();
    for case in cases(&vectors, "tables") {
        let (table, spread, confidence) = read(case);
        check_tukey(tukey_hsd_repeated(&table, confidence).as_ref(), &case["tukey"], spread, name(case));
    }
}

#[test]
fn pairs_of_answers_are_compared_as_by_scipy() {
    let vectors = vectors();
    for case in cases(&vectors, "tables") {
        let (table, spread, confidence) = read(case);
        let (found, expected) = (paired_t(&table, [0, 1], confidence), &case["paired"]);
        check_t(&found.test, expected, "d_z", name(case));
        check_interval(&found.test, expected, spread, name(case));
        if found.test.effect.is_some() {
            check(found.cohens_d.unwrap(), &expected["cohens_d"], name(case));
        }
    }
}
