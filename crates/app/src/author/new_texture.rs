//! New authored textures: fresh ones, copies, and the state of a snapshot. Each gets a name and a color of its own.

use shagreen_core::space::SpacePoint;
use shagreen_formats::library::free_name;
use shagreen_formats::project::{AuthoredTexture, N_COLORS};

use crate::panel::Panel;
use crate::strings::{self, authored as words};

/// New texture at a position on the canvas, with the further coordinates and the interpolation settings of the selected one.
pub(crate) fn fresh(panel: &Panel<'_>, at: SpacePoint) -> AuthoredTexture {
    AuthoredTexture {
        color: next_color(panel),
        at: panel.on_slice(at),
        blend: panel.project.blend_of_new(),
        ..AuthoredTexture::new(0, &own_name(panel, strings::NEW_TEXTURE))
    }
}

/// Copy of an authored texture at the same position, so that it is the same texture.
pub(crate) fn copy_of(panel: &Panel<'_>, texture: &AuthoredTexture) -> AuthoredTexture {
    let name = own_name(panel, &words::copy_of(&texture.name));
    AuthoredTexture { name, color: next_color(panel), ..texture.clone() }
}

/// New authored texture with the state of a snapshot.
pub(crate) fn of_snapshot(panel: &Panel<'_>, snapshot: &AuthoredTexture, number: usize) -> AuthoredTexture {
    let name = own_name(panel, &words::state_of(&snapshot.name, number));
    AuthoredTexture { name, color: next_color(panel), ..snapshot.clone() }
}

/// `name`, with a number appended if another authored texture has it.
pub(crate) fn own_name(panel: &Panel<'_>, name: &str) -> String {
    free_name(name, |name| panel.project.authored.iter().any(|texture| texture.name == name))
}

/// Color index used by the fewest authored textures.
pub(crate) fn next_color(panel: &Panel<'_>) -> u8 {
    let n_of = |color: u8| panel.project.authored.iter().filter(|texture| texture.color == color).count();
    // `N_COLORS` is not zero, so there is a minimum.
    (0..N_COLORS).min_by_key(|color| n_of(*color)).unwrap_or(0)
}
