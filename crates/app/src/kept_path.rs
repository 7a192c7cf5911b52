//! A path that was drawn becomes a texture of the list.

use shagreen_core::texture_path::{TexturePath, TexturePathError};
use shagreen_formats::library::TextureEntry;
use shagreen_formats::project::{AuthoredTexture, Project};

use crate::session::Session;

/// The textures along the path of an authored texture; `None` without a path.
///
/// # Errors
/// There is no texture at a point of it.
pub(crate) fn drawn_path(
    texture: &AuthoredTexture,
    session: &Session,
) -> Option<Result<TexturePath, TexturePathError>> {
    let route = texture.path.as_ref()?.route()?;
    Some(TexturePath::of_route(session.authoring(), &route, &session.blending(&texture.blend)))
}

/// The texture of the project's path, which owes something to every texture that has a place; `None` without a path.
///
/// # Errors
/// There is no texture at a point of it.
pub(crate) fn kept_path(
    project: &Project,
    session: &Session,
) -> Option<Result<TextureEntry, TexturePathError>> {
    let texture = project.texture();
    let (authoring, blending) = (session.authoring(), session.blending(&texture.blend));
    let of: Vec<usize> = session.space().sites().iter().map(|(texture, _)| *texture).collect();
    Some(drawn_path(texture, session)?.map(|path| {
        let authored = path.keys().iter().filter_map(|key| authoring.author(key.stop.at, &blending));
        let n_extrapolated = authored.filter(|authored| authored.is_extrapolated).count();
        session.library().entry_of_path(&texture.name, path, &of, n_extrapolated)
    }))
}
