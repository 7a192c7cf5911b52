//! Attribute prediction from pictures: a feature extractor followed by a trained head.

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::surfaces::picture_features::{self, PictureError};
use shagreen_core::surfaces::shading::Picture;

use crate::backbone::{Backbone, BackboneError};
use crate::model_file::sha256_of;
use crate::picture_model::{FeatureExtractor, PictureModel, PictureModelError};

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
    let square = picture_features::square(picture)?;
    Ok(match backbone {
        Some(backbone) => backbone.features(&square)?,
        None => picture_features::features(&square).into_iter().map(|x| x as f32).collect(),
    })
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
    model: PictureModel,
    sha256: String,
}

impl PicturePredictor {
    /// Returns the predictor of a head file and the network that it was trained with, if any.
    ///
    /// # Errors
    /// [`LookingError::ExtractorMismatch`] if they do not match, [`LookingError::Model`] for a file that is not a head.
    pub fn new(model: &[u8], backbone: Option<Backbone>) -> Result<Self, LookingError> {
        let sha256 = sha256_of(model);
        let model = PictureModel::from_bytes(model)?;
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

    /// Returns the head.
    pub fn model(&self) -> &PictureModel {
        &self.model
    }

    /// Returns the SHA-256 of the head's file.
    pub fn sha256(&self) -> &str {
        &self.sha256
    }

    /// Returns the predicted attributes of a picture, named by [`PictureModel::attributes`], each 0 to 100.
    ///
    /// # Errors
    /// [`LookingError::Picture`] for an unusable picture, [`LookingError::Backbone`] or [`LookingError::Model`] if a
    /// network fails.
    pub fn look(&self, picture: &Picture) -> Result<Vec<Estimate>, LookingError> {
        Ok(self.model.predict(&see(self.backbone.as_ref(), picture)?)?)
    }
}

#[cfg(test)]
mod tests {
    use super::{BY_EFFICIENTNET, BY_STATISTICS, LookingError, PicturePredictor, see};
    use crate::picture_model::FeatureExtractor;
    use shagreen_core::surfaces::picture_features::N_FEATURES;
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
        assert!(seen.iter().all(|of| (0.0..=100.0).contains(&of.mean) && of.deviation > 10.0), "{seen:?}");
        assert!(matches!(looker.look(&gray(8)), Err(LookingError::Picture(_))));
        assert_eq!(see(None, &gray(32)).unwrap().len(), N_FEATURES);
        let error = PicturePredictor::new(BY_EFFICIENTNET, None).unwrap_err().to_string();
        assert!(error.contains("EfficientNet-Lite0") && error.contains("statistics"), "{error}");
        assert!(matches!(PicturePredictor::new(b"", None), Err(LookingError::Model(_))));
    }
}
