//! `shagreen model add`: a model of the user's that makes pictures.

use std::path::PathBuf;

use serde_json::json;

use crate::cli::model_folder::model_folder;
use crate::cli::output;

/// Uses a model that makes pictures from words: Stable Diffusion 2.1, or another whose files are laid out as its are.
///
/// The folder is in the layout of diffusers, with safetensors: unet, vae, text_encoder, scheduler and tokenizer. It stays where
/// it is; the program keeps in mind where, and what each file was, by SHA-256. Which model may be used for what is said by its
/// licence, not by this program. `generate --diffusion` makes pictures with it.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The folder.
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    output::note("reading the whole model, which takes a while and two to four times its size of memory");
    let added = model_folder()?.add_diffusion(&args.folder)?;
    let result = json!({"model": added.name(), "folder": added.folder, "sha256": added.sha256});
    output::print(args.json, &result, || {
        let line = |(name, hash): (&String, &String)| format!("{hash}  {name}");
        let lines: Vec<String> = added.sha256.iter().map(line).collect();
        format!("Added {}: {}\n{}", added.name(), added.folder.display(), lines.join("\n"))
    });
    Ok(())
}
