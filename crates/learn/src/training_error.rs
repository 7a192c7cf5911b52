//! Errors of training, reading or running a network of strokes.

use crate::model_file::ModelFileError;

/// Reasons why a network of strokes cannot be trained, read or run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TrainingError {
    /// There is too little training data.
    #[error(
        "training needs 2 textures with strokes of {n_samples} samples, got {n_segments} segments of {n_textures} textures; add strokes or textures"
    )]
    TooFew {
        /// Number of segments.
        n_segments: usize,
        /// Number of textures.
        n_textures: usize,
        /// Samples per segment.
        n_samples: usize,
    },
    /// A size is zero or too large.
    #[error("invalid network or batch size; sizes must be above zero and within limits")]
    Sizes,
    /// A stroke has another number of acceleration axes than the network reads.
    #[error(
        "a stroke has {n_found} acceleration signals, the network reads {n_needed}; for 3, give recordings with three axes, for 1, the combined signal"
    )]
    Axes {
        /// Number of axes of the stroke.
        n_found: usize,
        /// Number of axes that the network reads.
        n_needed: usize,
    },
    /// The loss is not finite.
    #[error("training diverged in epoch {round}; start again with another seed, in another folder")]
    Astray {
        /// Number of the epoch, from 1.
        round: usize,
    },
    /// The model card does not match the network.
    #[error("the model card does not fit the network's {n_outputs} attributes; use the card of this network")]
    Card {
        /// Number of attributes of the network.
        n_outputs: usize,
    },
    /// The saved state belongs to another training.
    #[error("the saved state has other settings or textures; start again in another folder")]
    Other,
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] ModelFileError),
    /// A tensor operation failed.
    #[error("the network could not be evaluated: {0}")]
    Tensor(#[from] candle_core::Error),
}
