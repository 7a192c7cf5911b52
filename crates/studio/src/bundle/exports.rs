//! Files that the user adds to a bundle.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::bundle::{BundleFile, BundleRole, MAX_BYTES, MAX_FILES};
use shagreen_formats::wav::SidecarV1;

use crate::file::{file_name, in_file, read_file};

/// Folder of added files in a bundle.
const FOLDER: &str = "exports";
/// Deepest folder below an added one.
const MAX_DEPTH: usize = 16;

/// Returns added files, and all files of added folders. Hidden files in a folder are left out, and links, because they lead
/// elsewhere.
///
/// # Errors
/// A file cannot be read, has a name that is no text, or there are too many.
pub(super) fn exports_of(paths: &[PathBuf]) -> anyhow::Result<Vec<BundleFile>> {
    let mut added = Added { files: Vec::new(), n_bytes: 0 };
    for path in paths {
        let name = file_name(path);
        if name.is_empty() {
            bail!("this folder has no name of its own; give it by its name: {}", path.display());
        }
        added.add(path, format!("{FOLDER}/{name}"), 0)?;
    }
    Ok(added.files)
}

struct Added {
    files: Vec<BundleFile>,
    n_bytes: u64,
}

impl Added {
    /// Adds a file, or all files of a folder, with this path in the bundle.
    fn add(&mut self, path: &Path, to: String, depth: usize) -> anyhow::Result<()> {
        if !path.is_dir() {
            return self.add_file(path, to);
        }
        if depth == MAX_DEPTH {
            bail!("the folders are nested too deeply; add a folder further in: {}", path.display());
        }
        let list = || -> std::io::Result<Vec<PathBuf>> {
            std::fs::read_dir(path)?.map(|entry| entry.map(|entry| entry.path())).collect()
        };
        let mut entries = list()
            .context("cannot read the folder; check your permissions")
            .with_context(|| in_file(path))?;
        entries.sort();
        for entry in entries {
            let Some(name) = entry.file_name().and_then(OsStr::to_str) else {
                bail!(
                    "the name of this file is no text that every system reads; rename it: {}",
                    entry.display()
                );
            };
            if !entry.is_symlink() && !name.starts_with('.') {
                self.add(&entry, format!("{to}/{name}"), depth + 1)?;
            }
        }
        Ok(())
    }

    fn add_file(&mut self, path: &Path, to: String) -> anyhow::Result<()> {
        let bytes = read_file(path, FileKind::Recording)?;
        self.n_bytes += bytes.len() as u64;
        if self.files.len() >= MAX_FILES || self.n_bytes > MAX_BYTES {
            bail!("these are more files than a bundle can have; add fewer: {}", path.display());
        }
        self.files.push(BundleFile { path: to, role: BundleRole::Export, bytes });
        Ok(())
    }
}

/// Returns whether a file describes a signal that was made of one of the textures with these identifiers.
pub(super) fn is_made_of(bytes: &[u8], ids: &[&str]) -> bool {
    let is_one = |id: &str| ids.contains(&id);
    bytes.first() == Some(&b'{')
        && serde_json::from_slice::<SidecarV1>(bytes)
            .is_ok_and(|sidecar| sidecar.parents.iter().any(|parent| is_one(&parent.id)))
}
