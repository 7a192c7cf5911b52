//! The file of the project: where it is, what of the project it holds, and how it comes and goes.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};

use anyhow::{Context as _, bail};
use egui::Context;
use shagreen_formats::atomic;
use shagreen_formats::imported::Imported;
use shagreen_formats::library::{LibraryError, read_library};
use shagreen_formats::project::{
    LibraryFile, Project, ProjectError, read_project, sha256_hex, write_project,
};

use crate::background::in_background;
use crate::import::source::is_special;
use crate::strings::document as strings;

/// What stands in files as the program that wrote them.
pub(crate) const CREATED_BY: &str = concat!("Shagreen ", env!("CARGO_PKG_VERSION"));

/// The file of the project that is open.
pub struct Document {
    path: Option<PathBuf>,
    /// The project as the file has it; `None` where no file has it.
    on_disk: Option<Project>,
    is_changed: bool,
    /// The state of the project that `is_changed` was worked out for.
    revision: Option<u64>,
    saving: Option<Saving>,
    opening: Option<(Receiver<Result<Read, String>>, PathBuf)>,
}

/// A file that is being written: with what, and where.
struct Saving {
    outcome: Receiver<Result<(), String>>,
    project: Project,
    path: PathBuf,
}

/// What a file held.
pub enum Read {
    /// A project, with what was odd about it.
    Project(Box<Imported<Project>>),
    /// A library, with what was odd about it.
    Library(Box<Imported<LibraryFile>>),
}

/// What has come to an end since the last frame.
pub(crate) enum Came {
    /// The project is in this file now.
    Saved(PathBuf),
    /// Saving failed, for this reason.
    NotSaved(String),
    /// This was read from this file.
    Opened(Read, PathBuf),
    /// Reading failed, for this reason.
    NotOpened(String),
}

impl Document {
    /// A project that was just begun, or read from `path`: nothing of it would be lost.
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

    /// A project that no file has, though it may belong into the one at `path`.
    pub(crate) fn unsaved(path: Option<PathBuf>) -> Self {
        Self { path, on_disk: None, is_changed: true, revision: None, saving: None, opening: None }
    }

    /// Where the project is kept.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// The name of the project: that of its file.
    pub fn name(&self) -> String {
        let stem = self.path.as_ref().and_then(|path| path.file_stem());
        stem.map_or_else(|| strings::UNTITLED.to_owned(), |stem| stem.to_string_lossy().into_owned())
    }

    /// Whether something would be lost with the window, as of the last frame.
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

    /// Compares the project with what is on the disk, where its `revision` has changed.
    pub(crate) fn follow(&mut self, project: &Project, revision: u64) {
        if self.revision != Some(revision) {
            // What is selected and heard alone is looked at, not made: nobody is asked to save it.
            let is_on_disk = |on_disk: &Project| {
                let (selected, solo) = (project.selected, project.solo.clone());
                *project == Project { selected, solo, ..on_disk.clone() }
            };
            self.is_changed = !self.on_disk.as_ref().is_some_and(is_on_disk);
            self.revision = Some(revision);
        }
    }

    /// Writes the project to `path`, replacing what is there, in a thread of its own.
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

    /// Reads what is at `path` in a thread of its own.
    pub(crate) fn open(&mut self, path: PathBuf, ctx: &Context) {
        let from = path.clone();
        let work = move || read_file(&from).map_err(|error| format!("{error:#}"));
        self.opening = Some((in_background(ctx.clone(), work), path));
    }

    /// Takes in what the threads have done.
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

/// Reads a project, with its library where that is a file of its own, or a library.
///
/// # Errors
/// The file cannot be read or is neither; the message says which file it is.
pub fn read_file(path: &Path) -> anyhow::Result<Read> {
    let in_file = || path.display().to_string();
    if is_special(path) {
        bail!("{}: {}", path.display(), strings::NO_FILE);
    }
    let bytes = std::fs::read(path).context(strings::CANNOT_READ).with_context(in_file)?;
    let as_project = read_project(&bytes, &folder_of(path), &|library| std::fs::read(library));
    match as_project {
        Ok(imported) => Ok(Read::Project(Box::new(imported))),
        Err(ProjectError::Format { .. }) => match read_library(&bytes) {
            Ok(Imported { value: library, warnings }) => {
                // Told from every folder alike.
                let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
                let file = LibraryFile { path, sha256: sha256_hex(&bytes), library };
                Ok(Read::Library(Box::new(Imported { value: file, warnings })))
            }
            Err(LibraryError::Format { .. }) => bail!("{}: {}", path.display(), strings::NEITHER),
            Err(error) => Err(error).with_context(in_file),
        },
        Err(error) => Err(error).with_context(in_file),
    }
}

/// The folder that a file lies in, absolute where the system can tell.
fn folder_of(path: &Path) -> PathBuf {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    // Where it cannot be told, paths beside the project are written in full.
    std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned())
}

#[cfg(test)]
mod tests {
    use super::{Came, Document, Read, read_file};
    use crate::edit::{Edit, edited};
    use shagreen_formats::built_in::BuiltIn;
    use shagreen_formats::project::{Project, ProjectLibrary};
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
        let Came::Opened(Read::Project(imported), _) = wait(&mut document) else { panic!("a project") };
        assert_eq!((imported.value, imported.warnings), (project, Vec::new()));
    }

    #[test]
    fn what_cannot_be_saved_or_read_is_said_and_nothing_changes() {
        let folder = tempfile::tempdir().unwrap();
        let ctx = egui::Context::default();
        let project = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "New texture");
        let mut document = Document::unsaved(None);
        document.follow(&project, 1);
        document.save(&project, folder.path().join("no/where.shagreen"), &ctx);
        let Came::NotSaved(reason) = wait(&mut document) else { panic!("no folder") };
        assert!(reason.contains("where.shagreen"), "{reason}");
        assert!(document.is_changed() && document.path().is_none());
        let error_of =
            |path: &std::path::Path| format!("{:#}", read_file(path).err().expect("no file to open"));
        let faults: [(&str, &[u8], &str); 4] = [
            ("a", b"hello", "neither a project nor"),
            ("b", b"{\"format\": \"shagreen-library\"}", "version missing"),
            ("c", b"{\"format\": \"shagreen-project\"}", "version missing"),
            ("d", b"{\"format\": \"shagreen-project\", \"version\": \"1.0\"}", "damaged"),
        ];
        for (name, bytes, words) in faults {
            let path = folder.path().join(name);
            std::fs::write(&path, bytes).unwrap();
            let error = error_of(&path);
            assert!(error.contains(words) && error.contains(&path.display().to_string()), "{error}");
        }
        assert!(error_of(folder.path()).contains("no file"));
        assert!(error_of(&folder.path().join("none")).contains("cannot be read"));
    }

    #[test]
    fn a_library_is_opened_too() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("starter.json");
        std::fs::write(&path, shagreen_formats::starter::starter_bytes()).unwrap();
        let Ok(Read::Library(imported)) = read_file(&path) else { panic!("a library") };
        assert_eq!((imported.value.path, imported.value.library.textures.len()), (path, 25));
    }
}
