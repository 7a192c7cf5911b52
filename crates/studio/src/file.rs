//! Files by their paths: reading them, and naming them in errors.

use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_formats::bounded_file::{self, FileKind};

use crate::short_text::shortened;

/// Marks a context that only names a file.
const IN_FILE: &str = "file ";

/// Returns the context for an error inside a file; [`one_line`] shows it last.
pub fn in_file(path: &Path) -> String {
    format!("{IN_FILE}{}", path.display())
}

/// Returns the chain of causes on one line, with the path last: contexts of [`in_file`] move to the end.
pub fn one_line(error: &anyhow::Error) -> String {
    let (files, causes): (Vec<_>, Vec<_>) =
        error.chain().map(ToString::to_string).partition(|cause| cause.starts_with(IN_FILE));
    let mut parts: Vec<String> = Vec::new();
    for cause in causes {
        // Some errors repeat the text of their source.
        if !parts.iter().any(|part| part.contains(&cause)) {
            parts.push(cause);
        }
    }
    let paths = files.iter().map(|file| file.trim_start_matches(IN_FILE).to_owned());
    let line: Vec<String> = parts.into_iter().chain(paths).collect();
    shortened(line.join(": ").replace(['\n', '\r'], " "))
}

/// Returns the last component of a path as text.
pub fn file_name(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// Returns the last component of a path as text, or the whole path if it has none, such as `/`.
pub fn shown_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// Reads a file of this kind.
///
/// # Errors
/// The file does not exist, is a folder, pipe or device, is too large or cannot be read; the message says what to do.
pub fn read_file(path: &Path, kind: FileKind) -> anyhow::Result<Vec<u8>> {
    bounded_file::read(path, kind)
        .map_err(|error| anyhow::anyhow!("cannot read the file: {}", reason_of(&error)))
        .with_context(|| in_file(path))
}

/// Returns why the system does not read a file, and what to do.
pub(crate) fn reason_of(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file; check its name and its folder".to_owned(),
        io::ErrorKind::IsADirectory => "it is a folder; choose a file in it".to_owned(),
        io::ErrorKind::PermissionDenied => {
            "you do not have permission to read it; change the permissions of the file".to_owned()
        }
        io::ErrorKind::FileTooLarge | io::ErrorKind::InvalidInput => format!("{error}; choose another file"),
        _ => format!("{error}; check its name and your permissions"),
    }
}

/// Returns the ending of a file's name in lower case; empty if there is none.
pub fn ending_of(path: &Path) -> String {
    path.extension().map_or(String::new(), |ending| ending.to_string_lossy().to_lowercase())
}

/// Checks the ending of a file to write, without its dot in front: another one would promise another kind of file. A name may have
/// no ending. `what` names the output in the error.
///
/// # Errors
/// The name has another ending.
pub fn check_ending(what: &str, ending: &str, path: &Path) -> anyhow::Result<()> {
    let last = ending.rsplit_once('.').map_or(ending, |(_, last)| last);
    if let Some(other) = path.extension().filter(|other| !other.eq_ignore_ascii_case(last)) {
        bail!(
            "{what} is written to a .{ending} file, not to .{}; choose a name ending in .{ending}: {}",
            other.display(),
            path.display()
        );
    }
    Ok(())
}

/// Returns whether a folder, pipe or device is at this path. Reading a pipe or device might never end.
pub fn is_special(path: &Path) -> bool {
    path.metadata().is_ok_and(|metadata| !metadata.is_file())
}

/// Returns the folder that contains a file, as an absolute path where the system can resolve it.
pub fn folder_of(path: &Path) -> PathBuf {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    // With a relative folder, library paths would be stored in full instead of relative to the project.
    std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned())
}

#[cfg(test)]
mod tests {
    use super::{in_file, one_line};

    use std::path::Path;

    #[test]
    fn the_path_comes_last_on_one_line() {
        let error = anyhow::anyhow!("line 3 is\nshort")
            .context("the stroke is damaged")
            .context(in_file(Path::new("a/b.svc")));
        assert_eq!(one_line(&error), "the stroke is damaged: line 3 is short: a/b.svc");
    }
}
