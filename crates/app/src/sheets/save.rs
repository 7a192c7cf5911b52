//! Sheet that saves a library, figure, stroke, project or blank table. It asks before it replaces a file, and warns about textures that
//! must not be redistributed.

mod content;

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::{Button, Color32, Context, Key, Label, RichText, Ui};
use shagreen_formats::library::{Library, Provenance};
use shagreen_formats::project::{EXTENSION, Project, ProjectLibrary};

use crate::command::{Command, FileCommand};
use crate::look::primary::primary_ui;
use crate::look::sheet_frame::sheet;
use crate::look::theme::{GAP, Tokens, tokens};
use crate::look::together::at_right_ui;
use crate::sheets::path_field::{PathField, PathTexts, completed};
use crate::sheets::save::content::{Content, Outcome, write};
use crate::state::background::in_background;
use crate::state::blank_file::BlankFile;
use crate::state::document::CREATED_BY;
use crate::state::figure_file::FigureFile;
use crate::state::stroke_file::StrokeFile;
use crate::strings::{axes, build, document, import as strings, stroke};

/// State of the open sheet.
pub struct SaveSheet {
    subject: Subject,
    path: PathField,
    state: State,
    /// Path that the project may now be written to.
    granted: Option<PathBuf>,
}

#[derive(Default)]
enum State {
    #[default]
    Asking,
    /// There is already a file at this path.
    Exists,
    Saving(Receiver<Outcome>),
    /// The document writes the project, then closes the sheet.
    Granted,
    Saved(String),
    Failed(String),
}

/// What the sheet saves.
enum Subject {
    /// The library, with the positions that it states; `has_other_axes` if the project chooses other axes.
    Library {
        has_other_axes: bool,
    },
    Figure(FigureFile),
    Blank(BlankFile),
    Stroke(StrokeFile),
    Project(Box<Project>),
}

impl SaveSheet {
    /// Sheet that saves the library of a project.
    pub fn library(project: &Project) -> Self {
        Self::of(Subject::Library { has_other_axes: project.axes.is_some() }, String::new())
    }

    /// Sheet that saves a figure, by default in `folder`.
    pub fn figure(figure: FigureFile, folder: &Path) -> Self {
        let path = folder.join(figure.file_name()).display().to_string();
        Self::of(Subject::Figure(figure), path)
    }

    /// Sheet that saves a blank table or instructions, by default in `folder`.
    pub fn blank(file: BlankFile, folder: &Path) -> Self {
        let path = folder.join(file.file_name()).display().to_string();
        Self::of(Subject::Blank(file), path)
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
        Self { subject, path: PathField::new(path), state: State::default(), granted: None }
    }

    /// Offers folders that were used last.
    pub fn offer(&mut self, folders: Vec<PathBuf>) {
        self.path.offer(folders);
    }

    /// Folder in which a figure, stroke or blank table was saved.
    pub fn folder_of_export(&self) -> Option<&Path> {
        let State::Saved(path) = &self.state else { return None };
        let is_export = !matches!(self.subject, Subject::Library { .. } | Subject::Project(_));
        is_export.then(|| Path::new(path).parent())?
    }

    /// Whether the sheet saves the project.
    pub fn is_of_project(&self) -> bool {
        matches!(self.subject, Subject::Project(_))
    }

    /// Shows why the project could not be saved.
    pub fn say(&mut self, reason: String) {
        self.state = State::Failed(reason);
        self.path.refocus();
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
        if is_done {
            commands.push(Command::CloseSheet);
        }
        commands
    }

    fn content_ui(&mut self, ui: &mut Ui, library: &Library) -> Vec<Command> {
        let t = tokens(ui.ctx());
        let mut commands = Vec::new();
        let (title, name, hint) = match &self.subject {
            Subject::Library { .. } => (strings::SAVE_TITLE, strings::SAVE_PATH, strings::SAVE_HINT),
            Subject::Figure(_) => (build::SAVE_TITLE, build::SAVE_PATH, build::SAVE_HINT),
            Subject::Blank(_) => (build::BLANK_TITLE, build::BLANK_PATH, build::BLANK_HINT),
            Subject::Stroke(_) => (stroke::SAVE_TITLE, stroke::SAVE_PATH, stroke::SAVE_HINT),
            Subject::Project(_) => (document::SAVE_TITLE, document::SAVE_PATH, document::SAVE_HINT),
        };
        ui.add(Label::new(RichText::new(title).heading().strong()).selectable(false));
        ui.add_space(GAP);
        let is_saving = self.is_saving();
        // The path must not change while saving, because the outcome refers to it.
        let texts = PathTexts { title, name, hint, ending: self.subject.ending() };
        let input = self.path.show(ui, texts, !is_saving);
        if input.is_changed {
            let is_asked = input.is_chosen && Path::new(self.path.text()).exists();
            self.state = if is_asked { State::Exists } else { State::Asking };
        }
        // A figure contains names and numbers of textures, but no texture.
        let restricted: Vec<&str> = match &self.subject {
            Subject::Library { .. } => library.restricted().map(|entry| entry.name.as_str()).collect(),
            Subject::Project(project) => project.restricted().map(|entry| entry.name.as_str()).collect(),
            Subject::Figure(_) | Subject::Blank(_) | Subject::Stroke(_) => Vec::new(),
        };
        if let Some(warning) = Provenance::warning(&restricted) {
            ui.add(Label::new(RichText::new(warning).color(t.warning)).wrap());
        }
        let (text, color) = self.message(library, t);
        ui.add(Label::new(RichText::new(text).color(color)).wrap());
        ui.add_space(GAP);
        ui.horizontal(|ui| {
            let exists = matches!(self.state, State::Exists);
            let is_saved = matches!(self.state, State::Saved(_));
            let can_save = !self.path.text().is_empty() && !is_saving && !is_saved && !exists;
            // Not where the button before was, or a double click would replace the file.
            let replaces = exists && ui.button(strings::REPLACE).clicked();
            let save = at_right_ui(ui, |ui| {
                let save = primary_ui(ui, strings::SAVE, can_save);
                let close = Button::new(if is_saved { strings::CLOSE } else { strings::CANCEL });
                if ui.add_enabled(!is_saving, close).clicked() {
                    commands.push(Command::CloseSheet);
                }
                save
            });
            if save.clicked() || (can_save && input.is_entered) || replaces {
                self.save(library, replaces, ui.ctx());
            }
        });
        commands
    }

    /// What would happen, or has happened.
    fn message(&self, library: &Library, t: &Tokens) -> (String, Color32) {
        match &self.state {
            State::Asking => match &self.subject {
                Subject::Library { has_other_axes } => {
                    let of_axes = has_other_axes.then(|| axes::stored(&library.axis_names()));
                    let what = [Some(strings::to_save(library.textures.len())), of_axes];
                    (what.into_iter().flatten().collect::<Vec<_>>().join(" "), t.text_weak)
                }
                Subject::Figure(figure) => {
                    (build::to_save(&figure.title(), figure.format.word()), t.text_weak)
                }
                Subject::Blank(file) => (file.about().to_owned(), t.text_weak),
                Subject::Stroke(file) => (stroke::to_save(file.secs()), t.text_weak),
                Subject::Project(project) => {
                    let is_inside = matches!(project.library, ProjectLibrary::Inside(_));
                    (document::to_save(project.authored.len(), is_inside), t.text_weak)
                }
            },
            State::Exists => match &self.subject {
                Subject::Library { .. } => (strings::EXISTS.to_owned(), t.warning),
                Subject::Figure(figure) => (build::exists(figure.format.word()), t.warning),
                Subject::Blank(_) => (build::BLANK_EXISTS.to_owned(), t.warning),
                Subject::Stroke(_) => (stroke::EXISTS.to_owned(), t.warning),
                Subject::Project(_) => (document::EXISTS.to_owned(), t.warning),
            },
            State::Saving(_) | State::Granted => (strings::SAVING.to_owned(), t.text_weak),
            State::Saved(path) => (strings::saved(path), t.accent),
            State::Failed(reason) => (reason.clone(), t.error),
        }
    }

    /// Saves in the background. An existing file is replaced only with `replaces`.
    fn save(&mut self, library: &Library, replaces: bool, ctx: &Context) {
        let content = match &self.subject {
            Subject::Library { .. } => {
                Content::Library(Box::new(Library { created_by: CREATED_BY.to_owned(), ..library.clone() }))
            }
            Subject::Figure(figure) => Content::Figure(figure.clone()),
            Subject::Blank(file) => Content::Blank(file.clone()),
            Subject::Stroke(file) => Content::Stroke(file.clone()),
            Subject::Project(_) => Content::Project,
        };
        let path = completed(self.path.text(), self.subject.ending());
        self.path.set(&path);
        self.state = State::Saving(in_background(ctx.clone(), move || write(&path, &content, replaces)));
    }

    fn collect(&mut self) {
        let State::Saving(receiver) = &self.state else { return };
        let path = self.path.text().to_owned();
        self.state = match receiver.try_recv() {
            Err(TryRecvError::Empty) => return,
            Err(TryRecvError::Disconnected) => State::Failed(strings::SAVE_BROKEN.to_owned()),
            Ok(Outcome::Saved) => State::Saved(path),
            Ok(Outcome::MayBeWritten) => {
                self.granted = Some(PathBuf::from(path));
                State::Granted
            }
            Ok(Outcome::Exists) => State::Exists,
            Ok(Outcome::Failed(reason)) => State::Failed(reason),
        };
        self.path.refocus();
    }
}

impl Subject {
    /// Usual ending of the file's name.
    fn ending(&self) -> &'static str {
        match self {
            Self::Library { .. } => "json",
            Self::Figure(figure) => figure.format.ending(),
            Self::Blank(file) => file.ending(),
            Self::Stroke(_) => "csv",
            Self::Project(_) => EXTENSION,
        }
    }
}
