//! Rows without a valid measurement on an acceleration axis: spikes, stuck, clipped or repeated values.

use crate::recording::axis::Axis;
use crate::recording::clock::{Count, Timeline};
use crate::recording::spike::mark_spikes;
use crate::recording::{Fault, Finding, MIN_RATE_HZ};

/// Minimum duration of a suspicious run of equal values, in seconds and in rows.
const STUCK_SECS: f64 = 0.02;
const STUCK_ROWS: usize = 20;
/// Minimum length of a suspicious run relative to the signal's own long runs; coarse converters repeat values, too.
const STUCK_RUNS: f64 = 4.0;
/// Number of runs below which the signal gives no own reference length.
const FEW_RUNS: usize = 100;
/// Minimum number of rows at the extreme value that count as clipping; one less if the sensor's full scale is known.
const CLIPPED_ROWS: usize = 3;
/// Fraction of the full scale that counts as full scale: the last step of a 12-bit converter.
const FULL_SCALE_SHARE: f64 = 1.0 - 1.0 / 2048.0;
/// Minimum signal range in converter steps for clipping; in a smaller range, equal neighbors are common.
const CLIPPED_STEPS: f64 = 16.0;
/// Minimum jump into and out of a clipped run, in converter steps; a rounded peak has smaller steps.
const CLIPPED_EDGE_STEPS: f64 = 4.0;
/// Ratio of standard deviation to mean of the run lengths, below which values are held by a clock. For random repeats
/// it is near one.
const HELD_SPREAD: f64 = 0.35;
/// Minimum mean run length of held values.
const HELD_ROWS: f64 = 1.5;
/// Force in N and speed in m/s up to which the tip rests; a sensor without input may well be constant.
const REST_FORCE_N: f64 = 0.02;
const REST_SPEED_MPS: f64 = 1e-3;

/// Run of equal values, as indices into the timeline.
struct Run {
    start: usize,
    end: usize,
    value: f64,
}

impl Run {
    fn len(&self) -> usize {
        self.end - self.start
    }
}

/// Marks rows of the timeline as unusable and reports them. `usable` is indexed by place in the timeline; `at_rest`
/// returns whether the tip rests in a row.
pub(super) fn mark_dropouts(
    axis: &Axis<'_>,
    timeline: &Timeline,
    at_rest: impl Fn(usize) -> bool,
    usable: &mut [bool],
    findings: &mut Vec<Finding>,
    faults: &mut Vec<Fault>,
) {
    let column = || axis.column.to_owned();
    let of_rows = axis.values.len();
    let step = converter_step(&runs(axis.values, timeline, &[]));
    let is_spike = mark_spikes(axis, timeline, step, usable, findings);
    // A spike exceeds the clipping level and says nothing about the sensor's range.
    let runs = runs(axis.values, timeline, &is_spike);
    let mut clipped = Count::default();
    let mut clipped_value = 0.0_f64;
    let extremes = extremes(&runs);
    let mut is_clipped = vec![false; runs.len()];
    for (run_idx, run) in runs.iter().enumerate() {
        if is_clipped_run(&runs, run_idx, extremes, step, axis.full_scale_mps2) {
            is_clipped[run_idx] = true;
            clipped_value = if clipped_value == 0.0 { run.value } else { clipped_value };
            usable[run.start..run.end].fill(false);
            timeline.times[run.start..run.end].iter().for_each(|time| clipped.add(*time));
        }
    }
    findings.extend(clipped.found(of_rows).map(|at| Finding::Clipped {
        column: column(),
        at,
        value: clipped_value,
    }));

    let limit = stuck_rows(&runs, timeline.rate_hz);
    let mut stuck = Count::default();
    let long = runs.iter().zip(&is_clipped).filter(|(run, clipped)| run.len() >= limit && !**clipped);
    for (run, _) in long {
        let n_rest = (run.start..run.end).filter(|place| at_rest(timeline.rows[*place])).count();
        if 2 * n_rest < run.len() {
            usable[run.start..run.end].fill(false);
            timeline.times[run.start..run.end].iter().for_each(|time| stuck.add(*time));
        }
    }
    findings.extend(stuck.found(of_rows).map(|at| Finding::Stuck { column: column(), at }));

    if let Some(n_rows) = held_rows(&runs, limit) {
        let true_rate_hz = timeline.rate_hz / n_rows;
        findings.push(Finding::Held { column: column(), n_rows, true_rate_hz });
        if true_rate_hz < MIN_RATE_HZ && timeline.rate_hz >= MIN_RATE_HZ {
            faults.push(Fault::RateTooLow { rate_hz: true_rate_hz });
        }
    }
}

/// Returns a fault if all axes of acceleration are constant; their unit does not matter.
pub fn check_signal(axes: &[Vec<f64>]) -> Option<Fault> {
    let values: Option<Vec<f64>> = axes.iter().map(|axis| dead_value(axis.iter().copied())).collect();
    let values = values.filter(|values| !values.is_empty())?;
    Some(Fault::NoSignal { is_zero: values.iter().all(|value| *value == 0.0) })
}

/// Value of a constant axis; missing values are ignored.
pub(super) fn dead_value(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut finite = values.filter(|value| value.is_finite());
    let (first, second) = (finite.next()?, finite.next()?);
    (first == second && finite.all(|value| value == first)).then_some(first)
}

/// Runs of equal finite values; NaN and places in `is_left_out` belong to no run.
fn runs(values: &[f64], timeline: &Timeline, is_left_out: &[bool]) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (place, row) in timeline.rows.iter().enumerate() {
        let value = values[*row];
        if !value.is_finite() || is_left_out.get(place) == Some(&true) {
            continue;
        }
        match runs.last_mut() {
            Some(run) if run.value == value && run.end == place => run.end += 1,
            _ => runs.push(Run { start: place, end: place + 1, value }),
        }
    }
    runs
}

/// Smallest difference between two values that occur.
fn converter_step(runs: &[Run]) -> f64 {
    let mut values: Vec<f64> = runs.iter().map(|run| run.value).collect();
    values.sort_by(f64::total_cmp);
    values.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > 0.0).fold(f64::INFINITY, f64::min)
}

fn extremes(runs: &[Run]) -> [f64; 2] {
    runs.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], run| {
        [low.min(run.value), high.max(run.value)]
    })
}

/// Whether a run is the clipped top of a wave.
fn is_clipped_run(
    runs: &[Run],
    run_idx: usize,
    [low, high]: [f64; 2],
    step: f64,
    full_scale: Option<f64>,
) -> bool {
    let run = &runs[run_idx];
    let at_full_scale = full_scale.is_some_and(|scale| run.value.abs() >= FULL_SCALE_SHARE * scale);
    if at_full_scale {
        return run.len() + 1 >= CLIPPED_ROWS;
    }
    if run.len() < CLIPPED_ROWS
        || (run.value != low && run.value != high)
        || high - low < CLIPPED_STEPS * step
    {
        return false;
    }
    let edge = |other: Option<&Run>| other.map_or(0.0, |other| (other.value - run.value).abs());
    let before = run_idx.checked_sub(1).and_then(|idx| runs.get(idx));
    edge(before) + edge(runs.get(run_idx + 1)) >= CLIPPED_EDGE_STEPS * step
}

/// Minimum length of a suspicious run in this signal, in rows.
fn stuck_rows(runs: &[Run], rate_hz: f64) -> usize {
    let mut lengths: Vec<usize> = runs.iter().map(Run::len).collect();
    lengths.sort_unstable();
    let usual = if lengths.len() < FEW_RUNS { 1 } else { lengths[lengths.len() * 99 / 100] };
    let limit = (STUCK_SECS * rate_hz).max(STUCK_RUNS * usual as f64);
    (limit.ceil() as usize).max(STUCK_ROWS)
}

/// Mean run length if values are held by a clock.
fn held_rows(runs: &[Run], limit: usize) -> Option<f64> {
    // The first and the last run are cut off, and stuck runs say nothing about the clock.
    let inner = runs.get(1..runs.len().saturating_sub(1))?;
    let lengths: Vec<f64> = inner.iter().map(|run| run.len() as f64).filter(|n| *n < limit as f64).collect();
    if lengths.len() < FEW_RUNS / 2 {
        return None;
    }
    let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
    let variance = lengths.iter().map(|n| (n - mean).powi(2)).sum::<f64>() / lengths.len() as f64;
    (mean >= HELD_ROWS && variance.sqrt() <= HELD_SPREAD * mean).then_some(mean)
}

/// Whether the tip rests at this speed and force, as far as they are measured.
pub(super) fn is_rest(speed_mps: Option<f64>, force_n: Option<f64>) -> bool {
    speed_mps.is_some_and(|speed| speed.abs() <= REST_SPEED_MPS)
        || force_n.is_some_and(|force| force.abs() <= REST_FORCE_N)
}
