use shagreen_core::maths::rng::Random;

use super::{PhotoModel, drawn_roughness};
use crate::photo_card::PhotoCard;
use crate::photo_config::{Calibration, PhotoConfig, SmallNetworkConfig};
use crate::photo_folds::{LeftOut, folds};
use crate::photo_set::PhotoSet;
use crate::photo_validation::{JudgedPhoto, judge};
use crate::picture_model::{FeatureExtractor, PictureConfig, PictureModel, TrainingMetadata};
use crate::picture_set::Seen;

/// Heads on early features of `n_features` numbers, trained on made-up pictures.
pub(crate) fn drawn_heads(n_features: usize) -> PictureModel {
    let mut random = Random::new(8);
    let picture = |_| {
        let features: Vec<f32> = (0..n_features).map(|_| random.normal() as f32).collect();
        let first = f64::from(features[0]);
        Seen { features, labels: vec![50.0 + 10.0 * first, 50.0 - 10.0 * first] }
    };
    let pictures: Vec<Seen> = (0..40).map(picture).collect();
    let metadata = TrainingMetadata {
        eyes: FeatureExtractor::Statistics,
        attributes: vec!["rough-smooth".to_owned(), "hard-soft".to_owned()],
        learned_from: "pictures of 40 drawn materials".to_owned(),
    };
    let config = PictureConfig { hidden: vec![6], ..PictureConfig::paper(4, 2, 1, 1) };
    PictureModel::learn(&pictures.iter().collect::<Vec<_>>(), metadata, &config, |_| true).unwrap()
}

/// Fast settings.
pub(crate) fn fast(seed: u64) -> PhotoConfig {
    let usual = PhotoConfig::usual(seed);
    let network = SmallNetworkConfig {
        n_hidden: 12,
        dropout: 0.2,
        learning_rate: 0.02,
        n_epochs: 40,
        n_batch: 32,
        ..usual.network
    };
    PhotoConfig { ridge_penalty: 0.01, network, ..usual }
}

/// Fast settings with one network, calibrated on sources.
pub(crate) fn config() -> PhotoConfig {
    let fast = fast(1);
    let network = SmallNetworkConfig { n_networks: 1, ..fast.network };
    PhotoConfig { network, calibration: Calibration::Sources, ..fast }
}

pub(crate) fn card() -> PhotoCard {
    PhotoCard {
        n_photos: 0,
        n_classes: 0,
        sources: Vec::new(),
        left_out: Vec::new(),
        labels: "drawn numbers".to_owned(),
        drawn_materials: "drawn numbers".to_owned(),
        n_variations: 2,
        settings: config(),
        figures: Vec::new(),
        limits: vec!["meshes".to_owned()],
    }
}

/// A model of the photos of a set, validated by classes and sources.
pub(crate) fn photo_model(set: &PhotoSet) -> PhotoModel {
    let n_early = set.photos[0].features.early.len();
    let drawn = drawn_heads(n_early);
    let rough: Vec<_> =
        set.photos.iter().map(|photo| drawn_roughness(&drawn, &photo.features).unwrap()).collect();
    let mut judged: Vec<JudgedPhoto> = Vec::new();
    for kind in LeftOut::ALL {
        for numbered in folds(set, kind, 4).iter().enumerate() {
            judged.extend(judge(set, numbered, &rough, &config()).unwrap());
        }
    }
    PhotoModel::learn(set, drawn, &judged, &config(), card()).unwrap()
}
