//! File of the project: its path, its content, saving and opening.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::Context;
use shagreen_formats::atomic;
use shagreen_formats::project::{Project, write_project};
use shagreen_studio::file::folder_of;
use shagreen_studio::open::{Opened, open};

use crate::state::background::in_background;
use crate::strings::document as strings;

/// Program name and version in written files.
pub(crate) const CREATED_BY: &str = concat!("Shagreen ", env!("CARGO_PKG_VERSION"));

/// File of the open project.
pub struct Document {
    path: Option<PathBuf>,
    /// Project as saved, or `None` if no file contains it.
    on_disk: Option<Project>,
    is_changed: bool,
    /// Revision of the project for which `is_changed` was computed.
    revision: Option<u64>,
    saving: Option<Saving>,
    opening: Option<(Receiver<Result<Opened, String>>, PathBuf)>,
}

/// Save operation in progress.
struct Saving {
    outcome: Receiver<Result<(), String>>,
    project: Project,
    path: PathBuf,
}

/// Result of saving or opening.
pub(crate) enum Came {
    /// The project was saved to this file.
    Saved(PathBuf),
    /// Saving failed for this reason.
    NotSaved(String),
    /// This was opened from this file.
    Opened(Opened, PathBuf),
    /// Opening failed for this reason.
    NotOpened(String),
}

impl Document {
    /// Document of a new project, or of one that was read from `path`. It has no unsaved changes.
    pub(crate) fn new(project: &Project, path: Option<PathBuf>) -> Self {
        Self {
            path,
            on_disk: Some(project.clone()),
            is_changed: false,
            revision: None,
            saving: None,
            opening: None,
        }
    }

    /// Document of a recovered project. No file contains it, although `path` may be its file.
    pub(crate) fn unsaved(path: Option<PathBuf>) -> Self {
        Self { path, on_disk: None, is_changed: true, revision: None, saving: None, opening: None }
    }

    /// Path of the file, if the project has one.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Name of the project, which is the file name without its ending.
    pub fn name(&self) -> String {
        let stem = self.path.as_ref().and_then(|path| path.file_stem());
        stem.map_or_else(|| strings::UNTITLED.to_owned(), |stem| stem.to_string_lossy().into_owned())
    }

    /// Whether there were unsaved changes in the last frame.
    pub fn is_changed(&self) -> bool {
        self.is_changed
    }

    /// Whether the file is being written.
    pub fn is_saving(&self) -> bool {
        self.saving.is_some()
    }

    /// Whether another project is being read.
    pub fn is_opening(&self) -> bool {
        self.opening.is_some()
    }

    /// Compares the project with the saved one if its `revision` has changed.
    pub(crate) fn follow(&mut self, project: &Project, revision: u64) {
        if self.revision != Some(revision) {
            // Selection and solo are view state, so they do not count as changes.
            let is_on_disk = |on_disk: &Project| {
                let (selected, solo) = (project.selected, project.solo.clone());
                *project == Project { selected, solo, ..on_disk.clone() }
            };
            self.is_changed = !self.on_disk.as_ref().is_some_and(is_on_disk);
            self.revision = Some(revision);
        }
    }

    /// Saves the project to `path` in the background and replaces an existing file.
    pub(crate) fn save(&mut self, project: &Project, path: PathBuf, ctx: &Context) {
        let (content, to) = (project.clone(), path.clone());
        let work = move || {
            let folder = folder_of(&to);
            atomic::write(&to, &write_project(&content, &folder, CREATED_BY))
                .map_err(|error| error.to_string())
        };
        let outcome = in_background(ctx.clone(), work);
        self.saving = Some(Saving { outcome, project: project.clone(), path });
    }

    /// Opens `path` in the background.
    pub(crate) fn open(&mut self, path: PathBuf, ctx: &Context) {
        let from = path.clone();
        let work = move || open(&from).map_err(|error| format!("{error:#}"));
        self.opening = Some((in_background(ctx.clone(), work), path));
    }

    /// Result of a completed operation, if any.
    pub(crate) fn collect(&mut self) -> Option<Came> {
        self.collect_saved().or_else(|| self.collect_opened())
    }

    fn collect_saved(&mut self) -> Option<Came> {
        let outcome = match self.saving.as_ref()?.outcome.try_recv() {
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => Err(strings::BROKE_OFF.to_owned()),
            Ok(outcome) => outcome,
        };
        let Saving { project, path, .. } = self.saving.take()?;
        Some(match outcome {
            Ok(()) => {
                (self.on_disk, self.revision) = (Some(project), None);
                self.path = Some(path.clone());
                Came::Saved(path)
            }
            Err(reason) => Came::NotSaved(reason),
        })
    }

    fn collect_opened(&mut self) -> Option<Came> {
        let (receiver, _) = self.opening.as_ref()?;
        let outcome = match receiver.try_recv() {
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => Err(strings::BROKE_OFF.to_owned()),
            Ok(outcome) => outcome,
        };
        let (_, path) = self.opening.take()?;
        Some(match outcome {
            Ok(read) => Came::Opened(read, path),
            Err(reason) => Came::NotOpened(reason),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Came, Document};
    use crate::state::edit::{Edit, edited};
    use shagreen_formats::built_in::BuiltIn;
    use shagreen_formats::project::{Project, ProjectLibrary};
    use shagreen_studio::open::Opened;
    use std::time::Instant;

    fn wait(document: &mut Document) -> Came {
        let begun = Instant::now();
        loop {
            if let Some(came) = document.collect() {
                return came;
            }
            assert!(begun.elapsed().as_secs() < 20, "nothing came");
            std::thread::yield_now();
        }
    }

    #[test]
    fn a_project_is_saved_and_opened_again() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("Woods.shagreen");
        let ctx = egui::Context::default();
        let begun = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "New texture");
        let mut document = Document::new(&begun, None);
        assert_eq!(document.name(), "Untitled");
        let project = edited(&begun, Edit::Rename("Oak".to_owned()));
        document.follow(&project, 1);
        assert!(document.is_changed());
        document.save(&project, path.clone(), &ctx);
        assert!(matches!(wait(&mut document), Came::Saved(to) if to == path));
        document.follow(&project, 1);
        assert!(!document.is_changed());
        assert_eq!(document.name(), "Woods");
        document.follow(&begun, 2);
        assert!(document.is_changed(), "undo goes back behind what is saved");
        document.open(path, &ctx);
        let Came::Opened(Opened::Project(imported), _) = wait(&mut document) else { panic!("a project") };
        assert_eq!((imported.value, imported.warnings), (project, Vec::new()));
    }

    #[test]
    fn what_cannot_be_saved_is_explained_and_nothing_changes() {
        let folder = tempfile::tempdir().unwrap();
        let ctx = egui::Context::default();
        let project = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "New texture");
        let mut document = Document::unsaved(None);
        document.follow(&project, 1);
        document.save(&project, folder.path().join("no/where.shagreen"), &ctx);
        let Came::NotSaved(reason) = wait(&mut document) else { panic!("no folder") };
        assert!(reason.contains("where.shagreen"), "{reason}");
        assert!(document.is_changed() && document.path().is_none());
    }
}
