//! Opening of files: a project with its library, or a library.

use std::io::Read as _;
use std::path::Path;

use anyhow::{Context as _, anyhow};
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::imported::Imported;
use shagreen_formats::library::{LibraryError, read_library};
use shagreen_formats::project::{
    LibraryFile, Project, ProjectError, ProjectLibrary, read_project, sha256_hex,
};

use crate::file::{ending_of, folder_of, in_file, is_special};

/// Bytes at the beginning of a file that tell its kind.
const HEAD_BYTES: u64 = 256;
/// Endings of the names of files that the window takes although they are neither projects nor libraries: recordings,
/// models, strokes and photos.
pub const OTHER_ENDINGS: [&str; 9] = ["wav", "csv", "tsv", "txt", "xml", "svc", "jpg", "jpeg", "png"];

/// Returns whether a file is of such a kind: its name has one of [`OTHER_ENDINGS`], and it does not begin like a project
/// or a library, which may have any name.
pub fn is_other_kind(path: &Path) -> bool {
    OTHER_ENDINGS.contains(&ending_of(path).as_str()) && !begins_like_json(path)
}

/// Warning that a project takes its library from outside its own folder: who sent the project did not send that file.
fn outside_library(project: &Project, path: &Path) -> Option<String> {
    let ProjectLibrary::File(file) = &project.library else { return None };
    let folder = folder_of(path);
    let is_inside = file.path.canonicalize().ok()?.starts_with(folder.canonicalize().unwrap_or(folder));
    (!is_inside).then(|| {
        format!(
            "its library is outside the folder of the project; make sure that you want to use it: {}",
            file.path.display()
        )
    })
}

fn begins_like_json(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = bounded_file::open(path).and_then(|file| file.take(HEAD_BYTES).read_to_end(&mut head));
    read.is_ok() && head.iter().find(|byte| !byte.is_ascii_whitespace()) == Some(&b'{')
}

/// What a file contains.
pub enum Opened {
    /// A project, with warnings.
    Project(Box<OpenedProject>),
    /// A library, with warnings.
    Library(Box<Imported<LibraryFile>>),
}

/// A project that was read from a file.
#[derive(Debug)]
pub struct OpenedProject {
    /// The project.
    pub project: Project,
    /// Warnings about the file.
    pub warnings: Vec<String>,
    /// SHA-256 of the file in hexadecimal digits; detects changes by others before it is saved.
    pub sha256: String,
}

/// Reads a library, or a project with its library if that is a separate file.
///
/// # Errors
/// The file cannot be read or is neither; the message names the file.
pub fn open(path: &Path) -> anyhow::Result<Opened> {
    let in_file = || in_file(path);
    if is_special(path) {
        return Err(anyhow!("this is a folder or a device, not a file; choose a file")).with_context(in_file);
    }
    let bytes = bounded_file::read(path, FileKind::Document)
        .context("the file cannot be read; check the path and your permissions")
        .with_context(in_file)?;
    let as_project =
        read_project(&bytes, &folder_of(path), &|library| bounded_file::read(library, FileKind::Document));
    match as_project {
        Ok(Imported { value: project, mut warnings }) => {
            warnings.extend(outside_library(&project, path));
            Ok(Opened::Project(Box::new(OpenedProject { project, warnings, sha256: sha256_hex(&bytes) })))
        }
        Err(ProjectError::Format { .. }) => match read_library(&bytes) {
            Ok(Imported { value: library, warnings }) => {
                // An absolute path is valid from every working folder.
                let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
                let file = LibraryFile { path, sha256: sha256_hex(&bytes), library };
                Ok(Opened::Library(Box::new(Imported { value: file, warnings })))
            }
            Err(LibraryError::Format { .. }) => Err(anyhow!(
                "this is neither a project nor a texture library; choose another file, or import it as a recording or \
                 model"
            ))
            .with_context(in_file),
            Err(error) => Err(error).with_context(in_file),
        },
        Err(error) => Err(error).with_context(in_file),
    }
}

#[cfg(test)]
mod tests {
    use super::{Opened, open};

    #[test]
    fn what_cannot_be_opened_is_explained() {
        let folder = tempfile::tempdir().unwrap();
        let error_of = |path: &std::path::Path| format!("{:#}", open(path).err().expect("no file to open"));
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
        assert!(error_of(folder.path()).contains("not a file"));
        assert!(error_of(&folder.path().join("none")).contains("cannot be read"));
    }

    #[test]
    fn a_library_is_opened_too() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("starter.json");
        std::fs::write(&path, shagreen_formats::starter::starter_bytes()).unwrap();
        let Ok(Opened::Library(imported)) = open(&path) else { panic!("a library") };
        assert_eq!((imported.value.path, imported.value.library.textures.len()), (path, 25));
    }
}
