//! Folder of the user's networks.

use anyhow::Context as _;
use directories::ProjectDirs;
use shagreen_studio::models::ModelFolder;

/// Returns the folder of downloaded and registered networks.
pub(crate) fn model_folder() -> anyhow::Result<ModelFolder> {
    let folders = ProjectDirs::from("", "", "shagreen")
        .context("no home folder was found, so there is no folder for networks; set HOME and try again")?;
    Ok(ModelFolder::new(folders.data_local_dir().join("models")))
}
