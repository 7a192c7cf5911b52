//! Folder of the logs of a plan: the usual one beside the plan, or one that the user has chosen.

use std::path::{Path, PathBuf};

use shagreen_formats::library::free_id;
use shagreen_studio::file::file_name;
use shagreen_studio::study::logs::usual_log_folder;

/// Folder for logs that must not lie beside those of another plan: the usual one with the first number that is free.
pub(super) fn new_log_folder(plan: &Path) -> PathBuf {
    let usual = usual_log_folder(plan);
    let sibling = |name: &str| usual.with_file_name(name);
    sibling(&free_id(&file_name(&usual), |name| sibling(name).exists()))
}

#[cfg(test)]
mod tests {
    use super::{new_log_folder, usual_log_folder};

    #[test]
    fn a_new_folder_has_no_logs_of_others() {
        let folder = tempfile::tempdir().unwrap();
        let plan = folder.path().join("ten.toml");
        assert_eq!(new_log_folder(&plan), usual_log_folder(&plan));
        for expected in ["ten-logs", "ten-logs-2", "ten-logs-3"] {
            let new = new_log_folder(&plan);
            assert_eq!(new, folder.path().join(expected));
            std::fs::create_dir(&new).unwrap();
        }
    }
}
