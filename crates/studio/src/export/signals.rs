//! Writing a signal of one stroke: its paths, what it may replace, and its files.

use std::path::{Path, PathBuf};

use anyhow::bail;

use super::signal_format::{FilePart, SignalFormat, StrokeSignal, path_of};
use crate::figure_files::write_together;
use crate::file::check_ending;
use crate::replace::refuse_foreign;
use crate::report::Reporter;

/// Returns the paths of all files that an export to `out` may write, the first file first.
///
/// # Errors
/// The name has the ending of another format.
pub fn signal_paths(
    format: &dyn SignalFormat,
    out: &Path,
    has_actuator: bool,
) -> anyhow::Result<Vec<PathBuf>> {
    check_ending(format.name(), format.ending(), out)?;
    Ok(format.suffixes(has_actuator).iter().map(|suffix| path_of(format, out, suffix)).collect())
}

/// Returns an error if the files of a signal would replace a file of another kind.
///
/// # Errors
/// A file at one of the paths is of another kind.
pub fn refuse_foreign_files(format: &dyn SignalFormat, paths: &[PathBuf]) -> anyhow::Result<()> {
    let refuse =
        |path: &PathBuf| refuse_foreign(path, format.name(), |bytes| format.may_replace(path, bytes));
    paths.iter().try_for_each(refuse)
}

/// Returns the acceleration in m/s² of full scale for signals that share it, from that of each
/// ([`SignalFormat::full_scale_mps2`]): the highest, or 1 if all are silent.
pub fn shared_full_scale_mps2(each: impl IntoIterator<Item = f64>) -> f64 {
    let highest = each.into_iter().fold(0.0, f64::max);
    if highest > 0.0 { highest } else { 1.0 }
}

/// Writes the files of a signal, all or none, and returns their paths. It passes on the warning of the format, and warns of a
/// file of an earlier export that belongs to no file of this one.
///
/// # Errors
/// The format cannot represent the signal, or a file cannot be written.
pub fn write_signal(
    format: &dyn SignalFormat,
    signal: &StrokeSignal<'_>,
    (out, created_by): (&Path, &str),
    reporter: &dyn Reporter,
) -> anyhow::Result<Vec<PathBuf>> {
    let parts = format.files(signal, created_by)?;
    let files: Vec<(PathBuf, Vec<u8>)> =
        parts.into_iter().map(|FilePart { suffix, bytes }| (path_of(format, out, suffix), bytes)).collect();
    let written: Vec<PathBuf> = files.iter().map(|(path, _)| path.clone()).collect();
    if written.iter().skip(1).any(|path| path == out) {
        bail!(
            "two files of the export would have this name; choose a name ending in .{}: {}",
            format.ending(),
            out.display()
        );
    }
    write_together(&files, None)?;
    if let Some(warning) = format.warning(signal) {
        reporter.warn(&warning);
    }
    let possible = format.suffixes(signal.acf.is_some()).iter().map(|suffix| path_of(format, out, suffix));
    for stale in possible.filter(|path| !written.contains(path) && path.exists()) {
        reporter.warn(&format!(
            "this file is of an earlier export and does not belong to the new one; delete it: {}",
            stale.display()
        ));
    }
    Ok(written)
}

#[cfg(test)]
mod tests;
