//! A path that was drawn becomes a texture of the list.

use shagreen_core::texture_path::{TexturePath, TexturePathError};
use shagreen_formats::library::{Library, Provenance, TextureEntry, free_id, id_from_name};

use crate::project::Project;
use crate::session::Session;
use crate::strings;

/// The texture of the project's path, which owes something to every texture that has a place; `None` without a path.
///
/// # Errors
/// There is no texture at a point of it.
pub(crate) fn kept_path(
    project: &Project,
    session: &Session,
) -> Option<Result<TextureEntry, TexturePathError>> {
    let route = project.path.as_ref()?.route()?;
    let library = session.library();
    let made = TexturePath::of_route(session.authoring(), &route, &project.heard_blending());
    Some(made.map(|path| entry(library, &project.name, path)))
}

fn entry(library: &Library, name: &str, path: TexturePath) -> TextureEntry {
    let placed = || library.textures.iter().filter(|texture| texture.place.is_some());
    let mut licenses: Vec<&str> = Vec::new();
    for license in placed().map(|texture| library.license_of(texture)).filter(|license| !license.is_empty()) {
        if !licenses.contains(&license) {
            licenses.push(license);
        }
    }
    let is_restricted = placed().any(|texture| texture.provenance == Provenance::Restricted);
    let first = path.keys()[0].model.clone();
    let id = free_id(&id_from_name(name), |id| library.index_of(id).is_some());
    TextureEntry {
        license: licenses.join(" AND "),
        origin: strings::path::origin(&library.name),
        provenance: if is_restricted { Provenance::Restricted } else { Provenance::Free },
        path: Some(path),
        ..TextureEntry::new(id, name, first)
    }
}
