//! `shagreen import hatt`: imports models in the XML of the Penn Haptic Texture Toolkit.

use std::path::PathBuf;

use anyhow::bail;
use serde_json::json;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::hatt::read_hatt;
use shagreen_formats::library::{Provenance, name_from_file};

use crate::cli::import::{Destination, Outcome, files_in};
use crate::cli::progress::Progress;
use shagreen_studio::file::{self, file_name};

/// Imports texture models in the XML of the Penn Haptic Texture Toolkit (HaTT).
///
/// The published models are for non-profit research and must not be redistributed. Their textures are marked as
/// restricted; commands that export them or save them in a library print a warning.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Model files, or folders of them.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    destination: Destination,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let files = model_files(&args.files)?;
    let mut outcome = Outcome::new(&args.destination, &files)?;
    let mut restricted = Vec::new();
    let progress = Progress::new("importing the models", files.len());
    for file in &files {
        // The outcome adds the name of the file.
        let read = file::read_file(file, FileKind::Document).map_err(|error| error.root_cause().to_string());
        match read.and_then(|bytes| read_hatt(&bytes).map_err(|error| error.to_string())) {
            Err(reason) => outcome.failed(file, reason),
            Ok(read) => {
                for warning in &read.warnings {
                    outcome.warn(file, warning);
                }
                let texture = read.value;
                let name = if texture.name.is_empty() {
                    name_from_file(&file_name(file))
                } else {
                    texture.name.clone()
                };
                let is_restricted = texture.provenance == Provenance::Restricted;
                if is_restricted {
                    restricted.push(name.clone());
                }
                let figures = json!({
                    "file": file.display().to_string(),
                    "nodes": texture.model.n_nodes(),
                    "order": texture.model.order(),
                    "ma_order": texture.model.ma_order(),
                    "rate_hz": texture.model.rate().0,
                    "restricted": is_restricted,
                });
                let mut entry = texture.into_entry(outcome.claim_id(&name));
                entry.name = name;
                outcome.imported(entry, figures);
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

/// Returns the named files, and the `.xml` files of the named folders, sorted by name.
fn model_files(paths: &[PathBuf]) -> anyhow::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for path in paths {
        if !path.is_dir() {
            files.push(path.clone());
            continue;
        }
        let found = files_in(path, &["xml"])?;
        if found.is_empty() {
            bail!("the folder contains no .xml file; choose the folder of the models: {}", path.display());
        }
        files.extend(found);
    }
    Ok(files)
}
