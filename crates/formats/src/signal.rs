//! Signals to be compared or encoded: the acceleration of a WAV file, without the stroke that it was felt under.

use shagreen_core::dft321::{Dft321Error, dft321};
use shagreen_core::recording::RawClock;
use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};

use crate::imported::Imported;
use crate::recording::{AccelerationUnit, ColumnMap, RecordingFileError, read_recording};

/// A signal of one axis: several are made one by DFT321.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// Acceleration in m/s², all of it finite.
    pub samples_mps2: Vec<f64>,
    /// Samples a second.
    pub rate: Hertz,
}

/// Why a file is no signal.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SignalError {
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] RecordingFileError),
    /// A table, whose rows may come at any time.
    #[error(
        "a signal is a WAV file, and this is none; \"shagreen render\" writes such, and editors of sound do"
    )]
    NotWav,
    /// Axes that cannot be combined.
    #[error(transparent)]
    Axes(#[from] Dft321Error),
    /// A sample that is no number.
    #[error("sample {index} is not a finite number; cut it out, or export the file again")]
    NotFinite {
        /// Which, from zero.
        index: usize,
    },
}

/// Reads a signal. `sidecar` are the bytes of the `.json` beside the file, which tells what a sample of 1.0 is; where there is
/// none, it is `full_scale_mps2`, or one with a warning.
///
/// # Errors
/// See [`SignalError`].
pub fn read_signal(
    file_name: &str,
    bytes: &[u8],
    sidecar: Option<&[u8]>,
    full_scale_mps2: Option<f64>,
) -> Result<Imported<Signal>, SignalError> {
    let is_said = sidecar.is_some() && full_scale_mps2.is_none();
    let map = ColumnMap {
        acceleration_unit: (!is_said).then_some(AccelerationUnit::MetersPerSecondSquared),
        full_scale: (!is_said).then(|| full_scale_mps2.unwrap_or(1.0)),
        // Whatever the stroke was, it changes nothing here.
        constant_speed: Some(MetersPerSecond(0.1)),
        constant_force: Some(Newtons(1.0)),
        ..ColumnMap::default()
    };
    let file = read_recording(file_name, bytes, sidecar, &map)?;
    let RawClock::Rate(rate) = file.raw.clock else { return Err(SignalError::NotWav) };
    let axes: Vec<&[f64]> = file.raw.acceleration_mps2.iter().map(Vec::as_slice).collect();
    if let Some(index) = axes.iter().find_map(|axis| axis.iter().position(|x| !x.is_finite())) {
        return Err(SignalError::NotFinite { index });
    }
    let samples_mps2 = if let [axis] = axes.as_slice() { axis.to_vec() } else { dft321(&axes)? };
    let mut warnings = Vec::new();
    if sidecar.is_none() && full_scale_mps2.is_none() {
        warnings.push(
            "nothing says what the samples are; a sample of 1.0 is taken for 1 m/s² (--full-scale says otherwise)"
                .to_owned(),
        );
    }
    Ok(Imported { value: Signal { samples_mps2, rate }, warnings })
}

#[cfg(test)]
mod tests {
    use super::{SignalError, read_signal};

    use crate::wav::{SidecarV1, write_wav};

    #[test]
    fn a_signal_has_the_unit_of_its_sidecar_or_of_who_says_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("s.wav");
        let sidecar = SidecarV1 { full_scale: 2.0, ..SidecarV1::new(2000, 0.5, 1, "test") };
        let samples: Vec<f32> = (0..1000_u16).map(|i| f32::from(i % 7) * 0.25).collect();
        write_wav(&path, &samples, &sidecar).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let beside = std::fs::read(folder.path().join("s.json")).unwrap();
        for (beside, full_scale, factor, n_warnings) in [
            (Some(beside.as_slice()), None, 2.0, 0),
            (Some(&beside), Some(3.0), 3.0, 0),
            (None, Some(3.0), 3.0, 0),
            (None, None, 1.0, 1),
        ] {
            let read = read_signal("s.wav", &bytes, beside, full_scale).unwrap();
            assert_eq!(read.value.rate.0, 2000.0);
            assert_eq!(read.warnings.len(), n_warnings, "{:?}", read.warnings);
            let wanted = samples.iter().map(|x| factor * f64::from(*x));
            assert!(read.value.samples_mps2.iter().zip(wanted).all(|(x, y)| (x - y).abs() < 1e-12));
        }
    }

    #[test]
    fn what_is_no_signal_is_named() {
        let table = b"t,a,speed,force\n0,0.1,1,1\n0.001,0.2,1,1\n0.002,0.1,1,1\n";
        assert!(read_signal("t.csv", table, None, None).is_err());
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("s.wav");
        write_wav(&path, &[0.0, f32::NAN], &SidecarV1::new(2000, 0.001, 1, "test")).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let found = read_signal("s.wav", &bytes, None, None);
        assert!(matches!(found, Err(SignalError::NotFinite { index: 1 })), "{found:?}");
    }
}
