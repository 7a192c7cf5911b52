//! What a picture would feel like: whoever looks at it, and the head that learned from what they see.

use shagreen_core::gaussian_process::Estimate;
use shagreen_core::picture_features::{self, PictureError};
use shagreen_core::shading::Picture;

use crate::backbone::{Backbone, BackboneError};
use crate::model_file::sha256_of;
use crate::picture_model::{Eyes, PictureModel, PictureModelError};

/// Learned from drawn materials by what statistics see; needs nothing else.
const BY_STATISTICS: &[u8] = include_bytes!("../../../assets/models/pictures-by-statistics.safetensors");
/// The same by EfficientNet-Lite0, whose numbers are the user's file.
const BY_EFFICIENTNET: &[u8] =
    include_bytes!("../../../assets/models/pictures-by-efficientnet-lite0.safetensors");

/// Why a picture says nothing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LookingError {
    /// It is no picture to look at.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The network cannot be worked out.
    #[error(transparent)]
    Backbone(#[from] BackboneError),
    /// The head cannot be worked out.
    #[error(transparent)]
    Model(#[from] PictureModelError),
    /// The head learned with other eyes.
    #[error("the model learned from what {model} sees, this is {found}; {hint}")]
    OtherEyes {
        /// Who looked when it learned.
        model: String,
        /// Who would look now.
        found: String,
        /// What to do.
        hint: &'static str,
    },
}

/// What is seen in a picture.
///
/// # Errors
/// See [`LookingError`].
pub fn see(backbone: Option<&Backbone>, picture: &Picture) -> Result<Vec<f32>, LookingError> {
    let square = picture_features::square(picture)?;
    Ok(match backbone {
        Some(backbone) => backbone.features(&square)?,
        None => picture_features::features(&square).into_iter().map(|x| x as f32).collect(),
    })
}

/// Eyes by their name, and which of that name.
fn told(eyes: &Eyes) -> String {
    match eyes {
        Eyes::Statistics => eyes.name().to_owned(),
        Eyes::Network { sha256, .. } => format!("{} ({})", eyes.name(), sha256.get(..12).unwrap_or(sha256)),
    }
}

/// Eyes and a head that belong together.
#[derive(Debug)]
pub struct Looker {
    backbone: Option<Backbone>,
    model: PictureModel,
    sha256: String,
}

impl Looker {
    /// The head of a file, and the network that it learned with, if it did with one.
    ///
    /// # Errors
    /// [`LookingError::OtherEyes`] where they do not belong together, [`LookingError::Model`] for a file that is no head.
    pub fn new(model: &[u8], backbone: Option<Backbone>) -> Result<Self, LookingError> {
        let sha256 = sha256_of(model);
        let model = PictureModel::from_bytes(model)?;
        let backbone = backbone.filter(|_| *model.eyes() != Eyes::Statistics);
        let eyes = Eyes::of(backbone.as_ref());
        if *model.eyes() != eyes {
            return Err(LookingError::OtherEyes {
                model: told(model.eyes()),
                found: told(&eyes),
                hint: if eyes.name() == model.eyes().name() {
                    "the file of the network is another one: fetch it again by `shagreen model fetch`, or train a model with it"
                } else {
                    "name the file of the same network, or train another model by `shagreen train photo`"
                },
            });
        }
        Ok(Self { backbone, model, sha256 })
    }

    /// The head that comes with the program: with EfficientNet-Lite0 where that is given, else with statistics.
    ///
    /// # Errors
    /// As [`Looker::new`]; [`LookingError::OtherEyes`] for any other network.
    pub fn built_in(backbone: Option<Backbone>) -> Result<Self, LookingError> {
        Self::new(if backbone.is_some() { BY_EFFICIENTNET } else { BY_STATISTICS }, backbone)
    }

    /// The head.
    pub fn model(&self) -> &PictureModel {
        &self.model
    }

    /// SHA-256 of the head's file.
    pub fn sha256(&self) -> &str {
        &self.sha256
    }

    /// What a picture would feel like: [`PictureModel::attributes`], each from 0 to 100.
    ///
    /// # Errors
    /// See [`LookingError`].
    pub fn look(&self, picture: &Picture) -> Result<Vec<Estimate>, LookingError> {
        Ok(self.model.predict(&see(self.backbone.as_ref(), picture)?)?)
    }
}

#[cfg(test)]
mod tests {
    use super::{BY_EFFICIENTNET, BY_STATISTICS, Looker, LookingError, see};
    use crate::picture_model::Eyes;
    use shagreen_core::picture_features::N_FEATURES;
    use shagreen_core::shading::Picture;

    fn gray(side: usize) -> Picture {
        Picture { width: side, height: side, rgb: vec![128; 3 * side * side], millimeters: 20.0 }
    }

    #[test]
    fn the_heads_of_the_program_are_sound_and_know_whose_eyes_they_need() {
        let looker = Looker::new(BY_STATISTICS, None).unwrap();
        assert_eq!(looker.model().attributes(), ["rough-smooth", "hard-soft"]);
        assert_eq!((looker.model().eyes(), looker.sha256().len()), (&Eyes::Statistics, 64));
        let seen = looker.look(&gray(64)).unwrap();
        // Nothing of one color was learned from: it is unsure.
        assert!(seen.iter().all(|of| (0.0..=100.0).contains(&of.mean) && of.deviation > 10.0), "{seen:?}");
        assert!(matches!(looker.look(&gray(8)), Err(LookingError::Picture(_))));
        assert_eq!(see(None, &gray(32)).unwrap().len(), N_FEATURES);
        let error = Looker::new(BY_EFFICIENTNET, None).unwrap_err().to_string();
        assert!(error.contains("EfficientNet-Lite0") && error.contains("statistics"), "{error}");
        assert!(matches!(Looker::new(b"", None), Err(LookingError::Model(_))));
    }
}
