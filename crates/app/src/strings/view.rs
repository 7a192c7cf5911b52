//! View of the space.

pub const NEARER: &str = "Zoom in";
pub const FARTHER: &str = "Zoom out";
pub const FIT: &str = "Fit";
pub const ALL: &str = "All";
pub const HELP: &str =
    "The mouse wheel zooms the view of the space; the right or middle mouse button pans it.";
