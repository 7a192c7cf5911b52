//! Recovery after a crash: the project is written to a recovery folder every few seconds, and the next program start
//! offers it.
//!
//! Each window has a slot: a uniquely named project file and a lock file. The system releases the lock when the program
//! ends in any way. A slot with a released lock is a leftover, and its project is offered. A window that closes
//! normally deletes its slot.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use egui::Context;
use shagreen_formats::atomic;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::project::{EXTENSION, Project, write_project};

use crate::state::background::in_background;
use crate::state::document::{CREATED_BY, DocumentFile};

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
    /// Project file, if the project had one.
    pub origin: Option<DocumentFile>,
    /// Time of the last write.
    pub written: SystemTime,
}

impl Recovery {
    /// Creates a slot in `folder`, and the folder if necessary.
    ///
    /// # Errors
    /// The folder cannot be created or written to, or its file system does not support locks.
    pub fn new(folder: &Path) -> io::Result<Self> {
        create_private(folder)?;
        let slot = new_slot(folder);
        let lock = private().create_new(true).open(slot.with_extension(LOCK))?;
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
        origin: Option<&DocumentFile>,
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
        let (project, slot, origin) = (project.clone(), self.slot.clone(), origin.cloned());
        let work = move || write(&project, &slot, origin.as_ref()).map_err(|error| error.to_string());
        self.writing = Some((in_background(ctx.clone(), work), revision));
    }

    /// Writes a copy of the project into a slot that no window owns; the next window offers it.
    ///
    /// # Errors
    /// The files cannot be written.
    pub(crate) fn keep_aside(&self, project: &Project, origin: Option<&DocumentFile>) -> io::Result<()> {
        let slot = new_slot(self.slot.parent().unwrap_or(Path::new(".")));
        write(project, &slot, origin).map_err(|error| error.source)?;
        private().create_new(true).open(slot.with_extension(LOCK)).map(drop)
    }

    /// Writes the project at once.
    #[cfg(test)]
    pub(crate) fn write_now(&mut self, project: &Project, origin: Option<&DocumentFile>) {
        write(project, &self.slot, origin).unwrap();
    }

    /// Ends as a killed program does: the lock is released, and the files remain.
    #[cfg(test)]
    pub(crate) fn crash(self) {
        let files = [EXTENSION, ORIGIN, LOCK].map(|ending| self.slot.with_extension(ending));
        let kept = files.map(|file| (bounded_file::read(&file, FileKind::Document).ok(), file));
        drop(self);
        for (bytes, file) in kept {
            if let Some(bytes) = bytes {
                fs::write(file, bytes).unwrap();
            }
        }
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
    // A pipe in place of the lock must not block the start.
    let lock = bounded_file::open_to_lock(lock_path).ok()?;
    lock.try_lock().ok()?;
    let slot = lock_path.with_extension("");
    let Ok(metadata) = fs::metadata(slot.with_extension(EXTENSION)) else {
        // The program ended without unsaved changes.
        let _ = fs::remove_file(lock_path);
        return None;
    };
    let origin = bounded_file::read(&slot.with_extension(ORIGIN), FileKind::Small).ok();
    let written = metadata.modified().unwrap_or(UNIX_EPOCH);
    Some(Leftover { slot, _lock: lock, origin: origin.and_then(|bytes| origin_in(&bytes)), written })
}

/// Name of a slot that does not exist yet.
fn new_slot(folder: &Path) -> PathBuf {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    folder.join(format!("{}-{}-{count}", now.as_nanos(), std::process::id()))
}

/// Creates a folder that only this user may enter: projects may be confidential.
fn create_private(folder: &Path) -> io::Result<()> {
    let mut builder = fs::DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(folder)?;
    #[cfg(unix)]
    {
        // A folder of an earlier version may be open to others.
        use std::os::unix::fs::PermissionsExt as _;
        fs::set_permissions(folder, fs::Permissions::from_mode(0o700))?;
    }
    Ok(())
}

/// Options of a new file that only this user may read.
fn private() -> OpenOptions {
    let mut options = OpenOptions::new();
    options.write(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options
}

/// Content of the file that names the project file: its SHA-256, a line break, and the bytes of its path.
fn origin_bytes(origin: &DocumentFile) -> Vec<u8> {
    let mut bytes = origin.sha256.clone().unwrap_or_default().into_bytes();
    bytes.push(b'\n');
    bytes.extend_from_slice(origin.path.as_os_str().as_encoded_bytes());
    bytes
}

/// Project file that [`origin_bytes`] describes. Earlier versions wrote the path alone.
fn origin_in(bytes: &[u8]) -> Option<DocumentFile> {
    let (sha256, path) = match bytes.iter().position(|byte| *byte == b'\n') {
        Some(end) => {
            (std::str::from_utf8(&bytes[..end]).ok().filter(|hash| !hash.is_empty()), &bytes[end + 1..])
        }
        None => (None, bytes),
    };
    #[cfg(unix)]
    let path = PathBuf::from(std::os::unix::ffi::OsStrExt::from_bytes(path) as &std::ffi::OsStr);
    #[cfg(not(unix))]
    let path = PathBuf::from(std::str::from_utf8(path).ok()?);
    (!path.as_os_str().is_empty()).then(|| DocumentFile { path, sha256: sha256.map(str::to_owned) })
}

fn write(project: &Project, slot: &Path, origin: Option<&DocumentFile>) -> Result<(), atomic::WriteError> {
    // With an empty folder, library paths are written as absolute paths.
    let bytes = write_project(project, Path::new(""), CREATED_BY);
    let origin = origin.map(origin_bytes).unwrap_or_default();
    atomic::write_private(&[
        (&slot.with_extension(EXTENSION), &bytes),
        (&slot.with_extension(ORIGIN), &origin),
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
    use super::{DocumentFile, Recovery, leftovers, origin_bytes, origin_in, write};
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
        let origin = DocumentFile { path: "/somewhere/Woods.shagreen".into(), sha256: Some("ab".to_owned()) };
        write(&project(), &slot.slot, Some(&origin)).unwrap();
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
        assert_eq!(found[0].origin, Some(origin));
        let bytes = std::fs::read(found[0].path()).unwrap();
        let read = read_project(&bytes, Path::new("/"), &|_| Err(std::io::ErrorKind::NotFound.into()));
        assert_eq!(read.unwrap().value, project());
        for left in found {
            left.discard();
        }
        assert_eq!(std::fs::read_dir(&at).unwrap().count(), 0);
    }

    #[test]
    fn a_copy_that_is_kept_aside_is_offered() {
        let folder = tempfile::tempdir().unwrap();
        let at = folder.path().join("recovery");
        let slot = Recovery::new(&at).unwrap();
        slot.keep_aside(&project(), None).unwrap();
        let found = leftovers(&at);
        assert_eq!((found.len(), found[0].origin.clone()), (1, None));
    }

    #[cfg(unix)]
    #[test]
    fn only_the_user_may_read_what_is_kept() {
        use std::os::unix::fs::PermissionsExt as _;
        let folder = tempfile::tempdir().unwrap();
        let at = folder.path().join("recovery");
        let slot = Recovery::new(&at).unwrap();
        slot.keep_aside(&project(), None).unwrap();
        let mode = |path: &Path| std::fs::metadata(path).unwrap().permissions().mode() & 0o777;
        assert_eq!(mode(&at), 0o700);
        for entry in std::fs::read_dir(&at).unwrap() {
            assert_eq!(mode(&entry.unwrap().path()), 0o600);
        }
    }

    #[test]
    fn the_project_file_is_named_in_bytes() {
        let named = |path: &str, sha256: Option<&str>| DocumentFile {
            path: path.into(),
            sha256: sha256.map(str::to_owned),
        };
        for origin in [named("/a/ä.shagreen", Some("00ff")), named("/a\nb", None)] {
            assert_eq!(origin_in(&origin_bytes(&origin)), Some(origin));
        }
        assert_eq!(origin_in(b"/old.shagreen"), Some(named("/old.shagreen", None)));
        assert_eq!((origin_in(b""), origin_in(b"\n")), (None, None));
        #[cfg(unix)]
        {
            use std::os::unix::ffi::OsStrExt as _;
            let path = std::path::PathBuf::from(std::ffi::OsStr::from_bytes(b"/a/\xff.shagreen"));
            let origin = DocumentFile { path, sha256: None };
            assert_eq!(origin_in(&origin_bytes(&origin)), Some(origin));
        }
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
