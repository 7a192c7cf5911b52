//! The file of the settings, which follows them.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};

use egui::Context;
use shagreen_formats::atomic;
use shagreen_formats::settings::{Settings, read_settings, write_settings};

use crate::background::in_background;

/// The settings of the program, on the disk.
pub(crate) struct SettingsFile {
    /// `None` remembers nothing.
    path: Option<PathBuf>,
    written: Settings,
    writing: Option<Receiver<()>>,
}

impl SettingsFile {
    /// Reads the settings at `path`.
    pub(crate) fn open(path: Option<PathBuf>) -> (Self, Settings) {
        let settings = path.as_deref().map(read).unwrap_or_default();
        (Self { path, written: settings.clone(), writing: None }, settings)
    }

    /// Writes the settings in the background where they have changed.
    pub(crate) fn follow(&mut self, settings: &Settings, ctx: &Context) {
        if self.writing.as_ref().is_some_and(|writing| matches!(writing.try_recv(), Err(TryRecvError::Empty)))
        {
            return;
        }
        self.writing = None;
        let Some(path) = self.path.clone().filter(|_| self.written != *settings) else { return };
        self.written = settings.clone();
        let settings = settings.clone();
        self.writing = Some(in_background(ctx.clone(), move || write(&path, &settings)));
    }
}

/// Settings that are not there, or cannot be read, are as nobody had chosen any.
fn read(path: &Path) -> Settings {
    read_settings(&std::fs::read(path).unwrap_or_default())
}

/// Best effort: a program that cannot remember works as well.
fn write(path: &Path, settings: &Settings) {
    if let Some(folder) = path.parent() {
        let _ = std::fs::create_dir_all(folder);
    }
    let _ = atomic::write(path, &write_settings(settings));
}

#[cfg(test)]
mod tests {
    use super::{read, write};
    use shagreen_formats::settings::Settings;

    #[test]
    fn settings_come_back_from_a_folder_that_was_not_there() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sub/settings.json");
        assert_eq!(read(&path), Settings::default());
        let settings = Settings { is_light: Some(true), ..Settings::default() };
        write(&path, &settings);
        assert_eq!(read(&path), settings);
    }
}
