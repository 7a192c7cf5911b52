//! What came of prompts and photos.

use std::sync::Arc;

use egui::Context;
use shagreen_formats::library::free_name;
use shagreen_formats::project::AuthoredTexture;

use super::Window;
use crate::authored_panel::next_color;
use crate::command::Command;
use crate::edit::Edit;
use crate::panel::Panel;
use crate::prompt::PromptCommand;
use crate::workspace::Workspace;

impl Window {
    /// Begins what was asked for; what was described is remembered.
    pub(super) fn carry_out_prompt(&mut self, command: PromptCommand, ctx: &Context) {
        if let Some(kept) = self.prompts.carry_out(command, self.session.poles(), ctx) {
            self.files.settings.note_prompt(kept);
        }
    }

    /// What was made becomes an authored texture, or the one that it was made for anew.
    pub(super) fn collect_prompt(&mut self, ctx: &Context) {
        let arrived = match self.prompts.collect() {
            Some(Ok(arrived)) => arrived,
            Some(Err(reason)) => return self.session.say(reason),
            None => return,
        };
        let guess = arrived.guess;
        let is_there = |key: &u32| self.project.authored.iter().any(|texture| texture.key == *key);
        let edits = if let Some(key) = arrived.replaces.filter(is_there) {
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
        self.workspace = Workspace::Author;
        for edit in edits {
            self.carry_out(Command::Edit(edit), ctx);
        }
        self.prompts.keep(guess, self.project.texture().key);
    }
}
