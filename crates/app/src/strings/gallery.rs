//! Gallery of example projects.

pub const GALLERY: &str = "Gallery…";
pub const TITLE: &str = "Gallery";
pub const HELP: &str = "Example projects to play and change. All use the starter library. Its textures are simulated; nobody rated them. While the starter library is open, a project plays its selected texture as long as the pointer rests on it.";
pub const CLOSE: &str = "Close";
pub const MAKING: &str = "Making pictures…";

/// Accessible name of a project of the gallery.
pub fn open(title: &str) -> String {
    format!("Open {title}")
}
