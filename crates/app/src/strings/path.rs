//! Words of paths: textures that change along a stroke.

/// The path tool.
pub const PATH: &str = "Path";
/// What the path tool does.
pub const PATH_HELP: &str = "Draw a way through the space: press and drag, or click points and textures (P). The texture then \
                             changes along the stroke. Escape leaves.";
/// Plays the path.
pub const PLAY: &str = "Play path";
/// Ends playing the path.
pub const STOP: &str = "Stop path";
/// What playing the path does.
pub const PLAY_HELP: &str = "The texture under the hand follows the path, from its beginning with each touch. The point stays \
                             where it is, and is heard again when the path ends.";
/// The path is played, and nothing touches.
pub const WAITS: &str = "Stroke the pad: the texture changes along the path.";
/// Accessible name of the path's length.
pub const LENGTH: &str = "Length of the path";
/// What the path's length is.
pub const LENGTH_HELP: &str = "How far or how long the hand strokes from the first point to the last.";
/// Accessible name of what is counted along the path.
pub const ALONG: &str = "Measure of the path";
/// What is counted along the path.
pub const ALONG_HELP: &str = "The texture changes with the distance that the tip travels, or with time.";
/// Distance is counted.
pub const DISTANCE: &str = "distance";
/// Time is counted.
pub const TIME: &str = "time";
/// Accessible name of what happens at the end of the path.
pub const AT_END: &str = "End of the path";
/// What happens at the end of the path.
pub const AT_END_HELP: &str = "What a stroke does that is longer than the path.";
/// The last texture stays.
pub const HOLD: &str = "stays";
/// Back the same way.
pub const TURN: &str = "to and fro";
/// From the beginning again.
pub const REPEAT: &str = "again";
/// The path becomes a texture of the list.
pub const KEEP: &str = "Keep";
/// What keeping the path does.
pub const KEEP_HELP: &str = "Adds the path to the list as a texture of its own, under the name at the right: \"Save as…\" writes \
                             it into a library, and \"shagreen play\" and \"render\" follow it.";
/// Why the path cannot be kept.
pub const CANNOT_KEEP: &str = "A path of two points or more, and the mode Field or Parametric, can be kept.";
/// Takes the path away.
pub const CLEAR: &str = "Clear";
/// What clearing does.
pub const CLEAR_HELP: &str = "Takes the path away; undo brings it back.";
/// What can be done with a point of the path.
pub const POINT_HELP: &str = "Drag it; a right click, or Delete, takes it away.";

/// Accessible name of a point of the path, counted from one.
pub fn point(number: usize) -> String {
    format!("Path point {number}")
}
