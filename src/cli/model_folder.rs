//! Folder of the user's networks.

use anyhow::Context as _;
use directories::ProjectDirs;
use shagreen_studio::models::ModelFolder;

/// Returns the folder of third-party networks.
pub(crate) fn model_folder() -> anyhow::Result<ModelFolder> {
    let folders =
        ProjectDirs::from("", "", "shagreen").context("this system has no folder for user files")?;
    Ok(ModelFolder::new(folders.data_local_dir().join("models")))
}
