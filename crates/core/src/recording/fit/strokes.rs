//! Strokes in recordings, undivided, for learning from the signal itself.

use std::ops::Range;

use crate::dsp::filter::resample;
use crate::recording::Recording;
use crate::recording::fit::FitError;
use crate::recording::fit::pieces::{check, filtered, nominal, nothing};
use crate::units::Hertz;

/// Stroke with constant or varying speed and force; in a recording, a segment in which the tip touches the surface and
/// moves. All columns have the same length.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Acceleration in m/s² without gravity and hand motion.
    pub accel_mps2: Vec<f64>,
    /// Tip speed at each sample, in m/s.
    pub speed_mps: Vec<f64>,
    /// Normal force at each sample, in N.
    pub force_n: Vec<f64>,
}

/// Strokes of all recordings at this sample rate. They are the segments used by [`fit`](crate::recording::fit::fit),
/// with the same high-pass filter; adjacent segments are joined.
///
/// # Errors
/// [`FitError`] if the columns of a recording are invalid, or if there is no stroke.
pub fn strokes(recordings: &[Recording], rate: Hertz) -> Result<Vec<Stroke>, FitError> {
    for (index, recording) in recordings.iter().enumerate() {
        check(index, recording)?;
    }
    let all: Vec<_> = recordings.iter().map(filtered).collect();
    let mut strokes = Vec::new();
    for stroked in &all {
        let from = nominal(stroked.recording.rate);
        let joined = joined(stroked.segmentation.stretches.iter().map(|stretch| stretch.samples.clone()));
        for (usable, signal) in &stroked.signals {
            // The whole range is resampled at once, so that only its ends have edge effects.
            let accel = resample(signal, from, rate);
            let [speed, force] = [&stroked.recording.speed_mps, &stroked.recording.force_n]
                .map(|column| resample(&column[usable.clone()], from, rate));
            let at = |i: usize| ((i - usable.start) as f64 * rate.0 / from.0).round() as usize;
            for stretch in joined.iter().filter(|stretch| usable.contains(&stretch.start)) {
                let part = at(stretch.start)..at(stretch.end).min(accel.len());
                strokes.push(Stroke {
                    accel_mps2: accel[part.clone()].to_vec(),
                    speed_mps: speed[part.clone()].to_vec(),
                    force_n: force[part].to_vec(),
                });
            }
        }
    }
    if strokes.is_empty() { Err(nothing(&all)) } else { Ok(strokes) }
}

/// Joins ranges that touch or overlap; `ranges` must be in order.
fn joined(ranges: impl Iterator<Item = Range<usize>>) -> Vec<Range<usize>> {
    let mut joined: Vec<Range<usize>> = Vec::new();
    for range in ranges {
        match joined.last_mut() {
            Some(last) if range.start <= last.end => last.end = last.end.max(range.end),
            _ => joined.push(range),
        }
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::{joined, strokes};
    use crate::recording::Recording;
    use crate::recording::fit::FitError;
    use crate::units::Hertz;

    /// Strokes over a sinusoidal surface of 0.5 mm wavelength, the second twice as fast, with a lifted tip between
    /// them; the sensor measures gravity, too.
    fn recording(rate_hz: f64, gravity_mps2: f64) -> Recording {
        let n = (6.0 * rate_hz) as usize;
        let time = |i: usize| i as f64 / rate_hz;
        let speed = |i: usize| if time(i) < 3.0 { 0.05 } else { 0.1 };
        let mut position = 0.0;
        let acceleration_mps2 = (0..n)
            .map(|i| {
                position += speed(i) / rate_hz;
                (std::f64::consts::TAU * position / 5e-4).sin() + gravity_mps2 * (1.0 + 0.1 * time(i))
            })
            .collect();
        Recording {
            rate: Hertz(rate_hz),
            acceleration_mps2,
            speed_mps: (0..n).map(speed).collect(),
            force_n: (0..n).map(|i| if (2.5..3.5).contains(&time(i)) { 0.0 } else { 0.4 }).collect(),
            usable: std::iter::once(0..n).collect(),
        }
    }

    #[test]
    fn strokes_are_those_of_the_tip_on_the_surface_at_the_rate_that_is_asked_for() {
        for rate_hz in [1000.0, 2000.0, 2777.0] {
            let all = strokes(&[recording(rate_hz, 0.0)], Hertz(1000.0)).unwrap();
            assert_eq!(all.len(), 2, "{rate_hz}");
            for (stroke, speed) in all.iter().zip([0.05, 0.1]) {
                let n = stroke.accel_mps2.len();
                assert!((2000..=2600).contains(&n), "{n}");
                assert_eq!([stroke.speed_mps.len(), stroke.force_n.len()], [n; 2]);
                let middle = &stroke.accel_mps2[500..1500];
                let rms = (middle.iter().map(|x| x * x).sum::<f64>() / 1000.0).sqrt();
                assert!((rms - 0.5_f64.sqrt()).abs() < 0.01, "{rms}");
                // The number of upward zero crossings per second is the speed divided by 0.5 mm.
                let n_up = middle.windows(2).filter(|pair| pair[0] < 0.0 && pair[1] >= 0.0).count() as f64;
                assert!((n_up - speed / 5e-4).abs() <= 1.0, "{n_up}");
                assert!((stroke.speed_mps[n / 2] - speed).abs() < 1e-3);
            }
        }
    }

    #[test]
    fn gravity_and_drift_change_nothing() {
        let [without, with] =
            [0.0, 9.81].map(|gravity| strokes(&[recording(2000.0, gravity)], Hertz(1000.0)).unwrap());
        for (without, with) in without.iter().zip(&with) {
            let rows = without.accel_mps2.iter().zip(&with.accel_mps2).skip(200);
            assert!(rows.into_iter().all(|(a, b)| (a - b).abs() < 0.02));
        }
    }

    #[test]
    fn what_touches_is_one_and_what_is_no_stroking_is_refused() {
        assert_eq!(joined([0..4, 4..9, 11..12].into_iter()), [0..9, 11..12]);
        let lifted = Recording { force_n: vec![0.0; 6000], ..recording(1000.0, 0.0) };
        assert!(strokes(&[lifted], Hertz(1000.0)).is_err());
        let mut short = recording(1000.0, 0.0);
        short.force_n.pop();
        assert!(matches!(strokes(&[short], Hertz(1000.0)), Err(FitError::Columns { recording: 0 })));
    }
}
