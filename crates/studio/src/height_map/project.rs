//! Textures with a relief in a project.

use std::collections::BTreeMap;
use std::sync::Arc;

use shagreen_formats::library::TextureEntry;
use shagreen_formats::project::Project;

use crate::felt::join_felt;

/// Where a texture with a relief belongs in a project.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReliefPlace {
    /// In place of the added texture with this index, which takes part where that did.
    InPlaceOf(usize),
    /// Behind the added textures, and in no authored texture until one pins it.
    Added,
    /// Behind the added textures, and pinned by the authored texture with this key, whose point it is made for.
    Pinned(u32),
}

/// Adds a texture with a relief to a project. It is rendered alone until the point moves; an authored texture with a shape
/// that pins it is rendered instead, because a texture that is rendered alone has no shape. A picture of the authored texture's
/// own becomes that of the relief, or it would show something else than what is felt.
pub fn join_relief(project: &mut Project, entry: Arc<TextureEntry>, place: ReliefPlace) {
    let id = entry.id.clone();
    match place {
        ReliefPlace::InPlaceOf(index) => {
            let Some(replaced) = project.joined.get_mut(index) else { return };
            if project.own.remove(&replaced.id) {
                project.own.insert(id.clone());
            }
            project.coordinates.rename(&BTreeMap::from([(replaced.id.clone(), id.clone())]));
            *replaced = entry;
        }
        ReliefPlace::Added => {
            project.own.insert(id.clone());
            project.joined.push(entry);
        }
        ReliefPlace::Pinned(key) => {
            if let Some(texture) = project.authored.iter_mut().find(|texture| texture.key == key)
                && texture.picture.is_some()
            {
                Arc::make_mut(texture).picture = entry.picture.clone().map(Arc::new);
            }
            join_felt(project, key, entry, None);
            if project.authored.iter().any(|texture| texture.key == key && !texture.shape.is_neutral()) {
                project.solo = None;
            }
            return;
        }
    }
    project.solo = Some(id);
}
