//! Words about authored textures: their list, what is known of each, and states to come back to.

/// Heading of the list.
pub const HEADING: &str = "Authored";
/// What the list is.
pub const HELP: &str =
    "What you make: each is a point of the space with a way of blending. Click one to work on it.";
/// Adds one.
pub const ADD: &str = "Add";
/// What that does.
pub const ADD_HELP: &str = "Another texture, at the middle of what is shown";
/// Copies the one that is selected.
pub const DUPLICATE: &str = "Duplicate";
/// What that does.
pub const DUPLICATE_HELP: &str = "Another texture like the one that is selected, a little beside it";
/// Takes one away.
pub const DELETE: &str = "Delete";
/// Opens what is known of the texture.
pub const DETAILS: &str = "Details";
/// What the details are.
pub const DETAILS_HELP: &str = "Color, tags and notes of this texture";
/// The field for tags.
pub const TAGS: &str = "Tags";
/// What the field takes.
pub const TAGS_HINT: &str = "none yet; such as: wood, dry";
/// The field for notes.
pub const NOTES: &str = "Notes";
/// What the field takes.
pub const NOTES_HINT: &str = "What is it for? What did people say?";
/// Above the colors.
pub const COLOR: &str = "Color";
/// Names of the colors.
pub const COLORS: [&str; 8] = ["amber", "sky", "green", "yellow", "indigo", "vermilion", "pink", "gray"];
/// Above the picture.
pub const PICTURE: &str = "Picture";
/// It has none of its own.
pub const NO_PICTURE: &str = "Blended from its neighbors. Drop a photo (JPEG, PNG) on the window while this is open for one of its own.";
/// How much of a surface the picture shows.
pub const PICTURE_WIDTH: &str = "Width of the picture";
/// What that does.
pub const PICTURE_WIDTH_HELP: &str = "How many millimeters of the surface the picture shows across";
/// Takes the picture away.
pub const TAKE_PICTURE_AWAY: &str = "Take away";
/// What snapshots are.
pub const SNAPSHOTS_HELP: &str =
    "States to come back to: place, blend, path and picture. Right-click for more.";
/// Stands for a name that is empty.
pub const UNNAMED: &str = "(no name)";
/// Keeps a state.
pub const KEEP: &str = "Snapshot";
/// What that does.
pub const KEEP_HELP: &str = "Keeps the selected texture as it is now, to come back to";

/// Makes a texture of a snapshot.
pub const AS_OWN: &str = "As a texture of its own";
/// What that does.
pub const AS_OWN_HELP: &str =
    "Adds a texture in this state, to go on from, or to compare it (A, B, X) with what became of it";

/// Accessible name of an authored texture on the canvas that is not selected.
pub fn on_canvas(name: &str) -> String {
    format!("Authored: {name}")
}

/// Accessible name of an authored texture in the list.
pub fn select(name: &str) -> String {
    format!("Select {name}")
}

/// The name of a copy.
pub fn copy_of(name: &str) -> String {
    if name.ends_with(" copy") { name.to_owned() } else { format!("{name} copy") }
}

/// Accessible name of a color.
pub fn color(index: usize) -> String {
    format!("{COLOR} {}", COLORS[index])
}

/// Accessible name of a snapshot.
pub fn snapshot(number: usize, name: &str) -> String {
    format!("Snapshot {number}: {name}")
}

/// Accessible name of what takes a snapshot away.
pub fn delete_snapshot(number: usize) -> String {
    format!("Delete snapshot {number}")
}

/// The name of a texture that is made of a snapshot.
pub fn state_of(name: &str, number: usize) -> String {
    format!("{name} ({number})")
}
