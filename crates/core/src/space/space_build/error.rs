//! Errors of building a space.

use crate::people::dissimilarities::DissimilaritiesError;
use crate::people::mds::{MAX_DIMS, MdsError};
use crate::people::property::PropertyError;
use crate::people::ratings::{RatingsError, VoteError};
use crate::people::sorting::SortingError;
use crate::space::SpaceError;
use crate::space::features::FeatureError;
use crate::space::selection::SelectionError;
use crate::space::space_build::LEAST_RATED;
use crate::words::counted;

/// Reasons why no space can be built from the judgments.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpaceBuildError {
    /// The caller stopped the build.
    #[error("building the space was stopped before it finished")]
    Stopped,
    /// The number of dimensions is out of range.
    #[error("cannot build a space of {n_dims} dimensions; choose 2 to {MAX_DIMS}")]
    Dims {
        /// Number of dimensions requested.
        n_dims: usize,
    },
    /// Too few textures were sorted.
    #[error(
        "only {n_textures} textures were sorted; adjective directions in {n_dims} dimensions need at least {}",
        .n_dims + 2
    )]
    TooFewTextures {
        /// Number of sorted textures.
        n_textures: usize,
        /// Number of dimensions requested.
        n_dims: usize,
    },
    /// Two textures have the same identifier.
    #[error("two textures have the id \"{texture}\"; give one of them another id")]
    TextureTwice {
        /// The identifier.
        texture: String,
    },
    /// An unknown texture was sorted or rated.
    #[error(
        "\"{texture}\" was {what}, but no texture of the library has this id; correct the name, or import the texture"
    )]
    UnknownTexture {
        /// The unknown name.
        texture: String,
        /// "sorted" or "rated".
        what: &'static str,
    },
    /// No rating is filled in.
    #[error(
        "no rating is filled in; enter a number from 0 to 100 for each texture and adjective pair that a participant rated"
    )]
    NoRatings,
    /// Too few textures are rated on both axes, and there are no sorts.
    #[error(
        "only {} rated on both axes ({} and {}); a space from ratings alone needs at least {LEAST_RATED}; rate more textures, or choose other axes",
        if *n_textures == 1 { "1 texture is".to_owned() } else { format!("{n_textures} textures are") },
        axes[0],
        axes[1]
    )]
    TooFewRated {
        /// Number of textures rated on both.
        n_textures: usize,
        /// Names of the pairs.
        axes: [String; 2],
    },
    /// No two pairs share enough textures, and there are no sorts.
    #[error(
        "no two adjective pairs were rated on the same {LEAST_RATED} textures; rate every texture on every adjective pair"
    )]
    RatedApart,
    /// No texture was both sorted and rated.
    #[error("no texture was both sorted and rated; provide sorts and ratings of the same textures")]
    NothingShared,
    /// The similarities cannot be computed.
    #[error(transparent)]
    Sorting(#[from] SortingError),
    /// The dissimilarities are invalid.
    #[error(transparent)]
    Dissimilarities(#[from] DissimilaritiesError),
    /// The perceptual space cannot be scaled.
    #[error(transparent)]
    Mds(MdsError),
    /// The sorts fall into sets of textures without a connection.
    #[error(
        "the sorts fall into separate sets of textures, one with \"{first}\" and one with \"{second}\"; collect sorts that contain textures of both sets, or build a space for each set"
    )]
    Apart {
        /// A texture of the first set.
        first: String,
        /// A texture of the other set.
        second: String,
    },
    /// The ratings do not form a table.
    #[error(transparent)]
    Ratings(#[from] RatingsError),
    /// The votes cannot be counted.
    #[error(transparent)]
    Votes(#[from] VoteError),
    /// Fewer than two adjective pairs can be axes.
    #[error(
        "{} can be {}, but two are needed{reasons}; rate another adjective pair, or repeat the relevance vote",
        counted(*n_pairs, "adjective pair"),
        if *n_pairs == 1 { "an axis" } else { "axes" }
    )]
    TooFewPairs {
        /// Number of pairs that can be axes.
        n_pairs: usize,
        /// Reasons why the other pairs cannot be axes, each after a semicolon.
        reasons: String,
    },
    /// The pair requested as an axis was not rated, is excluded, or is already the other axis.
    #[error("\"{pair}\" cannot be an axis: {reason}; available pairs: {pairs}")]
    NoSuchAxis {
        /// Name of the pair.
        pair: String,
        /// Reason why it cannot be an axis.
        reason: String,
        /// Names of the pairs that can be axes.
        pairs: String,
    },
    /// Property fitting of an axis fails.
    #[error("\"{pair}\" cannot be an axis: {source}")]
    Axis {
        /// Name of the pair.
        pair: String,
        /// Cause of the failure.
        source: PropertyError,
    },
    /// All textures have the same position on an axis.
    #[error("all textures have the same position on \"{pair}\"; choose another axis")]
    FlatAxis {
        /// Name of the pair.
        pair: String,
    },
    /// The features cannot be computed.
    #[error(transparent)]
    Features(FeatureError),
    /// An axis cannot be predicted.
    #[error("\"{pair}\" cannot be predicted: {source}")]
    Selection {
        /// Name of the pair.
        pair: String,
        /// Cause of the failure.
        source: SelectionError,
    },
    /// The positions cannot be triangulated.
    #[error(transparent)]
    Space(#[from] SpaceError),
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
