//! Recovery after a crash: the project is written to a recovery folder every few seconds, and the next program start
//! offers it.
//!
//! Each window has a slot: a uniquely named project file and a lock file. The system releases the lock when the program
//! ends in any way. A slot with a released lock is a leftover, and its project is offered. A window that closes
//! normally deletes its slot.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use egui::Context;
use shagreen_formats::atomic;
use shagreen_formats::project::{EXTENSION, Project, write_project};

use crate::state::background::in_background;
use crate::state::document::CREATED_BY;

/// Minimum interval between writes of a changed project.
pub const INTERVAL: Duration = Duration::from_secs(4);
/// Ending of the lock files.
const LOCK: &str = "lock";
/// Ending of the files that contain the path of the project file.
const ORIGIN: &str = "origin";

/// Recovery slot of one window.
pub struct Recovery {
    slot: PathBuf,
    /// Locked while the program runs.
    _lock: File,
    written: Option<u64>,
    last: Instant,
    writing: Option<(Receiver<Result<(), String>>, u64)>,
    failure: Option<String>,
}

/// Project that another program run left behind.
#[derive(Debug)]
pub struct Leftover {
    slot: PathBuf,
    /// Locked so that no other window offers the same project.
    _lock: File,
    /// Path of the project file, if the project had one.
    pub origin: Option<PathBuf>,
    /// Time of the last write.
    pub written: SystemTime,
}

impl Recovery {
    /// Creates a slot in `folder`, and the folder if necessary.
    ///
    /// # Errors
    /// The folder cannot be created or written to, or its file system does not support locks.
    pub fn new(folder: &Path) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        let slot = folder.join(format!("{}-{}", now.as_nanos(), std::process::id()));
        let lock = File::create_new(slot.with_extension(LOCK))?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(TryLockError::Error(error)) => return Err(error),
            Err(TryLockError::WouldBlock) => return Err(io::ErrorKind::WouldBlock.into()),
        }
        Ok(Self { slot, _lock: lock, written: None, last: Instant::now(), writing: None, failure: None })
    }

    /// Writes the project in the background if it has unsaved changes, this `revision` has not been written, and
    /// [`INTERVAL`] has passed. Without unsaved changes, the slot's files are deleted.
    pub(crate) fn follow(
        &mut self,
        project: &Project,
        revision: u64,
        origin: Option<&Path>,
        is_changed: bool,
        ctx: &Context,
    ) {
        if let Some((receiver, revision)) = &self.writing {
            match receiver.try_recv() {
                Err(TryRecvError::Empty) => return,
                Ok(Ok(())) => self.written = Some(*revision),
                Ok(Err(reason)) => self.failure = Some(reason),
                Err(TryRecvError::Disconnected) => {}
            }
            self.writing = None;
        }
        if !is_changed {
            if self.written.take().is_some() {
                // The project is saved in its own file now.
                forget(&self.slot);
            }
            return;
        }
        if self.written == Some(revision) || self.last.elapsed() < INTERVAL {
            return;
        }
        self.last = Instant::now();
        let (project, slot, origin) = (project.clone(), self.slot.clone(), origin.map(Path::to_owned));
        let work = move || write(&project, &slot, origin.as_deref()).map_err(|error| error.to_string());
        self.writing = Some((in_background(ctx.clone(), work), revision));
    }

    /// Deletes the slot's files, which belong to the previous project.
    pub(crate) fn restart(&mut self) {
        if let Some((receiver, _)) = self.writing.take() {
            // A pending write must not finish after the files are deleted.
            let _ = receiver.recv();
        }
        forget(&self.slot);
        self.written = None;
    }

    /// Whether the slot contains a state of the project.
    pub(crate) fn has_written(&self) -> bool {
        self.written.is_some()
    }

    /// Error of the last write; it is returned once.
    pub(crate) fn take_failure(&mut self) -> Option<String> {
        self.failure.take()
    }
}

impl Drop for Recovery {
    fn drop(&mut self) {
        if let Some((receiver, _)) = self.writing.take() {
            // A pending write must not finish after the files are deleted.
            let _ = receiver.recv();
        }
        forget(&self.slot);
        // A remaining lock file is unlocked, and the next window deletes it.
        let _ = fs::remove_file(self.slot.with_extension(LOCK));
    }
}

impl Leftover {
    /// Path of the recovery file.
    pub fn path(&self) -> PathBuf {
        self.slot.with_extension(EXTENSION)
    }

    /// Deletes the recovery files.
    pub fn discard(self) {
        forget(&self.slot);
        let _ = fs::remove_file(self.slot.with_extension(LOCK));
    }
}

/// Leftovers of ended programs in `folder`, newest first.
pub fn leftovers(folder: &Path) -> Vec<Leftover> {
    // The folder may not exist yet.
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut found: Vec<Leftover> = paths.filter_map(|path| leftover(&path)).collect();
    found.sort_by_key(|leftover| std::cmp::Reverse(leftover.written));
    found
}

fn leftover(lock_path: &Path) -> Option<Leftover> {
    if lock_path.extension()? != LOCK {
        return None;
    }
    let lock = File::options().write(true).open(lock_path).ok()?;
    lock.try_lock().ok()?;
    let slot = lock_path.with_extension("");
    let Ok(metadata) = fs::metadata(slot.with_extension(EXTENSION)) else {
        // The program ended without unsaved changes.
        let _ = fs::remove_file(lock_path);
        return None;
    };
    let origin = fs::read_to_string(slot.with_extension(ORIGIN)).ok().filter(|path| !path.is_empty());
    let written = metadata.modified().unwrap_or(UNIX_EPOCH);
    Some(Leftover { slot, _lock: lock, origin: origin.map(PathBuf::from), written })
}

fn write(project: &Project, slot: &Path, origin: Option<&Path>) -> Result<(), atomic::WriteError> {
    // With an empty folder, library paths are written as absolute paths.
    let bytes = write_project(project, Path::new(""), CREATED_BY);
    let origin = origin.map(|path| path.to_string_lossy().into_owned()).unwrap_or_default();
    atomic::write_all(&[
        (&slot.with_extension(EXTENSION), &bytes),
        (&slot.with_extension(ORIGIN), origin.as_bytes()),
    ])
}

/// Deletes the files of a slot, if they exist.
fn forget(slot: &Path) {
    for extension in [EXTENSION, ORIGIN] {
        let _ = fs::remove_file(slot.with_extension(extension));
    }
}

#[cfg(test)]
mod tests {
    use super::{Recovery, leftovers, write};
    use shagreen_formats::built_in::BuiltIn;
    use shagreen_formats::project::{Project, ProjectLibrary, read_project};
    use std::path::Path;

    fn project() -> Project {
        Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "Oak copy")
    }

    #[test]
    fn what_a_living_window_holds_is_its_own_and_what_a_dead_one_left_is_found() {
        let folder = tempfile::tempdir().unwrap();
        let at = folder.path().join("recovery");
        assert!(leftovers(&at).is_empty());
        let slot = Recovery::new(&at).unwrap();
        write(&project(), &slot.slot, Some(Path::new("/somewhere/Woods.shagreen"))).unwrap();
        assert!(leftovers(&at).is_empty(), "its window lives");
        // Simulates a kill: the lock is released and the files remain.
        let path = slot.slot.clone();
        let copies = ["shagreen", "origin", "lock"].map(|extension| {
            let file = path.with_extension(extension);
            (std::fs::read(&file).unwrap(), file)
        });
        drop(slot);
        assert_eq!(std::fs::read_dir(&at).unwrap().count(), 0, "closed in peace, nothing stays");
        for (bytes, file) in copies {
            std::fs::write(file, bytes).unwrap();
        }
        let found = leftovers(&at);
        assert_eq!(found.len(), 1);
        assert!(leftovers(&at).is_empty(), "it is offered once");
        assert_eq!(found[0].origin.as_deref(), Some(Path::new("/somewhere/Woods.shagreen")));
        let bytes = std::fs::read(found[0].path()).unwrap();
        let read = read_project(&bytes, Path::new("/"), &|_| Err(std::io::ErrorKind::NotFound.into()));
        assert_eq!(read.unwrap().value, project());
        for left in found {
            left.discard();
        }
        assert_eq!(std::fs::read_dir(&at).unwrap().count(), 0);
    }

    #[test]
    fn a_lock_without_a_project_is_swept_away() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("1-2.lock"), "").unwrap();
        std::fs::write(folder.path().join("other.txt"), "").unwrap();
        assert!(leftovers(folder.path()).is_empty());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
