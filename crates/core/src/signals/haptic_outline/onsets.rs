//! Sudden beginnings of a vibration.

use super::{Onset, OutlinePoint, STEP_SECS};
use crate::units::Hertz;

/// Length of the part of the signal whose power is compared with that before it, in s.
const ATTACK_SECS: f64 = 0.01;
/// Length of the part before it, in s: longer than a period of the lowest vibration.
const BEFORE_SECS: f64 = 0.1;
/// Shortest part before it, in s: at the beginning of a signal nothing can rise.
const LEAST_BEFORE_SECS: f64 = 0.02;
/// Ratio of the powers of an onset: 10 dB.
const RISE: f64 = 10.0;
/// Fraction of the highest amplitude that a rise must reach.
const STRONG: f64 = 0.25;
/// Fraction of the highest amplitude that a landing must reach.
const LANDED: f64 = 0.1;
/// Length of the part in which the peak of an onset lies, in s.
const PEAK_SECS: f64 = 0.03;
/// Time after an onset whose frequency is its own: the window of the frequency then begins at the onset, in s.
const FREQUENCY_SECS: f64 = 0.025;
/// Shortest distance between two onsets, in s.
const APART_SECS: f64 = 0.05;

fn in_steps(secs: f64) -> usize {
    (secs / STEP_SECS).round() as usize
}

/// Onsets of a signal with these points, at landings and at rises of the power. Of onsets that are close, the first one stays.
/// Limits are fractions of `highest_mps2`.
pub(super) fn onsets(
    (samples, rate): (&[f32], Hertz),
    points: &[OutlinePoint],
    highest_mps2: f64,
    contacts_secs: &[f64],
) -> Vec<Onset> {
    if highest_mps2 == 0.0 {
        return Vec::new();
    }
    let peak_after = |point: usize, secs: f64| {
        let part = &samples[range(samples.len(), rate, point as f64 * STEP_SECS, secs)];
        part.iter().fold(0.0, |peak: f64, x| f64::from(x.abs()).max(peak))
    };
    let last = points.len() - 1;
    let landings =
        contacts_secs.iter().filter(|secs| secs.is_finite() && **secs >= 0.0).map(|secs| in_steps(*secs));
    let strong =
        landings.filter(|point| *point <= last && peak_after(*point, PEAK_SECS) >= LANDED * highest_mps2);
    let mut all: Vec<usize> = strong.chain(rises(samples, rate, last, STRONG * highest_mps2)).collect();
    all.sort_unstable();
    let mut kept: Vec<usize> = Vec::new();
    for point in all {
        if kept.last().is_none_or(|before| point >= before + in_steps(APART_SECS)) {
            kept.push(point);
        }
    }
    let onset = |point: usize| Onset {
        point,
        amplitude_mps2: peak_after(point, PEAK_SECS).max(points[point].amplitude_mps2),
        frequency: points[(point + in_steps(FREQUENCY_SECS)).min(last)].frequency,
    };
    kept.into_iter().map(onset).collect()
}

/// Samples of a part that begins at a time.
fn range(n_samples: usize, rate: Hertz, start_secs: f64, secs: f64) -> std::ops::Range<usize> {
    let index = |secs: f64| ((secs * rate.0).round() as usize).min(n_samples);
    index(start_secs)..index(start_secs + secs)
}

/// Points at which the power rises above all parts of the time before, to at least the power of a sine of `least_mps2`.
fn rises(samples: &[f32], rate: Hertz, last: usize, least_mps2: f64) -> Vec<usize> {
    let power = |point: usize| {
        let part = &samples[range(samples.len(), rate, point as f64 * STEP_SECS, ATTACK_SECS)];
        let sum: f64 = part.iter().map(|x| f64::from(*x).powi(2)).sum();
        sum / part.len().max(1) as f64
    };
    let powers: Vec<f64> = (0..=last).map(power).collect();
    let (n_attack, n_before) = (in_steps(ATTACK_SECS), in_steps(BEFORE_SECS));
    let is_rise = |point: &usize| {
        // Parts that end before the point.
        let Some(end) = (point + 1).checked_sub(n_attack) else { return false };
        let before = &powers[end.saturating_sub(n_before)..end];
        let highest = before.iter().copied().fold(0.0, f64::max);
        before.len() >= in_steps(LEAST_BEFORE_SECS)
            && powers[*point] >= RISE * highest
            && (2.0 * powers[*point]).sqrt() >= least_mps2
    };
    (0..=last).filter(is_rise).collect()
}
