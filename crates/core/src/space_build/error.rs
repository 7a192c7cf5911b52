//! Why judgments make no space.

use crate::dissimilarities::DissimilaritiesError;
use crate::features::FeatureError;
use crate::mds::{MAX_DIMS, MdsError};
use crate::property::PropertyError;
use crate::ratings::{RatingsError, VoteError};
use crate::selection::SelectionError;
use crate::sorting::SortingError;
use crate::triangulation::TriangulationError;
use crate::words::counted;

/// Why judgments make no space.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpaceBuildError {
    /// It was asked to stop.
    #[error("the space was not finished")]
    Stopped,
    /// Not as many dimensions as a space has.
    #[error("a space of {n_dims} dimensions was asked for; ask for 2 to {MAX_DIMS}")]
    Dims {
        /// The dimensions asked for.
        n_dims: usize,
    },
    /// Too few textures.
    #[error(
        "{n_textures} textures were sorted: {n_dims} dimensions and the directions of adjectives in them need at least {}",
        .n_dims + 2
    )]
    TooFewTextures {
        /// Textures that were sorted.
        n_textures: usize,
        /// The dimensions asked for.
        n_dims: usize,
    },
    /// Two textures have one identifier.
    #[error("two textures are called \"{texture}\"; give one of them another id")]
    TextureTwice {
        /// The identifier.
        texture: String,
    },
    /// Something that is no texture was judged.
    #[error(
        "\"{texture}\" was {what}, but no texture of the library has this id; correct the name, or import the texture"
    )]
    UnknownTexture {
        /// The name.
        texture: String,
        /// What was done with it.
        what: &'static str,
    },
    /// Sortings and ratings are of different textures.
    #[error("no texture was both sorted and rated; give sortings and ratings of the same textures")]
    NothingShared,
    /// The sortings make no similarities.
    #[error(transparent)]
    Sorting(#[from] SortingError),
    /// The similarities are no dissimilarities.
    #[error(transparent)]
    Dissimilarities(#[from] DissimilaritiesError),
    /// There is no perceptual space.
    #[error(transparent)]
    Mds(MdsError),
    /// Nothing joins two parts of the textures.
    #[error(
        "no participant sorted textures of the group of \"{first}\" together with those of \"{second}\"; let some sort textures of both, or build two spaces"
    )]
    Apart {
        /// A texture of one part.
        first: String,
        /// One of the other.
        second: String,
    },
    /// The ratings make no table.
    #[error(transparent)]
    Ratings(#[from] RatingsError),
    /// The votes cannot be counted.
    #[error(transparent)]
    Votes(#[from] VoteError),
    /// There are too few pairs for two axes.
    #[error(
        "{} can be {}, two are needed; rate another pair, or vote again on which are relevant{reasons}",
        counted(*n_pairs, "adjective pair"),
        if *n_pairs == 1 { "an axis" } else { "axes" }
    )]
    TooFewPairs {
        /// Pairs that could be axes.
        n_pairs: usize,
        /// Why the others cannot, each after a semicolon.
        reasons: String,
    },
    /// A pair that was to be an axis was not rated, or was left out.
    #[error("\"{pair}\" cannot be an axis: {reason}; the pairs are {pairs}")]
    NoSuchAxis {
        /// The pair.
        pair: String,
        /// Why.
        reason: &'static str,
        /// Those that can.
        pairs: String,
    },
    /// An axis has no line.
    #[error("\"{pair}\" cannot be an axis: {source}")]
    Axis {
        /// The pair.
        pair: String,
        /// Why.
        source: PropertyError,
    },
    /// All textures fall onto one place of an axis.
    #[error("all textures lie at one place along \"{pair}\"; choose another axis")]
    FlatAxis {
        /// The pair.
        pair: String,
    },
    /// The textures cannot be described.
    #[error(transparent)]
    Features(FeatureError),
    /// An axis cannot be predicted.
    #[error("\"{pair}\" cannot be predicted: {source}")]
    Selection {
        /// The pair.
        pair: String,
        /// Why.
        source: SelectionError,
    },
    /// The places make no triangles.
    #[error(transparent)]
    Triangulation(#[from] TriangulationError),
}

impl From<MdsError> for SpaceBuildError {
    fn from(error: MdsError) -> Self {
        match error {
            MdsError::Stopped => Self::Stopped,
            other => Self::Mds(other),
        }
    }
}

impl From<FeatureError> for SpaceBuildError {
    fn from(error: FeatureError) -> Self {
        match error {
            FeatureError::Stopped => Self::Stopped,
            other => Self::Features(other),
        }
    }
}
