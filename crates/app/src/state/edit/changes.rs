//! Changes of a project that need more than one step: authored textures, snapshots, and the library.

use std::sync::Arc;

use shagreen_formats::library::TextureEntry;
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};

use crate::state::axes_change::fit_points;

/// Says whether a texture that was added belongs to the project.
pub(super) fn set_own(project: &mut Project, joined: usize, is_own: bool) {
    let Some(entry) = project.joined.get(joined) else { return };
    if is_own {
        project.own.insert(entry.id.clone());
    } else {
        project.own.remove(&entry.id);
    }
}

/// Changes the selected authored texture.
pub(super) fn change(project: &mut Project, change: impl FnOnce(&mut AuthoredTexture)) {
    change(Arc::make_mut(&mut project.authored[project.selected]));
}

/// Adds an authored texture behind the selected one, and selects it.
pub(super) fn author(project: &mut Project, texture: AuthoredTexture) {
    let texture = AuthoredTexture { key: project.free_key(), ..texture };
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
    let Some(snapshot) = project.snapshots.get(index).cloned() else { return };
    project.solo = None;
    let Some(own) = project.authored.iter().position(|texture| texture.key == snapshot.key) else {
        // No other texture has its key: a new one never gets that of a snapshot.
        project.selected += 1;
        project.authored.insert(project.selected, snapshot);
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

/// Opens a library and resets what belongs to the textures of the previous one. Pins of textures that belong to the points
/// follow if the library needs other identifiers for these.
pub(super) fn open(project: &mut Project, library: ProjectLibrary) {
    if library == project.library {
        return;
    }
    project.library = library;
    (project.space, project.axes, project.solo) = (None, None, None);
    fit_points(project);
    project.renamed.clear();
    project.starred.clear();
    let own = &project.own;
    for texture in &mut project.authored {
        if !texture.blend.locked.is_subset(own) {
            Arc::make_mut(texture).blend.locked.retain(|id| own.contains(id));
        }
    }
    project.follow_listed_ids();
}
