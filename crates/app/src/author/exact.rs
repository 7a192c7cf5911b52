//! Textures of the library: listening to one, and authored textures that are exactly one.

use std::collections::BTreeSet;

use egui::Response;
use shagreen_core::texture::blend::Mode;
use shagreen_formats::project::{AuthoredTexture, BlendChoice};

use crate::author::context_menu::had_open_menu;
use crate::author::new_texture::{next_color, own_name};
use crate::panel::Panel;
use crate::state::edit::Edit;

/// Edit that a click on a texture of the library gives, on the canvas and in the list alike: the texture plays alone, and
/// the selected authored texture does not change. A double click makes that one exactly this texture.
pub(crate) fn clicked(response: &Response, panel: &Panel<'_>, texture: usize) -> Option<Edit> {
    if !response.clicked() || had_open_menu(&response.ctx) {
        return None;
    }
    let exact = if response.double_clicked() { taken(panel, texture) } else { None };
    exact.or_else(|| Some(Edit::Solo(Some(panel.session.textures()[texture].id.clone()))))
}

/// Whether a texture that plays alone belongs to the selected authored texture and plays there as well: pinned in the mode Field,
/// at its position, and without a shape. A generated texture is one.
pub(crate) fn is_own_exactly(panel: &Panel<'_>, texture: usize) -> bool {
    let authored = panel.project.texture();
    panel.session.is_own(texture)
        && panel.is_locked(texture)
        && panel.session.position(texture) == Some(panel.session.fitted(authored.at))
        && authored.shape.is_neutral()
}

/// Edit that makes the selected authored texture exactly a texture of the library: at its position, in the mode Field, and
/// with no other pin. `None` if the texture has no position.
pub(crate) fn taken(panel: &Panel<'_>, texture: usize) -> Option<Edit> {
    let at = panel.session.position(texture)?;
    let entry = &panel.session.textures()[texture];
    Some(Edit::TakeTexture { id: entry.id.clone(), name: entry.name.clone(), at })
}

/// Edit that adds an authored texture which is exactly a texture of the library: at its position, in the mode Field and
/// pinned, with its name, tags and description. `None` if the texture has no position.
pub(crate) fn authored_exactly(panel: &Panel<'_>, texture: usize) -> Option<Edit> {
    let at = panel.session.position(texture)?;
    let entry = &panel.session.textures()[texture];
    let blend = BlendChoice {
        mode: Mode::Field,
        locked: BTreeSet::from([entry.id.clone()]),
        ..panel.project.texture().blend.clone()
    };
    Some(Edit::Author(Box::new(AuthoredTexture {
        color: next_color(panel),
        notes: entry.description.clone(),
        tags: entry.tags.clone(),
        at,
        blend,
        ..AuthoredTexture::new(0, &own_name(panel, &entry.name))
    })))
}
