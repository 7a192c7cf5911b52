//! `shagreen model add`: registers a diffusion model of the user.

use std::path::PathBuf;

use serde_json::json;

use crate::cli::model_folder::model_folder;
use crate::cli::output;

/// Registers a diffusion model that generates pictures from text: Stable Diffusion 2.1, or another model with the same
/// file layout.
///
/// The folder must be in the layout of diffusers, with safetensors: unet, vae, text_encoder, scheduler and tokenizer.
/// It stays where it is; the program stores its path and the SHA-256 of each file. The model's licence states what it
/// may be used for. `generate --diffusion` generates pictures with it.
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
    output::note(
        "reading the whole model; this takes a while and needs memory of two to four times the model's size",
    );
    let added = model_folder()?.add_diffusion(&args.folder)?;
    let result = json!({"model": added.name(), "folder": added.folder, "sha256": added.sha256});
    output::print(args.json, &result, || {
        let line = |(name, hash): (&String, &String)| format!("{hash}  {name}");
        let lines: Vec<String> = added.sha256.iter().map(line).collect();
        format!("Added {}: {}\n{}", added.name(), added.folder.display(), lines.join("\n"))
    });
    Ok(())
}
