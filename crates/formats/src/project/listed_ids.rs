//! Identifiers of added textures, which are those of the list of a project.
//!
//! The list ([`Project::textures_on`]) gives an added texture another identifier if the library has a texture with its own:
//! one library is opened after another, or a library file changes. Pins and marks refer to textures of the list. Added
//! textures therefore take their identifiers of the list, and pins and marks follow.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::library::{TextureEntry, free_id};
use crate::project::{AuthoredTexture, Project, ProjectLibrary};
use crate::text_limits::{MAX_ID, begin_of};

impl Project {
    /// Adds textures, under other identifiers if theirs are taken.
    pub fn add_textures(&mut self, entries: Vec<Arc<TextureEntry>>) {
        let mut taken = ids_of(&self.library);
        taken.extend(self.joined.iter().map(|entry| entry.id.clone()));
        let added = entries.into_iter().map(|entry| with_free_id(entry, &mut taken));
        self.joined.extend(added);
    }

    /// Gives the added textures the identifiers that they have in the list after the library was replaced. Marks, and pins of
    /// textures that have another identifier now, follow.
    pub fn follow_listed_ids(&mut self) {
        let listed = listed(&self.library, self.joined.clone());
        let pairs = self.joined.iter().zip(&listed).filter(|(before, now)| before.id != now.id);
        let renamed: BTreeMap<String, String> =
            pairs.map(|(before, now)| (before.id.clone(), now.id.clone())).collect();
        self.joined = listed;
        if renamed.is_empty() {
            return;
        }
        let now = |id: &String| renamed.get(id).unwrap_or(id).clone();
        self.own = self.own.iter().map(now).collect();
        self.coordinates.rename(&renamed);
        let follow = |texture: &mut Arc<AuthoredTexture>| {
            if texture.blend.locked.iter().any(|id| renamed.contains_key(id)) {
                let locked = texture.blend.locked.iter().map(now).collect();
                Arc::make_mut(texture).blend.locked = locked;
            }
        };
        self.authored.iter_mut().chain(&mut self.snapshots).for_each(follow);
    }
}

/// Added textures with the identifiers that they have in the list behind a library.
pub(super) fn listed(library: &ProjectLibrary, joined: Vec<Arc<TextureEntry>>) -> Vec<Arc<TextureEntry>> {
    if joined.is_empty() {
        return joined;
    }
    let mut taken = ids_of(library);
    joined.into_iter().map(|entry| with_free_id(entry, &mut taken)).collect()
}

/// A texture with an identifier that is not taken, which is taken from now on. [`crate::library::Library::join`] chooses the
/// same one, unless it would be too long for a file.
fn with_free_id(mut entry: Arc<TextureEntry>, taken: &mut BTreeSet<String>) -> Arc<TextureEntry> {
    if taken.contains(&entry.id) {
        // A number follows.
        let begin = begin_of(entry.id.clone(), MAX_ID - 20);
        Arc::make_mut(&mut entry).id = free_id(&begin, |id| taken.contains(id));
    }
    taken.insert(entry.id.clone());
    entry
}

/// Identifiers of the textures of a library; none of a built-in one that cannot be read, which no list can show.
fn ids_of(library: &ProjectLibrary) -> BTreeSet<String> {
    let ids = |textures: &[TextureEntry]| textures.iter().map(|texture| texture.id.clone()).collect();
    match library {
        ProjectLibrary::BuiltIn(built_in) => {
            built_in.read().map_or_else(|_| BTreeSet::new(), |library| ids(&library.textures))
        }
        ProjectLibrary::File(file) => ids(&file.library.textures),
        ProjectLibrary::Inside(library) => ids(&library.textures),
    }
}
