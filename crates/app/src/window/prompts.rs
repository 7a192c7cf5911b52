//! Results of prompts and photos.

use std::sync::Arc;

use egui::Context;
use shagreen_formats::library::free_name;
use shagreen_formats::picture::Picture;
use shagreen_formats::project::AuthoredTexture;

use super::Window;
use crate::author::new_texture::next_color;
use crate::author::prompt::{axis_names, has_still};
use crate::command::Command;
use crate::command::prompt::PromptCommand;
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::prompt as words;
use crate::workspace::Workspace;

impl Window {
    /// Executes a command about prompts, and records the prompt in the settings.
    pub(super) fn carry_out_prompt(&mut self, command: PromptCommand, ctx: &Context) {
        let interrupts = matches!(command, PromptCommand::Make { .. } | PromptCommand::Another);
        if self.prompts.is_busy() && interrupts {
            return self.session.say(words::STILL_BUSY.to_owned());
        }
        if let Some(kept) = self.prompts.carry_out(command, self.session.poles(), ctx) {
            self.files.settings.note_prompt(kept);
        }
    }

    /// Adds the generated texture, or replaces the one that it was generated for.
    pub(super) fn collect_prompt(&mut self, ctx: &Context) {
        // Results wait while the user drags, a sheet is open, another workspace is visible, or a blind comparison runs.
        let is_free = !self.gesture.was_holding || ctx.text_edit_focused();
        if !is_free
            || self.sheet.is_open()
            || self.pages.workspace != Workspace::Author
            || self.compare.is_hidden()
        {
            return;
        }
        let Some(done) = self.prompts.collect() else { return };
        self.prompts.look_at_next(self.session.poles(), ctx);
        let arrived = match done {
            Ok(arrived) => arrived,
            Err(reason) => return self.session.say(reason),
        };
        if arrived.axes != axis_names(self.session.poles()) {
            return self.session.say(words::OTHER_AXES.to_owned());
        }
        let guess = arrived.guess;
        let is_there = |(key, picture): &(u32, Arc<Picture>)| {
            self.project.authored.iter().any(|texture| has_still(texture, *key, picture))
        };
        let edits = if let Some((key, _)) = arrived.replaces.filter(is_there) {
            let (at, picture, notes) = (guess.at(), Arc::clone(&guess.picture), guess.notes());
            vec![Edit::Select(key), Edit::Remake { at, picture, notes }]
        } else {
            let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
            let is_taken = |name: &str| self.project.authored.iter().any(|texture| texture.name == name);
            vec![Edit::Author(AuthoredTexture {
                color: next_color(&panel),
                at: guess.at(),
                picture: Some(Arc::clone(&guess.picture)),
                notes: guess.notes(),
                blend: self.project.texture().blend.clone(),
                ..AuthoredTexture::new(0, &free_name(&guess.name, is_taken))
            })]
        };
        self.gesture.begin_another();
        for edit in edits {
            self.carry_out(Command::Edit(edit), ctx);
        }
        self.prompts.keep(guess, self.project.texture().key);
    }
}
