//! Saving the library, a figure, a stroke or the project: a path, a word before a file is replaced, and a warning about textures
//! that may not be passed on.

mod figure_file;
mod signal_file;
mod stroke_file;

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::text::{CCursor, CCursorRange};
use egui::{Button, Context, Id, Key, Label, RichText, TextEdit, Ui};
use shagreen_core::units::Contact;
use shagreen_formats::atomic;
use shagreen_formats::library::{Library, LibraryError, Provenance, read_library, write_library};
use shagreen_formats::project::{EXTENSION, Project, ProjectError, ProjectLibrary, read_project};

use crate::background::in_background;
use crate::command::{Command, FileCommand};
use crate::document::CREATED_BY;
use crate::sheet_frame::{is_left, sheet};
use crate::strings::{build, document, import as strings, signal, stroke};
use crate::theme::{GAP, tokens};

pub use crate::save::figure_file::{FigureFile, FigureFormat};
pub use crate::save::signal_file::{SIGNAL_RATE_HZ, SIGNAL_SECS, SIGNAL_SEED, SignalFile, Sounding};
pub use crate::save::stroke_file::StrokeFile;

/// The sheet, as long as it is open.
pub struct SaveSheet {
    subject: Subject,
    path: String,
    state: State,
    is_focused: bool,
    /// Where a project may be written now.
    granted: Option<PathBuf>,
}

#[derive(Default)]
enum State {
    #[default]
    Asking,
    /// There is a file at this path.
    Exists(String),
    Saving(Receiver<Outcome>),
    /// The document writes the project, and closes the sheet when that is done.
    Granted,
    Saved(String),
    Failed(String),
}

/// What came of saving.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Outcome {
    Saved,
    /// Nothing stands in the way of the project.
    MayBeWritten,
    Exists,
    Failed(String),
}

/// What is saved.
enum Subject {
    Library,
    Figure(FigureFile),
    Stroke(StrokeFile),
    Signal(Box<SignalFile>),
    Project(Box<Project>),
}

/// What goes into the file.
enum Content {
    Library(Box<Library>),
    Figure(FigureFile),
    Stroke(StrokeFile),
    Signal(Box<SignalFile>),
    /// It is written by its document once it may be.
    Project,
}

impl SaveSheet {
    /// A sheet that saves a signal, at `path` unless another is chosen.
    pub fn signal(signal: SignalFile, path: &Path) -> Self {
        Self::of(Subject::Signal(Box::new(signal)), path.display().to_string())
    }

    /// A sheet that saves the library.
    pub fn library() -> Self {
        Self::of(Subject::Library, String::new())
    }

    /// A sheet that saves a figure, in `folder` unless another path is chosen.
    pub fn figure(figure: FigureFile, folder: &Path) -> Self {
        let path = folder.join(figure.file_name()).display().to_string();
        Self::of(Subject::Figure(figure), path)
    }

    /// A sheet that saves a stroke, at `path` unless another is chosen.
    pub fn stroke(stroke: StrokeFile, path: &Path) -> Self {
        Self::of(Subject::Stroke(stroke), path.display().to_string())
    }

    /// A sheet that asks where to save a project, `path` unless another is chosen.
    pub fn project(project: &Project, path: &Path) -> Self {
        Self::of(Subject::Project(Box::new(project.clone())), path.display().to_string())
    }

    fn of(subject: Subject, path: String) -> Self {
        Self { subject, path, state: State::default(), is_focused: false, granted: None }
    }

    /// The folder that a figure, a stroke or a signal was saved in.
    pub fn folder_of_export(&self) -> Option<&Path> {
        let State::Saved(path) = &self.state else { return None };
        let is_export = !matches!(self.subject, Subject::Library | Subject::Project(_));
        is_export.then(|| Path::new(path).parent())?
    }

    /// Whether it is the project that is saved.
    pub fn is_of_project(&self) -> bool {
        matches!(self.subject, Subject::Project(_))
    }

    /// Says why the project could not be saved.
    pub fn say(&mut self, reason: String) {
        (self.state, self.is_focused) = (State::Failed(reason), false);
    }

    /// Whether the file is on its way: the sheet stays until its outcome has been shown.
    pub fn is_saving(&self) -> bool {
        matches!(self.state, State::Saving(_) | State::Granted)
    }

    /// Draws the sheet over the window and returns what the user asked of it.
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
            Subject::Project(_) => (document::SAVE_TITLE, document::SAVE_PATH, document::SAVE_HINT),
        };
        ui.add(Label::new(RichText::new(title).heading().strong()).selectable(false));
        ui.add_space(GAP);
        // What is being saved is what the outcome is told of.
        let is_saving = self.is_saving();
        let field = TextEdit::singleline(&mut self.path).hint_text(hint).desired_width(f32::INFINITY);
        let field = ui.add_enabled(!is_saving, field).accessible_name(field_name);
        if !is_saving && !std::mem::replace(&mut self.is_focused, true) {
            field.request_focus();
            select_name(ui.ctx(), field.id, &self.path);
        }
        if field.changed() {
            self.state = State::Asking;
        }
        // A figure holds names and numbers of textures, but none of them.
        let restricted: Vec<&str> = match &self.subject {
            Subject::Library => library.restricted().map(|entry| entry.name.as_str()).collect(),
            Subject::Project(project) => project.restricted().map(|entry| entry.name.as_str()).collect(),
            Subject::Signal(file) => file.restricted.iter().map(String::as_str).collect(),
            Subject::Figure(_) | Subject::Stroke(_) => Vec::new(),
        };
        if let Some(warning) = Provenance::warning(&restricted) {
            ui.add(Label::new(RichText::new(warning).color(t.warning)).wrap());
        }
        let (text, color) = match &self.state {
            State::Asking => match &self.subject {
                Subject::Library => (strings::to_save(library.textures.len()), t.text_weak),
                Subject::Figure(figure) => {
                    (build::to_save(&figure.title(), figure.format.word()), t.text_weak)
                }
                Subject::Stroke(file) => (stroke::to_save(file.secs()), t.text_weak),
                Subject::Signal(file) => {
                    let Contact { speed, force } = file.contact;
                    let text = match &file.sounding {
                        Sounding::Bench(of) => signal::bench_to_save(&of.name, of.seconds(), SIGNAL_RATE_HZ),
                        Sounding::Mix(..) | Sounding::Path(_) => {
                            signal::to_save(SIGNAL_SECS, speed.mm_per_s(), force.0, SIGNAL_RATE_HZ)
                        }
                    };
                    (text, t.text_weak)
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
                Subject::Project(_) => (document::EXISTS.to_owned(), t.warning),
            },
            State::Saving(_) | State::Granted => (strings::SAVING.to_owned(), t.text_weak),
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
        let content = match &self.subject {
            Subject::Library => {
                Content::Library(Box::new(Library { created_by: CREATED_BY.to_owned(), ..library.clone() }))
            }
            Subject::Figure(figure) => Content::Figure(figure.clone()),
            Subject::Stroke(file) => Content::Stroke(file.clone()),
            Subject::Signal(file) => Content::Signal(file.clone()),
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
        // A field that was disabled has lost the keyboard.
        self.is_focused = false;
    }
}

impl Subject {
    /// The path as it is written to: told from every folder alike, with the home folder where it begins with one, and with
    /// the ending of such files where it has none.
    fn completed(&self, path: &str) -> PathBuf {
        let path = match path.strip_prefix("~/").zip(std::env::home_dir()) {
            Some((rest, home)) => home.join(rest),
            None => PathBuf::from(path),
        };
        let ending = match self {
            Self::Library => "json",
            Self::Figure(figure) => figure.format.ending(),
            Self::Stroke(_) => "csv",
            Self::Signal(_) => "wav",
            Self::Project(_) => EXTENSION,
        };
        let path =
            if path.extension().is_none() && !path.is_dir() { path.with_extension(ending) } else { path };
        std::path::absolute(&path).unwrap_or(path)
    }
}

/// Selects the name of the file in the field of its path, as who saves another one writes over it.
fn select_name(ctx: &Context, field: Id, path: &str) {
    let is_parting = |c: char| c == '/' || c == std::path::MAIN_SEPARATOR;
    let begin = path.rfind(is_parting).map_or(0, |at| path[..=at].chars().count());
    let length = Path::new(path).file_stem().map_or(0, |stem| stem.to_string_lossy().chars().count());
    let mut state = TextEdit::load_state(ctx, field).unwrap_or_default();
    let ends = CCursorRange::two(CCursor::new(begin), CCursor::new(begin + length));
    state.cursor.set_char_range(Some(ends));
    state.store(ctx, field);
}

impl Content {
    /// Writes it to `path`; a project is left to its document.
    fn put(&self, path: &Path) -> Result<Outcome, String> {
        let bytes = match self {
            Self::Library(library) => write_library(library),
            Self::Figure(figure) => figure.bytes()?,
            Self::Stroke(file) => file.bytes(),
            Self::Signal(file) => return file.write(path).map(|()| Outcome::Saved),
            Self::Project => return Ok(Outcome::MayBeWritten),
        };
        atomic::write(path, &bytes).map(|()| Outcome::Saved).map_err(|error| error.to_string())
    }

    /// Why a file of these bytes must not be replaced by this; `None` where it is of the same kind, of whatever version
    /// and with whatever mistakes in it.
    fn refusal(&self, path: &Path, bytes: &[u8]) -> Option<String> {
        match self {
            Self::Library(_) => match read_library(bytes) {
                Err(error @ (LibraryError::Format { .. } | LibraryError::Damaged { texture: None, .. })) => {
                    Some(strings::no_library(&error.to_string()))
                }
                _ => None,
            },
            Self::Figure(figure) => (!figure.is_like(bytes)).then(|| build::no_figure(figure.format.word())),
            Self::Stroke(_) => (!StrokeFile::is_like(bytes)).then(|| stroke::NO_STROKE.to_owned()),
            Self::Signal(_) => (!SignalFile::may_replace(path, bytes)).then(|| signal::NO_SIGNAL.to_owned()),
            Self::Project => is_project(bytes).err().map(|reason| document::no_project(&reason)),
        }
    }
}

fn write(path: &Path, content: &Content, replaces: bool) -> Outcome {
    if path.symlink_metadata().is_ok() {
        // What is there may be another file than it was when the user was asked.
        match refusal(path, content) {
            Some(reason) => return Outcome::Failed(reason),
            None if !replaces => return Outcome::Exists,
            None => {}
        }
    }
    content.put(path).unwrap_or_else(Outcome::Failed)
}

/// Whether bytes are a project, of whatever version and with whatever mistakes in it.
fn is_project(bytes: &[u8]) -> Result<(), String> {
    let nothing = |_: &Path| Err(std::io::ErrorKind::NotFound.into());
    match read_project(bytes, Path::new(""), &nothing) {
        Err(error @ (ProjectError::Format { .. } | ProjectError::Damaged { .. })) => Err(error.to_string()),
        _ => Ok(()),
    }
}

/// Why what is at this path must not be replaced.
fn refusal(path: &Path, content: &Content) -> Option<String> {
    let bytes = match path.metadata() {
        // A pipe or device would be read for ever.
        Ok(metadata) if !metadata.is_file() => return Some(document::NO_FILE.to_owned()),
        Ok(_) => std::fs::read(path),
        Err(error) => Err(error),
    };
    match bytes {
        Err(error) => Some(strings::cannot_be_checked(&error.to_string())),
        Ok(bytes) => content.refusal(path, &bytes),
    }
}

#[cfg(test)]
mod tests {
    use super::{Content, Outcome, Subject, write};
    use shagreen_formats::library::{Library, read_library};

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

    #[test]
    fn only_a_library_is_replaced_and_only_when_that_was_said() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.json");
        let library =
            |name: &str| Content::Library(Box::new(Library { name: name.to_owned(), ..Library::default() }));
        let name = || read_library(&std::fs::read(&path).unwrap()).unwrap().value.name;
        assert_eq!(write(&path, &library("one"), false), Outcome::Saved);
        assert_eq!(write(&path, &library("two"), false), Outcome::Exists);
        assert_eq!(name(), "one");
        assert_eq!(write(&path, &library("two"), true), Outcome::Saved);
        assert_eq!(name(), "two");
        assert!(
            matches!(write(&path, &Content::Project, true), Outcome::Failed(_)),
            "a library is no project"
        );
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
