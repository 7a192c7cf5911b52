use proptest::prelude::{prop, prop_assert, proptest};

use super::{RepeatedMeasures, RepeatedMeasuresTest, repeated_measures};
use crate::maths::hypothesis_tests::intervals::Confidence;
use crate::maths::hypothesis_tests::subject_table::SubjectTable;
use crate::maths::hypothesis_tests::t_tests::paired_t;

fn analyzed(rows: &[Vec<f64>]) -> (RepeatedMeasures, RepeatedMeasuresTest) {
    let result = repeated_measures(&SubjectTable::complete(rows));
    let test = result.test.unwrap();
    (result, test)
}

#[test]
fn a_small_table_has_the_sums_of_squares_by_hand() {
    // Subject means 2, 3, 4; condition means 2, 3, 4; residuals 0, 0, 0; 0, 1, -1; 0, -1, 1.
    let rows = [vec![1.0, 2.0, 3.0], vec![2.0, 4.0, 3.0], vec![3.0, 3.0, 6.0]];
    let (result, test) = analyzed(&rows);
    let squares = [result.squares_conditions, result.squares_subjects, result.squares_error];
    for (got, expected) in squares.iter().zip([6.0, 6.0, 4.0]) {
        assert!((got - expected).abs() < 1e-12, "{squares:?}");
    }
    assert_eq!((result.dof, result.n_subjects, result.n_left_out), ([2, 4], 3, 0));
    assert!((test.f_test.f - 3.0).abs() < 1e-12);
    assert!((test.partial_eta_squared - 0.6).abs() < 1e-12);
    assert!((test.generalized_eta_squared - 0.375).abs() < 1e-12);
    // The residuals have rank one, the farthest from sphericity.
    let epsilon = test.greenhouse_geisser.unwrap().epsilon;
    assert!((epsilon - 0.5).abs() < 1e-12, "{epsilon}");
    // With epsilon 1/2, the degrees of freedom are 1 and 2, where F is the square of t: P = 1 - t / sqrt(2 + t²).
    let p = test.greenhouse_geisser.unwrap().p_value;
    assert!((p - (1.0 - (3.0_f64 / 5.0).sqrt())).abs() < 1e-12, "{p}");
    // (3 · 1 - 2) / (2 (3 - 1 - 1)).
    let epsilon = test.huynh_feldt.unwrap().epsilon;
    assert!((epsilon - 0.5).abs() < 1e-12, "{epsilon}");
}

#[test]
fn an_error_of_zero_gives_an_infinite_or_no_ratio() {
    let additive: Vec<Vec<f64>> = [0.1, 0.4, 0.2].iter().map(|s| vec![*s, s + 0.1, s + 0.3]).collect();
    let (_, test) = analyzed(&additive);
    assert_eq!((test.f_test.f, test.f_test.p_value), (f64::INFINITY, 0.0));
    assert_eq!((test.greenhouse_geisser, test.huynh_feldt), (None, None));
    assert!((test.partial_eta_squared - 1.0).abs() < 1e-12);
    let constant: Vec<Vec<f64>> = [0.1, 0.4, 0.2].iter().map(|s| vec![*s; 4]).collect();
    assert_eq!(repeated_measures(&SubjectTable::complete(&constant)).test, None);
    assert_eq!(repeated_measures(&SubjectTable::complete(&[vec![0.1; 3], vec![0.1; 3]])).test, None);
}

#[test]
fn two_subjects_have_the_lower_bound_and_no_huynh_feldt() {
    let (_, test) = analyzed(&[vec![1.0, 3.0, 2.0, 7.0], vec![2.0, 2.5, 4.0, 5.0]]);
    assert!((test.greenhouse_geisser.unwrap().epsilon - 1.0 / 3.0).abs() < 1e-12);
    assert_eq!(test.huynh_feldt, None);
}

proptest! {
    /// Under two conditions, F is the square of the paired t, and no correction is needed.
    #[test]
    fn f_of_two_conditions_is_the_paired_t_squared(
        pairs in prop::collection::vec((-50.0..50.0_f64, -50.0..50.0_f64), 3..15),
    ) {
        let rows: Vec<Vec<f64>> = pairs.iter().map(|(a, b)| vec![*a, *b]).collect();
        let (_, test) = analyzed(&rows);
        let t = paired_t(&SubjectTable::complete(&rows), [0, 1], Confidence::NINETY_FIVE).test.ratio.unwrap();
        prop_assert!((test.f_test.f - t.t * t.t).abs() < 1e-8 * (1.0 + test.f_test.f), "{test:?} {t:?}");
        prop_assert!((test.f_test.p_value - t.p_value).abs() < 1e-9);
        prop_assert!((test.greenhouse_geisser.unwrap().epsilon - 1.0).abs() < 1e-12);
        prop_assert!(test.huynh_feldt.unwrap().epsilon == 1.0);
    }

    /// Neither a factor, nor an offset of a subject, nor the order of conditions or subjects changes the test.
    #[test]
    fn the_test_does_not_depend_on_unit_subject_offsets_or_order(
        rows in prop::collection::vec(prop::collection::vec(-1.0..1.0_f64, 4), 3..9),
        factor in 0.01..100.0_f64,
    ) {
        let (_, test) = analyzed(&rows);
        let mut other: Vec<Vec<f64>> = rows
            .iter()
            .enumerate()
            .map(|(i, row)| row.iter().rev().map(|x| factor * (x + 10.0 * i as f64)).collect())
            .collect();
        other.reverse();
        let (_, changed) = analyzed(&other);
        // Values up to a hundred times their spread lose two of sixteen digits.
        prop_assert!((test.f_test.f - changed.f_test.f).abs() < 1e-8 * (1.0 + test.f_test.f));
        prop_assert!((test.partial_eta_squared - changed.partial_eta_squared).abs() < 1e-8);
        let epsilon = |test: RepeatedMeasuresTest| {
            [test.greenhouse_geisser, test.huynh_feldt].map(|correction| correction.unwrap().epsilon)
        };
        let ([gg, hf], [other_gg, other_hf]) = (epsilon(test), epsilon(changed));
        prop_assert!((gg - other_gg).abs() < 1e-8 && (1.0 / 3.0..=1.0).contains(&gg), "{gg} {other_gg}");
        prop_assert!(hf >= gg - 1e-12 && (hf - other_hf).abs() < 1e-6, "{hf} {other_hf}");
    }
}
