//! Paths: textures that change along a stroke.

pub const PATH: &str = "Path";
pub const PATH_HELP: &str = "Draws a path through the space: press and drag, or click points and textures (P). The automatic stroke then follows the path. Escape leaves the tool.";
pub const PLAY: &str = "Play path";
pub const STOP: &str = "Stop path";
pub const PLAY_HELP: &str = "During a stroke, the texture changes along the path; each touch starts at the beginning of the path. The authored point does not move, and its texture plays again when you stop the path.";
pub const DRAW_ONE: &str = "Drag through the space, or click points in it.";
pub const WAITS: &str = "Stroke the pad: the texture changes along the path.";
pub const LENGTH: &str = "Length of the path";
pub const LENGTH_HELP: &str =
    "Tip distance (mm) or time (s) of a stroke from the first to the last point of the path.";
pub const ALONG: &str = "Path progress";
pub const ALONG_LABEL: &str = "Progress by";
pub const ALONG_HELP: &str =
    "The texture changes along the path with the distance that the tip travels, or with time.";
pub const DISTANCE: &str = "distance";
pub const TIME: &str = "time";
pub const AT_END: &str = "End of the path";
pub const AT_END_LABEL: &str = "At the end";
pub const AT_END_HELP: &str = "Behavior when the stroke is longer than the path: hold the last texture, go back along the path, or repeat the path from its first texture.";
pub const HOLD: &str = "hold";
pub const TURN: &str = "reverse";
pub const REPEAT: &str = "repeat";
pub const KEEP: &str = "Keep";
pub const KEEP_HELP: &str = "Adds the path to the list of textures, with the name of the authored texture. \"Save as…\" writes it to a library; the commands \"shagreen play\" and \"shagreen render\" can play it.";
pub const CANNOT_KEEP: &str =
    "To keep a path as a texture, draw at least two points and choose the mode Field or Parametric.";
pub const CLEAR: &str = "Clear";
pub const CLEAR_HELP: &str = "Deletes the path. Undo restores it.";
pub const POINT_HELP: &str = "Drag to move it. Right-click, or press Delete, to remove it.";

/// Accessible name of a point of the path; numbers start at 1.
pub fn point(number: usize) -> String {
    format!("Path point {number}")
}
