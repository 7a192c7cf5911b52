//! Opening of files: a project with its library, or a library.

use std::cell::Cell;
use std::io::{ErrorKind, Read as _};
use std::path::Path;

use anyhow::{Context as _, anyhow};
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::foreign_file::Found;
use shagreen_formats::imported::Imported;
use shagreen_formats::library::{LibraryError, read_library};
use shagreen_formats::project::{
    LibraryFile, Project, ProjectError, ProjectLibrary, read_project, read_project_on, sha256_hex,
};

use crate::file::{ending_of, folder_of, in_file, is_special, reason_of};
use crate::permitted_libraries::{OutsideLibrary, Permitted, without_dots};

/// Bytes at the beginning of a file that tell its kind.
const HEAD_BYTES: u64 = 256;
/// Endings of the names of files that the window takes although they are neither projects nor libraries: recordings,
/// models, strokes and photos.
pub const OTHER_ENDINGS: [&str; 13] =
    ["wav", "csv", "tsv", "txt", "xml", "svc", "jpg", "jpeg", "png", "webp", "bmp", "tif", "tiff"];

/// Returns whether a file is of such a kind: its name has one of [`OTHER_ENDINGS`], and it does not begin like a project
/// or a library, which may have any name.
pub fn is_other_kind(path: &Path) -> bool {
    OTHER_ENDINGS.contains(&ending_of(path).as_str()) && !begins_like_json(path)
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
    /// Where its library comes from.
    pub origin: LibraryOrigin,
}

/// Origin of the library of an opened project.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LibraryOrigin {
    /// The project names or contains it.
    Project,
    /// The user chose another file.
    Chosen,
    /// The starter library takes the place of one that was not read.
    Starter,
}

/// Reads a library, or a project with its library if that is a separate file.
///
/// # Errors
/// The file cannot be read or is neither; the message names the file. [`OutsideLibrary`] if the project names a library
/// that is not permitted.
pub fn open(path: &Path, permitted: &Permitted) -> anyhow::Result<Opened> {
    let in_file = || in_file(path);
    let bytes = document(path)?;
    let folder = folder_of(path);
    let outside = Cell::new(None);
    let read = |library: &Path| {
        if !permitted.covers(library, &folder) {
            let named = without_dots(library);
            // A link in the folder of the project: what it leads to lies outside.
            let is_named_inside = named.starts_with(without_dots(&folder));
            let real = if is_named_inside { library.canonicalize().ok() } else { None };
            outside.set(Some(real.unwrap_or(named)));
            if matches!(permitted, Permitted::Only(_)) {
                return Err(ErrorKind::PermissionDenied.into());
            }
        }
        bounded_file::read(library, FileKind::Document)
    };
    let as_project = read_project(&bytes, &folder, &read);
    let outside = outside.into_inner();
    if let (Permitted::Only(_), Some(library)) = (permitted, &outside) {
        return Err(OutsideLibrary { library: library.clone() }.into());
    }
    match as_project {
        Ok(Imported { value: project, mut warnings }) => {
            warnings.extend(outside.map(|library| outside_warning(&library)));
            let (sha256, origin) = (sha256_hex(&bytes), LibraryOrigin::Project);
            Ok(Opened::Project(Box::new(OpenedProject { project, warnings, sha256, origin })))
        }
        Err(ProjectError::Format { .. }) => {
            Ok(Opened::Library(Box::new(library_in(path, &bytes).with_context(in_file)?)))
        }
        Err(error) => Err(error).with_context(in_file),
    }
}

/// Reads a project with another library than the one that it names: the file at `library`, or the starter library.
///
/// # Errors
/// One of the files cannot be read or is of another kind; the message names the file.
pub fn open_on(path: &Path, library: Option<&Path>) -> anyhow::Result<OpenedProject> {
    let mut warnings = Vec::new();
    let (on, origin) = if let Some(library) = library {
        let imported = library_in(library, &document(library)?).with_context(|| in_file(library))?;
        warnings.extend(imported.warnings);
        (ProjectLibrary::File(imported.value.into()), LibraryOrigin::Chosen)
    } else {
        warnings.push(
            "this is a copy of the project with the starter library; the textures of its own library are missing"
                .to_owned(),
        );
        (ProjectLibrary::BuiltIn(BuiltIn::Starter), LibraryOrigin::Starter)
    };
    let bytes = document(path)?;
    let read = read_project_on(&bytes, on).with_context(|| in_file(path))?;
    warnings.extend(read.warnings);
    Ok(OpenedProject { project: read.value, warnings, sha256: sha256_hex(&bytes), origin })
}

/// Bytes of a project or library.
fn document(path: &Path) -> anyhow::Result<Vec<u8>> {
    let in_file = || in_file(path);
    if is_special(path) {
        return Err(anyhow!("this is a folder or a device, not a file; choose a file")).with_context(in_file);
    }
    bounded_file::read(path, FileKind::Document)
        .map_err(|error| anyhow!("the file cannot be read: {}", reason_of(&error)))
        .with_context(in_file)
}

/// Library in the bytes of the file at `path`.
fn library_in(path: &Path, bytes: &[u8]) -> anyhow::Result<Imported<LibraryFile>> {
    match read_library(bytes) {
        Ok(Imported { value: library, warnings }) => {
            // An absolute path is valid from every working folder.
            let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
            let file = LibraryFile { path, sha256: sha256_hex(bytes), library };
            Ok(Imported { value: file, warnings })
        }
        Err(LibraryError::Format { found }) => Err(anyhow!(neither(&found))),
        Err(error) => Err(error.into()),
    }
}

/// Says why a file is neither a project nor a library.
fn neither(found: &Found) -> String {
    let is = match found {
        Found::Empty => {
            return "the file is empty; choose another file, or restore it from a copy".to_owned();
        }
        Found::Kind(kind) => format!("this is {kind}, neither a project nor a texture library"),
        _ => "this is neither a project nor a texture library".to_owned(),
    };
    format!("{is}; choose another file, or import it as a recording or model")
}

fn outside_warning(library: &Path) -> String {
    format!(
        "its library is outside the folder of the project; make sure that you want to use it: {}",
        library.display()
    )
}

#[cfg(test)]
mod tests {
    use super::{LibraryOrigin, OTHER_ENDINGS, Opened, open, open_on};
    use crate::permitted_libraries::{OutsideLibrary, Permitted};
    use crate::project::new_project;
    use shagreen_formats::built_in::BuiltIn;
    use shagreen_formats::picture::PHOTO_ENDINGS;
    use shagreen_formats::project::{ProjectLibrary, write_project};
    use shagreen_formats::starter::starter_bytes;

    #[test]
    fn what_cannot_be_opened_is_explained() {
        let folder = tempfile::tempdir().unwrap();
        let error_of = |path: &std::path::Path| {
            format!("{:#}", open(path, &Permitted::All).err().expect("no file to open"))
        };
        let faults: [(&str, &[u8], &str); 6] = [
            ("a", b"hello", "neither a project nor"),
            ("empty", b"", "the file is empty"),
            ("picture", b"\x89PNG\r\n\x1a\n", "this is a PNG picture, neither a project nor"),
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
    fn photos_of_all_formats_are_taken() {
        assert!(PHOTO_ENDINGS.iter().all(|ending| OTHER_ENDINGS.contains(ending)));
    }

    #[test]
    fn a_library_is_opened_too() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("starter.json");
        std::fs::write(&path, starter_bytes()).unwrap();
        let Ok(Opened::Library(imported)) = open(&path, &Permitted::All) else { panic!("a library") };
        assert_eq!((imported.value.path, imported.value.library.textures.len()), (path, 25));
    }

    #[test]
    fn a_library_outside_the_folder_is_read_with_permission_only() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().canonicalize().unwrap();
        for name in ["elsewhere", "near"] {
            std::fs::create_dir(root.join(name)).unwrap();
            std::fs::write(root.join(name).join("mine.json"), starter_bytes()).unwrap();
        }
        let project = root.join("near/a.shagreen");
        let name_library = |library: &str| {
            let written = write_project(&new_project(), &root, "test");
            let mut wire: serde_json::Value = serde_json::from_slice(&written).unwrap();
            wire["library"] = serde_json::json!({"file": library});
            std::fs::write(&project, wire.to_string()).unwrap();
        };
        let only = |places: &[&str]| Permitted::Only(places.iter().map(|place| root.join(place)).collect());
        let opened = |permitted: &Permitted| match open(&project, permitted) {
            Ok(Opened::Project(opened)) => Ok(opened),
            Ok(Opened::Library(_)) => panic!("a project"),
            Err(error) => Err(error),
        };
        name_library("mine.json");
        assert!(opened(&only(&[])).is_ok(), "beside the project");
        name_library("../elsewhere/mine.json");
        let refused = opened(&only(&["elsewhere/other.json"])).unwrap_err();
        let refused = refused.downcast_ref::<OutsideLibrary>().expect("it is outside");
        assert_eq!(refused.library, root.join("elsewhere/mine.json"));
        for places in [["elsewhere"], ["elsewhere/mine.json"]] {
            assert!(opened(&only(&places)).unwrap().warnings.is_empty(), "{places:?}");
        }
        let warned = opened(&Permitted::AllWarned(Vec::new())).unwrap();
        assert!(warned.warnings[0].contains("outside the folder of the project"), "{:?}", warned.warnings);
        assert!(opened(&Permitted::All).unwrap().warnings.is_empty());
        // A link beside the project: the refusal names what it leads to, which can then be permitted.
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(root.join("elsewhere/mine.json"), root.join("near/link.json"))
                .unwrap();
            name_library("link.json");
            let refused = opened(&only(&[])).unwrap_err();
            let refused = refused.downcast_ref::<OutsideLibrary>().expect("it is outside");
            assert_eq!(refused.library, root.join("elsewhere/mine.json"));
            assert!(opened(&only(&["elsewhere/mine.json"])).is_ok());
            name_library("../elsewhere/mine.json");
        }
        // Another library in its place.
        let chosen = open_on(&project, Some(&root.join("near/mine.json"))).unwrap();
        let ProjectLibrary::File(file) = &chosen.project.library else { panic!("a file") };
        assert_eq!((&file.path, chosen.origin), (&root.join("near/mine.json"), LibraryOrigin::Chosen));
        let without = open_on(&project, None).unwrap();
        assert_eq!(without.project.library, ProjectLibrary::BuiltIn(BuiltIn::Starter));
        assert_eq!((without.warnings.len(), without.origin), (1, LibraryOrigin::Starter));
        assert!(open_on(&project, Some(&project)).is_err(), "a project is no library");
    }
}
