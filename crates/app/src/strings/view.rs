//! Words about the view of the space.

/// Comes nearer.
pub const NEARER: &str = "Zoom in";
/// Goes farther.
pub const FARTHER: &str = "Zoom out";
/// Shows all textures as large as they can be.
pub const FIT: &str = "Fit";
/// Shows the whole space.
pub const ALL: &str = "All";
/// How else the view is changed.
pub const HELP: &str = "The wheel over the space zooms, the right or middle button moves it";
