//! Gallery of example projects.

pub const GALLERY: &str = "Gallery…";
pub const TITLE: &str = "Gallery";
pub const HELP: &str =
    "Example projects to feel, study and start from. All use the starter library; nobody rated them.";
pub const CLOSE: &str = "Close";

/// Accessible name of a project of the gallery.
pub fn open(title: &str) -> String {
    format!("Open {title}")
}
