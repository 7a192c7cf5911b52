//! A folder of figures, each as SVG and CSV.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_formats::atomic;
use shagreen_formats::figure::{Figure, figure_csv, figure_svg, is_figure_csv};

use crate::cli::guard::{refuse_foreign, refuse_inputs};
use crate::cli::output;

/// Figures of these names must not replace what is read, nor somebody's files.
pub(crate) fn check_figures<S: Display>(
    folder: &Path,
    names: &[S],
    inputs: &[Option<&Path>],
) -> anyhow::Result<()> {
    if folder.exists() && !folder.is_dir() {
        bail!("figures go into a folder, and this is a file; name another: {}", folder.display());
    }
    for name in names {
        let [svg, csv] = places(folder, name);
        refuse_inputs(&[&svg, &csv], inputs)?;
        refuse_foreign(&svg, "a figure", |bytes| bytes.starts_with(b"<svg"))?;
        refuse_foreign(&csv, "the numbers of a figure", is_figure_csv)?;
    }
    Ok(())
}

/// Where the two files of a figure lie.
fn places<S: Display>(folder: &Path, name: &S) -> [PathBuf; 2] {
    ["svg", "csv"].map(|ending| folder.join(format!("{name}.{ending}")))
}

/// The two files of a figure.
pub(crate) fn figure_files(folder: &Path, name: &str, figure: &Figure) -> [(PathBuf, Vec<u8>); 2] {
    let [svg, csv] = places(folder, &name);
    [(svg, figure_svg(figure).into_bytes()), (csv, figure_csv(figure))]
}

/// Writes all files or none, into a folder of figures among others that is made for them.
pub(crate) fn write_together(files: &[(PathBuf, Vec<u8>)], folder: Option<&Path>) -> anyhow::Result<()> {
    let made = missing(folder);
    let write = || {
        make(folder)?;
        let files: Vec<(&Path, &[u8])> = files.iter().map(|(path, bytes)| (&**path, &**bytes)).collect();
        Ok(atomic::write_all(&files)?)
    };
    write().inspect_err(|_| take_away(&made))
}

/// Whether [`write_together`] could write these files and figures of these names by now; leaves everything as it was.
pub(crate) fn check_together<S: Display>(
    files: &[&Path],
    folder: Option<&Path>,
    names: &[S],
) -> anyhow::Result<()> {
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

/// The folders that have to be made, the innermost first.
fn missing(folder: Option<&Path>) -> Vec<&Path> {
    let mut missing: Vec<&Path> =
        folder.into_iter().flat_map(Path::ancestors).take_while(|path| !path.exists()).collect();
    missing.retain(|path| !path.as_os_str().is_empty());
    missing
}

fn make(folder: Option<&Path>) -> anyhow::Result<()> {
    let Some(folder) = folder else { return Ok(()) };
    std::fs::create_dir_all(folder)
        .context("cannot make the folder; choose another")
        .with_context(|| output::in_file(folder))
}

/// Takes folders away that were made here and hold nothing.
fn take_away(made: &[&Path]) {
    for path in made {
        // The error is told; a folder that somebody else fills meanwhile stays.
        let _ = std::fs::remove_dir(path);
    }
}
