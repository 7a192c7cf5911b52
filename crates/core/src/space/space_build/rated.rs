//! A space from ratings alone: the positions are the mean ratings on two adjective pairs.
//!
//! Method of the attribute paper ([`crate::space::space_build`]): mean ratings keep the scale that the participants used,
//! so that nothing is scaled to the range of the textures.

use std::collections::BTreeSet;

use crate::people::ratings::RatingTable;
use crate::space::Space;
use crate::space::features::NamedTexture;
use crate::space::space_build::adjectives::fit_adjectives;
use crate::space::space_build::axes::{Fitting, axes_of_means, axis_correlation, positions};
use crate::space::space_build::axis_choice::{Chosen, choose_by_ratings};
use crate::space::space_build::step::Progress;
use crate::space::space_build::vibrations::features;
use crate::space::space_build::{
    Adjective, LEAST_RATED, PlacedBy, SpaceBuild, SpaceBuildError, SpaceData, SpaceOptions, Step, components,
    raters, warnings,
};

/// Builds a space from ratings alone. The textures in the space are those with a mean rating on both axes.
///
/// # Errors
/// See [`SpaceBuildError`].
pub(super) fn from_ratings(
    data: &SpaceData<'_>,
    table: &RatingTable,
    options: &SpaceOptions,
    progress: &Progress<'_>,
) -> Result<SpaceBuild, SpaceBuildError> {
    let in_ratings: BTreeSet<&str> = table.textures().iter().map(String::as_str).collect();
    let rated: Vec<NamedTexture<'_>> =
        data.textures.iter().filter(|texture| in_ratings.contains(texture.name)).copied().collect();
    let names: Vec<String> = rated.iter().map(|texture| texture.name.to_owned()).collect();
    let mut findings = Vec::new();
    let mut adjectives = fit_adjectives(table, &data.votes, &names, None, &mut findings)?;
    let raters = raters(table);
    findings.extend(warnings::of_ratings(&raters, table));
    let components = components(&adjectives, options.seed, progress)?;
    let chosen = choose_by_ratings(&adjectives, options, &mut findings)?;

    let placed: Vec<usize> =
        (0..rated.len()).filter(|texture| is_on_both(&adjectives, chosen, *texture)).collect();
    if placed.len() < LEAST_RATED {
        let axes = chosen.map(|(index, _)| adjectives[index].pair.name());
        return Err(SpaceBuildError::TooFewRated { n_textures: placed.len(), axes });
    }
    for adjective in &mut adjectives {
        adjective.ratings = placed.iter().map(|texture| adjective.ratings[*texture]).collect();
    }
    let in_space: Vec<NamedTexture<'_>> = placed.iter().map(|texture| rated[*texture]).collect();
    let textures: Vec<String> = in_space.iter().map(|texture| texture.name.to_owned()).collect();
    let has_place: BTreeSet<&str> = in_space.iter().map(|texture| texture.name).collect();
    let outside = data.textures.iter().filter(|texture| !has_place.contains(texture.name));
    let not_placed: Vec<String> = outside.map(|texture| texture.name.to_owned()).collect();
    // Textures that nobody rated are those of the library that were not in the experiment.
    let is_rated = |name: &str| in_ratings.contains(name);
    let are_missed = warnings::are_missed(data.textures.len() - rated.len(), rated.len());
    let missed: Vec<String> =
        not_placed.iter().filter(|name| are_missed || is_rated(name)).cloned().collect();

    progress.begin(Step::Features)?;
    let features = features(&in_space, options, &|| progress.go_on())?;
    findings.extend(features.findings());
    // The positions are the mean ratings unless predicted ones are requested.
    let fitted_with =
        SpaceOptions { placement: options.placement.or(Some(PlacedBy::Felt)), ..options.clone() };
    let fitting = Fitting {
        adjectives: &adjectives,
        features: &features,
        options: &fitted_with,
        begin_axis: &|axis| progress.begin(Step::Axis(axis)),
        go_on: &|| progress.go_on(),
    };
    let axes = axes_of_means(&fitting, chosen)?;
    let axis_correlation = axis_correlation(&adjectives, chosen);
    findings.extend(warnings::of_mean_ratings(&axes, &adjectives, axis_correlation, raters.len(), &missed));
    findings.extend(warnings::of_prediction(&axes));
    let positions = positions(&axes);
    findings.extend(warnings::of_places(&textures, &positions));
    Ok(SpaceBuild {
        not_placed,
        source: data.source,
        options: options.clone(),
        perceptual: None,
        components,
        axis_correlation,
        raters,
        n_missing_ratings: table.n_missing(),
        space: Space::new(&positions.iter().copied().map(Some).collect::<Vec<_>>())?,
        stability: None,
        adjectives,
        axes,
        features,
        positions,
        findings,
        textures,
    })
}

/// Whether a texture has a mean rating on both axes.
fn is_on_both(adjectives: &[Adjective], chosen: Chosen, texture: usize) -> bool {
    chosen.iter().all(|(index, _)| adjectives[*index].ratings[texture].mean.is_some())
}
