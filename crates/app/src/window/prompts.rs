//! Results of prompts and photos.

use std::sync::Arc;

use egui::Context;
use shagreen_core::space::SpacePoint;
use shagreen_formats::library::{TextureEntry, free_id, free_name, id_from_name};
use shagreen_formats::picture::Picture;
use shagreen_formats::project::AuthoredTexture;
use shagreen_studio::added_places::LEAST_DISTANCE;
use shagreen_studio::felt::{FELT_ORIGIN, felt_entry, replaceable_felt};

use super::Window;
use crate::author::new_texture::next_color;
use crate::author::prompt::{PositionEstimate, Simulated, has_still};
use crate::command::Command;
use crate::command::prompt::PromptCommand;
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::prompt as words;
use crate::workspace::Workspace;

impl Window {
    /// Executes a command about prompts, and records the prompt in the settings.
    pub(super) fn carry_out_prompt(&mut self, command: PromptCommand, ctx: &Context) {
        if let PromptCommand::TakeMaterial(material) = command {
            return self.take_material(material, ctx);
        }
        let interrupts = matches!(command, PromptCommand::Make { .. } | PromptCommand::Another);
        if self.prompts.is_busy() && interrupts {
            return self.session.say(words::STILL_BUSY.to_owned());
        }
        let (texture, axes) = (self.project.texture(), self.session.axes());
        if let Some(kept) = self.prompts.carry_out(command, texture, axes, ctx) {
            self.files.settings.note_prompt(kept);
        }
    }

    /// Moves the selected texture to the lexicon entry of a material that its picture shows, or back to the estimate from the
    /// picture.
    fn take_material(&mut self, material: Option<String>, ctx: &Context) {
        let texture = self.project.texture();
        let Some(before) = self.prompts.guess_of(texture).map(PositionEstimate::notes) else { return };
        let session = &self.session;
        let completed = |guess: PositionEstimate| guess.in_space(session);
        let Some(guess) = self.prompts.take_material(texture, material.as_deref(), completed) else { return };
        // Notes that the user has written stay.
        let notes = if texture.notes == before { guess.notes() } else { texture.notes.clone() };
        let edit = Edit::TakeMaterial { material, at: guess.at(), picture: guess.picture, notes };
        self.gesture.begin_another();
        self.carry_out(Command::Edit(edit), ctx);
    }

    /// Adds the generated texture, or replaces the one that it was generated for.
    pub(super) fn collect_prompt(&mut self, ctx: &Context) {
        if !self.takes_results(ctx) {
            return;
        }
        let Some(done) = self.prompts.collect() else { return };
        self.prompts.look_at_next(self.session.axes(), ctx);
        let arrived = match done {
            Ok(arrived) => arrived,
            Err(reason) => return self.session.say(reason),
        };
        if arrived.axes != self.session.axes() {
            return self.session.say(words::OTHER_AXES.to_owned());
        }
        let guess = arrived.guess.in_space(&self.session);
        let is_there = |(key, picture): &(u32, Arc<Picture>)| {
            self.project.authored.iter().any(|texture| has_still(texture, *key, picture))
        };
        let edits: Vec<Edit> = if let Some((key, _)) = arrived.replaces.filter(is_there) {
            let (at, picture, notes) = (guess.at(), Arc::clone(&guess.picture), guess.notes());
            // Selecting what is selected would end solo as a step of its own.
            let select = (self.project.texture().key != key).then_some(Edit::Select(key));
            select.into_iter().chain([Edit::Remake { at, picture, notes }]).collect()
        } else {
            let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
            let is_taken = |name: &str| self.project.authored.iter().any(|texture| texture.name == name);
            vec![Edit::Author(Box::new(AuthoredTexture {
                color: next_color(&panel),
                at: guess.at(),
                picture: Some(Arc::clone(&guess.picture)),
                notes: guess.notes(),
                blend: self.project.blend_of_new(),
                ..AuthoredTexture::new(0, &free_name(&guess.name, is_taken))
            }))]
        };
        self.gesture.begin_another();
        for edit in edits {
            self.carry_out(Command::Edit(edit), ctx);
        }
        self.prompts.keep(guess, self.project.texture().key, ctx);
        self.prompts.note_step(self.history.revision());
    }

    /// Whether results may change the project: they wait while the user drags, a sheet is open, another workspace is
    /// visible, or a blind comparison runs.
    fn takes_results(&self, ctx: &Context) -> bool {
        let is_free = !self.gesture.was_holding || ctx.text_edit_focused();
        is_free
            && !self.sheet.is_open()
            && self.pages.workspace == Workspace::Author
            && !self.compare.is_hidden()
    }

    /// Adds the texture that was simulated for a generated picture, unless its authored texture has another picture by now.
    pub(super) fn collect_simulated(&mut self, ctx: &Context) {
        if !self.takes_results(ctx) {
            return;
        }
        let Some(done) = self.prompts.collect_simulated() else { return };
        let Simulated { of: (key, picture), model } = match done {
            Ok(simulated) => simulated,
            Err(reason) => return self.session.say(reason),
        };
        let Some(texture) = self.project.authored.iter().find(|texture| has_still(texture, key, &picture))
        else {
            return;
        };
        let textures = self.session.textures();
        let is_taken = |id: &str| textures.iter().any(|entry| entry.id == id);
        let id = free_id(&id_from_name(&texture.name), is_taken);
        let earlier = self.prompts.simulated_for(key).cloned();
        let at = self.position_for(texture, earlier.as_ref());
        let picture = Picture::clone(&picture);
        let entry = Arc::new(felt_entry(id, &texture.name, &texture.notes, model, picture, at));
        let edit = Edit::JoinSimulated { key, entry: Arc::clone(&entry), earlier };
        if self.prompts.is_at_step(self.history.revision()) {
            // Texture and simulation of one prompt are undone together.
            self.compare.end();
            self.history.add_to_last(&mut self.project, edit);
        } else {
            self.gesture.begin_another();
            self.carry_out(Command::Edit(edit), ctx);
        }
        self.prompts.note_simulated(key, entry);
    }

    /// Selected authored texture while the texture that was simulated for it plays alone.
    pub(super) fn simulated_texture(&self) -> Option<Arc<AuthoredTexture>> {
        let texture = self.project.authored.get(self.project.selected)?;
        let solo = self.project.solo.as_ref()?;
        let alone = self.project.joined.iter().find(|joined| joined.id == *solo)?;
        let is_its = alone.origin == FELT_ORIGIN
            && alone.picture.as_ref().is_some_and(|picture| texture.picture.as_deref() == Some(picture));
        is_its.then(|| Arc::clone(texture))
    }

    /// Position on the axes of the library of a texture that is simulated for an authored texture, if no other texture lies there
    /// ([`Window::is_free_for`]). In a built space and on chosen axes, the edit that adds the texture places it by name
    /// ([`shagreen_studio::added_places`]).
    pub(super) fn position_for(
        &self,
        texture: &AuthoredTexture,
        earlier: Option<&Arc<TextureEntry>>,
    ) -> Option<SpacePoint> {
        let is_as_filed = self.project.space.is_none() && self.project.axes.is_none();
        (is_as_filed && self.is_free_for(texture, earlier)).then(|| self.session.fitted(texture.at))
    }

    /// Whether a texture can be placed at the point of an authored texture: of two textures at one position, only one can be
    /// pinned. `earlier` was simulated for the authored texture before. Textures that take no part in it do not count.
    pub(super) fn is_free_for(&self, texture: &AuthoredTexture, earlier: Option<&Arc<TextureEntry>>) -> bool {
        let replaced =
            earlier.filter(|earlier| replaceable_felt(&self.project, texture.key, earlier).is_some());
        let textures = self.session.textures();
        let at = self.session.fitted(texture.at);
        let is_far = |(index, site): &(usize, SpacePoint)| {
            replaced.is_some_and(|replaced| replaced.id == textures[*index].id)
                || site.distance(at) > LEAST_DISTANCE
        };
        self.session.placed_for(&texture.blend).iter().all(is_far)
    }
}
