//! Signals as 32-bit float WAV with a sidecar that says what the numbers are.
//!
//! A WAV file knows no units: beside `out.wav` lies `out.json` ([`SidecarV1`]). Both are written, or neither.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use hound::{SampleFormat, WavSpec, WavWriter};
use serde::{Deserialize, Serialize};

use crate::atomic::{self, WriteError};
use crate::layout;
use crate::library::Library;

/// What the field `format` of a sidecar holds.
pub const FORMAT: &str = "shagreen-signal";
/// Version of the sidecar.
pub const VERSION: &str = "1.0";
/// What the field `units` of a sidecar holds.
pub const UNITS: &str = "m/s^2";

/// Bytes of a WAV file before its first sample.
const HEADER_BYTES: u32 = 68;
/// Most samples that fit a WAV file: it counts its bytes in 32 bits.
pub const MAX_SAMPLES: u64 = ((u32::MAX - HEADER_BYTES) / 4) as u64;

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
    /// Whether it lies outside that hull, where nothing was measured, and was authored nevertheless.
    #[serde(default)]
    pub extrapolated: bool,
    /// How the parents were mixed.
    pub blend: String,
    /// The textures that were mixed.
    pub parents: Vec<ParentV1>,
    /// Name of the library.
    pub library: String,
    /// What the positions of its textures were derived from: `human`, `simulated`, `physical` or `estimated`.
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

impl SidecarV1 {
    /// The sidecar of a signal of one channel in m/s²; what sounds in it, and how it was stroked, is to be filled in.
    pub fn new(rate_hz: u32, seconds: f64, seed: u64, created_by: &str) -> Self {
        Self {
            format: FORMAT.to_owned(),
            version: VERSION.to_owned(),
            units: UNITS.to_owned(),
            full_scale: 1.0,
            channels: vec![
                "acceleration of the tip, all directions combined into one (as by DFT321)".to_owned(),
            ],
            rate_hz,
            seconds,
            texture: None,
            at: None,
            clamped: false,
            extrapolated: false,
            blend: String::new(),
            parents: Vec::new(),
            library: String::new(),
            label_source: None,
            seed,
            stroke: None,
            trace: TraceV1::default(),
            created_by: created_by.to_owned(),
        }
    }
}

impl ParentV1 {
    /// A texture of a library with its share.
    pub fn new(library: &Library, texture: usize, weight: f64) -> Self {
        let entry = &library.textures[texture];
        Self { id: entry.id.clone(), weight, licence: library.license_of(entry).to_owned() }
    }
}

/// Whether bytes are the sidecar of a signal, of whatever version.
pub fn is_sidecar(bytes: &[u8]) -> bool {
    let json: Option<serde_json::Value> = serde_json::from_slice(bytes).ok();
    json.is_some_and(|json| json["format"] == FORMAT)
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
    /// There are more samples than [`MAX_SAMPLES`].
    #[error(
        "a WAV file holds at most {MAX_SAMPLES} samples, the signal has {n_samples}; make it shorter or lower its rate"
    )]
    TooLong {
        /// Samples of the signal.
        n_samples: u64,
    },
    /// The samples cannot be packed.
    #[error("the signal cannot be packed as WAV; choose another rate")]
    Pack(#[from] hound::Error),
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// The sidecar of a WAV file: the same name with `.json`.
pub fn sidecar_path(wav: &Path) -> PathBuf {
    wav.with_extension("json")
}

/// What may stand for the sidecar of a WAV file that is read: the name that is written, and `.json` behind the whole name.
pub fn sidecar_names(wav_name: &str) -> [String; 2] {
    let stem = wav_name.rsplit_once('.').map_or(wav_name, |(stem, _)| stem);
    [format!("{stem}.json"), format!("{wav_name}.json")]
}

/// Says whether so many samples fit a WAV file, before anybody works them out.
///
/// # Errors
/// [`WavWriteError::TooLong`].
pub fn check_length(n_samples: u64) -> Result<(), WavWriteError> {
    if n_samples > MAX_SAMPLES { Err(WavWriteError::TooLong { n_samples }) } else { Ok(()) }
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

/// Writes samples alone, -1 to 1 of digital full scale: for what is played and has no unit.
///
/// # Errors
/// See [`WavWriteError`]; a file that was there is then as it was.
pub fn write_samples(path: &Path, samples: &[f32], rate_hz: u32) -> Result<(), WavWriteError> {
    atomic::write(path, &pack(samples, rate_hz)?)?;
    Ok(())
}

/// Samples as the bytes of a WAV file of 32-bit floats.
fn pack(samples: &[f32], rate_hz: u32) -> Result<Vec<u8>, WavWriteError> {
    check_length(samples.len() as u64)?;
    let spec = WavSpec {
        channels: 1,
        sample_rate: rate_hz,
        bits_per_sample: 32,
        sample_format: SampleFormat::Float,
    };
    let mut bytes = Cursor::new(Vec::with_capacity(HEADER_BYTES as usize + size_of_val(samples)));
    let mut writer = WavWriter::new(&mut bytes, spec)?;
    for sample in samples {
        writer.write_sample(*sample)?;
    }
    writer.finalize()?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::{
        FORMAT, HEADER_BYTES, MAX_SAMPLES, ParentV1, SidecarV1, TraceV1, UNITS, VERSION, WavWriteError,
        check_length, pack, sidecar_path, write_wav,
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
            extrapolated: false,
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
        let mut reader = hound::WavReader::open(&path).unwrap();
        assert_eq!((reader.spec().channels, reader.spec().sample_rate), (1, 1000));
        let samples: Vec<f32> = reader.samples().map(Result::unwrap).collect();
        assert_eq!(samples, [0.25, -7.5, 1e-9]);
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
    fn what_32_bits_cannot_count_is_refused() {
        let header = pack(&[], 1000).unwrap();
        assert_eq!(header.len(), HEADER_BYTES as usize);
        assert!(check_length(MAX_SAMPLES).is_ok());
        let fits = |n_samples: u64| u32::try_from(4 * n_samples + u64::from(HEADER_BYTES)).is_ok();
        assert!(fits(MAX_SAMPLES) && !fits(MAX_SAMPLES + 1));
        let error = check_length(MAX_SAMPLES + 1).unwrap_err();
        assert!(matches!(error, WavWriteError::TooLong { n_samples } if n_samples == MAX_SAMPLES + 1));
    }
}
