//! Read-only state that panels draw. Panels request changes through commands.

use std::sync::Arc;

use shagreen_core::space::SpacePoint;
use shagreen_core::texture::blend::Mode;
use shagreen_formats::project::{AuthoredTexture, Project};

use crate::session::Session;
use crate::state::compare::Compare;
use crate::state::pictures::Pictures;
use crate::strings;

/// References to the state that panels draw.
#[derive(Clone, Copy)]
pub struct Panel<'a> {
    /// Project that the user edits.
    pub project: &'a Project,
    /// Textures, space, and audio output.
    pub session: &'a Session,
    /// State of the A/B comparison.
    pub compare: &'a Compare,
    /// Pictures of the textures.
    pub pictures: &'a Pictures,
}

impl<'a> Panel<'a> {
    /// Bundles references to the state.
    pub fn new(
        project: &'a Project,
        session: &'a Session,
        compare: &'a Compare,
        pictures: &'a Pictures,
    ) -> Self {
        Self { project, session, compare, pictures }
    }

    /// Name of the audible texture or signal; a placeholder while a blind comparison hides it.
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

    /// Authored texture that the inspector shows: the one that an open comparison plays, or else the selected one.
    pub fn inspected(&self) -> &'a AuthoredTexture {
        let compared = self.compare.heard_key().filter(|_| !self.compare.is_hidden());
        let heard = compared.and_then(|key| self.project.authored.iter().find(|texture| texture.key == key));
        heard.map_or(self.project.texture(), Arc::as_ref)
    }

    /// Whether the texture that the inspector shows is the selected one, to which edits apply.
    pub fn can_edit(&self) -> bool {
        self.inspected().key == self.project.texture().key
    }

    /// Point through whose further coordinates the canvas shows a slice of the space, its textures and its map: that of the
    /// texture that the inspector shows. A path that plays does not move it, because a map takes longer than a frame.
    pub fn slice_point(&self) -> SpacePoint {
        self.session.fitted(self.inspected().at)
    }

    /// Point of the canvas with the further coordinates of the selected texture, to which edits apply.
    pub fn on_slice(&self, at: SpacePoint) -> SpacePoint {
        self.session.fitted(self.project.texture().at).on_canvas_at(at)
    }

    /// Whether textures can be pinned in the selected texture: only its mode Field passes through them.
    pub fn can_lock(&self) -> bool {
        self.project.texture().blend.mode_in_space(self.session.n_axes()) == Mode::Field
    }

    /// Whether a texture of the list is pinned: the field passes through it exactly at its position.
    pub fn is_locked(&self, texture: usize) -> bool {
        let locked = &self.project.texture().blend.locked;
        self.can_lock() && locked.contains(&self.session.textures()[texture].id)
    }

    /// Whether a texture of the list is pinned without effect, because it has no position.
    pub fn has_lost_pin(&self, texture: usize) -> bool {
        self.is_locked(texture) && self.session.position(texture).is_none()
    }

    /// Whether a texture of the list is starred.
    pub fn is_starred(&self, texture: usize) -> bool {
        self.project.starred.contains(&self.session.textures()[texture].id)
    }

    /// Index of a texture among those added to the project; `None` for a texture of the library.
    pub fn joined_index(&self, texture: usize) -> Option<usize> {
        let n_of_library = self.session.textures().len().saturating_sub(self.project.joined.len());
        texture.checked_sub(n_of_library)
    }

    /// Index in the list of the texture that plays alone; `None` while a comparison plays an authored texture instead.
    pub fn solo(&self) -> Option<usize> {
        if self.compare.heard().is_some() { None } else { self.session.solo(self.project) }
    }
}
