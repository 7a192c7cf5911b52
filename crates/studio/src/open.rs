//! Opening of files: a project with its library, or a library.

use std::cell::Cell;
use std::io::{ErrorKind, Read as _};
use std::path::Path;

use anyhow::{Context as _, anyhow};
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::clip::{CLIP_ENDINGS, ClipKind};
use shagreen_formats::foreign_file::Found;
use shagreen_formats::imported::Imported;
use shagreen_formats::library::{LibraryError, read_library};
use shagreen_formats::project::{
    LibraryFile, Project, ProjectError, ProjectLibrary, read_project, read_project_on, sha256_hex,
};

use crate::file::{ending_of, file_name, folder_of, in_file, is_special, reason_of};
use crate::permitted_libraries::{OutsideLibrary, Permitted, without_dots};

/// Bytes at the beginning of a file that tell its kind.
const HEAD_BYTES: u64 = 256;
/// Ending of the name of the plan of a study.
pub const PLAN_ENDING: &str = "toml";
/// Endings of the names of files that the window takes although they are neither projects nor libraries: recordings, haptic
/// clips, models, strokes and photos.
pub const OTHER_ENDINGS: [&str; 15] = [
    "wav", "csv", "tsv", "txt", "haptic", "ahap", "xml", "svc", "jpg", "jpeg", "png", "webp", "bmp", "tif",
    "tiff",
];

/// Returns whether a file is of such a kind: it is a haptic clip, or its name has one of [`OTHER_ENDINGS`] and it does not begin
/// like a project or a library, which may have any name.
pub fn is_other_kind(path: &Path) -> bool {
    let ending = ending_of(path);
    is_clip(path, &ending) || (OTHER_ENDINGS.contains(&ending.as_str()) && !begins_like_json(path))
}

/// Returns whether a file is a haptic clip. Only the content of a JSON file tells that.
fn is_clip(path: &Path, ending: &str) -> bool {
    let is_clip = |bytes: &[u8]| ClipKind::of(&file_name(path), bytes).is_some();
    CLIP_ENDINGS.contains(&ending)
        || (ending == "json" && bounded_file::read(path, FileKind::Small).is_ok_and(|bytes| is_clip(&bytes)))
}

/// Returns whether a file is the plan of a study, by the ending of its name.
pub fn is_study_plan(path: &Path) -> bool {
    ending_of(path) == PLAN_ENDING
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

/// Reads a library, or a project with its library if that is a separate file. All points of the project have one coordinate for each
/// axis of its space; a warning says if they had others in the file.
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
        Ok(Imported { value: mut project, mut warnings }) => {
            warnings.extend(outside.map(|library| outside_warning(&library)));
            warnings.extend(fit_points(&mut project));
            let (sha256, origin) = (sha256_hex(&bytes), LibraryOrigin::Project);
            Ok(Opened::Project(Box::new(OpenedProject { project, warnings, sha256, origin })))
        }
        Err(ProjectError::Format { .. }) => {
            Ok(Opened::Library(Box::new(library_in(path, &bytes).with_context(in_file)?)))
        }
        Err(error) => Err(error).with_context(in_file),
    }
}

/// Reads a project with another library than the one that it names: the file at `library`, or the starter library. Its points are
/// those of [`open`].
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
    let mut project = read.value;
    warnings.extend(read.warnings);
    warnings.extend(fit_points(&mut project));
    Ok(OpenedProject { project, warnings, sha256: sha256_hex(&bytes), origin })
}

/// Gives every point of a project one coordinate for each axis of the space; returns a warning if one had others.
fn fit_points(project: &mut Project) -> Option<String> {
    project.fit_points().then(|| {
        format!(
            "points of the project had another number of coordinates than the space has axes ({}): missing coordinates are in the middle, further ones are left out; check their positions before you save",
            project.axis_names().join(", ")
        )
    })
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
mod tests;
