//! Figure files: a folder of figures, each as SVG and CSV.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_formats::atomic;
use shagreen_formats::figure::{Figure, figure_csv, figure_svg, is_figure_csv};

use crate::file::in_file;
use crate::replace::{refuse_foreign, refuse_inputs};

/// Checks that figures of these names would replace neither an input nor a file of another kind.
///
/// # Errors
/// The folder is a file, or a figure would replace an input or a file of another kind.
pub fn check_figures<S: Display>(folder: &Path, names: &[S], inputs: &[Option<&Path>]) -> anyhow::Result<()> {
    if folder.exists() && !folder.is_dir() {
        bail!(
            "figures are written into a folder, but this is a file; choose another folder: {}",
            folder.display()
        );
    }
    for name in names {
        let [svg, csv] = places(folder, name);
        refuse_inputs(&[&svg, &csv], inputs)?;
        refuse_foreign(&svg, "a figure", |bytes| bytes.starts_with(b"<svg"))?;
        refuse_foreign(&csv, "the data of a figure", is_figure_csv)?;
    }
    Ok(())
}

/// Returns the paths of a figure's two files.
fn places<S: Display>(folder: &Path, name: &S) -> [PathBuf; 2] {
    ["svg", "csv"].map(|ending| folder.join(format!("{name}.{ending}")))
}

/// Returns paths and contents of a figure's two files, SVG and CSV.
pub fn figure_files(folder: &Path, name: &str, figure: &Figure) -> [(PathBuf, Vec<u8>); 2] {
    let [svg, csv] = places(folder, &name);
    [(svg, figure_svg(figure).into_bytes()), (csv, figure_csv(figure))]
}

/// Writes all files or none. The folder of figures is created if it does not exist.
///
/// # Errors
/// The folder cannot be made or a file cannot be written; then none is.
pub fn write_together(files: &[(PathBuf, Vec<u8>)], folder: Option<&Path>) -> anyhow::Result<()> {
    let made = missing(folder);
    let write = || {
        make(folder)?;
        let files: Vec<(&Path, &[u8])> = files.iter().map(|(path, bytes)| (&**path, &**bytes)).collect();
        Ok(atomic::write_all(&files)?)
    };
    write().inspect_err(|_| take_away(&made))
}

/// Checks whether [`write_together`] could write these files and figures, and leaves the file system unchanged.
///
/// # Errors
/// The folder cannot be made, or a file could not be written.
pub fn check_together<S: Display>(files: &[&Path], folder: Option<&Path>, names: &[S]) -> anyhow::Result<()> {
    let made = missing(folder);
    let figures: Vec<PathBuf> =
        folder.iter().flat_map(|folder| names.iter().flat_map(|name| places(folder, name))).collect();
    let check = || {
        make(folder)?;
        let paths: Vec<&Path> = files.iter().copied().chain(figures.iter().map(PathBuf::as_path)).collect();
        Ok(atomic::check_all(&paths)?)
    };
    let checked = check();
    take_away(&made);
    checked
}

/// Returns the folders that do not exist yet, the innermost first.
fn missing(folder: Option<&Path>) -> Vec<&Path> {
    let mut missing: Vec<&Path> =
        folder.into_iter().flat_map(Path::ancestors).take_while(|path| !path.exists()).collect();
    missing.retain(|path| !path.as_os_str().is_empty());
    missing
}

/// Creates a folder that does not exist yet, with those around it.
///
/// # Errors
/// The folder cannot be created.
pub(crate) fn make(folder: Option<&Path>) -> anyhow::Result<()> {
    let Some(folder) = folder else { return Ok(()) };
    std::fs::create_dir_all(folder)
        .context("cannot create the folder; choose another")
        .with_context(|| in_file(folder))
}

/// Removes the folders that were created here if they are empty.
fn take_away(made: &[&Path]) {
    for path in made {
        // The first error is reported; a folder that another program fills meanwhile stays.
        let _ = std::fs::remove_dir(path);
    }
}
