//! Files as they come in: a path that was typed, or something dropped on the window.

use std::path::{Path, PathBuf};

use egui::DroppedFileHandle;

use crate::strings::import as strings;

/// Most files that are taken out of a folder.
const MAX_OF_FOLDER: usize = 1000;

/// Endings of names of files that can be imported, in lower case.
const ENDINGS: [&str; 7] = ["csv", "txt", "tsv", "wav", "xml", "json", "toml"];

/// A file, or a folder of them.
#[derive(Clone, Debug)]
pub enum Source {
    /// By its path.
    Path(PathBuf),
    /// As the windowing system handed it over.
    Dropped(DroppedFileHandle),
}

impl Source {
    /// Where it is; a name alone where the windowing system tells no more.
    pub fn path(&self) -> &Path {
        match self {
            Self::Path(path) => path,
            Self::Dropped(file) => file.path(),
        }
    }

    /// Its bytes, or what kept it from being read.
    pub(crate) fn bytes(&self) -> Result<Vec<u8>, String> {
        if is_special(self.path()) {
            return Err(format!("{}; choose a file", strings::NO_FILE));
        }
        match self {
            Self::Path(path) => std::fs::read(path).map_err(|error| {
                format!("the file cannot be read ({error}); check its path and permissions")
            }),
            Self::Dropped(file) => file.bytes().map_err(|error| {
                format!("the file cannot be read ({error}); drop it again, or copy it first")
            }),
        }
    }

    /// The last part of its path.
    pub(crate) fn name(&self) -> String {
        name_of(self.path())
    }

    /// The ending of its name, in lower case.
    pub(crate) fn ending(&self) -> String {
        self.path().extension().map_or(String::new(), |ending| ending.to_string_lossy().to_lowercase())
    }
}

/// Whether a folder, pipe or device is at this path: the last two would be read for ever.
pub(crate) fn is_special(path: &Path) -> bool {
    path.metadata().is_ok_and(|metadata| !metadata.is_file())
}

/// The last part of a path.
pub(super) fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// The paths in a text that was typed or pasted, one a line; quotes around a path are taken off.
pub fn paths_in(text: &str) -> Vec<Source> {
    let lines = text.lines().map(|line| line.trim().trim_matches(['"', '\'']));
    lines.filter(|line| !line.is_empty()).map(|line| Source::Path(PathBuf::from(line))).collect()
}

/// Puts the files of folders in the place of the folders, in the order of their names: those whose ending is known.
pub(super) fn without_folders(sources: Vec<Source>) -> Vec<Source> {
    sources
        .into_iter()
        .flat_map(|source| match std::fs::read_dir(source.path()) {
            Ok(folder) => {
                // An entry that cannot be looked at is not one that can be read.
                let mut files: Vec<PathBuf> =
                    folder.filter_map(|entry| Some(entry.ok()?.path())).filter(|p| p.is_file()).collect();
                files.retain(|path| ENDINGS.contains(&Source::Path(path.clone()).ending().as_str()));
                files.sort();
                files.into_iter().take(MAX_OF_FOLDER).map(Source::Path).collect()
            }
            // No folder; where it is nothing at all, reading it says so.
            Err(_) => vec![source],
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{Source, paths_in, strings, without_folders};
    use std::path::Path;

    #[test]
    fn paths_are_one_a_line_with_or_without_quotes() {
        let sources = paths_in(" /a/b c.csv \n\n\"/d.wav\"\n'e.xml'");
        let paths: Vec<&Path> = sources.iter().map(Source::path).collect();
        assert_eq!(paths, [Path::new("/a/b c.csv"), Path::new("/d.wav"), Path::new("e.xml")]);
    }

    #[cfg(unix)]
    #[test]
    fn what_might_never_end_is_not_read() {
        // This one ends at once: without the check it would be an empty file.
        for path in ["/dev/null", "/"] {
            let reason = Source::Path(path.into()).bytes().unwrap_err();
            assert!(reason.contains(strings::NO_FILE), "{reason}");
        }
    }

    #[test]
    fn a_folder_is_the_files_in_it_that_can_be_imported() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b.CSV", "a.wav", "notes.md"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        let found = without_folders(paths_in(&folder.path().display().to_string()));
        let names: Vec<String> = found.iter().map(Source::name).collect();
        assert_eq!(names, ["a.wav", "b.CSV"]);
        assert_eq!(without_folders(paths_in("/nowhere/at/all.csv")).len(), 1);
    }
}
