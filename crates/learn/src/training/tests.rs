use super::{Epoch, Training, TrainingConfig, TrainingError};
use crate::cnn_lstm::{Architecture, Padding, Streams};
use crate::model_card::{GaussianProcessComparison, ModelCard};
use crate::model_file::{ModelFileError, sha256_of};
use crate::stroke_model::StrokeModel;
use crate::stroke_set::StrokedTexture;
use shagreen_core::maths::rng::lcg_noise;
use shagreen_core::recording::fit::Stroke;

const N_SAMPLES: usize = 1200;

fn tiny(streams: Streams) -> Architecture {
    Architecture {
        streams,
        n_samples: 40,
        n_channels: 3,
        padding: Padding::Same,
        filters: [4, 4, 6, 6, 4, 4],
        pools: [2, 2],
        units: [4, 6, 6, 4],
        dense: [12, 8],
        n_outputs: 2,
    }
}

/// Textures whose level rises with the first attribute, and whose spectrum is lower with the second.
fn textures(n: usize) -> Vec<StrokedTexture> {
    let of = |index: usize| {
        let share = index as f64 / (n - 1) as f64;
        let noise = lcg_noise(N_SAMPLES, index as u64 + 1);
        let slow = 1.0 - share;
        let mut level = 0.0;
        let accel_mps2 = noise
            .iter()
            .map(|noise| {
                level = 0.9 * slow * level + noise;
                level * (0.2 + 2.0 * share)
            })
            .collect();
        let stroke = Stroke {
            axes_mps2: vec![accel_mps2],
            speed_mps: vec![0.1; N_SAMPLES],
            force_n: vec![0.3; N_SAMPLES],
        };
        StrokedTexture {
            id: format!("texture-{index}"),
            strokes: vec![stroke],
            attributes: vec![20.0 + 60.0 * share, 80.0 - 60.0 * share],
        }
    };
    (0..n).map(of).collect()
}

fn config(n_epochs: usize, patience: Option<usize>) -> TrainingConfig {
    config_of(tiny(Streams::Both), n_epochs, patience)
}

fn config_of(architecture: Architecture, n_epochs: usize, patience: Option<usize>) -> TrainingConfig {
    let paper = TrainingConfig::paper(architecture, n_epochs, patience, 3);
    TrainingConfig { n_batch: 8, learning_rate: 5e-3, ..paper }
}

fn run(mut training: Training) -> (Vec<Epoch>, StrokeModel) {
    while !training.is_over() {
        training.run_epoch(|_| true).unwrap().unwrap();
    }
    (training.epochs().to_vec(), training.finish().unwrap())
}

#[test]
fn it_learns_and_tells_textures_that_it_has_not_seen() {
    let all = textures(13);
    let learned: Vec<&StrokedTexture> = all.iter().filter(|texture| texture.id != "texture-4").collect();
    let (epochs, model) = run(Training::new(&learned, config(12, None)).unwrap());
    assert_eq!(epochs.len(), 12);
    assert!(epochs[11].learned_rmse < 0.5 * epochs[0].learned_rmse, "{epochs:?}");
    let predicted = model.predict(&all[4].strokes).unwrap().unwrap();
    for (predicted, attribute) in predicted.iter().zip(&all[4].attributes) {
        // An untrained constant prediction would be off by 20.
        assert!((predicted - attribute).abs() < 12.0, "{predicted} for {attribute}");
    }
    let short = Stroke { axes_mps2: vec![vec![0.0; 39]], speed_mps: vec![0.1; 39], force_n: vec![0.1; 39] };
    assert_eq!(model.predict(&[short]).unwrap(), None);
}

#[test]
fn the_serial_network_learns() {
    let all = textures(13);
    let learned: Vec<&StrokedTexture> = all.iter().collect();
    let (epochs, _) = run(Training::new(&learned, config_of(tiny(Streams::Series), 20, None)).unwrap());
    assert!(epochs[19].learned_rmse < 0.7 * epochs[0].learned_rmse, "{epochs:?}");
}

/// The vibration along one axis says nothing, the ratio of the axes everything.
#[test]
fn a_network_of_three_axes_learns_from_their_ratio() {
    let turned = |texture: &StrokedTexture| {
        let share = texture.attributes[0] / 100.0;
        let strokes = texture.strokes.iter().map(|stroke| {
            let noise = lcg_noise(N_SAMPLES, 7);
            let axis = |factor: f64| -> Vec<f64> { noise.iter().map(|value| factor * value).collect() };
            let angle = share * std::f64::consts::FRAC_PI_2;
            Stroke { axes_mps2: vec![axis(angle.cos()), axis(angle.sin()), axis(0.0)], ..stroke.clone() }
        });
        StrokedTexture { strokes: strokes.collect(), ..texture.clone() }
    };
    let all: Vec<StrokedTexture> = textures(9).iter().map(turned).collect();
    let learned: Vec<&StrokedTexture> = all.iter().collect();
    let three_axes = tiny(Streams::Convolutions).with_three_axes();
    let (epochs, model) = run(Training::new(&learned, config_of(three_axes.clone(), 12, None)).unwrap());
    assert!(epochs[11].learned_rmse < 0.6 * epochs[0].learned_rmse, "{epochs:?}");
    assert_eq!(model.architecture().n_axes(), 3);

    // Neither network reads the strokes of the other.
    let combined = textures(9);
    let refused = model.predict(&combined[0].strokes).unwrap_err();
    assert!(matches!(refused, TrainingError::Axes { n_found: 1, n_needed: 3 }), "{refused}");
    let other = Training::new(&learned, config(1, None));
    assert!(matches!(other.err(), Some(TrainingError::Axes { n_found: 3, n_needed: 1 })));
    let two = Architecture { n_channels: 4, ..three_axes };
    assert!(matches!(Training::new(&learned, config_of(two, 1, None)).err(), Some(TrainingError::Sizes)));
}

fn card() -> ModelCard {
    ModelCard {
        attributes: ["rough-smooth", "hard-soft"].map(str::to_owned).to_vec(),
        left_out_rmse: vec![7.5, 12.0],
        network: "toy".to_owned(),
        learned_from: "generated textures".to_owned(),
        label_sources: vec!["simulated".to_owned()],
        gaussian_process: Some(GaussianProcessComparison::new(vec![6.0, 10.0], vec![5.0, 4.0])),
        extent: None,
    }
}

#[test]
fn the_same_seed_gives_the_same_file_and_another_seed_another() {
    let all = textures(3);
    let learned: Vec<&StrokedTexture> = all.iter().collect();
    let file =
        |config: TrainingConfig| run(Training::new(&learned, config).unwrap()).1.to_bytes(&card()).unwrap();
    for streams in [Streams::Both, Streams::Series] {
        let config = || config_of(tiny(streams), 2, None);
        let once = file(config());
        assert_eq!(sha256_of(&once), sha256_of(&file(config())));
        assert_ne!(once, file(TrainingConfig { seed: 4, ..config() }));
    }
}

#[test]
fn a_stopped_training_goes_on_as_if_it_had_not_stopped() {
    let all = textures(11);
    let learned: Vec<&StrokedTexture> = all.iter().collect();
    for streams in [Streams::Both, Streams::Series] {
        let config = |n_epochs: usize| config_of(tiny(streams), n_epochs, Some(3));
        let whole = run(Training::new(&learned, config(4)).unwrap());
        let mut training = Training::new(&learned, config(2)).unwrap();
        while !training.is_over() {
            training.run_epoch(|_| true).unwrap();
        }
        let after_two = training.keep().unwrap();
        // An interrupted epoch counts as a fraction.
        assert_eq!(training.run_epoch(|share| share < 0.5).unwrap(), None);
        assert!((training.n_epochs() - 2.5).abs() < 0.05, "{}", training.n_epochs());
        let within = training.keep().unwrap();
        drop(training);
        for kept in [&after_two, &within] {
            let resumed = run(Training::resume(&learned, config(4), kept).unwrap());
            assert_eq!(resumed.0, whole.0);
            assert_eq!(resumed.1.to_bytes(&card()).unwrap(), whole.1.to_bytes(&card()).unwrap());
        }
        let fewer = Training::resume(&learned[1..], config(4), &after_two);
        assert!(matches!(fewer.err(), Some(TrainingError::Other)));
        let model = whole.1.to_bytes(&card()).unwrap();
        let other = Training::resume(&learned, config(4), &model);
        assert!(matches!(other.err(), Some(TrainingError::File(ModelFileError::Kind { .. }))));
    }
}

#[test]
fn an_interrupted_epoch_keeps_what_it_has_learned() {
    let all = textures(13);
    let learned: Vec<&StrokedTexture> = all.iter().collect();
    let mut training = Training::new(&learned, config(12, None)).unwrap();
    // Nothing was trained before the first batch, and an untrained network is what it was.
    assert_eq!(training.run_epoch(|_| false).unwrap(), None);
    assert_eq!(training.n_epochs(), 0.0);
    let untrained = Training::new(&learned, config(12, None)).unwrap().finish().unwrap();
    assert_eq!(training.run_epoch(|share| share < 0.7).unwrap(), None);
    assert!((0.7..0.75).contains(&training.n_epochs()), "{}", training.n_epochs());
    // Each call continues where the one before stopped.
    assert_eq!(training.run_epoch(|share| share < 0.9).unwrap(), None);
    assert!((0.9..0.95).contains(&training.n_epochs()) && training.epochs().is_empty());
    let trained = training.finish().unwrap();
    let error = |model: &StrokeModel| -> f64 {
        let of = |texture: &StrokedTexture| {
            let predicted = model.predict(&texture.strokes).unwrap().unwrap();
            predicted.iter().zip(&texture.attributes).map(|(p, value)| (p - value).abs()).sum::<f64>()
        };
        all.iter().map(of).sum()
    };
    assert!(error(&trained) < 0.8 * error(&untrained), "{} {}", error(&trained), error(&untrained));
}

#[test]
fn steps_share_the_segments_of_a_round_evenly() {
    for (n_segments, n_batch) in [(2625, 32), (525, 32), (32, 32), (5, 32), (33, 32)] {
        let n_steps = usize::div_ceil(n_segments, n_batch);
        let parts: Vec<_> = (0..n_steps).map(|step| super::part(n_segments, n_steps, step)).collect();
        assert_eq!((parts[0].start, parts[n_steps - 1].end), (0, n_segments));
        assert!(parts.windows(2).all(|pair| pair[0].end == pair[1].start));
        let sizes = parts.iter().map(ExactSizeIterator::len);
        let (least, most) = (sizes.clone().min().unwrap(), sizes.max().unwrap());
        assert!(most <= n_batch && most - least <= 1, "{least} {most}");
    }
}

#[test]
fn learning_that_goes_astray_is_told_and_not_kept() {
    let all = textures(4);
    let learned: Vec<&StrokedTexture> = all.iter().collect();
    let wild = TrainingConfig { learning_rate: 1e30, ..config(60, None) };
    let mut training = Training::new(&learned, wild).unwrap();
    let error = loop {
        match training.run_epoch(|_| true) {
            Ok(_) => assert!(!training.is_over(), "training did not diverge"),
            Err(error) => break error,
        }
    };
    assert!(matches!(error, TrainingError::Astray { .. }), "{error}");
}

#[test]
fn it_stops_early_and_keeps_the_best() {
    let all = textures(12);
    let learned: Vec<&StrokedTexture> = all.iter().collect();
    // A learning rate so large that the error soon rises.
    let config = TrainingConfig { learning_rate: 0.05, ..config(60, Some(2)) };
    let (epochs, _) = run(Training::new(&learned, config).unwrap());
    let best = epochs.iter().min_by(|a, b| a.aside_rmse.unwrap().total_cmp(&b.aside_rmse.unwrap())).unwrap();
    assert!(epochs.len() < 60 && epochs.len() == best.number + 2, "{epochs:?}");
}

#[test]
fn a_file_of_a_model_predicts_the_same_and_a_wrong_one_is_refused() {
    let all = textures(4);
    let learned: Vec<&StrokedTexture> = all.iter().collect();
    let (_, model) = run(Training::new(&learned, config(2, None)).unwrap());
    let bytes = model.to_bytes(&card()).unwrap();
    let (read, of) = StrokeModel::from_bytes(&bytes).unwrap();
    assert_eq!(of, card());
    assert_eq!(read.predict(&all[1].strokes).unwrap(), model.predict(&all[1].strokes).unwrap());
    let mut damaged = bytes.clone();
    let last = damaged.len() - 9;
    damaged[last] ^= 0x10;
    assert!(matches!(StrokeModel::from_bytes(&damaged), Err(TrainingError::File(ModelFileError::Hash))));
    assert!(StrokeModel::from_bytes(&bytes[..bytes.len() / 2]).is_err());
    assert!(StrokeModel::from_bytes(b"\x80\x02}q\x00.").is_err(), "a pickle must be refused");
    for other in [
        ModelCard { attributes: vec!["rough-smooth".to_owned()], ..card() },
        ModelCard { left_out_rmse: vec![f64::NAN; 2], ..card() },
    ] {
        assert!(matches!(model.to_bytes(&other), Err(TrainingError::Card { n_outputs: 2 })));
    }
}

#[test]
fn what_nothing_can_be_learned_from_is_refused() {
    let all = textures(3);
    let one: Vec<&StrokedTexture> = all.iter().take(1).collect();
    assert!(matches!(Training::new(&one, config(2, None)), Err(TrainingError::TooFew { n_textures: 1, .. })));
    let sizes = TrainingConfig { n_batch: 0, ..config(2, None) };
    assert!(matches!(Training::new(&all.iter().collect::<Vec<_>>(), sizes), Err(TrainingError::Sizes)));
}
