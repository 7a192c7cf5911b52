//! Saving the library: a path, a word before a file is replaced, and a warning about textures that may not be passed on.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use egui::{Button, Context, Key, Label, Modal, RichText, TextEdit, Ui};
use shagreen_formats::atomic;
use shagreen_formats::library::{Library, LibraryError, Provenance, read_library, write_library};

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
    /// Whether the file is on its way: the sheet stays until its outcome has been shown.
    pub fn is_saving(&self) -> bool {
        matches!(self.state, State::Saving(_))
    }

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
        let is_left = ctx.input_mut(|i| i.consume_key(egui::Modifiers::NONE, Key::Escape));
        if is_left && !self.is_saving() {
            commands.push(Command::CloseSheet);
        }
        commands
    }

    fn content_ui(&mut self, ui: &mut Ui, library: &Library) -> Vec<Command> {
        let t = tokens(ui.ctx());
        let mut commands = Vec::new();
        ui.add(Label::new(RichText::new(strings::SAVE_TITLE).heading().strong()).selectable(false));
        ui.add_space(GAP);
        // What is being saved is what the outcome is told of.
        let is_saving = self.is_saving();
        let field =
            TextEdit::singleline(&mut self.path).hint_text(strings::SAVE_HINT).desired_width(f32::INFINITY);
        let field = ui.add_enabled(!is_saving, field).accessible_name(strings::SAVE_PATH);
        if !is_saving && !std::mem::replace(&mut self.is_focused, true) {
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
            let can_save = !path.is_empty() && !is_saving && !matches!(self.state, State::Saved(_));
            let save = Button::new(if replaces { strings::REPLACE } else { strings::SAVE });
            let is_entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter)) && !replaces;
            if ui.add_enabled(can_save, save).clicked() || (can_save && is_entered) {
                self.save(&path, library, replaces, ui.ctx());
            }
            let is_saved = matches!(self.state, State::Saved(_));
            let close = Button::new(if is_saved { strings::CLOSE } else { strings::CANCEL });
            if ui.add_enabled(!self.is_saving(), close).clicked() {
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
            // The program may have ended meanwhile: then nobody asks any more.
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
        // A field that was disabled has lost the keyboard.
        self.is_focused = false;
    }
}

fn write(path: &Path, library: &Library, replaces: bool) -> Outcome {
    if path.symlink_metadata().is_ok() {
        // What is there may be another file than it was when the user was asked.
        match refusal(path) {
            Some(reason) => return Outcome::Failed(reason),
            None if !replaces => return Outcome::Exists,
            None => {}
        }
    }
    match atomic::write(path, &write_library(library)) {
        Ok(()) => Outcome::Saved,
        Err(error) => Outcome::Failed(error.to_string()),
    }
}

/// Why what is at this path must not be replaced; `None` where it is a library, of whatever version and with whatever
/// mistakes in it.
fn refusal(path: &Path) -> Option<String> {
    let bytes = match path.metadata() {
        // A pipe or device would be read for ever.
        Ok(metadata) if !metadata.is_file() => return Some(strings::no_library(strings::NO_FILE)),
        Ok(_) => std::fs::read(path),
        Err(error) => Err(error),
    };
    match bytes.map(|bytes| read_library(&bytes)) {
        Err(error) => Some(strings::cannot_be_checked(&error.to_string())),
        Ok(Err(error @ (LibraryError::Format { .. } | LibraryError::Damaged { texture: None, .. }))) => {
            Some(strings::no_library(&error.to_string()))
        }
        Ok(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{Outcome, write};
    use shagreen_formats::library::{Library, read_library};

    #[test]
    fn only_a_library_is_replaced_and_only_when_that_was_said() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.json");
        let library = |name: &str| Library { name: name.to_owned(), ..Library::default() };
        let name = || read_library(&std::fs::read(&path).unwrap()).unwrap().value.name;
        assert_eq!(write(&path, &library("one"), false), Outcome::Saved);
        assert_eq!(write(&path, &library("two"), false), Outcome::Exists);
        assert_eq!(name(), "one");
        assert_eq!(write(&path, &library("two"), true), Outcome::Saved);
        assert_eq!(name(), "two");
        std::fs::write(&path, "something else").unwrap();
        for replaces in [false, true] {
            assert!(matches!(write(&path, &library("three"), replaces), Outcome::Failed(_)), "{replaces}");
            assert!(matches!(write(folder.path(), &library("three"), replaces), Outcome::Failed(_)));
        }
        assert_eq!(std::fs::read(&path).unwrap(), b"something else");
        let newer = br#"{ "format": "shagreen-library", "version": "99.0" }"#;
        std::fs::write(&path, newer).unwrap();
        assert_eq!(write(&path, &library("three"), false), Outcome::Exists);
        let nowhere = folder.path().join("no/such/folder.json");
        assert!(matches!(write(&nowhere, &library("three"), true), Outcome::Failed(_)));
    }
}
