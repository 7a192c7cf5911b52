//! Commands about files: opening, saving and leaving projects. Unsaved changes are never discarded without asking.

use std::path::{Path, PathBuf};
use std::time::Instant;

use egui::{Context, ViewportCommand};
use shagreen_formats::imported::Imported;
use shagreen_formats::project::{EXTENSION, Project, ProjectLibrary};

use shagreen_studio::file::one_line;
use shagreen_studio::open::{LibraryOrigin, Opened, OpenedProject, open};
use shagreen_studio::permitted_libraries::Permitted;
use shagreen_studio::project::new_project;

use super::Window;
use crate::command::{Command, FileCommand};
use crate::look::notice::show_notice;
use crate::sheets::Sheet;
use crate::sheets::command_for;
use crate::sheets::folders_ui::folders_of;
use crate::sheets::gallery_sheet::GallerySheet;
use crate::sheets::open_sheet::OpenSheet;
use crate::sheets::outside_library::OutsideLibrarySheet;
use crate::sheets::save::SaveSheet;
use crate::state::document::{Came, DocumentFile};
use crate::state::edit::Edit;
use crate::state::files::Reading;
use crate::state::history::History;
use crate::state::leave::Leave;
use crate::strings;
use crate::window::file_menu::kept_inside;

impl Window {
    /// Takes in opened and saved files, and requests of the system to close the window, once a frame before drawing.
    pub(super) fn collect_files(&mut self, ctx: &Context) {
        if let Some(came) = self.files.document.collect() {
            self.take_file(came, ctx);
        }
        if let Some(message) = self.files.follow(&self.project, self.history.revision(), ctx) {
            self.session.say(message);
        }
        let wants_to_close = ctx.input(|i| i.viewport().close_requested());
        if wants_to_close && self.asks_to_leave_study(ctx) {
            return;
        }
        let would_lose = self.files.document.is_changed() || self.pages.signals.has_unsaved_painting();
        if wants_to_close && !self.files.is_closing && would_lose {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.sheet = Sheet::Leaving(Leave::Quit);
        }
    }

    pub(super) fn carry_out_file(&mut self, command: FileCommand, ctx: &Context) {
        match command {
            FileCommand::New => match self.files.settings.template.clone() {
                // The template is read before the open project is left, because that project may change in the
                // meantime.
                Some(template) => self.files.open(template, Reading::Template, ctx),
                None => self.leave(Leave::New, ctx),
            },
            FileCommand::Quit => self.leave(Leave::Quit, ctx),
            FileCommand::AskWhatToOpen => self.sheet = Sheet::Open(OpenSheet::new(&self.usual_folder(), ctx)),
            FileCommand::OpenGallery => self.sheet = Sheet::Gallery(GallerySheet::new(ctx)),
            FileCommand::BeginFromGallery(chosen) => self.leave(Leave::Gallery(chosen), ctx),
            FileCommand::Open(path) => {
                if let Some(command) = command_for(&path) {
                    self.sheet = Sheet::Closed;
                    self.carry_out(command, ctx);
                    return;
                }
                self.files.open(path, Reading::Open, ctx);
            }
            FileCommand::AnswerLibrary(answer) => self.answer_library(answer, ctx),
            // The file that is being written would count as changed by another window.
            FileCommand::Save if self.files.document.is_saving() => self.files.saves_again = true,
            FileCommand::Save => match self.files.document.path().map(Path::to_owned) {
                Some(path) => self.files.document.save(&self.project, path, ctx),
                None => self.ask_where_to_save(),
            },
            FileCommand::Reload => {
                if let Sheet::Conflict(conflict) = std::mem::take(&mut self.sheet) {
                    self.files.open(conflict.path, Reading::Reload, ctx);
                }
            }
            FileCommand::Overwrite => {
                if let Sheet::Conflict(conflict) = std::mem::take(&mut self.sheet) {
                    self.files.document.overwrite(&self.project, &conflict, ctx);
                }
            }
            FileCommand::SetTemplate(path) => self.files.settings.template = path,
            FileCommand::SaveAs => self.ask_where_to_save(),
            FileCommand::SaveTo(path) => self.files.document.save(&self.project, path, ctx),
            FileCommand::Export(format) => self.open_export(format),
            FileCommand::KeepLibraryInside => {
                if let Some(edit) = kept_inside(&self.project) {
                    self.carry_out(Command::Edit(edit), ctx);
                }
            }
            FileCommand::SaveAndLeave(leave) => {
                self.files.after_saving = Some(leave);
                self.sheet = Sheet::Closed;
                self.carry_out_file(FileCommand::Save, ctx);
            }
            FileCommand::LeaveUnsaved(leave) => {
                self.sheet = Sheet::Closed;
                self.go(leave, ctx);
            }
            FileCommand::Recover(index) => self.recover(index),
            FileCommand::Discard(index) => {
                if let Sheet::Recovered(leftovers) = &mut self.sheet {
                    leftovers.remove(index).discard();
                    if leftovers.is_empty() {
                        self.sheet = Sheet::Closed;
                    }
                }
            }
        }
    }

    fn take_file(&mut self, came: Came, ctx: &Context) {
        // The end of a save operation does not end the reading of a template.
        let is_read = matches!(came, Came::Opened(..) | Came::NotOpened(_) | Came::Outside { .. });
        let reading = if is_read { self.files.take_reading() } else { Reading::default() };
        let is_beginning = reading == Reading::Template;
        match came {
            Came::Saved(path) => {
                self.files.note_saved(&path, &self.project);
                show_notice(ctx, strings::document::SAVED.to_owned());
                if matches!(&self.sheet, Sheet::Save(sheet) if sheet.is_of_project()) {
                    self.sheet = Sheet::Closed;
                }
                if std::mem::take(&mut self.files.saves_again) {
                    self.carry_out_file(FileCommand::Save, ctx);
                }
                // If the project was changed while it was written, the user is asked again.
                if let Some(leave) = self.files.after_saving.take() {
                    self.leave(leave, ctx);
                }
            }
            Came::Conflict(conflict) => {
                (self.files.after_saving, self.files.saves_again) = (None, false);
                self.sheet = Sheet::Conflict(conflict);
            }
            Came::NotSaved(reason) => {
                (self.files.after_saving, self.files.saves_again) = (None, false);
                match &mut self.sheet {
                    Sheet::Save(sheet) if sheet.is_of_project() => sheet.say(reason),
                    _ => self.session.say(strings::document::not_saved(&reason)),
                }
            }
            Came::Opened(Opened::Project(opened), path) => {
                let is_copy = is_beginning || opened.origin == LibraryOrigin::Starter;
                self.files.waiting = Some((opened, (!is_copy).then_some(path)));
                // Kept aside only now, so that no change is lost that was made while the file was read.
                match (reading == Reading::Reload).then(|| self.files.keep_aside(&self.project)) {
                    Some(Ok(())) => self.go(Leave::Open, ctx),
                    Some(Err(reason)) => {
                        self.session.say(strings::conflict::not_kept(&reason));
                        self.leave(Leave::Open, ctx);
                    }
                    None => self.leave(Leave::Open, ctx),
                }
            }
            Came::Opened(Opened::Library(_), path) if is_beginning => {
                self.begin_as_usual(&strings::document::is_library(&path.display().to_string()), ctx);
            }
            Came::Opened(Opened::Library(imported), _) => {
                self.sheet = Sheet::Closed;
                let Imported { value, warnings } = *imported;
                self.say_warnings(&warnings);
                let library = ProjectLibrary::File(value.into());
                self.carry_out(Command::Edit(Edit::OpenLibrary(library)), ctx);
            }
            Came::Outside { project, library } => {
                self.sheet = Sheet::OutsideLibrary(OutsideLibrarySheet::new(project, library, reading));
            }
            Came::NotOpened(reason) if is_beginning => self.begin_as_usual(&reason, ctx),
            Came::NotOpened(reason) => match &mut self.sheet {
                Sheet::Open(sheet) => sheet.say(reason),
                Sheet::OutsideLibrary(sheet) => sheet.say(reason),
                _ => self.session.say(reason),
            },
        }
    }

    /// Begins a new project without the template. The template stays selected, because it may become readable again.
    fn begin_as_usual(&mut self, reason: &str, ctx: &Context) {
        self.session.say(strings::document::no_template(reason));
        self.leave(Leave::New, ctx);
    }

    /// Leaves the open project, or asks first if it has unsaved changes.
    fn leave(&mut self, leave: Leave, ctx: &Context) {
        // The project may have changed since the last frame.
        self.files.document.follow(&self.project, self.history.revision());
        let loses_painting = leave == Leave::Quit && self.pages.signals.has_unsaved_painting();
        if self.files.document.is_changed() || loses_painting {
            self.sheet = Sheet::Leaving(leave);
        } else {
            self.go(leave, ctx);
        }
    }

    fn go(&mut self, leave: Leave, ctx: &Context) {
        match leave {
            Leave::New => self.begin(new_project(), None),
            Leave::Open => {
                if let Some((opened, path)) = self.files.waiting.take() {
                    let OpenedProject { project, warnings, sha256, origin } = *opened;
                    let file = path.map(|path| DocumentFile { path, sha256: Some(sha256) });
                    match origin {
                        LibraryOrigin::Project => self.files.begin(&project, file),
                        LibraryOrigin::Chosen | LibraryOrigin::Starter => self.files.begin_unsaved(file),
                    }
                    self.show_project(project);
                    self.say_warnings(&warnings);
                }
            }
            Leave::Gallery(chosen) => match chosen.read() {
                Ok(project) => {
                    self.begin(project, None);
                    self.files.document.set_title(chosen.title);
                }
                Err(error) => self.session.say(error.to_string()),
            },
            Leave::Quit => {
                self.files.is_closing = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    /// Replaces the open project.
    fn begin(&mut self, project: Project, file: Option<DocumentFile>) {
        self.files.begin(&project, file);
        self.show_project(project);
    }

    fn show_project(&mut self, project: Project) {
        self.project = project;
        self.prompts.forget();
        self.history = History::default();
        self.session.play_path(false);
        self.session.forget_read_message(Instant::now());
        self.pages.author.canvas.tool.leave();
        self.pages.author.library.show_all();
        self.sheet = Sheet::Closed;
    }

    /// Opens a recovered project. The other leftovers remain, and the next window offers them.
    fn recover(&mut self, index: usize) {
        let Sheet::Recovered(leftovers) = &mut self.sheet else { return };
        match open(&leftovers[index].path(), &Permitted::All) {
            Ok(Opened::Project(opened)) => {
                let leftover = leftovers.remove(index);
                self.files.begin_recovered(leftover);
                self.show_project(opened.project);
                self.say_warnings(&opened.warnings);
            }
            Ok(Opened::Library(_)) => {}
            // The leftover remains.
            Err(error) => self.session.say(one_line(&error)),
        }
    }

    pub(super) fn say_warnings(&mut self, warnings: &[String]) {
        if !warnings.is_empty() {
            self.session.say(warnings.join("; "));
        }
    }

    fn ask_where_to_save(&mut self) {
        let path = self.files.document.path().map_or_else(
            || self.usual_folder().join(self.files.document.name()).with_extension(EXTENSION),
            Path::to_owned,
        );
        self.sheet = Sheet::Save(SaveSheet::project(&self.project, &path));
        self.offer_folders();
    }

    /// Offers the folders of the present project and of recent ones in the open sheet, if it asks for a path.
    pub(super) fn offer_folders(&mut self) {
        let recent = self.files.settings.recent.iter().map(PathBuf::as_path);
        let folders = folders_of(self.files.document.path().into_iter().chain(recent));
        match &mut self.sheet {
            Sheet::Import(sheet) => sheet.offer(folders),
            Sheet::Save(sheet) => sheet.offer(folders),
            Sheet::Export(sheet) => sheet.offer(folders),
            _ => {}
        }
    }

    /// Default folder for files: that of the project, otherwise that of the most recent project, otherwise the current
    /// folder.
    pub(super) fn usual_folder(&self) -> PathBuf {
        let of_recent = self.files.settings.recent.first().map(PathBuf::as_path);
        let folder = self.files.document.path().or(of_recent).and_then(Path::parent).filter(|f| f.is_dir());
        folder.map_or_else(|| std::env::current_dir().unwrap_or_default(), Path::to_owned)
    }
}
