//! Authored textures that are copied from one project and pasted into another.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use shagreen_core::space::SpacePoint;
use shagreen_formats::library::{Library, Place, TextureEntry, free_name};
use shagreen_formats::project::clipboard::CopiedTexture;
use shagreen_formats::project::{AuthoredTexture, BlendChoice, Project, plain_axis_name};
use shagreen_studio::axes::axis_poles;

use crate::state::moved_points::move_to_axes;
use crate::strings::clipboard as strings;

/// Offset of a copy from its original along each axis, in axis units (0 to 100).
const BESIDE: f64 = 4.0;
/// Distance below which two authored textures hide each other on the canvas, in axis units.
const SAME_PLACE: f64 = 1e-6;

/// Position of a copy of a texture at `at`, offset on the canvas by some points and inside the space.
pub fn beside(at: SpacePoint) -> SpacePoint {
    // Added to each coordinate, or subtracted if the sum would exceed 100.
    let step = |x: f64| if x + BESIDE <= 100.0 { x + BESIDE } else { x - BESIDE };
    at.on_canvas_at(SpacePoint::plane(step(at.x()), step(at.y())))
}

/// An authored texture of a project with the names of what it refers to, and the pinned textures that were added to the
/// project. `library` is the list of the project, and `axes` are the names of its axes.
pub fn copied(
    texture: &AuthoredTexture,
    project: &Project,
    library: &Library,
    axes: &[String],
) -> CopiedTexture {
    let named = |id: &String| {
        let index = library.index_of(id)?;
        Some((id.clone(), library.textures[index].name.clone()))
    };
    let pinned: BTreeMap<String, String> = texture.blend.locked.iter().filter_map(named).collect();
    // An added texture has the name that the list shows.
    let travels = |entry: &Arc<TextureEntry>| {
        let name = pinned.get(&entry.id)?.clone();
        Some(TextureEntry { name, ..TextureEntry::clone(entry) })
    };
    CopiedTexture {
        texture: texture.clone(),
        library: library.name.clone(),
        axes: axes.iter().map(|name| axis_poles(name)).collect(),
        axis_names: axes.to_vec(),
        textures: project.joined.iter().filter_map(travels).collect(),
        pinned,
    }
}

/// A texture to add to a project, and warnings about what differs from the project that it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Pasted {
    /// The texture.
    pub texture: AuthoredTexture,
    /// Textures that it pins and that the project lacks, to be added with it.
    pub own: Vec<Arc<TextureEntry>>,
    /// Warnings of the user.
    pub warnings: Vec<String>,
}

/// Fits a copied texture into a project with this library and axes of these names: its name becomes unique, it does not cover
/// another authored texture, and pins of textures that neither the library nor the copy has are removed. Between spaces with other
/// axes, its points keep the coordinates on common axes and have the local mean of the textures, which have these `positions` by
/// index, on the others. Between two axes and two others, they keep their coordinates, unless only the order differs.
pub fn pasted(
    copied: CopiedTexture,
    project: &Project,
    library: &Library,
    axes: &[String],
    positions: &[Option<SpacePoint>],
) -> Pasted {
    let mut warnings = Vec::new();
    let from = common_axes(&copied, axes);
    let has_same_axes = copied.axes.len() == axes.len() && from.iter().copied().eq((0..axes.len()).map(Some));
    if copied.library != library.name || !has_same_axes {
        warnings.push(strings::from_another_space(&copied.library, &copied.axes));
    }
    let CopiedTexture { mut texture, pinned, textures, axes: before, .. } = copied;
    let is_plane_to_plane = (before.len(), axes.len()) == (2, 2);
    if !has_same_axes && (!is_plane_to_plane || from.iter().all(Option::is_some)) {
        move_to_axes(&mut texture, &from, positions);
    }
    let is_lacking = |entry: &TextureEntry| !is_listed(entry, library);
    let own: Vec<TextureEntry> = textures.into_iter().filter(is_lacking).collect();
    let is_known = |id: &String| own.iter().any(|entry| entry.id == *id) || library.index_of(id).is_some();
    let (locked, missing): (BTreeSet<String>, BTreeSet<String>) =
        texture.blend.locked.iter().cloned().partition(is_known);
    if !missing.is_empty() {
        warnings.push(strings::not_pinned(&names_of(missing, &pinned)));
    }
    let others = &project.authored;
    let name = free_name(&texture.name, |name| others.iter().any(|other| other.name == name));
    let is_taken = |at: SpacePoint| others.iter().any(|other| other.at.distance(at) < SAME_PLACE);
    let mut at = texture.at;
    // After as many steps as there are textures, one of the positions is free, or they alternate in a corner.
    for _ in 0..others.len() {
        if is_taken(at) {
            at = beside(at);
        }
    }
    let blend = BlendChoice { locked, ..texture.blend };
    let own = own.into_iter().map(|entry| Arc::new(with_own_place(entry, library))).collect();
    Pasted { texture: AuthoredTexture { name, at, blend, ..texture }, own, warnings }
}

/// For each axis of a project, the index of the same axis of the copied texture. Without names, it is the one with the same words,
/// unless the project names the axis as an attribute, which a copy without names does not.
fn common_axes(copied: &CopiedTexture, axes: &[String]) -> Vec<Option<usize>> {
    let same = |name: &String| {
        if !copied.axis_names.is_empty() {
            return copied.axis_names.iter().position(|known| known == name);
        }
        let ends = axis_poles(name);
        let by_words = copied.axes.iter().position(|known| *known == ends);
        by_words.filter(|_| plain_axis_name(name) == name)
    };
    axes.iter().map(same).collect()
}

/// Whether the library has this very texture: an identifier alone may be that of another one.
fn is_listed(entry: &TextureEntry, library: &Library) -> bool {
    let listed = library.index_of(&entry.id).and_then(|index| library.textures.get(index));
    listed.is_some_and(|listed| listed.model == entry.model && listed.picture == entry.picture)
}

/// A texture without its position if another one of the library lies there: two at one position form no space.
fn with_own_place(entry: TextureEntry, library: &Library) -> TextureEntry {
    let mut places = library.textures.iter().filter_map(TextureEntry::at);
    let is_taken = |place: &Place| places.any(|other| other.distance(place.at) < SAME_PLACE);
    let is_taken = entry.place.as_ref().is_some_and(is_taken);
    if is_taken { TextureEntry { place: None, ..entry } } else { entry }
}

/// Names of textures; an identifier where the name is unknown.
fn names_of(ids: BTreeSet<String>, names: &BTreeMap<String, String>) -> Vec<String> {
    ids.into_iter().map(|id| names.get(&id).cloned().unwrap_or(id)).collect()
}

#[cfg(test)]
mod tests;
