//! When the rows of a recording were really taken.

use crate::recording::{Fault, Finding, MAX_RATE_HZ, MIN_RATE_HZ, RawClock, Where};
use crate::spectrum::median;

/// A step longer than this many usual ones is a gap: a row is missing.
const GAP_STEPS: f64 = 1.5;
/// Steps that differ from the usual one by no more than this share are regular: the sine of highest frequency that a
/// model keeps, two fifths of the rate, is then right within 5 %.
const REGULAR_SHARE: f64 = 0.02;
/// Above this share of rows with a repeated or backward time, or of gaps, the timestamps are no clock.
const BAD_SHARE: f64 = 0.05;
/// Above this share of a step, half of the steps are no steps.
const BAD_JITTER_SHARE: f64 = 0.5;
/// Times that are rounded to more than this share of a step cannot tell rows apart.
const COARSE_SHARE: f64 = 0.25;
/// A change of the rate over the recording that is worth a word.
const DRIFT_SHARE: f64 = 1e-3;
/// A change of the rate over the recording that is resampled away.
const DRIFT_RESAMPLED_SHARE: f64 = 0.01;
/// A rate nearer to a whole number of Hz than this share is that number: what is left is rounding of the times.
const WHOLE_RATE_SHARE: f64 = 1e-6;

/// Rows in the order of time.
pub(super) struct Timeline {
    /// Samples a second.
    pub(super) rate_hz: f64,
    /// Rows that are kept, ascending.
    pub(super) rows: Vec<usize>,
    /// Their times in seconds from the first, strictly ascending.
    pub(super) times: Vec<f64>,
    /// Whether the rows are samples of the regular clock as they are.
    pub(super) regular: bool,
    /// A step longer than this, in seconds, is a gap.
    pub(super) gap_secs: f64,
}

/// What is found in a clock without the columns that it is for: what it is, what is wrong with it, and whether a
/// recording can be made by it.
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

/// The timeline of `n_rows` rows; none where there is no clock in it.
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

/// How many rows something concerns, and where it was first.
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

    /// Nothing where nothing was counted.
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
            faults.push(Fault::BadClock { reason: "no time is a number".to_owned() });
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
            ", the times are rounded too much"
        } else {
            ""
        };
        let mean_rate_hz = steps.len() as f64 / times[times.len() - 1];
        let reason = format!("{reason}{hint}, {mean_rate_hz:.1} rows a second in all");
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

/// Mean of the steps that are no gaps. The median alone would be a multiple of what the times are rounded to.
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

/// What makes times no clock.
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
        return Some(format!("{share:.0} % of the rows have the time of the row before or an earlier one"));
    }
    let n_gaps = steps.iter().filter(|step| **step > GAP_STEPS * usual_secs).count();
    // One gap in a short recording is a gap.
    if n_gaps > 1 && n_gaps as f64 > BAD_SHARE * steps.len() as f64 {
        let (share, millis) = (percent(n_gaps, steps.len()), 1e3 * usual_secs);
        return Some(format!(
            "steps differ too much, {share:.0} % of them are gaps, the others {millis:.3} ms"
        ));
    }
    let jitter_secs = median(steps.iter().map(|step| (step - usual_secs).abs()).collect());
    (jitter_secs > BAD_JITTER_SHARE * usual_secs).then(|| {
        let share = 100.0 * jitter_secs / usual_secs;
        format!("half of the steps are off by more than {share:.0} %")
    })
}

/// What the times are rounded to, in seconds: the largest power of ten that they are multiples of; 0 below 0.1 µs.
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

/// Change of the usual step from the first to the last quarter of the recording, as a share of it.
fn drift(steps: &[f64], gap_secs: f64) -> f64 {
    let quarter = steps.len() / 4;
    let mean = |part: &[f64]| {
        let inner: Vec<f64> = part.iter().copied().filter(|step| *step <= gap_secs).collect();
        inner.iter().sum::<f64>() / inner.len() as f64
    };
    // Below this the noise of rounded times is as large as a drift.
    if quarter < 1000 {
        return 0.0;
    }
    let (first, last) = (mean(&steps[..quarter]), mean(&steps[steps.len() - quarter..]));
    if first > 0.0 && last > 0.0 { last / first - 1.0 } else { 0.0 }
}
