//! What a save writes, and which files it may replace.

use std::path::Path;

use shagreen_formats::atomic;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::library::{Library, LibraryError, read_library, write_library};
use shagreen_formats::project::{ProjectError, read_project};

use crate::state::blank_file::BlankFile;
use crate::state::figure_file::FigureFile;
use crate::state::stroke_file::StrokeFile;
use crate::strings::{build, document, import as strings, stroke};

/// Result of saving.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    Saved,
    /// The project may be written.
    MayBeWritten,
    Exists,
    Failed(String),
}

/// Content of the file.
pub(super) enum Content {
    Library(Box<Library>),
    Figure(FigureFile),
    Blank(BlankFile),
    Stroke(StrokeFile),
    /// The document writes it once that is permitted.
    Project,
}

impl Content {
    /// Writes the content to `path`; a project is left to its document.
    fn put(&self, path: &Path) -> Result<Outcome, String> {
        let bytes = match self {
            Self::Library(library) => write_library(library),
            Self::Figure(figure) => figure.bytes()?,
            Self::Blank(file) => file.bytes(),
            Self::Stroke(file) => file.bytes(),
            Self::Project => return Ok(Outcome::MayBeWritten),
        };
        atomic::write(path, &bytes).map(|()| Outcome::Saved).map_err(|error| error.to_string())
    }

    /// Why a file with these bytes must not be replaced by this content. `None` if it is of the same kind, of any
    /// version and even with errors in it.
    fn refusal(&self, bytes: &[u8]) -> Option<String> {
        match self {
            Self::Library(_) => match read_library(bytes) {
                Err(error @ (LibraryError::Format { .. } | LibraryError::Damaged { texture: None, .. })) => {
                    Some(strings::no_library(&error.to_string()))
                }
                _ => None,
            },
            Self::Figure(figure) => (!figure.is_like(bytes)).then(|| build::no_figure(figure.format.word())),
            Self::Blank(file) => (!file.may_replace(bytes)).then(|| build::NOT_BLANK.to_owned()),
            Self::Stroke(_) => (!StrokeFile::is_like(bytes)).then(|| stroke::NO_STROKE.to_owned()),
            Self::Project => is_project(bytes).err().map(|reason| document::no_project(&reason)),
        }
    }
}

pub(super) fn write(path: &Path, content: &Content, replaces: bool) -> Outcome {
    if path.symlink_metadata().is_ok() {
        // The file may have changed since the user was asked.
        match refusal(path, content) {
            Some(reason) => return Outcome::Failed(reason),
            None if !replaces => return Outcome::Exists,
            None => {}
        }
    }
    content.put(path).unwrap_or_else(Outcome::Failed)
}

/// Whether bytes are a project, of any version and even with errors in it.
fn is_project(bytes: &[u8]) -> Result<(), String> {
    let nothing = |_: &Path| Err(std::io::ErrorKind::NotFound.into());
    match read_project(bytes, Path::new(""), &nothing) {
        Err(error @ (ProjectError::Format { .. } | ProjectError::Damaged { .. })) => Err(error.to_string()),
        _ => Ok(()),
    }
}

/// Why the file at this path must not be replaced.
fn refusal(path: &Path, content: &Content) -> Option<String> {
    let bytes = match path.metadata() {
        // Reading a pipe or device would never end.
        Ok(metadata) if !metadata.is_file() => return Some(document::NO_FILE.to_owned()),
        Ok(_) => bounded_file::read(path, FileKind::Document),
        Err(error) => Err(error),
    };
    match bytes {
        Err(error) => Some(strings::cannot_be_checked(&error.to_string())),
        Ok(bytes) => content.refusal(&bytes),
    }
}

#[cfg(test)]
mod tests {
    use super::{Content, Outcome, write};
    use shagreen_formats::library::{Library, read_library};

    #[test]
    fn only_a_library_is_replaced_and_only_when_that_was_said() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mine.json");
        let library =
            |name: &str| Content::Library(Box::new(Library { name: name.to_owned(), ..Library::default() }));
        let name = || read_library(&std::fs::read(&path).unwrap()).unwrap().value.name;
        assert_eq!(write(&path, &library("one"), false), Outcome::Saved);
        assert_eq!(write(&path, &library("two"), false), Outcome::Exists);
        assert_eq!(name(), "one");
        assert_eq!(write(&path, &library("two"), true), Outcome::Saved);
        assert_eq!(name(), "two");
        assert!(
            matches!(write(&path, &Content::Project, true), Outcome::Failed(_)),
            "a library is no project"
        );
        std::fs::write(&path, "something else").unwrap();
        for replaces in [false, true] {
            assert!(matches!(write(&path, &library("three"), replaces), Outcome::Failed(_)), "{replaces}");
            assert!(matches!(write(folder.path(), &library("three"), replaces), Outcome::Failed(_)));
        }
        assert_eq!(std::fs::read(&path).unwrap(), b"something else");
        let newer = br#"{ "format": "shagreen-library", "version": "99.0" }"#;
        std::fs::write(&path, newer).unwrap();
        assert_eq!(write(&path, &library("three"), false), Outcome::Exists);
        let nowhere = folder.path().join("no/such/folder.json");
        assert!(matches!(write(&nowhere, &library("three"), true), Outcome::Failed(_)));
    }
}
