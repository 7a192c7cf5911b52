//! Gallery of example projects.

pub const GALLERY: &str = "Gallery…";
pub const TITLE: &str = "Gallery";
pub const HELP: &str = "Example projects to play and change. All use the starter library. Its textures are simulated; nobody rated them.";
pub const CLOSE: &str = "Close";

/// Accessible name of a project of the gallery.
pub fn open(title: &str) -> String {
    format!("Open {title}")
}
