//! Building an authoring space from judgments, with or without sorts: the space with its figures and its summary.

use std::sync::Arc;

use shagreen_core::space::space_build::{
    SpaceBuild, SpaceBuildError, SpaceData, SpaceOptions, Step, build_space, validation_summary,
};
use shagreen_formats::figure::Figure;
use shagreen_formats::placed_space::PlacedSpace;
use shagreen_formats::space_report::space_figures;

/// A space that was built, and how it is shown.
#[derive(Clone, Debug)]
pub struct BuiltSpace {
    /// The space with every intermediate result.
    pub build: Arc<SpaceBuild>,
    /// Positions and attributes for textures.
    pub placed: Arc<PlacedSpace>,
    /// Figures, each under a short name that serves for files.
    pub figures: Vec<(String, Arc<Figure>)>,
    /// Summary of the validation, in sentences.
    pub validation: Vec<String>,
}

/// Builds a space on all processors. `on_step` receives each step, from several threads, and returns whether to continue.
///
/// # Errors
/// See [`SpaceBuildError`].
pub fn build(
    data: &SpaceData<'_>,
    options: &SpaceOptions,
    on_step: &(dyn Fn(Step) -> bool + Sync),
) -> Result<BuiltSpace, SpaceBuildError> {
    let build = build_space(data, options, on_step)?;
    let figures = space_figures(&build).into_iter().map(|(name, figure)| (name, Arc::new(figure)));
    Ok(BuiltSpace {
        figures: figures.collect(),
        validation: validation_summary(&build),
        placed: Arc::new(PlacedSpace::of(&build)),
        build: Arc::new(build),
    })
}
