//! The settings file, which is written when the settings change.

use std::convert::Infallible;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::Context;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::locked_update::update;
use shagreen_formats::settings::{Settings, merged, read_settings, write_settings};

use crate::state::background::in_background;
use crate::strings::rig as strings;

/// The settings file of the program.
pub(crate) struct SettingsFile {
    /// Path of the file; `None` stores nothing.
    path: Option<PathBuf>,
    written: Settings,
    /// Reason why the file's device setup is unreadable.
    problem: Option<String>,
    writing: Option<Receiver<()>>,
}

impl SettingsFile {
    /// Reads the settings at `path`.
    pub(crate) fn open(path: Option<PathBuf>) -> (Self, Settings) {
        let (settings, problem) = path.as_deref().map(read).unwrap_or_default();
        (Self { path, written: settings.clone(), problem, writing: None }, settings)
    }

    /// Reason why nothing may be driven: the file exists, but its device setup is unreadable.
    pub(crate) fn problem(&self) -> Option<&str> {
        self.problem.as_deref()
    }

    /// Writes changed settings in the background. A file with an unreadable device setup is not overwritten until the
    /// user selects an output.
    pub(crate) fn follow(&mut self, settings: &Settings, ctx: &Context) {
        let has_output = settings.rig.as_ref().is_some_and(|rig| rig.output.is_some());
        if self.problem.is_some() && !has_output {
            return;
        }
        self.problem = None;
        if self.writing.as_ref().is_some_and(|writing| matches!(writing.try_recv(), Err(TryRecvError::Empty)))
        {
            return;
        }
        self.writing = None;
        let Some(path) = self.path.clone().filter(|_| self.written != *settings) else { return };
        let (before, settings) = (std::mem::replace(&mut self.written, settings.clone()), settings.clone());
        self.writing = Some(in_background(ctx.clone(), move || write(&path, &before, &settings)));
    }
}

/// Missing or unreadable settings fall back to defaults. An unreadable device setup is reported.
fn read(path: &Path) -> (Settings, Option<String>) {
    let (settings, reason) = match bounded_file::read(path, FileKind::Small) {
        Ok(bytes) => {
            let (settings, error) = read_settings(&bytes);
            (settings, error.map(|error| error.to_string()))
        }
        // The first start of the program.
        Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
            (Settings::default(), None)
        }
        Err(error) => (Settings::default(), Some(error.to_string())),
    };
    (settings, reason.map(|reason| strings::unreadable(&path.display().to_string(), &reason)))
}

/// Writes the settings that changed since `before`; those that another window has changed stay. Errors are ignored:
/// without stored settings the program still works.
fn write(path: &Path, before: &Settings, settings: &Settings) {
    if let Some(folder) = path.parent() {
        let _ = std::fs::create_dir_all(folder);
    }
    let merge = |present: Option<&[u8]>| -> Result<Vec<u8>, Infallible> {
        // A file with an error is replaced; a message has said so.
        let theirs = present.map(read_settings).and_then(|(theirs, error)| error.is_none().then_some(theirs));
        Ok(write_settings(
            &theirs.map_or_else(|| settings.clone(), |theirs| merged(before, settings, theirs)),
        ))
    };
    let _ = update(path, FileKind::Small, merge);
}

#[cfg(test)]
mod tests {
    use super::{read, write};
    use shagreen_formats::settings::Settings;

    #[test]
    fn settings_come_back_from_a_folder_that_was_not_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sub/settings.json");
        assert_eq!(read(&path), (Settings::default(), None));
        let settings = Settings { is_light: Some(true), ..Settings::default() };
        write(&path, &Settings::default(), &settings);
        assert_eq!(read(&path), (settings, None));
        // An existing settings path that cannot be read is an error, not a first start.
        let (nothing, problem) = read(folder.path());
        assert!(nothing == Settings::default() && problem.is_some());
    }
}
