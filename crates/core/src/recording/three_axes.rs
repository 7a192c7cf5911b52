//! Recordings that keep their three axes of acceleration beside the combined signal.

use crate::recording::from_raw::Columns;
use crate::recording::{Fault, Finding, RawRecording, Recording, RecordingError};

/// Recording with its three axes of acceleration on the same clock.
///
/// Unlike the combined signal of [`Recording::acceleration_mps2`], whose spectrum does not depend on the orientation of
/// the sensor, the axes can be compared only between recordings with the same orientation.
#[derive(Clone, Debug, PartialEq)]
pub struct ThreeAxisRecording {
    pub(super) recording: Recording,
    /// Acceleration of each axis in m/s², in the order of the file; a constant axis is 0, and samples that are not
    /// usable are NaN.
    pub(super) axes_mps2: [Vec<f64>; 3],
}

impl ThreeAxisRecording {
    /// Converts the rows of a file as [`Recording::from_raw`] does, and keeps the axes.
    ///
    /// # Errors
    /// [`RecordingError`] with [`Fault::NotThreeAxes`] unless the file has three axes, otherwise with every fault
    /// found.
    pub fn from_raw(raw: RawRecording) -> Result<(Self, Vec<Finding>), RecordingError> {
        let n_axes = raw.acceleration_mps2.len();
        if n_axes != 3 {
            return Err(RecordingError {
                faults: vec![Fault::NotThreeAxes { n_axes }],
                findings: Vec::new(),
            });
        }
        let columns = Columns::of(raw)?;
        let axes_mps2 = columns.three_axes();
        let (recording, findings) = columns.into_recording()?;
        Ok((Self { recording, axes_mps2 }, findings))
    }

    /// The recording with the combined signal.
    pub fn recording(&self) -> &Recording {
        &self.recording
    }

    /// Acceleration of each axis in m/s², in the order of the file, on the clock of the recording.
    pub fn axes_mps2(&self) -> &[Vec<f64>; 3] {
        &self.axes_mps2
    }
}

#[cfg(test)]
mod tests {
    use super::ThreeAxisRecording;
    use crate::maths::rng::lcg_noise;
    use crate::recording::{Fault, Finding, RawClock, RawMotion, RawRecording, RawTrack, Recording};
    use crate::units::Hertz;

    const N_ROWS: usize = 2000;

    fn raw(acceleration_mps2: Vec<Vec<f64>>) -> RawRecording {
        RawRecording {
            clock: RawClock::Rate(Hertz(1000.0)),
            acceleration_mps2,
            motion: RawMotion::Speed(RawTrack::Constant(0.1)),
            force_n: RawTrack::Constant(1.0),
            full_scale_mps2: None,
        }
    }

    fn three() -> Vec<Vec<f64>> {
        (1..4).map(|seed| lcg_noise(N_ROWS, seed)).collect()
    }

    #[test]
    fn the_axes_are_those_of_the_file_beside_the_combined_signal() {
        let (recording, findings) = ThreeAxisRecording::from_raw(raw(three())).expect("three axes");
        assert_eq!(recording.axes_mps2().as_slice(), three());
        let (combined, _) = Recording::from_raw(raw(three())).expect("a recording");
        assert_eq!(recording.recording(), &combined);
        let is_combined = |finding: &Finding| matches!(finding, Finding::AxesCombined { .. });
        assert!(!findings.iter().any(is_combined), "{findings:?}");
        // On a regular clock, the combined signal has the energy of the axes.
        let energy = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>();
        let of_axes: f64 = recording.axes_mps2().iter().map(|axis| energy(axis)).sum();
        // Energy is restored above 10 Hz.
        assert!((energy(&combined.acceleration_mps2) / of_axes - 1.0).abs() < 0.005);
    }

    #[test]
    fn a_constant_axis_is_zero_and_unusable_samples_are_missing_in_every_axis() {
        let mut axes = three();
        axes[1] = vec![9.81; N_ROWS];
        axes[2][700] = f64::NAN;
        let (recording, _) = ThreeAxisRecording::from_raw(raw(axes.clone())).expect("three axes");
        for (i, [x, y, z]) in (0..N_ROWS).map(|i| (i, [0, 1, 2].map(|axis| recording.axes_mps2()[axis][i]))) {
            if i == 700 {
                assert!([x, y, z].iter().all(|value| value.is_nan()));
            } else {
                assert_eq!([x, y, z], [axes[0][i], 0.0, axes[2][i]], "sample {i}");
            }
        }
    }

    #[test]
    fn another_number_of_axes_is_a_fault() {
        for n_axes in [1, 2] {
            let few = raw(three()[..n_axes].to_vec());
            let error = ThreeAxisRecording::from_raw(few).expect_err("no third axis");
            assert_eq!(error.faults, [Fault::NotThreeAxes { n_axes }]);
            assert!(error.to_string().contains(&format!("the recording has {n_axes}")), "{error}");
        }
    }
}
