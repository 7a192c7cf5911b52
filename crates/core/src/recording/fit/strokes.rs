//! Strokes in recordings, undivided, for learning from the signal itself.

use std::ops::Range;

use crate::dsp::filter::resample;
use crate::recording::fit::FitError;
use crate::recording::fit::pieces::{Stroked, check, filtered, high_passed, nominal, nothing};
use crate::recording::{Recording, ThreeAxisRecording};
use crate::units::Hertz;

/// Stroke with constant or varying speed and force; in a recording, a segment in which the tip touches the surface and
/// moves. All columns have the same length.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Acceleration in m/s² without gravity and hand motion: the combined signal, or the three axes.
    pub axes_mps2: Vec<Vec<f64>>,
    /// Tip speed at each sample, in m/s.
    pub speed_mps: Vec<f64>,
    /// Normal force at each sample, in N.
    pub force_n: Vec<f64>,
}

/// Strokes of all recordings at this sample rate, with the combined signal. They are the segments used by
/// [`fit`](crate::recording::fit::fit), with the same high-pass filter; adjacent segments are joined.
///
/// # Errors
/// [`FitError`] if the columns of a recording are invalid, or if there is no stroke.
pub fn strokes(recordings: &[Recording], rate: Hertz) -> Result<Vec<Stroke>, FitError> {
    let recordings: Vec<&Recording> = recordings.iter().collect();
    cut(&recordings, rate, |_, _, combined| vec![combined.to_vec()])
}

/// As [`strokes`], with the three axes, each filtered as the combined signal is.
///
/// # Errors
/// As [`strokes`].
pub fn three_axis_strokes(recordings: &[ThreeAxisRecording], rate: Hertz) -> Result<Vec<Stroke>, FitError> {
    let combined: Vec<&Recording> = recordings.iter().map(|recording| &recording.recording).collect();
    cut(&combined, rate, |index, usable, _| {
        let ThreeAxisRecording { recording, axes_mps2 } = &recordings[index];
        axes_mps2.iter().map(|axis| high_passed(&axis[usable.clone()], recording.rate)).collect()
    })
}

/// Strokes of all recordings. `axes_of` returns the filtered axes of a usable range, from the index of the recording,
/// the range and its filtered combined signal.
fn cut(
    recordings: &[&Recording],
    rate: Hertz,
    axes_of: impl Fn(usize, &Range<usize>, &[f64]) -> Vec<Vec<f64>>,
) -> Result<Vec<Stroke>, FitError> {
    for (index, recording) in recordings.iter().enumerate() {
        check(index, recording)?;
    }
    let all: Vec<Stroked<'_>> = recordings.iter().map(|recording| filtered(recording)).collect();
    let mut strokes = Vec::new();
    for (index, stroked) in all.iter().enumerate() {
        let from = nominal(stroked.recording.rate);
        let joined = joined(stroked.segmentation.stretches.iter().map(|stretch| stretch.samples.clone()));
        for (usable, combined) in &stroked.signals {
            // The whole range is resampled at once, so that only its ends have edge effects.
            let resampled = |column: &[f64]| resample(column, from, rate);
            let axes: Vec<Vec<f64>> =
                axes_of(index, usable, combined).iter().map(|axis| resampled(axis)).collect();
            let [speed, force] = [&stroked.recording.speed_mps, &stroked.recording.force_n]
                .map(|column| resampled(&column[usable.clone()]));
            let at = |i: usize| ((i - usable.start) as f64 * rate.0 / from.0).round() as usize;
            for stretch in joined.iter().filter(|stretch| usable.contains(&stretch.start)) {
                let part = at(stretch.start)..at(stretch.end).min(speed.len());
                strokes.push(Stroke {
                    axes_mps2: axes.iter().map(|axis| axis[part.clone()].to_vec()).collect(),
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
    use super::{joined, strokes, three_axis_strokes};
    use crate::recording::fit::FitError;
    use crate::recording::{RawClock, RawMotion, RawRecording, RawTrack, Recording, ThreeAxisRecording};
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
                let n = stroke.axes_mps2[0].len();
                assert!((2000..=2600).contains(&n), "{n}");
                assert_eq!([stroke.axes_mps2.len(), stroke.speed_mps.len(), stroke.force_n.len()], [1, n, n]);
                let middle = &stroke.axes_mps2[0][500..1500];
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
            let rows = without.axes_mps2[0].iter().zip(&with.axes_mps2[0]).skip(200);
            assert!(rows.into_iter().all(|(a, b)| (a - b).abs() < 0.02));
        }
    }

    /// The same strokes, measured by a sensor that is inclined to the surface: two axes share the vibration, and the
    /// third, across the stroke, is constant.
    fn three_axes(order: [usize; 3]) -> ThreeAxisRecording {
        let one = recording(2000.0, 0.0);
        let axis = |share: f64| one.acceleration_mps2.iter().map(|value| share * value + 2.0).collect();
        let axes: [Vec<f64>; 3] = [axis(0.6), axis(0.8), axis(0.0)];
        let raw = RawRecording {
            clock: RawClock::Rate(one.rate),
            acceleration_mps2: order.map(|number| axes[number].clone()).to_vec(),
            motion: RawMotion::Speed(RawTrack::Column(one.speed_mps.clone())),
            force_n: RawTrack::Column(one.force_n.clone()),
            full_scale_mps2: None,
        };
        ThreeAxisRecording::from_raw(raw).unwrap().0
    }

    #[test]
    fn the_axes_of_a_stroke_are_its_vibration_in_each_direction() {
        let combined = strokes(&[recording(2000.0, 0.0)], Hertz(1000.0)).unwrap();
        for order in [[0, 1, 2], [2, 0, 1]] {
            let all = three_axis_strokes(&[three_axes(order)], Hertz(1000.0)).unwrap();
            assert_eq!(all.len(), combined.len());
            for (stroke, combined) in all.iter().zip(&combined) {
                assert_eq!((&stroke.speed_mps, &stroke.force_n), (&combined.speed_mps, &combined.force_n));
                for (axis, number) in stroke.axes_mps2.iter().zip(order) {
                    let share = [0.6, 0.8, 0.0][number];
                    let rows = axis.iter().zip(&combined.axes_mps2[0]);
                    assert!(rows.into_iter().all(|(axis, whole)| (axis - share * whole).abs() < 1e-9));
                }
            }
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
