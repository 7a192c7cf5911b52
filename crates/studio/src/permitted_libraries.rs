//! Libraries that a project may read: those in its own folder, and those outside it that the user has permitted.
//!
//! A project that comes from someone else can name any file of this computer as its library.

use std::fmt;
use std::path::{Component, Path, PathBuf};

/// Libraries outside the folder of a project that may be read.
#[derive(Clone, Debug)]
pub enum Permitted {
    /// All, because this program wrote the project itself.
    All,
    /// All, with a warning for a library that is neither in the folder of the project nor at one of these places.
    AllWarned(Vec<PathBuf>),
    /// Those at these places: files, or folders with all that is below them.
    Only(Vec<PathBuf>),
}

/// A project names a library outside its folder that is not permitted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutsideLibrary {
    /// Absolute path of the library.
    pub library: PathBuf,
}

impl fmt::Display for OutsideLibrary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let library = self.library.display();
        write!(f, "the library is outside the folder of the project and is not permitted: {library}")
    }
}

impl std::error::Error for OutsideLibrary {}

impl Permitted {
    /// Returns whether a library is in the folder of its project or at a permitted place. Links are followed.
    pub fn covers(&self, library: &Path, folder: &Path) -> bool {
        let places = match self {
            Self::All => return true,
            Self::AllWarned(places) | Self::Only(places) => places,
        };
        let mut allowed = Vec::new();
        for place in places.iter().map(PathBuf::as_path).chain([folder]) {
            allowed.push(without_dots(place));
            // A place may be reached by several names.
            allowed.extend(place.canonicalize().ok());
        }
        let is_allowed = |path: &Path| allowed.iter().any(|place| path.starts_with(place));
        // The name is checked first: asking the system about a file can contact another computer. A file that does not
        // exist is reported when it is read.
        is_allowed(&without_dots(library)) && library.canonicalize().ok().is_none_or(|real| is_allowed(&real))
    }
}

/// Returns the absolute path without `.` and `..`, without asking the system about links.
pub(crate) fn without_dots(path: &Path) -> PathBuf {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let mut plain = PathBuf::new();
    for component in absolute.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir => {
                plain.pop();
            }
            other => plain.push(other),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::{Permitted, without_dots};
    use std::path::Path;

    #[test]
    fn dots_are_resolved_in_the_name() {
        for (path, expected) in [("/a/b/../c.json", "/a/c.json"), ("/../a/./b", "/a/b"), ("/a//b/", "/a/b")] {
            assert_eq!(without_dots(Path::new(path)), Path::new(expected), "{path}");
        }
    }

    #[test]
    fn the_folder_of_the_project_and_permitted_places_are_covered() {
        let only = Permitted::Only(vec!["/data/shagreen".into(), "/other/b.json".into()]);
        for (library, expected) in [
            ("/woods/mine.json", true),
            ("/woods/sub/mine.json", true),
            ("/woods/../mine.json", false),
            ("/woods-2/mine.json", false),
            ("/data/shagreen/x/mine.json", true),
            ("/other/b.json", true),
            ("/other/c.json", false),
        ] {
            assert_eq!(only.covers(Path::new(library), Path::new("/woods")), expected, "{library}");
        }
        assert!(Permitted::All.covers(Path::new("/other/c.json"), Path::new("/woods")));
    }

    #[cfg(unix)]
    #[test]
    fn a_link_does_not_lead_out_of_the_folder() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().canonicalize().unwrap();
        for name in ["near", "elsewhere"] {
            std::fs::create_dir(root.join(name)).unwrap();
        }
        std::fs::write(root.join("elsewhere/mine.json"), "").unwrap();
        std::os::unix::fs::symlink(root.join("elsewhere/mine.json"), root.join("near/mine.json")).unwrap();
        std::os::unix::fs::symlink(root.join("near"), root.join("by-name")).unwrap();
        let only = Permitted::Only(Vec::new());
        assert!(!only.covers(&root.join("near/mine.json"), &root.join("near")));
        std::fs::write(root.join("near/own.json"), "").unwrap();
        assert!(only.covers(&root.join("near/own.json"), &root.join("by-name")));
    }
}
