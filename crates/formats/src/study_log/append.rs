//! Writer of logs: appends whole lines, and never changes what is there.

use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::header::header_lines;
use super::line::LineV1;
use super::{LogHeader, ReadLog, ReadLogError, TimedEvent, read_study_log};
use crate::bounded_file::{self, FileKind};

/// Why an event is not in a log.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LogError {
    /// There is a file already.
    #[error("there is a file already; resume its session, or choose another name: {}", .path.display())]
    Exists {
        /// Path of the log.
        path: PathBuf,
    },
    /// Another session has the log.
    #[error("another session uses this log; end it first: {}", .path.display())]
    InUse {
        /// Path of the log.
        path: PathBuf,
    },
    /// Another program has changed the log.
    #[error(
        "another program has changed the log since it was opened; resume the session, so that nothing is lost: {}",
        .path.display()
    )]
    Changed {
        /// Path of the log.
        path: PathBuf,
    },
    /// The log cannot be written.
    #[error("the answer is not saved ({source}); make sure that the disk has space, and try again: {}", .path.display())]
    NotSaved {
        /// Path of the log.
        path: PathBuf,
        /// The error of the operating system.
        #[source]
        source: io::Error,
    },
    /// The log cannot be opened.
    #[error("cannot open the log ({source}): {}", .path.display())]
    NotOpened {
        /// Path of the log.
        path: PathBuf,
        /// The error of the operating system.
        #[source]
        source: io::Error,
    },
    /// The log cannot be read.
    #[error("{source}: {}", .path.display())]
    NotRead {
        /// Path of the log.
        path: PathBuf,
        /// What is wrong.
        #[source]
        source: ReadLogError,
    },
}

/// The log of a running session. It is locked until this is dropped.
#[derive(Debug)]
pub struct StudyLog {
    path: PathBuf,
    lines: Lines<File>,
}

impl StudyLog {
    /// Creates the log of a new session, with its first line and the copy of it.
    ///
    /// # Errors
    /// [`LogError::Exists`] if there is a file; [`LogError::NotOpened`] and [`LogError::NotSaved`] if the file cannot be
    /// created, which leaves none.
    pub fn create(path: &Path, header: &LogHeader) -> Result<Self, LogError> {
        let file = bounded_file::create_to_append(path).map_err(|source| match source.kind() {
            ErrorKind::AlreadyExists => LogError::Exists { path: path.to_owned() },
            _ => LogError::NotOpened { path: path.to_owned(), source },
        })?;
        lock(&file, path)?;
        let mut lines = Lines { storage: file, n_bytes: 0, is_torn: false };
        let appended = header_lines(header).iter().try_for_each(|line| lines.append(line));
        if let Err(error) = appended {
            // Nothing is answered yet, and a log without its first line could not be resumed.
            fs::remove_file(path).ok();
            return Err(error.at(path));
        }
        sync_folder(path);
        Ok(Self { path: path.to_owned(), lines })
    }

    /// Opens the log of a session to go on with it, and reads it. A torn last line stays; what follows begins a new line.
    ///
    /// # Errors
    /// [`LogError::InUse`] if a session runs on it; [`LogError::NotOpened`] and [`LogError::NotRead`].
    pub fn resume(path: &Path) -> Result<(Self, ReadLog), LogError> {
        let not_opened = |source| LogError::NotOpened { path: path.to_owned(), source };
        let file = bounded_file::open_to_append(path).map_err(not_opened)?;
        lock(&file, path)?;
        let bytes = bounded_file::read_open(&file, FileKind::Table).map_err(not_opened)?;
        let read =
            read_study_log(&bytes).map_err(|source| LogError::NotRead { path: path.to_owned(), source })?;
        let is_torn = bytes.last().is_some_and(|last| *last != b'\n');
        let lines = Lines { storage: file, n_bytes: bytes.len() as u64, is_torn };
        Ok((Self { path: path.to_owned(), lines }, read))
    }

    /// Path of the log.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Appends an event, and returns when it is on the disk.
    ///
    /// # Errors
    /// [`LogError::NotSaved`], for example if the disk is full: nothing before is lost, and the same event can be appended
    /// again. [`LogError::Changed`] if another program has written to the log.
    pub fn append(&mut self, event: &TimedEvent) -> Result<(), LogError> {
        // Keys are strings, and numbers that are not finite become null.
        let line = serde_json::to_vec(&LineV1::from(event)).unwrap_or_default();
        self.lines.append(&line).map_err(|error| error.at(&self.path))
    }
}

/// Locks the file until it is closed.
fn lock(file: &File, path: &Path) -> Result<(), LogError> {
    match file.try_lock() {
        // A file system without locks still allows the comparison of the length.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
        Err(TryLockError::WouldBlock) => Err(LogError::InUse { path: path.to_owned() }),
    }
}

/// Makes the name of a new file survive a power failure.
fn sync_folder(path: &Path) {
    // Some file systems cannot sync a folder, and Windows cannot open one, so an error is ignored.
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    bounded_file::open_folder_to_lock(folder).and_then(|folder| folder.sync_all()).ok();
}

/// Where lines are appended.
trait Storage: Write {
    /// Number of bytes that are stored.
    fn n_bytes(&self) -> io::Result<u64>;

    /// Waits until all bytes are on the disk.
    fn sync(&self) -> io::Result<()>;
}

impl Storage for File {
    fn n_bytes(&self) -> io::Result<u64> {
        Ok(self.metadata()?.len())
    }

    fn sync(&self) -> io::Result<()> {
        self.sync_data()
    }
}

/// Lines in a storage, of which the last one may be torn.
#[derive(Debug)]
struct Lines<S> {
    storage: S,
    /// Number of bytes after the last append.
    n_bytes: u64,
    /// Whether the last line has no line break.
    is_torn: bool,
}

/// Why a line was not appended.
#[derive(Debug)]
enum AppendError {
    Changed,
    Io(io::Error),
}

impl AppendError {
    fn at(self, path: &Path) -> LogError {
        let path = path.to_owned();
        match self {
            Self::Changed => LogError::Changed { path },
            Self::Io(source) => LogError::NotSaved { path, source },
        }
    }
}

impl<S: Storage> Lines<S> {
    /// Appends a line without its line break.
    fn append(&mut self, line: &[u8]) -> Result<(), AppendError> {
        if self.storage.n_bytes().map_err(AppendError::Io)? != self.n_bytes {
            return Err(AppendError::Changed);
        }
        let mut bytes = Vec::with_capacity(line.len() + 2);
        if self.is_torn {
            bytes.push(b'\n');
        }
        bytes.extend_from_slice(line);
        bytes.push(b'\n');
        let written = self.storage.write_all(&bytes).and_then(|()| self.storage.sync());
        // If the length is unknown, the next append finds out.
        self.n_bytes = self.storage.n_bytes().unwrap_or(self.n_bytes + bytes.len() as u64);
        // After an error, some of the line may be there.
        self.is_torn = written.is_err();
        written.map_err(AppendError::Io)
    }
}

#[cfg(test)]
mod tests {
    use std::io::{self, ErrorKind, Write};

    use super::{AppendError, Lines, Storage};

    /// A disk with so many bytes of space.
    struct Disk {
        bytes: Vec<u8>,
        space: usize,
        can_sync: bool,
    }

    impl Write for Disk {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let n = bytes.len().min(self.space - self.bytes.len());
            if n == 0 {
                return Err(ErrorKind::StorageFull.into());
            }
            self.bytes.extend_from_slice(&bytes[..n]);
            Ok(n)
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    impl Storage for Disk {
        fn n_bytes(&self) -> io::Result<u64> {
            Ok(self.bytes.len() as u64)
        }

        fn sync(&self) -> io::Result<()> {
            if self.can_sync { Ok(()) } else { Err(ErrorKind::StorageFull.into()) }
        }
    }

    fn on(space: usize) -> Lines<Disk> {
        Lines { storage: Disk { bytes: Vec::new(), space, can_sync: true }, n_bytes: 0, is_torn: false }
    }

    #[test]
    fn a_full_disk_tears_one_line_and_the_next_one_is_whole() {
        let mut lines = on(12);
        lines.append(b"first").unwrap();
        assert!(
            matches!(lines.append(b"second"), Err(AppendError::Io(error)) if error.kind() == ErrorKind::StorageFull)
        );
        // Part of it is there, and there it stays.
        assert_eq!(lines.storage.bytes, b"first\nsecond");
        assert!(lines.append(b"second").is_err(), "the disk is still full");
        lines.storage.space = 100;
        lines.append(b"second").unwrap();
        lines.append(b"third").unwrap();
        assert_eq!(lines.storage.bytes, b"first\nsecond\nsecond\nthird\n");
    }

    #[test]
    fn a_line_that_may_not_be_on_the_disk_is_not_saved() {
        let mut lines = on(100);
        lines.storage.can_sync = false;
        assert!(lines.append(b"first").is_err());
        lines.storage.can_sync = true;
        lines.append(b"first").unwrap();
        // The empty line means nothing, and of equal lines the first one counts.
        assert_eq!(lines.storage.bytes, b"first\n\nfirst\n");
    }

    #[test]
    fn lines_of_another_program_are_not_mixed_with_ours() {
        let mut lines = on(100);
        lines.append(b"first").unwrap();
        lines.storage.bytes.extend_from_slice(b"other\n");
        assert!(matches!(lines.append(b"second"), Err(AppendError::Changed)));
        assert_eq!(lines.storage.bytes, b"first\nother\n");
    }
}
