//! All files of the window: the project file, recovery, and settings.

use std::path::{Path, PathBuf};

use egui::Context;
use shagreen_formats::project::{Project, ProjectLibrary};
use shagreen_formats::settings::Settings;
use shagreen_studio::open::OpenedProject;
use shagreen_studio::permitted_libraries::Permitted;

use crate::state::desktop_motion;
use crate::state::document::{Document, DocumentFile};
use crate::state::leave::Leave;
use crate::state::recovery::{Leftover, Recovery, leftovers};
use crate::state::settings_file::SettingsFile;
use crate::strings::document as strings;

/// Paths of the files that outlive the program; with `None` nothing is stored.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StoragePaths {
    /// Folder of the recovery files.
    pub recovery: Option<PathBuf>,
    /// Settings file.
    pub settings: Option<PathBuf>,
    /// Folder of added models.
    pub models: Option<PathBuf>,
    /// Folder of all files that Shagreen keeps for the user. Projects may read libraries in it.
    pub own: Option<PathBuf>,
    /// Folder in which the desktop keeps its settings; it is only read.
    pub desktop: Option<PathBuf>,
}

/// Purpose of reading a project file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Reading {
    /// The project opens.
    #[default]
    Open,
    /// A copy of it begins as a new project.
    Template,
    /// The file of the open project is read again, because another window or program has changed it. The open project
    /// is then kept aside.
    Reload,
}

/// Project file, settings and recovery.
pub(crate) struct Files {
    pub(crate) document: Document,
    pub(crate) settings: Settings,
    settings_file: SettingsFile,
    recovery: Option<Recovery>,
    /// Reason why recovery is unavailable, until it is shown.
    problem: Option<String>,
    /// Recovered project, until its content is stored elsewhere.
    recovered: Option<Leftover>,
    /// Action after the project has been saved.
    pub(crate) after_saving: Option<Leave>,
    /// Project that was read and opens when the present one is left. The path is `None` for a copy.
    pub(crate) waiting: Option<(Box<OpenedProject>, Option<PathBuf>)>,
    /// Whether to save once more when the file has been written.
    pub(crate) saves_again: bool,
    /// Whether the program may close.
    pub(crate) is_closing: bool,
    /// Purpose of the file being read.
    reading: Reading,
    /// Paths of the files that outlive the program.
    pub(crate) keeping: StoragePaths,
    /// Whether the desktop asks for reduced motion.
    desktop_reduces_motion: bool,
}

impl Files {
    /// Files of a new project, or of one that was read from `path`.
    pub(crate) fn new(project: &Project, file: Option<DocumentFile>, keeping: StoragePaths) -> Self {
        let (settings_file, mut settings) = SettingsFile::open(keeping.settings.clone());
        if let Some(file) = &file {
            settings.note_project(&file.path);
        }
        let (mut recovery, mut problem) = (None, None);
        if let Some(folder) = &keeping.recovery {
            match Recovery::new(folder) {
                Ok(slot) => recovery = Some(slot),
                Err(error) => problem = Some(strings::no_recovery(&error.to_string())),
            }
        }
        Self {
            document: Document::new(project, file),
            settings,
            settings_file,
            recovery,
            problem,
            recovered: None,
            after_saving: None,
            waiting: None,
            saves_again: false,
            is_closing: false,
            reading: Reading::default(),
            desktop_reduces_motion: keeping.desktop.as_deref().is_some_and(desktop_motion::reduces_motion),
            keeping,
        }
    }

    /// Reason why no output may be driven: the settings file exists, but its device setup is unreadable.
    pub(crate) fn settings_problem(&self) -> Option<&str> {
        self.settings_file.problem()
    }

    /// Whether animations are off: the choice of the user, or else that of the desktop.
    pub(crate) fn reduces_motion(&self) -> bool {
        self.settings.reduces_motion.unwrap_or(self.desktop_reduces_motion)
    }

    /// Projects that other windows left behind.
    pub(crate) fn leftovers(keeping: &StoragePaths) -> Vec<Leftover> {
        keeping.recovery.as_deref().map(leftovers).unwrap_or_default()
    }

    /// Updates document, settings file and recovery, once a frame. Returns a message to show.
    pub(crate) fn follow(&mut self, project: &Project, revision: u64, ctx: &Context) -> Option<String> {
        self.document.follow(project, revision);
        self.settings_file.follow(&self.settings, ctx);
        let is_changed = self.document.is_changed();
        if let Some(recovery) = &mut self.recovery {
            recovery.follow(project, revision, self.document.file(), is_changed, ctx);
            let is_kept = recovery.has_written() || !is_changed;
            if let Some(leftover) = self.recovered.take_if(|_| is_kept) {
                leftover.discard();
            }
            if let Some(reason) = recovery.take_failure() {
                return Some(strings::no_recovery(&reason));
            }
        }
        self.problem.take()
    }

    /// Replaces the open project.
    pub(crate) fn begin(&mut self, project: &Project, file: Option<DocumentFile>) {
        if let Some(file) = &file {
            self.settings.note_project(&file.path);
        }
        self.document = Document::new(project, file);
        self.restart_recovery();
    }

    /// Replaces the open project by one that differs from its file.
    pub(crate) fn begin_unsaved(&mut self, file: Option<DocumentFile>) {
        if let Some(file) = &file {
            self.settings.note_project(&file.path);
        }
        self.document = Document::unsaved(file);
        self.restart_recovery();
    }

    /// Reads a project or library in the background. A project may read libraries in its own folder, in the folder of
    /// Shagreen, and those that the user has permitted for it.
    pub(crate) fn open(&mut self, path: PathBuf, reading: Reading, ctx: &Context) {
        self.reading = reading;
        let mut places = self.settings.libraries_of(&path);
        places.extend(self.keeping.own.clone());
        self.document.open(path, Permitted::Only(places), ctx);
    }

    /// Reads a project on another library than the one that it names, or on the starter library.
    pub(crate) fn open_on(
        &mut self,
        path: PathBuf,
        library: Option<PathBuf>,
        reading: Reading,
        ctx: &Context,
    ) {
        self.reading = reading;
        self.document.open_on(path, library, ctx);
    }

    /// Discards the file that is being opened; returns its path, or `None` if there is none.
    pub(crate) fn cancel_opening(&mut self) -> Option<PathBuf> {
        self.reading = Reading::default();
        self.document.cancel_opening()
    }

    /// Purpose of the file that was read last.
    pub(crate) fn take_reading(&mut self) -> Reading {
        std::mem::take(&mut self.reading)
    }

    /// Permits the library of a project that was saved: the user has opened it.
    pub(crate) fn note_saved(&mut self, path: &Path, project: &Project) {
        self.settings.note_project(path);
        if let ProjectLibrary::File(file) = &project.library {
            self.settings.permit_library(path, &file.path);
        }
    }

    /// Replaces the open project by a recovered one, which is in no project file yet.
    pub(crate) fn begin_recovered(&mut self, leftover: Leftover) {
        self.document = Document::unsaved(leftover.origin.clone());
        self.recovered = Some(leftover);
        self.restart_recovery();
    }

    /// Puts a copy of the project into the recovery folder, where the next window offers it.
    ///
    /// # Errors
    /// The copy cannot be written, or there is no recovery folder.
    pub(crate) fn keep_aside(&self, project: &Project) -> Result<(), String> {
        let Some(recovery) = &self.recovery else { return Err(strings::NO_RECOVERY.to_owned()) };
        recovery.keep_aside(project, self.document.file()).map_err(|error| error.to_string())
    }

    /// Cancels leaving the project.
    pub(crate) fn stay(&mut self) {
        (self.after_saving, self.waiting) = (None, None);
        if self.reading == Reading::Reload {
            self.reading = Reading::Open;
        }
    }

    /// Discards the recovery file, which belongs to the previous project.
    fn restart_recovery(&mut self) {
        if let Some(recovery) = &mut self.recovery {
            recovery.restart();
        }
    }
}
