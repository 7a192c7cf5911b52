//! Import of a folder of strokes in several directions: each texture of the folder becomes one model.

mod angles;
mod counted_messages;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use shagreen_core::dsp::spectrum::median;
use shagreen_core::recording::Recording;
use shagreen_core::recording::fit::directional::{DirectedRecording, DirectionReport, fit_directions};
use shagreen_core::recording::fit::{FitError, FitOptions};
use shagreen_core::recording::segment::MIN_SPEED;
use shagreen_core::words::counted;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::library::{TextureEntry, id_from_name, name_from_file};
use shagreen_formats::recording::directional::{
    NamedDirections, StrokeBytes, StrokeFiles, StrokeFolder, StrokeFolderError, TextureStrokes, find_strokes,
    name_directions, read_stroke,
};

use crate::file::{file_name, in_file, read_file};
use crate::import::directional::angles::angles_rad;
use crate::import::directional::counted_messages::CountedMessages;

/// Ratio of the measured speed to that of the file name, or its inverse, from which on it is reported.
const OTHER_SPEED: f64 = 2.0;

/// Options of the import.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionalOptions {
    /// Options of the fit.
    pub fit: FitOptions,
    /// Stated angles in degrees, counterclockwise from the x axis, by the direction as the file names write it.
    pub stated_deg: BTreeMap<String, f64>,
    /// Terms of use of the textures.
    pub license: String,
}

/// Texture fitted to strokes in several directions.
#[derive(Clone, Debug)]
pub struct DirectionalTexture {
    /// The texture; its id is that of its name.
    pub entry: TextureEntry,
    /// Directions, lay and quality.
    pub report: DirectionReport,
    /// Angles in rad that were used, by the direction as the file names write it.
    pub angles_rad: BTreeMap<String, f64>,
    /// Number of strokes that were read.
    pub n_strokes: usize,
    /// Phrase on the strokes, their directions and the lay; also in the origin of the texture.
    pub summary: String,
}

/// Result of importing one texture.
#[derive(Clone, Debug)]
pub struct DirectionalOutcome {
    /// The texture, or why there is none.
    pub texture: Result<DirectionalTexture, DirectionalError>,
    /// Files that cannot be read, and why; their strokes are left out.
    pub failed: Vec<(PathBuf, String)>,
    /// Sentences for the user. Equal ones of several strokes are counted.
    pub warnings: Vec<String>,
}

/// Why a texture of a folder has no model.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum DirectionalError {
    /// No stroke can be read.
    Unreadable {
        /// Name of the first file that cannot be used.
        file: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The angles of these directions, as the file names write them, are unknown. Positions or stated angles help; the
    /// program that shows the error says how it takes them.
    UnknownDirections(Vec<String>),
    /// The strokes cannot be fitted.
    Fit(FitError),
}

impl fmt::Display for DirectionalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable { file, reason } => {
                write!(f, "no stroke of this texture can be read; {file}: {reason}")
            }
            Self::UnknownDirections(directions) => {
                write!(f, "no angle is known for the directions {}", directions.join(", "))
            }
            Self::Fit(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for DirectionalError {}

/// Finds the strokes in a folder and its subfolders.
///
/// # Errors
/// The folder cannot be listed, or has no strokes; the message says how to name them.
pub fn find(folder: &Path) -> anyhow::Result<StrokeFolder> {
    match find_strokes(folder) {
        Ok(found) => Ok(found),
        // This error names the folder itself, which may be a subfolder.
        Err(error @ StrokeFolderError::List { .. }) => Err(error.into()),
        Err(error) => Err(error).with_context(|| in_file(folder)),
    }
}

/// Interprets the directions of all textures of a folder.
pub fn directions_of(textures: &[TextureStrokes]) -> NamedDirections {
    let texts: BTreeSet<&str> = textures.iter().flat_map(TextureStrokes::directions).collect();
    name_directions(&texts)
}

/// Reads the strokes on one texture and fits a model. `named` are the directions of its folder ([`directions_of`]).
///
/// The angle of a direction is the stated one, otherwise that of its name, otherwise that of the positions, otherwise
/// that of a number from 0 to 7 or 1 to 8.
pub fn import_texture(
    texture: &TextureStrokes,
    named: &NamedDirections,
    options: &DirectionalOptions,
) -> DirectionalOutcome {
    let mut messages = CountedMessages::default();
    let (mut read, mut failed) = (Vec::new(), Vec::new());
    for stroke in &texture.strokes {
        match read_one(stroke, &mut messages) {
            Ok(one) => read.push(one),
            Err(failure) => failed.push(failure),
        }
    }
    let mut warnings = messages.into_sentences();
    let texture = match failed.first() {
        Some((file, reason)) if read.is_empty() => {
            Err(DirectionalError::Unreadable { file: file_name(file), reason: reason.clone() })
        }
        _ => fitted(texture, read, named, options, &mut warnings),
    };
    DirectionalOutcome { texture, failed, warnings }
}

/// Stroke that was read.
struct ReadStroke<'a> {
    /// Direction as the file name writes it.
    direction: &'a str,
    recording: Recording,
    /// Direction of the positions in rad.
    moved_rad: Option<f64>,
}

/// Reads a stroke, or returns the file that cannot be used, and why.
fn read_one<'a>(
    stroke: &'a StrokeFiles,
    messages: &mut CountedMessages,
) -> Result<ReadStroke<'a>, (PathBuf, String)> {
    let bytes = |path: &Path| {
        read_file(path, FileKind::Recording)
            .map_err(|error| (path.to_owned(), error.root_cause().to_string()))
    };
    let acceleration = bytes(&stroke.acceleration)?;
    let force = stroke.force.as_deref().map(bytes).transpose()?;
    let position = stroke.position.as_deref().map(bytes).transpose()?;
    let bytes =
        StrokeBytes { acceleration: &acceleration, force: force.as_deref(), position: position.as_deref() };
    let read = read_stroke(&stroke.name, &bytes)
        .map_err(|error| (stroke.path_of(error.quantity).to_owned(), error.to_string()))?;
    let (converted, findings) = match Recording::from_raw(read.raw) {
        Ok((recording, findings)) => (Ok(recording), findings),
        Err(error) => (Err((stroke.acceleration.clone(), error.to_string())), error.findings),
    };
    let unusual = findings.iter().filter(|finding| !finding.is_ordinary()).map(ToString::to_string);
    for message in read.warnings.into_iter().chain(unusual) {
        messages.add(&message, &stroke.acceleration);
    }
    let recording = converted?;
    if is_other_speed(&recording, stroke.name.speed.0) {
        messages.add(
            "the measured speed is less than half or more than twice that of the file name; the measured speed is used",
            &stroke.acceleration,
        );
    }
    Ok(ReadStroke { direction: &stroke.name.direction, recording, moved_rad: read.direction_rad })
}

/// Whether the median speed of the moving tip is far from the stated one.
fn is_other_speed(recording: &Recording, stated_mps: f64) -> bool {
    let usable = recording.usable.iter().flat_map(|range| &recording.speed_mps[range.clone()]);
    let moving: Vec<f64> = usable.copied().filter(|speed_mps| *speed_mps >= MIN_SPEED.0).collect();
    let ratio = median(moving) / stated_mps;
    // A tip that never moves has no median; the fit reports that.
    ratio.is_finite() && !(OTHER_SPEED.recip()..=OTHER_SPEED).contains(&ratio)
}

/// Fits the model to the strokes of one texture.
fn fitted(
    texture: &TextureStrokes,
    strokes: Vec<ReadStroke<'_>>,
    named: &NamedDirections,
    options: &DirectionalOptions,
    warnings: &mut Vec<String>,
) -> Result<DirectionalTexture, DirectionalError> {
    let moved: Vec<(&str, Option<f64>)> =
        strokes.iter().map(|stroke| (stroke.direction, stroke.moved_rad)).collect();
    let angles_rad = angles_rad(&moved, named, &options.stated_deg, warnings)?;
    let n_strokes = strokes.len();
    let directed = strokes.into_iter().map(|stroke| DirectedRecording {
        // Every direction has an angle, or there would be an error.
        direction_rad: angles_rad.get(stroke.direction).copied().unwrap_or(f64::NAN),
        recording: stroke.recording,
    });
    let fitted = fit_directions(directed.collect(), &options.fit).map_err(DirectionalError::Fit)?;
    warnings.extend(fitted.report.notes.iter().cloned());
    let name = name_from_file(&format!("{}.csv", texture.texture));
    let summary = summary(&fitted.report, n_strokes);
    let entry = TextureEntry {
        license: options.license.clone(),
        origin: format!("Fitted to {summary}"),
        ..TextureEntry::new(id_from_name(&name), name, fitted.model)
    };
    Ok(DirectionalTexture { entry, report: fitted.report, angles_rad, n_strokes, summary })
}

/// Phrase on the strokes, their directions and the lay.
fn summary(report: &DirectionReport, n_strokes: usize) -> String {
    let directions = counted(report.directions.len(), "direction");
    let lay = match (report.lay_rad, report.modulation_db) {
        (Some(lay_rad), Some(modulation_db)) => {
            format!("lay at {:.0}°, {modulation_db:.1} dB quieter than across it", lay_rad.to_degrees())
        }
        (None, Some(modulation_db)) => format!("isotropic, {modulation_db:.1} dB over direction"),
        (_, None) => "isotropic, since the directions do not show a lay".to_owned(),
    };
    format!("{} in {directions}: {lay}", counted(n_strokes, "stroke"))
}
