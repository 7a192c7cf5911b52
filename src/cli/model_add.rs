//! `shagreen model add`: registers a diffusion model of the user.

use std::path::PathBuf;

use serde_json::json;

use crate::cli::model_folder::model_folder;
use crate::cli::output;
use crate::cli::progress::Progress;

/// Registers a diffusion model that generates pictures from text: Stable Diffusion 2.1, or another model with the same
/// file layout.
///
/// The folder must have the file layout of the Python library diffusers, with safetensors files: unet, vae,
/// text_encoder, scheduler and tokenizer. The files are not copied; the program stores the path of the folder and the
/// SHA-256 of each file. The license of the model states its permitted uses. `generate --diffusion` generates pictures
/// with the model.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Folder of the model.
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    output::note("reading the whole model: this needs memory of two to four times the size of the model");
    let progress = Progress::endless("reading the model");
    let added = model_folder()?.add_diffusion(&args.folder)?;
    progress.finish();
    let result = json!({"model": added.name(), "folder": added.folder, "sha256": added.sha256});
    output::print(args.json, &result, || {
        let line = |(name, hash): (&String, &String)| format!("{hash}  {name}");
        let lines: Vec<String> = added.sha256.iter().map(line).collect();
        format!("Registered {}: {}\n{}", added.name(), added.folder.display(), lines.join("\n"))
    });
    Ok(())
}
