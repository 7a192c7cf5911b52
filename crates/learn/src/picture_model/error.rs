//! Errors of models of attributes from pictures.

use crate::model_file::ModelFileError;
use crate::photo_heads::PhotoHeadsError;

/// Reasons why a model cannot be trained, read or used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureModelError {
    /// There are too few pictures.
    #[error("training needs at least {least} pictures, got {n}; add more")]
    TooFew {
        /// Number of pictures.
        n: usize,
        /// Smallest number of pictures.
        least: usize,
    },
    /// Features or labels differ in number between pictures, or a value is not finite.
    #[error(
        "picture {index} (from 0) has {n_features} features and {n_labels} labels, needs {expected:?}, all finite; extract its features again"
    )]
    Picture {
        /// Index of the picture.
        index: usize,
        /// Number of its features.
        n_features: usize,
        /// Number of its labels.
        n_labels: usize,
        /// Required numbers of features and labels.
        expected: [usize; 2],
    },
    /// A setting or a size in a file is out of range.
    #[error("the model's settings are invalid; check layer sizes, heads, batch size and label noise")]
    Settings,
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] ModelFileError),
    /// Heads for photos cannot be trained, read or used.
    #[error(transparent)]
    Photos(#[from] PhotoHeadsError),
    /// There are no errors of left-out photos, by which standard deviations could be scaled.
    #[error(
        "no photo was left out of a training, so the errors are unknown; leave classes and sources out first"
    )]
    Unjudged,
    /// The heads do not predict roughness.
    #[error(
        "the heads trained on drawn materials do not predict rough-smooth; choose another model, or train one"
    )]
    NoRoughness,
    /// A tensor operation failed.
    #[error("the head could not be evaluated: {0}")]
    Tensor(#[from] candle_core::Error),
}
