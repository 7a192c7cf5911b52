//! A manifest from the keys of its file.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use shagreen_core::space::texture_path::{Along, AtEnd, MAX_KEYS};
use shagreen_core::texture::blend::Mode;
use toml::Table;

use crate::batch_manifest::keys::{KeyProblem, Keys};
use crate::batch_manifest::{
    BatchChoice, BatchManifest, BatchMotion, BatchOutput, BatchPath, BatchSource, BatchStroke, BatchTexture,
};
use crate::built_in::BuiltIn;
use crate::library::id_from_name;
use crate::text_limits::{MAX_ID, MAX_NAME};
use crate::wav_encoding::{Level, SampleType, WavEncoding};

/// Largest number of tables of a kind.
const MOST_TABLES: usize = 1000;
/// Largest number of textures or points in a list.
const MOST_LISTED: usize = 100_000;
/// Sample rates in Hz.
const RATES_HZ: RangeInclusive<u64> = 1..=768_000;
/// Speeds in mm/s, forces in N.
const SPEEDS_MM_PER_S: RangeInclusive<f64> = 0.0..=1e5;
const FORCES_N: RangeInclusive<f64> = 0.0..=1e3;
/// Durations in s, as of a recorded stroke.
const SECONDS: RangeInclusive<f64> = 0.001..=3600.0;
/// Full scale in m/s².
const FULL_SCALES_MPS2: RangeInclusive<f64> = 1e-6..=1e6;
/// Length of a path in mm or s.
const LENGTHS: RangeInclusive<f64> = 1e-3..=1e6;
/// Keys that choose textures; a table has one of them.
const CHOICES: [&str; 5] = ["all", "ids", "authored", "at", "path"];
/// Keys of a path.
const OF_PATH: [&str; 4] = ["name", "length_mm", "length_s", "at_end"];
/// Keys of an output that only signals have.
const OF_SIGNALS: [&str; 7] =
    ["rate_hz", "bits", "normalize", "loop", "full_scale_mps2", "actuator", "strokes"];

/// Returns what a file says, and collects its problems; values with problems have defaults.
pub(super) fn manifest_of(table: &Table, problems: &mut Vec<KeyProblem>) -> BatchManifest {
    let known = ["format", "version", "name", "library", "project", "seed", "texture", "stroke", "output"];
    let mut keys = Keys::new(table, String::new(), &known, problems);
    let name = keys.text("name", MAX_NAME).unwrap_or_default();
    let source = source(&mut keys);
    let seed = keys.whole("seed", &(0..=u64::from(u32::MAX))).unwrap_or(1);
    let textures = keys.tables("texture", MOST_TABLES);
    let strokes = keys.tables("stroke", MOST_TABLES);
    let outputs = keys.tables("output", MOST_TABLES);
    for (key, is_empty, what) in [
        ("texture", textures.is_empty(), "textures: [[texture]] with all = true"),
        ("output", outputs.is_empty(), "files to write: [[output]] with id and format"),
    ] {
        if is_empty && !keys.has(key) {
            keys.problem(key, format!("the manifest has no {what}; add it"));
        }
    }
    let is_project = matches!(source, BatchSource::Project(_));
    let at = |name: &str, index: usize| format!("{name}[{}].", index + 1);
    let textures: Vec<BatchTexture> = textures
        .into_iter()
        .enumerate()
        .map(|(index, table)| texture(table, at("texture", index), is_project, problems))
        .collect();
    let strokes: Vec<BatchStroke> = strokes
        .into_iter()
        .enumerate()
        .map(|(index, table)| stroke(table, at("stroke", index), problems))
        .collect();
    let outputs: Vec<BatchOutput> = outputs
        .into_iter()
        .enumerate()
        .map(|(index, table)| output(table, at("output", index), problems))
        .collect();
    refuse_twice("stroke", &strokes.iter().map(|stroke| stroke.id.as_str()).collect::<Vec<_>>(), problems);
    refuse_twice("output", &outputs.iter().map(|output| output.id.as_str()).collect::<Vec<_>>(), problems);
    for (index, output) in outputs.iter().enumerate() {
        for wanted in output.strokes.iter().flatten() {
            if !strokes.iter().any(|stroke| stroke.id == *wanted) {
                let ids: Vec<&str> = strokes.iter().map(|stroke| stroke.id.as_str()).collect();
                let there = if ids.is_empty() { "there are none".to_owned() } else { ids.join(", ") };
                let text = format!("there is no stroke \"{wanted}\"; the strokes are: {there}");
                problems.push(KeyProblem { key: format!("output[{}].strokes", index + 1), text });
            }
        }
    }
    BatchManifest { name, source, seed, textures, strokes, outputs }
}

fn refuse_twice(what: &str, ids: &[&str], problems: &mut Vec<KeyProblem>) {
    let mut seen = BTreeSet::new();
    for (index, id) in ids.iter().enumerate() {
        if !id.is_empty() && !seen.insert(id) {
            let text = format!("\"{id}\" is the id of another {what}; choose another");
            problems.push(KeyProblem { key: format!("{what}[{}].id", index + 1), text });
        }
    }
}

fn source(keys: &mut Keys<'_, '_>) -> BatchSource {
    let library = keys.text("library", MAX_NAME);
    match keys.text("project", MAX_NAME) {
        Some(_) if library.is_some() => {
            keys.problem("project", "state either `library` or `project`; remove one".to_owned());
            BatchSource::Library(String::new())
        }
        Some(project) => BatchSource::Project(project),
        None => BatchSource::Library(library.unwrap_or_else(|| BuiltIn::Starter.id().to_owned())),
    }
}

fn texture(table: &Table, at: String, is_project: bool, problems: &mut Vec<KeyProblem>) -> BatchTexture {
    let known: Vec<&str> = CHOICES.iter().chain(&["blend", "shape"]).chain(&OF_PATH).copied().collect();
    let mut keys = Keys::new(table, at, &known, problems);
    let stated: Vec<&str> = CHOICES.into_iter().filter(|key| keys.has(key)).collect();
    let choice = match stated[..] {
        ["all"] => {
            if keys.flag("all") == Some(false) {
                keys.problem(
                    "all",
                    "it is false, so that the table has no texture; remove the table".to_owned(),
                );
            }
            Some(BatchChoice::All)
        }
        ["ids"] => keys.texts("ids", MOST_LISTED).map(BatchChoice::Ids),
        ["authored"] => {
            if !is_project {
                keys.problem(
                    "authored",
                    "authored textures are those of a project; state `project`".to_owned(),
                );
            }
            keys.texts("authored", MOST_LISTED).map(BatchChoice::Authored)
        }
        ["at"] => keys.points("at", &(1..=MOST_LISTED)).map(BatchChoice::Points),
        ["path"] => path(&mut keys).map(BatchChoice::Path),
        [] => {
            keys.problem("all", format!("nothing chooses textures; add one of {}", CHOICES.join(", ")));
            None
        }
        [.., last] => {
            keys.problem(last, format!("a table has one of {}; add another [[texture]]", CHOICES.join(", ")));
            None
        }
    };
    if stated != ["path"] {
        for key in OF_PATH {
            if keys.has(key) {
                keys.problem(key, "only a path has this key; remove it, or add `path`".to_owned());
            }
        }
    }
    if keys.has("blend") && !matches!(stated[..], ["at" | "path"]) {
        keys.problem("blend", "only points and paths are interpolated; remove the key".to_owned());
    }
    let modes = Mode::ALL.map(Mode::id).join(", ");
    let blend = keys.word("blend", Mode::from_id, &modes).unwrap_or_default();
    let shape = keys.text("shape", MAX_NAME).and_then(|text| match text.parse() {
        Ok(shape) => Some(shape),
        Err(error) => {
            keys.problem("shape", format!("{error}"));
            None
        }
    });
    BatchTexture { choice: choice.unwrap_or(BatchChoice::All), blend, shape }
}

fn path(keys: &mut Keys<'_, '_>) -> Option<BatchPath> {
    let points = keys.points("path", &(2..=MAX_KEYS));
    let name = keys.text("name", MAX_NAME);
    let name = keys.need("name", name, "the name of the texture");
    let (millimeters, seconds) = (keys.number("length_mm", &LENGTHS), keys.number("length_s", &LENGTHS));
    let (along, length) = match (millimeters, seconds) {
        (Some(_), Some(_)) => {
            keys.problem("length_s", "state either `length_mm` or `length_s`; remove one".to_owned());
            return None;
        }
        (Some(length_mm), None) => (Along::Distance, 1e-3 * length_mm),
        (None, Some(length_s)) => (Along::Time, length_s),
        (None, None) => {
            if !keys.has("length_mm") && !keys.has("length_s") {
                keys.problem("length_mm", "the path has no length; add `length_mm` or `length_s`".to_owned());
            }
            return None;
        }
    };
    let ends = AtEnd::ALL.map(AtEnd::id).join(", ");
    let at_end = keys.word("at_end", AtEnd::from_id, &ends).unwrap_or_default();
    Some(BatchPath { name, points: points?, along, length, at_end })
}

/// The identifier of a stroke or output, which names files.
fn id(keys: &mut Keys<'_, '_>) -> String {
    let id = keys.text("id", MAX_ID);
    let id = keys.need("id", id, "a short name for files");
    if !id.is_empty() && id_from_name(&id) != id {
        let text = format!(
            "\"{id}\" cannot be part of a file name; use lower-case letters, digits and hyphens, such as \"{}\"",
            id_from_name(&id)
        );
        keys.problem("id", text);
    }
    id
}

fn stroke(table: &Table, at: String, problems: &mut Vec<KeyProblem>) -> BatchStroke {
    const STEADY: [&str; 3] = ["speed_mm_per_s", "force_n", "seconds"];
    let known = ["id", "file", STEADY[0], STEADY[1], STEADY[2]];
    let mut keys = Keys::new(table, at, &known, problems);
    let id = id(&mut keys);
    if keys.has("file") {
        for key in STEADY {
            if keys.has(key) {
                keys.problem(key, "a recorded stroke has its own; remove the key, or `file`".to_owned());
            }
        }
        let file = keys.text("file", MAX_NAME).unwrap_or_default();
        return BatchStroke { id, motion: BatchMotion::File(file) };
    }
    let speed = keys.number("speed_mm_per_s", &SPEEDS_MM_PER_S);
    let force = keys.number("force_n", &FORCES_N);
    let seconds = keys.number("seconds", &SECONDS);
    let motion = BatchMotion::Steady {
        speed_mm_per_s: keys.need("speed_mm_per_s", speed, "the tip speed, or add `file`"),
        force_n: keys.need("force_n", force, "the normal force, or add `file`"),
        seconds: keys.need("seconds", seconds, "the duration, or add `file`"),
    };
    BatchStroke { id, motion }
}

fn output(table: &Table, at: String, problems: &mut Vec<KeyProblem>) -> BatchOutput {
    let known: Vec<&str> = ["id", "format"].iter().chain(&OF_SIGNALS).copied().collect();
    let mut keys = Keys::new(table, at, &known, problems);
    let id = id(&mut keys);
    let format = keys.text("format", MAX_ID);
    let format = keys.need("format", format, "a format of `shagreen export`");
    let rate_hz = keys.whole("rate_hz", &RATES_HZ).and_then(|rate_hz| u32::try_from(rate_hz).ok());
    let bits = keys.whole("bits", &(16..=32));
    let samples = match bits {
        None | Some(32) => SampleType::Float32,
        Some(24) => SampleType::Pcm24,
        Some(16) => SampleType::Pcm16,
        Some(bits) => {
            keys.problem("bits", format!("it is {bits}, but must be 16, 24 or 32"));
            SampleType::Float32
        }
    };
    let level = if keys.flag("normalize") == Some(true) { Level::Peak } else { Level::Kept };
    let stated = OF_SIGNALS.into_iter().filter(|key| keys.has(key)).collect();
    BatchOutput {
        id,
        format,
        rate_hz,
        encoding: WavEncoding { samples, level },
        loops: keys.flag("loop") == Some(true),
        full_scale_mps2: keys.number("full_scale_mps2", &FULL_SCALES_MPS2),
        actuator: keys.text("actuator", MAX_NAME),
        strokes: keys.texts("strokes", MOST_TABLES),
        stated,
    }
}
