//! `shagreen import hatt`: imports models in the XML of the Penn Haptic Texture Toolkit.

use std::path::PathBuf;

use anyhow::bail;

use crate::cli::import::{Destination, files_in};
use crate::cli::import_models::{ModelFile, import_models};
use shagreen_studio::import::HATT;

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
    let models: Vec<ModelFile> = files.into_iter().map(|path| ModelFile { path, format: HATT }).collect();
    import_models(&models, &args.destination)
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
