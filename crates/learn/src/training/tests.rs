use super::{Epoch, Training, TrainingConfig, TrainingError};
use crate::cnn_lstm::{Architecture, Padding, Streams};
use crate::model_file::{ModelFileError, sha256_of};
use crate::stroke_model::{ModelCard, StrokeModel};
use crate::stroke_set::StrokedTexture;
use shagreen_core::maths::rng::lcg_noise;
use shagreen_core::recording::fit::Stroke;

const N_SAMPLES: usize = 1200;

fn tiny() -> Architecture {
    Architecture {
        streams: Streams::Both,
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
        let stroke = Stroke { accel_mps2, speed_mps: vec![0.1; N_SAMPLES], force_n: vec![0.3; N_SAMPLES] };
        StrokedTexture {
            id: format!("texture-{index}"),
            strokes: vec![stroke],
            attributes: vec![20.0 + 60.0 * share, 80.0 - 60.0 * share],
        }
    };
    (0..n).map(of).collect()
}

fn config(n_epochs: usize, patience: Option<usize>) -> TrainingConfig {
    TrainingConfig { n_batch: 8, learning_rate: 5e-3, ..TrainingConfig::paper(tiny(), n_epochs, patience, 3) }
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
    let short = Stroke { accel_mps2: vec![0.0; 39], speed_mps: vec![0.1; 39], force_n: vec![0.1; 39] };
    assert_eq!(model.predict(&[short]).unwrap(), None);
}

fn card() -> ModelCard {
    ModelCard {
        attributes: ["rough-smooth", "hard-soft"].map(str::to_owned).to_vec(),
        left_out_rmse: vec![7.5, 12.0],
        network: "toy".to_owned(),
        learned_from: "generated textures".to_owned(),
        label_sources: vec!["simulated".to_owned()],
    }
}

#[test]
fn the_same_seed_gives_the_same_file_and_another_seed_another() {
    let all = textures(3);
    let learned: Vec<&StrokedTexture> = all.iter().collect();
    let file =
        |config: TrainingConfig| run(Training::new(&learned, config).unwrap()).1.to_bytes(&card()).unwrap();
    let once = file(config(2, None));
    assert_eq!(sha256_of(&once), sha256_of(&file(config(2, None))));
    assert_ne!(once, file(TrainingConfig { seed: 4, ..config(2, None) }));
}

#[test]
fn a_stopped_training_goes_on_as_if_it_had_not_stopped() {
    let all = textures(11);
    let learned: Vec<&StrokedTexture> = all.iter().collect();
    let whole = run(Training::new(&learned, config(4, Some(3))).unwrap());
    let mut training = Training::new(&learned, config(2, Some(3))).unwrap();
    while !training.is_over() {
        training.run_epoch(|_| true).unwrap();
    }
    let kept = training.keep().unwrap();
    // An epoch that is interrupted does not count.
    assert_eq!(training.run_epoch(|share| share < 0.5).unwrap(), None);
    drop(training);
    let resumed = run(Training::resume(&learned, config(4, Some(3)), &kept).unwrap());
    assert_eq!(resumed.0, whole.0);
    assert_eq!(resumed.1.to_bytes(&card()).unwrap(), whole.1.to_bytes(&card()).unwrap());

    let fewer = Training::resume(&learned[1..], config(4, Some(3)), &kept);
    assert!(matches!(fewer.err(), Some(TrainingError::Other)));
    let model = whole.1.to_bytes(&card()).unwrap();
    let other = Training::resume(&learned, config(4, Some(3)), &model);
    assert!(matches!(other.err(), Some(TrainingError::File(ModelFileError::Kind { .. }))));
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
