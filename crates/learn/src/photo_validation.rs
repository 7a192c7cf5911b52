//! Predictions for photos whose whole class or source was left out of the training, and what they say: how large the
//! errors are, and how standard deviations must be scaled so that they hold.

pub mod by_class;

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::maths::statistics::quantile;
use shagreen_core::maths::weighted_statistics::{weighted_correlation, weighted_mean};
use shagreen_core::surfaces::picture_doubts::{PictureDoubt, doubt_of_materials, doubt_of_unlikeness};
use shagreen_core::surfaces::picture_features::N_VIEWS;

use crate::photo_card::LeftOutFigure;
use crate::photo_config::{Calibration, PhotoConfig};
use crate::photo_deviation::{DeviationModel, Evidence, LeftOutError};
use crate::photo_evidence::{PhotoEvidence, evidence};
use crate::photo_folds::{Fold, LeftOut};
use crate::photo_heads::{PhotoHeads, PhotoHeadsError, class_weights};
use crate::photo_set::{MaterialClass, PhotoSet, SeenPhoto};

/// Share of left-out photos whose distance from the training photos counts as usual.
const USUAL_SHARE: f64 = 0.95;

/// Prediction for a photo that was left out of the training.
#[derive(Clone, Debug, PartialEq)]
pub struct JudgedPhoto {
    kind: LeftOut,
    /// Index of the photo.
    photo: usize,
    /// Number of the fold among those of its kind.
    fold: usize,
    of: PhotoEvidence,
    /// Roughness by the heads trained on drawn materials; `None` for a photo with few pixels.
    drawn_roughness: Option<Estimate>,
    /// Mean hardness of the photos that were not left out.
    mean_hardness: f64,
    /// Mean roughness of their classes.
    mean_roughness: f64,
}

/// Predicts the photos of a fold with heads that are trained on all other photos.
///
/// `drawn_roughness` has the roughness that the heads trained on drawn materials predict for each photo of the set; `fold`
/// is the number of the fold among those of its kind.
///
/// # Errors
/// As the training of the heads.
///
/// # Panics
/// If there is not one roughness for each photo.
pub fn judge(
    set: &PhotoSet,
    (number, fold): (usize, &Fold),
    drawn_roughness: &[Option<Estimate>],
    config: &PhotoConfig,
) -> Result<Vec<JudgedPhoto>, PhotoHeadsError> {
    assert_eq!(drawn_roughness.len(), set.photos.len(), "each photo needs a roughness");
    let others = fold.others(set.photos.len());
    let heads = PhotoHeads::learn(set, &others, config)?;
    let classes_of_others = others.iter().map(|index| set.photos[*index].class);
    let weights = class_weights(classes_of_others.clone(), set.classes.len(), config.class_exponent);
    let mean_of = |label: fn(&MaterialClass) -> f64| {
        let labels: Vec<f64> = classes_of_others.clone().map(|class| label(&set.classes[class])).collect();
        weighted_mean(&labels, &weights)
    };
    let (mean_hardness, mean_roughness) =
        (mean_of(|class| class.hard_soft), mean_of(|class| class.rough_smooth));
    let judged = |index: &usize| -> Result<JudgedPhoto, PhotoHeadsError> {
        let views = set.photos[*index].features.late.get(..N_VIEWS);
        let outputs = heads.look(views.ok_or(PhotoHeadsError::Features { index: *index })?)?;
        let drawn = drawn_roughness[*index];
        Ok(JudgedPhoto {
            kind: fold.kind,
            photo: *index,
            fold: number,
            of: evidence(&outputs, drawn, &set.classes, config),
            drawn_roughness: drawn,
            mean_hardness,
            mean_roughness,
        })
    };
    fold.photos.iter().map(judged).collect()
}

/// Scaled standard deviations, and what they are scaled with.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Calibrated {
    /// Standard deviations of the roughness and of the hardness.
    pub(crate) deviations: [DeviationModel; 2],
    /// Distance from the training photos that counts as usual.
    pub(crate) usual_distance: f64,
}

/// Attributes in the order of a prediction.
pub(crate) const ATTRIBUTES: [&str; 2] = ["rough-smooth", "hard-soft"];

/// Left-out photos with their weights.
pub(crate) struct Validation<'a> {
    set: &'a PhotoSet,
    judged: &'a [JudgedPhoto],
    /// Weight of each photo of the set.
    weights: Vec<f64>,
    usual_distance: f64,
    calibration: Calibration,
}

impl<'a> Validation<'a> {
    pub(crate) fn new(set: &'a PhotoSet, judged: &'a [JudgedPhoto], config: &PhotoConfig) -> Self {
        let classes = set.photos.iter().map(|photo| photo.class);
        let distances: Vec<f64> = judged.iter().map(|photo| photo.of.distance).collect();
        Self {
            set,
            judged,
            weights: class_weights(classes, set.classes.len(), config.class_exponent),
            usual_distance: quantile(&distances, USUAL_SHARE).map_or(1.0, |usual| usual.max(1e-6)),
            calibration: config.calibration,
        }
    }

    /// Scales the standard deviations; `None` without errors.
    pub(crate) fn calibrated(&self) -> Option<Calibrated> {
        let fit =
            |attribute| DeviationModel::fit(&self.errors(attribute, &|photo| self.is_calibrating(photo)));
        Some(Calibrated { deviations: [fit(0)?, fit(1)?], usual_distance: self.usual_distance })
    }

    fn is_calibrating(&self, photo: &JudgedPhoto) -> bool {
        match self.calibration {
            Calibration::Classes => photo.kind == LeftOut::Classes,
            Calibration::Sources => photo.kind == LeftOut::Sources,
            Calibration::Both => true,
        }
    }

    /// Returns the errors of an attribute for the left-out photos that are chosen.
    fn errors(&self, attribute: usize, is_chosen: &dyn Fn(&JudgedPhoto) -> bool) -> Vec<LeftOutError> {
        let chosen = self.judged.iter().filter(|photo| is_chosen(photo));
        chosen.map(|photo| self.error(attribute, photo)).collect()
    }

    fn error(&self, attribute: usize, judged: &JudgedPhoto) -> LeftOutError {
        let photo = &self.set.photos[judged.photo];
        let class = &self.set.classes[photo.class];
        let of = evidence_of(attribute, &judged.of);
        // The error contains that of the label, which is independent of the prediction for a class that was left out. To
        // add the variance of the label would count it twice.
        let off = of.mean - label(attribute, class);
        let unlikeness = judged.of.distance / self.usual_distance;
        LeftOutError {
            evidence: of,
            squared: off * off,
            weight: self.weights[judged.photo],
            unlikeness,
            doubts: doubts(photo, &judged.of.probabilities, unlikeness),
        }
    }

    /// Returns the errors on the left-out photos, by attribute and by what was left out. Each photo counts with the weight
    /// of its class, as in the training.
    ///
    /// The ratio of error to standard deviation of a photo is that of a calibration without the photos of its fold.
    pub(crate) fn figures(&self) -> Vec<LeftOutFigure> {
        let mut figures = Vec::new();
        for attribute in [1, 0] {
            for kind in LeftOut::ALL {
                let judged: Vec<&'a JudgedPhoto> =
                    self.judged.iter().filter(|photo| photo.kind == kind).collect();
                let ratio = self.nested_ratio(attribute, kind);
                for (predictor, predict) in predictors(attribute) {
                    let by = |photo: &&'a JudgedPhoto| Some((*photo, predict(photo)?));
                    let (judged, predicted): (Vec<&JudgedPhoto>, Vec<f64>) =
                        judged.iter().filter_map(by).unzip();
                    if judged.is_empty() {
                        continue;
                    }
                    let ratio = ratio.filter(|_| predictor == OF_MODEL);
                    figures.push(self.figure((attribute, kind, predictor), &judged, &predicted, ratio));
                }
            }
        }
        figures
    }

    fn figure(
        &self,
        (attribute, left_out, predictor): (usize, LeftOut, &str),
        judged: &[&JudgedPhoto],
        predicted: &[f64],
        error_over_deviation: Option<f64>,
    ) -> LeftOutFigure {
        let class = |photo: &&JudgedPhoto| &self.set.classes[self.set.photos[photo.photo].class];
        let labels: Vec<f64> = judged.iter().map(|photo| label(attribute, class(photo))).collect();
        let weights: Vec<f64> = judged.iter().map(|photo| self.weights[photo.photo]).collect();
        let errors: Vec<f64> = predicted.iter().zip(&labels).map(|(a, b)| (a - b).abs()).collect();
        LeftOutFigure {
            attribute: ATTRIBUTES[attribute].to_owned(),
            left_out,
            predictor: predictor.to_owned(),
            n: judged.len(),
            r: weighted_correlation(predicted, &labels, &weights),
            mae: weighted_mean(&errors, &weights),
            error_over_deviation,
        }
    }

    /// Returns the root mean square of error over standard deviation, where each fold is predicted by a calibration without
    /// its photos; `None` if there are too few folds.
    fn nested_ratio(&self, attribute: usize, kind: LeftOut) -> Option<f64> {
        let n_folds =
            self.judged.iter().filter(|photo| photo.kind == kind).map(|photo| photo.fold + 1).max()?;
        let (mut sum, mut total) = (0.0, 0.0);
        for fold in 0..n_folds {
            let is_inside = |photo: &JudgedPhoto| photo.kind == kind && photo.fold == fold;
            let inside: Vec<usize> =
                self.judged.iter().filter(|photo| is_inside(photo)).map(|photo| photo.photo).collect();
            let others = self.errors(attribute, &|photo| {
                self.is_calibrating(photo) && inside.binary_search(&photo.photo).is_err()
            });
            let Some(model) = DeviationModel::fit(&others) else { continue };
            let of_fold = self.errors(attribute, &is_inside);
            let weight: f64 = of_fold.iter().map(|error| error.weight).sum();
            if let Some(ratio) = model.ratio(&of_fold) {
                sum += weight * ratio * ratio;
                total += weight;
            }
        }
        (total > 0.0).then(|| (sum / total).sqrt())
    }
}

/// Name of the predictor that a model contains.
pub const OF_MODEL: &str = "the model";

type Predict = fn(&JudgedPhoto) -> Option<f64>;

/// Returns the predictors of an attribute that are compared, with their names.
fn predictors(attribute: usize) -> Vec<(&'static str, Predict)> {
    const OF_ROUGHNESS: [(&str, Predict); 4] = [
        (OF_MODEL, |photo| Some(photo.of.rough_smooth.mean)),
        ("class probabilities", |photo| Some(photo.of.roughness_of_classes)),
        ("heads of drawn materials", |photo| Some(photo.drawn_roughness?.mean)),
        ("mean of the others", |photo| Some(photo.mean_roughness)),
    ];
    const OF_HARDNESS: [(&str, Predict); 6] = [
        (OF_MODEL, |photo| Some(photo.of.hard_soft.mean)),
        ("ridge regression", |photo| photo.of.by_head.ridge),
        ("class probabilities", |photo| Some(photo.of.by_head.classes)),
        ("small networks", |photo| photo.of.by_head.network),
        ("kernel regression", |photo| photo.of.by_head.kernel),
        ("mean of the others", |photo| Some(photo.mean_hardness)),
    ];
    if attribute == 0 { OF_ROUGHNESS.to_vec() } else { OF_HARDNESS.to_vec() }
}

pub(crate) fn evidence_of(attribute: usize, of: &PhotoEvidence) -> Evidence {
    if attribute == 0 { of.rough_smooth } else { of.hard_soft }
}

fn label(attribute: usize, class: &MaterialClass) -> f64 {
    if attribute == 0 { class.rough_smooth } else { class.hard_soft }
}

fn doubts(photo: &SeenPhoto, probabilities: &[f64], unlikeness: f64) -> Vec<PictureDoubt> {
    all_doubts(photo.features.detail.doubt(), probabilities, unlikeness)
}

/// Returns all doubts about a photo: that of its pixels, and those of the model.
pub(crate) fn all_doubts(
    of_pixels: Option<PictureDoubt>,
    probabilities: &[f64],
    unlikeness: f64,
) -> Vec<PictureDoubt> {
    let of_model = [doubt_of_unlikeness(unlikeness), doubt_of_materials(probabilities)];
    of_pixels.into_iter().chain(of_model.into_iter().flatten()).collect()
}

#[cfg(test)]
mod tests;
