//! The outline of a vibration as a clip.

use shagreen_core::signals::haptic_outline::{HapticOutline, simplified};

use super::{AmplitudePoint, ClipMetadata, ClipRules, Emphasis, FrequencyPoint, HapticClip, HapticClipError};
use crate::clip_scale::ClipScale;

/// Largest error of the amplitude envelope, from 0 to 1.
pub const AMPLITUDE_TOLERANCE: f64 = 0.03;
/// Largest error of the frequency envelope, from 0 to 1.
pub const FREQUENCY_TOLERANCE: f64 = 0.05;

/// Returns the clip of an outline: envelopes with as few points as the tolerances allow, and an emphasis at each onset.
///
/// # Errors
/// [`HapticClipError::TooFewPoints`] for an outline without points.
pub fn clip_of_outline(
    outline: &HapticOutline,
    scale: ClipScale,
    metadata: ClipMetadata,
) -> Result<HapticClip, HapticClipError> {
    let times_secs: Vec<f64> = outline.points.iter().map(|point| point.time_secs).collect();
    let amplitudes: Vec<f64> =
        outline.points.iter().map(|point| scale.amplitude(point.amplitude_mps2)).collect();
    let frequencies: Vec<f64> = outline.points.iter().map(|point| scale.frequency(point.frequency)).collect();
    let onsets: Vec<usize> = outline.onsets.iter().map(|onset| onset.point).collect();
    let emphasis_at = |point: usize| {
        let onset = outline.onsets.iter().find(|onset| onset.point == point)?;
        let amplitude = scale.amplitude(onset.amplitude_mps2).max(amplitudes[point]);
        Some(Emphasis { amplitude, frequency: scale.frequency(onset.frequency) })
    };
    let amplitude = |point: usize| AmplitudePoint {
        time_secs: micros(times_secs[point]),
        amplitude: amplitudes[point],
        emphasis: emphasis_at(point),
    };
    let frequency =
        |point: usize| FrequencyPoint { time_secs: micros(times_secs[point]), frequency: frequencies[point] };
    let of_amplitude = simplified(&times_secs, &[(&amplitudes, AMPLITUDE_TOLERANCE)], &onsets);
    let of_frequency = simplified(&times_secs, &[(&frequencies, FREQUENCY_TOLERANCE)], &[]);
    let clip = HapticClip {
        metadata,
        amplitude: of_amplitude.into_iter().map(amplitude).collect(),
        frequency: of_frequency.into_iter().map(frequency).collect(),
    };
    clip.checked(ClipRules::Strict)
}

/// Rounds a time to a microsecond.
fn micros(secs: f64) -> f64 {
    (1e6 * secs).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::{AMPLITUDE_TOLERANCE, clip_of_outline};
    use crate::clip_scale::ClipScale;
    use crate::haptic_clip::{ClipMetadata, ClipRules, HapticClip, HapticClipError};
    use proptest::prelude::{prop_assert_eq, proptest};
    use shagreen_core::signals::haptic_outline::HapticOutline;
    use shagreen_core::units::Hertz;
    use std::f64::consts::TAU;

    const RATE: Hertz = Hertz(2000.0);

    fn clip(samples: &[f32], full_scale_mps2: f64) -> Result<HapticClip, HapticClipError> {
        let outline = HapticOutline::of(samples, RATE, &[]);
        clip_of_outline(&outline, ClipScale::new(full_scale_mps2, None), ClipMetadata::default())
    }

    #[test]
    fn a_sine_is_two_points_and_a_burst_is_an_emphasis() {
        let sine = |i: usize, hz: f64| (2.0 * (TAU * hz * i as f64 / RATE.0).sin()) as f32;
        let steady: Vec<f32> = (0..2000).map(|i| sine(i, 180.0)).collect();
        let clip_of_sine = clip(&steady, 4.0).unwrap();
        assert_eq!((clip_of_sine.amplitude.len(), clip_of_sine.frequency.len()), (2, 2));
        assert!((clip_of_sine.amplitude[0].amplitude - 0.5).abs() < 0.005, "{clip_of_sine:?}");
        assert!((clip_of_sine.frequency[0].frequency - 0.5).abs() < 0.005, "{clip_of_sine:?}");
        assert_eq!((clip_of_sine.start_secs(), clip_of_sine.end_secs()), (0.0, 1.0));
        let mut burst = vec![0.0; 2000];
        for (i, sample) in burst.iter_mut().enumerate().skip(1000).take(60) {
            *sample = sine(i - 1000, 300.0);
        }
        let clip_of_burst = clip(&burst, 2.0).unwrap();
        let emphases: Vec<_> =
            clip_of_burst.amplitude.iter().filter_map(|p| Some((p.time_secs, p.emphasis?))).collect();
        let [(time_secs, emphasis)] = emphases[..] else { panic!("{emphases:?}") };
        assert!((time_secs - 0.5).abs() < 0.011, "{time_secs}");
        assert!(emphasis.amplitude > 0.9 && emphasis.frequency > 0.8, "{emphasis:?}");
        // Silence before it needs no points but its ends.
        assert!(clip_of_burst.amplitude.len() < 25, "{}", clip_of_burst.amplitude.len());
        assert_eq!(clip(&[], 1.0), Err(HapticClipError::TooFewPoints { n: 0 }));
    }

    #[test]
    fn the_envelope_is_within_its_tolerance() {
        let samples: Vec<f32> = (0..2000)
            .map(|i| {
                let t = f64::from(i) / RATE.0;
                ((1.0 + 0.9 * (TAU * 3.0 * t).sin()) * (TAU * 150.0 * t).sin()) as f32
            })
            .collect();
        let made = clip(&samples, 2.0).unwrap();
        assert!(made.amplitude.len() > 8 && made.amplitude.len() < 60, "{}", made.amplitude.len());
        for pair in made.amplitude.windows(2) {
            let middle_secs = 0.5 * (pair[0].time_secs + pair[1].time_secs);
            // The windows at the ends are not centered.
            if !(0.05..0.95).contains(&middle_secs) {
                continue;
            }
            let middle = 0.5 * (pair[0].amplitude + pair[1].amplitude);
            let expected = 0.5 * (1.0 + 0.9 * (TAU * 3.0 * middle_secs).sin());
            // A window of 25 ms flattens the wave a little.
            assert!((middle - expected).abs() < AMPLITUDE_TOLERANCE + 0.02, "{middle} {expected}");
        }
    }

    proptest! {
        #[test]
        fn every_signal_has_a_clip_that_keeps_the_rules(
            samples in proptest::collection::vec(-10.0..10.0_f32, 1..400),
            full_scale_mps2 in 0.01..20.0_f64,
        ) {
            let made = clip(&samples, full_scale_mps2).unwrap();
            prop_assert_eq!(HapticClip::from_json(&made.to_json(), ClipRules::Strict), Ok(made));
        }
    }
}
