//! Clock of a recording: the times of its rows.

use crate::dsp::spectrum::median;
use crate::recording::{Fault, Finding, MAX_RATE_HZ, MIN_RATE_HZ, RawClock, Where};

/// Number of usual sampling intervals above which an interval is a gap.
const GAP_STEPS: f64 = 1.5;
/// Maximum relative deviation of a regular sampling interval. It keeps the error of a sine at the highest frequency of
/// a model, two fifths of the rate, below 5 %.
const REGULAR_SHARE: f64 = 0.02;
/// Share of rows with repeated or backward timestamps, or of gaps, above which the timestamps are not a clock.
const BAD_SHARE: f64 = 0.05;
/// Median relative deviation of the sampling intervals above which the timestamps are not a clock.
const BAD_JITTER_SHARE: f64 = 0.5;
/// Rounding of the timestamps, relative to the sampling interval, above which rows cannot be distinguished.
const COARSE_SHARE: f64 = 0.25;
/// Relative change of the rate over the recording above which drift is reported.
const DRIFT_SHARE: f64 = 1e-3;
/// Relative change of the rate over the recording above which the columns are resampled.
const DRIFT_RESAMPLED_SHARE: f64 = 0.01;
/// Relative distance to an integer in Hz below which a rate is rounded to it; the rest is rounding of the timestamps.
const WHOLE_RATE_SHARE: f64 = 1e-6;

/// Rows in order of time.
pub(super) struct Timeline {
    /// Sample rate in Hz.
    pub(super) rate_hz: f64,
    /// Indices of the rows in use, ascending.
    pub(super) rows: Vec<usize>,
    /// Times of these rows in seconds from the first, strictly ascending.
    pub(super) times: Vec<f64>,
    /// Whether the rows are samples of a regular clock without resampling.
    pub(super) regular: bool,
    /// Interval in seconds above which there is a gap.
    pub(super) gap_secs: f64,
}

/// Checks a clock without its columns; returns findings, and faults that prevent its use.
pub fn check_clock(clock: &RawClock) -> (Vec<Finding>, Vec<Fault>) {
    let n_rows = if let RawClock::Times(times) = clock { times.len() } else { usize::MAX };
    let (mut findings, mut faults) = (Vec::new(), Vec::new());
    match clock {
        RawClock::Rate(rate) => check_rate(rate.0, &mut faults),
        RawClock::Times(times) => {
            read_times(times, n_rows, &mut findings, &mut faults);
        }
    }
    (findings, faults)
}

/// Timeline of `n_rows` rows; `None` if the clock is unusable.
pub(super) fn read_clock(
    clock: RawClock,
    n_rows: usize,
    findings: &mut Vec<Finding>,
    faults: &mut Vec<Fault>,
) -> Option<Timeline> {
    match clock {
        RawClock::Rate(rate) => {
            check_rate(rate.0, faults);
            let usual = rate.0.is_finite() && rate.0 > 0.0;
            usual.then(|| Timeline {
                rate_hz: rate.0,
                rows: (0..n_rows).collect(),
                times: (0..n_rows).map(|row| row as f64 / rate.0).collect(),
                regular: true,
                gap_secs: GAP_STEPS / rate.0,
            })
        }
        RawClock::Times(times) => read_times(&times, n_rows, findings, faults),
    }
}

fn check_rate(rate_hz: f64, faults: &mut Vec<Fault>) {
    if rate_hz < MIN_RATE_HZ {
        faults.push(Fault::RateTooLow { rate_hz });
    } else if rate_hz.is_nan() || rate_hz > MAX_RATE_HZ {
        faults.push(Fault::RateTooHigh { rate_hz });
    }
}

/// Counts affected rows and keeps the time of the first.
#[derive(Default)]
pub(super) struct Count {
    n_rows: usize,
    first_secs: Option<f64>,
}

impl Count {
    pub(super) fn add(&mut self, secs: f64) {
        self.n_rows += 1;
        self.first_secs.get_or_insert(secs);
    }

    /// Extent of the affected rows, or `None` if there are none.
    pub(super) fn found(&self, of_rows: usize) -> Option<Where> {
        self.first_secs.map(|first_secs| Where { n_rows: self.n_rows, of_rows, first_secs })
    }
}

fn read_times(
    written: &[f64],
    n_rows: usize,
    findings: &mut Vec<Finding>,
    faults: &mut Vec<Fault>,
) -> Option<Timeline> {
    let Some(start) = written.iter().copied().find(|time| time.is_finite()) else {
        if !written.is_empty() {
            faults.push(Fault::BadClock { reason: "no timestamp is a number".to_owned() });
        }
        return None;
    };
    let (mut rows, mut times) = (Vec::with_capacity(written.len()), Vec::with_capacity(written.len()));
    let (mut missing, mut repeated, mut backward) = (Count::default(), Count::default(), Count::default());
    let mut last = f64::NEG_INFINITY;
    for (row, time) in written.iter().map(|time| time - start).enumerate().take(n_rows) {
        if !time.is_finite() {
            missing.add(last.max(0.0));
        } else if time == last {
            repeated.add(time);
        } else if time < last {
            backward.add(time);
        } else {
            rows.push(row);
            times.push(time);
            last = time;
        }
    }
    let of_rows = written.len();
    let missing = missing.found(of_rows).map(|at| Finding::NotANumber { column: "time".to_owned(), at });
    let (repeated, backward) = (repeated.found(of_rows), backward.found(of_rows));
    findings.extend(missing);
    findings.extend(repeated.map(Finding::RepeatedTimes));
    findings.extend(backward.map(Finding::BackwardTimes));
    if times.len() < 2 {
        faults.push(Fault::TooFewRows { n_rows: times.len() });
        return None;
    }

    let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let usual_secs = usual_step(&steps);
    let gap_secs = GAP_STEPS * usual_secs;
    let rate_hz = whole_where_near(1.0 / usual_secs);
    if let Some(reason) = bad_clock(&steps, usual_secs, of_rows, repeated, backward) {
        let hint = if written_to(&times) > COARSE_SHARE * usual_secs {
            ", the timestamps are rounded too coarsely"
        } else {
            ""
        };
        let mean_rate_hz = steps.len() as f64 / times[times.len() - 1];
        let reason = format!("{reason}{hint}, {mean_rate_hz:.1} rows per second on average");
        faults.push(Fault::BadClock { reason });
        return None;
    }
    check_rate(rate_hz, faults);

    let mut gaps = Count::default();
    let mut longest_secs = 0.0_f64;
    for (step, time) in steps.iter().zip(&times[1..]).filter(|(step, _)| **step > gap_secs) {
        gaps.add(*time);
        longest_secs = longest_secs.max(*step);
    }
    findings.extend(gaps.found(of_rows).map(|at| Finding::Gaps { at, longest_secs }));

    let drift = drift(&steps, gap_secs);
    if drift.abs() > DRIFT_SHARE {
        findings.push(Finding::Drift { share: drift });
    }
    let tolerance_secs = (REGULAR_SHARE * usual_secs).max(1.01 * written_to(&times));
    let inner = || steps.iter().filter(|step| **step <= gap_secs).map(|step| (step - usual_secs).abs());
    let regular = inner().all(|off| off <= tolerance_secs) && drift.abs() <= DRIFT_RESAMPLED_SHARE;
    if !regular {
        let mut shares: Vec<f64> = inner().map(|off| off / usual_secs).collect();
        shares.sort_by(f64::total_cmp);
        let share = shares[(shares.len() - 1) * 95 / 100];
        findings.push(Finding::Jitter { share, rate_hz });
    }
    Some(Timeline { rate_hz, rows, times, regular, gap_secs })
}

/// Mean of the intervals that are not gaps. The median alone would be a multiple of the timestamps' rounding.
fn usual_step(steps: &[f64]) -> f64 {
    let limit = GAP_STEPS * median(steps.to_vec());
    let (sum, n) =
        steps.iter().filter(|step| **step <= limit).fold((0.0, 0.0), |(sum, n), step| (sum + step, n + 1.0));
    sum / n
}

fn whole_where_near(rate_hz: f64) -> f64 {
    let whole = rate_hz.round();
    if (rate_hz - whole).abs() <= WHOLE_RATE_SHARE * rate_hz { whole } else { rate_hz }
}

/// Reason why the timestamps are not a clock, if any.
fn bad_clock(
    steps: &[f64],
    usual_secs: f64,
    of_rows: usize,
    repeated: Option<Where>,
    backward: Option<Where>,
) -> Option<String> {
    let percent = |n: usize, of: usize| 100.0 * n as f64 / of as f64;
    let off_order = repeated.map_or(0, |at| at.n_rows) + backward.map_or(0, |at| at.n_rows);
    if off_order as f64 > BAD_SHARE * of_rows as f64 {
        let share = percent(off_order, of_rows);
        return Some(format!("{share:.0} % of the rows repeat a timestamp or go back in time"));
    }
    let n_gaps = steps.iter().filter(|step| **step > GAP_STEPS * usual_secs).count();
    // A single gap in a short recording is allowed.
    if n_gaps > 1 && n_gaps as f64 > BAD_SHARE * steps.len() as f64 {
        let (share, millis) = (percent(n_gaps, steps.len()), 1e3 * usual_secs);
        return Some(format!(
            "sampling intervals are too irregular: {share:.0} % of them are gaps, the others {millis:.3} ms"
        ));
    }
    let jitter_secs = median(steps.iter().map(|step| (step - usual_secs).abs()).collect());
    (jitter_secs > BAD_JITTER_SHARE * usual_secs).then(|| {
        let share = 100.0 * jitter_secs / usual_secs;
        format!("half of the sampling intervals deviate by more than {share:.0} %")
    })
}

/// Rounding unit of the timestamps in seconds: the largest power of ten that divides all of them; 0 below 0.1 µs.
fn written_to(times: &[f64]) -> f64 {
    let powers = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7];
    let whole = |power: f64| {
        times.iter().all(|time| {
            let scaled = time * power;
            (scaled - scaled.round()).abs() < 0.02
        })
    };
    powers.into_iter().find(|power| whole(*power)).map_or(0.0, f64::recip)
}

/// Relative change of the mean interval from the first to the last quarter of the recording.
fn drift(steps: &[f64], gap_secs: f64) -> f64 {
    let quarter = steps.len() / 4;
    let mean = |part: &[f64]| {
        let inner: Vec<f64> = part.iter().copied().filter(|step| *step <= gap_secs).collect();
        inner.iter().sum::<f64>() / inner.len() as f64
    };
    // With fewer intervals, rounding of the timestamps is as large as a drift.
    if quarter < 1000 {
        return 0.0;
    }
    let (first, last) = (mean(&steps[..quarter]), mean(&steps[steps.len() - quarter..]));
    if first > 0.0 && last > 0.0 { last / first - 1.0 } else { 0.0 }
}
