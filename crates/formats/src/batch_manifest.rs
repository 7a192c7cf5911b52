//! Manifests of batches: which textures are rendered along which strokes to which files, as TOML files.
//!
//! ```toml
//! format = "shagreen-batch"
//! version = "1.0"
//! name = "Catalogue"
//! library = "materials.json"      # beside the manifest; or "starter", "simulated", or: project = "woods.shagreen"
//! seed = 1                        # of the noise of all signals
//!
//! [[texture]]
//! all = true                      # every texture of the library
//!
//! [[texture]]
//! at = [[30, 70], [40.5, 60]]     # points of the space, or: ids = ["cork"], authored = ["Mine"], path = [[…], […]]
//! blend = "field"
//! shape = "level=-3"
//!
//! [[stroke]]
//! id = "slow"
//! speed_mm_per_s = 60             # or: file = "scribble.csv"
//! force_n = 0.5
//! seconds = 10
//!
//! [[output]]
//! id = "wav"                      # name of its folder
//! format = "wav"                  # as in `shagreen export --format`
//! rate_hz = 8000
//! bits = 16
//! ```
//!
//! Each texture is rendered along each stroke for each output. An unknown key is an error, because its value would have no
//! effect. All problems are reported at once, each with its line and key.

mod keys;
mod read;

use shagreen_core::space::texture_path::{Along, AtEnd};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::shape::Shape;
use shagreen_core::words::counted;

use crate::toml_lines::{Lines, LocatedProblem, listed};
use crate::toml_text;
use crate::wav_encoding::WavEncoding;

use self::keys::KeyProblem;
use self::read::manifest_of;

/// Value of the `format` key.
pub const FORMAT: &str = "shagreen-batch";
/// Version that this program reads.
pub const VERSION: &str = "1.0";
/// Number of problems that are reported; of more, the first ones.
const MOST_PROBLEMS: usize = 100;

/// What a batch renders.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchManifest {
    /// Name to show.
    pub name: String,
    /// Where the textures come from.
    pub source: BatchSource,
    /// Random seed of the noise of all signals.
    pub seed: u64,
    /// Textures, at least one choice.
    pub textures: Vec<BatchTexture>,
    /// Strokes; none if all outputs are texture models.
    pub strokes: Vec<BatchStroke>,
    /// Kinds of files, at least one.
    pub outputs: Vec<BatchOutput>,
}

/// Where the textures of a batch come from. Paths are relative to the folder of the manifest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BatchSource {
    /// A library file, a folder of them, or the name of a built-in library.
    Library(String),
    /// A project file.
    Project(String),
}

impl BatchSource {
    /// Keys of which one names the source.
    pub const KEYS: [&str; 2] = ["library", "project"];

    /// Key that names this source.
    pub fn key(&self) -> &'static str {
        match self {
            Self::Library(_) => Self::KEYS[0],
            Self::Project(_) => Self::KEYS[1],
        }
    }
}

/// Textures of a batch that are chosen together.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchTexture {
    /// Which textures.
    pub choice: BatchChoice,
    /// Interpolation mode of points and paths.
    pub blend: Mode,
    /// Shape; `None` keeps that of an authored texture, and is neutral for others.
    pub shape: Option<Shape>,
}

/// Which textures are rendered.
#[derive(Clone, Debug, PartialEq)]
pub enum BatchChoice {
    /// Every texture of the library or project.
    All,
    /// Textures of the library or project, by their identifiers.
    Ids(Vec<String>),
    /// Authored textures of the project, by name or number.
    Authored(Vec<String>),
    /// Points of the space, by their coordinates.
    Points(Vec<Vec<f64>>),
    /// A texture that changes along the stroke.
    Path(BatchPath),
}

/// A path through the space, with points at equal distances along the stroke.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchPath {
    /// Name of the texture.
    pub name: String,
    /// Coordinates of its points, at least two.
    pub points: Vec<Vec<f64>>,
    /// Quantity along the stroke.
    pub along: Along,
    /// Length of the path in m, or in s along time.
    pub length: f64,
    /// Behavior at its end.
    pub at_end: AtEnd,
}

/// A stroke of a batch.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchStroke {
    /// Identifier, a part of the names of files.
    pub id: String,
    /// How the tip moves.
    pub motion: BatchMotion,
}

/// How the tip moves.
#[derive(Clone, Debug, PartialEq)]
pub enum BatchMotion {
    /// Constant speed and force.
    Steady {
        /// Tip speed in mm/s.
        speed_mm_per_s: f64,
        /// Normal force in N.
        force_n: f64,
        /// Duration in s.
        seconds: f64,
    },
    /// A recorded stroke, by its path relative to the folder of the manifest.
    File(String),
}

/// A kind of files.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchOutput {
    /// Identifier, the name of the folder of its files.
    pub id: String,
    /// Identifier of the export format.
    pub format: String,
    /// Sample rate in Hz; `None` for the model rate of each texture.
    pub rate_hz: Option<u32>,
    /// Encoding, for formats that store samples.
    pub encoding: WavEncoding,
    /// Whether the end of each signal goes on into its beginning.
    pub loops: bool,
    /// Acceleration in m/s² that files store as 1; `None` lets each signal use the range of its file.
    pub full_scale_mps2: Option<f64>,
    /// Actuator that shall play the files: a built-in one by its identifier, or a profile file.
    pub actuator: Option<String>,
    /// Identifiers of its strokes; `None` for all strokes.
    pub strokes: Option<Vec<String>>,
    /// Keys of signals that the manifest states; a format of texture models has none of them.
    pub stated: Vec<&'static str>,
}

/// Why bytes are not a manifest that can be run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BatchManifestError {
    /// The file is not UTF-8.
    #[error("the manifest is not valid UTF-8 at byte {at}; save the file as UTF-8")]
    NotText {
        /// Offset of the first invalid byte, from zero.
        at: usize,
    },
    /// Not TOML.
    #[error("cannot read the manifest: {reason}; correct that line of the file")]
    Damaged {
        /// The parser's message with its line number, on one line.
        reason: String,
    },
    /// The file has another format.
    #[error(
        "the file is not the manifest of a batch: `format` is {found}, not \"{FORMAT}\"; choose another file, or write format = \"{FORMAT}\""
    )]
    Format {
        /// Value of the `format` key, or "missing".
        found: String,
    },
    /// The file has an unsupported version.
    #[error(
        "the manifest has version {found}, but this program reads version \"{VERSION}\"; use another version of Shagreen"
    )]
    Version {
        /// Value of the `version` key, or "missing".
        found: String,
    },
    /// The manifest cannot be run.
    #[error("the manifest has {}: {}", counted(.0.len(), "problem"), listed(.0))]
    Problems(Vec<LocatedProblem>),
}

/// Reads a manifest. Whether its textures, formats and files exist is not checked.
///
/// # Errors
/// See [`BatchManifestError`].
pub fn read_batch_manifest(bytes: &[u8]) -> Result<BatchManifest, BatchManifestError> {
    let (manifest, problems) = batch_manifest_with_problems(bytes)?;
    if problems.is_empty() {
        return Ok(manifest);
    }
    Err(batch_problems(&String::from_utf8_lossy(bytes), problems))
}

/// Reads a manifest that may have problems, and returns them, each a key and what is wrong ([`batch_problems`]). A value with a
/// problem has a default, so that problems of other kinds can be looked for too.
///
/// # Errors
/// See [`BatchManifestError`]: all but [`BatchManifestError::Problems`].
pub fn batch_manifest_with_problems(
    bytes: &[u8],
) -> Result<(BatchManifest, Vec<(String, String)>), BatchManifestError> {
    let text = std::str::from_utf8(bytes)
        .map_err(|error| BatchManifestError::NotText { at: error.valid_up_to() })?;
    let table: toml::Table = toml::from_str(text)
        .map_err(|error| BatchManifestError::Damaged { reason: toml_text::reason(&error, text) })?;
    // The header is checked first: in a newer version, unknown keys are not an error.
    let found = |key: &str| table.get(key).map_or_else(|| "missing".to_owned(), shown);
    if table.get("format").and_then(toml::Value::as_str) != Some(FORMAT) {
        return Err(BatchManifestError::Format { found: found("format") });
    }
    if table.get("version").and_then(toml::Value::as_str) != Some(VERSION) {
        return Err(BatchManifestError::Version { found: found("version") });
    }
    let mut problems = Vec::new();
    let manifest = manifest_of(&table, &mut problems);
    Ok((manifest, problems.into_iter().map(|KeyProblem { key, text }| (key, text)).collect()))
}

/// Returns the error for problems that were found later, such as textures that do not exist, with the lines of their keys.
/// `text` is the text of the file; a problem is a key, such as `texture[2].ids`, and what is wrong.
pub fn batch_problems(text: &str, problems: Vec<(String, String)>) -> BatchManifestError {
    let lines = Lines::of(text);
    let located = |(key, text): (String, String)| LocatedProblem { line: lines.line_of(&key), key, text };
    BatchManifestError::Problems(problems.into_iter().take(MOST_PROBLEMS).map(located).collect())
}

/// Longest value in an error, in characters.
const SHOWN: usize = 40;

/// A value for an error.
fn shown(value: &toml::Value) -> String {
    match value {
        toml::Value::String(text) if text.chars().count() <= SHOWN => format!("\"{text}\""),
        toml::Value::String(_) => "a long text".to_owned(),
        toml::Value::Array(_) => "a list".to_owned(),
        toml::Value::Table(_) => "a table".to_owned(),
        toml::Value::Integer(number) => number.to_string(),
        toml::Value::Float(number) => number.to_string(),
        toml::Value::Boolean(flag) => flag.to_string(),
        toml::Value::Datetime(time) => time.to_string(),
    }
}

#[cfg(test)]
mod tests;
