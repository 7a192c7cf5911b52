//! Path of the file, or of the folder of several files.

use std::path::{Path, PathBuf};

use shagreen_studio::export::{self, FormatInfo, without_ending};

use crate::sheets::export::ExportSheet;

impl ExportSheet {
    /// Turns the path of a file into that of its folder if all textures are exported, and the other way round.
    pub(super) fn follow_number(&mut self) {
        let path = if self.is_all {
            let path = self.folder();
            let without = without_ending(Path::new(self.path.text()), self.format.ending);
            if let Some(name) = without.file_name().filter(|_| path.is_some()) {
                self.name = name.to_string_lossy().into_owned();
            }
            path.unwrap_or_else(|| PathBuf::from(self.path.text()))
        } else {
            // A name may have dots.
            Path::new(self.path.text()).join(format!("{}.{}", self.name, self.format.ending))
        };
        self.path.set(&path);
    }

    /// Folder of the typed path if that is the path of a file: one with the ending of a format.
    pub(super) fn folder(&self) -> Option<PathBuf> {
        let path = Path::new(self.path.text());
        let is_file = export::listed().any(|format| has_ending(path, format.ending)) && !path.is_dir();
        if is_file { path.parent().map(Path::to_owned) } else { None }
    }

    /// Replaces the ending of the path if it is that of the format before.
    pub(super) fn follow_format(&mut self, before: FormatInfo) {
        let path = Path::new(self.path.text());
        if has_ending(path, before.ending) {
            let mut path = without_ending(path, before.ending).into_os_string();
            path.push(".");
            path.push(self.format.ending);
            self.path.set(Path::new(&path));
        }
    }
}

/// Whether a path has this ending, which may contain dots.
pub(super) fn has_ending(path: &Path, ending: &str) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    name.strip_suffix(ending).is_some_and(|stem| stem.len() > 1 && stem.ends_with('.'))
}
