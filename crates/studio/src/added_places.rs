//! Positions of textures that a project added, where nothing else gives them a coordinate on an axis of the space.
//!
//! A texture that was made for an authored texture lies at the point of that one. After a change of the axes, and for a texture
//! whose position is an estimate, a missing coordinate is the local mean of the other textures. These coordinates are stored in
//! the project ([`Project::coordinates`]), so that a texture stays where it is when others are added.

use std::sync::Arc;

use shagreen_core::space::{SpacePoint, with_local_means};
use shagreen_formats::library::{Library, Place, TextureEntry};
use shagreen_formats::project::{Project, is_same_axis};

use crate::axes::{AxisColumns, list_places};
use crate::project::textures_of;

/// Smallest distance between a texture that is placed at a point and the others there, in points of the axes: of two textures
/// at one position, only one can be pinned.
pub const LEAST_DISTANCE: f64 = 0.1;

/// Gives a texture that was made for the point of the authored texture with this key a position on every axis of the space:
/// where nothing else gives a coordinate, it has that of the point. With chosen axes, the point moves to the texture, whose
/// vibration may give other coordinates. Without them, a texture has its own position, or that of the point.
///
/// Where another texture lies, it gets no position.
pub fn place_made(project: &mut Project, key: u32, id: &str) {
    let authored = project.authored.iter().position(|texture| texture.key == key);
    let joined = project.joined.iter().position(|entry| entry.id == id);
    let (Some(authored), Some(joined)) = (authored, joined) else { return };
    if position(project, joined).is_none() {
        place_at_point(project, authored, joined);
    }
    if project.axes.is_some()
        && let Some(at) = position(project, joined)
    {
        move_point(project, authored, at);
    }
}

/// Places own textures without a position at the points of the authored textures with these indices that pin them, as
/// [`place_made`]. The points do not move.
pub fn place_pinned(project: &mut Project, authored: impl IntoIterator<Item = usize>) {
    let mut pins: Vec<(usize, usize)> = Vec::new();
    for index in authored {
        let Some(texture) = project.authored.get(index) else { continue };
        let is_pinned = |joined: &usize| {
            project.is_own(*joined) && texture.blend.locked.contains(&project.joined[*joined].id)
        };
        pins.extend((0..project.joined.len()).filter(is_pinned).map(|joined| (index, joined)));
    }
    if pins.is_empty() {
        return;
    }
    let before = positions(project);
    for (authored, joined) in pins {
        // If several points pin it, it lies at the first one.
        if before[joined].is_none() && position(project, joined).is_none() {
            place_at_point(project, authored, joined);
        }
    }
}

/// Gives the added textures with these indices a position on the chosen axes: where nothing else gives a coordinate, it is the
/// local mean of the other textures. Only those get one that have a position on the axes of the library and may take estimates
/// ([`Project::takes_estimates`]).
pub fn complete_estimates(project: &mut Project, joined: impl IntoIterator<Item = usize>) {
    let is_estimated = |joined: &usize| {
        project.takes_estimates(*joined)
            && project.joined.get(*joined).is_some_and(|entry| entry.place.is_some())
    };
    let estimated: Vec<usize> = joined.into_iter().filter(is_estimated).collect();
    if project.axes.is_none() || estimated.is_empty() {
        return;
    }
    let Some(listed) = Listed::of(project) else { return };
    let positions = listed.common_positions();
    if positions.iter().all(Option::is_none) {
        return;
    }
    for joined in estimated {
        // A built space takes away the positions of textures outside it.
        let entry = listed.library.textures.get(listed.n_of_library + joined);
        if entry.is_some_and(|entry| entry.place.is_some()) && listed.at(joined).is_none() {
            let whole = with_local_means(&positions, &listed.known(project, joined));
            set(project, &listed, joined, &whole);
        }
    }
}

/// Positions of own textures before the library or the space of a project is replaced, and the points that lie on them.
pub struct OwnPlaces {
    /// Names of the axes.
    axes: Vec<String>,
    /// By the index among the added textures; `None` for textures that are not own.
    at: Vec<Option<SpacePoint>>,
    /// Indices of the authored textures that lie exactly on an own texture that they pin, and of that texture.
    lying: Vec<(usize, usize)>,
}

impl OwnPlaces {
    /// Notes the positions in a project.
    pub fn of(project: &Project) -> Self {
        let axes = project.axis_names().into_iter().map(str::to_owned).collect();
        let mut at = if project.own.is_empty() { Vec::new() } else { positions(project) };
        for (joined, at) in at.iter_mut().enumerate() {
            if !project.is_own(joined) {
                *at = None;
            }
        }
        let mut lying = Vec::new();
        for (index, texture) in project.authored.iter().enumerate() {
            let is_there = |joined: &usize| {
                at[*joined] == Some(texture.at) && texture.blend.locked.contains(&project.joined[*joined].id)
            };
            lying.extend((0..at.len()).filter(is_there).map(|joined| (index, joined)));
        }
        Self { axes, at, lying }
    }

    /// Gives own textures that have lost their position one in the new space, after the points of the project were moved to it:
    /// they keep their coordinates on axes of the same name, and are at the local mean of the other textures on axes on which
    /// nothing else gives a coordinate. If no axis has a former name, they keep their first coordinates, like points. Points
    /// that lay on them move with them.
    pub fn follow(self, project: &mut Project) {
        if self.at.iter().all(Option::is_none) {
            return;
        }
        let now = positions(project);
        let is_lost = |joined: &usize| now[*joined].is_none() && self.at[*joined].is_some();
        let lost: Vec<usize> = (0..now.len().min(self.at.len())).filter(is_lost).collect();
        if !lost.is_empty()
            && let Some(listed) = Listed::of(project)
        {
            for joined in lost {
                self.place(project, &listed, joined);
            }
        }
        let now = positions(project);
        for (authored, joined) in self.lying {
            if let Some(at) = now.get(joined).copied().flatten() {
                move_point(project, authored, at);
            }
        }
    }

    /// Places an own texture that has lost its position.
    fn place(&self, project: &mut Project, listed: &Listed, joined: usize) {
        let Some(before) = self.at[joined] else { return };
        let same = |name: &String| self.axes.iter().position(|known| is_same_axis(known, name));
        let mut from: Vec<Option<usize>> = listed.axes.iter().map(same).collect();
        if from.iter().all(Option::is_none) {
            from = (0..from.len()).map(Some).collect();
        }
        let kept = from.into_iter().map(|axis| before.get(axis?));
        let known: Vec<Option<f64>> =
            listed.known(project, joined).into_iter().zip(kept).map(|(known, kept)| known.or(kept)).collect();
        set(project, listed, joined, &with_local_means(&listed.common_positions(), &known));
    }
}

/// The list of a project on the axes of its space.
struct Listed {
    /// Names of the axes.
    axes: Vec<String>,
    library: Library,
    /// Position of each texture of the list.
    places: Vec<Option<Place>>,
    /// Own textures, as indices of the list.
    own: Vec<usize>,
    columns: AxisColumns,
    /// Number of the textures before the added ones.
    n_of_library: usize,
}

impl Listed {
    /// `None` if the built-in library is damaged.
    fn of(project: &Project) -> Option<Self> {
        let library = textures_of(project).ok()?; // The library was reported as damaged when it was opened.
        let mut columns = AxisColumns::default();
        let places = list_places(&library, project.axes.as_deref(), &mut columns, &project.coordinates);
        let axes = project.axis_names().into_iter().map(str::to_owned).collect();
        let n_of_library = library.textures.len().saturating_sub(project.joined.len());
        let own = project.left_out(&library.textures, |_| false);
        Some(Self { axes, library, places, own, columns, n_of_library })
    }

    /// Positions of the textures that take part in all authored textures, by index: local means follow from them.
    fn common_positions(&self) -> Vec<Option<SpacePoint>> {
        let common = |(index, place): (usize, &Option<Place>)| {
            place.filter(|_| !self.own.contains(&index)).map(|place| place.at)
        };
        self.places.iter().enumerate().map(common).collect()
    }

    /// Position of an added texture.
    fn at(&self, joined: usize) -> Option<SpacePoint> {
        Some((*self.places.get(self.n_of_library + joined)?)?.at)
    }

    /// Coordinate of an added texture on each axis, where it has one.
    fn known(&self, project: &Project, joined: usize) -> Vec<Option<f64>> {
        let at = self.at(joined);
        let coordinate = |(index, axis): (usize, &String)| {
            let placed = at.and_then(|at| at.get(index));
            let given = || self.columns.coordinate(axis, self.n_of_library + joined);
            let stored = || project.coordinates.get(&project.joined.get(joined)?.id, axis);
            placed.or_else(given).or_else(stored)
        };
        self.axes.iter().enumerate().map(coordinate).collect()
    }
}

/// Sets the coordinates of an added texture on the axes on which it has none; `whole` has one for each axis.
fn set(project: &mut Project, listed: &Listed, joined: usize, whole: &[f64]) {
    let known = listed.known(project, joined);
    let Some(entry) = project.joined.get(joined) else { return };
    for ((axis, known), value) in listed.axes.iter().zip(known).zip(whole) {
        if known.is_none() {
            project.coordinates.set(&entry.id, axis, *value);
        }
    }
}

/// Places an added texture at the point of an authored texture on the axes on which it has no coordinate, unless another texture
/// that takes part there lies at this position.
fn place_at_point(project: &mut Project, authored: usize, joined: usize) {
    let Some(texture) = project.authored.get(authored).cloned() else { return };
    let Some(listed) = Listed::of(project) else { return };
    let point = texture.at.on(listed.axes.len());
    let known = listed.known(project, joined);
    let whole: Vec<f64> =
        known.iter().zip(point.coordinates()).map(|(known, at)| known.unwrap_or(*at)).collect();
    let Ok(at) = SpacePoint::of(&whole) else { return };
    let left_out = project.left_out(&listed.library.textures, |id| texture.blend.locked.contains(id));
    let is_free = |(other, place): (usize, &Option<Place>)| {
        other == listed.n_of_library + joined
            || left_out.contains(&other)
            || place.is_none_or(|place| place.at.distance(at) > LEAST_DISTANCE)
    };
    if listed.places.iter().enumerate().all(is_free) {
        set(project, &listed, joined, &whole);
    }
}

fn move_point(project: &mut Project, authored: usize, at: SpacePoint) {
    if let Some(texture) = project.authored.get_mut(authored)
        && texture.at != at
    {
        Arc::make_mut(texture).at = at;
    }
}

/// Position of an added texture.
fn position(project: &Project, joined: usize) -> Option<SpacePoint> {
    positions(project).get(joined).copied().flatten()
}

/// Positions of the added textures, by their index among them.
fn positions(project: &Project) -> Vec<Option<SpacePoint>> {
    if project.axes.is_some() || project.space.is_some() {
        let listed = Listed::of(project);
        return (0..project.joined.len()).map(|joined| listed.as_ref()?.at(joined)).collect();
    }
    // The library need not be read.
    let axes = project.axis_names();
    let at = |entry: &Arc<TextureEntry>| {
        let own = entry.at().filter(|at| at.n_axes() == axes.len());
        own.or_else(|| project.coordinates.on(&entry.id, &axes))
    };
    project.joined.iter().map(at).collect()
}

#[cfg(test)]
mod tests;
