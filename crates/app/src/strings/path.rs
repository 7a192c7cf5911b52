//! Paths: textures that change along a stroke.

pub const PATH: &str = "Path";
pub const PATH_HELP: &str = "Draws a path through the space: press and drag, or click points and textures (P). The texture then changes along the stroke. Escape leaves the tool.";
pub const PLAY: &str = "Play path";
pub const STOP: &str = "Stop path";
pub const PLAY_HELP: &str = "The texture follows the path during a stroke and restarts with each touch. The point does not move; its texture returns when the path stops.";
pub const WAITS: &str = "Stroke the pad: the texture changes along the path.";
pub const LENGTH: &str = "Length of the path";
pub const LENGTH_HELP: &str =
    "Distance (mm) or time (s) of the stroke from the first to the last point of the path.";
pub const ALONG: &str = "Measure of the path";
pub const ALONG_HELP: &str = "The texture changes with the distance that the tip travels, or with time.";
pub const DISTANCE: &str = "distance";
pub const TIME: &str = "time";
pub const AT_END: &str = "End of the path";
pub const AT_END_HELP: &str = "What happens when the stroke is longer than the path: hold the last texture, reverse, or repeat from the first.";
pub const HOLD: &str = "hold";
pub const TURN: &str = "reverse";
pub const REPEAT: &str = "repeat";
pub const KEEP: &str = "Keep";
pub const KEEP_HELP: &str = "Adds the path to the list as a new texture, under the name at the right. \"Save as…\" writes it to a library; the commands \"shagreen play\" and \"shagreen render\" follow it.";
pub const CANNOT_KEEP: &str = "A path needs two points or more, and the mode Field or Parametric.";
pub const CLEAR: &str = "Clear";
pub const CLEAR_HELP: &str = "Deletes the path. Undo restores it.";
pub const POINT_HELP: &str = "Drag to move it. Right-click, or press Delete, to remove it.";

/// Accessible name of a point of the path; numbers start at 1.
pub fn point(number: usize) -> String {
    format!("Path point {number}")
}
