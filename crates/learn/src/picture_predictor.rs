//! Attribute prediction from pictures: a feature extractor followed by a trained head.

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::surfaces::picture_doubts::{Detail, doubt_of_unlikeness, widened};
use shagreen_core::surfaces::picture_features::{self, PictureError, Square};
use shagreen_core::surfaces::shading::Picture;

use crate::attribute_model::AttributeModel;
use crate::backbone::{Backbone, BackboneError};
use crate::model_file::sha256_of;
use crate::photo_set::PhotoFeatures;
use crate::picture_model::{FeatureExtractor, PictureModel, PictureModelError};

pub use crate::picture_prediction::{LikelyMaterial, PicturePrediction};

/// Head trained on texture statistics of drawn materials; needs no other file.
const BY_STATISTICS: &[u8] = include_bytes!("../../../assets/models/pictures-by-statistics.safetensors");
/// Head trained on EfficientNet-Lite0 features of drawn materials; the network weights are the user's file.
const BY_EFFICIENTNET: &[u8] =
    include_bytes!("../../../assets/models/pictures-by-efficientnet-lite0.safetensors");

/// Reasons why attributes cannot be predicted from a picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LookingError {
    /// The picture has no features.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The backbone network failed.
    #[error(transparent)]
    Backbone(#[from] BackboneError),
    /// The head failed or its file is invalid.
    #[error(transparent)]
    Model(#[from] PictureModelError),
    /// The head was trained on features of another extractor.
    #[error("the model was trained on features of {model}, but these come from {found}; {hint}")]
    ExtractorMismatch {
        /// Feature extractor used in training.
        model: String,
        /// Feature extractor available now.
        found: String,
        /// What to do next.
        hint: &'static str,
    },
}

/// Returns the features of a picture, from a backbone network or else texture statistics.
///
/// # Errors
/// [`LookingError::Picture`] for an unusable picture, [`LookingError::Backbone`] if the network fails.
pub fn see(backbone: Option<&Backbone>, picture: &Picture) -> Result<Vec<f32>, LookingError> {
    see_square(backbone, &picture_features::square(picture)?)
}

fn see_square(backbone: Option<&Backbone>, square: &Square) -> Result<Vec<f32>, LookingError> {
    Ok(match backbone {
        Some(backbone) => backbone.features(square)?,
        None => statistics(square),
    })
}

fn statistics(square: &Square) -> Vec<f32> {
    picture_features::features(square).into_iter().map(|x| x as f32).collect()
}

/// Returns the late features of the central square of a picture; texture statistics have no separate late features.
///
/// # Errors
/// As [`see`].
pub fn see_late(backbone: Option<&Backbone>, picture: &Picture) -> Result<Vec<f32>, LookingError> {
    late_of_square(backbone, &picture_features::square(picture)?)
}

fn late_of_square(backbone: Option<&Backbone>, square: &Square) -> Result<Vec<f32>, LookingError> {
    Ok(match backbone {
        Some(backbone) => backbone.late_features(square)?,
        None => statistics(square),
    })
}

/// Returns the early features of a photo and the late features of its views. With a network, it takes about six times as
/// long as [`see`].
///
/// # Errors
/// As [`see`].
pub fn see_photo(backbone: Option<&Backbone>, picture: &Picture) -> Result<PhotoFeatures, LookingError> {
    let square = picture_features::square(picture)?;
    let [whole, quarters @ ..] = &picture_features::views(picture)?;
    let [early, of_whole] = match backbone {
        // One evaluation gives both, unless the photo is so small that its view is interpolated.
        Some(backbone) if *whole == square => backbone.early_and_late_features(whole)?,
        _ => [see_square(backbone, &square)?, late_of_square(backbone, whole)?],
    };
    let mut late = vec![of_whole];
    for quarter in quarters {
        late.push(late_of_square(backbone, quarter)?);
    }
    let side_px = picture.width.min(picture.height);
    Ok(PhotoFeatures { early, late, detail: Detail::of(&square), side_px })
}

/// Returns the name of a feature extractor, with the start of its file hash for a network.
fn told(eyes: &FeatureExtractor) -> String {
    match eyes {
        FeatureExtractor::Statistics => eyes.name().to_owned(),
        FeatureExtractor::Network { sha256, .. } => {
            format!("{} ({})", eyes.name(), sha256.get(..12).unwrap_or(sha256))
        }
    }
}

/// A feature extractor with a matching head.
#[derive(Debug)]
pub struct PicturePredictor {
    backbone: Option<Backbone>,
    model: AttributeModel,
    sha256: String,
}

impl PicturePredictor {
    /// Returns the predictor of a model file and the network that it was trained with, if any.
    ///
    /// # Errors
    /// [`LookingError::ExtractorMismatch`] if they do not match, [`LookingError::Model`] for a file that is not a
    /// model of attributes from pictures.
    pub fn new(model: &[u8], backbone: Option<Backbone>) -> Result<Self, LookingError> {
        let sha256 = sha256_of(model);
        let model = AttributeModel::from_bytes(model)?;
        let backbone = backbone.filter(|_| *model.eyes() != FeatureExtractor::Statistics);
        let eyes = FeatureExtractor::of(backbone.as_ref());
        if *model.eyes() != eyes {
            return Err(LookingError::ExtractorMismatch {
                model: told(model.eyes()),
                found: told(&eyes),
                hint: if eyes.name() == model.eyes().name() {
                    "the network file differs: fetch it again with `shagreen model fetch`, or train a model with it"
                } else {
                    "give the file of the same network, or train another model with `shagreen train photo`"
                },
            });
        }
        Ok(Self { backbone, model, sha256 })
    }

    /// Returns the built-in predictor: with EfficientNet-Lite0 if it is given, else with texture statistics.
    ///
    /// # Errors
    /// Those of [`PicturePredictor::new`]; [`LookingError::ExtractorMismatch`] for any other network.
    pub fn built_in(backbone: Option<Backbone>) -> Result<Self, LookingError> {
        Self::new(if backbone.is_some() { BY_EFFICIENTNET } else { BY_STATISTICS }, backbone)
    }

    /// Returns the model.
    pub fn model(&self) -> &AttributeModel {
        &self.model
    }

    /// Returns the SHA-256 of the model's file.
    pub fn sha256(&self) -> &str {
        &self.sha256
    }

    /// Returns the attributes predicted from a picture, named by [`AttributeModel::attributes`], each 0 to 100, with the
    /// likely materials and with reasons to doubt them.
    ///
    /// # Errors
    /// [`LookingError::Picture`] for an unusable picture, [`LookingError::Backbone`] or [`LookingError::Model`] if a
    /// network fails.
    pub fn look(&self, picture: &Picture) -> Result<PicturePrediction, LookingError> {
        let backbone = self.backbone.as_ref();
        match &self.model {
            AttributeModel::Drawn(model) => drawn_prediction(model, backbone, picture),
            AttributeModel::Photos(model) => Ok(model.predict(&see_photo(backbone, picture)?)?),
        }
    }
}

/// Returns the prediction of heads that were trained on drawn materials alone. They know no materials.
fn drawn_prediction(
    model: &PictureModel,
    backbone: Option<&Backbone>,
    picture: &Picture,
) -> Result<PicturePrediction, LookingError> {
    let square = picture_features::square(picture)?;
    let features = see_square(backbone, &square)?;
    let of_unlikeness = doubt_of_unlikeness(model.unlikeness(&features)?);
    let doubts: Vec<_> = Detail::of(&square).doubt().into_iter().chain(of_unlikeness).collect();
    let estimates = model.predict(&features)?;
    let with_doubts = |of: Estimate| Estimate { mean: of.mean, deviation: widened(of.deviation, &doubts) };
    let attributes = estimates.into_iter().map(with_doubts).collect();
    Ok(PicturePrediction { attributes, materials: Vec::new(), doubts })
}

#[cfg(test)]
mod tests {
    use super::{BY_EFFICIENTNET, BY_STATISTICS, LookingError, PicturePredictor, see, see_late, see_photo};
    use crate::photo_model::made_up::photo_model;
    use crate::photo_set::made_up::photo_set;
    use crate::photo_set::{PhotoFeatures, PhotoSet};
    use crate::picture_model::FeatureExtractor;
    use shagreen_core::maths::rng::lcg_noise;
    use shagreen_core::surfaces::picture_doubts::PictureDoubt;
    use shagreen_core::surfaces::picture_features::{N_FEATURES, N_VIEWS};
    use shagreen_core::surfaces::shading::Picture;

    fn gray(side: usize) -> Picture {
        Picture { width: side, height: side, rgb: vec![128; 3 * side * side], millimeters: 20.0 }
    }

    #[test]
    fn the_heads_of_the_program_are_sound_and_know_whose_eyes_they_need() {
        let looker = PicturePredictor::new(BY_STATISTICS, None).unwrap();
        assert_eq!(looker.model().attributes(), ["rough-smooth", "hard-soft"]);
        assert_eq!((looker.model().eyes(), looker.sha256().len()), (&FeatureExtractor::Statistics, 64));
        let seen = looker.look(&gray(64)).unwrap();
        // A uniform gray picture is unlike the training pictures, so the standard deviation is large.
        let is_sound = |mean: f64| (0.0..=100.0).contains(&mean);
        assert!(seen.attributes.iter().all(|of| is_sound(of.mean) && of.deviation > 10.0), "{seen:?}");
        assert!(seen.doubts.contains(&PictureDoubt::NoDetail) && seen.materials.is_empty(), "{seen:?}");
        assert!(matches!(looker.look(&gray(8)), Err(LookingError::Picture(_))));
        assert_eq!(see(None, &gray(32)).unwrap().len(), N_FEATURES);
        let error = PicturePredictor::new(BY_EFFICIENTNET, None).unwrap_err().to_string();
        assert!(error.contains("EfficientNet-Lite0") && error.contains("statistics"), "{error}");
        assert!(matches!(PicturePredictor::new(b"", None), Err(LookingError::Model(_))));
    }

    fn noise(side: usize, seed: u64) -> Picture {
        let byte = |x: f64| (128.0 + 40.0 * x).clamp(0.0, 255.0) as u8;
        let rgb = lcg_noise(3 * side * side, seed).into_iter().map(byte).collect();
        Picture { rgb, ..gray(side) }
    }

    #[test]
    fn a_photo_is_seen_as_a_whole_and_in_quarters() {
        let photo = noise(300, 4);
        let seen = see_photo(None, &photo).unwrap();
        assert_eq!((seen.early.len(), seen.late.len()), (N_FEATURES, N_VIEWS));
        assert_eq!(seen.early, see(None, &photo).unwrap());
        // The whole view of a photo of this size is averaged in the same way.
        assert_eq!((&seen.late[0], seen.late[0].clone()), (&seen.early, see_late(None, &photo).unwrap()));
        assert!(seen.late[1..].iter().all(|quarter| quarter != &seen.early));
        // A smaller photo is interpolated.
        let small = see_photo(None, &noise(100, 4)).unwrap();
        assert_ne!(small.late[0], small.early);
        assert!(see_photo(None, &gray(8)).is_err());
    }

    #[test]
    fn a_model_of_labelled_photos_tells_materials_from_pixels() {
        // Noise of different grain stands for three materials.
        let material = |class: usize, seed: u64| {
            let cell = [1, 3, 12][class];
            let fine = noise(120, seed);
            let of = |i: usize| -> [u8; 3] {
                let (x, y) = (i % 120 / cell * cell, i / 120 / cell * cell);
                [0, 1, 2].map(|channel| fine.rgb[3 * (y * 120 + x) + channel])
            };
            Picture { rgb: (0..120 * 120).flat_map(of).collect(), ..fine }
        };
        let mut set: PhotoSet = photo_set(24, 1);
        for (index, photo) in set.photos.iter_mut().enumerate() {
            let picture = material(photo.class, index as u64);
            let PhotoFeatures { early, late, detail, side_px } = see_photo(None, &picture).unwrap();
            let variations = vec![late[0].clone(); 2];
            photo.features = PhotoFeatures { early, late: [late, variations].concat(), detail, side_px };
        }
        let bytes = photo_model(&set).to_bytes().unwrap();
        let looker = PicturePredictor::new(&bytes, None).unwrap();
        for class in 0..3 {
            let seen = looker.look(&material(class, 500)).unwrap();
            assert_eq!(seen.materials[0].name, set.classes[class].name, "{seen:?}");
            assert_eq!(seen.attributes.len(), 2);
        }
        let card = looker.look(&gray(120)).unwrap();
        assert!(card.doubts.contains(&PictureDoubt::NoDetail), "{card:?}");
    }
}
