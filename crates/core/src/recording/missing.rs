//! Missing and impossible values, and linear interpolation of columns from slower sensors.

use crate::dsp::spectrum::median;
use crate::recording::Finding;
use crate::recording::bounds::{Bound, MOST};
use crate::recording::clock::{Count, Timeline};

/// Rows between values from which on a sensor counts as slower than the file rather than as losing values.
const SLOW_ROWS: f64 = 1.5;
/// Lowest sensor rate in Hz at which linear interpolation follows hand motion.
const SLOWEST_HZ: f64 = 25.0;
/// Number of sensor steps between two values above which the interval is a gap.
const GAP_STEPS: f64 = 3.0;

/// Marks rows in which one of `columns` has no finite value, or one beyond `bound`.
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

/// Interpolates linearly between the values of slower sensors, whose columns are empty (NaN) in the rows between. Rows
/// before the first value, after the last value and in gaps stay empty.
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

/// Interpolates one column; returns the sensor's rate if it is slower than the file and fast enough to interpolate.
fn fill(values: &mut [f64], timeline: &Timeline) -> Option<f64> {
    let Timeline { rate_hz, rows, times, .. } = timeline;
    let known: Vec<usize> = (0..rows.len()).filter(|place| values[rows[*place]].abs() <= MOST).collect();
    if known.len() == rows.len() {
        return None;
    }
    let steps: Vec<f64> = known.windows(2).map(|pair| times[pair[1]] - times[pair[0]]).collect();
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    // Steps can be irregular, so that the median says little about the long ones.
    let upper_secs = sorted.get(3 * sorted.len() / 4).copied()?;
    let longest_secs = GAP_STEPS * upper_secs.min(SLOWEST_HZ.recip());
    let (sum, n) = steps
        .iter()
        .filter(|step| **step <= longest_secs)
        .fold((0.0, 0.0), |(sum, n), step| (sum + step, n + 1.0));
    let usual_secs: f64 = sum / n;
    // A median step of one row means a sensor as fast as the file, whose missing values are lost. The mean would
    // include a few long steps.
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
            // Infinite or impossible values are not empty.
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
