//! Authored textures: list, details, and snapshots.

use crate::strings::axes::local_means;

pub const HEADING: &str = "Authored";
pub const HELP: &str = "Authored textures of this project: each is a point of the space with an interpolation mode. Click one to edit it.";
pub const ADD: &str = "Add";
pub const ADD_HELP: &str = "Adds a texture at the center of the space, with the interpolation mode and options of the selected texture";
pub const DUPLICATE: &str = "Duplicate";
pub const DUPLICATE_HELP: &str =
    "Adds an exact copy of this texture at the same position. Both points are drawn side by side.";
pub const DELETE: &str = "Delete";
pub const IS_LAST: &str = "A project has at least one authored texture.";
pub const RENAME: &str = "Rename…";
pub const RENAME_HELP: &str = "Selects this texture and its name, above the sliders. A double click on its row in the list does the same there.";
pub const ADD_HERE: &str = "Add a texture here";
pub const ADD_HERE_HELP: &str = "Adds an authored texture at this position, with the interpolation mode and options of the selected texture";
pub const MOVE_HERE: &str = "Move the point here";
pub const MOVE_HERE_HELP: &str = "Moves the selected authored texture to this position.";
pub const DETAILS: &str = "Details";
pub const DETAILS_HELP: &str = "Color, tags, notes and picture of this texture";
pub const TAGS: &str = "Tags";
pub const TAGS_HINT: &str = "none yet; for example: wood, dry";
pub const NOTES: &str = "Notes";
pub const NOTES_HINT: &str = "Purpose of the texture, comments of participants…";
pub const COLOR: &str = "Color";
pub const COLORS: [&str; 8] = ["amber", "sky", "green", "yellow", "indigo", "vermilion", "pink", "gray"];
pub const PICTURE: &str = "Picture";
pub const NO_PICTURE: &str = "The picture is interpolated from the contributing textures. To use a photo (JPEG, PNG, WebP, BMP, TIFF), drop it on the window while this menu is open.";
pub const PICTURE_WIDTH: &str = "Width of the surface in the picture";
pub const PICTURE_WIDTH_HELP: &str = "Width of the surface that the picture shows, in mm";
pub const TAKE_PICTURE_AWAY: &str = "Remove picture";
pub const SNAPSHOTS_HELP: &str =
    "Saved state: position, interpolation, shape, path and picture. Right-click for its menu.";
pub const ROW_NAME: &str = "New name";
pub const UNNAMED: &str = "(no name)";
pub const KEEP: &str = "Snapshot";
pub const KEEP_HELP: &str = "Saves the state of the selected texture (position, interpolation, shape, path, picture). You can restore it later.";
pub const AS_OWN: &str = "Add as texture";
pub const AS_OWN_HELP: &str = "Adds an authored texture with this state. You can edit it, or compare it with the current one (A, B, X).";

/// Accessible name on the canvas of an authored texture that is not selected.
pub fn on_canvas(name: &str) -> String {
    format!("Authored: {name}")
}

/// Result of a drop of a library texture at the pointer.
pub fn drop_adds(name: &str) -> String {
    format!("Add {name} at its position")
}

/// Why a library texture cannot be dropped.
pub fn cannot_drop(name: &str) -> String {
    format!("{name} has no position in this space")
}

/// Accessible name of an authored texture in the list.
pub fn select(name: &str) -> String {
    format!("Select {name}")
}

pub fn copy_of(name: &str) -> String {
    // "Oak copy 2" is a copy already; it gets the next number.
    let begin = name.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end();
    if begin.ends_with(" copy") { begin.to_owned() } else { format!("{name} copy") }
}

/// Accessible name of the color at this index.
pub fn color(index: usize) -> String {
    format!("{COLOR} {}", COLORS[index])
}

/// What a click on a snapshot does; `is_there` tells that its texture was not deleted.
pub fn restore_help(name: &str, is_there: bool) -> String {
    if is_there {
        format!("Click to select {name} and restore it.")
    } else {
        format!("{name} was deleted. Click to add it again.")
    }
}

/// Accessible name of a snapshot; numbers start at 1.
pub fn snapshot(number: usize, name: &str) -> String {
    format!("Snapshot {number}: {name}")
}

/// Notice that a snapshot is restored; numbers start at 1, and `keys` are those of undo.
pub fn restored(number: usize, name: &str, keys: &str) -> String {
    format!("Snapshot {number} of {name} restored. Undo: {keys}")
}

/// Notice that a snapshot that was taken on other axes is restored, with local means on these `axes`; numbers start at 1, and
/// `keys` are those of undo.
pub fn restored_on(axes: &[String], number: usize, name: &str, keys: &str) -> String {
    format!("Snapshot {number} of {name} restored. {} Undo: {keys}", local_means(axes))
}

/// Notice that a snapshot that was taken on other axes is added as a texture with this name, with local means on these `axes`.
pub fn added_on(axes: &[String], name: &str, keys: &str) -> String {
    format!("{name} added. {} Undo: {keys}", local_means(axes))
}

/// Notice that an authored texture is deleted; `keys` are those of undo.
pub fn deleted(name: &str, keys: &str) -> String {
    format!("{name} deleted. Undo: {keys}")
}

pub fn delete_snapshot(number: usize) -> String {
    format!("Delete snapshot {number}")
}

/// Name of a texture that is added from a snapshot.
pub fn state_of(name: &str, number: usize) -> String {
    format!("{name} ({number})")
}

#[cfg(test)]
mod tests {
    use super::copy_of;

    #[test]
    fn a_copy_of_a_copy_is_a_copy() {
        for name in ["Oak", "Oak copy", "Oak copy 2", "Oak copy 12"] {
            assert_eq!(copy_of(name), "Oak copy");
        }
        assert_eq!(copy_of("Oak 2"), "Oak 2 copy");
    }
}
