//! Bundles: a project or a library with everything that belongs to it, in one file to share.
//!
//! A bundle has no textures that must not be redistributed, unless their owner states the right to share them.

mod exports;
mod extract;
mod sources;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context as _, bail};
use shagreen_core::words::counted;
use shagreen_formats::bundle::{
    Bundle, BundleFile, BundleKind, BundleManifestV1, BundleRole, BundledTextureV1, OverrideV1,
    is_restricted_file, write_bundle,
};
use shagreen_formats::imported::Imported;
use shagreen_formats::library::{Library, id_from_name, write_library};
use shagreen_formats::picture::{Picture, PictureFormat};
use shagreen_formats::project::{self, LibraryFile, Project, ProjectLibrary, sha256_hex, write_project};

use self::exports::exports_of;
use self::sources::{authored_textures, listed_textures};
use crate::library;
use crate::open::{Opened, open};
use crate::permitted_libraries::Permitted;
use crate::project::textures_of;
use crate::report::Reporter;

pub use self::extract::{check_bundle, extract_bundle};

/// Ending of the name of a library.
const LIBRARY_ENDING: &str = "json";
/// Largest number of names in an error.
const MOST_NAMED: usize = 20;
/// Largest number of characters of a texture in the name of its picture.
const MOST_LETTERS: usize = 40;
/// What a bundle says about restricted textures in it.
const STATEMENT: &str = "Whoever made this bundle states the right to share these textures, although they were made from data that must not be redistributed.";

/// What to bundle.
pub enum BundleSource {
    /// A project with its library.
    Project(Box<Project>),
    /// A library.
    Library(Box<Library>),
}

/// How to bundle it.
pub struct BundleOptions<'a> {
    /// Name of the project or library.
    pub name: &'a str,
    /// The program, with its version.
    pub created_by: &'a str,
    /// Files and folders to add, such as exported signals.
    pub exports: &'a [PathBuf],
    /// Whether restricted textures may be in the bundle, because the user owns their data.
    pub overrides_restriction: bool,
}

/// A bundle in memory.
pub struct Bundled {
    /// The bytes of the file.
    pub bytes: Vec<u8>,
    /// The list of its files, and what they contain.
    pub manifest: BundleManifestV1,
}

impl BundleSource {
    /// Reads a project, a library, a folder of libraries, or a built-in library.
    ///
    /// # Errors
    /// As [`open`] and [`library::load`].
    pub fn read(path: &Path, permitted: &Permitted, reporter: &dyn Reporter) -> anyhow::Result<Self> {
        if path.is_dir() || library::built_in(path).is_some() {
            return Ok(Self::Library(Box::new(library::load(Some(path), reporter)?)));
        }
        let (source, warnings) = match open(path, permitted)? {
            Opened::Project(opened) => (Self::Project(Box::new(opened.project)), opened.warnings),
            Opened::Library(imported) => {
                let Imported { value, warnings } = *imported;
                (Self::Library(Box::new(value.library)), warnings)
            }
        };
        for warning in &warnings {
            reporter.warn(&format!("{warning}: {}", path.display()));
        }
        Ok(source)
    }
}

/// Bundles a project or a library. The same content gives the same bytes.
///
/// # Errors
/// It has textures that must not be redistributed, an added file cannot be read or has a name that not every system permits, or the
/// bundle would be too large.
pub fn bundle(
    source: &BundleSource,
    options: &BundleOptions<'_>,
    reporter: &dyn Reporter,
) -> anyhow::Result<Bundled> {
    let contents = match source {
        BundleSource::Project(project) => of_project(project, options, reporter)?,
        BundleSource::Library(library) => of_library(library, options.name),
    };
    let Contents { kind, origin, textures, mut files } = contents;
    files.extend(exports_of(options.exports)?);
    let restriction = Restriction::of(&textures, &files);
    let mut manifest = BundleManifestV1::new(options.created_by, options.name, kind);
    if !restriction.is_empty() {
        if !options.overrides_restriction {
            bail!(restriction.refusal());
        }
        manifest.override_restriction =
            Some(OverrideV1 { textures: restriction.names(), statement: STATEMENT.to_owned() });
    }
    manifest.licence = terms_of_all(&textures);
    manifest.origin = origin;
    manifest.textures = textures;
    let bytes = write_bundle(manifest, files)?;
    // What cannot be read again must not be handed out.
    let manifest = Bundle::open(&bytes).context("the bundle cannot be read again")?.manifest().clone();
    Ok(Bundled { bytes, manifest })
}

/// What goes into a bundle, apart from added files.
struct Contents {
    kind: BundleKind,
    origin: String,
    textures: Vec<BundledTextureV1>,
    files: Vec<BundleFile>,
}

fn of_library(library: &Library, name: &str) -> Contents {
    let path = path_of(name, LIBRARY_ENDING);
    let mut files = vec![BundleFile { path, role: BundleRole::Library, bytes: write_library(library) }];
    files.extend(pictures(library, &[]));
    let textures = listed_textures(library);
    Contents { kind: BundleKind::Library, origin: library.origin.clone(), textures, files }
}

fn of_project(
    project: &Project,
    options: &BundleOptions<'_>,
    reporter: &dyn Reporter,
) -> anyhow::Result<Contents> {
    let library = textures_of(project)?;
    let mut files = Vec::new();
    let mut bundled = project.clone();
    if let ProjectLibrary::File(file) = &project.library {
        let stem = file.path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let path = format!("library/{}", path_of(&stem, LIBRARY_ENDING));
        let bytes = write_library(&file.library);
        let sha256 = sha256_hex(&bytes);
        // Relative to the folder of the project, wherever the bundle is unpacked.
        let file = LibraryFile { path: path.clone().into(), sha256, library: file.library.clone() };
        bundled.library = ProjectLibrary::File(Arc::new(file));
        files.push(BundleFile { path, role: BundleRole::Library, bytes });
    }
    files.push(BundleFile {
        path: path_of(options.name, project::EXTENSION),
        role: BundleRole::Project,
        bytes: write_project(&bundled, Path::new(""), options.created_by),
    });
    // Every installation has the pictures of the built-in libraries.
    let is_built_in = matches!(project.library, ProjectLibrary::BuiltIn(_));
    let n_built_in = if is_built_in { library.textures.len() - project.joined.len() } else { 0 };
    let mut pictured = library.clone();
    pictured.textures.drain(..n_built_in);
    let authored: Vec<(String, &Picture)> = project
        .authored
        .iter()
        .filter_map(|texture| {
            Some((format!("authored {} {}", texture.key, texture.name), &**texture.picture.as_ref()?))
        })
        .collect();
    files.extend(pictures(&pictured, &authored));
    let mut textures = listed_textures(&library);
    textures.extend(authored_textures(project, &library, reporter));
    Ok(Contents { kind: BundleKind::Project, origin: library.origin, textures, files })
}

/// A file name made of a name.
fn path_of(name: &str, ending: &str) -> String {
    format!("{}.{ending}", id_from_name(name))
}

/// The pictures of these textures and of authored ones, as files to look at.
fn pictures(library: &Library, authored: &[(String, &Picture)]) -> Vec<BundleFile> {
    let of_library =
        library.textures.iter().filter_map(|entry| Some((entry.id.as_str(), entry.picture.as_ref()?)));
    let of_authored = authored.iter().map(|(name, picture)| (name.as_str(), *picture));
    let file = |(index, (name, picture)): (usize, (&str, &Picture))| {
        let ending = match picture.format {
            PictureFormat::Jpeg => "jpg",
            PictureFormat::Png => "png",
        };
        let name: String = id_from_name(name).chars().take(MOST_LETTERS).collect();
        // With a number, no two are the same, and none is the name of a device.
        let path = format!("pictures/{:03}-{name}.{ending}", index + 1);
        BundleFile { path, role: BundleRole::Picture, bytes: picture.bytes.clone() }
    };
    of_library.chain(of_authored).enumerate().map(file).collect()
}

/// The terms of use of all textures, each once.
fn terms_of_all(textures: &[BundledTextureV1]) -> String {
    let mut distinct: Vec<&str> = Vec::new();
    for texture in textures.iter().filter(|texture| !texture.licence.is_empty()) {
        if !distinct.contains(&&*texture.licence) {
            distinct.push(&texture.licence);
        }
    }
    match distinct[..] {
        [] => "not stated".to_owned(),
        [one] => one.to_owned(),
        _ => format!("several, which are stated with each texture: {}", distinct.join("; ")),
    }
}

/// What must not be redistributed.
struct Restriction {
    /// Names of textures of the library or of the project.
    textures: Vec<String>,
    /// Names of authored textures that are made of them.
    authored: Vec<String>,
    /// Paths of added files that say so of themselves, or that contain such a texture.
    files: Vec<String>,
}

impl Restriction {
    fn of(textures: &[BundledTextureV1], files: &[BundleFile]) -> Self {
        let restricted = || textures.iter().filter(|texture| texture.restricted);
        let names = |authored: bool| -> Vec<String> {
            restricted().filter(|t| t.authored == authored).map(|texture| texture.name.clone()).collect()
        };
        let ids: Vec<&str> = restricted().filter(|t| !t.authored).map(|texture| &*texture.id).collect();
        let is_restricted = |file: &&BundleFile| {
            file.role == BundleRole::Export
                && (is_restricted_file(&file.bytes) || exports::is_made_of(&file.bytes, &ids))
        };
        Self {
            textures: names(false),
            authored: names(true),
            files: files.iter().filter(is_restricted).map(|file| file.path.clone()).collect(),
        }
    }

    fn is_empty(&self) -> bool {
        self.textures.is_empty() && self.authored.is_empty() && self.files.is_empty()
    }

    /// All names.
    fn names(&self) -> Vec<String> {
        self.textures.iter().chain(&self.authored).chain(&self.files).cloned().collect()
    }

    /// Why there is no bundle, and what to do.
    fn refusal(&self) -> String {
        let mut text = "this must not be redistributed, because it was made from restricted data".to_owned();
        for (names, noun) in
            [(&self.textures, "texture"), (&self.authored, "authored texture"), (&self.files, "added file")]
        {
            if !names.is_empty() {
                // Writing to a string cannot fail.
                let _ = write!(text, "; {}: {}", counted(names.len(), noun), named(names));
            }
        }
        text + ". Remove it, or use --override-restriction if the data are yours"
    }
}

/// The first names of a list, in quotation marks.
fn named(names: &[String]) -> String {
    let shown: Vec<String> = names.iter().take(MOST_NAMED).map(|name| format!("\"{name}\"")).collect();
    match names.len().saturating_sub(MOST_NAMED) {
        0 => shown.join(", "),
        n => format!("{} and {n} more", shown.join(", ")),
    }
}

#[cfg(test)]
mod tests;
