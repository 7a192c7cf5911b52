//! Why an axis cannot be predicted.

use super::{FeatureMatrix, MIN_TEXTURES};
use crate::statistics::is_constant;

/// Why an axis cannot be predicted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SelectionError {
    /// It was asked to stop.
    #[error("the validation was not finished")]
    Stopped,
    /// There is no feature, or no texture.
    #[error("there are no features")]
    NoFeatures,
    /// A texture has another number of features than the first.
    #[error("texture {texture} has {n} features, the first has {expected}")]
    RowLength {
        /// Index of the texture.
        texture: usize,
        /// Its features.
        n: usize,
        /// Those of the first texture.
        expected: usize,
    },
    /// A feature is not a number.
    #[error(
        "feature {feature} of texture {texture} is not a finite number; leave the feature or the texture out"
    )]
    FeatureNotFinite {
        /// Index of the texture.
        texture: usize,
        /// Index of the feature.
        feature: usize,
    },
    /// Features and positions are of different textures.
    #[error(
        "{n_features} textures have features, {n_target} a position on the axis; give the same ones to both"
    )]
    TargetLength {
        /// Textures with features.
        n_features: usize,
        /// Textures with a position.
        n_target: usize,
    },
    /// A position is not on the axis.
    #[error("texture {texture} is at {value} on the axis, which runs from 0 to 100")]
    Target {
        /// Index of the texture.
        texture: usize,
        /// Its position.
        value: f64,
    },
    /// There are too few textures.
    #[error(
        "{n} textures are too few to predict an axis from features; {MIN_TEXTURES} are the least, 25 are usual"
    )]
    TooFew {
        /// How many there are.
        n: usize,
    },
    /// All textures have one position.
    #[error("all textures lie at the same place of the axis: there is nothing to predict")]
    ConstantTarget,
    /// All features are constant.
    #[error("no feature differs between textures: there is nothing to predict from")]
    ConstantFeatures,
    /// The folds do not fit the textures.
    #[error(
        "{n} textures cannot be split into {n_folds} folds, {n_repeats} times; ask for 2 to {n} folds, at least once"
    )]
    Folds {
        /// Textures.
        n: usize,
        /// Folds asked for.
        n_folds: usize,
        /// Repeats asked for.
        n_repeats: usize,
    },
}

pub(super) fn check(features: &FeatureMatrix, target: &[f64]) -> Result<(), SelectionError> {
    let n = features.n_textures();
    if n != target.len() {
        return Err(SelectionError::TargetLength { n_features: n, n_target: target.len() });
    }
    if let Some(texture) = target.iter().position(|t| !(0.0..=100.0).contains(t)) {
        return Err(SelectionError::Target { texture, value: target[texture] });
    }
    if n < MIN_TEXTURES {
        return Err(SelectionError::TooFew { n });
    }
    if is_constant(target) {
        return Err(SelectionError::ConstantTarget);
    }
    if (0..features.n_features()).all(|f| is_constant(features.column(f))) {
        return Err(SelectionError::ConstantFeatures);
    }
    Ok(())
}
