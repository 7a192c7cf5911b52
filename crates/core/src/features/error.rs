//! Why there are no features, and what to know about those that there are.

use std::fmt;

use crate::mfcc::{MfccError, MfccPlanError};
use crate::patterns::{PatternError, PatternWarning};
use crate::words::listed;

/// Why textures have no features.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FeatureError {
    /// It was asked to stop.
    #[error("the features were not finished")]
    Stopped,
    /// There are no textures.
    #[error("there are no textures to take features of")]
    NoTextures,
    /// Two textures have the same name.
    #[error("two textures are called {name}; features need names that differ")]
    SameName {
        /// The name.
        name: String,
    },
    /// The options make no coefficients at the rate of the patterns.
    #[error(transparent)]
    Mfcc(#[from] MfccPlanError),
    /// A texture has no patterns.
    #[error("{texture}: {source}")]
    Patterns {
        /// Name of the texture.
        texture: String,
        /// Why.
        source: PatternError,
    },
    /// A pattern has no coefficients.
    #[error("{texture} at {pattern}: {source}")]
    Coefficients {
        /// Name of the texture.
        texture: String,
        /// Name of the pattern.
        pattern: String,
        /// Why.
        source: MfccError,
    },
}

/// What to know about features.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum FeatureWarning {
    /// The patterns of a texture are not quite as asked.
    Pattern {
        /// Name of the texture.
        texture: String,
        /// In what.
        warning: PatternWarning,
    },
    /// Mel filters hold no bin of the transform: their logarithms never change.
    EmptyFilters {
        /// How many.
        n: usize,
        /// Of how many.
        n_filters: usize,
    },
    /// A feature is left out, since some textures have none.
    Absent {
        /// Name of the feature.
        feature: &'static str,
        /// Names of those textures.
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
                    "{n} of {n_filters} mel filters are empty; take a longer transform or fewer filters"
                )
            }
            Self::Absent { feature, textures } => {
                write!(f, "{feature} is left out: not known of {}", listed(textures))
            }
        }
    }
}
