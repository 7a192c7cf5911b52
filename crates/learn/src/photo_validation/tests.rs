use super::by_class::predictions_of_classes;
use super::{JudgedPhoto, OF_MODEL, Validation, judge};
use crate::photo_config::{Calibration, HeadWeights, PhotoConfig, SmallNetworkConfig};
use crate::photo_folds::{LeftOut, folds};
use crate::photo_set::PhotoSet;
use crate::photo_set::made_up::photo_set;
use shagreen_core::maths::gaussian_process::Estimate;

fn config() -> PhotoConfig {
    let usual = PhotoConfig::usual(1);
    let network = SmallNetworkConfig { n_hidden: 6, n_epochs: 3, n_networks: 1, ..usual.network };
    let hardness = HeadWeights { network: 0.0, kernel: 0.0, ..usual.hardness };
    PhotoConfig { ridge_penalty: 0.01, network, hardness, ..usual }
}

fn judged(set: &PhotoSet, config: &PhotoConfig) -> Vec<JudgedPhoto> {
    let drawn = vec![Some(Estimate { mean: 40.0, deviation: 9.0 }); set.photos.len()];
    let of = |kind| {
        let folds = folds(set, kind, 4);
        let of_fold = |(number, fold)| judge(set, (number, fold), &drawn, config).unwrap();
        folds.iter().enumerate().flat_map(of_fold).collect::<Vec<JudgedPhoto>>()
    };
    LeftOut::ALL.into_iter().flat_map(of).collect()
}

#[test]
fn classes_that_were_left_out_are_predicted_worse_than_sources() {
    let set = photo_set(72, 4);
    let config = config();
    let judged = judged(&set, &config);
    assert_eq!(judged.len(), 2 * 72);
    let figures = Validation::new(&set, &judged, &config).figures();
    let mae = |left_out: LeftOut, predictor: &str| {
        let is_it = |figure: &&crate::photo_card::LeftOutFigure| {
            figure.attribute == "hard-soft" && figure.left_out == left_out && figure.predictor == predictor
        };
        figures.iter().find(is_it).unwrap().mae
    };
    // The sources do not differ, so leaving one out changes nothing but the number of photos.
    assert!(mae(LeftOut::Sources, "the model") < 10.0, "{figures:?}");
    assert!(mae(LeftOut::Classes, "the model") > mae(LeftOut::Sources, "the model"));
    // A class that is left out has no probability.
    assert!(mae(LeftOut::Classes, "class probabilities") > 25.0);
    // The mean of the two other classes of equal size: 65, 45 and 30 for 10, 50 and 80.
    assert!((mae(LeftOut::Classes, "mean of the others") - 110.0 / 3.0).abs() < 1e-9);
    assert!(figures.iter().all(|figure| figure.n == 72 && figure.predictor != "small networks"));
}

#[test]
fn deviations_are_scaled_to_the_errors_of_the_chosen_photos() {
    let set = photo_set(72, 4);
    let mut before = 0.0;
    for (calibration, kind) in
        [(Calibration::Sources, LeftOut::Sources), (Calibration::Classes, LeftOut::Classes)]
    {
        let config = PhotoConfig { calibration, ..config() };
        let judged = judged(&set, &config);
        let validation = Validation::new(&set, &judged, &config);
        let calibrated = validation.calibrated().unwrap();
        let errors = validation.errors(1, &|photo| photo.kind == kind);
        let ratio = calibrated.deviations[1].ratio(&errors).unwrap();
        // The limits may leave the standard deviations too large (labels) or too small (an unknown attribute).
        assert!((0.3..2.5).contains(&ratio), "{ratio}");
        let mean: f64 = errors
            .iter()
            .map(|error| calibrated.deviations[1].deviation(&error.evidence, error.unlikeness, &error.doubts))
            .sum::<f64>()
            / errors.len() as f64;
        // Classes that were left out have larger errors.
        assert!(mean > before, "{mean} {before}");
        before = mean;
        // The error is that against the label, and nothing else.
        for (error, judged) in validation.errors(0, &|_| true).iter().zip(&judged) {
            let label = set.classes[set.photos[judged.photo].class].rough_smooth;
            assert_eq!(error.squared, (judged.of.rough_smooth.mean - label).powi(2));
        }
    }
}

#[test]
fn without_left_out_photos_there_is_no_calibration() {
    let set = photo_set(12, 4);
    let config = config();
    let validation = Validation::new(&set, &[], &config);
    assert!(validation.calibrated().is_none() && validation.figures().is_empty());
}

#[test]
fn the_prediction_of_a_class_is_the_mean_of_those_of_its_photos() {
    let set = photo_set(72, 4);
    let config = config();
    let judged = judged(&set, &config);
    let all = predictions_of_classes(&set, &judged, &config);
    // Three classes; four predictors of the roughness, and four of the hardness without the small networks.
    assert_eq!(all.len(), 3 * (4 + 4));
    let of = |attribute: &str, predictor: &str| {
        all.iter().filter(|of| of.attribute == attribute && of.predictor == predictor).collect::<Vec<_>>()
    };
    let hardness: Vec<f64> = of("hard-soft", OF_MODEL).iter().map(|of| of.actual).collect();
    assert_eq!(hardness, [10.0, 50.0, 80.0]);
    // Of two classes that remain.
    for (of, others) in of("hard-soft", "mean of the others").into_iter().zip([65.0, 45.0, 30.0]) {
        assert!((of.predicted - others).abs() < 1e-9 && of.deviation.is_none(), "{of:?}");
    }
    for of in of("rough-smooth", "heads of drawn materials") {
        assert!((of.predicted - 40.0).abs() < 1e-9 && of.actual == 90.0 - hardness[of.class], "{of:?}");
    }
    for of in of("hard-soft", OF_MODEL) {
        let is_of_class = |photo: &&JudgedPhoto| {
            photo.kind == LeftOut::Classes && set.photos[photo.photo].class == of.class
        };
        let photos: Vec<&JudgedPhoto> = judged.iter().filter(is_of_class).collect();
        let sum: f64 = photos.iter().map(|photo| photo.of.hard_soft.mean).sum();
        assert!(photos.len() == 24 && (of.predicted - sum / 24.0).abs() < 1e-9, "{of:?}");
        assert!(of.deviation.is_some_and(|deviation| (1.0..40.0).contains(&deviation)), "{of:?}");
    }
}
