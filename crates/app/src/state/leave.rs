//! Reasons to leave the open project.

use shagreen_formats::gallery::GalleryProject;

/// Reason to leave the open project.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leave {
    /// A new project.
    New,
    /// A project that was read.
    Open,
    /// A project of the gallery.
    Gallery(GalleryProject),
    /// End of the program.
    Quit,
}
