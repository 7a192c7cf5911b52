//! The folder of a batch: which folders a batch may write into, and the names in it.

use std::ffi::OsStr;
use std::path::Path;

use anyhow::{Context as _, bail};
use shagreen_formats::atomic;
use shagreen_formats::batch_record::{batch_folder_mark, is_batch_folder_mark};
use shagreen_formats::bounded_file::{self, FileKind};

use crate::file::in_file;

/// Name of the file that marks the folder of a batch.
pub const MARK: &str = "batch.json";
/// Folder of the records of finished jobs.
pub(super) const RECORDS: &str = "records";
/// Beginning of the names under which files are written before they are renamed.
const TEMPORARY: &str = ".shagreen-";

/// Creates the folder of a batch with a folder for each output, and marks it. Several runs may do this at once.
///
/// # Errors
/// The folder has files that no batch wrote, or cannot be written.
pub(super) fn prepare(folder: &Path, name: &str, outputs: &[&str]) -> anyhow::Result<()> {
    if folder.is_file() {
        bail!(
            "a batch is written into a folder, but this is a file; choose another folder: {}",
            folder.display()
        );
    }
    let mark = folder.join(MARK);
    let is_marked =
        || bounded_file::read(&mark, FileKind::Small).is_ok_and(|bytes| is_batch_folder_mark(&bytes));
    // Folders of outputs are made after the mark, so that another run that begins at the same time has marked what it has filled.
    if has_files(folder) && !is_marked() {
        bail!(
            "the folder has files that no batch has written, which could be overwritten; choose an empty folder: {}",
            folder.display()
        );
    }
    create(folder)?;
    if !is_marked() {
        atomic::write(&mark, &batch_folder_mark(name))?;
    }
    for output in outputs {
        create(&folder.join(output))?;
        create(&folder.join(RECORDS).join(output))?;
    }
    Ok(())
}

fn create(folder: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder)
        .context("cannot create the folder; check its name and your permissions")
        .with_context(|| in_file(folder))
}

/// Whether a folder has files, apart from those that are being written at this moment.
fn has_files(folder: &Path) -> bool {
    let is_temporary = |name: &OsStr| name.to_str().is_some_and(|name| name.starts_with(TEMPORARY));
    // A folder that does not exist has none, and one that cannot be listed cannot be written either.
    let mut entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.any(|entry| !is_temporary(&entry.file_name()))
}
