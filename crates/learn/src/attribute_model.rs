//! A model that predicts attributes from pictures, of either kind of file: heads trained on drawn materials, or a model
//! trained on labelled photos as well.

use crate::model_file::kind_of;
use crate::photo_card::PhotoCard;
use crate::photo_model::{self, PhotoModel};
use crate::picture_model::{FeatureExtractor, PictureModel, PictureModelError};

/// A model of attributes from pictures.
#[derive(Clone, Debug)]
pub enum AttributeModel {
    /// Heads trained on drawn materials.
    Drawn(Box<PictureModel>),
    /// A model trained on labelled photos, with such heads inside.
    Photos(Box<PhotoModel>),
}

impl AttributeModel {
    /// Returns the model of a file.
    ///
    /// # Errors
    /// As [`PictureModel::from_bytes`] and [`PhotoModel::from_bytes`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, PictureModelError> {
        if kind_of(bytes)? == photo_model::MODEL {
            Ok(Self::Photos(Box::new(PhotoModel::from_bytes(bytes)?)))
        } else {
            Ok(Self::Drawn(Box::new(PictureModel::from_bytes(bytes)?)))
        }
    }

    /// Returns the feature extractor that the model needs.
    pub fn eyes(&self) -> &FeatureExtractor {
        self.drawn().eyes()
    }

    /// Returns the names of the predicted attributes.
    pub fn attributes(&self) -> &[String] {
        match self {
            Self::Drawn(model) => model.attributes(),
            Self::Photos(model) => model.attributes(),
        }
    }

    /// Returns a description of the training data.
    pub fn learned_from(&self) -> &str {
        match self {
            Self::Drawn(model) => model.learned_from(),
            Self::Photos(model) => model.learned_from(),
        }
    }

    /// Returns the heads trained on drawn materials.
    pub fn drawn(&self) -> &PictureModel {
        match self {
            Self::Drawn(model) => model,
            Self::Photos(model) => model.drawn(),
        }
    }

    /// Returns the model card of a model trained on labelled photos.
    pub fn card(&self) -> Option<&PhotoCard> {
        match self {
            Self::Drawn(_) => None,
            Self::Photos(model) => Some(model.card()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::AttributeModel;
    use crate::photo_model::made_up::{drawn_heads, photo_model};
    use crate::photo_set::made_up::photo_set;

    #[test]
    fn both_kinds_of_files_are_read() {
        let drawn = drawn_heads(2);
        let read = AttributeModel::from_bytes(&drawn.to_bytes().unwrap()).unwrap();
        assert!(matches!(&read, AttributeModel::Drawn(_)) && read.card().is_none());
        assert_eq!(read.learned_from(), "pictures of 40 drawn materials");
        let photos = photo_model(&photo_set(24, 2));
        let read = AttributeModel::from_bytes(&photos.to_bytes().unwrap()).unwrap();
        assert!(matches!(&read, AttributeModel::Photos(_)));
        assert_eq!(read.card(), Some(photos.card()));
        assert_eq!((read.eyes(), read.attributes()), (drawn.eyes(), drawn.attributes()));
        assert_eq!(read.drawn().to_bytes().unwrap(), drawn.to_bytes().unwrap());
        assert!(AttributeModel::from_bytes(b"").is_err());
    }
}
