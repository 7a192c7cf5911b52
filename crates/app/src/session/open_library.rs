//! Another library takes the place of the one that is open, and gives it back.

use shagreen_formats::library::Library;

use super::Session;
use super::places::Opened;
use crate::libraries::BuiltIn;
use crate::project::Project;

impl Session {
    /// Which of the program's libraries is open, where it is one of them.
    pub fn built_in(&self) -> Option<BuiltIn> {
        self.built_in.or_else(|| self.first_as())
    }

    /// Which of the program's libraries the session began with, where it was one of them. Asked for the first time, it
    /// takes some milliseconds.
    pub fn first_as(&self) -> Option<BuiltIn> {
        let look = || {
            if let Some((library, _)) = &self.first {
                return BuiltIn::of(library);
            }
            let mut library = self.library.clone();
            self.opened.restore(&mut library);
            BuiltIn::of(&library)
        };
        *self.first_as.get_or_init(look)
    }

    /// Name of the library that the session began with.
    pub fn first_name(&self) -> &str {
        self.first.as_ref().map_or(&self.library.name, |(library, _)| &library.name)
    }

    /// Opens the library of the project, without the textures that joined; returns for each texture whether the one at the
    /// same index was heard before, so that it need not be prepared again.
    pub(super) fn open_library(&mut self, project: &Project) -> Vec<bool> {
        let (library, opened) = match project.library.map(BuiltIn::read) {
            Some(Ok(library)) => {
                let opened = Opened::new(&library);
                (library, opened)
            }
            Some(Err(error)) => {
                // What is open stays.
                self.player.message = Some(format!("{error:#}"));
                return vec![true; self.library.textures.len()];
            }
            None => match self.first.take() {
                Some(first) => first,
                None => return vec![true; self.library.textures.len()],
            },
        };
        self.built_in = project.library;
        let models = library.textures.iter().map(|t| &t.model).chain(project.added.iter().map(|t| &t.model));
        let before = self.library.textures.iter().map(|t| &t.model);
        let is_same = before.zip(models).map(|(a, b)| a == b).collect();
        let mut left: Library = std::mem::replace(&mut self.library, library);
        let left_opened = std::mem::replace(&mut self.opened, opened);
        if project.library.is_some() && self.first.is_none() {
            left_opened.restore(&mut left);
            self.first = Some((left, left_opened));
        }
        is_same
    }
}
