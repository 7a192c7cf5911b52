//! Gap-free segments of rows, and their samples on the regular clock.

use std::ops::Range;

use crate::recording::clock::Timeline;
use crate::recording::resample::{SIDE_ROWS, interpolate_line, interpolate_local};
use crate::recording::{Fault, Finding};

/// Minimum duration of a segment, in seconds: one cycle at 50 Hz.
const FRAGMENT_SECS: f64 = 0.02;
/// A recording may have at most [`SAMPLES_PER_ROW`] × rows + [`MORE_SAMPLES`] samples, gaps included. Otherwise its
/// timestamps are wrong.
const SAMPLES_PER_ROW: usize = 3;
const MORE_SAMPLES: usize = 1_000_000;

/// Gap-free segment of rows, and its samples.
pub(super) struct Stretch {
    /// Indices into the timeline.
    pub(super) places: Range<usize>,
    /// Samples of the regular clock.
    pub(super) samples: Range<usize>,
}

/// Returns the gap-free segments of at least [`FRAGMENT_SECS`] with their samples, and the length of the recording in
/// samples, gaps included; `None` if the timestamps are wrong.
pub(super) fn lay_out(
    timeline: &Timeline,
    usable: &[bool],
    n_rows: usize,
    findings: &mut Vec<Finding>,
    faults: &mut Vec<Fault>,
) -> Option<(Vec<Stretch>, usize)> {
    let Timeline { rate_hz, times, .. } = timeline;
    let limit = SAMPLES_PER_ROW * n_rows + MORE_SAMPLES;
    let seconds = times[times.len() - 1];
    if seconds * rate_hz > limit as f64 {
        let reason = format!("{n_rows} rows at {rate_hz:.1} Hz cannot last {seconds:.0} s");
        faults.push(Fault::BadClock { reason });
        return None;
    }
    let mut stretches: Vec<Stretch> = Vec::new();
    let mut next_free = 0;
    let (mut n_fragments, mut fragment_samples) = (0, 0);
    let mut start = 0;
    while start < times.len() {
        if !usable[start] {
            start += 1;
            continue;
        }
        let mut end = start + 1;
        while end < times.len() && usable[end] && times[end] - times[end - 1] <= timeline.gap_secs {
            end += 1;
        }
        let samples = samples_of(timeline, start..end, next_free);
        if (samples.len() as f64) < FRAGMENT_SECS * rate_hz {
            n_fragments += 1;
            fragment_samples += end - start;
        } else {
            // One sample remains between neighboring segments, so that two never look like one.
            next_free = samples.end + 1;
            stretches.push(Stretch { places: start..end, samples });
        }
        start = end;
    }
    if n_fragments > 0 {
        let seconds = fragment_samples as f64 / rate_hz;
        findings.push(Finding::Fragments { n: n_fragments, seconds });
    }
    let n_samples = stretches.last().map_or(0, |stretch| stretch.samples.end);
    Some((stretches, n_samples))
}

/// Samples of gap-free rows, starting at `next_free` or later.
fn samples_of(timeline: &Timeline, places: Range<usize>, next_free: usize) -> Range<usize> {
    let place_of = |place: usize| timeline.times[place] * timeline.rate_hz;
    if timeline.regular {
        let first = (place_of(places.start).round() as usize).max(next_free);
        return first..first + places.len();
    }
    if places.len() < 2 * SIDE_ROWS {
        return next_free..next_free;
    }
    // From the row with enough rows before it to the row with enough rows after it.
    let first = (place_of(places.start + SIDE_ROWS - 1).ceil() as usize).max(next_free);
    let last = place_of(places.end - SIDE_ROWS).floor() as usize;
    first..(last + 1).max(first)
}

/// Acceleration column at the samples of a segment, by polynomial interpolation; unchanged on a regular clock.
pub(super) fn fast(values: &[f64], timeline: &Timeline, stretch: &Stretch) -> Vec<f64> {
    on_samples(values, timeline, stretch, interpolate_local)
}

/// Speed, position or force column at the samples of a segment, by linear interpolation; unchanged on a regular clock.
pub(super) fn slow(values: &[f64], timeline: &Timeline, stretch: &Stretch) -> Vec<f64> {
    on_samples(values, timeline, stretch, interpolate_line)
}

fn on_samples(
    values: &[f64],
    timeline: &Timeline,
    stretch: &Stretch,
    interpolate: impl Fn(&[f64], &[f64], usize, f64) -> f64,
) -> Vec<f64> {
    let values: Vec<f64> = timeline.rows[stretch.places.clone()].iter().map(|row| values[*row]).collect();
    if timeline.regular {
        return values;
    }
    let times = &timeline.times[stretch.places.clone()];
    let mut after = 0;
    let at = |sample: usize| {
        let time = sample as f64 / timeline.rate_hz;
        while after < times.len() && times[after] <= time {
            after += 1;
        }
        // Rounding errors at the ends must not leave the rows.
        interpolate(times, &values, after.clamp(SIDE_ROWS, times.len() - SIDE_ROWS), time)
    };
    stretch.samples.clone().map(at).collect()
}
