//! Writing files whole or not at all: to a new file in the same folder, to the disk, then by renaming.

use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// Why a file was not written. What was there before is untouched.
#[derive(Debug, thiserror::Error)]
#[error("cannot write the file ({source}); check that its folder exists, is writable and has room: {}", path.display())]
pub struct WriteError {
    /// The file.
    pub path: PathBuf,
    /// What the system says.
    #[source]
    pub source: io::Error,
}

/// Writes `bytes` to `path`, replacing a file that is there.
///
/// # Errors
/// [`WriteError`]; then a file that was there still is, as it was.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    write_all(&[(path, bytes)])
}

/// Writes several files of which none makes sense without the others, replacing those that are there.
///
/// All of them are on the disk under other names before the first takes its place. Where a later one cannot take its
/// place, the earlier ones are put back as they were.
///
/// # Errors
/// [`WriteError`] for the first file that could not be written; then all files are as they were.
pub fn write_all(files: &[(&Path, &[u8])]) -> Result<(), WriteError> {
    let staged: Vec<NamedTempFile> =
        files.iter().map(|(path, bytes)| stage(path, bytes)).collect::<Result<_, _>>()?;
    let mut before: Vec<(&Path, Option<Vec<u8>>)> = Vec::new();
    for (file, (path, _)) in staged.into_iter().zip(files) {
        // A single file needs no copy of what it replaces: nothing can fail after it.
        let old = if files.len() > 1 { std::fs::read(path).ok() } else { None }; // Not readable: not there before.
        if let Err(error) = file.persist(path) {
            put_back(before);
            return Err(WriteError { path: path.to_path_buf(), source: error.error });
        }
        before.push((path, old));
    }
    Ok(())
}

/// The bytes on the disk, in the folder of `path`, under another name that goes away unless it is persisted.
fn stage(path: &Path, bytes: &[u8]) -> Result<NamedTempFile, WriteError> {
    let failed = |source| WriteError { path: path.to_path_buf(), source };
    if path.is_dir() {
        return Err(failed(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder")));
    }
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        // A file like any other, as the person's umask has it; the default is for secrets.
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    // The system's own words would name a file that nobody asked for.
    let unnamed = |error: io::Error| failed(io::Error::from(error.kind()));
    let mut file = builder.prefix(".shagreen-").tempfile_in(folder).map_err(unnamed)?;
    file.write_all(bytes).map_err(failed)?;
    file.as_file().sync_all().map_err(failed)?;
    Ok(file)
}

fn put_back(before: Vec<(&Path, Option<Vec<u8>>)>) {
    for (path, old) in before {
        // The error that led here is the one to report; this is the best that can be done about it.
        let _ = match old {
            Some(bytes) => stage(path, &bytes).is_ok_and(|file| file.persist(path).is_ok()),
            None => std::fs::remove_file(path).is_ok(),
        };
    }
}

#[cfg(test)]
mod tests {
    use super::{write, write_all};
    use std::fs;

    fn names(folder: &std::path::Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn replaces_and_leaves_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write(&path, b"old").unwrap();
        write(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_failure_leaves_everything_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let (a, b, taken) =
            (folder.path().join("a"), folder.path().join("none/b"), folder.path().join("taken"));
        fs::write(&a, b"old").unwrap();
        fs::create_dir(&taken).unwrap();
        for other in [&b, &taken] {
            let error = write_all(&[(&a, b"new"), (other, b"new")]).unwrap_err();
            assert_eq!(&error.path, other);
            assert_eq!(fs::read(&a).unwrap(), b"old");
            assert_eq!(names(folder.path()), ["a", "taken"]);
        }
    }

    #[test]
    fn files_that_took_their_place_are_put_back() {
        let folder = tempfile::tempdir().unwrap();
        let (old, fresh) = (folder.path().join("old"), folder.path().join("fresh"));
        fs::write(&old, b"now").unwrap();
        fs::write(&fresh, b"now").unwrap();
        super::put_back(vec![(&old, Some(b"before".to_vec())), (&fresh, None)]);
        assert_eq!(fs::read(&old).unwrap(), b"before");
        assert_eq!(names(folder.path()), ["old"]);
    }

    #[cfg(unix)]
    #[test]
    fn files_are_as_open_as_any_other() {
        use std::os::unix::fs::PermissionsExt as _;
        let folder = tempfile::tempdir().unwrap();
        let (ours, theirs) = (folder.path().join("ours"), folder.path().join("theirs"));
        write(&ours, b"x").unwrap();
        fs::write(&theirs, b"x").unwrap();
        let mode = |path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&ours), mode(&theirs));
    }
}
