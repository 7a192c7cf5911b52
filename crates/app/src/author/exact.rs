//! Authored textures that are exactly a texture of the library.

use std::collections::BTreeSet;

use shagreen_core::texture::blend::Mode;
use shagreen_formats::project::{AuthoredTexture, BlendChoice};

use crate::author::new_texture::{next_color, own_name};
use crate::panel::Panel;
use crate::state::edit::Edit;

/// Edit that moves the selected point onto a texture of the library and plays exactly this texture, and not the smooth
/// field at its position. `None` if the texture has no position.
pub(crate) fn taken(panel: &Panel<'_>, texture: usize) -> Option<Edit> {
    let at = panel.session.space().position(texture)?;
    let entry = &panel.session.textures()[texture];
    Some(Edit::TakeTexture { id: entry.id.clone(), name: entry.name.clone(), at })
}

/// Edit that adds an authored texture which is exactly a texture of the library: at its position, in the mode Field and
/// pinned, with its name, tags and description. `None` if the texture has no position.
pub(crate) fn authored_exactly(panel: &Panel<'_>, texture: usize) -> Option<Edit> {
    let at = panel.session.space().position(texture)?;
    let entry = &panel.session.textures()[texture];
    let blend = BlendChoice {
        mode: Mode::Field,
        locked: BTreeSet::from([entry.id.clone()]),
        ..panel.project.texture().blend.clone()
    };
    Some(Edit::Author(AuthoredTexture {
        color: next_color(panel),
        notes: entry.description.clone(),
        tags: entry.tags.clone(),
        at,
        blend,
        ..AuthoredTexture::new(0, &own_name(panel, &entry.name))
    }))
}
