//! Signals to compare or encode: the acceleration of a WAV file or a haptic clip, without its stroke.

use shagreen_core::dsp::dft321::{Dft321Error, dft321_short_time};
use shagreen_core::recording::RawClock;
use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};

use crate::clip::ClipKind;
use crate::imported::Imported;
use crate::recording::{
    AccelerationUnit, Ask, Channel, ColumnMap, Question, RecordingFileError, n_channels, read_recording,
};

/// A signal with one axis; several axes are combined by DFT321.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// Acceleration in m/s², all finite.
    pub samples_mps2: Vec<f64>,
    /// Sample rate.
    pub rate: Hertz,
}

/// Facts about a signal that its file does not state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SignalHints {
    /// Acceleration of a sample of 1.0 in m/s², if there is no sidecar file.
    pub full_scale_mps2: Option<f64>,
    /// The channel that holds the signal, from zero; `None` if all channels are axes.
    pub channel: Option<usize>,
}

/// Supported sample rates in Hz: from the lowest that covers vibrotactile bandwidth to the highest of audio converters.
pub const RATES_HZ: std::ops::RangeInclusive<f64> = 200.0..=768_000.0;

/// Why a file is not a signal.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SignalError {
    /// The file cannot be read.
    #[error(transparent)]
    File(RecordingFileError),
    /// A table, whose rows may be unevenly spaced.
    #[error(
        "the file is neither a WAV file nor a haptic clip; use a signal from \"shagreen render\" or from an audio editor"
    )]
    NotWav,
    /// The file lacks necessary facts.
    #[error(
        "{what}; select the channel of the signal with --channel N, and state \"units\" and \"full_scale\" (the acceleration of a sample value of 1.0) in the sidecar file (.json) next to it"
    )]
    Unclear {
        /// The missing facts.
        what: String,
    },
    /// The file has several channels, and the signal is one of them.
    #[error("the file has {n_channels} channels; select the channel of the signal with --channel N, from 1")]
    WhichChannel {
        /// Number of channels in the file.
        n_channels: usize,
    },
    /// The requested channel does not exist.
    #[error("there is no channel {channel}; choose a channel from 1 to {n_channels}")]
    Channel {
        /// The channel, from one.
        channel: usize,
        /// Number of channels in the file.
        n_channels: usize,
    },
    /// The sample rate is not supported.
    #[error("the file states a sample rate of {rate_hz} Hz, but {} to {} Hz are supported; correct its header or resample it", RATES_HZ.start(), RATES_HZ.end())]
    Rate {
        /// Sample rate of the file in Hz.
        rate_hz: f64,
    },
    /// The axes cannot be combined.
    #[error(transparent)]
    Axes(#[from] Dft321Error),
    /// A sample is not a finite number.
    #[error("sample {index} is not a finite number; remove it, or export the file again")]
    NotFinite {
        /// Index of the sample, from zero.
        index: usize,
    },
}

/// Reads a signal. A haptic clip becomes one ([`crate::clip`]). `sidecar` holds the bytes of the `.json` file next to the WAV file, which states the value of a
/// sample of 1.0. Without a sidecar the hints apply; without either, a sample of 1.0 is read as 1 m/s², with a warning.
///
/// # Errors
/// See [`SignalError`].
pub fn read_signal(
    file_name: &str,
    bytes: &[u8],
    sidecar: Option<&[u8]>,
    hints: SignalHints,
) -> Result<Imported<Signal>, SignalError> {
    let is_wav = bytes.starts_with(b"RIFF") || file_name.to_lowercase().ends_with(".wav");
    if !is_wav && ClipKind::of(file_name, bytes).is_none() {
        return Err(SignalError::NotWav);
    }
    let is_said = is_wav && sidecar.is_some();
    let channel = hints.channel.filter(|_| is_wav);
    let channels = channel.map(|channel| only(channel, n_channels(bytes))).transpose()?;
    // A clip that states no full scale says itself which one is assumed.
    let usual = is_wav.then_some(1.0);
    let map = ColumnMap {
        acceleration_unit: (!is_said).then_some(AccelerationUnit::MetersPerSecondSquared),
        full_scale: if is_said { None } else { hints.full_scale_mps2.or(usual) },
        channels,
        // The stroke has no effect here, so any value will do.
        constant_speed: Some(MetersPerSecond(0.1)),
        constant_force: Some(Newtons(1.0)),
        ..ColumnMap::default()
    };
    let file = read_recording(file_name, bytes, sidecar, &map).map_err(|error| match error {
        RecordingFileError::NeedsAnswers(needed) => {
            let asked = || needed.questions.iter().filter(|question| question.guess.is_none());
            if asked().next().is_some() && asked().all(|question| question.what == Ask::Channels) {
                SignalError::WhichChannel { n_channels: n_channels(bytes) }
            } else {
                SignalError::Unclear { what: asked().map(|q| q.text.as_str()).collect::<Vec<_>>().join("; ") }
            }
        }
        other => SignalError::File(other),
    })?;
    let RawClock::Rate(rate) = file.raw.clock else { return Err(SignalError::NotWav) };
    if !RATES_HZ.contains(&rate.0) {
        return Err(SignalError::Rate { rate_hz: rate.0 });
    }
    let axes: Vec<&[f64]> = file.raw.acceleration_mps2.iter().map(Vec::as_slice).collect();
    if let Some(index) = axes.iter().find_map(|axis| axis.iter().position(|x| !x.is_finite())) {
        return Err(SignalError::NotFinite { index });
    }
    let samples_mps2 =
        if let [axis] = axes.as_slice() { axis.to_vec() } else { dft321_short_time(&axes, rate)? };
    let mut warnings = file.warnings;
    let assumed = |question: Question| if is_wav { question.text } else { question.to_string() };
    warnings.extend(file.questions.into_iter().map(assumed));
    if is_wav && sidecar.is_none() && hints.full_scale_mps2.is_none() {
        warnings.push(
            "the unit of the samples is not stated; a sample value of 1.0 is read as 1 m/s² (set another value with --full-scale)"
                .to_owned(),
        );
    }
    Ok(Imported { value: Signal { samples_mps2, rate }, warnings })
}

/// Selects one channel as the signal and ignores the others.
fn only(channel: usize, n_channels: usize) -> Result<Vec<Channel>, SignalError> {
    if channel >= n_channels {
        return Err(SignalError::Channel { channel: channel + 1, n_channels });
    }
    let kind = |i: usize| if i == channel { Channel::Acceleration } else { Channel::Unused };
    Ok((0..n_channels).map(kind).collect())
}

#[cfg(test)]
mod tests {
    use super::{SignalError, SignalHints, read_signal};

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
            (Some(&beside), Some(3.0), 2.0, 0),
            (None, Some(3.0), 3.0, 0),
            (None, None, 1.0, 1),
        ] {
            let hints = SignalHints { full_scale_mps2: full_scale, channel: None };
            let read = read_signal("s.wav", &bytes, beside, hints).unwrap();
            assert_eq!(read.value.rate.0, 2000.0);
            assert_eq!(read.warnings.len(), n_warnings, "{:?}", read.warnings);
            let wanted = samples.iter().map(|x| factor * f64::from(*x));
            assert!(read.value.samples_mps2.iter().zip(wanted).all(|(x, y)| (x - y).abs() < 1e-12));
        }
    }

    /// A 16-bit WAV file with these channels.
    fn integers(rate_hz: u32, channels: &[[i16; 4]]) -> Vec<u8> {
        let spec = hound::WavSpec {
            channels: channels.len() as u16,
            sample_rate: rate_hz,
            bits_per_sample: 16,
            sample_format: hound::SampleFormat::Int,
        };
        let mut bytes = std::io::Cursor::new(Vec::new());
        let mut writer = hound::WavWriter::new(&mut bytes, spec).unwrap();
        for i in 0..4 {
            for channel in channels {
                writer.write_sample(channel[i]).unwrap();
            }
        }
        writer.finalize().unwrap();
        bytes.into_inner()
    }

    #[test]
    fn one_channel_of_several_is_the_signal() {
        let stereo = integers(8000, &[[1, 2, 3, 4], [16_384, 0, -16_384, 0]]);
        let of = |channel| {
            read_signal("s.wav", &stereo, None, SignalHints { channel, full_scale_mps2: Some(10.0) })
        };
        assert_eq!(of(Some(1)).unwrap().value.samples_mps2, [5.0, 0.0, -5.0, 0.0]);
        assert!(matches!(of(Some(2)), Err(SignalError::Channel { channel: 3, n_channels: 2 })));
        // The scale is known, so the message asks for the channel alone.
        assert_eq!(
            of(None).unwrap_err().to_string(),
            "the file has 2 channels; select the channel of the signal with --channel N, from 1"
        );
    }

    #[test]
    fn what_is_no_signal_is_named() {
        let none = SignalHints::default();
        let table = b"t,a,speed,force\n0,0.1,1,1\n0.001,0.2,1,1\n0.002,0.1,1,1\n";
        assert!(matches!(read_signal("t.csv", table, None, none), Err(SignalError::NotWav)));
        assert!(matches!(read_signal("t.wav", table, None, none), Err(SignalError::File(_))));
        for rate_hz in [0, 1, 4_000_000_000_u32] {
            let mut file = integers(8000, &[[1; 4]]);
            file[24..28].copy_from_slice(&u32::to_le_bytes(rate_hz));
            let found = read_signal("s.wav", &file, None, none);
            assert!(matches!(found, Err(SignalError::Rate { .. })), "{rate_hz}: {found:?}");
        }
        let mut cut = integers(8000, &[[1; 4]]);
        cut.truncate(cut.len() - 2);
        assert_eq!(read_signal("s.wav", &cut, None, none).unwrap().warnings.len(), 2);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("s.wav");
        write_wav(&path, &[0.0, f32::NAN], &SidecarV1::new(2000, 0.001, 1, "test")).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let found = read_signal("s.wav", &bytes, None, none);
        assert!(matches!(found, Err(SignalError::NotFinite { index: 1 })), "{found:?}");
    }
}
