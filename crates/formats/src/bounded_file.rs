//! Reading of whole files: regular files only, up to a size that depends on their kind.
//!
//! A project may name any path as its library, and a user may drop anything on the window. Reading a device such as
//! `/dev/zero` would fill the memory, and opening a pipe would wait forever.

use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, ErrorKind, Read as _};
use std::path::Path;

/// Kind of a file, which limits its size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// Settings, profiles, column maps, descriptors, sidecars.
    Small,
    /// Tables of judgments, positions or profiles, and texts with pen reports.
    Table,
    /// Photos.
    Picture,
    /// Projects, libraries and reports.
    Document,
    /// Recordings, signals and strokes.
    Recording,
    /// Networks, their training states and training data.
    Network,
}

impl FileKind {
    /// Largest file of this kind, in bytes.
    pub const fn max_bytes(self) -> u64 {
        const MIB: u64 = 1 << 20;
        match self {
            Self::Small => 4 * MIB,
            Self::Table => 64 * MIB,
            Self::Picture => 128 * MIB,
            Self::Document => 512 * MIB,
            Self::Recording => 2048 * MIB,
            Self::Network => 16 * 1024 * MIB,
        }
    }
}

/// Returns the bytes of a regular file.
///
/// # Errors
/// - [`ErrorKind::IsADirectory`] for a folder, [`ErrorKind::InvalidInput`] for a pipe, device or socket.
/// - [`ErrorKind::FileTooLarge`] for a file above [`FileKind::max_bytes`].
/// - Any error of the system.
pub fn read(path: &Path, kind: FileKind) -> io::Result<Vec<u8>> {
    read_open(&open(path)?, kind)
}

/// Returns the bytes of an open regular file from its position to its end.
///
/// # Errors
/// As [`read`].
pub fn read_open(file: &File, kind: FileKind) -> io::Result<Vec<u8>> {
    let n_bytes = file.metadata()?.len();
    let mut bytes = Vec::new();
    if n_bytes <= kind.max_bytes() {
        bytes.try_reserve_exact(n_bytes as usize)?;
        // A file may grow while it is read.
        file.take(kind.max_bytes() + 1).read_to_end(&mut bytes)?;
    }
    if n_bytes.max(bytes.len() as u64) > kind.max_bytes() {
        let (size, most) = (n_bytes >> 20, kind.max_bytes() >> 20);
        let reason = format!("the file has {size} MiB, but files of this kind may have at most {most} MiB");
        return Err(io::Error::new(ErrorKind::FileTooLarge, reason));
    }
    Ok(bytes)
}

/// Opens a regular file for reading. It does not wait for a pipe.
///
/// # Errors
/// As [`read`], except for the size.
pub fn open(path: &Path) -> io::Result<File> {
    open_with(OpenOptions::new().read(true), path)
}

/// Opens a regular file to lock it; some network file systems lock only files that are open for writing.
///
/// # Errors
/// As [`open`].
pub fn open_to_lock(path: &Path) -> io::Result<File> {
    open_with(OpenOptions::new().read(true).write(true), path).or_else(|_| open(path))
}

/// Opens a regular file to read it and to append to it. Nothing in it can be overwritten.
///
/// # Errors
/// As [`open`].
pub fn open_to_append(path: &Path) -> io::Result<File> {
    open_with(OpenOptions::new().read(true).append(true), path)
}

/// Creates a file to append to.
///
/// # Errors
/// [`ErrorKind::AlreadyExists`] if there is anything at the path, else any error of the system.
pub fn create_to_append(path: &Path) -> io::Result<File> {
    OpenOptions::new().read(true).append(true).create_new(true).open(path)
}

/// Opens a folder to lock it. Nothing is read from it.
///
/// # Errors
/// The folder does not exist or cannot be opened; on Windows, no folder can.
pub fn open_folder_to_lock(path: &Path) -> io::Result<File> {
    let folder = File::open(path)?;
    if folder.metadata()?.is_dir() {
        return Ok(folder);
    }
    Err(io::Error::new(ErrorKind::NotADirectory, "it is a file, not a folder"))
}

fn open_with(options: &mut OpenOptions, path: &Path) -> io::Result<File> {
    // Before opening, because Windows reports a folder as one without permission.
    check(&std::fs::metadata(path)?)?;
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(
        options,
        rustix::fs::OFlags::NONBLOCK.bits().cast_signed(),
    );
    let file = options.open(path)?;
    check(&file.metadata()?)?;
    Ok(file)
}

fn check(metadata: &Metadata) -> io::Result<()> {
    if metadata.is_dir() {
        return Err(io::Error::new(ErrorKind::IsADirectory, "it is a folder, not a file"));
    }
    if !metadata.is_file() {
        return Err(io::Error::new(ErrorKind::InvalidInput, "it is a pipe or a device, not a file"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{FileKind, read};
    use std::io::ErrorKind;

    #[test]
    fn a_regular_file_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        std::fs::write(&path, b"hello").unwrap();
        assert_eq!(read(&path, FileKind::Small).unwrap(), b"hello");
        assert_eq!(read(folder.path(), FileKind::Small).unwrap_err().kind(), ErrorKind::IsADirectory);
        assert_eq!(read(&folder.path().join("b"), FileKind::Small).unwrap_err().kind(), ErrorKind::NotFound);
    }

    #[test]
    fn a_file_that_is_too_large_is_not_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let file = std::fs::File::create(&path).unwrap();
        file.set_len(FileKind::Small.max_bytes()).unwrap();
        assert_eq!(read(&path, FileKind::Small).unwrap().len() as u64, FileKind::Small.max_bytes());
        file.set_len(FileKind::Small.max_bytes() + (1 << 20)).unwrap();
        let error = read(&path, FileKind::Small).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::FileTooLarge);
        assert!(
            error.to_string().contains("5 MiB") && error.to_string().contains("at most 4 MiB"),
            "{error}"
        );
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn devices_and_pipes_are_refused_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        rustix::fs::mkfifoat(rustix::fs::CWD, &pipe, rustix::fs::Mode::RUSR).unwrap();
        let link = folder.path().join("link");
        std::os::unix::fs::symlink("/dev/zero", &link).unwrap();
        for path in [pipe.as_path(), link.as_path(), std::path::Path::new("/dev/zero")] {
            let error = read(path, FileKind::Network).unwrap_err();
            assert!(error.to_string().contains("pipe or a device"), "{error}");
        }
    }
}
