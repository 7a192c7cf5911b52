//! A space from sorts and ratings: the sorts yield a perceptual space, and the ratings a direction of each adjective pair
//! in it.

use std::collections::BTreeSet;

use crate::people::dissimilarities::Dissimilarities;
use crate::people::mds::{MAX_DIMS, Mds, MdsError};
use crate::people::ratings::RatingTable;
use crate::people::sorting::{Similarity, similarity};
use crate::space::Space;
use crate::space::features::{FeatureTable, NamedTexture};
use crate::space::space_build::adjectives::fit_adjectives;
use crate::space::space_build::axes::{Fitting, axes_along, axis_correlation, positions};
use crate::space::space_build::axis_choice::{Chosen, choose_in_space};
use crate::space::space_build::scaling::{Scaled, scaled};
use crate::space::space_build::stability::{Drawn, stability};
use crate::space::space_build::step::Progress;
use crate::space::space_build::vibrations::features;
use crate::space::space_build::{
    Adjective, Axis, DegenerateScaling, PerceptualSpace, SpaceBuild, SpaceBuildError, SpaceData,
    SpaceOptions, Stability, Step, components, raters, warnings,
};

/// Builds a space from sorts and ratings.
///
/// # Errors
/// See [`SpaceBuildError`].
pub(super) fn from_sorts(
    data: &SpaceData<'_>,
    table: &RatingTable,
    options: &SpaceOptions,
    progress: &Progress<'_>,
) -> Result<SpaceBuild, SpaceBuildError> {
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
        table,
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
        || judged.continued(options, progress).inspect_err(|_| progress.stop()),
    );
    let Rest { adjectives, features, axes, chosen, angle_degrees, stability, mut findings } = rest?;
    by_dimension.extend(more.map_err(in_words)?);
    let positions = positions(&axes);
    findings.extend(warnings::of_places(&textures, &positions));
    Ok(SpaceBuild {
        not_placed: judged.not_sorted.iter().map(|name| (*name).to_owned()).collect(),
        source: data.source,
        options: options.clone(),
        components: components(&adjectives, options.seed, progress)?,
        axis_correlation: axis_correlation(&adjectives, chosen),
        raters: raters(table),
        n_missing_ratings: table.n_missing(),
        space: Space::new(&positions.iter().copied().map(Some).collect::<Vec<_>>())?,
        perceptual: Some(PerceptualSpace {
            stress: by_dimension.iter().map(|mds| mds.stress).collect(),
            configuration: perceptual,
            similarity,
            degenerate,
            shepard,
            angle_degrees,
        }),
        adjectives,
        axes,
        features,
        stability,
        positions,
        findings,
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
    features: FeatureTable,
    axes: [Axis; 2],
    chosen: Chosen,
    angle_degrees: f64,
    stability: Option<Stability>,
    findings: Vec<String>,
}

impl Judged<'_> {
    fn continued(&self, options: &SpaceOptions, progress: &Progress<'_>) -> Result<Rest, SpaceBuildError> {
        let Self { data, table, sorted, not_sorted, textures, similarity, perceptual, degenerate } = self;
        progress.begin(Step::Adjectives)?;
        let mut findings = warnings::of_sorting(data, similarity, table, not_sorted, options.mds.transform);
        findings.extend(degenerate.as_ref().map(warnings::of_degenerate));
        findings.extend(warnings::of_scaling(perceptual, options));
        let points = Some(perceptual.points.as_slice());
        let adjectives = fit_adjectives(table, &data.votes, textures, points, &mut findings)?;
        findings.extend(warnings::of_ratings(&raters(table), table));

        progress.begin(Step::Features)?;
        let features = features(sorted, options, &|| progress.go_on())?;
        findings.extend(features.findings());

        let chosen = choose_in_space(&adjectives, options)?;
        let fitting = Fitting {
            adjectives: &adjectives,
            features: &features,
            options,
            begin_axis: &|axis| progress.begin(Step::Axis(axis)),
            go_on: &|| progress.go_on(),
        };
        let (axes, angle_degrees) = axes_along(&fitting, chosen, &perceptual.points)?;
        findings.extend(warnings::of_angle(&axes, angle_degrees));
        findings.extend(warnings::of_prediction(&axes));
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
        Ok(Rest { adjectives, features, axes, chosen, angle_degrees, stability, findings })
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
