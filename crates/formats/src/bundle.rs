//! Bundles: a project or a library with everything that belongs to it, in one ZIP archive to share.
//!
//! The first file of the archive is `bundle.json`:
//!
//! ```json
//! {
//!   "format": "shagreen-bundle", "version": "1.0", "created_by": "…", "name": "Woods", "kind": "project",
//!   "licence": "CC0-1.0", "origin": "…",
//!   "override_restriction": {"textures": ["Oak, measured"], "statement": "…"},
//!   "textures": [{"id": "cork", "name": "Cork", "licence": "…", "origin": "…", "restricted": false, "authored": false,
//!     "parents": []}],
//!   "files": [{"path": "project.shagreen", "role": "project", "bytes": 1200, "sha256": "…"}]
//! }
//! ```
//!
//! - `files` are all other files of the archive, by ascending path. Paths are relative, with slashes.
//! - `textures` are those of the library, those that were added to the project, and its authored textures with the textures that they
//!   are made of (`parents`).
//! - `override_restriction` is missing, or says that the owner of the data shares textures that must not be redistributed otherwise.
//!
//! The same content always gives the same bytes. Whoever reads a bundle trusts nothing in it: [`Bundle::open`] refuses names that
//! lead out of a folder and sizes that no bundle has, and [`Bundle::file`] checks the hash of what it returns.

mod archive;
mod path;
mod restriction;

use std::collections::BTreeSet;
use std::io::Cursor;

use serde::{Deserialize, Serialize};
use zip::ZipArchive;

use self::archive::{at_most, entry_bytes, has_plain_end, list_at_most, pack, reason};
use self::path::check_path;
use crate::bounded_file::FileKind;
use crate::foreign_file::Found;
use crate::layout;
use crate::own_json::{HeaderFault, minor_version};
use crate::parser_words::plain;
use crate::project::sha256_hex;

pub use self::restriction::is_restricted_file;

/// Value of the `format` field.
pub const FORMAT: &str = "shagreen-bundle";
/// Version of the format.
pub const VERSION: &str = "1.0";
const VERSION_MAJOR: u32 = 1;
/// Name of the file that lists the others.
pub const MANIFEST: &str = "bundle.json";
/// Ending of the name of a bundle.
pub const EXTENSION: &str = "zip";

/// Largest number of files: a plain ZIP archive has no more than 65,534.
pub const MAX_FILES: usize = 60_000;
/// Largest sum of the lengths of all files, and largest bundle, in bytes.
pub const MAX_BYTES: u64 = FileKind::Recording.max_bytes();

/// Why bytes are no bundle, or files cannot become one.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BundleError {
    /// The file has another format.
    #[error("{}", .found.instead_of("a bundle", FORMAT))]
    Format {
        /// What it is instead.
        found: Found,
    },
    /// A ZIP archive that does not begin with the list of its files.
    #[error("this ZIP archive is not a bundle: it does not begin with {MANIFEST}; choose another file")]
    OtherArchive,
    /// The version is not supported.
    #[error("the bundle has version {found}, but this program reads version {VERSION}; update Shagreen")]
    Version {
        /// Value of the `version` field.
        found: String,
    },
    /// The archive or its list is damaged.
    #[error("the bundle is damaged: {reason}; copy it again from where it came")]
    Damaged {
        /// What is wrong.
        reason: String,
    },
    /// A path that a bundle must not have.
    #[error("the file \"{path}\" cannot be in a bundle: its path {reason}; rename the file")]
    Path {
        /// The path.
        path: String,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// More files than fit.
    #[error("the bundle has {n} files, but at most {MAX_FILES} are possible; divide it")]
    TooMany {
        /// Number of files.
        n: usize,
    },
    /// Files that are too large, alone or for the size of their archive.
    #[error("the files of the bundle have {bytes} bytes, but at most {most} are possible; leave some out")]
    TooLarge {
        /// Sum of the lengths.
        bytes: u64,
        /// The limit.
        most: u64,
    },
    /// A file is not the one that was bundled.
    #[error("the file \"{path}\" of the bundle {reason}; copy the bundle again from where it came")]
    File {
        /// Path of the file.
        path: String,
        /// How it differs.
        reason: String,
    },
}

/// What a bundle contains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BundleKind {
    /// A project with its library.
    Project,
    /// A library.
    Library,
}

/// What a file of a bundle is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BundleRole {
    /// The project.
    Project,
    /// The library.
    Library,
    /// A picture of a texture, which is also in the project or the library.
    Picture,
    /// A file that was added, such as an exported signal.
    Export,
}

/// A texture of a bundle and its source.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BundledTextureV1 {
    /// Its identifier, or the key of an authored texture.
    pub id: String,
    /// Its name.
    pub name: String,
    /// Its terms of use.
    pub licence: String,
    /// Where it comes from.
    pub origin: String,
    /// Whether it was made from data that must not be redistributed.
    pub restricted: bool,
    /// Whether it is authored: a position in the space of the others.
    pub authored: bool,
    /// Identifiers of the textures that it is made of.
    pub parents: Vec<String>,
}

/// The owner of restricted data shares what was made from it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct OverrideV1 {
    /// Names of the textures.
    pub textures: Vec<String>,
    /// Sentence for whoever receives the bundle.
    pub statement: String,
}

/// A listed file of a bundle.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BundledFileV1 {
    /// Path in the bundle, with slashes.
    pub path: String,
    /// What it is.
    pub role: BundleRole,
    /// Length in bytes.
    pub bytes: u64,
    /// SHA-256 in hexadecimal digits.
    pub sha256: String,
}

/// The content of `bundle.json`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BundleManifestV1 {
    format: String,
    version: String,
    /// The program that wrote it, with its version.
    pub created_by: String,
    /// Name of the project or library.
    pub name: String,
    /// What it contains.
    pub kind: BundleKind,
    /// Terms of use of the whole; those of each texture are with it.
    pub licence: String,
    /// Where the textures come from.
    pub origin: String,
    /// Textures that are shared against their restriction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub override_restriction: Option<OverrideV1>,
    /// The textures and their sources.
    pub textures: Vec<BundledTextureV1>,
    /// All files but this one, by ascending path.
    pub files: Vec<BundledFileV1>,
}

impl BundleManifestV1 {
    /// Begins the list of a bundle, without terms, textures and files.
    pub fn new(created_by: &str, name: &str, kind: BundleKind) -> Self {
        Self {
            format: FORMAT.to_owned(),
            version: VERSION.to_owned(),
            created_by: created_by.to_owned(),
            name: name.to_owned(),
            kind,
            licence: String::new(),
            origin: String::new(),
            override_restriction: None,
            textures: Vec::new(),
            files: Vec::new(),
        }
    }
}

/// A file to put into a bundle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BundleFile {
    /// Path in the bundle, with slashes.
    pub path: String,
    /// What it is.
    pub role: BundleRole,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// Returns the bytes of the bundle of these files. `manifest` has all but the list of the files.
///
/// # Errors
/// A path, the number or the size of the files is refused.
pub fn write_bundle(manifest: BundleManifestV1, mut files: Vec<BundleFile>) -> Result<Vec<u8>, BundleError> {
    files.sort_by(|a, b| a.path.cmp(&b.path));
    let listed = |file: &BundleFile| BundledFileV1 {
        path: file.path.clone(),
        role: file.role,
        bytes: file.bytes.len() as u64,
        sha256: sha256_hex(&file.bytes),
    };
    let manifest = BundleManifestV1 { files: files.iter().map(listed).collect(), ..manifest };
    check_files(&manifest.files)?;
    let list = layout::to_bytes(&manifest, 2);
    let entries =
        || [(MANIFEST, &list[..])].into_iter().chain(files.iter().map(|f| (&*f.path, &f.bytes[..])));
    let failed = |error| BundleError::Damaged { reason: reason(&error) };
    let compressed = pack(entries(), true).map_err(failed)?;
    // Silence compresses to almost nothing; a reader would take that for a size bomb.
    let is_usual = sum(&manifest.files) <= at_most(compressed.len());
    let archive = if is_usual { compressed } else { pack(entries(), false).map_err(failed)? };
    let bytes = archive.len() as u64;
    if bytes > MAX_BYTES { Err(BundleError::TooLarge { bytes, most: MAX_BYTES }) } else { Ok(archive) }
}

/// A bundle that is being read.
pub struct Bundle<'a> {
    archive: ZipArchive<Cursor<&'a [u8]>>,
    list: Vec<u8>,
    manifest: BundleManifestV1,
    /// For each listed file, its index in the archive.
    entries: Vec<usize>,
}

impl<'a> Bundle<'a> {
    /// Reads the list of a bundle and checks that the archive has these files and no others. The files themselves are checked when they
    /// are read.
    ///
    /// # Errors
    /// The bytes are no bundle, or one that is refused.
    pub fn open(bytes: &'a [u8]) -> Result<Self, BundleError> {
        if !bytes.starts_with(b"PK\x03\x04") {
            return Err(BundleError::Format { found: Found::of(bytes) });
        }
        let damaged = |reason: &str| BundleError::Damaged { reason: reason.to_owned() };
        if !has_plain_end(bytes) {
            return Err(damaged("the archive has no end as a bundle has it"));
        }
        let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| damaged(&reason(&error)))?;
        if archive.has_duplicate_names() {
            return Err(damaged("two files have the same path"));
        }
        if archive.index_for_name_raw(MANIFEST.as_bytes()) != Some(0) {
            return Err(BundleError::OtherArchive);
        }
        let list = entry_bytes(&mut archive, 0, list_at_most(bytes.len()))
            .map_err(|reason| BundleError::File { path: MANIFEST.to_owned(), reason })?;
        minor_version(&list, FORMAT, VERSION_MAJOR)?;
        let manifest: BundleManifestV1 =
            serde_json::from_slice(&list).map_err(|error| damaged(&plain(&error.to_string())))?;
        check_files(&manifest.files)?;
        let (bytes, most) = (sum(&manifest.files), at_most(bytes.len()));
        if bytes > most {
            return Err(BundleError::TooLarge { bytes, most });
        }
        let mut entries = Vec::with_capacity(manifest.files.len());
        for file in &manifest.files {
            let entry = archive.index_for_name_raw(file.path.as_bytes()).ok_or_else(|| {
                BundleError::File { path: file.path.clone(), reason: "is missing".to_owned() }
            })?;
            entries.push(entry);
        }
        // The paths differ, so that more entries than these are not in the list.
        if archive.len() != entries.len() + 1 {
            return Err(damaged("it has files that are not in its list"));
        }
        Ok(Self { archive, list, manifest, entries })
    }

    /// The list of the files, and what they contain.
    pub fn manifest(&self) -> &BundleManifestV1 {
        &self.manifest
    }

    /// The bytes of `bundle.json`.
    pub fn list(&self) -> &[u8] {
        &self.list
    }

    /// Returns the content of the listed file with this index.
    ///
    /// # Errors
    /// There is no such file, it cannot be decompressed, or it is not the one that was bundled.
    pub fn file(&mut self, index: usize) -> Result<Vec<u8>, BundleError> {
        let (Some(listed), Some(&entry)) = (self.manifest.files.get(index), self.entries.get(index)) else {
            return Err(BundleError::Damaged { reason: format!("it has no file {}", index + 1) });
        };
        let failed = |reason: String| BundleError::File { path: listed.path.clone(), reason };
        let bytes = entry_bytes(&mut self.archive, entry, listed.bytes).map_err(failed)?;
        if bytes.len() as u64 != listed.bytes || sha256_hex(&bytes) != listed.sha256 {
            return Err(failed("was changed after the bundle was made".to_owned()));
        }
        Ok(bytes)
    }

    /// Checks the content of every file.
    ///
    /// # Errors
    /// As [`Bundle::file`], for the first file that fails.
    pub fn check(&mut self) -> Result<(), BundleError> {
        (0..self.entries.len()).try_for_each(|index| self.file(index).map(drop))
    }
}

/// Checks the paths, the number and the size of the files of a bundle.
fn check_files(files: &[BundledFileV1]) -> Result<(), BundleError> {
    if files.len() > MAX_FILES {
        return Err(BundleError::TooMany { n: files.len() });
    }
    // Some systems do not tell capital letters from small ones.
    let mut taken = BTreeSet::from([MANIFEST.to_owned()]);
    let mut folders = BTreeSet::new();
    for BundledFileV1 { path, .. } in files {
        check_path(path).map_err(|reason| BundleError::Path { path: path.clone(), reason })?;
        let lower = path.to_lowercase();
        folders.extend(lower.match_indices('/').map(|(end, _)| lower[..end].to_owned()));
        if !taken.insert(lower) {
            return Err(BundleError::Path { path: path.clone(), reason: "is that of another file" });
        }
    }
    if let Some(path) = taken.intersection(&folders).next() {
        return Err(BundleError::Path { path: path.clone(), reason: "is that of a folder" });
    }
    let bytes = sum(files);
    if bytes > MAX_BYTES {
        return Err(BundleError::TooLarge { bytes, most: MAX_BYTES });
    }
    Ok(())
}

fn sum(files: &[BundledFileV1]) -> u64 {
    files.iter().fold(0, |sum: u64, file| sum.saturating_add(file.bytes))
}

impl From<HeaderFault> for BundleError {
    fn from(fault: HeaderFault) -> Self {
        match fault {
            HeaderFault::TooDense(reason) | HeaderFault::Damaged(reason) => Self::Damaged { reason },
            HeaderFault::Format(_) => Self::OtherArchive,
            HeaderFault::Version(found) | HeaderFault::Major(found) => Self::Version { found },
        }
    }
}

#[cfg(test)]
mod tests;
