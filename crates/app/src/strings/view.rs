//! View of the space.

pub const NEARER: &str = "Zoom in";
pub const FARTHER: &str = "Zoom out";
pub const FIT: &str = "Fit";
pub const ALL: &str = "All";
pub const HELP: &str = "The wheel over the space zooms, the right or middle button pans";
