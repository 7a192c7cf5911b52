//! Words of the gallery.

/// Opens it.
pub const GALLERY: &str = "Gallery…";
/// Its title.
pub const TITLE: &str = "Gallery";
/// What it is.
pub const HELP: &str =
    "Projects to hear, take apart and begin from. All stand on the starter library; nobody rated them.";
/// Leaves it.
pub const CLOSE: &str = "Close";

/// Accessible name of a project.
pub fn open(title: &str) -> String {
    format!("Open {title}")
}
