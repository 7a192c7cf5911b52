//! Unpacking of bundles from others, which may be damaged or made to do harm.

use std::path::Path;

use anyhow::{Context as _, bail};
use shagreen_formats::atomic;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::bundle::{Bundle, BundleManifestV1, MANIFEST};

use crate::file::{in_file, read_file};

/// Checks that every file of a bundle is the one that was bundled, and returns the list.
///
/// # Errors
/// The file cannot be read or is no bundle, or a file in it differs.
pub fn check_bundle(path: &Path) -> anyhow::Result<BundleManifestV1> {
    let bytes = read_file(path, FileKind::Recording)?;
    Ok(checked(&bytes, path)?.manifest().clone())
}

/// Unpacks a bundle into a new or empty folder, after all of its files were checked, and returns the list.
///
/// # Errors
/// As [`check_bundle`]; or the folder has files, or cannot be written.
pub fn extract_bundle(path: &Path, folder: &Path) -> anyhow::Result<BundleManifestV1> {
    let bytes = read_file(path, FileKind::Recording)?;
    let mut bundle = checked(&bytes, path)?;
    check_empty(folder)?;
    create(folder)?;
    atomic::write(&folder.join(MANIFEST), bundle.list())?;
    let manifest = bundle.manifest().clone();
    for (index, file) in manifest.files.iter().enumerate() {
        let content = bundle.file(index).with_context(|| in_file(path))?;
        // The path has passed the check of bundles, so that it stays in the folder, which had no links.
        let to = folder.join(&file.path);
        to.parent().map_or(Ok(()), create)?;
        atomic::write(&to, &content)
            .with_context(|| format!("the folder is incomplete; delete it: {}", folder.display()))?;
    }
    Ok(manifest)
}

fn checked<'a>(bytes: &'a [u8], path: &Path) -> anyhow::Result<Bundle<'a>> {
    let mut bundle = Bundle::open(bytes).with_context(|| in_file(path))?;
    bundle.check().with_context(|| in_file(path))?;
    Ok(bundle)
}

/// Checks that nothing in a folder can be overwritten.
fn check_empty(folder: &Path) -> anyhow::Result<()> {
    if folder.exists() && !folder.is_dir() {
        bail!(
            "a bundle is unpacked into a folder, but this is a file; choose another name: {}",
            folder.display()
        );
    }
    // A folder that does not exist is empty, and one that cannot be listed cannot be written either.
    let mut entries = std::fs::read_dir(folder).into_iter().flatten();
    if entries.next().is_some() {
        bail!(
            "the folder has files, which could be overwritten; choose a new or empty one: {}",
            folder.display()
        );
    }
    Ok(())
}

fn create(folder: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder)
        .context("cannot create the folder; check its name and your permissions")
        .with_context(|| in_file(folder))
}
