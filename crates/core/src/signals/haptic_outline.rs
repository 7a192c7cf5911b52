//! Outline of a vibration: its amplitude and one frequency over time, and the moments at which it begins suddenly. Files for
//! phones, controllers and games describe vibration so.
//!
//! In: acceleration in m/s². Out: points of the amplitude of a sine with the same level and of the spectral centroid
//! ([`HapticOutline`]), and the few of them that a curve needs ([`simplified`]).

mod frequency;
mod onsets;
mod simplify;
mod windows;

use std::f64::consts::PI;

pub use crate::signals::haptic_outline::simplify::simplified;

use crate::signals::haptic_outline::frequency::Centroids;
use crate::signals::haptic_outline::windows::Windows;
use crate::units::Hertz;

/// Interval between points, in s.
pub const STEP_SECS: f64 = 0.005;
/// Length of the Hann window of an amplitude, in s: over two periods at 100 Hz, a sine has a ripple below 1 %.
const WINDOW_SECS: f64 = 0.025;
/// Intervals between two frequencies, which change more slowly than amplitudes and cost more; linear between them.
const FREQUENCY_STEPS: usize = 4;
/// Fraction of the highest amplitude below which a frequency says nothing: the one before is kept.
const SILENT: f64 = 1e-3;

/// Amplitude and frequency of a vibration over time, with its onsets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HapticOutline {
    /// Points every [`STEP_SECS`] from the first sample on, and one at the end. Empty without samples.
    pub points: Vec<OutlinePoint>,
    /// Sudden beginnings, in the order of their times.
    pub onsets: Vec<Onset>,
}

/// Point of an outline.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OutlinePoint {
    /// Time from the first sample, in s.
    pub time_secs: f64,
    /// Amplitude of a sine with the same root mean square, in m/s².
    pub amplitude_mps2: f64,
    /// Spectral centroid between 10 Hz and 1 kHz; during silence the one before it, or 0 if there is none.
    pub frequency: Hertz,
}

/// Sudden beginning of a vibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Onset {
    /// Index of the point at which it begins.
    pub point: usize,
    /// Highest absolute acceleration just after it, in m/s².
    pub amplitude_mps2: f64,
    /// Spectral centroid just after it.
    pub frequency: Hertz,
}

impl HapticOutline {
    /// Outline of a signal in m/s². `contacts_secs` are the times at which the tip lands: each is an onset if the signal has a
    /// tenth of its highest amplitude there, and so is each rise of the power by 10 dB above that of the last tenth of a second.
    ///
    /// Cost: a transform of 50 ms of samples for each 20 ms of the signal.
    pub fn of(samples: &[f32], rate: Hertz, contacts_secs: &[f64]) -> Self {
        let points = points(&Windows::inside(samples, rate));
        let onsets = onsets::onsets((samples, rate), &points, highest_mps2(&points), contacts_secs);
        Self { points, onsets }
    }

    /// Outline of a loop in m/s², whose last sample is followed by its first: the last point is equal to the first one but for
    /// its time.
    pub fn of_loop(samples: &[f32], rate: Hertz) -> Self {
        let points = points(&Windows::around(samples, rate));
        let onsets = onsets::onsets((samples, rate), &points, highest_mps2(&points), &[]);
        Self { points, onsets }
    }

    /// Outline of a signal with taps, as [`Self::of`], for files that have taps of their own: the points are those of `texture`,
    /// the same signal without its taps, and the onsets are those of `samples`. Limits of onsets are fractions of the highest
    /// amplitude of the texture, or of the taps if the texture is silent.
    ///
    /// Cost: twice that of [`Self::of`].
    pub fn with_taps(texture: &[f32], samples: &[f32], rate: Hertz, contacts_secs: &[f64]) -> Self {
        let of_texture = points(&Windows::inside(texture, rate));
        let of_all = points(&Windows::inside(samples, rate));
        let highest = [&of_texture, &of_all].map(|points| highest_mps2(points));
        let highest_mps2 = if highest[0] > 0.0 { highest[0] } else { highest[1] };
        let onsets = onsets::onsets((samples, rate), &of_all, highest_mps2, contacts_secs);
        Self { points: of_texture, onsets }
    }

    /// Highest amplitude of the points in m/s²; 0 for silence.
    pub fn highest_mps2(&self) -> f64 {
        highest_mps2(&self.points)
    }

    /// Duration in s.
    pub fn seconds(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.time_secs)
    }
}

/// Highest amplitude of the outline of a signal in m/s², without the rest of the outline; 0 for silence. `loops` states whether
/// the last sample is followed by the first.
pub fn highest_amplitude_mps2(samples: &[f32], rate: Hertz, loops: bool) -> f64 {
    let windows = if loops { Windows::around(samples, rate) } else { Windows::inside(samples, rate) };
    highest_mps2(&amplitudes(&windows))
}

/// Points of all times.
fn points(signal: &Windows<'_>) -> Vec<OutlinePoint> {
    let mut points = amplitudes(signal);
    set_frequencies(&mut points, signal);
    points
}

fn highest_mps2(points: &[OutlinePoint]) -> f64 {
    points.iter().fold(0.0, |highest, point| point.amplitude_mps2.max(highest))
}

/// Points of all times with their amplitudes.
fn amplitudes(signal: &Windows<'_>) -> Vec<OutlinePoint> {
    let (n, rate) = (signal.n_signal(), signal.rate());
    if n == 0 {
        return Vec::new();
    }
    let n_window = ((WINDOW_SECS * rate.0).round() as usize).clamp(1, n);
    let weight = |i: usize| (PI * (i as f64 + 0.5) / n_window as f64).sin().powi(2);
    let weights: Vec<f64> = (0..n_window).map(weight).collect();
    let sum: f64 = weights.iter().sum();
    let point = |time_secs: f64| {
        let window = signal.around_secs(n_window, time_secs).iter().zip(&weights);
        let power = window.map(|(x, w)| w * f64::from(*x).powi(2)).sum::<f64>() / sum;
        OutlinePoint { time_secs, amplitude_mps2: (2.0 * power).sqrt(), frequency: Hertz(0.0) }
    };
    let end_secs = n as f64 / rate.0;
    // A point just before the end would say nothing new.
    let n_steps = (end_secs / STEP_SECS - 1e-6).ceil().max(1.0) as usize;
    (0..n_steps).map(|step| point(step as f64 * STEP_SECS)).chain([point(end_secs)]).collect()
}

/// Adds the frequencies to points.
fn set_frequencies(points: &mut [OutlinePoint], signal: &Windows<'_>) {
    let Some(mut centroids) = Centroids::new(signal.n_signal(), signal.rate()) else { return };
    let least_mps2 = SILENT * highest_mps2(points);
    let mut centroid_at = |point: &OutlinePoint| {
        let is_silent = point.amplitude_mps2 <= least_mps2;
        if is_silent { None } else { centroids.at(signal, point.time_secs) }
    };
    let last = points.len().saturating_sub(1);
    let found: Vec<Option<Hertz>> = points
        .iter()
        .enumerate()
        .map(|(i, point)| {
            let is_measured = i.is_multiple_of(FREQUENCY_STEPS) || i == last;
            if is_measured { centroid_at(point) } else { None }
        })
        .collect();
    // Before the beginning of a loop is its end.
    let known =
        if signal.is_loop() { found.iter().flatten().next_back() } else { found.iter().flatten().next() };
    let Some(mut before) = known.copied() else { return };
    for start in (0..points.len()).step_by(FREQUENCY_STEPS) {
        let end = (start + FREQUENCY_STEPS).min(last);
        let from = found[start].unwrap_or(before);
        let to = found[end].unwrap_or(from);
        for (i, point) in points[start..=end].iter_mut().enumerate() {
            let share = i as f64 / (end - start).max(1) as f64;
            point.frequency = Hertz(from.0 + share * (to.0 - from.0));
        }
        before = to;
    }
}

#[cfg(test)]
mod tests;
