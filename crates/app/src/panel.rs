//! What a panel may look at: read-only. Panels ask for changes by commands.

use shagreen_formats::project::Project;

use crate::compare::Compare;
use crate::pictures::Pictures;
use crate::session::Session;
use crate::strings;

/// The state that panels draw.
#[derive(Clone, Copy)]
pub struct Panel<'a> {
    /// What the user makes.
    pub project: &'a Project,
    /// Textures, space, and what sounds.
    pub session: &'a Session,
    /// What is compared.
    pub compare: &'a Compare,
    /// Pictures of the textures.
    pub pictures: &'a Pictures,
}

impl<'a> Panel<'a> {
    /// The state of these parts.
    pub fn new(
        project: &'a Project,
        session: &'a Session,
        compare: &'a Compare,
        pictures: &'a Pictures,
    ) -> Self {
        Self { project, session, compare, pictures }
    }

    /// The name of what is heard, where it may be known.
    pub fn heard_name(&self) -> String {
        if self.session.is_hidden() {
            return strings::compare::HIDDEN.to_owned();
        }
        if let Some(felt) = self.session.felt_name() {
            return felt.to_owned();
        }
        let compared = self.compare.heard_key();
        let heard = self.project.authored.iter().find(|texture| Some(texture.key) == compared);
        match self.solo().filter(|_| heard.is_none()) {
            Some(alone) => self.session.textures()[alone].name.clone(),
            None => heard.map_or(&self.project.texture().name, |texture| &texture.name).clone(),
        }
    }

    /// Whether the field meets a texture of the list exactly at its own place.
    pub fn is_locked(&self, texture: usize) -> bool {
        self.project.texture().blend.is_locked(&self.session.textures()[texture].id)
    }

    /// Whether a texture of the list has a star.
    pub fn is_starred(&self, texture: usize) -> bool {
        self.project.starred.contains(&self.session.textures()[texture].id)
    }

    /// The place of a texture among those that joined the project; `None` where it is a part of the library.
    pub fn joined_index(&self, texture: usize) -> Option<usize> {
        let n_of_library = self.session.textures().len().saturating_sub(self.project.joined.len());
        texture.checked_sub(n_of_library)
    }

    /// The texture that is heard alone, by its place in the list.
    pub fn solo(&self) -> Option<usize> {
        self.session.solo(self.project)
    }
}
