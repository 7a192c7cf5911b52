//! The authoring spaces, their models, and the texture at the point.

use std::collections::BTreeSet;

use shagreen_core::space::authoring::Authored;
use shagreen_core::space::{Space, SpacePoint};

use super::audible_worker::AudibleWorker;
use super::models_worker::ModelsWorker;
use super::path_walk::PathWalk;
use super::spaces::Spaces;

/// The authoring spaces and the texture interpolated in one of them.
pub(super) struct AuthoredState {
    /// The space of the audible authored texture, and recent ones.
    pub(super) spaces: Spaces,
    /// Pinned textures for which the current space was chosen; `None` if it must be chosen again.
    pub(super) pins: Option<BTreeSet<String>>,
    /// Pinned textures and space of the selected authored texture while another one with another space is audible.
    pub(super) unheard: Option<(BTreeSet<String>, Space)>,
    /// Models of a space, computed by a worker.
    pub(super) models: ModelsWorker,
    /// Textures at the point that a worker makes audible.
    pub(super) audible: AudibleWorker,
    /// The texture at the point.
    pub(super) current: Option<Authored>,
    /// Whether a blind comparison hides the audible texture.
    pub(super) is_hidden: bool,
    /// Number of interpolated textures so far, which identifies each of them to the output.
    pub(super) n_made: u64,
    /// The stroke along the project's path, while it is played.
    pub(super) walk: Option<PathWalk>,
    /// The stroke along the path of a soloed texture, and its index.
    pub(super) walk_alone: Option<(usize, PathWalk)>,
    /// Position of the stroke on the path that is played.
    pub(super) path_point: Option<SpacePoint>,
}

impl AuthoredState {
    pub(super) fn new(space: Space) -> Self {
        Self {
            spaces: Spaces::new(space),
            pins: None,
            unheard: None,
            models: ModelsWorker::default(),
            audible: AudibleWorker::default(),
            current: None,
            is_hidden: false,
            n_made: 0,
            walk: None,
            walk_alone: None,
            path_point: None,
        }
    }
}
