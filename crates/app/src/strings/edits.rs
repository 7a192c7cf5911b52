//! What edits are called, as they follow the words undo and redo.

/// Another mode of blending.
pub const CHANGE_BLEND: &str = "Change blend";
/// The field ends at the outline.
pub const STAY_WITHIN: &str = "Stay within the textures";
/// The field goes on.
pub const GO_BEYOND: &str = "Go beyond the textures";
/// The corners of the triangle count.
pub const USE_TRIANGLES: &str = "Use triangles";
/// Natural neighbors count.
pub const USE_NATURAL: &str = "Use natural neighbors";
/// The notes of the project.
pub const CHANGE_NOTES: &str = "Change notes of the project";
/// The library becomes a part of the project.
pub const KEEP_INSIDE: &str = "Keep library in the project";
/// Textures join the list.
pub const ADD_TEXTURES: &str = "Add textures";
/// One texture is heard alone.
pub const HEAR_ALONE: &str = "Hear one texture";
/// The blend is heard again.
pub const HEAR_BLEND: &str = "Hear the blend";
/// A space is used.
pub const USE_SPACE: &str = "Use space";
/// Other axes.
pub const CHOOSE_AXES: &str = "Choose axes";
/// A snapshot goes.
pub const REMOVE_SNAPSHOT: &str = "Delete snapshot";
/// A path is drawn.
pub const DRAW_PATH: &str = "Draw path";
/// A point joins the path.
pub const ADD_PATH_POINT: &str = "Add path point";
/// A point of the path moves.
pub const MOVE_PATH_POINT: &str = "Move path point";
/// A point of the path goes.
pub const DELETE_PATH_POINT: &str = "Delete path point";
/// The length of the path.
pub const CHANGE_PATH_LENGTH: &str = "Change path length";
/// What is counted along the path.
pub const CHANGE_PATH_MEASURE: &str = "Change path measure";
/// What happens at the end of the path.
pub const CHANGE_PATH_END: &str = "Change path end";
/// The path goes.
pub const CLEAR_PATH: &str = "Clear path";

/// An authored texture moves.
pub fn moved(name: &str) -> String {
    format!("Move {name}")
}

/// An authored texture gets another name.
pub fn renamed(name: &str) -> String {
    format!("Rename {name}")
}

/// A texture of the list gets another name.
pub fn renamed_to(name: &str) -> String {
    format!("Rename to {name}")
}

/// An authored texture gets another color.
pub fn colored(name: &str) -> String {
    format!("Color {name}")
}

/// Something is noted of an authored texture.
pub fn noted(name: &str) -> String {
    format!("Change notes of {name}")
}

/// An authored texture gets other tags.
pub fn tagged(name: &str) -> String {
    format!("Change tags of {name}")
}

/// An authored texture gets a picture.
pub fn pictured(name: &str) -> String {
    format!("Set picture of {name}")
}

/// An authored texture loses its picture.
pub fn unpictured(name: &str) -> String {
    format!("Take picture from {name}")
}

/// Another texture is authored.
pub fn authored(name: &str) -> String {
    format!("Add {name}")
}

/// A texture goes.
pub fn removed(name: &str) -> String {
    format!("Delete {name}")
}

/// Another authored texture is worked on.
pub fn selected(name: &str) -> String {
    format!("Select {name}")
}

/// A state is kept.
pub fn kept_snapshot(name: &str) -> String {
    format!("Snapshot of {name}")
}

/// A state comes back.
pub fn restored_snapshot(name: &str) -> String {
    format!("Bring back {name}")
}

/// Another library is opened.
pub fn opened(library: &str) -> String {
    format!("Open {library}")
}

/// A texture gets a star, or loses it.
pub fn starred(name: &str, is_starred: bool) -> String {
    if is_starred { format!("Star {name}") } else { format!("Unstar {name}") }
}
