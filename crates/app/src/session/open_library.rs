//! Another library takes the place of the one that is open.

use shagreen_formats::project::{Project, ProjectLibrary};

use super::Session;
use super::places::Opened;
use crate::strings;

impl Session {
    /// The library of the project that is open.
    pub fn base(&self) -> &ProjectLibrary {
        &self.base
    }

    /// Libraries that were open before and are none of the program's.
    pub fn other_libraries(&self) -> &[ProjectLibrary] {
        &self.others
    }

    /// Opens the library of the project, without the textures that joined; returns for each texture whether the one at the
    /// same index was heard before, so that it need not be prepared again.
    pub(super) fn open_library(&mut self, project: &Project) -> Vec<bool> {
        let left = std::mem::replace(&mut self.base, project.library.clone());
        self.others.retain(|other| *other != self.base);
        if !matches!(left, ProjectLibrary::BuiltIn(_)) && !self.others.contains(&left) {
            self.others.push(left);
        }
        let library = match project.library.read() {
            Ok(library) => library,
            Err(error) => {
                // The textures that are open stay.
                self.player.message = Some(format!("{}: {error}", strings::DAMAGED_LIBRARY));
                return vec![true; self.library.textures.len()];
            }
        };
        let joined = project.joined.iter().map(|t| &t.model);
        let models = library.textures.iter().map(|t| &t.model).chain(joined);
        let before = self.library.textures.iter().map(|t| &t.model);
        let is_same = before.zip(models).map(|(a, b)| a == b).collect();
        self.opened = Opened::new(&library);
        self.library = library;
        is_same
    }
}
