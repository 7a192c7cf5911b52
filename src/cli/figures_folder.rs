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
        let [svg, csv] = ["svg", "csv"].map(|ending| folder.join(format!("{name}.{ending}")));
        refuse_inputs(&[&svg, &csv], inputs)?;
        refuse_foreign(&svg, "a figure", |bytes| bytes.starts_with(b"<svg"))?;
        refuse_foreign(&csv, "the numbers of a figure", is_figure_csv)?;
    }
    Ok(())
}

/// The two files of a figure.
pub(crate) fn figure_files(folder: &Path, name: &str, figure: &Figure) -> [(PathBuf, Vec<u8>); 2] {
    [
        (folder.join(format!("{name}.svg")), figure_svg(figure).into_bytes()),
        (folder.join(format!("{name}.csv")), figure_csv(figure)),
    ]
}

/// Writes all files or none, into a folder of figures among others that is made for them.
pub(crate) fn write_together(files: &[(PathBuf, Vec<u8>)], folder: Option<&Path>) -> anyhow::Result<()> {
    // The innermost first: those that are made here go away again where nothing is written.
    let mut made: Vec<&Path> =
        folder.into_iter().flat_map(Path::ancestors).take_while(|path| !path.exists()).collect();
    made.retain(|path| !path.as_os_str().is_empty());
    let write = || {
        if let Some(folder) = folder {
            std::fs::create_dir_all(folder)
                .context("cannot make the folder; choose another")
                .with_context(|| output::in_file(folder))?;
        }
        let files: Vec<(&Path, &[u8])> = files.iter().map(|(path, bytes)| (&**path, &**bytes)).collect();
        Ok(atomic::write_all(&files)?)
    };
    write().inspect_err(|_| {
        for path in made {
            // The error is told; a folder that somebody else fills meanwhile stays.
            let _ = std::fs::remove_dir(path);
        }
    })
}
