//! `shagreen model list`: lists third-party networks on this machine.

use serde_json::json;
use shagreen_studio::models::EFFICIENTNET_LITE0_LICENSE;

use crate::cli::model_folder::model_folder;
use crate::cli::output;

/// Lists the third-party neural networks that the program uses on this computer, and the commands that add missing
/// ones.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let folder = model_folder()?;
    let (backbone, added) = (folder.backbone()?, folder.added_diffusion()?);
    let path = folder.efficientnet_lite0();
    let result = json!({
        "pictures_to_attributes": backbone.as_ref().map(|backbone| json!({
            "model": backbone.kind().name(), "file": path, "sha256": backbone.sha256(),
            "license": EFFICIENTNET_LITE0_LICENSE,
        })),
        "words_to_pictures": added.as_ref().map(|added| json!({
            "model": added.name(), "folder": added.folder, "sha256": added.sha256,
        })),
    });
    output::print(args.json, &result, || {
        let seeing = match &backbone {
            Some(backbone) => {
                format!("{} ({EFFICIENTNET_LITE0_LICENSE}): {}", backbone.kind().name(), path.display())
            }
            None => "statistics of the picture; `shagreen model fetch` downloads a more accurate network"
                .to_owned(),
        };
        let making = match &added {
            Some(added) => format!("{}: {}", added.name(), added.folder.display()),
            None => {
                "the procedural generator; `shagreen model add FOLDER` registers a diffusion model".to_owned()
            }
        };
        format!("attributes from pictures: {seeing}\npictures from text: {making}")
    });
    Ok(())
}
