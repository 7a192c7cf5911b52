//! Values that are not there, or cannot be: between those of a slower sensor, and elsewhere.

use crate::recording::Finding;
use crate::recording::clock::{Count, Timeline};
use crate::spectrum::median;
use crate::texture::{FORCES_N, LEVELS_MPS2, SPEEDS_MPS};

/// Largest magnitude, in any SI unit, that is a number between which others can lie.
const MOST: f64 = 1e9;
/// Rows a step, from which on a sensor is slower than the file and not one that lost values.
const SLOW_ROWS: f64 = 1.5;
/// Slowest sensor, in Hz, between whose values straight lines say what a hand did.
const SLOWEST_HZ: f64 = 25.0;
/// A time between two values that is longer than so many steps of their sensor is a gap.
const GAP_STEPS: f64 = 3.0;

/// The largest magnitude that a quantity can have.
pub(super) struct Bound {
    /// In `unit`.
    pub(super) most: f64,
    /// The SI unit.
    pub(super) unit: &'static str,
}

/// Above these a model cannot be rendered.
pub(super) const ACCELERATION: Bound = Bound { most: *LEVELS_MPS2.end(), unit: "m/s²" };
pub(super) const SPEED: Bound = Bound { most: *SPEEDS_MPS.end(), unit: "m/s" };
pub(super) const FORCE: Bound = Bound { most: *FORCES_N.end(), unit: "N" };
pub(super) const POSITION: Bound = Bound { most: MOST, unit: "m" };

/// Marks rows where one of `columns` has no finite number, or one beyond `bound`.
pub(super) fn mark_missing(
    name: &str,
    bound: &Bound,
    columns: &[&[f64]],
    timeline: &Timeline,
    usable: &mut [bool],
    findings: &mut Vec<Finding>,
) {
    let (mut missing, mut impossible) = (Count::default(), Count::default());
    for ((row, time), usable) in timeline.rows.iter().zip(&timeline.times).zip(usable) {
        if columns.iter().any(|values| !values[*row].is_finite()) {
            missing.add(*time);
            *usable = false;
        } else if columns.iter().any(|values| values[*row].abs() > bound.most) {
            impossible.add(*time);
            *usable = false;
        }
    }
    let at = missing.found(timeline.rows.len());
    findings.extend(at.map(|at| Finding::NotANumber { column: name.to_owned(), at }));
    let at = impossible.found(timeline.rows.len());
    findings.extend(at.map(|at| Finding::Impossible {
        column: name.to_owned(),
        at,
        most: bound.most,
        unit: bound.unit,
    }));
}

/// Puts straight lines between the values of sensors that were slower than the file, which left the rows between empty
/// (NaN). Rows before the first value, behind the last and in gaps stay empty.
pub(super) fn fill_slower(
    name: &str,
    columns: &mut [Vec<f64>],
    timeline: &Timeline,
    findings: &mut Vec<Finding>,
) {
    let mut slowest_hz: Option<f64> = None;
    for values in columns {
        if let Some(rate_hz) = fill(values, timeline) {
            slowest_hz = Some(slowest_hz.map_or(rate_hz, |slowest| slowest.min(rate_hz)));
        }
    }
    findings.extend(slowest_hz.map(|rate_hz| Finding::SlowerTrack { column: name.to_owned(), rate_hz }));
}

/// Fills one column; gives the rate of its sensor where that is slower than the file and fast enough.
fn fill(values: &mut [f64], timeline: &Timeline) -> Option<f64> {
    let Timeline { rate_hz, rows, times, .. } = timeline;
    let known: Vec<usize> = (0..rows.len()).filter(|place| values[rows[*place]].abs() <= MOST).collect();
    if known.len() == rows.len() {
        return None;
    }
    let steps: Vec<f64> = known.windows(2).map(|pair| times[pair[1]] - times[pair[0]]).collect();
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    // Steps may well be uneven, so the middle one says little of the long ones.
    let upper_secs = sorted.get(3 * sorted.len() / 4).copied()?;
    let longest_secs = GAP_STEPS * upper_secs.min(SLOWEST_HZ.recip());
    let (sum, n) = steps
        .iter()
        .filter(|step| **step <= longest_secs)
        .fold((0.0, 0.0), |(sum, n), step| (sum + step, n + 1.0));
    let usual_secs: f64 = sum / n;
    // Steps of one row are those of a sensor as fast as the file: what it lacks is lost. The mean counts a few long ones.
    if median(steps) * rate_hz <= SLOW_ROWS || usual_secs.is_nan() || usual_secs * SLOWEST_HZ > 1.0 + 1e-9 {
        return None;
    }
    for pair in known.windows(2) {
        let (before, after) = (pair[0], pair[1]);
        let step_secs = times[after] - times[before];
        if step_secs > GAP_STEPS * usual_secs {
            continue;
        }
        let (from, to) = (values[rows[before]], values[rows[after]]);
        for place in before + 1..after {
            // Infinite or impossible is not empty.
            if values[rows[place]].is_nan() {
                let share = (times[place] - times[before]) / step_secs;
                values[rows[place]] = from + share * (to - from);
            }
        }
    }
    Some(usual_secs.recip())
}

#[cfg(test)]
mod tests;
