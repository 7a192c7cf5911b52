//! Files of a texture model: their paths, what they may replace, and their contents.

use std::path::{Path, PathBuf};

use anyhow::bail;
use shagreen_core::actuator::Actuator;
use shagreen_formats::library::TextureEntry;

use super::signal_format::FilePart;
use super::{ExportFormat, suffixed_path, without_ending};
use crate::file::file_name;
use crate::replace::refuse_foreign;
use crate::report::Reporter;

/// What files hold beside the texture.
#[derive(Clone, Copy, Debug)]
pub struct ExportContext<'a> {
    /// Name and version of the program.
    pub created_by: &'a str,
    /// Actuator that the files are made for, for formats that describe one ([`ExportFormat::describes_actuator`]).
    pub actuator: Option<&'a Actuator>,
}

impl<'a> ExportContext<'a> {
    /// Without an actuator.
    pub fn new(created_by: &'a str) -> Self {
        Self { created_by, actuator: None }
    }
}

/// Returns the paths of all files that an export to `out` may write, `out` first.
pub fn model_paths(format: &dyn ExportFormat, out: &Path) -> Vec<PathBuf> {
    format.suffixes().iter().map(|suffix| suffixed_path(out, format.ending(), suffix)).collect()
}

/// Returns an error if an export would replace files of another kind. Files beside one of this format were written with it, so
/// that they may be replaced with it.
///
/// # Errors
/// There is such a file.
pub fn refuse_foreign_model(format: &dyn ExportFormat, out: &Path) -> anyhow::Result<()> {
    refuse_foreign(out, format.name(), |bytes| format.is_like(bytes))?;
    if out.is_file() {
        return Ok(());
    }
    let mut beside = model_paths(format, out).into_iter().skip(1);
    if let Some(path) = beside.find(|path| path.symlink_metadata().is_ok()) {
        bail!(
            "{} would replace a file that it has not written; choose another name, or move that file: {}",
            format.name(),
            path.display()
        );
    }
    Ok(())
}

/// Returns paths and contents of the files of a texture, `out` first.
///
/// # Errors
/// The format cannot represent the texture.
pub(super) fn model_files(
    texture: &TextureEntry,
    format: &dyn ExportFormat,
    out: &Path,
    context: &ExportContext<'_>,
) -> anyhow::Result<Vec<(PathBuf, Vec<u8>)>> {
    if let Some(reason) = format.refusal(texture) {
        bail!(reason);
    }
    let stem = file_name(&without_ending(out, format.ending()));
    let parts = format.files(texture, &stem, context)?;
    let path_and_bytes = |FilePart { suffix, bytes }| (suffixed_path(out, format.ending(), suffix), bytes);
    Ok(parts.into_iter().map(path_and_bytes).collect())
}

/// Warns of files of an earlier export that do not belong to the files that were written to `out`.
pub(super) fn warn_of_stale(
    format: &dyn ExportFormat,
    out: &Path,
    written: &[PathBuf],
    reporter: &dyn Reporter,
) {
    for stale in model_paths(format, out).iter().filter(|path| !written.contains(path) && path.exists()) {
        reporter.warn(&format!(
            "this file is of an earlier export and does not belong to the new one; delete it: {}",
            stale.display()
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::super::FORMATS;
    use super::super::test_support::library_with_heights;
    use super::{ExportContext, model_files, model_paths, refuse_foreign_model, warn_of_stale};
    use crate::report::Warnings;

    #[test]
    fn files_beside_an_own_file_only_are_replaced() {
        let library = library_with_heights();
        for format in FORMATS {
            let folder = tempfile::tempdir().unwrap();
            let out = folder.path().join("my cork").with_extension(format.ending());
            let files = model_files(&library.textures[0], format, &out, &ExportContext::new("test")).unwrap();
            let paths = model_paths(format, &out);
            assert!(files.iter().map(|(path, _)| path).eq(&paths), "{} writes {files:?}", format.id());
            for path in &paths {
                assert!(refuse_foreign_model(format, &out).is_ok());
                std::fs::write(path, "my notes").unwrap();
                let refused = refuse_foreign_model(format, &out).unwrap_err().to_string();
                assert!(refused.contains("would replace") && refused.contains("my cork"), "{refused}");
                std::fs::remove_file(path).unwrap();
            }
            for (path, bytes) in &files {
                std::fs::write(path, bytes).unwrap();
            }
            assert!(refuse_foreign_model(format, &out).is_ok());
            let warnings = Warnings::default();
            warn_of_stale(format, &out, &paths[..1], &warnings);
            assert_eq!(warnings.into_vec().len(), paths.len() - 1);
        }
    }
}
