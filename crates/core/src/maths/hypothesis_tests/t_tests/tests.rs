use proptest::prelude::{prop, prop_assert, proptest};

use super::{TTestError, one_sample_t, paired_t, welch_t};
use crate::maths::hypothesis_tests::intervals::{Confidence, mean_interval};
use crate::maths::hypothesis_tests::subject_table::SubjectTable;

const LEVEL: Confidence = Confidence::NINETY_FIVE;

fn pairs_table(pairs: &[[f64; 2]]) -> SubjectTable {
    SubjectTable::complete(&pairs.iter().map(|pair| pair.to_vec()).collect::<Vec<Vec<f64>>>())
}

#[test]
fn two_values_have_the_closed_form() {
    // Mean 3 and standard error 1: t is 3 with one degree of freedom, whose tails are 1 - 2 atan(t) / π.
    let test = one_sample_t(&[2.0, 4.0], 0.0, LEVEL).unwrap();
    let ratio = test.ratio.unwrap();
    assert!((ratio.t - 3.0).abs() < 1e-12 && (test.standard_error - 1.0).abs() < 1e-12, "{test:?}");
    assert!((ratio.p_value - (1.0 - 2.0 / std::f64::consts::PI * 3.0_f64.atan())).abs() < 1e-12);
    let effect = test.effect.unwrap();
    assert!((effect.d - 3.0 / 2.0_f64.sqrt()).abs() < 1e-12 && effect.hedges_g.abs() < 1e-12, "{effect:?}");
}

#[test]
fn equal_values_have_an_infinite_or_no_t() {
    let equal = one_sample_t(&[0.3, 0.1 + 0.2, 0.3], 0.3, LEVEL).unwrap();
    assert_eq!((equal.ratio, equal.effect, equal.difference), (None, None, 0.0));
    let off = one_sample_t(&[0.1; 4], 0.3, LEVEL).unwrap();
    assert_eq!(off.ratio.map(|ratio| (ratio.t, ratio.p_value)), Some((f64::NEG_INFINITY, 0.0)));
    assert!((off.interval.low + 0.2).abs() < 1e-12 && off.interval.low == off.interval.high);
    let groups = welch_t(&[2.0; 3], &[1.0; 5], LEVEL).unwrap();
    assert_eq!((groups.ratio.map(|ratio| ratio.t), groups.dof), (Some(f64::INFINITY), 1.0));
    assert_eq!(welch_t(&[2.0; 3], &[2.0; 5], LEVEL).unwrap().ratio, None);
    let paired = paired_t(&pairs_table(&[[0.4, 0.3], [0.3, 0.2], [0.8, 0.7]]), [0, 1], LEVEL);
    assert_eq!(paired.test.ratio.map(|ratio| ratio.t), Some(f64::INFINITY));
    assert_eq!(paired.test.effect, None);
    // The variances 0.07 of both conditions remain.
    assert!((paired.cohens_d.unwrap() - 0.1 / 0.07_f64.sqrt()).abs() < 1e-12, "{paired:?}");
}

#[test]
fn samples_without_a_test_are_refused() {
    let error = |values: &[f64], expected: f64| one_sample_t(values, expected, LEVEL).unwrap_err();
    assert_eq!(error(&[1.0], 0.0), TTestError::TooFew { sample: 0, n: 1 });
    assert_eq!(error(&[1.0, f64::NAN], 0.0), TTestError::NotFinite { sample: 0, index: 1 });
    assert_eq!(error(&[1.0, 2.0], f64::INFINITY), TTestError::Expected);
    assert_eq!(welch_t(&[1.0, 2.0], &[], LEVEL).unwrap_err(), TTestError::TooFew { sample: 1, n: 0 });
}

proptest! {
    /// A paired test is a test of the differences, and its interval ends where the hypothesis is just rejected.
    #[test]
    fn pairs_are_a_sample_of_differences(
        pairs in prop::collection::vec(prop::array::uniform2(-9.0..9.0_f64), 2..20),
    ) {
        let differences: Vec<f64> = pairs.iter().map(|[a, b]| a - b).collect();
        let paired = paired_t(&pairs_table(&pairs), [0, 1], LEVEL).test;
        let single = one_sample_t(&differences, 0.0, LEVEL).unwrap();
        let (a, b) = (paired.ratio.unwrap(), single.ratio.unwrap());
        prop_assert!((a.t - b.t).abs() < 1e-9 * (1.0 + b.t.abs()) && (a.p_value - b.p_value).abs() < 1e-9);
        let interval = mean_interval(&differences, LEVEL).unwrap().interval;
        prop_assert!((paired.interval.low - interval.low).abs() < 1e-9 * (1.0 + interval.low.abs()));
        let at_end = one_sample_t(&differences, interval.high, LEVEL).unwrap().ratio.unwrap();
        prop_assert!((at_end.p_value - 0.05).abs() < 1e-7, "{at_end:?}");
        let swapped = paired_t(&pairs_table(&pairs), [1, 0], LEVEL).test;
        prop_assert!(swapped.difference == -paired.difference);
    }

    /// The test of Welch does not depend on unit and offset, and changes its sign with the order of the groups.
    #[test]
    fn welch_does_not_depend_on_unit_and_offset(
        a in prop::collection::vec(-1.0..1.0_f64, 2..15),
        b in prop::collection::vec(-1.0..1.0_f64, 2..15),
        shift in -100.0..100.0_f64,
        factor in 0.01..100.0_f64,
    ) {
        let plain = welch_t(&a, &b, LEVEL).unwrap();
        let changed = |values: &[f64]| -> Vec<f64> { values.iter().map(|v| factor * (v + shift)).collect() };
        let other = welch_t(&changed(&b), &changed(&a), LEVEL).unwrap();
        // Values up to a hundred times their spread lose two of sixteen digits.
        let (t, negative) = (plain.ratio.unwrap().t, other.ratio.unwrap().t);
        prop_assert!((t + negative).abs() < 1e-8 * (1.0 + t.abs()), "{t} {negative}");
        prop_assert!((plain.dof - other.dof).abs() < 1e-7 * plain.dof);
        let smaller = a.len().min(b.len()) as f64 - 1.0;
        let total = (a.len() + b.len()) as f64 - 2.0;
        prop_assert!((smaller - 1e-9..=total + 1e-9).contains(&plain.dof), "{plain:?}");
        prop_assert!((plain.effect.unwrap().d + other.effect.unwrap().d).abs() < 1e-8 * (1.0 + t.abs()));
    }
}
