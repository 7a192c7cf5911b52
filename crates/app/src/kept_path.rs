//! A path that was drawn becomes a texture of the list.

use shagreen_core::texture_path::{TexturePath, TexturePathError};
use shagreen_formats::library::TextureEntry;
use shagreen_formats::project::Project;

use crate::session::Session;

/// The texture of the project's path, which owes something to every texture that has a place; `None` without a path.
///
/// # Errors
/// There is no texture at a point of it.
pub(crate) fn kept_path(
    project: &Project,
    session: &Session,
) -> Option<Result<TextureEntry, TexturePathError>> {
    let texture = project.texture();
    let route = texture.path.as_ref()?.route()?;
    let (authoring, blending) = (session.authoring(), session.blending(&texture.blend));
    let made = TexturePath::of_route(authoring, &route, &blending);
    let of: Vec<usize> = session.space().sites().iter().map(|(texture, _)| *texture).collect();
    Some(made.map(|path| {
        let authored = path.keys().iter().filter_map(|key| authoring.author(key.stop.at, &blending));
        let n_extrapolated = authored.filter(|authored| authored.is_extrapolated).count();
        session.library().entry_of_path(&texture.name, path, &of, n_extrapolated)
    }))
}
