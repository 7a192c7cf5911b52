//! Change of a file that other processes may change too: read, decide, write, without another process in between.

use std::fs::File;
use std::io;
use std::path::Path;

use crate::atomic::{self, WriteError};
use crate::bounded_file::{self, FileKind};

/// Lets `change` see the present content of the file (`None` if there is none) and writes what it returns. Another
/// process that uses this function waits meanwhile. An error of `change` writes nothing.
///
/// # Errors
/// [`WriteError`] if the file can be neither read nor written; the file is then unchanged.
pub fn update<E>(
    path: &Path,
    kind: FileKind,
    change: impl FnOnce(Option<&[u8]>) -> Result<Vec<u8>, E>,
) -> Result<Result<(), E>, WriteError> {
    let failed = |source| WriteError { path: path.to_path_buf(), source };
    let _locked = lock(path).map_err(failed)?;
    // Read only now: while this process waited, another one may have replaced the file.
    let present = match bounded_file::read(path, kind) {
        Ok(bytes) => Some(bytes),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(failed(error)),
    };
    match change(present.as_deref()) {
        Ok(bytes) => atomic::write(path, &bytes).map(Ok),
        Err(error) => Ok(Err(error)),
    }
}

/// Locks the file at `path` until the result is dropped, or its folder if the file does not exist yet. On Windows a locked
/// file cannot be replaced, so there is no lock.
fn lock(path: &Path) -> io::Result<Option<File>> {
    loop {
        let file = match bounded_file::open_to_lock(path) {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let folder = lock_folder(path);
                // Another process may have created the file while this one waited.
                if folder.is_some() && path.exists() {
                    continue;
                }
                return Ok(folder);
            }
            Err(error) => return Err(error),
        };
        if !cfg!(unix) {
            return Ok(None);
        }
        // A file system without locks still allows the comparison.
        file.lock().ok();
        // Another process may have replaced the file while this one waited. The lock must be that of the new one.
        if is_at(&file, path) {
            return Ok(Some(file));
        }
    }
}

/// Locks the folder of `path`; `None` where that is impossible.
fn lock_folder(path: &Path) -> Option<File> {
    if !cfg!(unix) {
        return None;
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let folder = bounded_file::open_folder_to_lock(folder).ok()?;
    folder.lock().ok()?;
    Some(folder)
}

/// Whether the path still leads to this file. A path that leads nowhere counts too, because nothing can be lost there.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let identity = |metadata: std::fs::Metadata| (metadata.dev(), metadata.ino());
    match (file.metadata(), std::fs::metadata(path)) {
        (Ok(open), Ok(there)) => identity(open) == identity(there),
        _ => true,
    }
}

#[cfg(not(unix))]
fn is_at(_: &File, _: &Path) -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::update;
    use crate::bounded_file::FileKind;
    use std::fs;

    #[test]
    fn sees_what_is_there_and_writes_what_it_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let add = |present: Option<&[u8]>| {
            let mut all = present.unwrap_or_default().to_vec();
            all.push(b'x');
            if all.len() > 3 { Err("enough") } else { Ok(all) }
        };
        for expected in [Ok(()), Ok(()), Ok(()), Err("enough")] {
            assert_eq!(update(&path, FileKind::Small, add).unwrap(), expected);
        }
        assert_eq!(fs::read(&path).unwrap(), b"xxx");
        let missing = folder.path().join("none/b");
        assert!(update(&missing, FileKind::Small, add).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn no_change_is_lost_among_many_threads() {
        let folder = tempfile::tempdir().unwrap();
        // The file does not exist at first.
        let path = folder.path().join("n");
        let count = |present: Option<&[u8]>| {
            let n: u32 = std::str::from_utf8(present.unwrap_or(b"0")).unwrap().parse().unwrap();
            Ok::<_, ()>((n + 1).to_string().into_bytes())
        };
        for _ in 0..20 {
            std::thread::scope(|scope| {
                for _ in 0..4 {
                    scope.spawn(|| {
                        for _ in 0..5 {
                            update(&path, FileKind::Small, count).unwrap().unwrap();
                        }
                    });
                }
            });
            let n: u32 = fs::read_to_string(&path).unwrap().parse().unwrap();
            assert_eq!(n, 20);
            fs::remove_file(&path).unwrap();
        }
    }
}
