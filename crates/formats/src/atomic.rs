//! Atomic file writing: write a temporary file in the same folder, flush it to disk, then rename it.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, SystemTime};

use tempfile::{NamedTempFile, TempPath};

/// Why a file was not written. The previous file is unchanged.
#[derive(Debug, thiserror::Error)]
#[error("cannot write the file ({source}); check that its folder exists, is writable and has free space: {}", path.display())]
pub struct WriteError {
    /// Path of the file.
    pub path: PathBuf,
    /// The error of the operating system.
    #[source]
    pub source: io::Error,
}

/// Writes `bytes` to `path`, replacing an existing file.
///
/// # Errors
/// [`WriteError`]; an existing file is then unchanged.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    write_all(&[(path, bytes)])
}

/// Writes several files that belong together, replacing existing ones.
///
/// All files are on disk under temporary names before the first is renamed. If renaming a later file fails, the earlier
/// ones are restored.
///
/// If the process is killed halfway, every file is complete, either old or new. A hidden temporary file may remain next
/// to it.
///
/// Symbolic links are followed: the target is replaced, and the link stays. A path that is a folder, device or pipe is
/// an error and is left unchanged.
///
/// # Errors
/// [`WriteError`] for the first file that could not be written; all files are then unchanged.
pub fn write_all(files: &[(&Path, &[u8])]) -> Result<(), WriteError> {
    replace(stage_all(files, Access::Usual)?)
}

/// Same as [`write_all`], but only this user may read the files.
///
/// # Errors
/// As [`write_all`].
pub fn write_private(files: &[(&Path, &[u8])]) -> Result<(), WriteError> {
    replace(stage_all(files, Access::Private)?)
}

/// Who may read a new file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Access {
    /// As the user's umask permits.
    Usual,
    /// This user.
    Private,
}

/// Checks whether [`write_all`] could write these files now, as far as possible without replacing one. Call it before
/// work that cannot be repeated.
///
/// # Errors
/// [`WriteError`] for the first file that could not be written.
pub fn check_all(paths: &[&Path]) -> Result<(), WriteError> {
    let files: Vec<(&Path, &[u8])> = paths.iter().map(|path| (*path, &[][..])).collect();
    stage_all(&files, Access::Usual).map(drop)
}

/// Writes all files under temporary names.
fn stage_all<'a>(files: &[(&'a Path, &[u8])], access: Access) -> Result<Vec<Staged<'a>>, WriteError> {
    let mut staged: Vec<Staged<'_>> = Vec::with_capacity(files.len());
    for (path, bytes) in files {
        let file =
            stage(path, bytes, access).map_err(|source| WriteError { path: path.to_path_buf(), source })?;
        if let Some(twin) = staged.iter().find(|other| other.target == file.target) {
            let reason =
                format!("it is the same file as {}, which is also being written", twin.path.display());
            let source = io::Error::new(io::ErrorKind::InvalidInput, reason);
            return Err(WriteError { path: path.to_path_buf(), source });
        }
        staged.push(file);
    }
    Ok(staged)
}

/// A file on disk under a temporary name, in its final folder.
struct Staged<'a> {
    /// The path that the caller gave.
    path: &'a Path,
    /// The file to replace, after following all links.
    target: PathBuf,
    /// The new bytes; the temporary file is deleted unless it is renamed.
    file: NamedTempFile,
}

/// Writes the bytes to a temporary file in the folder of the target of `path`.
fn stage<'a>(path: &'a Path, bytes: &[u8], access: Access) -> io::Result<Staged<'a>> {
    let target = behind_links(path)?;
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        // The usual file mode under the user's umask; the default of `tempfile` is private to the user.
        use std::os::unix::fs::PermissionsExt as _;
        builder.permissions(fs::Permissions::from_mode(if access == Access::Private {
            0o600
        } else {
            0o666
        }));
    }
    sweep(folder_of(&target));
    let file = builder.prefix(PREFIX).tempfile_in(folder_of(&target)).map_err(|error| unnamed(&error))?;
    // Written to the inner file, whose errors do not name the temporary file.
    file.as_file().write_all(bytes)?;
    file.as_file().sync_all()?;
    Ok(Staged { path, target, file })
}

/// Prefix of temporary file names.
const PREFIX: &str = ".shagreen-";
/// Maximum number of links to follow: the limit of Linux.
const MAX_LINKS: usize = 40;

/// Resolves a path to the file that it means, which may not exist yet.
fn behind_links(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_path_buf();
    for _ in 0..MAX_LINKS {
        match fs::metadata(&path) {
            Ok(found) if found.is_file() => return fs::canonicalize(&path),
            Ok(found) if found.is_dir() => {
                return Err(io::Error::new(io::ErrorKind::IsADirectory, "the path is a folder"));
            }
            Ok(_) => {
                let reason = "the path is a device or a pipe, which cannot be replaced by a file";
                return Err(io::Error::new(io::ErrorKind::InvalidInput, reason));
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(error) => return Err(error),
        }
        // The path does not exist, or is a link to a missing file.
        match fs::read_link(&path) {
            Ok(next) => path = folder_of(&path).join(next),
            Err(_) => return Ok(in_real_folder(&path)),
        }
    }
    Err(io::Error::new(io::ErrorKind::InvalidInput, "the path leads through too many symbolic links"))
}

/// Path of a file that does not exist yet, in its folder without links and detours: `a` and `./a` are one file.
fn in_real_folder(path: &Path) -> PathBuf {
    match (fs::canonicalize(folder_of(path)), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        // Writing the file reports a folder that does not exist.
        _ => path.to_owned(),
    }
}

/// Age from which a temporary file counts as left behind by a process that was killed.
const STALE: Duration = Duration::from_hours(1);

/// Deletes temporary files that killed processes left in a folder. A process does this once for each folder.
fn sweep(folder: &Path) {
    static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    let mut swept = SWEPT.lock().unwrap_or_else(PoisonError::into_inner);
    if swept.insert(folder.to_owned()) {
        sweep_older(folder, STALE);
    }
}

fn sweep_older(folder: &Path, age: Duration) {
    // A folder that cannot be read is not swept; writing to it may still be possible.
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let is_ours = entry.file_name().to_str().is_some_and(|name| name.starts_with(PREFIX));
        let is_old = || changed(&entry.metadata().ok()?)?.elapsed().ok().map(|since| since >= age);
        if is_ours && entry.file_type().is_ok_and(|kind| kind.is_file()) && is_old() == Some(true) {
            fs::remove_file(entry.path()).ok(); // Another process may have removed it.
        }
    }
}

/// Time at which a file was made or changed. A backup is a second name of an old file, so on Unix the time of the last
/// change of its names counts.
fn changed(metadata: &fs::Metadata) -> Option<SystemTime> {
    #[cfg(unix)]
    {
        let secs = std::os::unix::fs::MetadataExt::ctime(metadata);
        SystemTime::UNIX_EPOCH.checked_add(Duration::from_secs(u64::try_from(secs).ok()?))
    }
    #[cfg(not(unix))]
    metadata.modified().ok()
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Rewords an I/O error: the original text would name the temporary file, and its text for a missing folder is unclear.
fn unnamed(error: &io::Error) -> io::Error {
    match error.kind() {
        kind @ io::ErrorKind::NotFound => io::Error::new(kind, "its folder does not exist"),
        kind => io::Error::from(kind),
    }
}

/// Renames staged files to their targets.
fn replace(staged: Vec<Staged<'_>>) -> Result<(), WriteError> {
    let failed = |path: &Path, source| WriteError { path: path.to_path_buf(), source };
    // The last file needs no backup, because nothing can fail after its rename.
    let n_kept = staged.len().saturating_sub(1);
    let mut before = Vec::with_capacity(n_kept);
    for staged in &staged[..n_kept] {
        let old = keep(&staged.target).map_err(|source| failed(staged.path, source))?;
        before.push((staged.target.clone(), old));
    }
    for (n_replaced, Staged { path, target, file }) in staged.into_iter().enumerate() {
        if let Err(error) = file.persist(&target) {
            before.truncate(n_replaced);
            put_back(before);
            return Err(failed(path, unnamed(&error.error)));
        }
        sync_folder(&target);
    }
    Ok(())
}

/// Makes a backup of `target` under a second name, which is deleted unless restored; `None` if the file does not exist.
fn keep(target: &Path) -> io::Result<Option<TempPath>> {
    let under = |name: &Path| match fs::hard_link(target, name) {
        // Fallback to a copy: the file system has no hard links, or the file belongs to another user.
        Err(error) if !matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::AlreadyExists) => {
            fs::copy(target, name).map(|_| ())
        }
        done => done,
    };
    match tempfile::Builder::new().prefix(PREFIX).make_in(folder_of(target), under) {
        Ok(kept) => Ok(Some(kept.into_temp_path())),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(unnamed(&error)),
    }
}

fn put_back(before: Vec<(PathBuf, Option<TempPath>)>) {
    for (target, old) in before {
        // The original error is reported; a failure to restore cannot be handled.
        let _ = match old {
            Some(kept) => kept.persist(&target).is_ok(),
            None => fs::remove_file(&target).is_ok(),
        };
    }
}

/// Makes a rename survive a power failure.
fn sync_folder(target: &Path) {
    // The file is already in place, and some file systems cannot sync a folder, so an error here is ignored.
    #[cfg(unix)]
    let _ = fs::File::open(folder_of(target)).and_then(|folder| folder.sync_all());
    #[cfg(not(unix))]
    let _ = target;
}

#[cfg(test)]
mod tests {
    use super::{Access, check_all, replace, stage, sweep_older, write, write_all};
    use std::fs;
    use std::time::Duration;

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
            assert_eq!(check_all(&[&a, other]).unwrap_err().to_string(), error.to_string());
            assert_eq!(fs::read(&a).unwrap(), b"old");
            assert_eq!(names(folder.path()), ["a", "taken"]);
        }
    }

    #[test]
    fn what_could_be_written_is_only_asked() {
        let folder = tempfile::tempdir().unwrap();
        let (a, b) = (folder.path().join("a"), folder.path().join("b"));
        fs::write(&a, b"old").unwrap();
        check_all(&[&a, &b]).unwrap();
        assert!(check_all(&[&a, &a]).unwrap_err().to_string().contains("the same file"));
        assert_eq!((fs::read(&a).unwrap(), names(folder.path())), (b"old".to_vec(), vec!["a".to_owned()]));
    }

    /// Stages three files, of which the last cannot be renamed because a folder has taken its name.
    fn fail_late(folder: &std::path::Path) {
        let [old, fresh, taken] = ["old", "fresh", "taken"].map(|name| folder.join(name));
        let staged = [&old, &fresh, &taken].map(|path| stage(path, b"now", Access::Usual).unwrap());
        fs::create_dir(&taken).unwrap();
        assert_eq!(replace(staged.into()).unwrap_err().path, taken);
        assert_eq!(names(folder), ["old", "taken"]);
    }

    #[test]
    fn files_that_took_their_place_are_put_back() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("old"), b"before").unwrap();
        fail_late(folder.path());
        assert_eq!(fs::read(folder.path().join("old")).unwrap(), b"before");
    }

    #[cfg(unix)]
    #[test]
    fn a_file_that_cannot_be_read_is_put_back_too() {
        use std::os::unix::fs::{MetadataExt as _, PermissionsExt as _};
        let folder = tempfile::tempdir().unwrap();
        let old = folder.path().join("old");
        fs::write(&old, b"before").unwrap();
        fs::set_permissions(&old, fs::Permissions::from_mode(0o000)).unwrap();
        let before = fs::metadata(&old).unwrap();
        fail_late(folder.path());
        // The same inode, with its permissions and owner.
        let after = fs::metadata(&old).unwrap();
        assert_eq!((after.ino(), after.mode()), (before.ino(), before.mode()));
    }

    #[test]
    fn two_names_of_one_file_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b] = ["a", "./a"].map(|name| folder.path().join(name));
        assert!(write_all(&[(&a, b"new"), (&b, b"other")]).unwrap_err().to_string().contains("same file"));
        fs::write(&a, b"old").unwrap();
        let error = write_all(&[(&a, b"new"), (&b, b"other")]).unwrap_err();
        assert!(error.to_string().contains("same file"), "{error}");
        assert_eq!(fs::read(&a).unwrap(), b"old");
    }

    #[test]
    fn what_a_killed_process_left_is_swept() {
        let folder = tempfile::tempdir().unwrap();
        for name in [".shagreen-abc", ".shagreen", "other"] {
            fs::write(folder.path().join(name), b"x").unwrap();
        }
        sweep_older(folder.path(), Duration::from_hours(1));
        assert_eq!(names(folder.path()).len(), 3, "a young file may be in use");
        sweep_older(folder.path(), Duration::ZERO);
        assert_eq!(names(folder.path()), [".shagreen", "other"]);
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_stay() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("there")).unwrap();
        fs::write(at("there/file"), b"old").unwrap();
        for (to, link) in [("there/file", "link"), ("link", "second"), ("there/none", "dangling")] {
            std::os::unix::fs::symlink(to, at(link)).unwrap();
        }
        write(&at("second"), b"new").unwrap();
        write(&at("dangling"), b"fresh").unwrap();
        assert_eq!(fs::read(at("there/file")).unwrap(), b"new");
        assert_eq!(fs::read(at("there/none")).unwrap(), b"fresh");
        for link in ["link", "second", "dangling"] {
            assert!(fs::symlink_metadata(at(link)).unwrap().is_symlink(), "{link}");
        }
        assert_eq!(names(folder.path()), ["dangling", "link", "second", "there"]);
        assert_eq!(names(&at("there")), ["file", "none"]);
        std::os::unix::fs::symlink("round", at("round")).unwrap();
        assert!(write(&at("round"), b"x").is_err());
    }

    #[cfg(unix)]
    #[test]
    fn what_is_no_file_is_left_alone() {
        use std::os::unix::fs::FileTypeExt as _;
        let folder = tempfile::tempdir().unwrap();
        let socket = folder.path().join("socket");
        let _bound = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        let link = folder.path().join("link");
        std::os::unix::fs::symlink("socket", &link).unwrap();
        for path in [&socket, &link] {
            let error = write(path, b"x").unwrap_err();
            assert!(error.to_string().contains("device or a pipe"), "{error}");
        }
        assert!(fs::metadata(&socket).unwrap().file_type().is_socket());
        assert_eq!(names(folder.path()), ["link", "socket"]);
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
