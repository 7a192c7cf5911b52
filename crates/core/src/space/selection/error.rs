//! Errors of feature selection and axis prediction.

use super::MIN_TEXTURES;

/// Reasons why an axis cannot be predicted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SelectionError {
    /// The caller stopped the computation.
    #[error("the validation was stopped before it finished")]
    Stopped,
    /// There are no features or no textures.
    #[error("there are no features; add at least one feature and one texture")]
    NoFeatures,
    /// A texture has a different number of features than the first.
    #[error("texture {texture} has {n} features, but the first texture has {expected}")]
    RowLength {
        /// Index of the texture.
        texture: usize,
        /// Number of its features.
        n: usize,
        /// Number of features of the first texture.
        expected: usize,
    },
    /// A feature is not finite.
    #[error(
        "feature {feature} of texture {texture} is not a finite number; leave the feature or the texture out"
    )]
    FeatureNotFinite {
        /// Index of the texture.
        texture: usize,
        /// Index of the feature.
        feature: usize,
    },
    /// The numbers of textures with features and with positions differ.
    #[error(
        "{n_features} textures have features but {n_target} have a position on the axis; use the same textures for both"
    )]
    TargetLength {
        /// Number of textures with features.
        n_features: usize,
        /// Number of textures with a position.
        n_target: usize,
    },
    /// A position is outside the axis.
    #[error("texture {texture} is at {value} on the axis; a position must be between 0 and 100")]
    Target {
        /// Index of the texture.
        texture: usize,
        /// Its position.
        value: f64,
    },
    /// There are too few textures.
    #[error(
        "{n} textures are too few to predict an axis from features; use at least {MIN_TEXTURES}, preferably 25"
    )]
    TooFew {
        /// Number of textures.
        n: usize,
    },
    /// All textures have the same position.
    #[error("all textures have the same position on the axis, so there is nothing to predict")]
    ConstantTarget,
    /// All features are constant.
    #[error("no feature differs between textures, so there is nothing to predict from")]
    ConstantFeatures,
    /// The number of folds or repeats is invalid.
    #[error(
        "{n} textures cannot be split into {n_folds} folds, {n_repeats} times; choose 2 to {n} folds and at least 1 repeat"
    )]
    Folds {
        /// Number of textures.
        n: usize,
        /// Number of folds requested.
        n_folds: usize,
        /// Number of repeats requested.
        n_repeats: usize,
    },
}
