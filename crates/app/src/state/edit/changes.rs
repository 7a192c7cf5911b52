//! Changes of a project that need more than one step: authored textures, snapshots, and the library.

use std::sync::Arc;

use shagreen_core::space::SpacePoint;
use shagreen_formats::library::TextureEntry;
use shagreen_formats::placed_space::PlacedSpace;
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
use shagreen_studio::added_places::{OwnPlaces, complete_estimates, place_made, place_pinned};
use shagreen_studio::felt::join_felt;
use shagreen_studio::height_map::{ReliefPlace, join_relief};
use shagreen_studio::project::{can_have_its_axes, textures_on_axes};

use crate::state::axes_change::AxesChange;
use crate::state::moved_points::move_to_axes;

/// Says whether a texture that was added belongs to the project.
pub(super) fn set_own(project: &mut Project, joined: usize, is_own: bool) {
    let Some(entry) = project.joined.get(joined) else { return };
    if is_own {
        project.own.insert(entry.id.clone());
        complete_estimates(project, [joined]);
    } else {
        project.own.remove(&entry.id);
    }
}

/// Adds textures to the list.
pub(super) fn add_textures(project: &mut Project, entries: Vec<Arc<TextureEntry>>) {
    let n_before = project.joined.len();
    project.add_textures(entries);
    let n = project.joined.len();
    complete_estimates(project, n_before..n);
}

/// Replaces an added texture by the same one with a position.
pub(super) fn place_texture(project: &mut Project, joined: usize, entry: Arc<TextureEntry>) {
    if let Some(before) = project.joined.get_mut(joined) {
        *before = entry;
        complete_estimates(project, [joined]);
    }
}

/// Deletes an added texture.
pub(super) fn remove_texture(project: &mut Project, joined: usize) {
    if joined < project.joined.len() {
        let removed = project.joined.remove(joined);
        project.own.remove(&removed.id);
        project.coordinates.remove(&removed.id);
        project.solo = None;
    }
}

/// Adds the texture that was simulated for an authored texture, at the point of that.
pub(super) fn join_simulated(
    project: &mut Project,
    key: u32,
    entry: Arc<TextureEntry>,
    earlier: Option<&Arc<TextureEntry>>,
) {
    let id = entry.id.clone();
    join_felt(project, key, entry, earlier);
    place_made(project, key, &id);
}

/// Adds a texture with a relief; one that was made for an authored texture is at the point of that.
pub(super) fn add_relief(project: &mut Project, entry: Arc<TextureEntry>, place: ReliefPlace) {
    let (id, n_before) = (entry.id.clone(), project.joined.len());
    join_relief(project, entry, place);
    let n = project.joined.len();
    match place {
        ReliefPlace::Pinned(key) => place_made(project, key, &id),
        ReliefPlace::Added => complete_estimates(project, n_before..n),
        ReliefPlace::InPlaceOf(_) => {}
    }
}

/// Chooses axes and moves the points to them.
pub(super) fn set_axes(project: &mut Project, change: AxesChange) {
    change.apply(project);
    let n = project.authored.len();
    place_pinned(project, 0..n);
}

/// Changes the selected authored texture.
pub(super) fn change(project: &mut Project, change: impl FnOnce(&mut AuthoredTexture)) {
    change(Arc::make_mut(&mut project.authored[project.selected]));
}

/// Changes points of the selected authored texture. The library file may have changed since the others were set, so all of them
/// get one coordinate for each axis of the space.
pub(super) fn change_points(project: &mut Project, edit: impl FnOnce(&mut AuthoredTexture)) {
    let n_axes = project.n_axes();
    change(project, |texture| {
        edit(texture);
        texture.fit(n_axes);
    });
}

/// Adds an authored texture behind the selected one, and selects it.
pub(super) fn author(project: &mut Project, texture: AuthoredTexture) {
    let mut texture = in_space(project, AuthoredTexture { key: project.free_key(), ..texture });
    texture.fit(project.n_axes());
    project.authored.insert(project.selected + 1, Arc::new(texture));
    (project.selected, project.solo) = (project.selected + 1, None);
}

/// Adds an authored texture with the textures that only it uses.
pub(super) fn author_with(project: &mut Project, mut texture: AuthoredTexture, own: Vec<Arc<TextureEntry>>) {
    for entry in &own {
        texture.blend.locked.remove(&entry.id);
    }
    let n_before = project.joined.len();
    project.add_textures(own);
    let added: Vec<String> = project.joined.iter().skip(n_before).map(|entry| entry.id.clone()).collect();
    texture.blend.locked.extend(added.iter().cloned());
    project.own.extend(added);
    author(project, texture);
    let selected = project.selected;
    place_pinned(project, [selected]);
}

/// A texture with its points on the axes of the space, if it is a snapshot that was taken on others. Points keep their
/// coordinates on axes of the same name, and have the local mean of the textures on the others. If its position is that of a
/// texture that it pins on all axes of the same name, it is so on the others, too.
fn in_space(project: &Project, mut texture: AuthoredTexture) -> AuthoredTexture {
    let Some(axes) = texture.axes.take() else { return texture };
    let names = project.axis_names();
    let from: Vec<Option<usize>> =
        names.iter().map(|name| axes.iter().position(|known| known == name)).collect();
    let is_pinned = |id: &str| texture.blend.locked.contains(id);
    // Without positions, there are no means either, and points are in the middle of the other axes.
    let library = textures_on_axes(project).unwrap_or_default();
    let common = project.with_places_of(&library, |_| false).positions();
    let is_there = |place: &SpacePoint| {
        let is_same = |(axis, before): (usize, &Option<usize>)| {
            before.is_none_or(|before| place.get(axis) == texture.at.get(before))
        };
        from.iter().any(Option::is_some) && from.iter().enumerate().all(is_same)
    };
    let pinned = library.textures.iter().filter(|entry| is_pinned(&entry.id));
    let there = pinned.filter_map(TextureEntry::at).find(is_there);
    move_to_axes(&mut texture, &from, &common);
    if let Some(there) = there {
        texture.at = there;
    }
    texture
}

/// Deletes the authored texture with this key, unless it is the last one.
pub(super) fn remove(project: &mut Project, key: u32) {
    let Some(index) = project.authored.iter().position(|texture| texture.key == key) else { return };
    if project.authored.len() > 1 {
        project.authored.remove(index);
        if index < project.selected || project.selected == project.authored.len() {
            project.selected -= 1;
        }
        project.solo = None;
    }
}

/// Selects the texture of a snapshot and restores its state.
pub(super) fn restore(project: &mut Project, index: usize) {
    let Some(snapshot) = project.snapshots.get(index) else { return };
    let snapshot = in_space(project, AuthoredTexture::clone(snapshot));
    project.solo = None;
    let Some(own) = project.authored.iter().position(|texture| texture.key == snapshot.key) else {
        // No other texture has its key: a new one never gets that of a snapshot.
        project.selected += 1;
        project.authored.insert(project.selected, Arc::new(snapshot));
        return;
    };
    project.selected = own;
    change(project, |texture| {
        texture.at = snapshot.at;
        texture.blend.clone_from(&snapshot.blend);
        texture.shape = snapshot.shape;
        texture.path.clone_from(&snapshot.path);
        texture.picture.clone_from(&snapshot.picture);
    });
}

/// Opens a library and resets what belongs to the textures of the previous one. Textures that belong to the points, and their
/// pins, stay, under other identifiers if the library needs that.
pub(super) fn open(project: &mut Project, library: ProjectLibrary) {
    if library == project.library {
        return;
    }
    let (former, own_places) = (axes_of(project), OwnPlaces::of(project));
    project.library = library;
    (project.space, project.solo) = (None, None);
    keep_axes(project);
    project.follow_axes(&former);
    project.renamed.clear();
    project.starred.clear();
    let own = &project.own;
    for texture in &mut project.authored {
        if !texture.blend.locked.is_subset(own) {
            Arc::make_mut(texture).blend.locked.retain(|id| own.contains(id));
        }
    }
    project.follow_listed_ids();
    own_places.follow(project);
}

/// Takes positions and attributes of the textures from a built space.
pub(super) fn use_space(project: &mut Project, space: Arc<PlacedSpace>) {
    let (former, own_places) = (axes_of(project), OwnPlaces::of(project));
    project.space = Some(space);
    keep_axes(project);
    project.follow_axes(&former);
    own_places.follow(project);
}

/// Keeps the chosen axes if the new textures can be placed on them; otherwise, the axes are those of the positions.
fn keep_axes(project: &mut Project) {
    if !can_have_its_axes(project) {
        project.axes = None;
    }
}

fn axes_of(project: &Project) -> Vec<String> {
    project.axis_names().into_iter().map(str::to_owned).collect()
}
