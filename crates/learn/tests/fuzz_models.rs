//! Every reader of model files withstands any header: no panic, no hang, and no more memory than the file suggests.
//!
//! The weights have a checksum and no structure, so only the header is mutated. `SHAGREEN_FUZZ_INPUTS` is the number of
//! inputs for each reader.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may panic, and reports what it did")]

#[path = "fuzz_models/made_up_photos.rs"]
mod made_up_photos;
#[path = "../../formats/tests/fuzz_readers/memory.rs"]
mod memory;
#[path = "../../formats/tests/fuzz_readers/mutate.rs"]
#[allow(dead_code, reason = "model files have no checksums that a mutation must repair")]
mod mutate;

use std::time::{Duration, Instant};

use shagreen_core::maths::rng::{Random, derive_seed, lcg_noise};
use shagreen_core::recording::fit::Stroke;
use shagreen_learn::attribute_model::AttributeModel;
use shagreen_learn::backbone::Backbone;
use shagreen_learn::cnn_lstm::{Architecture, Padding, Streams};
use shagreen_learn::model_card::{GaussianProcessComparison, ModelCard};
use shagreen_learn::photo_set::PhotoSet;
use shagreen_learn::picture_model::PictureModel;
use shagreen_learn::picture_set::{PictureSet, Seen};
use shagreen_learn::stroke_model::StrokeModel;
use shagreen_learn::stroke_set::StrokedTexture;
use shagreen_learn::training::{Training, TrainingConfig};

use crate::made_up_photos::{photo_model, photo_set};
use crate::memory::peak_of;
use crate::mutate::mutate;

/// Inputs for each reader in a test.
const USUAL_INPUTS: u64 = 3000;
const LONGEST: Duration = Duration::from_secs(10);
/// Permitted memory, in bytes per byte of the file, and in addition.
const MEMORY_FACTOR: usize = 20;
const MEMORY_BYTES: usize = 64 << 20;

/// A trained network of a few hundred weights.
fn stroke_model() -> Vec<u8> {
    let architecture = Architecture {
        streams: Streams::Both,
        n_samples: 40,
        n_channels: 3,
        padding: Padding::Same,
        filters: [2; 6],
        pools: [2, 2],
        units: [2; 4],
        dense: [3, 2],
        n_outputs: 1,
    };
    let texture = |seed: u64| StrokedTexture {
        id: seed.to_string(),
        strokes: vec![Stroke {
            axes_mps2: vec![lcg_noise(200, seed)],
            speed_mps: vec![0.1; 200],
            force_n: vec![0.3; 200],
        }],
        attributes: vec![seed as f64],
    };
    let textures = [1, 2, 3].map(texture);
    let config = TrainingConfig::paper(architecture, 1, None, 1);
    let mut training = Training::new(&textures.iter().collect::<Vec<_>>(), config).unwrap();
    training.run_epoch(|_| true).unwrap().unwrap();
    let card = ModelCard {
        attributes: vec!["rough-smooth".to_owned()],
        left_out_rmse: vec![9.0],
        network: "tiny".to_owned(),
        learned_from: "noise".to_owned(),
        label_sources: vec!["simulated".to_owned()],
        gaussian_process: Some(GaussianProcessComparison::new(vec![9.0], vec![4.0])),
        extent: None,
    };
    training.finish().unwrap().to_bytes(&card).unwrap()
}

fn picture_set() -> Vec<u8> {
    let seen = |n: u8| Seen { features: vec![f32::from(n); 4], labels: vec![f64::from(n)] };
    PictureSet { made_by: "test".to_owned(), pictures: [1, 2, 3].map(seen).to_vec() }.to_bytes().unwrap()
}

fn picture_model() -> Vec<u8> {
    std::fs::read(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../assets/models/pictures-by-statistics.safetensors"
    ))
    .unwrap()
}

/// A file with a mutated header, whose length is stated rightly, and the same weights.
fn with_mutated_header(file: &[u8], random: &mut Random) -> Vec<u8> {
    let end = 8 + header_length(file);
    let header = mutate(&[file[8..end].to_vec()], random);
    [&(header.len() as u64).to_le_bytes()[..], &header, &file[end..]].concat()
}

fn header_length(file: &[u8]) -> usize {
    u64::from_le_bytes(file[..8].try_into().unwrap()) as usize
}

/// Reads mutated files, and returns how many were read without an error.
fn fuzz(name: &str, file: &[u8], read: &dyn Fn(&[u8]) -> bool) -> u64 {
    let n_inputs = std::env::var("SHAGREEN_FUZZ_INPUTS").map_or(USUAL_INPUTS, |n| n.parse().unwrap());
    assert!(read(file), "{name}: the file itself is refused");
    let begun = Instant::now();
    let (mut n_read, mut most) = (0, 0);
    for index in 0..n_inputs {
        let mut random = Random::new(derive_seed(4, &format!("{name} {index}")));
        let input = with_mutated_header(file, &mut random);
        let once = Instant::now();
        let (is_read, peak) = peak_of(|| read(&input));
        assert!(once.elapsed() < LONGEST, "{name}, input {index}: {:?}", once.elapsed());
        assert!(
            peak <= MEMORY_FACTOR * input.len() + MEMORY_BYTES,
            "{name}, input {index}: {peak} bytes for {}",
            input.len()
        );
        n_read += u64::from(is_read);
        most = most.max(peak);
    }
    println!(
        "{name}: {n_inputs} inputs, {n_read} read, {} kB, {:.1} s",
        most >> 10,
        begun.elapsed().as_secs_f64()
    );
    n_read
}

#[test]
fn every_reader_of_models_takes_whatever_comes() {
    fuzz("stroke model", &stroke_model(), &|bytes| StrokeModel::from_bytes(bytes).is_ok());
    fuzz("picture set", &picture_set(), &|bytes| PictureSet::from_bytes(bytes).is_ok());
    fuzz("picture model", &picture_model(), &|bytes| PictureModel::from_bytes(bytes).is_ok());
    fuzz("photo set", &photo_set().to_bytes().unwrap(), &|bytes| PhotoSet::from_bytes(bytes).is_ok());
    fuzz("photo model", &photo_model(), &|bytes| AttributeModel::from_bytes(bytes).is_ok());
    // Networks of others have no header of ours: this one is refused as unknown, whatever its header says.
    fuzz("backbone", &picture_set(), &|bytes| {
        assert!(Backbone::from_bytes(bytes).is_err());
        true
    });
}

/// A header may state any size: a network is made only if the file holds its weights.
#[test]
fn a_header_of_a_large_network_is_refused_before_it_is_made() {
    let file = stroke_model();
    let length = header_length(&file);
    let header = String::from_utf8(file[8..8 + length].to_vec()).unwrap();
    for (small, large) in [
        ("\\\"units\\\":[2,2,2,2]", "\\\"units\\\":[4096,4096,4096,4096]"),
        ("\\\"dense\\\":[3,2]", "\\\"dense\\\":[4096,4096]"),
    ] {
        assert!(header.contains(small), "{header}");
        let header = header.replace(small, large);
        let bytes =
            [&(header.len() as u64).to_le_bytes()[..], header.as_bytes(), &file[8 + length..]].concat();
        let (refused, peak) = peak_of(|| StrokeModel::from_bytes(&bytes).is_err());
        assert!(refused && peak < MEMORY_BYTES, "{large}: {peak} bytes");
    }
}
