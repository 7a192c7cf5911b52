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
    /// Whether the end goes on into the beginning, so that the signal can be repeated; absent if it does not.
    #[serde(default, rename = "loop", skip_serializing_if = "std::ops::Not::not")]
    pub loops: bool,
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
            loops: false,
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

impl TraceV1 {
    /// Times in s at which the tip lands: where the force begins, and at the start if an impact is stated there.
    pub fn landings_secs(&self) -> Vec<f64> {
        let touches: Vec<bool> = self.force_n.iter().map(|force_n| *force_n > 0.0).collect();
        let impacts = self.speed_normal_mm_per_s.as_deref().unwrap_or_default();
        let lands_at_start = impacts.first().is_some_and(|first| first.is_some_and(|impact| impact > 0.0));
        let lands = |(i, touches_now): (usize, &bool)| {
            let was_lifted = match i.checked_sub(1) {
                Some(before) => !touches[before],
                None => lands_at_start,
            };
            (*touches_now && was_lifted).then(|| self.time_s.get(i).copied())?
        };
        touches.iter().enumerate().filter_map(lands).collect()
    }

    /// Speed in mm/s and force in N if they are the same at all times.
    pub fn steady(&self) -> Option<(f64, f64)> {
        let same = |values: &[f64]| {
            let first = *values.first()?;
            values.iter().all(|value| *value == first).then_some(first)
        };
        Some((same(&self.speed_mm_per_s)?, same(&self.force_n)?))
    }
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
    let [wav, json] = wav_bytes(samples, sidecar, (of, scale))?;
    atomic::write_all(&[(path, &wav), (&beside, &json)])?;
    Ok(())
}

/// Returns the bytes of the two files that [`write_wav_scaled`] writes: the WAV file and its sidecar.
///
/// # Errors
/// [`WavWriteError::TooLong`] and [`WavWriteError::Pack`].
pub fn wav_bytes(
    samples: &[f32],
    sidecar: &SidecarV1,
    (of, scale): (SampleType, f64),
) -> Result<[Vec<u8>; 2], WavWriteError> {
    check_length(samples.len() as u64)?;
    let wav = pack(samples, scale, sidecar.rate_hz, of)?;
    let full_scale = scale * sidecar.full_scale;
    // One line per field, and one per row of the trace.
    let json = layout::to_bytes(&SidecarV1 { full_scale, ..sidecar.clone() }, 2);
    Ok([wav, json])
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
mod tests;
