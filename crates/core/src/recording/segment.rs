//! Stationary segmentation: segments of a recording with nearly constant tip speed and force.
//!
//! Blocks of [`BLOCK_SECS`] are merged bottom-up, the most similar first, while speed and force stay within
//! [`SPEED_TOLERANCE`] and [`FORCE_TOLERANCE`] of the middle of their range in the union.

use std::ops::Range;

use crate::dsp::spectrum::median;
use crate::recording::Recording;
use crate::units::{MetersPerSecond, Newtons};

/// Duration of the initial blocks, in seconds.
pub const BLOCK_SECS: f64 = 0.05;

/// Maximum duration of a segment in seconds; more and shorter segments resolve changes of the texture better.
pub const MAX_SECS: f64 = 1.0;

/// Minimum tip speed of a stroke.
pub const MIN_SPEED: MetersPerSecond = MetersPerSecond(0.010);

/// Minimum force that counts as contact; sensors drift by about as much.
pub const MIN_FORCE: Newtons = Newtons(0.05);

/// Maximum deviation of the speed in a segment from the middle of its range, relative to that middle. The limit is a
/// quarter because back-and-forth strokes stay within 10 % for only a third of the time, and hardly ever at low speed.
/// [`crate::recording::fit`] models the change of the texture within a segment sample by sample.
pub const SPEED_TOLERANCE: f64 = 0.25;

/// Minimum tolerance of the speed, at any speed, in m/s.
const SPEED_TOLERANCE_MPS: f64 = 0.010;

/// Maximum deviation of the force in a segment from the middle of its range, relative to that middle. The level depends
/// on force half as much as on speed.
pub const FORCE_TOLERANCE: f64 = 0.15;

/// Minimum tolerance of the force, at any force, in N.
const FORCE_TOLERANCE_N: f64 = 0.05;

/// Cutoff of the low-pass filter for speed and force, in Hz; hand motion is slower, and sensors are noisy above.
const TRACK_BAND_HZ: f64 = 20.0;

/// Stationary segment, with nearly constant speed and force.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    /// Sample range in the recording.
    pub samples: Range<usize>,
    /// Median tip speed.
    pub speed: MetersPerSecond,
    /// Median normal force.
    pub force: Newtons,
}

/// Result of the segmentation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Segmentation {
    /// Stationary segments, in order.
    pub stretches: Vec<Stretch>,
    /// Usable seconds with the tip lifted.
    pub lifted_secs: f64,
    /// Seconds in contact but slower than [`MIN_SPEED`].
    pub slow_secs: f64,
    /// Seconds of strokes whose speed or force changes too fast, or whose segments are too short.
    pub changing_secs: f64,
    /// Highest tip speed in contact.
    pub fastest: MetersPerSecond,
    /// Highest normal force.
    pub strongest: Newtons,
}

/// Range of a quantity.
#[derive(Clone, Copy)]
struct Span {
    low: f64,
    high: f64,
}

/// Segment under construction.
#[derive(Clone)]
struct Piece {
    samples: Range<usize>,
    speed: Span,
    force: Span,
}

/// Stationary segments of at least `min_secs` in the usable part of a recording.
pub fn segment(recording: &Recording, min_secs: f64) -> Segmentation {
    let rate_hz = recording.rate.0;
    let n_block = ((BLOCK_SECS * rate_hz).round() as usize).max(1);
    let mut found = Segmentation::default();
    for usable in &recording.usable {
        let speed = smoothed(&recording.speed_mps[usable.clone()], rate_hz);
        let force = smoothed(&recording.force_n[usable.clone()], rate_hz);
        let mut run: Vec<Piece> = Vec::new();
        for start in (0..usable.len()).step_by(n_block) {
            let samples = start..(start + n_block).min(usable.len());
            let piece =
                Piece { speed: span(&speed[samples.clone()]), force: span(&force[samples.clone()]), samples };
            let secs = piece.samples.len() as f64 / rate_hz;
            found.strongest.0 = found.strongest.0.max(piece.force.high);
            let lifted = piece.force.low < MIN_FORCE.0;
            if !lifted {
                found.fastest.0 = found.fastest.0.max(piece.speed.high);
            }
            let slow = piece.speed.low < MIN_SPEED.0;
            let changing = spread(&piece) > 1.0;
            if lifted {
                found.lifted_secs += secs;
            } else if slow {
                found.slow_secs += secs;
            } else if changing {
                found.changing_secs += secs;
            }
            if lifted || slow || changing {
                close(&mut run, &speed, &force, (usable.start, rate_hz, min_secs), &mut found);
            } else {
                run.push(piece);
            }
        }
        close(&mut run, &speed, &force, (usable.start, rate_hz, min_secs), &mut found);
    }
    found
}

/// Merges a run of neighboring blocks, and keeps the segments that are long enough.
fn close(
    run: &mut Vec<Piece>,
    speed: &[f64],
    force: &[f64],
    (offset, rate_hz, min_secs): (usize, f64, f64),
    found: &mut Segmentation,
) {
    merge(run, (MAX_SECS * rate_hz).round() as usize);
    for piece in run.drain(..) {
        let secs = piece.samples.len() as f64 / rate_hz;
        // Twice the rounded length of a block can be one sample shorter than the minimum.
        if secs + 1.0 / rate_hz < min_secs {
            found.changing_secs += secs;
            continue;
        }
        found.stretches.push(Stretch {
            speed: MetersPerSecond(median(speed[piece.samples.clone()].to_vec())),
            force: Newtons(median(force[piece.samples.clone()].to_vec())),
            samples: piece.samples.start + offset..piece.samples.end + offset,
        });
    }
}

/// Repeatedly joins the two most similar neighbors, while the union stays within the tolerances and `n_max` samples.
fn merge(run: &mut Vec<Piece>, n_max: usize) {
    let cost = |pair: &[Piece]| {
        let both = union(&pair[0], &pair[1]);
        if both.samples.len() > n_max { f64::INFINITY } else { spread(&both) }
    };
    let mut costs: Vec<f64> = run.windows(2).map(cost).collect();
    while let Some((i, _)) =
        costs.iter().enumerate().filter(|(_, c)| **c <= 1.0).min_by(|a, b| a.1.total_cmp(b.1))
    {
        run[i] = union(&run[i], &run[i + 1]);
        run.remove(i + 1);
        costs.remove(i);
        for j in [i.wrapping_sub(1), i] {
            if let Some(pair) = run.get(j..).and_then(|from| from.get(..2)) {
                costs[j] = cost(pair);
            }
        }
    }
}

fn union(a: &Piece, b: &Piece) -> Piece {
    let both = |a: Span, b: Span| Span { low: a.low.min(b.low), high: a.high.max(b.high) };
    Piece {
        samples: a.samples.start..b.samples.end,
        speed: both(a.speed, b.speed),
        force: both(a.force, b.force),
    }
}

/// Larger of the deviations of speed and force, relative to their tolerances.
fn spread(piece: &Piece) -> f64 {
    let share = |span: Span, relative: f64, absolute: f64| {
        let middle = 0.5 * (span.low + span.high);
        0.5 * (span.high - span.low) / (relative * middle).max(absolute)
    };
    share(piece.speed, SPEED_TOLERANCE, SPEED_TOLERANCE_MPS).max(share(
        piece.force,
        FORCE_TOLERANCE,
        FORCE_TOLERANCE_N,
    ))
}

fn span(values: &[f64]) -> Span {
    Span {
        low: values.iter().copied().fold(f64::INFINITY, f64::min),
        high: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    }
}

/// Track after a zero-delay low-pass filter at [`TRACK_BAND_HZ`]: three moving averages with the gain `sinc³`.
pub(crate) fn smoothed(track: &[f64], rate_hz: f64) -> Vec<f64> {
    // sinc³ is 1/√2 at the argument 0.262, which is length times frequency divided by sample rate.
    let half = (0.5 * (0.262 / TRACK_BAND_HZ * rate_hz - 1.0)).round().max(0.0) as usize;
    (0..3).fold(track.to_vec(), |track, _| moving_average(&track, half))
}

/// Moving average over `half` samples on each side, over fewer at the ends.
fn moving_average(track: &[f64], half: usize) -> Vec<f64> {
    let sums: Vec<f64> = std::iter::once(0.0)
        .chain(track.iter().scan(0.0, |sum, x| {
            *sum += x;
            Some(*sum)
        }))
        .collect();
    let n = track.len();
    (0..n)
        .map(|i| {
            let reach = half.min(i).min(n - 1 - i);
            (sums[i + reach + 1] - sums[i - reach]) / (2 * reach + 1) as f64
        })
        .collect()
}

#[cfg(test)]
mod tests;
