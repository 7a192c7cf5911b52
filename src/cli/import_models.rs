//! Import of files of texture models into a library.

use std::path::{Path, PathBuf};

use serde_json::json;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::imported::Imported;
use shagreen_formats::library::{Provenance, TextureEntry};

use crate::cli::import::{Destination, Outcome};
use crate::cli::progress::Progress;
use shagreen_studio::file::{self, file_name};
use shagreen_studio::import::ImportFormat;

/// File of texture models, and its format.
pub(crate) struct ModelFile {
    pub(crate) path: PathBuf,
    pub(crate) format: &'static dyn ImportFormat,
}

/// Imports the textures of all files. A file that cannot be read is reported, and the others are imported.
///
/// # Errors
/// Nothing was imported, or the library cannot be written.
pub(crate) fn import_models(models: &[ModelFile], destination: &Destination) -> anyhow::Result<()> {
    let paths: Vec<PathBuf> = models.iter().map(|model| model.path.clone()).collect();
    let mut outcome = Outcome::new(destination, &paths)?;
    let mut restricted = Vec::new();
    let progress = Progress::new("importing the models", models.len());
    for ModelFile { path, format } in models {
        // The outcome adds the name of the file.
        let read = file::read_file(path, FileKind::Document).map_err(|error| error.root_cause().to_string());
        match read.and_then(|bytes| format.read(&file_name(path), &bytes)) {
            Err(reason) => outcome.failed(path, reason),
            Ok(Imported { value: entries, warnings }) => {
                for warning in &warnings {
                    outcome.warn(path, warning);
                }
                for mut entry in entries {
                    entry.id = outcome.claim_id(&entry.id);
                    let is_restricted = entry.provenance == Provenance::Restricted;
                    restricted.extend(is_restricted.then(|| entry.name.clone()));
                    let figures = figures(path, &entry);
                    outcome.imported(entry, figures);
                }
            }
        }
        progress.step();
    }
    progress.finish();
    let names: Vec<&str> = restricted.iter().map(String::as_str).collect();
    if let Some(warning) = Provenance::warning(&names) {
        outcome.warn_of_all(warning);
    }
    outcome.finish(json!({}))
}

fn figures(path: &Path, entry: &TextureEntry) -> serde_json::Value {
    json!({
        "file": path.display().to_string(),
        "nodes": entry.model.n_nodes(),
        "order": entry.model.order(),
        "ma_order": entry.model.ma_order(),
        "rate_hz": entry.model.rate().0,
        "restricted": entry.provenance == Provenance::Restricted,
    })
}
