//! Where this system keeps the files of a user.

use anyhow::Context as _;
use directories::ProjectDirs;
use shagreen_app::models::ModelFolder;

/// The folder with networks of others.
pub(crate) fn model_folder() -> anyhow::Result<ModelFolder> {
    let folders =
        ProjectDirs::from("", "", "shagreen").context("this system has no folder for the files of a user")?;
    Ok(ModelFolder::new(folders.data_local_dir().join("models")))
}
