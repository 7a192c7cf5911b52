use std::path::Path;

use shagreen_core::surfaces::picture_features::N_FEATURES;
use shagreen_formats::photo_networks::{ImageNetwork, PhotoNetworks};
use shagreen_learn::backbone::BackboneKind;
use shagreen_learn::picture_model::{FeatureExtractor, PictureConfig, PictureModel, TrainingMetadata};
use shagreen_learn::picture_set::Seen;

use super::{described, photo_predictor};
use crate::file::one_line;
use crate::models::ModelFolder;

/// A file of heads that have learned nothing.
fn heads(folder: &Path, name: &str, eyes: FeatureExtractor, n_features: usize, attributes: &[&str]) {
    let seen = |i: usize| Seen {
        features: (0..n_features).map(|k| ((i * k) % 7) as f32).collect(),
        labels: attributes.iter().map(|_| 10.0 * i as f64).collect(),
    };
    let seen: Vec<Seen> = (0..8).map(seen).collect();
    let pictures: Vec<&Seen> = seen.iter().collect();
    let attributes = attributes.iter().map(|name| (*name).to_owned()).collect();
    let lesson = TrainingMetadata { eyes, attributes, learned_from: "eight toys".to_owned() };
    let model = PictureModel::learn(&pictures, lesson, &PictureConfig::paper(1, 1, 1, 1), |_| true).unwrap();
    std::fs::write(folder.join(name), model.to_bytes().unwrap()).unwrap();
}

fn failure(networks: &PhotoNetworks, models: Option<&ModelFolder>) -> String {
    one_line(&photo_predictor(Some(networks), models).map(|predictor| described(&predictor)).unwrap_err())
}

#[test]
fn without_a_choice_and_without_a_network_there_are_statistics() {
    for chosen in [None, Some(PhotoNetworks { network: ImageNetwork::Statistics, heads: None })] {
        let predictor = photo_predictor(chosen.as_ref(), None).unwrap();
        assert!(described(&predictor).starts_with("statistics of the picture, trained on "));
    }
}

#[test]
fn heads_of_the_user_are_used_where_they_belong() {
    let folder = tempfile::tempdir().unwrap();
    let usual = ["rough-smooth", "hard-soft"];
    heads(folder.path(), "heads.safetensors", FeatureExtractor::Statistics, N_FEATURES, &usual);
    let path = folder.path().join("heads.safetensors");
    let statistics =
        |path: &Path| PhotoNetworks { network: ImageNetwork::Statistics, heads: Some(path.to_owned()) };
    let predictor = photo_predictor(Some(&statistics(&path)), None).unwrap();
    assert_eq!(described(&predictor), "statistics of the picture, trained on eight toys");

    // Heads of a network, without that network.
    let eyes = FeatureExtractor::Network { kind: BackboneKind::Resnet50, sha256: "0".repeat(64) };
    heads(folder.path(), "of-resnet.safetensors", eyes, 2048, &usual);
    let of_resnet = folder.path().join("of-resnet.safetensors");
    let reason = failure(&statistics(&of_resnet), None);
    assert!(reason.contains("ResNet-50") && reason.contains("statistics of the picture"), "{reason}");
    assert!(reason.ends_with("of-resnet.safetensors"), "{reason}");
    // Heads of other attributes.
    heads(folder.path(), "warm.safetensors", FeatureExtractor::Statistics, N_FEATURES, &["warm-cold"]);
    let reason = failure(&statistics(&folder.path().join("warm.safetensors")), None);
    assert!(reason.contains("warm-cold") && reason.contains("rough-smooth and hard-soft"), "{reason}");
    std::fs::write(&path, b"hello").unwrap();
    let reason = failure(&statistics(&path), None);
    assert!(reason.contains("not a safetensors file") && reason.ends_with("heads.safetensors"), "{reason}");
}

#[test]
fn networks_that_are_missing_or_others_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let models = ModelFolder::new(folder.path().join("models"));
    let efficientnet = PhotoNetworks { network: ImageNetwork::EfficientnetLite0, heads: None };
    for models in [None, Some(&models)] {
        assert!(failure(&efficientnet, models).contains("shagreen model fetch"));
    }
    let resnet = |heads: Option<&str>| PhotoNetworks {
        network: ImageNetwork::Resnet50(folder.path().join("resnet50.safetensors")),
        heads: heads.map(|name| folder.path().join(name)),
    };
    assert!(failure(&resnet(None), None).contains("no built-in heads"));
    let reason = failure(&resnet(Some("heads.safetensors")), None);
    assert!(reason.contains("no such file") && reason.ends_with("resnet50.safetensors"), "{reason}");
    std::fs::write(folder.path().join("resnet50.safetensors"), b"hello").unwrap();
    let reason = failure(&resnet(Some("heads.safetensors")), None);
    assert!(
        reason.contains("not a safetensors file") && reason.ends_with("resnet50.safetensors"),
        "{reason}"
    );
}
