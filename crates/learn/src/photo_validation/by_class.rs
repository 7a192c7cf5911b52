//! Predictions for classes whose photos were left out of the training together.

use shagreen_core::maths::statistics::mean;

use super::{ATTRIBUTES, JudgedPhoto, OF_MODEL, Validation, label, predictors};
use crate::photo_config::PhotoConfig;
use crate::photo_folds::LeftOut;
use crate::photo_set::PhotoSet;

/// Prediction of an attribute for a class, by a predictor that was trained without any photo of it.
#[derive(Clone, Debug, PartialEq)]
pub struct ClassPrediction {
    /// Index of the class.
    pub class: usize,
    /// Name of the attribute.
    pub attribute: &'static str,
    /// Name of the predictor.
    pub predictor: &'static str,
    /// Label of the class, 0 to 100.
    pub actual: f64,
    /// Mean of the predictions for its photos.
    pub predicted: f64,
    /// Root mean square of the standard deviations that the model states for its photos, in points. Other predictors state
    /// none.
    pub deviation: Option<f64>,
}

/// Returns the predictions for all classes that were left out, by each predictor.
pub fn predictions_of_classes(
    set: &PhotoSet,
    judged: &[JudgedPhoto],
    config: &PhotoConfig,
) -> Vec<ClassPrediction> {
    let validation = Validation::new(set, judged, config);
    let deviations = validation.calibrated().map(|calibrated| calibrated.deviations);
    let mut by_class: Vec<Vec<&JudgedPhoto>> = vec![Vec::new(); set.classes.len()];
    for photo in judged.iter().filter(|photo| photo.kind == LeftOut::Classes) {
        by_class[set.photos[photo.photo].class].push(photo);
    }
    let mut all = Vec::new();
    for (index, attribute) in ATTRIBUTES.into_iter().enumerate() {
        let stated = |photos: &[&JudgedPhoto]| -> Option<f64> {
            let model = deviations.as_ref()?[index];
            let squared = |photo: &&JudgedPhoto| {
                let of = validation.error(index, photo);
                model.deviation(&of.evidence, of.unlikeness, &of.doubts).powi(2)
            };
            Some(mean(&photos.iter().map(squared).collect::<Vec<f64>>()).sqrt())
        };
        for (predictor, predict) in predictors(index) {
            for (class, photos) in by_class.iter().enumerate() {
                let of_photos: Vec<f64> = photos.iter().filter_map(|photo| predict(photo)).collect();
                if of_photos.is_empty() {
                    continue;
                }
                all.push(ClassPrediction {
                    class,
                    attribute,
                    predictor,
                    actual: label(index, &set.classes[class]),
                    predicted: mean(&of_photos),
                    deviation: if predictor == OF_MODEL { stated(photos) } else { None },
                });
            }
        }
    }
    all
}
