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
mod verdict;

use std::collections::BTreeSet;

use crate::dissimilarities::Dissimilarities;
use crate::features::{
    FeaturePlan, FeatureTable, NamedTexture, Statistic, per_frame, per_pattern, physical_table,
};
use crate::mds::{MAX_DIMS, Mds, MdsOptions, ShepardPair, by_dimension, shepard};
use crate::mfcc::MfccOptions;
use crate::patterns::{PAPER_RATE, PAPER_SECS, PatternPlan, paper_patterns};
use crate::ratings::{AdjectivePair, RaterFit, Rating, RatingTable, RelevanceVote, rater_fits};
use crate::selection::Method;
use crate::sorting::{Similarity, Sort, similarity};
use crate::space::{LabelSource, Space, SpacePoint};

pub use crate::space_build::adjectives::Adjective;
pub use crate::space_build::axes::Axis;
pub use crate::space_build::error::SpaceBuildError;
pub use crate::space_build::verdict::{kruskal_word, verdict};

use crate::space_build::adjectives::fit_adjectives;
use crate::space_build::axes::fit_axes;

/// Participants below whom a perceptual space is mostly chance.
const MIN_SORTERS: usize = 5;

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
    /// What a texture's place is.
    pub placement: Placement,
    /// How often positions are exchanged for the null distribution.
    pub n_permutations: usize,
    /// Seed of scaling, noise, folds and permutations.
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

/// What the place of a texture is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placement {
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
    /// Where each texture lies.
    pub positions: Vec<SpacePoint>,
    /// The same, triangulated.
    pub space: Space,
    /// What is not as it should be, in sentences.
    pub findings: Vec<String>,
}

/// A step on the way, as it begins.
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
}

impl Step {
    /// How many steps there are.
    pub const COUNT: usize = 6;

    /// Its place among them, from 0.
    pub fn index(self) -> usize {
        match self {
            Self::Sorting => 0,
            Self::Scaling => 1,
            Self::Adjectives => 2,
            Self::Features => 3,
            Self::Axis(axis) => 4 + axis.min(1),
        }
    }
}

impl SpaceOptions {
    /// Two dimensions, mean coefficients in the recommended way, the practical prediction, places as they were felt, a
    /// thousand permutations.
    pub fn usual(seed: u64) -> Self {
        Self {
            n_dims: 2,
            mds: MdsOptions::usual(seed),
            axes: None,
            is_orthogonal: false,
            features: FeatureKind::Mfcc,
            mfcc: crate::mfcc::recommended(),
            method: Method::Practical,
            placement: Placement::Felt,
            n_permutations: 1000,
            seed,
        }
    }
}

/// Builds the space. `on_step` hears of every step as it begins and says whether to go on.
///
/// # Errors
/// See [`SpaceBuildError`]; what can be lived with is among the findings.
pub fn build_space(
    data: &SpaceData<'_>,
    options: &SpaceOptions,
    on_step: &mut dyn FnMut(Step) -> bool,
) -> Result<SpaceBuild, SpaceBuildError> {
    let mut begin = |step: Step| if on_step(step) { Ok(()) } else { Err(SpaceBuildError::Stopped) };
    begin(Step::Sorting)?;
    if !(2..=MAX_DIMS).contains(&options.n_dims) {
        return Err(SpaceBuildError::Dims { n_dims: options.n_dims });
    }
    check_names(data)?;
    let table = RatingTable::new(&data.ratings)?;
    let in_sorts: BTreeSet<&str> =
        data.sorts.iter().flat_map(|sort| sort.placements.iter().map(|p| p.texture.as_str())).collect();
    let (sorted, not_sorted): (Vec<NamedTexture<'_>>, Vec<_>) =
        data.textures.iter().partition(|texture| in_sorts.contains(texture.name));
    let textures: Vec<String> = sorted.iter().map(|texture| texture.name.to_owned()).collect();
    let similarity = similarity(&textures, &data.sorts)?;
    let dissimilarities: Dissimilarities = similarity.dissimilarities()?;

    begin(Step::Scaling)?;
    // A space cannot have as many dimensions as textures.
    let most_dims = MAX_DIMS.min(textures.len().saturating_sub(2)).max(options.n_dims);
    let all_dims = by_dimension(&dissimilarities, 1..=most_dims, &options.mds)?;
    let stress: Vec<f64> = all_dims.iter().map(|mds| mds.stress).collect();
    let perceptual = all_dims[options.n_dims - 1].clone();
    let shepard = shepard(&dissimilarities, &perceptual.points, options.mds.ties)?;

    begin(Step::Adjectives)?;
    let mut findings: Vec<String> = similarity.findings.iter().map(ToString::to_string).collect();
    let n_sorters = similarity.agreements.len();
    if n_sorters < MIN_SORTERS {
        findings.push(format!(
            "only {n_sorters} participants sorted: most dissimilarities are equal, so the perceptual space depends on chance however low its stress is; ten are usual"
        ));
    }
    if !perceptual.converged {
        findings.push("the perceptual space was still moving when its steps ran out: allow more".to_owned());
    }
    let adjectives = fit_adjectives(&table, &data.votes, &textures, &perceptual.points, &mut findings)?;
    let raters: Vec<(String, RaterFit)> =
        table.participants().iter().cloned().zip(rater_fits(&table)).collect();

    begin(Step::Features)?;
    let features = features(&sorted, options)?;
    findings.extend(features.warnings.iter().map(ToString::to_string));

    let (axes, angle_degrees) =
        fit_axes(&adjectives, &perceptual.points, &features, options, &mut |axis| begin(Step::Axis(axis)))?;
    if let Some(unusual) = unusual_axes(&axes) {
        findings.push(unusual);
    }
    let positions = positions(&axes, options.placement);
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
        positions,
        space,
        findings,
    })
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

fn features(textures: &[NamedTexture<'_>], options: &SpaceOptions) -> Result<FeatureTable, SpaceBuildError> {
    let contacts = paper_patterns();
    let patterns =
        PatternPlan { contacts: &contacts, seconds: PAPER_SECS, rate: PAPER_RATE, seed: options.seed };
    let plan = FeaturePlan { patterns, mfcc: &options.mfcc };
    Ok(match options.features {
        FeatureKind::Mfcc => per_pattern(textures, &plan, Statistic::Mean)?,
        FeatureKind::MfccFrames => per_frame(textures, &plan)?,
        FeatureKind::Physical => physical_table(textures, &contacts)?,
        FeatureKind::MfccAndPhysical => {
            per_pattern(textures, &plan, Statistic::Mean)?.beside(&physical_table(textures, &contacts)?)
        }
    })
}

/// What is to be known where the axes are not those that the square is named by.
fn unusual_axes(axes: &[Axis; 2]) -> Option<String> {
    let names = axes.each_ref().map(|axis| axis.pair.name().to_lowercase());
    (names != ["rough-smooth", "hard-soft"]).then(|| {
        format!(
            "the axes are {} and {}: they take the places of rough-smooth and hard-soft in the library, where 0 is {} and {}",
            names[0], names[1], axes[0].pair.low, axes[1].pair.low
        )
    })
}

fn positions([first, second]: &[Axis; 2], placement: Placement) -> Vec<SpacePoint> {
    let of = |axis: &Axis| match placement {
        Placement::Felt => axis.felt.clone(),
        Placement::Predicted => axis.predicted.clone(),
    };
    let pairs = of(first).into_iter().zip(of(second));
    pairs.map(|(rough_smooth, hard_soft)| SpacePoint { rough_smooth, hard_soft }).collect()
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

    /// The kind that has this [`FeatureKind::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.id() == id)
    }
}

impl Placement {
    /// The word for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Felt => "felt",
            Self::Predicted => "predicted",
        }
    }

    /// The placement that has this [`Placement::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        [Self::Felt, Self::Predicted].into_iter().find(|placement| placement.id() == id)
    }
}

#[cfg(test)]
mod tests;
