//! Export of signals: the audible texture, or all authored textures, with the options of the export sheet.

use std::path::{Path, PathBuf};

use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::library::{free_id, id_from_name};

use crate::state::signal_file::{SignalFile, SignalOptions};
use crate::strings::signal as strings;

/// Signals to be exported.
#[derive(Clone, Debug)]
pub struct SignalExport {
    /// The audible texture.
    pub file: SignalFile,
    /// All authored textures with their names; empty if there is only one signal.
    pub all: Vec<(String, SignalFile)>,
    /// How they are rendered and written.
    pub options: SignalOptions,
    /// Whether all authored textures are exported.
    pub is_all: bool,
}

impl SignalExport {
    /// The signal of the audible texture, and of all authored textures if there are several.
    pub fn new(file: SignalFile, all: Vec<(String, SignalFile)>) -> Self {
        let all = if all.len() > 1 && !file.is_of_bench() { all } else { Vec::new() };
        Self { file, all, options: SignalOptions::default(), is_all: false }
    }

    /// Names of the contained textures that may not be redistributed.
    pub fn restricted(&self) -> Vec<&str> {
        let mut names: Vec<&str> =
            self.files().flat_map(|file| file.restricted.iter().map(String::as_str)).collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    fn files(&self) -> Box<dyn Iterator<Item = &SignalFile> + '_> {
        if self.is_all {
            Box::new(self.all.iter().map(|(_, file)| file))
        } else {
            Box::new(std::iter::once(&self.file))
        }
    }

    /// Paths of the files to write. All authored textures get files of their own names beside `path`.
    pub fn paths(&self, path: &Path) -> Vec<PathBuf> {
        if !self.is_all {
            return vec![path.to_owned()];
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut names: Vec<String> = Vec::new();
        for (name, _) in &self.all {
            names.push(free_id(&id_from_name(name), |id| names.iter().any(|other| other == id)));
        }
        names.iter().map(|name| folder.join(name).with_extension("wav")).collect()
    }

    /// Renders and writes the signals. Nothing is written before all are found to be writable.
    ///
    /// # Errors
    /// States which signal cannot be rendered or written. Files that were written before it stay.
    pub fn write(&self, path: &Path) -> Result<(), String> {
        for (file, path) in self.files().zip(self.paths(path)) {
            file.write(&path, &self.options)?;
        }
        Ok(())
    }

    /// Whether one of the files exists already. A file that is no signal of this program is refused.
    ///
    /// # Errors
    /// Names the file that must not be replaced.
    pub fn would_replace(&self, path: &Path) -> Result<bool, String> {
        let mut exists = false;
        for path in self.paths(path) {
            if !SignalFile::may_lie_beside(&path) {
                return Err(strings::not_replaced(&path.with_extension("json").display().to_string()));
            }
            if path.symlink_metadata().is_err() {
                continue;
            }
            exists = true;
            let bytes = bounded_file::read(&path, FileKind::Recording).map_err(|error| error.to_string())?;
            if !SignalFile::may_replace(&path, &bytes) {
                return Err(strings::not_replaced(&path.display().to_string()));
            }
        }
        Ok(exists)
    }
}
