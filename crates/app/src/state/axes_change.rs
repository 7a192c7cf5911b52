//! Another choice of axes, with every point of a project moved to it.

use std::sync::Arc;

use shagreen_core::space::{LocalMean, MIDDLE, SpacePoint};
use shagreen_formats::library::Library;
use shagreen_formats::project::{AddedCoordinates, AuthoredTexture, Project, different_axes};
use shagreen_studio::axes::axis_values;

/// Other axes of the space, and where the points of a project lie on them.
#[derive(Clone, Debug, PartialEq)]
pub struct AxesChange {
    /// Names of the axes; `None` for those of the positions.
    axes: Option<Vec<String>>,
    n_axes: usize,
    /// Each authored texture of the project on the axes before, and the same one on the new axes.
    moved: Vec<[Arc<AuthoredTexture>; 2]>,
    /// Coordinates of added textures where nothing else gives one, on all axes that they have had.
    coordinates: AddedCoordinates,
}

impl AxesChange {
    /// Change to the axes with these names, one to six; of several names of one axis
    /// ([`shagreen_formats::project::is_same_axis`]), the first counts. `library` is the list of textures of the project, and
    /// `positions` are those of the textures on the axes before, by index.
    ///
    /// Points keep their coordinates on axes that stay. On a new axis, a point at the position of a texture has the coordinate
    /// of this texture: of several ones, that of the first pinned one. Other points have the local mean of the textures
    /// ([`LocalMean`]), or are in the middle where no texture has a coordinate. Added textures whose coordinates may be
    /// estimated ([`Project::takes_estimates`]) have the local mean on a new axis on which nothing else gives one. Local means
    /// are those of the textures that take part in all authored textures. Snapshots stay on their axes.
    pub fn new(
        project: &Project,
        library: &Library,
        positions: &[Option<SpacePoint>],
        axes: &[String],
    ) -> Self {
        let own: Vec<String> = library.axis_names().into_iter().map(str::to_owned).collect();
        let before = project.axes.as_ref().unwrap_or(&own);
        let axes = different_axes(axes);
        let mut common = positions.to_vec();
        for texture in project.left_out(&library.textures, |_| false) {
            if let Some(position) = common.get_mut(texture) {
                *position = None;
            }
        }
        let mut new_axes: Vec<NewAxis> =
            axes.iter().map(|name| NewAxis::new(name, before, library, &common)).collect();
        let coordinates = place_added(project, library, positions, &mut new_axes);
        let moved = |texture: &Arc<AuthoredTexture>| {
            let is_pinned = |id: &str| texture.blend.locked.contains(id);
            let left_out = project.left_out(&library.textures, is_pinned);
            let is_pinned =
                |index: &usize| library.textures.get(*index).is_some_and(|entry| is_pinned(&entry.id));
            let after = texture.moved(|at| {
                let at = at.on(before.len());
                let is_there = |index: &usize| positions[*index] == Some(at) && !left_out.contains(index);
                let mut there: Vec<usize> = (0..positions.len()).filter(is_there).collect();
                there.sort_by_key(|index| !is_pinned(index));
                let coordinates: Vec<f64> = new_axes.iter().map(|axis| axis.coordinate(at, &there)).collect();
                SpacePoint::of(&coordinates).unwrap_or_else(|_| at.on(new_axes.len()))
            });
            [Arc::clone(texture), after]
        };
        let moved = project.authored.iter().map(moved).collect();
        Self { n_axes: axes.len(), axes: (own != axes).then_some(axes), moved, coordinates }
    }

    /// Sets the axes of the project and moves its points. A texture that the project did not have when the change was made keeps
    /// its first coordinates.
    pub(super) fn apply(self, project: &mut Project) {
        let Self { axes, n_axes, moved, coordinates } = self;
        let former: Vec<String> = project.axis_names().into_iter().map(str::to_owned).collect();
        (project.axes, project.coordinates) = (axes, coordinates);
        project.note_axes_of_snapshots(&former);
        for texture in &mut project.authored {
            let known = moved.iter().find(|[before, _]| Arc::ptr_eq(before, texture));
            *texture =
                known.map_or_else(|| texture.moved(|at| at.on(n_axes)), |[_, after]| Arc::clone(after));
        }
    }
}

/// The coordinates of added textures after the change. On a new axis on which nothing else gives one, a texture has the one
/// that it had there before, or the local mean at its position.
fn place_added(
    project: &Project,
    library: &Library,
    positions: &[Option<SpacePoint>],
    axes: &mut [NewAxis],
) -> AddedCoordinates {
    let mut coordinates = project.coordinates.clone();
    let n_of_library = library.textures.len().saturating_sub(project.joined.len());
    for (index, entry) in library.textures.iter().enumerate().skip(n_of_library) {
        let Some(at) = positions.get(index).copied().flatten() else { continue };
        if !project.takes_estimates(index - n_of_library) {
            continue;
        }
        for axis in axes.iter_mut() {
            let before = coordinates.get(&entry.id, &axis.name);
            if let Some(value) = axis.place(index, at, before) {
                coordinates.set(&entry.id, &axis.name, value);
            }
        }
    }
    coordinates
}

/// An axis after the change, and what the coordinates of points on it follow from.
struct NewAxis {
    name: String,
    /// Index of the same axis before the change.
    kept: Option<usize>,
    /// Coordinate of each texture, by index; empty for an axis that stays or that no texture has.
    values: Vec<Option<f64>>,
    /// Local mean of these coordinates over the axes before.
    mean: Option<LocalMean>,
}

impl NewAxis {
    /// `common` are the positions of the textures that local means follow from.
    fn new(name: &str, before: &[String], library: &Library, common: &[Option<SpacePoint>]) -> Self {
        let kept = before.iter().position(|known| known == name);
        let values = if kept.is_none() { axis_values(library, name) } else { None };
        let values = values.unwrap_or_default();
        Self { name: name.to_owned(), kept, mean: LocalMean::new(common, &values), values }
    }

    /// Gives a texture at a point of the axes before a coordinate, and returns it, if this axis is new and gives none: the one
    /// that it had `before` on this axis, or the local mean.
    fn place(&mut self, texture: usize, at: SpacePoint, before: Option<f64>) -> Option<f64> {
        let value = self.values.get_mut(texture)?;
        if value.is_some() {
            return None;
        }
        let estimate = before.or_else(|| Some(self.mean.as_ref()?.at(at))).unwrap_or(MIDDLE);
        *value = Some(estimate);
        Some(estimate)
    }

    /// Coordinate of a point of the axes before; `there` are the textures at its position, the first one that counts first.
    fn coordinate(&self, at: SpacePoint, there: &[usize]) -> f64 {
        let kept = || at.get(self.kept?);
        let of_texture = || there.iter().find_map(|texture| *self.values.get(*texture)?);
        let mean = || Some(self.mean.as_ref()?.at(at));
        kept().or_else(of_texture).or_else(mean).unwrap_or(MIDDLE)
    }
}

#[cfg(test)]
mod tests;
