//! Execution of commands about the clipboard.

use egui::{Context, ViewportCommand};
use shagreen_formats::project::AuthoredTexture;
use shagreen_formats::project::clipboard::{read_copied_texture, write_copied_texture};

use super::Window;
use crate::author::new_texture::next_color;
use crate::command::Command;
use crate::command::clipboard::ClipboardCommand;
use crate::look::notice::show_notice;
use crate::panel::Panel;
use crate::state::clipboard::{copied, pasted};
use crate::state::edit::Edit;
use crate::strings::clipboard as strings;
use crate::workspace::Workspace;

impl Window {
    pub(super) fn carry_out_clipboard(&mut self, command: ClipboardCommand, ctx: &Context) {
        // What is copied, deleted or added must be visible.
        if self.pages.workspace != Workspace::Author {
            self.carry_out(Command::Show(Workspace::Author), ctx);
        }
        match command {
            ClipboardCommand::Copy(key) => {
                if let Some((_, name)) = self.copy_authored(key, ctx) {
                    show_notice(ctx, strings::copied(&name));
                }
            }
            ClipboardCommand::Cut(key) => match self.copy_authored(key, ctx) {
                Some((key, _)) if self.project.authored.len() > 1 => {
                    self.carry_out(Command::Edit(Edit::Remove(key)), ctx);
                }
                Some(_) => self.session.say(strings::CANNOT_CUT.to_owned()),
                None => {}
            },
            ClipboardCommand::Paste => {
                // A text field with the keyboard focus would take the text.
                ctx.memory_mut(egui::Memory::stop_text_input);
                ctx.send_viewport_cmd(ViewportCommand::RequestPaste);
            }
            ClipboardCommand::Read(text) => self.paste_authored(&text, ctx),
        }
    }

    /// Copies an authored texture, by its key, or the one that is shown. Returns its key and name.
    fn copy_authored(&self, key: Option<u32>, ctx: &Context) -> Option<(u32, String)> {
        // During a comparison, the texture that the inspector shows.
        let shown = self.compare.heard_key().filter(|_| !self.compare.is_hidden());
        let key = key.or(shown).unwrap_or(self.project.texture().key);
        let texture = self.project.authored.iter().find(|texture| texture.key == key)?;
        let copied = copied(texture, &self.project, self.session.library(), self.session.axes());
        ctx.copy_text(write_copied_texture(&copied));
        Some((key, texture.name.clone()))
    }

    /// Adds the authored texture that a text describes, as one step.
    fn paste_authored(&mut self, text: &str, ctx: &Context) {
        let copied = match read_copied_texture(text) {
            Ok(copied) => copied,
            Err(error) => {
                self.session.say(error.to_string());
                return;
            }
        };
        let session = &self.session;
        let positions = session.common_positions();
        let pasted = pasted(copied, &self.project, session.library(), session.axes(), &positions);
        let is_used = |color: u8| self.project.authored.iter().any(|texture| texture.color == color);
        let color = if is_used(pasted.texture.color) {
            next_color(&Panel::new(&self.project, &self.session, &self.compare, &self.pictures))
        } else {
            pasted.texture.color
        };
        let said = strings::pasted(&pasted.texture.name);
        // Each paste is a step of its own, even if they follow each other quickly.
        self.gesture.begin_another();
        let texture = Box::new(AuthoredTexture { color, ..pasted.texture });
        self.carry_out(Command::Edit(Edit::AuthorWith { texture, own: pasted.own }), ctx);
        if pasted.warnings.is_empty() {
            show_notice(ctx, said);
        } else {
            let mut warnings = vec![said];
            warnings.extend(pasted.warnings);
            self.say_warnings(&warnings);
        }
    }
}
