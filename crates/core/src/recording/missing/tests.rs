use super::{fill, fill_slower, mark_missing};
use crate::recording::bounds::{FORCE, MOST};
use crate::recording::clock::{Timeline, read_clock};
use crate::recording::{Finding, RawClock};
use crate::units::Hertz;
use proptest::prelude::{prop, prop_assert, proptest};

fn timeline(n_rows: usize) -> Timeline {
    read_clock(RawClock::Rate(Hertz(1000.0)), n_rows, &mut Vec::new(), &mut Vec::new()).expect("a clock")
}

/// Ramp with values only in the rows selected by `is_there`.
fn ramp(n_rows: usize, is_there: impl Fn(usize) -> bool) -> Vec<f64> {
    (0..n_rows).map(|row| if is_there(row) { 0.5 + 1e-3 * row as f64 } else { f64::NAN }).collect()
}

/// Interpolates a ramp and checks the rate, the number of missing values and that all values lie on the ramp.
#[track_caller]
fn check(
    n_rows: usize,
    is_there: impl Fn(usize) -> bool,
    rate_hz: Option<f64>,
    n_missing: usize,
) -> Vec<f64> {
    let mut values = ramp(n_rows, is_there);
    let found = fill(&mut values, &timeline(n_rows));
    let near = |a: f64, b: f64| (a / b - 1.0).abs() < 0.02;
    assert!(found == rate_hz || found.zip(rate_hz).is_some_and(|(a, b)| near(a, b)), "{found:?}");
    assert_eq!(values.iter().filter(|value| value.is_nan()).count(), n_missing);
    for (row, value) in values.iter().enumerate().filter(|(_, value)| !value.is_nan()) {
        assert!((value - (0.5 + 1e-3 * row as f64)).abs() < 1e-12, "row {row} is {value}");
    }
    values
}

#[test]
fn what_lies_between_values_of_a_slower_sensor_is_on_lines() {
    check(1001, |row| row % 10 == 0, Some(100.0), 0);
    check(1000, |row| row % 10 == 3, Some(100.0), 3 + 6);
    // 90 Hz on a clock of 1000 Hz: a value in every eleventh or twelfth row.
    check(1000, |row| (row * 90) % 1000 < 90, Some(90.0), 10);
    check(1000, |row| row % 22 < 1 || row % 22 == 2, Some(1000.0 / 11.0), 7);
    check(1000, |row| row % 40 == 0, Some(25.0), 39);
}

#[test]
fn what_was_lost_is_not_made_up() {
    check(1000, |_| true, None, 0);
    // Three of every ten values are lost.
    check(1000, |row| row % 10 < 7, None, 300);
    check(1000, |row| row < 500, None, 500);
    check(1000, |row| row % 50 == 0, None, 980);
    check(1000, |row| row == 7, None, 999);
    check(1000, |_| false, None, 1000);
    // A gap of 0.1 s in values at 100 Hz.
    let values = check(1001, |row| row % 10 == 0 && !(301..400).contains(&row), Some(100.0), 99);
    assert!(
        values[300].is_finite() && values[301].is_nan() && values[399].is_nan() && values[400].is_finite()
    );
    // A single lost value is within the allowed number of steps.
    check(1001, |row| row % 10 == 0 && row != 300, Some(100.0), 0);
}

#[test]
fn what_cannot_be_is_said_and_never_filled() {
    let mut values = ramp(101, |row| row % 10 == 0);
    (values[15], values[25], values[50]) = (f64::INFINITY, -2.0 * MOST, 1e308);
    let (clock, mut findings, mut usable) = (timeline(101), Vec::new(), vec![true; 101]);
    fill_slower("force", std::slice::from_mut(&mut values), &clock, &mut findings);
    mark_missing("force", &FORCE, &[&values], &clock, &mut usable, &mut findings);
    assert_eq!(
        findings.iter().map(Finding::name).collect::<Vec<_>>(),
        ["slower track", "not a number", "impossible values"]
    );
    assert_eq!((0..101).filter(|row| !usable[*row]).collect::<Vec<_>>(), [15, 25, 50]);
    let sentence = findings[0].to_string();
    assert!(sentence.contains("force") && sentence.contains("Hz"), "{sentence}");
}

proptest! {
    #[test]
    fn values_that_are_there_stay_and_what_is_filled_lies_between_them(
        cells in prop::collection::vec(prop::option::weighted(0.2, -5.0..5.0_f64), 2..300),
    ) {
        let before: Vec<f64> = cells.iter().map(|cell| cell.unwrap_or(f64::NAN)).collect();
        let mut after = before.clone();
        fill(&mut after, &timeline(before.len()));
        let mut known = (0..before.len()).filter(|row| before[*row].is_finite());
        let (first, last) = (known.next(), known.next_back());
        for (row, value) in after.iter().enumerate().filter(|(_, value)| !value.is_nan()) {
            if before[row].is_finite() {
                prop_assert!(*value == before[row]);
            } else {
                prop_assert!(first.is_some_and(|first| first < row) && last.is_some_and(|last| row < last));
                let left = before[..row].iter().rfind(|value| value.is_finite()).copied().unwrap_or(f64::NAN);
                let right = before[row..].iter().find(|value| value.is_finite()).copied().unwrap_or(f64::NAN);
                prop_assert!((left.min(right) - 1e-12..=left.max(right) + 1e-12).contains(value));
            }
        }
    }
}
