//! Export of textures to the formats of other programs.

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::types::{PyDict, PyDictMethods as _};
use pyo3::{Bound, PyResult, Python, pyfunction};
use shagreen_formats::library::Library;
use shagreen_studio::export::{
    ExportContext, ExportFormat, ExportOutcome, FORMATS, export as export_entry, format as format_of,
};

use crate::errors::{refused, run};
use crate::texture::PyTexture;

/// Name and version of the program, for the files that it writes.
const CREATED_BY: &str = concat!("shagreen ", env!("CARGO_PKG_VERSION"));

/// Exports a texture in the format of another program, as `shagreen export` does.
///
/// `format` is the id of one of `export_formats()`. A file of the same format is replaced, and no other file. Returns a
/// dictionary: `files` that were written, properties of the texture that are `lost` because the format cannot hold them, and the
/// `license` of the texture.
#[pyfunction]
pub(crate) fn export<'py>(
    py: Python<'py>,
    texture: &PyTexture,
    format: &str,
    path: PathBuf,
) -> PyResult<Bound<'py, PyDict>> {
    let sounding = Arc::clone(&texture.0);
    let wanted = format_of(format).ok_or_else(|| {
        let known: Vec<&str> = FORMATS.into_iter().map(ExportFormat::id).collect();
        refused(format!(
            "there is no format \"{format}\" for textures; choose one of {}, or render a signal",
            known.join(", ")
        ))
    })?;
    let outcome = run(py, move |reporter| {
        // The entry states its own terms of use.
        let context = ExportContext::new(CREATED_BY);
        export_entry(&Library::default(), &sounding.entry()?, wanted, (&path, &context), reporter)
    })?;
    let ExportOutcome { files, lost, license, .. } = outcome;
    let result = PyDict::new(py);
    result.set_item("files", files.iter().map(|file| file.display().to_string()).collect::<Vec<_>>())?;
    result.set_item("lost", lost)?;
    result.set_item("license", license)?;
    Ok(result)
}

/// Returns the export formats of textures: dictionaries with `id`, `name`, `ending` and `help`.
#[pyfunction]
pub(crate) fn export_formats(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let mut formats = Vec::new();
    for format in FORMATS {
        let of = PyDict::new(py);
        of.set_item("id", format.id())?;
        of.set_item("name", format.name())?;
        of.set_item("ending", format.ending())?;
        of.set_item("help", format.help())?;
        formats.push(of);
    }
    Ok(formats)
}
