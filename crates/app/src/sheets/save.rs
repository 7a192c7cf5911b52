//! Sheet that saves a library, figure, stroke, signal, texture or project. It asks before it replaces a file, and warns
//! about textures that must not be redistributed.

mod content;
mod signal_ui;

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::text::{CCursor, CCursorRange};
use egui::{Button, Color32, Context, Id, Key, Label, Response, RichText, TextEdit, Ui};
use shagreen_core::units::Contact;
use shagreen_formats::library::{Library, Provenance};
use shagreen_formats::project::{EXTENSION, Project, ProjectLibrary};

use crate::browse::{Asked, BROWSE_WIDTH, Browse};
use crate::command::{Command, FileCommand};
use crate::look::sheet_frame::{is_left, sheet};
use crate::look::theme::{GAP, Tokens, tokens};
use crate::sheets::save::content::{Content, Outcome, write};
use crate::sheets::save::signal_ui::options_ui;
use crate::state::background::in_background;
use crate::state::document::CREATED_BY;
use crate::strings::{build, document, import as strings, signal, stroke};

use crate::state::figure_file::FigureFile;
use crate::state::signal_export::SignalExport;
use crate::state::signal_file::Sounding;
use crate::state::stroke_file::StrokeFile;
use crate::state::texture_file::TextureFile;

/// State of the open sheet.
pub struct SaveSheet {
    subject: Subject,
    path: String,
    state: State,
    is_focused: bool,
    /// Path that the project may now be written to.
    granted: Option<PathBuf>,
    browse: Browse,
}

#[derive(Default)]
enum State {
    #[default]
    Asking,
    /// There is already a file at this path.
    Exists(String),
    Saving(Receiver<Outcome>),
    /// The document writes the project, then closes the sheet.
    Granted,
    Saved(String),
    Failed(String),
}

/// What the sheet saves.
enum Subject {
    Library,
    Figure(FigureFile),
    Stroke(StrokeFile),
    Signal(Box<SignalExport>),
    Texture(TextureFile),
    Project(Box<Project>),
}

impl SaveSheet {
    /// Sheet that saves a signal, by default at `path`.
    pub fn signal(signal: SignalExport, path: &Path) -> Self {
        Self::of(Subject::Signal(Box::new(signal)), path.display().to_string())
    }

    /// Sheet that exports a texture, by default to `path`.
    pub fn texture(texture: TextureFile, path: &Path) -> Self {
        Self::of(Subject::Texture(texture), path.display().to_string())
    }

    /// Sheet that saves the library.
    pub fn library() -> Self {
        Self::of(Subject::Library, String::new())
    }

    /// Sheet that saves a figure, by default in `folder`.
    pub fn figure(figure: FigureFile, folder: &Path) -> Self {
        let path = folder.join(figure.file_name()).display().to_string();
        Self::of(Subject::Figure(figure), path)
    }

    /// Sheet that saves a stroke, by default at `path`.
    pub fn stroke(stroke: StrokeFile, path: &Path) -> Self {
        Self::of(Subject::Stroke(stroke), path.display().to_string())
    }

    /// Sheet that saves a project, by default at `path`.
    pub fn project(project: &Project, path: &Path) -> Self {
        Self::of(Subject::Project(Box::new(project.clone())), path.display().to_string())
    }

    fn of(subject: Subject, path: String) -> Self {
        Self {
            subject,
            path,
            state: State::default(),
            is_focused: false,
            granted: None,
            browse: Browse::default(),
        }
    }

    /// Folder in which a figure, stroke, signal or texture was saved.
    pub fn folder_of_export(&self) -> Option<&Path> {
        let State::Saved(path) = &self.state else { return None };
        let is_export = !matches!(self.subject, Subject::Library | Subject::Project(_));
        is_export.then(|| Path::new(path).parent())?
    }

    /// Whether the sheet saves the project.
    pub fn is_of_project(&self) -> bool {
        matches!(self.subject, Subject::Project(_))
    }

    /// Shows why the project could not be saved.
    pub fn say(&mut self, reason: String) {
        (self.state, self.is_focused) = (State::Failed(reason), false);
    }

    /// Whether a file is being saved: the sheet stays until the outcome has been shown.
    pub fn is_saving(&self) -> bool {
        matches!(self.state, State::Saving(_) | State::Granted)
    }

    /// Draws the sheet; returns the requested commands.
    pub fn show(&mut self, ctx: &Context, library: &Library) -> Vec<Command> {
        self.collect();
        let shown = sheet(ctx, "save sheet", |ui| {
            ui.set_width(520.0);
            self.content_ui(ui, library)
        });
        let mut commands = shown.inner;
        commands.extend(self.granted.take().map(|path| Command::File(FileCommand::SaveTo(path))));
        let is_done = matches!(self.state, State::Saved(_)) && ctx.input(|i| i.key_pressed(Key::Enter));
        let is_left = is_left(ctx) || is_done;
        if is_left && !self.is_saving() {
            commands.push(Command::CloseSheet);
        }
        commands
    }

    fn content_ui(&mut self, ui: &mut Ui, library: &Library) -> Vec<Command> {
        let t = tokens(ui.ctx());
        let mut commands = Vec::new();
        let (title, field_name, hint) = match &self.subject {
            Subject::Library => (strings::SAVE_TITLE, strings::SAVE_PATH, strings::SAVE_HINT),
            Subject::Figure(_) => (build::SAVE_TITLE, build::SAVE_PATH, build::SAVE_HINT),
            Subject::Stroke(_) => (stroke::SAVE_TITLE, stroke::SAVE_PATH, stroke::SAVE_HINT),
            Subject::Signal(_) => (signal::SAVE_TITLE, signal::SAVE_PATH, signal::SAVE_HINT),
            Subject::Texture(_) => {
                (signal::SAVE_TEXTURE_TITLE, signal::SAVE_TEXTURE_PATH, signal::SAVE_TEXTURE_HINT)
            }
            Subject::Project(_) => (document::SAVE_TITLE, document::SAVE_PATH, document::SAVE_HINT),
        };
        ui.add(Label::new(RichText::new(title).heading().strong()).selectable(false));
        ui.add_space(GAP);
        let is_saving = self.is_saving();
        let field = self.path_ui(ui, title, field_name, hint);
        if field.changed() {
            self.state = State::Asking;
        }
        if let Subject::Signal(export) = &mut self.subject {
            let changed = ui.add_enabled_ui(!is_saving, |ui| options_ui(ui, export)).inner;
            if changed {
                self.state = State::Asking;
            }
        }
        // A figure contains names and numbers of textures, but no texture.
        let restricted: Vec<&str> = match &self.subject {
            Subject::Library => library.restricted().map(|entry| entry.name.as_str()).collect(),
            Subject::Project(project) => project.restricted().map(|entry| entry.name.as_str()).collect(),
            Subject::Signal(export) => export.restricted(),
            Subject::Texture(texture) => texture.restricted().into_iter().collect(),
            Subject::Figure(_) | Subject::Stroke(_) => Vec::new(),
        };
        if let Some(warning) = Provenance::warning(&restricted) {
            ui.add(Label::new(RichText::new(warning).color(t.warning)).wrap());
        }
        let (text, color) = self.message(library, t);
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

    /// Draws the path field, with the button for the dialog of the system.
    fn path_ui(&mut self, ui: &mut Ui, title: &str, field_name: &str, hint: &str) -> Response {
        // The path must not change while saving, because the outcome refers to it.
        let is_saving = self.is_saving();
        let field = ui.horizontal(|ui| {
            let field = TextEdit::singleline(&mut self.path).hint_text(hint);
            let field = field.desired_width(ui.available_width() - BROWSE_WIDTH);
            let field = ui.add_enabled(!is_saving, field).accessible_name(field_name);
            let present = self.subject.completed(self.path.trim());
            let name = present.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let asked = Asked {
                title,
                kind: title,
                endings: &[self.subject.ending()],
                folder: present.parent(),
                name: Some(&name),
                ..Asked::default()
            };
            let chosen = ui.add_enabled_ui(!is_saving, |ui| self.browse.show(ui, field_name, &asked)).inner;
            if let Some(chosen) = chosen.into_iter().next().filter(|_| !is_saving) {
                // The dialog has asked before it gave the name of an existing file, and asks better.
                self.path = chosen.display().to_string();
                // For several files the dialog has asked about one only.
                let is_one = !matches!(&self.subject, Subject::Signal(export) if export.is_all);
                self.state =
                    if chosen.exists() && is_one { State::Exists(self.path.clone()) } else { State::Asking };
            }
            field
        });
        let field = field.inner;
        if !is_saving && !std::mem::replace(&mut self.is_focused, true) {
            field.request_focus();
            select_name(ui.ctx(), field.id, &self.path);
        }
        field
    }

    /// What would happen, or has happened.
    fn message(&self, library: &Library, t: &Tokens) -> (String, Color32) {
        match &self.state {
            State::Asking => match &self.subject {
                Subject::Library => (strings::to_save(library.textures.len()), t.text_weak),
                Subject::Figure(figure) => {
                    (build::to_save(&figure.title(), figure.format.word()), t.text_weak)
                }
                Subject::Stroke(file) => (stroke::to_save(file.secs()), t.text_weak),
                Subject::Signal(export) => {
                    let (file, options) = (&export.file, &export.options);
                    let Contact { speed, force } = file.contact;
                    let steady = (!options.follows_stroke).then_some((speed.mm_per_s(), force.0));
                    let text = match &file.sounding {
                        Sounding::Bench(of) => signal::bench_to_save(&of.name, of.seconds()),
                        Sounding::Mix(..) | Sounding::Path(_) => {
                            signal::to_save(file.seconds(options), steady)
                        }
                    };
                    (text, t.text_weak)
                }
                Subject::Texture(texture) => {
                    let (name, format) = (&texture.entry.name, texture.format.name());
                    (signal::texture_to_save(name, format, &texture.lost()), t.text_weak)
                }
                Subject::Project(project) => {
                    let is_inside = matches!(project.library, ProjectLibrary::Inside(_));
                    (document::to_save(project.authored.len(), is_inside), t.text_weak)
                }
            },
            State::Exists(_) => match &self.subject {
                Subject::Library => (strings::EXISTS.to_owned(), t.warning),
                Subject::Figure(figure) => (build::exists(figure.format.word()), t.warning),
                Subject::Stroke(_) => (stroke::EXISTS.to_owned(), t.warning),
                Subject::Signal(_) => (signal::EXISTS.to_owned(), t.warning),
                Subject::Texture(texture) => (signal::texture_exists(texture.format.name()), t.warning),
                Subject::Project(_) => (document::EXISTS.to_owned(), t.warning),
            },
            State::Saving(_) | State::Granted => (strings::SAVING.to_owned(), t.text_weak),
            State::Saved(path) => (strings::saved(path), t.accent),
            State::Failed(reason) => (reason.clone(), t.error),
        }
    }

    /// Saves in the background. An existing file is replaced only with `replaces`.
    fn save(&mut self, path: &str, library: &Library, replaces: bool, ctx: &Context) {
        let content = match &self.subject {
            Subject::Library => {
                Content::Library(Box::new(Library { created_by: CREATED_BY.to_owned(), ..library.clone() }))
            }
            Subject::Figure(figure) => Content::Figure(figure.clone()),
            Subject::Stroke(file) => Content::Stroke(file.clone()),
            Subject::Signal(file) => Content::Signal(file.clone()),
            Subject::Texture(texture) => Content::Texture(texture.clone()),
            Subject::Project(_) => Content::Project,
        };
        let path = self.subject.completed(path);
        self.path = path.display().to_string();
        self.state = State::Saving(in_background(ctx.clone(), move || write(&path, &content, replaces)));
    }

    fn collect(&mut self) {
        let State::Saving(receiver) = &self.state else { return };
        let path = self.path.trim().to_owned();
        self.state = match receiver.try_recv() {
            Err(TryRecvError::Empty) => return,
            Err(TryRecvError::Disconnected) => State::Failed(strings::SAVE_BROKEN.to_owned()),
            Ok(Outcome::Saved) => State::Saved(path),
            Ok(Outcome::MayBeWritten) => {
                self.granted = Some(PathBuf::from(path));
                State::Granted
            }
            Ok(Outcome::Exists) => State::Exists(path),
            Ok(Outcome::Failed(reason)) => State::Failed(reason),
        };
        // A disabled field has lost the keyboard focus.
        self.is_focused = false;
    }
}

impl Subject {
    /// Usual ending of the file's name.
    fn ending(&self) -> &'static str {
        match self {
            Self::Library => "json",
            Self::Figure(figure) => figure.format.ending(),
            Self::Stroke(_) => "csv",
            Self::Signal(_) => "wav",
            Self::Texture(texture) => texture.format.ending(),
            Self::Project(_) => EXTENSION,
        }
    }

    /// Absolute path to write to. `~/` is replaced by the home folder, and a missing file name ending is added.
    fn completed(&self, path: &str) -> PathBuf {
        let path = match path.strip_prefix("~/").zip(std::env::home_dir()) {
            Some((rest, home)) => home.join(rest),
            None => PathBuf::from(path),
        };
        let ending = self.ending();
        let path =
            if path.extension().is_none() && !path.is_dir() { path.with_extension(ending) } else { path };
        std::path::absolute(&path).unwrap_or(path)
    }
}

/// Selects the file name in the path field, so that typing another name replaces it.
fn select_name(ctx: &Context, field: Id, path: &str) {
    let is_parting = |c: char| c == '/' || c == std::path::MAIN_SEPARATOR;
    let begin = path.rfind(is_parting).map_or(0, |at| path[..=at].chars().count());
    let length = Path::new(path).file_stem().map_or(0, |stem| stem.to_string_lossy().chars().count());
    let mut state = TextEdit::load_state(ctx, field).unwrap_or_default();
    let ends = CCursorRange::two(CCursor::new(begin), CCursor::new(begin + length));
    state.cursor.set_char_range(Some(ends));
    state.store(ctx, field);
}

#[cfg(test)]
mod tests {
    use super::Subject;

    #[test]
    fn a_path_is_completed() {
        let folder = tempfile::tempdir().unwrap();
        let completed =
            |name: &str| Subject::Library.completed(&folder.path().join(name).display().to_string());
        assert_eq!(completed("mine"), folder.path().join("mine.json"));
        assert_eq!(completed("mine.txt"), folder.path().join("mine.txt"));
        assert_eq!(completed(""), folder.path().join(""), "a folder stays one, and is refused");
        assert!(Subject::Library.completed("mine").is_absolute());
        let at_home = Subject::Library.completed("~/mine");
        assert!(
            at_home.is_absolute()
                && at_home.ends_with("mine.json")
                && !at_home.display().to_string().contains('~')
        );
    }
}
