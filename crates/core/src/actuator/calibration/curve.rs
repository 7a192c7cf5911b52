//! Gain, noise and distortion over frequency.

use crate::actuator::calibration::impulse::{HIGH_EDGE, Impulse, LOW_EDGE, Window, magnitude_at};
use crate::actuator::calibration::sweep::Sweep;
use crate::actuator::calibration::{CurvePoint, DistortionPoint};
use crate::dsp::spectrum::{hann, median};
use crate::units::Hertz;

/// Number of curve points per octave, sufficient for a resonance with a Q of 30.
pub(super) const POINTS_PER_OCTAVE: f64 = 24.0;
/// Maximum ringing time of an actuator, in seconds.
pub(super) const RING_SECS: f64 = 0.3;
/// Duration of the response window after the start of the response, in seconds.
const AFTER_SECS: f64 = 2.2;
/// Maximum duration of the response window before the start, in seconds, for the ringing of the band edges.
const BEFORE_SECS: f64 = 1.0;
/// Orders of the harmonics in the distortion.
const HARMONICS: std::ops::RangeInclusive<u32> = 2..=5;
/// Length of a section of silence in seconds, and the minimum length.
const PIECE_SECS: f64 = 1.0;
const LEAST_PIECE_SECS: f64 = 0.25;
/// Number of neighboring points on each side that estimate the noise at a point.
const N_NEIGHBORS: usize = 5;
/// Ratio of mean to median of noise powers: between 1.44 for one section and 1 for many.
const MEAN_OVER_MEDIAN: f64 = 1.2;
/// Threshold for hum: ratio of a noise power to that of its neighbors. Smaller ratios are random fluctuations.
const HUM_POWER: f64 = 6.0;
/// Ratio of a harmonic's power to the noise power above which it counts as a harmonic.
const HARMONIC_POWER: f64 = 6.0;
/// Margins between the sweep and the silence, in seconds: the sweep may start slightly earlier, and the actuator rings
/// afterwards.
const MARGIN_BEFORE_SECS: f64 = 0.1;
const MARGIN_AFTER_SECS: f64 = 0.5;

/// Sections of silence in a recording, at most [`PIECE_SECS`] long and half overlapping.
pub(super) fn silence(signal: &[f64], rate: Hertz, begins_secs: f64, sweep_secs: f64) -> Vec<&[f64]> {
    let index = |secs: f64| ((secs * rate.0).max(0.0) as usize).min(signal.len());
    let before = &signal[..index(begins_secs - MARGIN_BEFORE_SECS)];
    let after = &signal[index(begins_secs + sweep_secs + MARGIN_AFTER_SECS)..];
    let least = (LEAST_PIECE_SECS * rate.0) as usize;
    let piece = (PIECE_SECS * rate.0) as usize;
    let mut pieces = Vec::new();
    for part in [before, after] {
        let length = piece.min(part.len());
        if length >= least {
            pieces.extend(part.windows(length).step_by((length / 2).max(1)));
        }
    }
    pieces
}

/// Gain over frequency, with the noise at each point.
pub(super) fn gains(
    impulse: &Impulse,
    sweep: &Sweep,
    begins_secs: f64,
    silence: &[&[f64]],
) -> Vec<CurvePoint> {
    let rate = impulse.rate;
    let window = response_window(sweep, rate, begins_secs);
    let kept = impulse.windowed(&window);
    let kept_energy: f64 = window.shape().iter().map(|w| w * w).sum();
    let pieces: Vec<Vec<f64>> = silence.iter().map(|piece| windowed(piece)).collect();
    // Stationary noise has the same density in the response window as in a section of silence; it scales with the
    // energy of the windows.
    let power_at = |frequency: Hertz| {
        let power = |piece: &Vec<f64>| {
            let energy = 0.375 * piece.len() as f64;
            magnitude_at(piece, frequency, rate).powi(2) * kept_energy / energy
        };
        pieces.iter().map(power).sum::<f64>() / pieces.len() as f64
    };
    let powers = steady(&frequencies(sweep).map(power_at).collect::<Vec<f64>>());
    let points = frequencies(sweep).zip(powers).map(|(frequency, power)| {
        let noise = (!pieces.is_empty()).then(|| power.sqrt() / impulse.sweep_at(frequency));
        let gain = magnitude_at(&kept, frequency, rate);
        // Subtracts the noise power from the measured power, unless little would remain.
        let without = (gain * gain - noise.map_or(0.0, |n| n * n)).max(0.0).sqrt();
        CurvePoint {
            frequency,
            gain_mps2_per_v: if without > 0.5 * gain { without } else { gain },
            noise_mps2_per_v: noise,
        }
    });
    points.collect()
}

/// Smoothed noise powers: the median of the neighborhood, because few sections give random fluctuations. Powers that
/// stand out like hum are kept.
fn steady(powers: &[f64]) -> Vec<f64> {
    let around = |(at, own): (usize, &f64)| {
        let neighbors = &powers[at.saturating_sub(N_NEIGHBORS)..(at + N_NEIGHBORS + 1).min(powers.len())];
        let middle = MEAN_OVER_MEDIAN * median(neighbors.to_vec());
        if *own > HUM_POWER * middle { *own } else { middle }
    };
    powers.iter().enumerate().map(around).collect()
}

/// Harmonics relative to the fundamental, where at least the second harmonic is within the sweep.
pub(super) fn distortion(
    impulse: &Impulse,
    sweep: &Sweep,
    begins_secs: f64,
    curve: &[CurvePoint],
) -> Vec<DistortionPoint> {
    let growth_secs = sweep.growth_secs();
    let harmonics: Vec<(f64, Vec<f64>, f64)> = HARMONICS
        .map(|order| {
            let order = f64::from(order);
            // The response of the next harmonic lies before this one, that of the previous harmonic after it.
            let gap_secs = growth_secs * ((order + 1.0) / order).ln();
            let window = Window {
                rate: impulse.rate,
                at_secs: begins_secs - growth_secs * order.ln(),
                before_secs: 0.3 * gap_secs,
                after_secs: 0.6 * gap_secs,
            };
            let energy: f64 = window.shape().iter().map(|w| w * w).sum();
            (order, impulse.windowed(&window), energy)
        })
        .collect();
    let window_energy: f64 =
        response_window(sweep, impulse.rate, begins_secs).shape().iter().map(|w| w * w).sum();
    let most_hz = HIGH_EDGE * sweep.high.0;
    let at = |point: &CurvePoint| {
        let mut power = 0.0;
        for (order, kept, energy) in &harmonics {
            let hz = order * point.frequency.0;
            if hz > most_hz {
                break;
            }
            let noise = noise_at(curve, hz).powi(2) * energy / window_energy;
            let found = magnitude_at(kept, Hertz(hz), impulse.rate).powi(2);
            power += if found > HARMONIC_POWER * noise { found - noise } else { 0.0 };
        }
        DistortionPoint { frequency: point.frequency, share: power.sqrt() / point.gain_mps2_per_v }
    };
    let clear =
        curve.iter().filter(|point| 2.0 * point.frequency.0 <= most_hz && super::fit::is_clear(point));
    clear.map(at).collect()
}

/// Largest noise of the curve around a frequency, including nearby hum; zero if the noise is unknown.
fn noise_at(curve: &[CurvePoint], hz: f64) -> f64 {
    let after = curve.partition_point(|point| point.frequency.0 < hz);
    let around = &curve[after.saturating_sub(2).min(curve.len())..(after + 2).min(curve.len())];
    around.iter().filter_map(|point| point.noise_mps2_per_v).fold(0.0, f64::max)
}

/// Window of the linear response, which excludes the response of the second harmonic before it.
fn response_window(sweep: &Sweep, rate: Hertz, begins_secs: f64) -> Window {
    let second_secs = sweep.growth_secs() * 2.0_f64.ln();
    Window {
        rate,
        at_secs: begins_secs,
        before_secs: BEFORE_SECS.min(second_secs / 3.0),
        after_secs: AFTER_SECS.min(sweep.seconds),
    }
}

fn frequencies(sweep: &Sweep) -> impl Iterator<Item = Hertz> {
    let (low, high) = (LOW_EDGE * sweep.low.0, HIGH_EDGE * sweep.high.0);
    let n = (POINTS_PER_OCTAVE * (high / low).log2()).floor() as usize;
    (0..=n).map(move |i| Hertz(low * 2.0_f64.powf(i as f64 / POINTS_PER_OCTAVE)))
}

fn windowed(piece: &[f64]) -> Vec<f64> {
    piece.iter().zip(hann(piece.len())).map(|(x, w)| x * w).collect()
}
