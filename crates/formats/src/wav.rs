//! Signals as 32-bit float WAV with a sidecar that says what the numbers are.
//!
//! A WAV file knows no units: beside `out.wav` lies `out.json` ([`SidecarV1`]). Both are written, or neither.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use hound::{SampleFormat, WavReader, WavSpec, WavWriter};
use serde::{Deserialize, Serialize};

use crate::atomic::{self, WriteError};
use crate::layout;

/// What the field `format` of a sidecar holds.
pub const FORMAT: &str = "shagreen-signal";
/// Version of the sidecar.
pub const VERSION: &str = "1.0";
/// What the field `units` of a sidecar holds.
pub const UNITS: &str = "m/s^2";

/// What the samples of a WAV file are and how they came about.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SidecarV1 {
    /// [`FORMAT`].
    pub format: String,
    /// [`VERSION`].
    pub version: String,
    /// [`UNITS`]: what a sample counts.
    pub units: String,
    /// Units for a sample of 1.0.
    pub full_scale: f64,
    /// What each channel is.
    pub channels: Vec<String>,
    /// Samples a second, in Hz.
    pub rate_hz: u32,
    /// Length, in seconds.
    pub seconds: f64,
    /// Identifier of the texture, where one was rendered as it is.
    pub texture: Option<String>,
    /// Point of the space, rough-smooth and hard-soft (0..100), where one was authored.
    pub at: Option<[f64; 2]>,
    /// Whether that point was moved to the hull of the textures.
    pub clamped: bool,
    /// How the parents were mixed.
    pub blend: String,
    /// The textures that were mixed.
    pub parents: Vec<ParentV1>,
    /// Name of the library.
    pub library: String,
    /// What the positions of its textures were derived from: `human`, `simulated` or `physical`.
    pub label_source: Option<String>,
    /// Seed of the noise.
    pub seed: u64,
    /// Name of the stroke's file, where there was one.
    pub stroke: Option<String>,
    /// Speed and force over time.
    pub trace: TraceV1,
    /// The program that wrote it, with its version.
    pub created_by: String,
}

/// A texture in a mixture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParentV1 {
    /// Its identifier.
    pub id: String,
    /// Its share, 0..1.
    pub weight: f64,
    /// Its terms.
    pub licence: String,
}

/// What the tip did: three columns of one length, straight lines between.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TraceV1 {
    /// Times from the first sample of the signal, in seconds.
    pub time_s: Vec<f64>,
    /// Speeds, in mm/s.
    pub speed_mm_per_s: Vec<f64>,
    /// Forces, in N; zero while lifted.
    pub force_n: Vec<f64>,
}

/// A signal of one channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// Samples a second, in Hz.
    pub rate_hz: u32,
    /// Samples, in units of the file's full scale.
    pub samples: Vec<f32>,
}

/// Why a signal was not written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WavWriteError {
    /// The file would overwrite its own sidecar.
    #[error("a signal cannot be called .json, for its sidecar is; name it .wav: {}", path.display())]
    Name {
        /// The file asked for.
        path: PathBuf,
    },
    /// The samples do not fit a WAV file.
    #[error("the signal cannot be packed as WAV; make it shorter or lower its rate")]
    Pack(#[from] hound::Error),
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// Why bytes are no signal.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WavReadError {
    /// Not WAV, or cut off.
    #[error("the WAV file is damaged or of an unknown kind; get a complete copy")]
    Damaged(#[from] hound::Error),
    /// More than one channel.
    #[error("the WAV file has {channels} channels, needs one; split it first")]
    Channels {
        /// Channels of the file.
        channels: u16,
    },
    /// A sample is not finite.
    #[error("sample {index} of the WAV file is not a finite number; repair the file")]
    NotFinite {
        /// Its index.
        index: usize,
    },
}

/// The sidecar of a WAV file: the same name with `.json`.
pub fn sidecar_path(wav: &Path) -> PathBuf {
    wav.with_extension("json")
}

/// Writes samples and their sidecar, both or neither.
///
/// # Errors
/// See [`WavWriteError`]; files that were there are then as they were.
pub fn write_wav(path: &Path, samples: &[f32], sidecar: &SidecarV1) -> Result<(), WavWriteError> {
    let beside = sidecar_path(path);
    if beside == path {
        return Err(WavWriteError::Name { path: path.to_path_buf() });
    }
    let wav = pack(samples, sidecar.rate_hz)?;
    // A line for each field, and one for each row of the trace.
    let json = layout::to_bytes(sidecar, 2);
    atomic::write_all(&[(path, &wav), (&beside, &json)])?;
    Ok(())
}

/// Samples as the bytes of a WAV file of 32-bit floats.
fn pack(samples: &[f32], rate_hz: u32) -> Result<Vec<u8>, hound::Error> {
    let spec = WavSpec {
        channels: 1,
        sample_rate: rate_hz,
        bits_per_sample: 32,
        sample_format: SampleFormat::Float,
    };
    let mut bytes = Cursor::new(Vec::new());
    let mut writer = WavWriter::new(&mut bytes, spec)?;
    for sample in samples {
        writer.write_sample(*sample)?;
    }
    writer.finalize()?;
    Ok(bytes.into_inner())
}

/// Reads a WAV file of one channel: floats as they are, whole numbers as shares of their full scale.
///
/// # Errors
/// See [`WavReadError`].
pub fn read_wav(bytes: &[u8]) -> Result<Signal, WavReadError> {
    let mut reader = WavReader::new(bytes)?;
    let spec = reader.spec();
    if spec.channels != 1 {
        return Err(WavReadError::Channels { channels: spec.channels });
    }
    let samples: Vec<f32> = match spec.sample_format {
        SampleFormat::Float => reader.samples::<f32>().collect::<Result<_, _>>()?,
        SampleFormat::Int => {
            let full_scale = 2.0_f64.powi(i32::from(spec.bits_per_sample) - 1);
            let share = |sample: i32| (f64::from(sample) / full_scale) as f32;
            reader.samples::<i32>().map(|sample| sample.map(share)).collect::<Result<_, _>>()?
        }
    };
    match samples.iter().position(|sample| !sample.is_finite()) {
        Some(index) => Err(WavReadError::NotFinite { index }),
        None => Ok(Signal { rate_hz: spec.sample_rate, samples }),
    }
}

#[cfg(test)]
mod tests {
    use super::{
        FORMAT, ParentV1, SidecarV1, TraceV1, UNITS, VERSION, WavReadError, pack, read_wav, sidecar_path,
        write_wav,
    };
    use std::fs;

    fn sidecar() -> SidecarV1 {
        SidecarV1 {
            format: FORMAT.into(),
            version: VERSION.into(),
            units: UNITS.into(),
            full_scale: 1.0,
            channels: vec!["acceleration".into()],
            rate_hz: 1000,
            seconds: 0.003,
            texture: None,
            at: Some([30.0, 70.0]),
            clamped: false,
            blend: "shared".into(),
            parents: vec![ParentV1 { id: "cork".into(), weight: 1.0, licence: "CC0-1.0".into() }],
            library: "Starter".into(),
            label_source: Some("physical".into()),
            seed: 5,
            stroke: None,
            trace: TraceV1 { time_s: vec![0.0], speed_mm_per_s: vec![100.0], force_n: vec![1.0] },
            created_by: "shagreen".into(),
        }
    }

    #[test]
    fn samples_and_sidecar_come_back_exactly() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.wav");
        // Levels above one are kept: the unit is m/s², not a share of anything.
        write_wav(&path, &[0.25, -7.5, 1e-9], &sidecar()).unwrap();
        let signal = read_wav(&fs::read(&path).unwrap()).unwrap();
        assert_eq!((signal.rate_hz, signal.samples), (1000, vec![0.25, -7.5, 1e-9]));
        let beside: SidecarV1 = serde_json::from_slice(&fs::read(sidecar_path(&path)).unwrap()).unwrap();
        assert_eq!(beside, sidecar());
    }

    #[test]
    fn nothing_is_left_half_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.wav");
        fs::create_dir(sidecar_path(&path)).unwrap();
        assert!(write_wav(&path, &[0.0], &sidecar()).is_err());
        assert!(!path.exists());
        assert!(write_wav(&folder.path().join("x.json"), &[0.0], &sidecar()).is_err());
        assert!(!folder.path().join("x.json").exists());
    }

    #[test]
    fn damage_is_named() {
        let wav = pack(&[0.0; 10], 1000).unwrap();
        for end in 0..wav.len() {
            assert!(read_wav(&wav[..end]).is_err(), "cut at {end}");
        }
        let nan = pack(&[0.0, f32::NAN], 1000).unwrap();
        assert!(matches!(read_wav(&nan), Err(WavReadError::NotFinite { index: 1 })));
        let mut stereo = std::io::Cursor::new(Vec::new());
        let spec = hound::WavSpec {
            channels: 2,
            sample_rate: 8000,
            bits_per_sample: 16,
            sample_format: hound::SampleFormat::Int,
        };
        let mut writer = hound::WavWriter::new(&mut stereo, spec).unwrap();
        writer.write_sample(1_i16).unwrap();
        writer.write_sample(1_i16).unwrap();
        writer.finalize().unwrap();
        assert!(matches!(read_wav(stereo.get_ref()), Err(WavReadError::Channels { channels: 2 })));
    }

    #[test]
    fn whole_numbers_are_shares_of_their_full_scale() {
        let spec = hound::WavSpec {
            channels: 1,
            sample_rate: 8000,
            bits_per_sample: 16,
            sample_format: hound::SampleFormat::Int,
        };
        let mut bytes = std::io::Cursor::new(Vec::new());
        let mut writer = hound::WavWriter::new(&mut bytes, spec).unwrap();
        writer.write_sample(-16384_i16).unwrap();
        writer.finalize().unwrap();
        assert_eq!(read_wav(bytes.get_ref()).unwrap().samples, [-0.5]);
    }
}
