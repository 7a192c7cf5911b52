//! Everything about files that the window keeps: the project's own, what survives a crash, and what is remembered.

use std::path::PathBuf;

use egui::Context;
use shagreen_formats::imported::Imported;
use shagreen_formats::project::Project;
use shagreen_formats::settings::Settings;

use crate::document::Document;
use crate::leaving::Leave;
use crate::recovery::{Leftover, Recovery, leftovers};
use crate::settings_file::SettingsFile;
use crate::strings::document as strings;

/// Where the program keeps what outlives it; `None` keeps nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Keeping {
    /// The folder of what survives a crash.
    pub recovery: Option<PathBuf>,
    /// The file of the settings.
    pub settings: Option<PathBuf>,
    /// The folder of networks of others.
    pub models: Option<PathBuf>,
}

/// The state of all of them.
pub(crate) struct Files {
    pub(crate) document: Document,
    pub(crate) settings: Settings,
    settings_file: SettingsFile,
    recovery: Option<Recovery>,
    /// Why there is none, until it was said.
    problem: Option<String>,
    /// What was recovered, until something else holds it.
    recovered: Option<Leftover>,
    /// What waits for the project to be saved.
    pub(crate) after_saving: Option<Leave>,
    /// A project that was read and waits for the one that is open to be left, and its file unless it is a copy.
    pub(crate) waiting: Option<(Box<Imported<Project>>, Option<PathBuf>)>,
    /// Whether the program may end.
    pub(crate) is_closing: bool,
    /// Whether what is being read is what a new project begins like.
    pub(crate) is_beginning: bool,
}

impl Files {
    /// The files of a project that was just begun, or read from `path`.
    pub(crate) fn new(project: &Project, path: Option<PathBuf>, keeping: Keeping) -> Self {
        let (settings_file, mut settings) = SettingsFile::open(keeping.settings);
        if let Some(path) = &path {
            settings.note_project(path);
        }
        let (mut recovery, mut problem) = (None, None);
        if let Some(folder) = keeping.recovery {
            match Recovery::new(&folder) {
                Ok(slot) => recovery = Some(slot),
                Err(error) => problem = Some(strings::no_recovery(&error.to_string())),
            }
        }
        Self {
            document: Document::new(project, path),
            settings,
            settings_file,
            recovery,
            problem,
            recovered: None,
            after_saving: None,
            waiting: None,
            is_closing: false,
            is_beginning: false,
        }
    }

    /// Why nothing may be driven: the settings are there and do not tell what hangs on the output.
    pub(crate) fn settings_problem(&self) -> Option<&str> {
        self.settings_file.problem()
    }

    /// What other windows left behind.
    pub(crate) fn leftovers(keeping: &Keeping) -> Vec<Leftover> {
        keeping.recovery.as_deref().map(leftovers).unwrap_or_default()
    }

    /// Once a frame: keeps what is to be kept; returns what there is to say.
    pub(crate) fn follow(&mut self, project: &Project, revision: u64, ctx: &Context) -> Option<String> {
        self.document.follow(project, revision);
        self.settings_file.follow(&self.settings, ctx);
        let is_changed = self.document.is_changed();
        if let Some(recovery) = &mut self.recovery {
            recovery.follow(project, revision, self.document.path(), is_changed, ctx);
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

    /// Another project takes the place of the one that was open.
    pub(crate) fn begin(&mut self, project: &Project, path: Option<PathBuf>) {
        if let Some(path) = &path {
            self.settings.note_project(path);
        }
        self.document = Document::new(project, path);
        self.restart_recovery();
    }

    /// The same with a project that was left behind, which is in no file yet.
    pub(crate) fn begin_recovered(&mut self, leftover: Leftover) {
        self.document = Document::unsaved(leftover.origin.clone());
        self.recovered = Some(leftover);
        self.restart_recovery();
    }

    /// The project is not left after all: what waited for that is forgotten.
    pub(crate) fn stay(&mut self) {
        (self.after_saving, self.waiting) = (None, None);
    }

    /// What the slot holds belongs to a project that was left.
    fn restart_recovery(&mut self) {
        if let Some(recovery) = &mut self.recovery {
            recovery.restart();
        }
    }
}
