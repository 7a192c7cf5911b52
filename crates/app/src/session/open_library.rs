//! Opens another library.

use shagreen_formats::project::{Project, ProjectLibrary};

use super::Session;
use super::places::Opened;
use crate::strings;

impl Session {
    /// Library of the open project.
    pub fn base(&self) -> &ProjectLibrary {
        &self.textures.base
    }

    /// Libraries that were open before, except the built-in ones.
    pub fn other_libraries(&self) -> &[ProjectLibrary] {
        &self.textures.others
    }

    /// Opens the library of the project, without the textures that the project added. Returns, by index, whether a
    /// texture has the same model as before, so that its prepared plane is still valid.
    pub(super) fn open_library(&mut self, project: &Project) -> Vec<bool> {
        let left = std::mem::replace(&mut self.textures.base, project.library.clone());
        self.textures.others.retain(|other| *other != self.textures.base);
        if !matches!(left, ProjectLibrary::BuiltIn(_)) && !self.textures.others.contains(&left) {
            self.textures.others.push(left);
        }
        let library = match project.library.read() {
            Ok(library) => library,
            Err(error) => {
                // The present textures stay open.
                self.say(format!("{}: {error}", strings::DAMAGED_LIBRARY));
                return vec![true; self.textures.library.textures.len()];
            }
        };
        let joined = project.joined.iter().map(|t| &t.model);
        let models = library.textures.iter().map(|t| &t.model).chain(joined);
        let before = self.textures.library.textures.iter().map(|t| &t.model);
        let is_same = before.zip(models).map(|(a, b)| a == b).collect();
        self.textures.opened = Opened::new(&library);
        self.textures.library = library;
        is_same
    }
}
