//! Saving the library: a path, a word before a file is replaced, and a warning about textures that may not be passed on.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use egui::{Button, Context, Key, Label, Modal, RichText, TextEdit, Ui};
use shagreen_formats::atomic;
use shagreen_formats::library::{Library, Provenance, write_library};

use crate::command::Command;
use crate::strings::import as strings;
use crate::theme::{GAP, tokens};

/// The sheet, as long as it is open.
#[derive(Default)]
pub struct SaveSheet {
    path: String,
    state: State,
    is_focused: bool,
}

#[derive(Default)]
enum State {
    #[default]
    Asking,
    /// There is a file at this path.
    Exists(String),
    Saving(Receiver<Outcome>),
    Saved(String),
    Failed(String),
}

/// What came of saving.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Outcome {
    Saved,
    Exists,
    Failed(String),
}

impl SaveSheet {
    /// Draws the sheet over the window and returns what the user asked of it.
    pub fn show(&mut self, ctx: &Context, library: &Library) -> Vec<Command> {
        self.collect();
        let t = tokens(ctx);
        let frame = egui::Frame::popup(&ctx.global_style()).fill(t.panel).inner_margin(14.0);
        let shown = Modal::new(egui::Id::unique("save sheet")).frame(frame).show(ctx, |ui| {
            ui.set_width(520.0);
            self.content_ui(ui, library)
        });
        let mut commands = shown.inner;
        if ctx.input_mut(|i| i.consume_key(egui::Modifiers::NONE, Key::Escape)) {
            commands.push(Command::CloseSheet);
        }
        commands
    }

    fn content_ui(&mut self, ui: &mut Ui, library: &Library) -> Vec<Command> {
        let t = tokens(ui.ctx());
        let mut commands = Vec::new();
        ui.add(Label::new(RichText::new(strings::SAVE_TITLE).heading().strong()).selectable(false));
        ui.add_space(GAP);
        let field =
            TextEdit::singleline(&mut self.path).hint_text(strings::SAVE_HINT).desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name(strings::SAVE_PATH);
        if !std::mem::replace(&mut self.is_focused, true) {
            field.request_focus();
        }
        if field.changed() {
            self.state = State::Asking;
        }
        let restricted: Vec<&str> = library.restricted().map(|entry| entry.name.as_str()).collect();
        if let Some(warning) = Provenance::warning(&restricted) {
            ui.add(Label::new(RichText::new(warning).color(t.warning)).wrap());
        }
        let (text, color) = match &self.state {
            State::Asking => (strings::to_save(library.textures.len()), t.text_weak),
            State::Exists(_) => (strings::EXISTS.to_owned(), t.warning),
            State::Saving(_) => (strings::SAVING.to_owned(), t.text_weak),
            State::Saved(path) => (strings::saved(path), t.accent),
            State::Failed(reason) => (reason.clone(), t.error),
        };
        ui.add(Label::new(RichText::new(text).color(color)).wrap());
        ui.add_space(GAP);
        ui.horizontal(|ui| {
            let path = self.path.trim().to_owned();
            let replaces = matches!(&self.state, State::Exists(exists) if *exists == path);
            let can_save = !path.is_empty() && !matches!(self.state, State::Saving(_) | State::Saved(_));
            let save = Button::new(if replaces { strings::REPLACE } else { strings::SAVE });
            let is_entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter)) && !replaces;
            if ui.add_enabled(can_save, save).clicked() || (can_save && is_entered) {
                self.save(&path, library, replaces, ui.ctx());
            }
            let is_saved = matches!(self.state, State::Saved(_));
            if ui.button(if is_saved { strings::CLOSE } else { strings::CANCEL }).clicked() {
                commands.push(Command::CloseSheet);
            }
        });
        commands
    }

    /// Writes in a thread of its own, and not over a file that is there unless `replaces`.
    fn save(&mut self, path: &str, library: &Library, replaces: bool, ctx: &Context) {
        let (sender, receiver) = channel();
        let library = Library {
            created_by: concat!("Shagreen ", env!("CARGO_PKG_VERSION")).to_owned(),
            ..library.clone()
        };
        let (path, ctx) = (PathBuf::from(path), ctx.clone());
        std::thread::spawn(move || {
            // The sheet may have been closed meanwhile: then nobody asks any more.
            let _ = sender.send(write(&path, &library, replaces));
            ctx.request_repaint();
        });
        self.state = State::Saving(receiver);
    }

    fn collect(&mut self) {
        let State::Saving(receiver) = &self.state else { return };
        let path = self.path.trim().to_owned();
        self.state = match receiver.try_recv() {
            Err(TryRecvError::Empty) => return,
            Err(TryRecvError::Disconnected) => State::Failed(strings::SAVE_BROKEN.to_owned()),
            Ok(Outcome::Saved) => State::Saved(path),
            Ok(Outcome::Exists) => State::Exists(path),
            Ok(Outcome::Failed(reason)) => State::Failed(reason),
        };
    }
}

fn write(path: &Path, library: &Library, replaces: bool) -> Outcome {
    if !replaces && path.symlink_metadata().is_ok() {
        return Outcome::Exists;
    }
    match atomic::write(path, &write_library(library)) {
        Ok(()) => Outcome::Saved,
        Err(error) => Outcome::Failed(error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::{Outcome, write};
    use shagreen_formats::library::{Library, read_library};

    #[test]
    fn a_file_is_replaced_only_when_that_was_said() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.json");
        let library = |name: &str| Library { name: name.to_owned(), ..Library::default() };
        let name = || read_library(&std::fs::read(&path).unwrap()).unwrap().value.name;
        assert_eq!(write(&path, &library("one"), false), Outcome::Saved);
        assert_eq!(write(&path, &library("two"), false), Outcome::Exists);
        assert_eq!(name(), "one");
        assert_eq!(write(&path, &library("two"), true), Outcome::Saved);
        assert_eq!(name(), "two");
        let nowhere = folder.path().join("no/such/folder.json");
        assert!(matches!(write(&nowhere, &library("three"), true), Outcome::Failed(_)));
    }
}
