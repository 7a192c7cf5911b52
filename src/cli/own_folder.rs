//! Folder in which Shagreen keeps files of the user, and the libraries that projects may read.

use std::path::PathBuf;

use directories::ProjectDirs;
use shagreen_studio::permitted_libraries::Permitted;

/// Returns the folder; `None` without a home folder.
pub(crate) fn own_folder() -> Option<PathBuf> {
    ProjectDirs::from("", "", "shagreen").map(|folders| folders.data_local_dir().to_owned())
}

/// Returns which libraries the projects of a command may read: all, because a script can answer no question. One outside
/// the folders of the project and of Shagreen gets a warning.
pub(crate) fn permitted_libraries() -> Permitted {
    Permitted::AllWarned(own_folder().into_iter().collect())
}
