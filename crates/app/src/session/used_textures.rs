//! Textures that an authored texture uses: those of the library, added ones, and those that belong to it. The session keeps
//! the spaces of recent authored textures; one worker computes their models.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::Arc;

use shagreen_core::space::authoring::Authoring;
use shagreen_core::space::{LabelSource, Space};
use shagreen_formats::project::{AuthoredTexture, BlendChoice};

use super::Session;
use super::loaded_textures::positions_without;
use super::models_worker::{Ingredients, Job};
use super::spaces::Found;

impl Session {
    /// Interpolation of an authored texture, with the models that are computed so far.
    pub fn authoring_of(&self, texture: &AuthoredTexture) -> Cow<'_, Authoring> {
        self.found(texture).authoring
    }

    /// Number that changes whenever the interpolated texture at any point of an authored texture's space may have changed.
    pub fn generation_of(&self, texture: &AuthoredTexture) -> u64 {
        self.found(texture).generation
    }

    /// Indices of the textures that take no part in an authored texture with these options, because they belong to others.
    pub fn left_out(&self, blend: &BlendChoice) -> Vec<usize> {
        self.textures.own.left_out(self.textures(), |id| blend.locked.contains(id))
    }

    /// Has the models of an authored texture computed after those of the audible one.
    pub(crate) fn prepare(&mut self, texture: &AuthoredTexture) {
        if let Ok(space) = self.space_of(&texture.blend) {
            self.authored.spaces.ensure(space);
        }
    }

    /// Makes the space of an authored texture with these options the current one.
    pub(super) fn follow_space(&mut self, blend: &BlendChoice) {
        if self.authored.pins.as_ref() == Some(&blend.locked) {
            return;
        }
        match self.space_of(blend) {
            Ok(space) => {
                if self.authored.spaces.select(space) {
                    self.sound.player.wanted = None;
                }
            }
            Err(error) => self.say(error.to_string()),
        }
        self.authored.pins = Some(blend.locked.clone());
    }

    /// Keeps the space of the selected authored texture, with these options, while another one is audible: the window shows
    /// it.
    pub(super) fn follow_unheard(&mut self, blend: &BlendChoice) {
        let is_its = |pins: &BTreeSet<String>| *pins == blend.locked;
        if self.authored.pins.as_ref().is_some_and(is_its) {
            self.authored.unheard = None;
        } else if !self.authored.unheard.as_ref().is_some_and(|(pins, _)| is_its(pins)) {
            // Where textures have no space, the session has said so for the audible one.
            self.authored.unheard = self.space_of(blend).ok().map(|space| (blend.locked.clone(), space));
            if let Some((_, space)) = &self.authored.unheard {
                self.authored.spaces.ensure(space.clone());
            }
        }
    }

    /// Requests the models of the field and parametric modes that are needed next.
    pub(super) fn ask_for_models(&mut self) {
        if let Some(space) = self.authored.spaces.next_to_ask() {
            let job = self.job(space);
            self.authored.models.ask(job);
        }
    }

    /// What the models of a space are computed from.
    pub(super) fn job(&self, space: Space) -> Job {
        let mut textures: Vec<Option<Ingredients>> = self.textures.planes.iter().map(|_| None).collect();
        for (texture, _) in space.sites() {
            let model = &self.textures.library.textures[*texture].model;
            let plane = Arc::clone(&self.textures.planes[*texture]);
            textures[*texture] = Some(Ingredients::of(model, plane));
        }
        Job { space, textures }
    }

    /// Common source of the positions in a space, or `None` if there are no positions or several sources.
    pub(super) fn source_in(&self, space: &Space) -> Option<LabelSource> {
        let mut sources = space.sites().iter().map(|(texture, _)| self.place_source(*texture));
        let first = sources.next()?;
        first.filter(|_| sources.all(|source| source == first))
    }

    /// Interpolation of an authored texture; without models if its space is not kept.
    pub(super) fn found(&self, texture: &AuthoredTexture) -> Found<'_> {
        let spaces = &self.authored.spaces;
        if self.authored.pins.as_ref() == Some(&texture.blend.locked) {
            return spaces.found_current();
        }
        let kept = self.authored.unheard.as_ref().filter(|(pins, _)| *pins == texture.blend.locked);
        let space = match kept {
            // Triangulating a space in every frame would take too long.
            Some((_, space)) => Ok(Cow::Borrowed(space)),
            None => self.space_of(&texture.blend).map(Cow::Owned),
        };
        match space {
            Ok(space) => spaces.find(&space).unwrap_or_else(|| Found::without_models(space.into_owned())),
            Err(_) => spaces.found_current(),
        }
    }

    fn space_of(&self, blend: &BlendChoice) -> anyhow::Result<Space> {
        Ok(Space::new(&positions_without(&self.textures.places, &self.left_out(blend)))?)
    }
}
