//! File of the project: its path, its content, saving and opening.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::Context;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::library::Library;
use shagreen_formats::locked_update::update;
use shagreen_formats::project::{
    Project, ProjectError, ProjectLibrary, read_project, read_project_on, sha256_hex, write_project,
};
use shagreen_studio::file::{folder_of, one_line};
use shagreen_studio::open::{Opened, open, open_on};
use shagreen_studio::permitted_libraries::{OutsideLibrary, Permitted};

use crate::state::background::in_background;
use crate::state::conflict::{Conflict, differences};
use crate::strings::document as strings;

/// Program name and version in written files.
pub(crate) const CREATED_BY: &str = concat!("Shagreen ", env!("CARGO_PKG_VERSION"));

/// Project file, as it was when it was read or saved last.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DocumentFile {
    /// Path of the file.
    pub path: PathBuf,
    /// SHA-256 of its content in hexadecimal digits; `None` if the content is unknown.
    pub sha256: Option<String>,
}

/// File of the open project.
pub struct Document {
    file: Option<DocumentFile>,
    /// Name of a project that has no file yet.
    title: Option<&'static str>,
    /// Project as saved, or `None` if no file contains it.
    on_disk: Option<Project>,
    is_changed: bool,
    /// Revision of the project for which `is_changed` was computed.
    revision: Option<u64>,
    saving: Option<Saving>,
    opening: Option<(Receiver<anyhow::Result<Opened>>, PathBuf)>,
}

/// Content that an existing file may have when it is replaced.
enum Expected {
    /// Any, because the user chose to replace the file.
    Any,
    /// None: what the file contained when it was read is unknown.
    Nothing,
    /// Content with this SHA-256.
    Content(String),
}

impl Expected {
    fn allows(&self, present: &[u8]) -> bool {
        match self {
            Self::Any => true,
            Self::Nothing => false,
            Self::Content(sha256) => *sha256 == sha256_hex(present),
        }
    }
}

/// Save operation in progress.
struct Saving {
    outcome: Receiver<Result<Saved, String>>,
    project: Project,
    path: PathBuf,
}

/// Result of a save operation that did not fail.
enum Saved {
    /// The file was written; it has this SHA-256.
    Written(String),
    /// The file has changed since it was read, and was not written.
    Changed(Conflict),
}

/// Result of saving or opening.
pub(crate) enum Came {
    /// The project was saved to this file.
    Saved(PathBuf),
    /// Nothing was saved, because another window or program has changed the file.
    Conflict(Conflict),
    /// Saving failed for this reason.
    NotSaved(String),
    /// This was opened from this file.
    Opened(Opened, PathBuf),
    /// Nothing was opened, because the project names a library outside its folder that the user has not permitted.
    Outside {
        /// Path of the project.
        project: PathBuf,
        /// Path of the library.
        library: PathBuf,
    },
    /// Opening failed for this reason.
    NotOpened(String),
}

impl Document {
    /// Document of a new project, or of one that was read from `file`. It has no unsaved changes.
    pub(crate) fn new(project: &Project, file: Option<DocumentFile>) -> Self {
        Self { on_disk: Some(project.clone()), is_changed: false, ..Self::unsaved(file) }
    }

    /// Document of a recovered project. No file contains it, although `file` may be its file.
    pub(crate) fn unsaved(file: Option<DocumentFile>) -> Self {
        Self {
            file,
            title: None,
            on_disk: None,
            is_changed: true,
            revision: None,
            saving: None,
            opening: None,
        }
    }

    /// Path of the file, if the project has one.
    pub fn path(&self) -> Option<&Path> {
        self.file.as_ref().map(|file| file.path.as_path())
    }

    /// Project file, if the project has one.
    pub(crate) fn file(&self) -> Option<&DocumentFile> {
        self.file.as_ref()
    }

    /// Name of the project: the file name without its ending, or the title of a project that has no file yet.
    pub fn name(&self) -> String {
        let stem = self.path().and_then(Path::file_stem);
        let title = || self.title.unwrap_or(strings::UNTITLED).to_owned();
        stem.map_or_else(title, |stem| stem.to_string_lossy().into_owned())
    }

    /// Names the project until it has a file.
    pub(crate) fn set_title(&mut self, title: &'static str) {
        self.title = Some(title);
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

    /// Saves the project to `path` in the background and replaces an existing file. If it is the document's own file and
    /// another window or program has changed it, nothing is written.
    pub(crate) fn save(&mut self, project: &Project, path: PathBuf, ctx: &Context) {
        let own = self.file.as_ref().filter(|file| file.path == path);
        let expected = own.map_or(Expected::Any, |file| match &file.sha256 {
            Some(sha256) => Expected::Content(sha256.clone()),
            None => Expected::Nothing,
        });
        self.begin_to_save(project, path, expected, ctx);
    }

    /// Saves the project over the changed file of a conflict, unless that has changed once more.
    pub(crate) fn overwrite(&mut self, project: &Project, conflict: &Conflict, ctx: &Context) {
        self.begin_to_save(project, conflict.path.clone(), Expected::Content(conflict.sha256.clone()), ctx);
    }

    /// Saves the project if an existing file has the expected content.
    fn begin_to_save(&mut self, project: &Project, path: PathBuf, expected: Expected, ctx: &Context) {
        let (content, to, base) = (project.clone(), path.clone(), self.on_disk.clone());
        let outcome = in_background(ctx.clone(), move || {
            let bytes = write_project(&content, &folder_of(&to), CREATED_BY);
            let sha256 = sha256_hex(&bytes);
            let written = update(&to, FileKind::Document, |present| match present {
                Some(present) if present != bytes && !expected.allows(present) => {
                    Err(conflict(&to, base.as_ref(), &content, present))
                }
                _ => Ok(bytes),
            });
            match written.map_err(|error| error.to_string())? {
                Ok(()) => Ok(Saved::Written(sha256)),
                Err(conflict) => Ok(Saved::Changed(conflict)),
            }
        });
        self.saving = Some(Saving { outcome, project: project.clone(), path });
    }

    /// Opens `path` in the background; a project may read the permitted libraries.
    pub(crate) fn open(&mut self, path: PathBuf, permitted: Permitted, ctx: &Context) {
        let from = path.clone();
        self.opening = Some((in_background(ctx.clone(), move || open(&from, &permitted)), path));
    }

    /// Opens the project at `path` in the background, on this library or on the starter library.
    pub(crate) fn open_on(&mut self, path: PathBuf, library: Option<PathBuf>, ctx: &Context) {
        let from = path.clone();
        let work = move || open_on(&from, library.as_deref()).map(|opened| Opened::Project(Box::new(opened)));
        self.opening = Some((in_background(ctx.clone(), work), path));
    }

    /// Discards the file that is being opened; returns its path, or `None` if there is none.
    pub(crate) fn cancel_opening(&mut self) -> Option<PathBuf> {
        self.opening.take().map(|(_, path)| path)
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
            Ok(Saved::Written(sha256)) => {
                (self.on_disk, self.revision) = (Some(project), None);
                self.file = Some(DocumentFile { path: path.clone(), sha256: Some(sha256) });
                Came::Saved(path)
            }
            Ok(Saved::Changed(conflict)) => Came::Conflict(conflict),
            Err(reason) => Came::NotSaved(reason),
        })
    }

    fn collect_opened(&mut self) -> Option<Came> {
        let (receiver, _) = self.opening.as_ref()?;
        let outcome = match receiver.try_recv() {
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => Err(anyhow::anyhow!(strings::BROKE_OFF)),
            Ok(outcome) => outcome,
        };
        let (_, path) = self.opening.take()?;
        Some(match outcome {
            Ok(read) => Came::Opened(read, path),
            Err(error) => match error.downcast::<OutsideLibrary>() {
                Ok(OutsideLibrary { library }) => Came::Outside { project: path, library },
                Err(error) => Came::NotOpened(one_line(&error)),
            },
        })
    }
}

/// Differences between the open project and the content of its changed file.
fn conflict(path: &Path, base: Option<&Project>, here: &Project, present: &[u8]) -> Conflict {
    let folder = folder_of(path);
    // Whoever changed the file may have named a library that the user has not permitted.
    let open_libraries =
        [Some(here), base].into_iter().flatten().filter_map(|project| match &project.library {
            ProjectLibrary::File(file) => Some(file.path.clone()),
            ProjectLibrary::BuiltIn(_) | ProjectLibrary::Inside(_) => None,
        });
    let permitted = Permitted::Only(open_libraries.collect());
    let library = |library: &Path| {
        let is_permitted = permitted.covers(library, &folder);
        if is_permitted { bounded_file::read(library, FileKind::Document) } else { Err(unreadable()) }
    };
    let read = |bytes: &[u8]| match read_project(bytes, &folder, &library) {
        Ok(mut read) => {
            // As an opened project.
            read.value.fit_points();
            Some(read.value)
        }
        // An empty library differs from the open one, as the one that was not read does.
        Err(ProjectError::LibraryFile { .. } | ProjectError::Network { .. }) => {
            let empty = ProjectLibrary::Inside(Library::default().into());
            read_project_on(bytes, empty).ok().map(|read| read.value)
        }
        Err(_) => None,
    };
    // As they would come back from a file, in which numbers are rounded.
    let as_read = |project: &Project| read(&write_project(project, &folder, CREATED_BY));
    let (base, here) = (base.and_then(as_read), as_read(here).unwrap_or_else(|| here.clone()));
    let differences = read(present).map(|there| differences(base.as_ref(), &here, &there));
    Conflict { path: path.to_owned(), sha256: sha256_hex(present), differences }
}

fn unreadable() -> std::io::Error {
    std::io::ErrorKind::PermissionDenied.into()
}

#[cfg(all(test, target_os = "linux", target_arch = "x86_64"))]
#[path = "document/tests/faults.rs"]
mod faults;

#[cfg(test)]
#[path = "document/tests/other_axes.rs"]
mod other_axes;

#[cfg(test)]
#[path = "document/tests/other_library.rs"]
mod other_library;

#[cfg(test)]
#[path = "document/tests/support.rs"]
mod support;

#[cfg(test)]
#[path = "document/tests/two_windows.rs"]
mod two_windows;

#[cfg(test)]
mod tests {
    use super::support::wait;
    use super::{Came, Document, DocumentFile};
    use crate::choices::conflict::Change;
    use crate::state::edit::{Edit, edited};
    use shagreen_formats::built_in::BuiltIn;
    use shagreen_formats::project::{Project, ProjectLibrary};
    use shagreen_studio::open::Opened;
    use shagreen_studio::permitted_libraries::Permitted;

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
        document.open(path, Permitted::All, &ctx);
        let Came::Opened(Opened::Project(opened), _) = wait(&mut document) else { panic!("a project") };
        assert_eq!((opened.project, opened.warnings), (project, Vec::new()));
    }

    #[test]
    fn a_file_that_another_window_changed_is_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("Woods.shagreen");
        let ctx = egui::Context::default();
        let begun = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "New texture");
        let renamed = |name: &str| edited(&begun, Edit::Rename(name.to_owned()));
        let mut first = Document::new(&begun, None);
        first.save(&begun, path.clone(), &ctx);
        assert!(matches!(wait(&mut first), Came::Saved(_)));
        let mut second = Document::new(&begun, first.file().cloned());
        second.save(&renamed("Elm"), path.clone(), &ctx);
        assert!(matches!(wait(&mut second), Came::Saved(_)));
        first.save(&renamed("Ash"), path.clone(), &ctx);
        let Came::Conflict(conflict) = wait(&mut first) else { panic!("a conflict") };
        let differences = conflict.differences.as_ref().unwrap();
        assert_eq!((differences.len(), differences[0].change), (1, Change::Both));
        // The same content is no conflict.
        first.save(&renamed("Elm"), path.clone(), &ctx);
        assert!(matches!(wait(&mut first), Came::Saved(_)));
        second.save(&renamed("Oak"), path.clone(), &ctx);
        assert!(matches!(wait(&mut second), Came::Saved(_)));
        first.save(&renamed("Ash"), path.clone(), &ctx);
        let Came::Conflict(conflict) = wait(&mut first) else { panic!("a conflict") };
        // A recovered project does not know the content of its file.
        let unknown = DocumentFile { path: path.clone(), sha256: None };
        let mut recovered = Document::unsaved(Some(unknown));
        recovered.save(&renamed("Ash"), path.clone(), &ctx);
        assert!(matches!(wait(&mut recovered), Came::Conflict(_)));
        // Overwriting replaces the content that the user has seen, and no later one.
        second.save(&renamed("Yew"), path.clone(), &ctx);
        assert!(matches!(wait(&mut second), Came::Saved(_)));
        first.overwrite(&renamed("Ash"), &conflict, &ctx);
        let Came::Conflict(conflict) = wait(&mut first) else { panic!("it changed once more") };
        first.overwrite(&renamed("Ash"), &conflict, &ctx);
        assert!(matches!(wait(&mut first), Came::Saved(_)));
        // A file that was deleted is written again.
        std::fs::remove_file(&path).unwrap();
        first.save(&renamed("Fir"), path.clone(), &ctx);
        assert!(matches!(wait(&mut first), Came::Saved(_)));
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
