//! Errors and warnings of feature extraction.

use std::fmt;

use crate::dsp::mfcc::{MfccError, MfccPlanError};
use crate::texture::patterns::{PatternError, PatternWarning};
use crate::words::listed;

/// Reasons why features cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FeatureError {
    /// The caller stopped the computation.
    #[error("the feature extraction was stopped before it finished")]
    Stopped,
    /// There are no textures.
    #[error("there are no textures; add at least one to compute features")]
    NoTextures,
    /// Two textures have the same name.
    #[error("two textures are named {name}; give each texture its own name")]
    SameName {
        /// The name.
        name: String,
    },
    /// The MFCC options are invalid at the sample rate of the patterns.
    #[error(transparent)]
    Mfcc(#[from] MfccPlanError),
    /// The patterns of a texture cannot be rendered.
    #[error("{texture}: {source}")]
    Patterns {
        /// Name of the texture.
        texture: String,
        /// Cause of the failure.
        source: PatternError,
    },
    /// The coefficients of a pattern cannot be computed.
    #[error("{texture} at {pattern}: {source}")]
    Coefficients {
        /// Name of the texture.
        texture: String,
        /// Name of the pattern.
        pattern: String,
        /// Cause of the failure.
        source: MfccError,
    },
}

/// A warning about computed features.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum FeatureWarning {
    /// The patterns of a texture differ from the requested ones.
    Pattern {
        /// Name of the texture.
        texture: String,
        /// How they differ.
        warning: PatternWarning,
    },
    /// Some mel filters contain no bin of the Fourier transform, so their outputs are constant.
    EmptyFilters {
        /// Number of empty filters.
        n: usize,
        /// Number of all filters.
        n_filters: usize,
    },
    /// A feature is left out because some textures lack it.
    Absent {
        /// Name of the feature.
        feature: &'static str,
        /// Names of the textures that lack it.
        textures: Vec<String>,
    },
}

impl fmt::Display for FeatureWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pattern { texture, warning } => write!(f, "{texture}: {warning}"),
            Self::EmptyFilters { n, n_filters } => {
                write!(
                    f,
                    "{n} of {n_filters} mel filters contain no bin of the Fourier transform; use a longer transform or fewer filters"
                )
            }
            Self::Absent { feature, textures } => {
                write!(f, "feature left out: {feature} is unknown for {}", listed(textures))
            }
        }
    }
}
