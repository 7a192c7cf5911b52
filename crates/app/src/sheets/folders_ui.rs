//! Menu of the folders that were used last.

use std::path::{Path, PathBuf};

use egui::Ui;

use crate::strings::document as strings;

/// Width that the button needs beside a path field, in points.
pub(crate) const FOLDERS_WIDTH: f32 = 84.0;
/// Largest number of folders.
const MOST: usize = 8;

/// Folders of these files, without doubles, in the same order.
pub(crate) fn folders_of(paths: impl IntoIterator<Item: AsRef<Path>>) -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> = Vec::new();
    for path in paths {
        let Some(folder) = path.as_ref().parent() else { continue };
        let is_new = !folder.as_os_str().is_empty() && folders.iter().all(|other| other != folder);
        if is_new && folders.len() < MOST {
            folders.push(folder.to_owned());
        }
    }
    folders
}

/// Draws a button that lists the folders, if there are any; returns the one that was chosen.
pub(crate) fn folders_ui(ui: &mut Ui, folders: &[PathBuf]) -> Option<PathBuf> {
    let mut chosen = None;
    if folders.is_empty() {
        return None;
    }
    let menu = ui.menu_button(strings::FOLDERS, |ui| {
        for folder in folders {
            if ui.button(folder.display().to_string()).clicked() {
                chosen = Some(folder.clone());
                // By the keyboard too.
                ui.close();
            }
        }
    });
    menu.response.on_hover_text(strings::FOLDERS_HELP);
    chosen
}

#[cfg(test)]
mod tests {
    use super::folders_of;
    use std::path::{Path, PathBuf};

    #[test]
    fn each_folder_is_listed_once() {
        let paths = ["/a/b.shagreen", "/c/d.shagreen", "/a/e.shagreen", "f.shagreen"];
        assert_eq!(folders_of(paths.map(Path::new)), [PathBuf::from("/a"), PathBuf::from("/c")]);
    }
}
