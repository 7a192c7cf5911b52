//! Folder of the user's networks.

use anyhow::Context as _;
use shagreen_studio::models::ModelFolder;

use crate::cli::own_folder::own_folder;

/// Returns the folder of downloaded and registered networks.
pub(crate) fn model_folder() -> anyhow::Result<ModelFolder> {
    let folder = own_folder()
        .context("no home folder was found, so there is no folder for networks; set HOME and try again")?;
    Ok(ModelFolder::new(folder.join("models")))
}
