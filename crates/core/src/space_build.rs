//! An authoring space, from what people felt and what was measured.
//!
//! Sortings make a perceptual space ([`crate::sorting`], [`crate::mds`]); ratings point into it ([`crate::property`]);
//! textures fall onto the lines of two adjective pairs, which are the axes; features of their vibrations predict where
//! ([`crate::features`], [`crate::selection`]). W. Hassan, A. Abdulali and S. Jeon, "Authoring new haptic textures based
//! on interpolation of real textures in affective space", IEEE Transactions on Industrial Electronics 2020.
//!
//! The axes need not be at right angles in the perceptual space: both directions and their angle are kept. What predicts
//! an axis is reported with nested cross-validation and a null distribution, whatever was selected.

mod adjectives;
mod axes;
mod error;
mod oddities;
mod stability;
mod verdict;

use std::collections::BTreeSet;

use crate::dissimilarities::Dissimilarities;
use crate::features::{
    FeaturePlan, FeatureTable, NamedTexture, Statistic, per_frame, per_pattern, physical_table,
};
use crate::mds::{MAX_DIMS, Mds, MdsError, MdsOptions, ShepardPair, by_dimension, shepard};
use crate::mfcc::MfccOptions;
use crate::patterns::{PAPER_RATE, PAPER_SECS, PatternPlan, paper_patterns};
use crate::ratings::{AdjectivePair, RaterFit, Rating, RatingTable, RelevanceVote, rater_fits};
use crate::selection::Method;
use crate::sorting::{Similarity, Sort, SortingError, similarity};
use crate::space::{LabelSource, Space, SpacePoint};

pub use crate::space_build::adjectives::Adjective;
pub use crate::space_build::axes::{Axis, Prediction, TRUSTED_NESTED_R};
pub use crate::space_build::error::SpaceBuildError;
pub use crate::space_build::stability::{MIN_DRAWN, Stability};
pub use crate::space_build::verdict::{kruskal_word, verdict};

use crate::space_build::adjectives::fit_adjectives;
use crate::space_build::axes::{Axes, fit_axes};
use crate::space_build::stability::{Drawn, stability};

/// What a space is made of.
#[derive(Clone, Debug)]
pub struct SpaceData<'a> {
    /// The textures, by their identifiers. Those that nobody sorted stay without a place.
    pub textures: Vec<NamedTexture<'a>>,
    /// How they were sorted.
    pub sorts: Vec<Sort>,
    /// How they were rated.
    pub ratings: Vec<Rating>,
    /// Which adjectives were found relevant; without votes, all.
    pub votes: Vec<RelevanceVote>,
    /// Who judged.
    pub source: LabelSource,
}

/// How a space is made; [`SpaceOptions::usual`] is a good start.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceOptions {
    /// Dimensions of the perceptual space, 2 to [`MAX_DIMS`].
    pub n_dims: usize,
    /// How the perceptual space is scaled.
    pub mds: MdsOptions,
    /// The pairs that become the two axes, low end first; `None` takes rough-smooth and hard-soft where they were rated,
    /// else the pair that correlates best with each dimension.
    pub axes: Option<[AdjectivePair; 2]>,
    /// Whether the second axis is turned at right angles to the first.
    pub is_orthogonal: bool,
    /// What is taken from the vibrations.
    pub features: FeatureKind,
    /// How coefficients are taken from a pattern.
    pub mfcc: MfccOptions,
    /// How an axis is predicted from features.
    pub method: Method,
    /// What a texture's place is; `None` takes on each axis what is likely nearer to what people feel
    /// ([`TRUSTED_NESTED_R`]).
    pub placement: Option<PlacedBy>,
    /// How often positions are exchanged for the null distribution.
    pub n_permutations: usize,
    /// How often participants are drawn anew, to see how far places hang on who took part.
    pub n_draws: usize,
    /// Seed of scaling, noise, folds, permutations and draws.
    pub seed: u64,
}

/// What is taken from the vibrations of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeatureKind {
    /// The mean of every coefficient over each pattern.
    Mfcc,
    /// Every coefficient of every frame, as printed in the paper.
    MfccFrames,
    /// Level, exponents, centroid, friction and tap.
    Physical,
    /// [`FeatureKind::Mfcc`] and [`FeatureKind::Physical`].
    MfccAndPhysical,
}

/// What the place of a texture on an axis is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlacedBy {
    /// Where people put it.
    Felt,
    /// What its features predict, as in the paper, whose axes are features.
    Predicted,
}

/// A space, and everything on the way to it.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceBuild {
    /// Identifiers of the textures in the space, in the order of everything below.
    pub textures: Vec<String>,
    /// Textures that nobody sorted, which have no place.
    pub not_sorted: Vec<String>,
    /// Who judged.
    pub source: LabelSource,
    /// How it was made.
    pub options: SpaceOptions,
    /// How alike the textures were sorted.
    pub similarity: Similarity,
    /// Stress-1 of one dimension, two, and so on.
    pub stress: Vec<f64>,
    /// The perceptual space.
    pub perceptual: Mds,
    /// Its Shepard diagram.
    pub shepard: Vec<ShepardPair>,
    /// Every adjective pair that was rated, in the order of the ratings.
    pub adjectives: Vec<Adjective>,
    /// Who rated, and how each agrees with the others.
    pub raters: Vec<(String, RaterFit)>,
    /// How many of all possible ratings are missing.
    pub n_missing_ratings: usize,
    /// The two axes.
    pub axes: [Axis; 2],
    /// Angle between the lines of the two pairs in the perceptual space, in degrees, whether or not the axes were turned.
    pub angle_degrees: f64,
    /// Features by name, of which axes use some.
    pub features: FeatureTable,
    /// How far the places where textures were felt move when participants are drawn anew; `None` without draws, with fewer
    /// than [`MIN_DRAWN`] sorters or raters, or where hardly a draw makes a space: a finding says which.
    pub stability: Option<Stability>,
    /// Where each texture lies.
    pub positions: Vec<SpacePoint>,
    /// The same, triangulated.
    pub space: Space,
    /// What is not as it should be, in sentences.
    pub findings: Vec<String>,
}

/// A step on the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Sortings are put together.
    Sorting,
    /// The perceptual space is scaled.
    Scaling,
    /// Adjectives are fitted to it.
    Adjectives,
    /// Textures are stroked and described.
    Features,
    /// An axis is predicted and tested: the first or the second.
    Axis(usize),
    /// Participants are drawn anew.
    Stability,
}

impl Step {
    /// How many steps there are.
    pub const COUNT: usize = 7;

    /// Its place among them, from 0.
    pub fn index(self) -> usize {
        match self {
            Self::Sorting => 0,
            Self::Scaling => 1,
            Self::Adjectives => 2,
            Self::Features => 3,
            Self::Axis(axis) => 4 + axis.min(1),
            Self::Stability => 6,
        }
    }
}

impl SpaceOptions {
    /// Two dimensions, mean coefficients in the recommended way, the practical prediction, places by what can be trusted
    /// more, a thousand permutations, a hundred draws.
    pub fn usual(seed: u64) -> Self {
        Self {
            n_dims: 2,
            mds: MdsOptions::usual(seed),
            axes: None,
            is_orthogonal: false,
            features: FeatureKind::Mfcc,
            mfcc: crate::mfcc::recommended(),
            method: Method::Practical,
            placement: None,
            n_permutations: 1000,
            n_draws: 100,
            seed,
        }
    }
}

/// Builds the space. `on_step` hears of every step, many times while it lasts, and says whether to go on.
///
/// # Errors
/// See [`SpaceBuildError`]; what can be lived with is among the findings.
pub fn build_space(
    data: &SpaceData<'_>,
    options: &SpaceOptions,
    on_step: &mut dyn FnMut(Step) -> bool,
) -> Result<SpaceBuild, SpaceBuildError> {
    begin(on_step, Step::Sorting)?;
    if !(2..=MAX_DIMS).contains(&options.n_dims) {
        return Err(SpaceBuildError::Dims { n_dims: options.n_dims });
    }
    check_names(data)?;
    let table = RatingTable::new(&data.ratings)?;
    if data.sorts.is_empty() {
        return Err(SortingError::NoSorts.into());
    }
    let in_sorts: BTreeSet<&str> =
        data.sorts.iter().flat_map(|sort| sort.placements.iter().map(|p| p.texture.as_str())).collect();
    let (sorted, not_sorted): (Vec<NamedTexture<'_>>, Vec<_>) =
        data.textures.iter().partition(|texture| in_sorts.contains(texture.name));
    let textures: Vec<String> = sorted.iter().map(|texture| texture.name.to_owned()).collect();
    if textures.len() < options.n_dims + 2 {
        return Err(SpaceBuildError::TooFewTextures { n_textures: textures.len(), n_dims: options.n_dims });
    }
    let similarity = similarity(&textures, &data.sorts)?;
    let dissimilarities: Dissimilarities = similarity.dissimilarities()?;

    // A space cannot have as many dimensions as textures.
    let most_dims = MAX_DIMS.min(textures.len().saturating_sub(2)).max(options.n_dims);
    let mut go_on = || on_step(Step::Scaling);
    let all_dims = by_dimension(&dissimilarities, 1..=most_dims, &options.mds, &mut go_on)
        .map_err(|error| named(error, &textures))?;
    let stress: Vec<f64> = all_dims.iter().map(|mds| mds.stress).collect();
    let perceptual = all_dims[options.n_dims - 1].clone();
    let shepard = shepard(&dissimilarities, &perceptual.points, options.mds.ties)?;

    begin(on_step, Step::Adjectives)?;
    let unsorted: Vec<&str> = not_sorted.iter().map(|texture| texture.name).collect();
    let mut findings = oddities::of_sorting(data, &similarity, &table, &unsorted, options.mds.ties);
    findings.extend(oddities::of_scaling(&perceptual, options.n_dims));
    let adjectives = fit_adjectives(&table, &data.votes, &textures, &perceptual.points, &mut findings)?;
    let raters: Vec<(String, RaterFit)> =
        table.participants().iter().cloned().zip(rater_fits(&table)).collect();
    findings.extend(oddities::of_ratings(&raters, &table));

    begin(on_step, Step::Features)?;
    let features = features(&sorted, options, &mut || on_step(Step::Features))?;
    findings.extend(features.findings());

    let mut go_on = |axis| on_step(Step::Axis(axis));
    let Axes { fitted: axes, angle_degrees, chosen } =
        fit_axes(&adjectives, &perceptual.points, &features, options, &mut go_on)?;
    findings.extend(oddities::of_axes(&axes, angle_degrees));
    begin(on_step, Step::Stability)?;
    let drawn = Drawn {
        textures: &textures,
        sorts: &data.sorts,
        ratings: &table,
        // Adjectives are in the order of the table.
        axes: chosen,
        n_dims: options.n_dims,
        is_orthogonal: options.is_orthogonal,
        mds: &options.mds,
    };
    let mut go_on = || on_step(Step::Stability);
    let stability = stability(&drawn, options.n_draws, options.seed, &mut go_on, &mut findings)?;
    let positions = positions(&axes);
    findings.extend(oddities::of_places(&textures, &positions));
    let space = Space::new(&positions.iter().copied().map(Some).collect::<Vec<_>>())?;
    Ok(SpaceBuild {
        textures,
        not_sorted: not_sorted.iter().map(|texture| texture.name.to_owned()).collect(),
        source: data.source,
        options: options.clone(),
        similarity,
        stress,
        perceptual,
        shepard,
        adjectives,
        raters,
        n_missing_ratings: table.n_missing(),
        axes,
        angle_degrees,
        features,
        stability,
        positions,
        space,
        findings,
    })
}

/// The error with the names of textures.
fn named(error: MdsError, textures: &[String]) -> SpaceBuildError {
    match error {
        MdsError::Apart { item } => {
            SpaceBuildError::Apart { first: textures[0].clone(), second: textures[item].clone() }
        }
        other => other.into(),
    }
}

/// Sortings and ratings must be of textures that there are, each of which has a name of its own.
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
    if !data.ratings.is_empty() && !rated().any(|texture| in_sorts.contains(texture)) {
        return Err(SpaceBuildError::NothingShared);
    }
    Ok(())
}

/// Goes on with a step, or not.
fn begin(on_step: &mut dyn FnMut(Step) -> bool, step: Step) -> Result<(), SpaceBuildError> {
    if on_step(step) { Ok(()) } else { Err(SpaceBuildError::Stopped) }
}

fn features(
    textures: &[NamedTexture<'_>],
    options: &SpaceOptions,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<FeatureTable, SpaceBuildError> {
    let contacts = paper_patterns();
    let patterns =
        PatternPlan { contacts: &contacts, seconds: PAPER_SECS, rate: PAPER_RATE, seed: options.seed };
    let plan = FeaturePlan { patterns, mfcc: &options.mfcc };
    Ok(match options.features {
        FeatureKind::Mfcc => per_pattern(textures, &plan, Statistic::Mean, go_on)?,
        FeatureKind::MfccFrames => per_frame(textures, &plan, go_on)?,
        FeatureKind::Physical => physical_table(textures, &contacts)?,
        FeatureKind::MfccAndPhysical => per_pattern(textures, &plan, Statistic::Mean, go_on)?
            .beside(&physical_table(textures, &contacts)?),
    })
}

fn positions([first, second]: &[Axis; 2]) -> Vec<SpacePoint> {
    let pairs = first.places().iter().zip(second.places());
    pairs.map(|(x, y)| SpacePoint { rough_smooth: *x, hard_soft: *y }).collect()
}

impl FeatureKind {
    /// All kinds, in the order in which they are offered.
    pub const ALL: [Self; 4] = [Self::Mfcc, Self::MfccAndPhysical, Self::Physical, Self::MfccFrames];

    /// The word for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Mfcc => "mfcc",
            Self::MfccFrames => "mfcc-frames",
            Self::Physical => "physical",
            Self::MfccAndPhysical => "mfcc+physical",
        }
    }
}

impl PlacedBy {
    /// The word for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Felt => "felt",
            Self::Predicted => "predicted",
        }
    }
}

#[cfg(test)]
mod tests;
