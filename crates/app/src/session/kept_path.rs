//! Converts a drawn path to a texture of the list.

use shagreen_core::space::texture_path::{TexturePath, TexturePathError};
use shagreen_formats::library::TextureEntry;
use shagreen_formats::project::{AuthoredTexture, Project};

use crate::session::Session;

/// Textures along the path of an authored texture, in its shape, or `None` without a path.
///
/// # Errors
/// There is no texture at a point of the path, or it cannot have the shape.
pub(crate) fn drawn_path(
    texture: &AuthoredTexture,
    session: &Session,
) -> Option<Result<TexturePath, TexturePathError>> {
    let route = texture.path.as_ref()?.route()?;
    let authoring = session.authoring_of(texture);
    let path = TexturePath::of_route(&authoring, &route, &session.blending(&texture.blend));
    Some(path.and_then(|path| path.shaped(&texture.shape)))
}

/// The project's path as a texture of the list, or `None` without a path. It carries the terms of use of every texture
/// in the space of its authored texture.
///
/// # Errors
/// There is no texture at a point of the path.
pub(crate) fn kept_path(
    project: &Project,
    session: &Session,
) -> Option<Result<TextureEntry, TexturePathError>> {
    let texture = project.texture();
    let (authoring, blending) = (session.authoring_of(texture), session.blending(&texture.blend));
    let of: Vec<usize> = authoring.space().sites().iter().map(|(texture, _)| *texture).collect();
    Some(drawn_path(texture, session)?.map(|path| {
        let authored = path.keys().iter().filter_map(|key| authoring.author(key.stop.at, &blending));
        let n_extrapolated = authored.filter(|authored| authored.is_extrapolated).count();
        session.library().entry_of_path(&texture.name, path, &of, n_extrapolated)
    }))
}
