//! What a panel may look at: read-only. Panels ask for changes by commands.

use crate::pictures::Pictures;
use crate::project::Project;
use crate::session::Session;

/// The state that panels draw.
#[derive(Clone, Copy)]
pub struct Panel<'a> {
    /// What the user makes.
    pub project: &'a Project,
    /// Textures, space, and what sounds.
    pub session: &'a Session,
    /// Pictures of the textures.
    pub pictures: &'a Pictures,
}
