//! The authoring space, its models, and the texture at the point.

use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::{Authored, Authoring};

use super::models_worker::ModelsWorker;
use super::path_walk::PathWalk;

/// The authoring space and the texture interpolated in it.
pub(super) struct AuthoredState {
    pub(super) authoring: Authoring,
    /// Counts changes of any interpolated texture.
    pub(super) generation: u64,
    /// Models of the space, computed by a worker.
    pub(super) models: ModelsWorker,
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
    pub(super) fn new(authoring: Authoring) -> Self {
        Self {
            authoring,
            generation: 0,
            models: ModelsWorker::default(),
            current: None,
            is_hidden: false,
            n_made: 0,
            walk: None,
            walk_alone: None,
            path_point: None,
        }
    }
}
