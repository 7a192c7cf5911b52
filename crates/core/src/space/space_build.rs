//! Construction of an authoring space from human judgments and signal features.
//!
//! # With sorts
//!
//! Sorts yield a perceptual space ([`crate::people::sorting`], [`crate::people::mds`]), and ratings yield a direction
//! of each adjective pair in this space ([`crate::people::property`]). The projections of the textures onto the
//! directions of two adjective pairs are their perceived positions on the two axes. Features of the textures'
//! vibrations predict these positions ([`crate::space::features`], [`crate::space::selection`]). Method: W. Hassan, A.
//! Abdulali and S. Jeon, "Authoring new haptic textures based on interpolation of real textures in affective space",
//! IEEE Transactions on Industrial Electronics 2020.
//!
//! The axes need not be orthogonal in the perceptual space: both directions and their angle are reported.
//!
//! # From ratings alone
//!
//! Without sorts, the perceived position of a texture is its mean rating on two adjective pairs, with its standard error.
//! The *attribute paper* uses mean ratings in this way: "Predicting Perceptual Haptic Attributes of Textured Surface from
//! Tactile Data Based on Deep CNN-LSTM Network", VRST 2023. There, relevance votes select the adjectives, and those with
//! an antonym among them form the pairs. Here, the two least correlated pairs with reliable ratings become the axes.
//!
//! # Prediction
//!
//! The prediction of an axis is always reported with nested cross-validation, and with a permutation test if
//! [`SpaceOptions::n_permutations`] is above 0.

mod adjectives;
mod axes;
mod axis_choice;
mod error;
mod options;
mod rated;
mod scaling;
mod sorted;
mod stability;
mod step;
mod validation;
mod vibrations;
mod warnings;

use std::collections::BTreeSet;

use crate::people::components::{ComponentsError, RatingComponents, rating_components};
use crate::people::mds::{MAX_DIMS, Mds, ShepardPair};
use crate::people::ratings::{RaterFit, Rating, RatingTable, RelevanceVote, rater_fits};
use crate::people::sorting::{Similarity, Sort};
use crate::space::features::{FeatureTable, NamedTexture};
use crate::space::{LabelSource, Space, SpacePoint};

pub use crate::space::space_build::adjectives::Adjective;
pub use crate::space::space_build::axes::{Axis, Prediction, TRUSTED_NESTED_R};
pub use crate::space::space_build::axis_choice::RELIABLE_ALPHA;
pub use crate::space::space_build::error::SpaceBuildError;
pub use crate::space::space_build::options::{FeatureKind, PlacedBy, SpaceOptions};
pub use crate::space::space_build::scaling::DegenerateScaling;
pub use crate::space::space_build::stability::{MIN_DRAWN, Stability};
pub use crate::space::space_build::step::Step;
pub use crate::space::space_build::validation::{
    few_judges, kruskal_word, position_errors, stress_in_words, stress_of_random_data, validation_summary,
};

use crate::space::space_build::rated::from_ratings;
use crate::space::space_build::sorted::from_sorts;
use crate::space::space_build::step::Progress;

/// Minimum number of textures with a mean rating, for a correlation and for a space from ratings alone.
const LEAST_RATED: usize = 3;

/// Input data of a space.
#[derive(Clone, Debug)]
pub struct SpaceData<'a> {
    /// Textures, named by their identifiers. Textures that nobody sorted get no position; without sorts, those that are
    /// not rated on both axes.
    pub textures: Vec<NamedTexture<'a>>,
    /// Sorts of the textures; without any, the space is built from the ratings alone.
    pub sorts: Vec<Sort>,
    /// Ratings of the textures.
    pub ratings: Vec<Rating>,
    /// Relevance votes on adjectives; without votes, all adjectives count as relevant.
    pub votes: Vec<RelevanceVote>,
    /// Source of the judgments.
    pub source: LabelSource,
}

/// A built space with all intermediate results.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceBuild {
    /// Identifiers of the textures in the space; all other fields use this order.
    pub textures: Vec<String>,
    /// Textures without a position: nobody sorted them, or, without sorts, rated them on both axes.
    pub not_placed: Vec<String>,
    /// Source of the judgments.
    pub source: LabelSource,
    /// Options that were used. `mds` holds the transformation that gave the perceptual space.
    pub options: SpaceOptions,
    /// Perceptual space from the sorts; `None` if there are none.
    pub perceptual: Option<PerceptualSpace>,
    /// All rated adjective pairs, in the order of the ratings.
    pub adjectives: Vec<Adjective>,
    /// Raters, and the agreement of each rater with the others.
    pub raters: Vec<(String, RaterFit)>,
    /// Number of missing ratings among all possible ones.
    pub n_missing_ratings: usize,
    /// Principal components of the mean ratings on the relevant pairs; their `pairs` are indices of
    /// [`SpaceBuild::adjectives`].
    pub components: Result<RatingComponents, ComponentsError>,
    /// The two axes.
    pub axes: [Axis; 2],
    /// Correlation of the mean ratings on the two axes, -1..1, over the textures rated on both; `None` with fewer than
    /// three of them, or if one pair has the same mean for all of them.
    pub axis_correlation: Option<f64>,
    /// Feature table. Each axis model uses some of its columns.
    pub features: FeatureTable,
    /// Bootstrap stability of the perceived positions. `None` if [`SpaceOptions::n_draws`] is 0. Also `None`, with the
    /// reason among the findings, with fewer than [`MIN_DRAWN`] sorters or raters, or if fewer than two bootstrap
    /// samples yield a space. Without sorts, the standard errors of the mean ratings replace it ([`position_errors`]).
    pub stability: Option<Stability>,
    /// Position of each texture.
    pub positions: Vec<SpacePoint>,
    /// The positions with their triangulation.
    pub space: Space,
    /// Warnings about irregular data and results, as sentences.
    pub findings: Vec<String>,
}

/// Perceptual space from the sorts, with its intermediate results.
#[derive(Clone, Debug, PartialEq)]
pub struct PerceptualSpace {
    /// Similarities from the sorts.
    pub similarity: Similarity,
    /// Stress-1 for one dimension, two dimensions, and so on.
    pub stress: Vec<f64>,
    /// Configuration from multidimensional scaling, in the requested number of dimensions.
    pub configuration: Mds,
    /// A degenerate solution: the configuration, or the one that interval scaling replaced.
    pub degenerate: Option<DegenerateScaling>,
    /// Shepard diagram of the configuration.
    pub shepard: Vec<ShepardPair>,
    /// Angle between the directions of the two pairs of the axes, in degrees, before any orthogonalization.
    pub angle_degrees: f64,
}

/// Builds a space: from sorts and ratings, or from ratings alone if there are no sorts. `on_step` is called at the start of
/// every step and repeatedly within long steps, from several threads. If it returns `false`, the build stops. The result
/// does not depend on the number of threads.
///
/// # Errors
/// See [`SpaceBuildError`]. Irregularities that do not prevent a result are listed in [`SpaceBuild::findings`].
pub fn build_space(
    data: &SpaceData<'_>,
    options: &SpaceOptions,
    on_step: &(dyn Fn(Step) -> bool + Sync),
) -> Result<SpaceBuild, SpaceBuildError> {
    let progress = Progress::new(on_step);
    let is_rated_alone = data.sorts.is_empty();
    progress.begin(if is_rated_alone { Step::Adjectives } else { Step::Sorting })?;
    if !(2..=MAX_DIMS).contains(&options.n_dims) {
        return Err(SpaceBuildError::Dims { n_dims: options.n_dims });
    }
    check_names(data)?;
    let table = RatingTable::new(&data.ratings)?;
    if data.ratings.iter().all(|rating| rating.value.is_none()) {
        return Err(SpaceBuildError::NoRatings);
    }
    if is_rated_alone {
        from_ratings(data, &table, options, &progress)
    } else {
        from_sorts(data, &table, options, &progress)
    }
}

/// Raters, and the agreement of each with the others.
fn raters(table: &RatingTable) -> Vec<(String, RaterFit)> {
    table.participants().iter().cloned().zip(rater_fits(table)).collect()
}

/// Principal components of the mean ratings on the relevant pairs.
fn components(
    adjectives: &[Adjective],
    seed: u64,
    progress: &Progress<'_>,
) -> Result<Result<RatingComponents, ComponentsError>, SpaceBuildError> {
    let means = |adjective: &Adjective| -> Vec<Option<f64>> {
        adjective.ratings.iter().map(|average| average.mean.filter(|_| adjective.is_relevant)).collect()
    };
    let means: Vec<Vec<Option<f64>>> = adjectives.iter().map(means).collect();
    match rating_components(&means, seed, &|| progress.go_on()) {
        Err(ComponentsError::Stopped) => Err(SpaceBuildError::Stopped),
        found => Ok(found),
    }
}

/// Checks that sorts and ratings refer to known textures and that each texture has a unique name.
fn check_names(data: &SpaceData<'_>) -> Result<(), SpaceBuildError> {
    let mut known = BTreeSet::new();
    if let Some(twice) = data.textures.iter().find(|texture| !known.insert(texture.name)) {
        return Err(SpaceBuildError::TextureTwice { texture: twice.name.to_owned() });
    }
    let unknown = |texture: &&String| !known.contains(texture.as_str());
    let sorted = || data.sorts.iter().flat_map(|sort| sort.placements.iter().map(|p| &p.texture));
    let rated = || data.ratings.iter().map(|rating| &rating.texture);
    for (judged, what) in [(sorted().find(unknown), "sorted"), (rated().find(unknown), "rated")] {
        if let Some(texture) = judged {
            return Err(SpaceBuildError::UnknownTexture { texture: texture.clone(), what });
        }
    }
    let in_sorts: BTreeSet<&String> = sorted().collect();
    if !data.sorts.is_empty()
        && !data.ratings.is_empty()
        && !rated().any(|texture| in_sorts.contains(texture))
    {
        return Err(SpaceBuildError::NothingShared);
    }
    Ok(())
}

impl SpaceBuild {
    /// Source of the positions. Positions that a model predicts on an axis are estimates, even if people's judgments
    /// trained the model. Those from simulated raters stay marked as such.
    pub fn place_source(&self) -> LabelSource {
        let is_predicted = self.axes.iter().any(|axis| axis.placed_by == PlacedBy::Predicted);
        match self.source {
            LabelSource::HumanRatings if is_predicted => LabelSource::Estimated,
            source => source,
        }
    }
}

#[cfg(test)]
mod tests;
