//! Attributes and materials predicted from photos, by a model trained on labelled photos of materials.
//!
//! The hardness comes from heads on late features of several views, trained on the physical hardness of the class of each
//! photo. The roughness is the mean of two predictions: that of heads on early features, trained on drawn materials, and
//! that of the class probabilities with the roughness of each class. Photos with few pixels have the second one alone. The
//! standard deviations are scaled to the errors on photos whose whole class or source was left out of the training.

use candle_core::Device;
use serde::{Deserialize, Serialize};
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::surfaces::picture_features::SIDE;

use crate::model_file::{self, Numbers};
use crate::photo_card::PhotoCard;
use crate::photo_config::PhotoConfig;
use crate::photo_deviation::DeviationModel;
use crate::photo_evidence::evidence;
use crate::photo_heads::{HeadParts, KernelSize, PhotoHeads};
use crate::photo_set::{MaterialClass, PhotoFeatures, PhotoSet};
use crate::photo_validation::{ATTRIBUTES, Calibrated, JudgedPhoto, Validation, all_doubts, evidence_of};
use crate::picture_model::{self, FeatureExtractor, PictureModel, PictureModelError};
use crate::picture_prediction::{PicturePrediction, likely_materials};

/// Kind of the file.
pub(crate) const MODEL: &str = "attributes from photos";
/// Beginnings of the names of tensors.
const OF_DRAWN: &str = "drawn.";
const OF_PHOTOS: &str = "photo.";

/// Metadata of a model file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct About {
    attributes: Vec<String>,
    learned_from: String,
    /// Metadata of the heads trained on drawn materials.
    drawn: picture_model::About,
    classes: Vec<MaterialClass>,
    /// Number of features that the heads for photos use.
    n_features: usize,
    has_ridge: bool,
    n_networks: usize,
    #[serde(default)]
    kernel: Option<KernelSize>,
    /// Standard deviations of each attribute.
    deviations: [DeviationModel; 2],
    /// Distance from the training photos that counts as usual.
    usual_distance: f64,
    card: PhotoCard,
}

/// A model trained on labelled photos and on drawn materials.
#[derive(Clone, Debug)]
pub struct PhotoModel {
    about: About,
    drawn: PictureModel,
    heads: PhotoHeads,
}

/// Returns the roughness that heads trained on drawn materials predict from early features; `None` for a photo with fewer
/// pixels than the network sees, since interpolated pixels have none of the fine detail that these heads were trained on.
///
/// # Errors
/// [`PictureModelError::NoRoughness`], and those of [`PictureModel::predict`].
pub fn drawn_roughness(
    drawn: &PictureModel,
    features: &PhotoFeatures,
) -> Result<Option<Estimate>, PictureModelError> {
    let index = drawn.attributes().iter().position(|name| name == ATTRIBUTES[0]);
    let estimates = drawn.predict(&features.early)?;
    let estimate = index.and_then(|index| estimates.get(index)).copied();
    let is_large = features.side_px >= SIDE;
    estimate.map(|estimate| is_large.then_some(estimate)).ok_or(PictureModelError::NoRoughness)
}

impl PhotoModel {
    /// Trains a model on all photos of a set. Its standard deviations are scaled to the errors of `judged`, the predictions
    /// for photos that were left out ([`crate::photo_validation::judge`]).
    ///
    /// `card` describes the data; its number of photos, settings and figures are filled in.
    ///
    /// # Errors
    /// [`PictureModelError::Photos`] for unusable photos, [`PictureModelError::Unjudged`] without errors,
    /// [`PictureModelError::NoRoughness`] if the heads do not predict roughness.
    pub fn learn(
        set: &PhotoSet,
        drawn: PictureModel,
        judged: &[JudgedPhoto],
        config: &PhotoConfig,
        card: PhotoCard,
    ) -> Result<Self, PictureModelError> {
        if !drawn.attributes().iter().any(|name| name == ATTRIBUTES[0]) {
            return Err(PictureModelError::NoRoughness);
        }
        let validation = Validation::new(set, judged, config);
        let Calibrated { deviations, usual_distance } =
            validation.calibrated().ok_or(PictureModelError::Unjudged)?;
        let all: Vec<usize> = (0..set.photos.len()).collect();
        let heads = PhotoHeads::learn(set, &all, config)?;
        let HeadParts { has_ridge, kernel, n_networks } = heads.parts();
        let card = PhotoCard {
            n_photos: set.photos.len(),
            n_classes: set.classes.len(),
            settings: config.clone(),
            figures: validation.figures(),
            ..card
        };
        let about = About {
            attributes: ATTRIBUTES.map(str::to_owned).to_vec(),
            learned_from: format!(
                "{} photos of {} classes of materials and {}",
                card.n_photos,
                card.n_classes,
                drawn.learned_from()
            ),
            drawn: drawn.about().clone(),
            classes: set.classes.clone(),
            n_features: heads.n_features(),
            has_ridge,
            n_networks,
            kernel,
            deviations,
            usual_distance,
            card,
        };
        Ok(Self { about, drawn, heads })
    }

    /// Returns the feature extractor that the model needs.
    pub fn eyes(&self) -> &FeatureExtractor {
        self.drawn.eyes()
    }

    /// Returns the names of the predicted attributes: rough-smooth and hard-soft.
    pub fn attributes(&self) -> &[String] {
        &self.about.attributes
    }

    /// Returns a description of the training data.
    pub fn learned_from(&self) -> &str {
        &self.about.learned_from
    }

    /// Returns the model card.
    pub fn card(&self) -> &PhotoCard {
        &self.about.card
    }

    /// Returns the heads trained on drawn materials.
    pub fn drawn(&self) -> &PictureModel {
        &self.drawn
    }

    /// Returns the prediction from the features of a photo and of its views.
    ///
    /// # Errors
    /// [`PictureModelError::Picture`] or [`PictureModelError::Photos`] for another number of features, or a feature that is
    /// not finite.
    pub fn predict(&self, features: &PhotoFeatures) -> Result<PicturePrediction, PictureModelError> {
        let drawn = drawn_roughness(&self.drawn, features)?;
        let outputs = self.heads.look(&features.late)?;
        let of = evidence(&outputs, drawn, &self.about.classes, &self.about.card.settings);
        let unlikeness = of.distance / self.about.usual_distance;
        let doubts = all_doubts(features.detail.doubt(), &of.probabilities, unlikeness);
        let estimate = |(attribute, deviation): (usize, &DeviationModel)| {
            let of_attribute = evidence_of(attribute, &of);
            Estimate {
                mean: of_attribute.mean,
                deviation: deviation.deviation(&of_attribute, unlikeness, &doubts),
            }
        };
        let names = self.about.classes.iter().map(|class| class.name.as_str());
        Ok(PicturePrediction {
            attributes: self.about.deviations.iter().enumerate().map(estimate).collect(),
            materials: likely_materials(names.zip(of.probabilities.iter().copied())),
            doubts,
        })
    }

    /// Returns the bytes of the model's file.
    ///
    /// # Errors
    /// [`PictureModelError::File`] if a weight is not finite.
    pub fn to_bytes(&self) -> Result<Vec<u8>, PictureModelError> {
        let mut numbers = Numbers::new();
        self.drawn.add_to(&mut numbers, OF_DRAWN)?;
        self.heads.add_to(&mut numbers, OF_PHOTOS)?;
        Ok(model_file::write(MODEL, &self.about, &numbers)?)
    }

    /// Returns the model of a file.
    ///
    /// # Errors
    /// [`PictureModelError::File`] or [`PictureModelError::Photos`] for an invalid file, [`PictureModelError::Settings`] for
    /// impossible numbers.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, PictureModelError> {
        let device: Device = crate::device::best();
        let (about, numbers) = model_file::read::<About>(MODEL, bytes, &device)?;
        let is_label = |label: f64, sd: f64| (0.0..=100.0).contains(&label) && sd.is_finite() && sd >= 0.0;
        let is_possible = about.attributes == ATTRIBUTES
            && about.deviations.iter().all(|deviation| deviation.is_sound())
            && about.usual_distance.is_finite()
            && about.usual_distance > 0.0
            && about.classes.iter().all(|class| {
                is_label(class.hard_soft, class.hard_soft_sd)
                    && is_label(class.rough_smooth, class.rough_smooth_sd)
            });
        if !is_possible {
            return Err(PictureModelError::Settings);
        }
        let sizes = [about.n_features, about.classes.len()];
        let parts =
            HeadParts { has_ridge: about.has_ridge, kernel: about.kernel, n_networks: about.n_networks };
        let heads = PhotoHeads::read(&numbers, OF_PHOTOS, &about.card.settings, sizes, parts)?;
        let drawn = PictureModel::read(about.drawn.clone(), &numbers, OF_DRAWN, device)?;
        Ok(Self { about, drawn, heads })
    }
}

/// Made-up models for tests.
#[cfg(test)]
pub(crate) mod made_up;

#[cfg(test)]
mod tests;
