//! Manifests and records of batches, parts of evaluations, and bundles.

use std::path::{Component, Path};

use shagreen_formats::batch_manifest::read_batch_manifest;
use shagreen_formats::batch_record::{BatchRecordV1, FORMAT, RecordedFileV1, VERSION};
use shagreen_formats::bundle::{Bundle, BundleFile, BundleKind, BundleManifestV1, BundleRole, write_bundle};
use shagreen_formats::evaluation_part::{read_evaluation_part, write_evaluation_part};

/// Number of textures of the library of [`part_seeds`].
const N_TEXTURES: usize = 25;
const INPUTS: &str = "ab";

pub(crate) fn manifest_seeds() -> Vec<Vec<u8>> {
    let head = "format = \"shagreen-batch\"\nversion = \"1.0\"\nname = \"Test\"\n";
    let strokes = "[[stroke]]\nid = \"slow\"\nspeed_mm_per_s = 60\nforce_n = 0.5\nseconds = 10\n\
        [[stroke]]\nid = \"drawn\"\nfile = \"a.csv\"\n";
    let outputs =
        "[[output]]\nid = \"wav\"\nformat = \"wav\"\nrate_hz = 8000\nbits = 16\nstrokes = [\"slow\"]\n";
    let path =
        "[[texture]]\nname = \"Way\"\npath = [[30, 70], [60, 20.5]]\nlength_mm = 80\nshape = \"level=-3\"\n";
    vec![
        format!("{head}library = \"starter\"\nseed = 4\n[[texture]]\nall = true\n{strokes}{outputs}").into_bytes(),
        format!(
            "{head}project = \"a.shagreen\"\n[[texture]]\nids = [\"cork\"]\n[[texture]]\nauthored = [\"Mine\"]\n{path}{outputs}"
        )
        .into_bytes(),
    ]
}

/// A manifest or a list of its problems, each of which says something.
pub(crate) fn read_a_manifest(bytes: &[u8]) -> Result<(), String> {
    match read_batch_manifest(bytes) {
        Err(error) if error.to_string().is_empty() => Err("an error without words".to_owned()),
        Ok(_) | Err(_) => Ok(()),
    }
}

pub(crate) fn record_seeds() -> Vec<Vec<u8>> {
    let file = RecordedFileV1 { path: "wav/cork.wav".to_owned(), bytes: 3, sha256: "cd".repeat(32) };
    let record = BatchRecordV1 {
        format: FORMAT.to_owned(),
        version: VERSION.to_owned(),
        inputs: "ab".repeat(32),
        files: vec![file],
        licence: "CC0-1.0".to_owned(),
        restricted: Vec::new(),
        lost: vec!["the friction coefficient".to_owned()],
        warnings: Vec::new(),
    };
    vec![record.to_bytes()]
}

pub(crate) fn read_a_record(bytes: &[u8]) -> Result<(), String> {
    let Some(record) = BatchRecordV1::read(bytes) else { return Ok(()) };
    let again = BatchRecordV1::read(&record.to_bytes());
    if again.as_ref() == Some(&record) { Ok(()) } else { Err("the written record is another one".to_owned()) }
}

pub(crate) fn part_seeds() -> Vec<Vec<u8>> {
    let text = r#"{"format": "shagreen-evaluation-part", "version": "1.0", "inputs": "ab", "part": 2, "of": 3,
        "n_evaluated": 3, "reach_db": 1.5, "on_hull": [0, 1], "textures": [
        {"texture": 4, "at": [30.5, 70.0], "nearest": 24, "within_measured": true, "outcomes": [
        {"error_db": 0.3333333333333333, "level_error_db": 0.1, "shape_error_db": 2.5, "rank": 3, "nrs": 0.7,
        "signal_error_db": null, "signal_from_model_db": 2.0}]}]}"#;
    let part = read_evaluation_part(text.as_bytes(), INPUTS, N_TEXTURES).unwrap();
    vec![write_evaluation_part(&part, INPUTS)]
}

pub(crate) fn read_a_part(bytes: &[u8]) -> Result<(), String> {
    let Ok(part) = read_evaluation_part(bytes, INPUTS, N_TEXTURES) else { return Ok(()) };
    match read_evaluation_part(&write_evaluation_part(&part, INPUTS), INPUTS, N_TEXTURES) {
        Ok(again) if again == part => Ok(()),
        Ok(_) => Err("the written part is another one".to_owned()),
        Err(error) => Err(format!("the written part cannot be read: {error}")),
    }
}

fn bundle_of(files: &[(&str, &[u8])]) -> Vec<u8> {
    let file = |(path, bytes): &(&str, &[u8])| BundleFile {
        path: (*path).to_owned(),
        role: BundleRole::Export,
        bytes: bytes.to_vec(),
    };
    let manifest = BundleManifestV1::new("fuzz", "Woods", BundleKind::Library);
    write_bundle(manifest, files.iter().map(file).collect()).unwrap()
}

pub(crate) fn bundle_seeds() -> Vec<Vec<u8>> {
    let tone: Vec<u8> = (0..500_u32).map(|i| (i * i / 7 % 256) as u8).collect();
    vec![bundle_of(&[("woods.json", b"{}"), ("exports/a.wav", &tone)]), bundle_of(&[])]
}

/// Much that takes little room.
pub(crate) fn bundle_bombs() -> Vec<Vec<u8>> {
    let zeros = vec![0; 12 << 20];
    vec![bundle_of(&[("zeros", &zeros)]), bundle_of(&[("a", &zeros[..6 << 20]), ("b", &zeros[..6 << 20])])]
}

/// No path of a bundle leads out of the folder that it is unpacked to.
pub(crate) fn read_a_bundle(bytes: &[u8]) -> Result<(), String> {
    let Ok(mut bundle) = Bundle::open(bytes) else { return Ok(()) };
    let is_inside =
        |path: &str| Path::new(path).components().all(|part| matches!(part, Component::Normal(_)));
    if let Some(file) = bundle.manifest().files.iter().find(|file| !is_inside(&file.path)) {
        return Err(format!("a file leads out of its folder: {}", file.path));
    }
    // A file that was changed is an error, which is fine.
    let _ = bundle.check();
    Ok(())
}
