use super::{FeatureExtractor, PictureConfig, PictureModel, PictureModelError, TrainingMetadata};
use crate::picture_set::Seen;
use shagreen_core::maths::rng::Random;

fn lesson() -> TrainingMetadata {
    TrainingMetadata {
        eyes: FeatureExtractor::Statistics,
        attributes: vec!["sum".to_owned(), "first".to_owned()],
        learned_from: "numbers that were drawn".to_owned(),
    }
}

fn config(seed: u64) -> PictureConfig {
    PictureConfig {
        hidden: vec![12, 6],
        n_batch: 16,
        learning_rate: 5e-3,
        ..PictureConfig::paper(60, 10, 2, seed)
    }
}

/// Pictures whose labels depend on their first two features.
fn pictures(n: usize) -> Vec<Seen> {
    let mut random = Random::new(5);
    let of = |_| {
        let features: Vec<f32> = (0..6).map(|_| random.normal() as f32).collect();
        let (a, b) = (f64::from(features[0]), f64::from(features[1]));
        Seen { labels: vec![50.0 + 12.0 * (a + b).tanh(), 50.0 + 10.0 * a], features }
    };
    (0..n).map(of).collect()
}

fn learn(pictures: &[Seen], seed: u64) -> PictureModel {
    let references: Vec<&Seen> = pictures.iter().collect();
    PictureModel::learn(&references, lesson(), &config(seed), |_| true).unwrap()
}

#[test]
fn what_follows_from_the_features_is_learned_and_the_error_is_known() {
    let all = pictures(240);
    let (learned, others) = all.split_at(200);
    let model = learn(learned, 1);
    let mut squares = [0.0; 2];
    let mut deviations = [0.0; 2];
    for seen in others {
        let estimates = model.predict(&seen.features).unwrap();
        for (i, estimate) in estimates.iter().enumerate() {
            squares[i] += (estimate.mean - seen.labels[i]).powi(2) / 40.0;
            deviations[i] += estimate.deviation / 40.0;
        }
    }
    for (square, deviation) in squares.into_iter().zip(deviations) {
        // The labels have a standard deviation of about ten.
        assert!(square.sqrt() < 4.0, "{square}");
        // The stated standard deviation matches the actual error within a factor of two.
        assert!((0.5..2.0).contains(&(square.sqrt() / deviation)), "{square} {deviation}");
    }
    let strange = model.predict(&[40.0, -35.0, 50.0, 20.0, -60.0, 30.0]).unwrap();
    assert!(strange[0].deviation > 2.5 * deviations[0], "{strange:?}");
    assert!((0.0..=100.0).contains(&strange[0].mean));
}

#[test]
fn a_seed_gives_the_same_file_and_the_file_the_same_model() {
    let pictures = pictures(60);
    let (model, bytes) = (learn(&pictures, 3), learn(&pictures, 3).to_bytes().unwrap());
    assert_eq!(model.to_bytes().unwrap(), bytes);
    assert_ne!(learn(&pictures, 4).to_bytes().unwrap(), bytes);
    let read = PictureModel::from_bytes(&bytes).unwrap();
    assert_eq!(read.predict(&pictures[0].features).unwrap(), model.predict(&pictures[0].features).unwrap());
    assert_eq!(
        (read.eyes(), read.learned_from()),
        (&FeatureExtractor::Statistics, "numbers that were drawn")
    );
    assert_eq!(read.attributes(), ["sum", "first"]);
}

#[test]
fn damage_and_other_shapes_are_refused() {
    let bytes = learn(&pictures(30), 3).to_bytes().unwrap();
    for n in [0, 7, 100, bytes.len() / 2, bytes.len() - 1] {
        assert!(PictureModel::from_bytes(&bytes[..n]).is_err(), "{n}");
    }
    let mut changed = bytes.clone();
    *changed.last_mut().unwrap() ^= 1;
    let error = PictureModel::from_bytes(&changed).unwrap_err().to_string();
    assert!(error.contains("changed or cut"), "{error}");
    // Layer sizes in the header must match the tensors.
    let replaced = |from: &str, to: &str| {
        let at = bytes.windows(from.len()).position(|window| window == from.as_bytes()).unwrap();
        let mut changed = bytes.clone();
        changed[at..at + to.len()].copy_from_slice(to.as_bytes());
        PictureModel::from_bytes(&changed).unwrap_err().to_string()
    };
    let sizes = "[6,12,6,2]";
    assert!(replaced(sizes, "[6,11,6,2]").contains("do not fit"), "{}", replaced(sizes, "[6,11,6,2]"));
    assert!(replaced(sizes, "[6,12,6,9]").contains("settings are invalid"));
    assert!(replaced(sizes, "[0,12,6,2]").contains("settings are invalid"));
}

#[test]
fn what_nothing_can_be_learned_from_is_refused() {
    let all = pictures(20);
    let refused = |pictures: &[Seen], config: &PictureConfig| {
        let references: Vec<&Seen> = pictures.iter().collect();
        PictureModel::learn(&references, lesson(), config, |_| true).unwrap_err()
    };
    assert!(matches!(refused(&all[..7], &config(1)), PictureModelError::TooFew { n: 7, .. }));
    let mut odd = all.clone();
    odd[3].features.pop();
    assert!(matches!(refused(&odd, &config(1)), PictureModelError::Picture { index: 3, n_features: 5, .. }));
    let mut broken = all.clone();
    broken[4].labels[0] = f64::NAN;
    assert!(matches!(refused(&broken, &config(1)), PictureModelError::Picture { index: 4, .. }));
    let none = PictureConfig { n_heads: 0, ..config(1) };
    assert!(matches!(refused(&all, &none), PictureModelError::Settings));
    let model = learn(&all, 1);
    assert!(matches!(model.predict(&[1.0]), Err(PictureModelError::Picture { n_features: 1, .. })));
}

#[test]
fn it_stops_when_told_and_is_what_it_learned_so_far() {
    let all = pictures(30);
    let references: Vec<&Seen> = all.iter().collect();
    let mut n = 0;
    let model = PictureModel::learn(&references, lesson(), &config(1), |epochs| {
        n = epochs;
        epochs < 3
    })
    .unwrap();
    assert_eq!(n, 3);
    assert_eq!(model.predict(&all[0].features).unwrap().len(), 2);
}
