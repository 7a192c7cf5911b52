//! Textures of generated surfaces, simulated from the height field that their picture shows.

use std::cell::Cell;
use std::sync::Arc;

use anyhow::Context as _;
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::surfaces::felt_material;
use shagreen_core::surfaces::height_field::Tile;
use shagreen_core::surfaces::material::Material;
use shagreen_core::texture::TextureModel;
use shagreen_formats::library::{Place, TextureEntry};
use shagreen_formats::picture::Picture;
use shagreen_formats::project::{AuthoredTexture, Project};
use shagreen_formats::text_limits::{MAX_NOTES, begin_of};

/// Origin of a texture from [`felt_entry`].
pub const FELT_ORIGIN: &str =
    "Simulated by Shagreen from the height field of a generated picture; no surface was recorded.";

/// A generated surface: all that its height field, its picture and its texture are computed from.
#[derive(Clone, Debug, PartialEq)]
pub struct GeneratedSurface {
    /// Material of the surface.
    pub material: Material,
    /// Tile of its height field.
    pub tile: Tile,
    /// Random seed.
    pub seed: u64,
}

/// Returns the texture that feels as the picture of the surface looks, or `None` if it was stopped. Takes some seconds.
/// `on_step` gets the number of strokes done and of all strokes, and returns whether to continue.
///
/// # Errors
/// The material gives no texture.
pub fn felt(
    surface: &GeneratedSurface,
    on_step: impl Fn(usize, usize) -> bool,
) -> anyhow::Result<Option<TextureModel>> {
    let GeneratedSurface { material, tile, seed } = surface;
    let (n_done, n_steps) = (Cell::new(0), felt_material::n_steps(material));
    let step = || {
        n_done.set(n_done.get() + 1);
        on_step(n_done.get(), n_steps)
    };
    match felt_material::felt(material, *tile, *seed, &step) {
        Ok(model) => Ok(Some(model)),
        Err(error) if error.is_stop() => Ok(None),
        Err(error) => Err(error).with_context(|| {
            format!("\"{}\" cannot be simulated; try another description or seed", material.name)
        }),
    }
}

/// Returns the library entry of a simulated texture. `about` describes where its picture comes from. With a position,
/// the position counts as estimated.
pub fn felt_entry(
    id: String,
    name: &str,
    about: &str,
    model: TextureModel,
    picture: Picture,
    at: Option<SpacePoint>,
) -> TextureEntry {
    let description = format!("Simulated from its height field; nobody rated it. {about}");
    TextureEntry {
        origin: FELT_ORIGIN.to_owned(),
        description: begin_of(description.trim_end().to_owned(), MAX_NOTES),
        place: at.map(|at| Place::new(at, LabelSource::Estimated)),
        picture: Some(picture),
        ..TextureEntry::new(id, name, model)
    }
}

/// Returns the index among the added textures of `earlier`, which was simulated for the authored texture with this key, if a
/// later simulation may replace it: only this authored texture pins it, no snapshot does, and it has no star, no new name
/// and no place in a built space. A texture of a file is never the same entry, even with the same id.
pub fn replaceable_felt(project: &Project, key: u32, earlier: &Arc<TextureEntry>) -> Option<usize> {
    let id = &earlier.id;
    let is_pinned_by = |texture: &&Arc<AuthoredTexture>| texture.blend.locked.contains(id);
    let is_pinned = project.authored.iter().filter(is_pinned_by).map(|texture| texture.key).eq([key]);
    let is_kept = project.snapshots.iter().any(|texture| is_pinned_by(&texture))
        || project.starred.contains(id)
        || project.renamed.contains_key(id)
        || project.space.iter().flat_map(|space| &space.textures).any(|placed| placed.id == *id);
    let index = project.joined.iter().position(|joined| Arc::ptr_eq(joined, earlier));
    index.filter(|_| is_pinned && !is_kept)
}

/// Adds a simulated texture to a project, for the authored texture with this key, in place of an earlier one if
/// [`replaceable_felt`] allows it. It belongs to the authored texture ([`Project::own`]), so that no other one changes. It is
/// pinned, so that the field passes through it; a pin has no effect on a texture without a position. If the authored texture
/// is selected, the simulated one is rendered alone until the point moves.
pub fn join_felt(
    project: &mut Project,
    key: u32,
    entry: Arc<TextureEntry>,
    earlier: Option<&Arc<TextureEntry>>,
) {
    let Some(index) = project.authored.iter().position(|texture| texture.key == key) else { return };
    let replaced = earlier.and_then(|earlier| replaceable_felt(project, key, earlier));
    let replaced_id = replaced.map(|replaced| project.joined[replaced].id.clone());
    let locked = &mut Arc::make_mut(&mut project.authored[index]).blend.locked;
    if let Some(id) = &replaced_id {
        locked.remove(id);
        project.own.remove(id);
        project.coordinates.remove(id);
    }
    locked.insert(entry.id.clone());
    project.own.insert(entry.id.clone());
    if index == project.selected || (replaced_id.is_some() && project.solo == replaced_id) {
        project.solo = Some(entry.id.clone());
    }
    match replaced {
        Some(replaced) => project.joined[replaced] = entry,
        None => project.joined.push(entry),
    }
}

#[cfg(test)]
mod tests;
