//! Input files: typed paths, and files dropped on the window.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::DroppedFileHandle;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::picture::PHOTO_ENDINGS;
use shagreen_formats::wav::sidecar_names;

use shagreen_studio::file::{ending_of, is_special, shown_name};
use shagreen_studio::import::is_importable;

use crate::strings::import as strings;

/// Maximum number of files taken from a folder.
const MAX_OF_FOLDER: usize = 1000;

/// Input file or folder.
#[derive(Clone, Debug)]
pub enum Source {
    /// Path.
    Path(PathBuf),
    /// File that the window system passed to the window.
    Dropped(DroppedFileHandle),
}

impl Source {
    /// Path of the file, or only its name if the window system provides no path.
    pub fn path(&self) -> &Path {
        match self {
            Self::Path(path) => path,
            Self::Dropped(file) => file.path(),
        }
    }

    /// Content of the file, or the reason why it cannot be read.
    pub(crate) fn bytes(&self) -> Result<Vec<u8>, String> {
        if is_special(self.path()) {
            return Err(format!("{}; choose a file", strings::NO_FILE));
        }
        match self {
            Self::Path(path) => bounded_file::read(path, FileKind::Recording).map_err(|error| {
                format!("the file cannot be read ({error}); check its path and permissions")
            }),
            Self::Dropped(file) => file.bytes().map_err(|error| {
                format!("the file cannot be read ({error}); drop it again, or copy it first")
            }),
        }
    }

    /// Last component of the path.
    pub(crate) fn name(&self) -> String {
        shown_name(self.path())
    }

    /// File ending in lower case.
    pub(crate) fn ending(&self) -> String {
        ending_of(self.path())
    }
}

/// Paths in a typed or pasted text, one per line. Quotes around a path are removed.
pub(crate) fn paths_in(text: &str) -> Vec<Source> {
    let lines = text.lines().map(|line| line.trim().trim_matches(['"', '\'']));
    lines.filter(|line| !line.is_empty()).map(|line| Source::Path(PathBuf::from(line))).collect()
}

/// Replaces folders by the files in them that can be imported, in alphabetical order. A folder without any stays, so
/// that this is reported.
pub(crate) fn without_folders(sources: Vec<Source>) -> Vec<Source> {
    sources
        .into_iter()
        // If the path does not exist, reading it reports that.
        .flat_map(|source| {
            let files = files_in(source.path(), |_| true).filter(|files| !files.is_empty());
            files.unwrap_or_else(|| vec![source])
        })
        .collect()
}

/// Wanted files in a folder that can be imported, photos included, in alphabetical order; `None` if it is no folder that can be listed.
pub(crate) fn files_in(folder: &Path, is_wanted: impl Fn(&Path) -> bool) -> Option<Vec<Source>> {
    // Entries that cannot be inspected cannot be read either.
    let entries = std::fs::read_dir(folder).ok()?.filter_map(|entry| Some(entry.ok()?.path()));
    let is_meant = |path: &PathBuf| {
        let ending = ending_of(path);
        let is_taken = is_importable(&ending) || PHOTO_ENDINGS.contains(&ending.as_str());
        is_taken && path.is_file() && is_wanted(path)
    };
    let mut files: Vec<PathBuf> = entries.filter(is_meant).collect();
    files.sort();
    Some(files.into_iter().take(MAX_OF_FOLDER).map(Source::Path).collect())
}

/// Sidecar of a WAV file, which states its units: imported together with it, or in the same folder.
pub(crate) fn sidecar_of(source: &Source, all: &[Source]) -> Option<Arc<[u8]>> {
    if source.ending() != "wav" {
        return None;
    }
    let names = sidecar_names(&source.name());
    if let Some(beside) = all.iter().find(|other| names.contains(&other.name())) {
        // A sidecar that cannot be read is listed as failed itself.
        return beside.bytes().ok().map(Into::into);
    }
    // Most WAV files have no sidecar; the reader then asks for the units.
    names
        .iter()
        .find_map(|name| bounded_file::read(&source.path().with_file_name(name), FileKind::Small).ok())
        .map(Into::into)
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
        // Reading this file would end at once: without the check it would count as an empty file.
        for path in ["/dev/null", "/"] {
            let reason = Source::Path(path.into()).bytes().unwrap_err();
            assert!(reason.contains(strings::NO_FILE), "{reason}");
        }
    }

    #[test]
    fn a_folder_is_the_files_in_it_that_can_be_imported() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b.CSV", "a.wav", "notes.md", "wall.JPG"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        let found = without_folders(paths_in(&folder.path().display().to_string()));
        let names: Vec<String> = found.iter().map(Source::name).collect();
        assert_eq!(names, ["a.wav", "b.CSV", "wall.JPG"]);
        assert_eq!(without_folders(paths_in("/nowhere/at/all.csv")).len(), 1);
        let empty = folder.path().join("empty");
        std::fs::create_dir(&empty).unwrap();
        let found = without_folders(vec![Source::Path(empty.clone())]);
        assert_eq!(found.iter().map(Source::path).collect::<Vec<_>>(), [empty], "it is not ignored");
    }
}
