//! A set of made-up photos, and a model trained on it.

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::maths::rng::lcg_noise;
use shagreen_core::surfaces::picture_doubts::Detail;
use shagreen_core::surfaces::picture_features::N_VIEWS;
use shagreen_learn::photo_card::PhotoCard;
use shagreen_learn::photo_config::{PhotoConfig, SmallNetworkConfig};
use shagreen_learn::photo_folds::{LeftOut, folds};
use shagreen_learn::photo_model::PhotoModel;
use shagreen_learn::photo_set::{MaterialClass, PhotoFeatures, PhotoSet, SeenPhoto};
use shagreen_learn::photo_validation::judge;
use shagreen_learn::picture_model::{FeatureExtractor, PictureConfig, PictureModel, TrainingMetadata};
use shagreen_learn::picture_set::Seen;

/// Number of features, early and late.
const N_FEATURES: usize = 3;

pub(crate) fn photo_set() -> PhotoSet {
    let class = |name: &str, hard_soft: f64| MaterialClass {
        name: name.to_owned(),
        hard_soft,
        hard_soft_sd: 7.0,
        rough_smooth: 100.0 - hard_soft,
        rough_smooth_sd: 12.0,
    };
    let photo = |index: usize| {
        let features = |row: usize| -> Vec<f32> {
            let noise = lcg_noise(N_FEATURES, (100 * index + row) as u64 + 1);
            noise.into_iter().map(|x| (x + 3.0 * (index % 3) as f64) as f32).collect()
        };
        SeenPhoto {
            file: format!("{index}.jpg"),
            sha256: "0".repeat(64),
            class: index % 3,
            source: index / 3 % 2,
            features: PhotoFeatures {
                early: features(90),
                late: (0..=N_VIEWS).map(features).collect(),
                detail: Detail { rms: 0.1, sharpness_db: -4.0 },
                side_px: 512,
            },
        }
    };
    PhotoSet {
        made_by: "test".to_owned(),
        classes: [("brick", 9.0), ("cork", 57.0), ("carpet", 85.0)]
            .map(|(name, of)| class(name, of))
            .to_vec(),
        sources: vec!["a".to_owned(), "b".to_owned()],
        photos: (0..12).map(photo).collect(),
    }
}

pub(crate) fn photo_model() -> Vec<u8> {
    let set = photo_set();
    let of = |photo: &SeenPhoto| Seen { features: photo.features.early.clone(), labels: vec![40.0, 50.0] };
    let pictures: Vec<Seen> = set.photos.iter().map(of).collect();
    let metadata = TrainingMetadata {
        eyes: FeatureExtractor::Statistics,
        attributes: vec!["rough-smooth".to_owned(), "hard-soft".to_owned()],
        learned_from: "noise".to_owned(),
    };
    let config = PictureConfig { hidden: vec![2], ..PictureConfig::paper(1, 1, 1, 1) };
    let drawn =
        PictureModel::learn(&pictures.iter().collect::<Vec<_>>(), metadata, &config, |_| true).unwrap();
    let usual = PhotoConfig::usual(1);
    let network = SmallNetworkConfig { n_hidden: 2, n_epochs: 1, n_networks: 1, ..usual.network };
    let config = PhotoConfig { network, ..usual };
    let rough = vec![Some(Estimate { mean: 40.0, deviation: 9.0 }); set.photos.len()];
    let mut judged = Vec::new();
    for numbered in folds(&set, LeftOut::Classes, 3).iter().enumerate() {
        judged.extend(judge(&set, numbered, &rough, &config).unwrap());
    }
    let card = PhotoCard {
        n_photos: 0,
        n_classes: 0,
        sources: Vec::new(),
        left_out: Vec::new(),
        labels: "noise".to_owned(),
        drawn_materials: "noise".to_owned(),
        n_variations: 1,
        settings: config.clone(),
        figures: Vec::new(),
        limits: Vec::new(),
    };
    PhotoModel::learn(&set, drawn, &judged, &config, card).unwrap().to_bytes().unwrap()
}
