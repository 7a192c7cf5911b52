//! Reliefs from pictures: which texture gets one, and how it joins the project.

use std::sync::Arc;

use egui::Context;
use shagreen_core::space::LabelSource;
use shagreen_core::texture::shape::Shape;
use shagreen_formats::library::{Place, TextureEntry, free_name};
use shagreen_formats::project::AuthoredTexture;
use shagreen_studio::height_map::{PictureRelief, ReliefPlace, with_relief};
use shagreen_studio::report::Warnings;

use super::Window;
use crate::author::texture_menu::copied;
use crate::command::Command;
use crate::command::relief::{ReliefCommand, ReliefOf};
use crate::panel::Panel;
use crate::sheets::Sheet;
use crate::sheets::relief_choice::ReliefChoice;
use crate::sheets::relief_sheet::{ReliefSheet, ReliefTarget};
use crate::state::edit::Edit;
use crate::strings::relief as strings;

impl Window {
    /// Executes a command about reliefs.
    pub(super) fn carry_out_relief(&mut self, command: ReliefCommand, ctx: &Context) {
        match command {
            ReliefCommand::AskWhatFor(of, picture) => {
                let of = of.unwrap_or_else(|| self.audible());
                let name = self.name_of(&of).unwrap_or_default();
                let choice = ReliefChoice::new(picture, of, name, self.prompts.described());
                self.sheet = Sheet::ReliefChoice(choice);
            }
            ReliefCommand::Begin(of, picture) => {
                let of = of.unwrap_or_else(|| self.audible());
                if let ReliefOf::Authored(key) = &of
                    && let Some(texture) = self.project.authored.iter().find(|texture| texture.key == *key)
                {
                    self.session.prepare(texture);
                }
                let target = self.relief_target(of);
                self.sheet = Sheet::Relief(Box::new(ReliefSheet::new(target, picture, ctx)));
            }
            ReliefCommand::Apply(relief) => self.apply_relief(&relief, ctx),
        }
    }

    /// Texture of the list that plays alone, or else the authored texture that the inspector shows.
    fn audible(&self) -> ReliefOf {
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        match panel.solo() {
            Some(texture) => ReliefOf::Listed(self.session.textures()[texture].id.clone()),
            None => ReliefOf::Authored(panel.inspected().key),
        }
    }

    fn name_of(&self, of: &ReliefOf) -> Option<String> {
        match of {
            ReliefOf::Listed(id) => {
                let texture = self.session.index_of(id)?;
                Some(self.session.textures()[texture].name.clone())
            }
            ReliefOf::Authored(key) => self.authored_with(*key).map(|texture| texture.name.clone()),
        }
    }

    fn authored_with(&self, key: u32) -> Option<&AuthoredTexture> {
        self.project.authored.iter().map(|texture| &**texture).find(|texture| texture.key == key)
    }

    /// Index among the added textures of a texture of the list; `None` for a texture of the library.
    fn joined_index(&self, texture: usize) -> Option<usize> {
        Panel::new(&self.project, &self.session, &self.compare, &self.pictures).joined_index(texture)
    }

    fn relief_target(&self, of: ReliefOf) -> ReliefTarget {
        let name = self.name_of(&of);
        let Some(name) = name else {
            return ReliefTarget { of, note: String::new(), picture: None, refusal: Some(strings::GONE) };
        };
        let (note, refusal) = match &of {
            ReliefOf::Listed(id) => {
                let texture = self.session.index_of(id);
                let entry = texture.and_then(|texture| self.session.textures().get(texture));
                let is_added = texture.and_then(|texture| self.joined_index(texture)).is_some();
                let note = if is_added { strings::of_added(&name) } else { strings::of_library(&name) };
                let has_one = entry.is_some_and(|entry| entry.model.height_map().is_some());
                let replaces = if has_one { strings::REPLACES } else { "" };
                let is_path = entry.is_some_and(|entry| entry.path.is_some());
                (format!("{note}{replaces}"), is_path.then_some(strings::IS_PATH))
            }
            ReliefOf::Authored(key) => {
                let mode = |texture: &AuthoredTexture| self.session.blend_in_space(&texture.blend).mode;
                let has_model = self.authored_with(*key).is_some_and(|of| mode(of).makes_a_model());
                (strings::of_authored(&name), (!has_model).then_some(strings::NO_MODEL))
            }
        };
        let picture = match &of {
            ReliefOf::Authored(key) => self.authored_with(*key).and_then(|texture| texture.picture.clone()),
            ReliefOf::Listed(_) => None,
        };
        ReliefTarget { of, note, picture, refusal }
    }

    /// Gives the texture of the open sheet a relief, in one step. If that fails, the sheet stays and says why.
    fn apply_relief(&mut self, relief: &PictureRelief, ctx: &Context) {
        let Sheet::Relief(sheet) = &self.sheet else { return };
        let made = match sheet.of() {
            ReliefOf::Listed(id) => self.listed_with(id, relief),
            ReliefOf::Authored(key) => self.authored_texture_with(*key, relief),
        };
        match made {
            Ok((entry, place)) => {
                self.sheet = Sheet::Closed;
                self.gesture.begin_another();
                let edit = Edit::AddRelief { entry: Arc::new(entry), place };
                self.carry_out(Command::Edit(edit), ctx);
            }
            Err(reason) => {
                if let Sheet::Relief(sheet) = &mut self.sheet {
                    sheet.say(reason);
                }
            }
        }
    }

    /// An added texture with a relief, or a copy of a texture of the library with it.
    fn listed_with(&self, id: &str, relief: &PictureRelief) -> Result<(TextureEntry, ReliefPlace), String> {
        let texture = self.session.index_of(id).ok_or_else(|| strings::GONE.to_owned())?;
        let joined =
            self.joined_index(texture).and_then(|index| Some((index, self.project.joined.get(index)?)));
        let (before, place) = match joined {
            // An id that the library has too was changed in the list.
            Some((index, joined)) => {
                let before = TextureEntry { id: id.to_owned(), ..TextureEntry::clone(joined) };
                (before, ReliefPlace::InPlaceOf(index))
            }
            None => (copied(self.session.library(), texture, strings::with_relief), ReliefPlace::Added),
        };
        Ok((with_picture(&before, relief)?, place))
    }

    /// The texture at the point of an authored texture with a relief. It gets the position of the point and no shape, so
    /// that the authored texture shapes it; where it can have no position, it gets the shape and plays alone.
    fn authored_texture_with(
        &self,
        key: u32,
        relief: &PictureRelief,
    ) -> Result<(TextureEntry, ReliefPlace), String> {
        let texture = self.authored_with(key).ok_or_else(|| strings::GONE.to_owned())?;
        let at = self.position_for(texture, None);
        let is_taken = |name: &str| self.session.textures().iter().any(|entry| entry.name == name);
        let name = free_name(&strings::with_relief(&texture.name), is_taken);
        let is_shaped = !self.is_free_for(texture, None) && !texture.shape.is_neutral();
        let shape = if is_shaped { texture.shape } else { Shape::default() };
        let before = self.session.entry_of_authored(texture, &name, &shape)?;
        let before = TextureEntry { place: at.map(|at| Place::new(at, LabelSource::Estimated)), ..before };
        let place = if is_shaped { ReliefPlace::Added } else { ReliefPlace::Pinned(key) };
        Ok((with_picture(&before, relief)?, place))
    }
}

/// A texture with the heights and the picture of a relief. The sheet has said what is replaced.
fn with_picture(before: &TextureEntry, relief: &PictureRelief) -> Result<TextureEntry, String> {
    with_relief(before, relief, &Warnings::default()).map_err(|error| format!("{error:#}"))
}
