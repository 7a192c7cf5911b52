//! Signals as WAV files with a sidecar file that states their units.
//!
//! A WAV file has no units, so `out.json` ([`SidecarV1`]) lies next to `out.wav`. Either both are written or neither.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::atomic::{self, WriteError};
use crate::layout;
use crate::library::Library;
use crate::wav_encoding::{HEADER_BYTES, SampleType, WavEncoding, pack};

/// Value of the `format` field of a sidecar.
pub const FORMAT: &str = "shagreen-signal";
/// Version of the sidecar format.
pub const VERSION: &str = "1.0";
/// Value of the `units` field of a sidecar.
pub const UNITS: &str = "m/s^2";

/// Maximum number of samples in a WAV file, which counts its bytes in 32 bits.
pub const MAX_SAMPLES: u64 = ((u32::MAX - HEADER_BYTES) / 4) as u64;

/// Meaning and origin of the samples of a WAV file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SidecarV1 {
    /// [`FORMAT`].
    pub format: String,
    /// [`VERSION`].
    pub version: String,
    /// Unit of the samples, [`UNITS`].
    pub units: String,
    /// Value of a sample of 1.0, in `units`.
    pub full_scale: f64,
    /// Contents of each channel.
    pub channels: Vec<String>,
    /// Sample rate in Hz.
    pub rate_hz: u32,
    /// Duration in s.
    pub seconds: f64,
    /// Name of the texture, if it has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Identifier of the texture, if a library texture was rendered.
    pub texture: Option<String>,
    /// Position in the space, one coordinate (0..100) for each axis, usually rough-smooth and hard-soft, if an authored
    /// texture was rendered.
    pub at: Option<Vec<f64>>,
    /// The same position by the names of the axes ([`crate::named_point`]); absent without a position, and in older files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_named: Option<BTreeMap<String, f64>>,
    /// Whether that position was moved to the convex hull of the textures.
    pub clamped: bool,
    /// Whether the texture was extrapolated to a position outside the convex hull, beyond all measurements.
    #[serde(default)]
    pub extrapolated: bool,
    /// Interpolation mode of the parent textures.
    pub blend: String,
    /// Shape of the texture, as on the command line; absent if it is neutral.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<String>,
    /// The textures that were interpolated.
    pub parents: Vec<ParentV1>,
    /// Name of the library.
    pub library: String,
    /// What the positions of its textures were derived from: `human`, `simulated`, `physical` or `estimated`.
    pub label_source: Option<String>,
    /// Random seed of the noise.
    pub seed: u64,
    /// File name of the stroke, if there is one.
    pub stroke: Option<String>,
    /// Speed and force over time.
    pub trace: TraceV1,
    /// The program that wrote it, with its version.
    pub created_by: String,
}

impl SidecarV1 {
    /// The sidecar of a signal with one channel in m/s²; the caller fills in the texture and the stroke.
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
            name: None,
            texture: None,
            at: None,
            at_named: None,
            clamped: false,
            extrapolated: false,
            blend: String::new(),
            shape: None,
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
    /// A texture of a library with its weight.
    pub fn new(library: &Library, texture: usize, weight: f64) -> Self {
        let entry = &library.textures[texture];
        Self { id: entry.id.clone(), weight, licence: library.license_of(entry).to_owned() }
    }
}

/// Returns whether bytes are the sidecar of a signal, of any version.
pub fn is_sidecar(bytes: &[u8]) -> bool {
    let json: Option<serde_json::Value> = serde_json::from_slice(bytes).ok();
    json.is_some_and(|json| json["format"] == FORMAT)
}

/// A texture that contributes to an interpolated one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ParentV1 {
    /// Identifier of the texture.
    pub id: String,
    /// Its weight, 0..1.
    pub weight: f64,
    /// Its terms of use.
    pub licence: String,
}

/// The stroke of the tip: columns of equal length; time, speed, force and position are linearly interpolated.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TraceV1 {
    /// Times from the first sample of the signal, in s.
    pub time_s: Vec<f64>,
    /// Speeds in mm/s.
    pub speed_mm_per_s: Vec<f64>,
    /// Normal forces in N; zero while the tip is lifted.
    pub force_n: Vec<f64>,
    /// Positions to the right in mm; absent if only the speed is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x_mm: Option<Vec<f64>>,
    /// Positions upwards in mm; absent if only the speed is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y_mm: Option<Vec<f64>>,
    /// Speeds in mm/s at which the tip lands, at the first time of each contact whose impact speed is stated, and null at
    /// all other times; absent if none is stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed_normal_mm_per_s: Option<Vec<Option<f64>>>,
}

/// Why a signal was not written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WavWriteError {
    /// The file would overwrite its own sidecar.
    #[error("the name of a signal file cannot end in .json, because its sidecar file has this name; use the ending .wav: {}", path.display())]
    Name {
        /// The requested path.
        path: PathBuf,
    },
    /// The signal has more than [`MAX_SAMPLES`] samples.
    #[error(
        "a WAV file holds at most {MAX_SAMPLES} samples, but the signal has {n_samples}; shorten it or lower its sample rate"
    )]
    TooLong {
        /// Number of samples of the signal.
        n_samples: u64,
    },
    /// The samples cannot be encoded.
    #[error("cannot encode the signal as WAV; choose another sample rate")]
    Pack(#[from] hound::Error),
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// Path of the sidecar of a WAV file: the same name with `.json`.
pub fn sidecar_path(wav: &Path) -> PathBuf {
    wav.with_extension("json")
}

/// File names that are accepted as the sidecar of a WAV file: the one that is written, and the full name followed by
/// `.json`.
pub fn sidecar_names(wav_name: &str) -> [String; 2] {
    let stem = wav_name.rsplit_once('.').map_or(wav_name, |(stem, _)| stem);
    [format!("{stem}.json"), format!("{wav_name}.json")]
}

/// Checks whether a number of samples fits a WAV file, before they are computed.
///
/// # Errors
/// [`WavWriteError::TooLong`].
pub fn check_length(n_samples: u64) -> Result<(), WavWriteError> {
    if n_samples > MAX_SAMPLES { Err(WavWriteError::TooLong { n_samples }) } else { Ok(()) }
}

/// Writes samples in m/s² as 32-bit floats, and their sidecar; either both or neither.
///
/// # Errors
/// See [`WavWriteError`]; existing files are then unchanged.
pub fn write_wav(path: &Path, samples: &[f32], sidecar: &SidecarV1) -> Result<(), WavWriteError> {
    write_wav_as(path, samples, sidecar, WavEncoding::default())
}

/// As [`write_wav`], in another encoding. The `full_scale` of the sidecar that is written follows the scaling, so that it
/// still states the acceleration of a sample of 1.
///
/// # Errors
/// See [`WavWriteError`]; existing files are then unchanged.
pub fn write_wav_as(
    path: &Path,
    samples: &[f32],
    sidecar: &SidecarV1,
    encoding: WavEncoding,
) -> Result<(), WavWriteError> {
    write_wav_scaled(path, samples, sidecar, (encoding.samples, encoding.full_scale(samples)))
}

/// As [`write_wav_as`], with this type of the samples, and with the acceleration of a sample of 1 in the unit of `samples`, above
/// zero. Signals that are written at one scale keep the differences between their levels. Integers are clipped at full scale.
///
/// # Errors
/// See [`WavWriteError`]; existing files are then unchanged.
pub fn write_wav_scaled(
    path: &Path,
    samples: &[f32],
    sidecar: &SidecarV1,
    (of, scale): (SampleType, f64),
) -> Result<(), WavWriteError> {
    let beside = sidecar_path(path);
    if beside == path {
        return Err(WavWriteError::Name { path: path.to_path_buf() });
    }
    check_length(samples.len() as u64)?;
    let wav = pack(samples, scale, sidecar.rate_hz, of)?;
    let full_scale = scale * sidecar.full_scale;
    // One line per field, and one per row of the trace.
    let json = layout::to_bytes(&SidecarV1 { full_scale, ..sidecar.clone() }, 2);
    atomic::write_all(&[(path, &wav), (&beside, &json)])?;
    Ok(())
}

/// Writes only samples, -1 to 1 of digital full scale, for drive signals without a unit.
///
/// # Errors
/// See [`WavWriteError`]; an existing file is then unchanged.
pub fn write_samples(path: &Path, samples: &[f32], rate_hz: u32) -> Result<(), WavWriteError> {
    check_length(samples.len() as u64)?;
    atomic::write(path, &pack(samples, 1.0, rate_hz, SampleType::Float32)?)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{
        FORMAT, HEADER_BYTES, MAX_SAMPLES, ParentV1, SidecarV1, TraceV1, UNITS, VERSION, WavWriteError,
        check_length, sidecar_path, write_wav, write_wav_as, write_wav_scaled,
    };
    use crate::wav_encoding::{Level, SampleType, WavEncoding, pack};
    use std::collections::BTreeMap;
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
            name: None,
            texture: None,
            at: Some(vec![30.0, 70.0]),
            at_named: Some(BTreeMap::from([("a-b".into(), 30.0), ("c".into(), 70.0)])),
            clamped: false,
            extrapolated: false,
            blend: "shared".into(),
            shape: None,
            parents: vec![ParentV1 { id: "cork".into(), weight: 1.0, licence: "CC0-1.0".into() }],
            library: "Starter".into(),
            label_source: Some("physical".into()),
            seed: 5,
            stroke: None,
            trace: TraceV1 {
                time_s: vec![0.0, 0.003],
                speed_mm_per_s: vec![100.0; 2],
                force_n: vec![1.0; 2],
                x_mm: Some(vec![0.0, 0.3]),
                y_mm: Some(vec![0.0; 2]),
                speed_normal_mm_per_s: Some(vec![Some(50.0), None]),
            },
            created_by: "shagreen".into(),
        }
    }

    #[test]
    fn samples_and_sidecar_come_back_exactly() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.wav");
        // Values above one are kept, because the unit is m/s², not a fraction of full scale.
        write_wav(&path, &[0.25, -7.5, 1e-9], &sidecar()).unwrap();
        let mut reader = hound::WavReader::open(&path).unwrap();
        assert_eq!((reader.spec().channels, reader.spec().sample_rate), (1, 1000));
        let samples: Vec<f32> = reader.samples().map(Result::unwrap).collect();
        assert_eq!(samples, [0.25, -7.5, 1e-9]);
        let beside: SidecarV1 = serde_json::from_slice(&fs::read(sidecar_path(&path)).unwrap()).unwrap();
        assert_eq!(beside, sidecar());
        // A sidecar of an earlier version states no names.
        let mut older = serde_json::to_value(sidecar()).unwrap();
        assert_eq!(older["at_named"]["c"], 70.0);
        older.as_object_mut().unwrap().remove("at_named");
        let read: SidecarV1 = serde_json::from_value(older).unwrap();
        assert_eq!(read, SidecarV1 { at_named: None, ..sidecar() });
    }

    /// What a player plays is below full scale, and the sidecar gives the acceleration back.
    #[test]
    fn peaks_fit_every_player_and_the_sidecar_undoes_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.wav");
        let given = [0.25, -7.5, 3.0, 0.0];
        for (samples, bits, step) in [
            (SampleType::Float32, 32, 1e-7),
            (SampleType::Pcm24, 24, 1.2e-7),
            (SampleType::Pcm16, 16, 3.1e-5),
        ] {
            write_wav_as(&path, &given, &sidecar(), WavEncoding { samples, level: Level::Peak }).unwrap();
            let beside: SidecarV1 = serde_json::from_slice(&fs::read(sidecar_path(&path)).unwrap()).unwrap();
            let mut reader = hound::WavReader::open(&path).unwrap();
            assert_eq!(reader.spec().bits_per_sample, bits);
            let full = f64::from(2.0_f32.powi(i32::from(bits) - 1) - 1.0);
            let read: Vec<f64> = match samples {
                SampleType::Float32 => reader.samples::<f32>().map(|x| f64::from(x.unwrap())).collect(),
                _ => reader.samples::<i32>().map(|x| f64::from(x.unwrap()) / full).collect(),
            };
            let peak = read.iter().fold(0.0_f64, |peak, x| peak.max(x.abs()));
            assert!((peak - 10_f64.powf(-0.05)).abs() < 1e-4, "{peak}");
            for (x, expected) in read.iter().zip(given) {
                assert!(
                    (x * beside.full_scale - f64::from(expected)).abs() < step * beside.full_scale,
                    "{x}"
                );
            }
        }
        // Silence has no peak; integers cannot hold the level of floats, so it is not kept.
        write_wav_as(
            &path,
            &[0.0; 4],
            &sidecar(),
            WavEncoding { samples: SampleType::Pcm16, level: Level::Kept },
        )
        .unwrap();
        let beside: SidecarV1 = serde_json::from_slice(&fs::read(sidecar_path(&path)).unwrap()).unwrap();
        assert_eq!(beside.full_scale, 1.0);
    }

    #[test]
    fn signals_at_one_scale_keep_the_ratio_of_their_levels() {
        let folder = tempfile::tempdir().unwrap();
        let [loud, quiet] = [[0.5_f32, -4.0], [0.25, -2.0]];
        let scale = WavEncoding { samples: SampleType::Pcm16, level: Level::Peak }.full_scale(&loud);
        let read = |name: &str, samples: &[f32]| {
            let path = folder.path().join(name);
            write_wav_scaled(&path, samples, &sidecar(), (SampleType::Pcm16, scale)).unwrap();
            let mut reader = hound::WavReader::open(&path).unwrap();
            reader.samples::<i32>().map(|x| f64::from(x.unwrap())).collect::<Vec<f64>>()
        };
        let (loud, quiet) = (read("loud.wav", &loud), read("quiet.wav", &quiet));
        // Each number is rounded to a whole one.
        assert!(loud.iter().zip(&quiet).all(|(loud, quiet)| (loud - 2.0 * quiet).abs() <= 1.5), "{quiet:?}");
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
        let header = pack(&[], 1.0, 1000, SampleType::Float32).unwrap();
        assert_eq!(header.len(), HEADER_BYTES as usize);
        assert!(check_length(MAX_SAMPLES).is_ok());
        let fits = |n_samples: u64| u32::try_from(4 * n_samples + u64::from(HEADER_BYTES)).is_ok();
        assert!(fits(MAX_SAMPLES) && !fits(MAX_SAMPLES + 1));
        let error = check_length(MAX_SAMPLES + 1).unwrap_err();
        assert!(matches!(error, WavWriteError::TooLong { n_samples } if n_samples == MAX_SAMPLES + 1));
    }
}
