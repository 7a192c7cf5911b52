//! Vibration envelopes for Android 16: control points of its two builders of envelopes, in a JSON file.
//!
//! Both envelopes start at 0, and each control point states the time in which the values before it change to its own. They are
//! linear between. All durations are at least [`MIN_POINT_MS`] and at most [`MAX_POINT_MS`], which every device must support;
//! the last point is 0.

use serde::{Deserialize, Serialize};
use shagreen_core::signals::haptic_outline::{HapticOutline, STEP_SECS, simplified};
use shagreen_core::units::Hertz;

use crate::clip_head::ClipHeadV1;
use crate::clip_scale::ClipScale;
use crate::layout;

/// Value of the `format` field.
pub const FORMAT: &str = "shagreen-android-envelope";
/// Version of the format.
pub const VERSION: &str = "1.0";
/// Shortest duration of a control point, in ms.
pub const MIN_POINT_MS: u32 = 20;
/// Longest duration of a control point, in ms.
pub const MAX_POINT_MS: u32 = 1000;
/// Largest error of an amplitude, from 0 to 1: larger than that of clips, since devices have few points.
pub const AMPLITUDE_TOLERANCE: f64 = 0.05;
/// Largest error of a frequency in Hz.
pub const FREQUENCY_TOLERANCE_HZ: f64 = 15.0;
/// Levels of objects and lists that are written over several lines: one line for each control point.
const OPEN_DEPTH: usize = 3;

/// A file with both envelopes of a signal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AndroidEnvelopeV1 {
    /// Its format is [`FORMAT`], and its version [`VERSION`].
    #[serde(flatten)]
    pub head: ClipHeadV1,
    /// For `VibrationEffect.WaveformEnvelopeBuilder`.
    pub waveform: WaveformV1,
    /// For `VibrationEffect.BasicEnvelopeBuilder`.
    pub basic: BasicV1,
}

/// Envelope of amplitude and frequency.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaveformV1 {
    /// Frequency at the start, in Hz.
    pub initial_frequency_hz: f64,
    /// Control points.
    pub points: Vec<WaveformPointV1>,
}

/// Control point of amplitude and frequency.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaveformPointV1 {
    /// Amplitude at the end, 0 to 1.
    pub amplitude: f64,
    /// Frequency at the end, in Hz.
    pub frequency_hz: f64,
    /// Duration in ms.
    pub duration_ms: u32,
}

/// Envelope of intensity and sharpness, which each device maps to its own range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BasicV1 {
    /// Sharpness at the start, 0 to 1.
    pub initial_sharpness: f64,
    /// Control points; the last one has an intensity of 0.
    pub points: Vec<BasicPointV1>,
}

/// Control point of intensity and sharpness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BasicPointV1 {
    /// Intensity at the end, 0 to 1: the root of the amplitude.
    pub intensity: f64,
    /// Sharpness at the end, 0 to 1: the position of the frequency in the band of the description.
    pub sharpness: f64,
    /// Duration in ms.
    pub duration_ms: u32,
}

/// Returns the envelopes of an outline. `about` has the program and the description of the signal.
pub fn android_envelope(outline: &HapticOutline, scale: ClipScale, about: (&str, &str)) -> AndroidEnvelopeV1 {
    let points = points(outline, scale);
    let first_hz = points.first().map_or(scale.band[0].0, |point| point.frequency_hz);
    let basic = |point: &WaveformPointV1| BasicPointV1 {
        intensity: rounded(point.amplitude.sqrt(), 1e4),
        sharpness: scale.frequency(Hertz(point.frequency_hz)),
        duration_ms: point.duration_ms,
    };
    AndroidEnvelopeV1 {
        head: ClipHeadV1::new((FORMAT, VERSION), about, outline.seconds(), scale),
        basic: BasicV1 {
            initial_sharpness: scale.frequency(Hertz(first_hz)),
            points: points.iter().map(basic).collect(),
        },
        waveform: WaveformV1 { initial_frequency_hz: first_hz, points },
    }
}

/// Serializes envelopes as JSON.
pub fn write_android_envelope(envelope: &AndroidEnvelopeV1) -> Vec<u8> {
    layout::to_bytes(envelope, OPEN_DEPTH)
}

/// Control points on a grid of [`MIN_POINT_MS`], the last one 0 at the end of the signal.
fn points(outline: &HapticOutline, scale: ClipScale) -> Vec<WaveformPointV1> {
    let Some(last) = outline.points.len().checked_sub(1) else { return Vec::new() };
    let step_secs = 1e-3 * f64::from(MIN_POINT_MS);
    // A quotient just below a whole number is a rounded one: 0.58 s are 29 steps.
    let n_steps = ((outline.seconds() / step_secs + 1e-9) as usize).max(2);
    let per_step = (step_secs / STEP_SECS).round() as usize;
    let at = |step: usize| outline.points[(step * per_step).min(last)];
    // The time in which the first point is reached is the first step.
    let steps: Vec<f64> = (1..=n_steps).map(|step| step as f64).collect();
    let amplitudes: Vec<f64> = (1..=n_steps)
        .map(|step| if step == n_steps { 0.0 } else { scale.amplitude(at(step).amplitude_mps2) })
        .collect();
    let frequencies_hz: Vec<f64> = (1..=n_steps)
        .map(|step| {
            let hz = at(step).frequency.0;
            // Silence has no frequency, but a control point must have one.
            rounded(if hz > 0.0 { hz } else { scale.band[0].0 }, 10.0)
        })
        .collect();
    let curves = [(&*amplitudes, AMPLITUDE_TOLERANCE), (&*frequencies_hz, FREQUENCY_TOLERANCE_HZ)];
    let mut points = Vec::new();
    let mut before = (0.0, frequencies_hz[0], 0);
    for index in simplified(&steps, &curves, &[]) {
        let target = (amplitudes[index], frequencies_hz[index], MIN_POINT_MS * (index as u32 + 1));
        add_point(&mut points, before, target);
        before = target;
    }
    points
}

/// Adds the control point from one amplitude, frequency in Hz and time in ms to another one: several if it is too long for one.
fn add_point(points: &mut Vec<WaveformPointV1>, from: (f64, f64, u32), to: (f64, f64, u32)) {
    let total_ms = to.2 - from.2;
    let n_parts = total_ms.div_ceil(MAX_POINT_MS);
    let time_ms = |part: u32| (u64::from(total_ms) * u64::from(part) / u64::from(n_parts)) as u32;
    for part in 1..=n_parts {
        let share = f64::from(time_ms(part)) / f64::from(total_ms);
        points.push(WaveformPointV1 {
            amplitude: rounded(from.0 + share * (to.0 - from.0), 1e4),
            frequency_hz: rounded(from.1 + share * (to.1 - from.1), 10.0),
            duration_ms: time_ms(part) - time_ms(part - 1),
        });
    }
}

fn rounded(value: f64, per_unit: f64) -> f64 {
    (per_unit * value).round() / per_unit
}

#[cfg(test)]
mod tests {
    use super::{AndroidEnvelopeV1, MAX_POINT_MS, MIN_POINT_MS, android_envelope, write_android_envelope};
    use crate::clip_scale::ClipScale;
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
    use shagreen_core::signals::haptic_outline::HapticOutline;
    use shagreen_core::units::Hertz;
    use std::f64::consts::TAU;

    fn envelope(samples: &[f32], rate_hz: f64) -> AndroidEnvelopeV1 {
        let outline = HapticOutline::of(samples, Hertz(rate_hz), &[]);
        android_envelope(&outline, ClipScale::new(2.0, None), ("test", "a signal"))
    }

    fn sine(n: usize, amplitude: f64) -> Vec<f32> {
        (0..n).map(|i| (amplitude * (TAU * 180.0 * i as f64 / 2000.0).sin()) as f32).collect()
    }

    #[test]
    fn a_sine_is_reached_held_and_left() {
        let made = envelope(&sine(6000, 1.0), 2000.0);
        let durations: Vec<u32> = made.waveform.points.iter().map(|point| point.duration_ms).collect();
        // One step to its amplitude, three parts of at most a second, and one step to silence.
        assert_eq!(durations, [20, 986, 987, 987, 20]);
        assert_eq!(durations.iter().sum::<u32>(), 3000);
        for point in &made.waveform.points[..4] {
            assert!(
                (point.amplitude - 0.5).abs() < 0.005 && (point.frequency_hz - 180.0).abs() < 0.5,
                "{point:?}"
            );
        }
        assert_eq!(made.waveform.points[4].amplitude, 0.0);
        for (basic, point) in made.basic.points.iter().zip(&made.waveform.points) {
            assert!((basic.intensity.powi(2) - point.amplitude).abs() < 1e-3, "{basic:?}");
            assert!((basic.sharpness - 0.5).abs() < 0.005, "{basic:?}");
            assert_eq!(basic.duration_ms, point.duration_ms);
        }
        assert_eq!(made.waveform.initial_frequency_hz, made.waveform.points[0].frequency_hz);
        let back: AndroidEnvelopeV1 = serde_json::from_slice(&write_android_envelope(&made)).unwrap();
        assert_eq!(back, made);
    }

    #[test]
    fn silence_and_short_signals_are_envelopes_too() {
        let silent = envelope(&[0.0; 2000], 2000.0);
        assert!(
            silent.waveform.points.iter().all(|point| point.amplitude == 0.0 && point.frequency_hz == 60.0)
        );
        assert_eq!(envelope(&sine(10, 1.0), 2000.0).waveform.points.len(), 2);
        assert!(envelope(&[], 2000.0).waveform.points.is_empty());
        let points = envelope(&sine(1160, 1.0), 2000.0).waveform.points;
        assert_eq!(points.iter().map(|point| point.duration_ms).sum::<u32>(), 580);
    }

    proptest! {
        /// Every envelope keeps the rules of the builders.
        #[test]
        fn every_envelope_can_be_built(
            samples in proptest::collection::vec(-4.0..4.0_f32, 1..900),
            rate_hz in 200.0..4000.0_f64,
        ) {
            let made = envelope(&samples, rate_hz);
            let points = &made.waveform.points;
            prop_assert!(points.iter().all(|p| (MIN_POINT_MS..=MAX_POINT_MS).contains(&p.duration_ms)));
            prop_assert!(points.iter().all(|p| (0.0..=1.0).contains(&p.amplitude) && p.frequency_hz > 0.0));
            prop_assert!(made.basic.points.iter().all(|p| (0.0..=1.0).contains(&p.intensity)));
            prop_assert!(made.basic.points.iter().all(|p| (0.0..=1.0).contains(&p.sharpness)));
            prop_assert_eq!(made.basic.points.last().map(|point| point.intensity), Some(0.0));
            let total_ms = f64::from(points.iter().map(|point| point.duration_ms).sum::<u32>());
            prop_assert!(total_ms <= (1e3 * made.head.seconds).max(40.0) + 1e-6);
        }
    }
}
