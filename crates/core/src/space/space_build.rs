//! Construction of an authoring space from human judgments and signal features.
//!
//! Sorts yield a perceptual space ([`crate::people::sorting`], [`crate::people::mds`]), and ratings yield a direction
//! of each adjective pair in this space ([`crate::people::property`]). The projections of the textures onto the
//! directions of two adjective pairs are their perceived positions on the two axes. Features of the textures'
//! vibrations predict these positions ([`crate::space::features`], [`crate::space::selection`]). Method: W. Hassan, A.
//! Abdulali and S. Jeon, "Authoring new haptic textures based on interpolation of real textures in affective space",
//! IEEE Transactions on Industrial Electronics 2020.
//!
//! The axes need not be orthogonal in the perceptual space: both directions and their angle are reported. The
//! prediction of an axis is always reported with nested cross-validation, and with a permutation test if
//! [`SpaceOptions::n_permutations`] is above 0.

mod adjectives;
mod axes;
mod error;
mod scaling;
mod stability;
mod step;
mod validation;
mod warnings;

use std::collections::BTreeSet;

use crate::dsp::mfcc::MfccOptions;
use crate::people::dissimilarities::Dissimilarities;
use crate::people::mds::{MAX_DIMS, Mds, MdsError, MdsOptions, ShepardPair, Transform};
use crate::people::ratings::{AdjectivePair, RaterFit, Rating, RatingTable, RelevanceVote, rater_fits};
use crate::people::sorting::{Similarity, Sort, SortingError, similarity};
use crate::space::features::{
    FeaturePlan, FeatureTable, NamedTexture, Statistic, per_frame, per_pattern, physical_table,
};
use crate::space::selection::Method;
use crate::space::{LabelSource, Space, SpacePoint};
use crate::texture::patterns::{PAPER_RATE, PAPER_SECS, PatternPlan, paper_patterns};

pub use crate::space::space_build::adjectives::Adjective;
pub use crate::space::space_build::axes::{Axis, Prediction, TRUSTED_NESTED_R};
pub use crate::space::space_build::error::SpaceBuildError;
pub use crate::space::space_build::scaling::DegenerateScaling;
pub use crate::space::space_build::stability::{MIN_DRAWN, Stability};
pub use crate::space::space_build::step::Step;
pub use crate::space::space_build::validation::{
    kruskal_word, stress_in_words, stress_of_random_data, validation_summary,
};

use crate::space::space_build::adjectives::fit_adjectives;
use crate::space::space_build::axes::{Axes, fit_axes};
use crate::space::space_build::scaling::{Scaled, scaled};
use crate::space::space_build::stability::{Drawn, stability};
use crate::space::space_build::step::Progress;

/// Input data of a space.
#[derive(Clone, Debug)]
pub struct SpaceData<'a> {
    /// Textures, named by their identifiers. Textures that nobody sorted get no position.
    pub textures: Vec<NamedTexture<'a>>,
    /// Sorts of the textures.
    pub sorts: Vec<Sort>,
    /// Ratings of the textures.
    pub ratings: Vec<Rating>,
    /// Relevance votes on adjectives; without votes, all adjectives count as relevant.
    pub votes: Vec<RelevanceVote>,
    /// Source of the judgments.
    pub source: LabelSource,
}

/// Options for building a space; [`SpaceOptions::usual`] gives reasonable defaults.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceOptions {
    /// Number of dimensions of the perceptual space, 2 to [`MAX_DIMS`].
    pub n_dims: usize,
    /// Options of the multidimensional scaling.
    pub mds: MdsOptions,
    /// Transformation of the dissimilarities. `None` uses that of `mds`, and interval scaling instead if its solution is
    /// degenerate ([`DegenerateScaling`]).
    pub transform: Option<Transform>,
    /// Adjective pairs of the two axes, the pole at 0 first. `None` selects rough-smooth and hard-soft if both are
    /// usable: rated, not excluded by relevance votes, and with a direction in the perceptual space. Otherwise `None`
    /// selects, for each of the first two dimensions of the perceptual space, the usable pair whose ratings have the
    /// highest absolute correlation with it.
    pub axes: Option<[AdjectivePair; 2]>,
    /// Whether the second axis is made orthogonal to the first.
    pub is_orthogonal: bool,
    /// Kind of features of the vibrations.
    pub features: FeatureKind,
    /// Options of the mel-frequency cepstral coefficients (MFCC). They describe a pattern: a stroke rendered at
    /// constant speed and force ([`crate::texture::patterns`]).
    pub mfcc: MfccOptions,
    /// Method that predicts an axis from features.
    pub method: Method,
    /// Kind of positions. `None` selects, for each axis, predicted positions if the nested correlation reaches
    /// [`TRUSTED_NESTED_R`], else perceived positions.
    pub placement: Option<PlacedBy>,
    /// Number of permutations for the null distribution of the nested correlation; 0 omits the permutation test.
    pub n_permutations: usize,
    /// Number of bootstrap samples of the participants, for the stability of the perceived positions; 0 omits the
    /// bootstrap.
    pub n_draws: usize,
    /// Seed of scaling, noise, folds, permutations and bootstrap.
    pub seed: u64,
}

/// Kind of features that describe the vibrations of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeatureKind {
    /// For each pattern, the mean of every mel-frequency cepstral coefficient over its frames.
    Mfcc,
    /// For each pattern, every coefficient of every frame, as in the paper (see the module documentation).
    MfccFrames,
    /// Physical features ([`crate::space::features::Physical`]): level, exponents of the level over speed and force,
    /// spectral centroid, friction coefficient, and tap transient.
    Physical,
    /// [`FeatureKind::Mfcc`] and [`FeatureKind::Physical`].
    MfccAndPhysical,
}

/// Kind of position of a texture on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlacedBy {
    /// Perceived position, computed from the judgments.
    Felt,
    /// Position predicted from features. The paper uses these positions: its axes are computed from features.
    Predicted,
}

/// A built space with all intermediate results.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceBuild {
    /// Identifiers of the textures in the space; all other fields use this order.
    pub textures: Vec<String>,
    /// Textures that nobody sorted and that therefore have no position.
    pub not_sorted: Vec<String>,
    /// Source of the judgments.
    pub source: LabelSource,
    /// Options that were used. `mds` holds the transformation that gave the perceptual space.
    pub options: SpaceOptions,
    /// Similarities from the sorts.
    pub similarity: Similarity,
    /// Stress-1 for one dimension, two dimensions, and so on.
    pub stress: Vec<f64>,
    /// Perceptual space from multidimensional scaling.
    pub perceptual: Mds,
    /// A degenerate solution: the perceptual space, or the one that interval scaling replaced.
    pub degenerate: Option<DegenerateScaling>,
    /// Shepard diagram of the perceptual space.
    pub shepard: Vec<ShepardPair>,
    /// All rated adjective pairs, in the order of the ratings.
    pub adjectives: Vec<Adjective>,
    /// Raters, and the agreement of each rater with the others.
    pub raters: Vec<(String, RaterFit)>,
    /// Number of missing ratings among all possible ones.
    pub n_missing_ratings: usize,
    /// The two axes.
    pub axes: [Axis; 2],
    /// Angle between the directions of the two pairs in the perceptual space, in degrees, before any orthogonalization.
    pub angle_degrees: f64,
    /// Feature table. Each axis model uses some of its columns.
    pub features: FeatureTable,
    /// Bootstrap stability of the perceived positions. `None` if [`SpaceOptions::n_draws`] is 0. Also `None`, with the
    /// reason among the findings, with fewer than [`MIN_DRAWN`] sorters or raters, or if fewer than two bootstrap
    /// samples yield a space.
    pub stability: Option<Stability>,
    /// Position of each texture.
    pub positions: Vec<SpacePoint>,
    /// The positions with their triangulation.
    pub space: Space,
    /// Warnings about irregular data and results, as sentences.
    pub findings: Vec<String>,
}

impl SpaceOptions {
    /// Default options: two dimensions, [`FeatureKind::Mfcc`] with the recommended MFCC options, [`Method::Practical`],
    /// an automatic kind of positions, a thousand permutations and a hundred bootstrap samples.
    pub fn usual(seed: u64) -> Self {
        Self {
            n_dims: 2,
            mds: MdsOptions::usual(seed),
            transform: None,
            axes: None,
            is_orthogonal: false,
            features: FeatureKind::Mfcc,
            mfcc: crate::dsp::mfcc::recommended(),
            method: Method::Practical,
            placement: None,
            n_permutations: 1000,
            n_draws: 100,
            seed,
        }
    }
}

/// Builds a space. `on_step` is called at the start of every step and repeatedly within long steps, from several
/// threads. If it returns `false`, the build stops. The result does not depend on the number of threads.
///
/// # Errors
/// See [`SpaceBuildError`]. Irregularities that do not prevent a result are listed in [`SpaceBuild::findings`].
pub fn build_space(
    data: &SpaceData<'_>,
    options: &SpaceOptions,
    on_step: &(dyn Fn(Step) -> bool + Sync),
) -> Result<SpaceBuild, SpaceBuildError> {
    let progress = Progress::new(on_step);
    progress.begin(Step::Sorting)?;
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

    progress.begin(Step::Scaling)?;
    let in_words = |error| named(error, &textures);
    let Scaled { scaling, options: mds, mut by_dimension, perceptual, shepard, degenerate } =
        scaled(&dissimilarities, options, &|| progress.go_on()).map_err(in_words)?;
    let options = &SpaceOptions { mds, ..options.clone() };
    let judged = Judged {
        data,
        table: &table,
        sorted: &sorted,
        not_sorted: not_sorted.iter().map(|texture| texture.name).collect(),
        textures: &textures,
        similarity: &similarity,
        perceptual: &perceptual,
        degenerate,
    };
    // Of solutions with more dimensions, only the stress is reported, and nothing else depends on it. They are
    // therefore computed in parallel with all other steps. Scaling needs more textures than dimensions.
    let most_dims = MAX_DIMS.min(textures.len().saturating_sub(2)).max(options.n_dims);
    let more_dims = options.n_dims + 1..=most_dims;
    let (more, rest) = rayon::join(
        || scaling.best(more_dims, Some(&perceptual), &|| progress.go_on()),
        || judged.continued(options, &progress).inspect_err(|_| progress.stop()),
    );
    let Rest { adjectives, raters, features, axes, angle_degrees, stability, positions, space, findings } =
        rest?;
    by_dimension.extend(more.map_err(in_words)?);
    Ok(SpaceBuild {
        not_sorted: judged.not_sorted.iter().map(|name| (*name).to_owned()).collect(),
        source: data.source,
        options: options.clone(),
        stress: by_dimension.iter().map(|mds| mds.stress).collect(),
        degenerate,
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
        similarity,
        perceptual,
        textures,
    })
}

/// Judgments and the perceptual space: the input of all later steps.
struct Judged<'a> {
    data: &'a SpaceData<'a>,
    table: &'a RatingTable,
    /// Textures in the space, and their names.
    sorted: &'a [NamedTexture<'a>],
    textures: &'a [String],
    not_sorted: Vec<&'a str>,
    similarity: &'a Similarity,
    perceptual: &'a Mds,
    degenerate: Option<DegenerateScaling>,
}

/// Results that follow from the perceptual space; see the fields of [`SpaceBuild`].
struct Rest {
    adjectives: Vec<Adjective>,
    raters: Vec<(String, RaterFit)>,
    features: FeatureTable,
    axes: [Axis; 2],
    angle_degrees: f64,
    stability: Option<Stability>,
    positions: Vec<SpacePoint>,
    space: Space,
    findings: Vec<String>,
}

impl Judged<'_> {
    fn continued(&self, options: &SpaceOptions, progress: &Progress<'_>) -> Result<Rest, SpaceBuildError> {
        let Self { data, table, sorted, not_sorted, textures, similarity, perceptual, degenerate } = self;
        progress.begin(Step::Adjectives)?;
        let mut findings = warnings::of_sorting(data, similarity, table, not_sorted, options.mds.transform);
        findings.extend(degenerate.as_ref().map(warnings::of_degenerate));
        findings.extend(warnings::of_scaling(perceptual, options));
        let adjectives = fit_adjectives(table, &data.votes, textures, &perceptual.points, &mut findings)?;
        let raters: Vec<(String, RaterFit)> =
            table.participants().iter().cloned().zip(rater_fits(table)).collect();
        findings.extend(warnings::of_ratings(&raters, table));

        progress.begin(Step::Features)?;
        let features = features(sorted, options, &|| progress.go_on())?;
        findings.extend(features.findings());

        let begin_axis = |axis| progress.begin(Step::Axis(axis));
        let Axes { fitted: axes, angle_degrees, chosen } =
            fit_axes(&adjectives, &perceptual.points, &features, options, &begin_axis, &|| progress.go_on())?;
        findings.extend(warnings::of_axes(&axes, angle_degrees));
        progress.begin(Step::Stability)?;
        let drawn = Drawn {
            textures,
            sorts: &data.sorts,
            ratings: table,
            // Adjectives are in the order of the table.
            axes: chosen,
            n_dims: options.n_dims,
            is_orthogonal: options.is_orthogonal,
            mds: &options.mds,
        };
        let stability =
            stability(&drawn, options.n_draws, options.seed, &|| progress.go_on(), &mut findings)?;
        let positions = positions(&axes);
        findings.extend(warnings::of_places(textures, &positions));
        let space = Space::new(&positions.iter().copied().map(Some).collect::<Vec<_>>())?;
        Ok(Rest { adjectives, raters, features, axes, angle_degrees, stability, positions, space, findings })
    }
}

/// Replaces item indices in an error by the names of the textures.
fn named(error: MdsError, textures: &[String]) -> SpaceBuildError {
    match error {
        MdsError::Apart { item } => {
            SpaceBuildError::Apart { first: textures[0].clone(), second: textures[item].clone() }
        }
        other => other.into(),
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
    if !data.ratings.is_empty() && !rated().any(|texture| in_sorts.contains(texture)) {
        return Err(SpaceBuildError::NothingShared);
    }
    Ok(())
}

fn features(
    textures: &[NamedTexture<'_>],
    options: &SpaceOptions,
    go_on: &(dyn Fn() -> bool + Sync),
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

fn positions([first, second]: &[Axis; 2]) -> Vec<SpacePoint> {
    let pairs = first.places().iter().zip(second.places());
    pairs.map(|(x, y)| SpacePoint { rough_smooth: *x, hard_soft: *y }).collect()
}

impl FeatureKind {
    /// All kinds, in the order in which the user interface lists them.
    pub const ALL: [Self; 4] = [Self::Mfcc, Self::MfccAndPhysical, Self::Physical, Self::MfccFrames];

    /// Identifier for files and scripts.
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
    /// Identifier for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Felt => "felt",
            Self::Predicted => "predicted",
        }
    }
}

#[cfg(test)]
mod tests;
