//! The sheet that chooses the networks for photos: files that belong together, files that do not, and the settings.

use std::path::{Path, PathBuf};

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use serde_json::{Map, Value, json};
use shagreen_app::Begin;
use shagreen_app::choices::networks::NetworkChoice;
use shagreen_app::state::files::StoragePaths;
use shagreen_app::strings::networks as words;
use shagreen_app::strings::{document, help, prompt, relief};
use shagreen_core::surfaces::picture_features::N_FEATURES;
use shagreen_formats::photo_networks::{ImageNetwork, PhotoNetworks};
use shagreen_formats::picture::{Rgb, encode_png};
use shagreen_formats::settings::read_settings;
use shagreen_learn::backbone::BackboneKind;
use shagreen_learn::model_file::sha256_of;
use shagreen_learn::picture_model::{FeatureExtractor, PictureConfig, PictureModel, TrainingMetadata};
use shagreen_learn::picture_set::Seen;
use shagreen_studio::project::new_project;

use crate::support::{
    Author, author_of, begin, choose, click, drop_files, says, unnamed_controls, wait, window, write_into,
};

/// Window that keeps its settings and networks in a folder.
fn opened(folder: &Path) -> Author {
    let settings = folder.join("settings.json");
    if !settings.exists() {
        std::fs::write(&settings, r#"{"has_seen_tour": true}"#).unwrap();
    }
    let keeping = StoragePaths {
        settings: Some(settings),
        models: Some(folder.join("models")),
        ..StoragePaths::default()
    };
    author_of(Begin { keeping, ..begin(new_project()) }, [1280.0, 720.0])
}

fn open_sheet(harness: &mut Author) {
    click(harness, document::FILE);
    harness.run_steps(2);
    click(harness, words::MENU);
    harness.run_steps(4);
    assert_eq!(unnamed_controls(harness), Vec::<String>::new());
}

fn field(harness: &Author, name: &str) -> String {
    harness.get_by_role_and_label(Role::TextInput, name).value().unwrap_or_default()
}

/// Networks in the settings file.
fn remembered(folder: &Path) -> Option<PhotoNetworks> {
    read_settings(&std::fs::read(folder.join("settings.json")).unwrap()).0.photo_networks
}

/// Writes a file of heads that have learned nothing.
fn heads(folder: &Path, name: &str, eyes: FeatureExtractor, n_features: usize) -> PathBuf {
    let seen = |i: usize| Seen {
        features: (0..n_features).map(|k| ((i * k) % 7) as f32).collect(),
        labels: vec![10.0 * i as f64, 50.0],
    };
    let seen: Vec<Seen> = (0..8).map(seen).collect();
    let pictures: Vec<&Seen> = seen.iter().collect();
    let attributes = ["rough-smooth", "hard-soft"].map(str::to_owned).to_vec();
    let lesson = TrainingMetadata { eyes, attributes, learned_from: "eight toys".to_owned() };
    let model = PictureModel::learn(&pictures, lesson, &PictureConfig::paper(1, 1, 1, 1), |_| true).unwrap();
    let path = folder.join(name);
    std::fs::write(&path, model.to_bytes().unwrap()).unwrap();
    path
}

/// A file of ResNet-50 with the tensor names of torchvision. All weights are zero, in half precision.
fn resnet_50() -> Vec<u8> {
    let mut shapes: Vec<(String, Vec<usize>)> = Vec::new();
    let mut convolution = |name: String, normalization: &str, shape: [usize; 4]| {
        shapes.push((format!("{name}.weight"), shape.to_vec()));
        for part in ["weight", "bias", "running_mean", "running_var"] {
            shapes.push((format!("{normalization}.{part}"), vec![shape[0]]));
        }
    };
    convolution("conv1".to_owned(), "bn1", [64, 3, 7, 7]);
    let mut n_inputs = 64;
    for (layer, (width, n_blocks)) in [(64, 3), (128, 4), (256, 6), (512, 3)].into_iter().enumerate() {
        for block in 0..n_blocks {
            let name = |part: &str| format!("layer{}.{block}.{part}", layer + 1);
            convolution(name("conv1"), &name("bn1"), [width, n_inputs, 1, 1]);
            convolution(name("conv2"), &name("bn2"), [width, width, 3, 3]);
            convolution(name("conv3"), &name("bn3"), [4 * width, width, 1, 1]);
            if block == 0 {
                convolution(name("downsample.0"), &name("downsample.1"), [4 * width, n_inputs, 1, 1]);
            }
            n_inputs = 4 * width;
        }
    }
    let mut header = Map::new();
    let mut end = 0;
    for (name, shape) in shapes {
        let begin = end;
        end += 2 * shape.iter().product::<usize>();
        header.insert(name, json!({"dtype": "F16", "shape": shape, "data_offsets": [begin, end]}));
    }
    let header = Value::Object(header).to_string();
    let mut bytes = (header.len() as u64).to_le_bytes().to_vec();
    bytes.extend(header.into_bytes());
    bytes.resize(bytes.len() + end, 0);
    bytes
}

#[test]
fn heads_without_a_network_are_checked_used_and_remembered() {
    let folder = tempfile::tempdir().unwrap();
    let path = heads(folder.path(), "heads.safetensors", FeatureExtractor::Statistics, N_FEATURES);
    let mut harness = opened(folder.path());
    open_sheet(&mut harness);
    // Nothing is downloaded, so statistics are in use, which need no file.
    assert!(says(&harness, words::name(NetworkChoice::Statistics)));
    assert!(harness.query_by_role_and_label(Role::TextInput, words::FILE).is_none());
    write_into(&mut harness, words::HEADS, &folder.path().join("none.safetensors").display().to_string());
    click(&mut harness, words::USE);
    wait(&mut harness, "the error is in the sheet", |h| says(h, "no such file"));
    assert_eq!(remembered(folder.path()), None);
    write_into(&mut harness, words::HEADS, &path.display().to_string());
    assert!(!says(&harness, "no such file"), "it was about another file");
    click(&mut harness, words::USE);
    let used = words::in_use("statistics of the picture, trained on eight toys");
    wait(&mut harness, "they are in use", |h| says(h, &used));
    let chosen = PhotoNetworks { network: ImageNetwork::Statistics, heads: Some(path.clone()) };
    wait(&mut harness, "they are remembered", |_| remembered(folder.path()).as_ref() == Some(&chosen));
    click(&mut harness, help::CLOSE);
    harness.run_steps(3);
    assert!(harness.query_by_label(words::USE).is_none());

    // The next photo is seen by them.
    let photo = encode_png(&Rgb { width: 64, height: 64, pixels: vec![90; 3 * 64 * 64] }).unwrap();
    drop_files(&mut harness, &[("gray.png", &photo)]);
    click(&mut harness, relief::FIND_POINT);
    wait(&mut harness, "it landed", |h| window(h).project().authored.len() == 2);
    wait(&mut harness, "it is said by what", |h| says(h, &prompt::seen_by("statistics of the picture")));
    drop(harness);

    // So is the next window; a file that is gone meanwhile is an error of the photo.
    let mut harness = opened(folder.path());
    open_sheet(&mut harness);
    assert_eq!(field(&harness, words::HEADS), path.display().to_string());
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    std::fs::remove_file(&path).unwrap();
    drop_files(&mut harness, &[("gray.png", &photo)]);
    click(&mut harness, relief::FIND_POINT);
    wait(&mut harness, "the error is shown", |h| says(h, "heads.safetensors"));
    assert_eq!(window(&harness).project().authored.len(), 1);
}

#[test]
fn resnet_50_is_used_with_the_heads_that_belong_to_it() {
    let folder = tempfile::tempdir().unwrap();
    let network = folder.path().join("resnet50.safetensors");
    let bytes = resnet_50();
    std::fs::write(&network, &bytes).unwrap();
    let eyes = |sha256: String| FeatureExtractor::Network { kind: BackboneKind::Resnet50, sha256 };
    let right = heads(folder.path(), "right.safetensors", eyes(sha256_of(&bytes)), 2048);
    let wrong = heads(folder.path(), "wrong.safetensors", eyes("0".repeat(64)), 2048);
    let mut harness = opened(folder.path());
    open_sheet(&mut harness);
    choose(&mut harness, words::NETWORK, words::name(NetworkChoice::Resnet50));
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, words::USE);
    harness.run_steps(2);
    assert!(says(&harness, words::NO_FILE));
    write_into(&mut harness, words::FILE, &network.display().to_string());
    click(&mut harness, words::USE);
    wait(&mut harness, "heads are asked for", |h| says(h, "ResNet-50 has no built-in heads; train them"));
    write_into(&mut harness, words::HEADS, &wrong.display().to_string());
    click(&mut harness, words::USE);
    wait(&mut harness, "the heads do not match", |h| says(h, "the network file differs"));
    assert_eq!(remembered(folder.path()), None);
    write_into(&mut harness, words::HEADS, &right.display().to_string());
    click(&mut harness, words::USE);
    wait(&mut harness, "they are in use", |h| says(h, &words::in_use("ResNet-50, trained on eight toys")));
    let chosen = PhotoNetworks { network: ImageNetwork::Resnet50(network.clone()), heads: Some(right) };
    wait(&mut harness, "they are remembered", |_| remembered(folder.path()).as_ref() == Some(&chosen));

    // A file of something else replaces nothing.
    std::fs::write(folder.path().join("notes.safetensors"), b"hello").unwrap();
    write_into(&mut harness, words::FILE, &folder.path().join("notes.safetensors").display().to_string());
    click(&mut harness, words::USE);
    wait(&mut harness, "the error is in the sheet", |h| says(h, "not a safetensors file"));
    assert_eq!(remembered(folder.path()), Some(chosen));
}

#[test]
fn a_network_that_was_not_downloaded_says_how_to_get_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = opened(folder.path());
    open_sheet(&mut harness);
    choose(&mut harness, words::NETWORK, words::name(NetworkChoice::EfficientnetLite0));
    assert!(says(&harness, &words::note(NetworkChoice::EfficientnetLite0, None)));
    click(&mut harness, words::USE);
    wait(&mut harness, "the error is in the sheet", |h| says(h, "download it with `shagreen model fetch`"));
    assert_eq!(remembered(folder.path()), None);
}
