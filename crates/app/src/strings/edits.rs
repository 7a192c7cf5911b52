//! Names of edits, as they follow the words "Undo" and "Redo".

use shagreen_core::texture::shape::ShapeControl;

use crate::strings::shape;

pub const CHANGE_BLEND: &str = "Change interpolation mode";
pub const STAY_WITHIN: &str = "Stop extrapolating";
pub const GO_BEYOND: &str = "Extrapolate outside hull";
pub const USE_TRIANGLES: &str = "Use barycentric weights";
pub const USE_NATURAL: &str = "Use natural neighbors";
pub const CHANGE_NOTES: &str = "Change project notes";
pub const KEEP_INSIDE: &str = "Embed library in project";
pub const ADD_TEXTURES: &str = "Add textures";
pub const HEAR_ALONE: &str = "Solo texture";
pub const HEAR_BLEND: &str = "End solo";
pub const USE_SPACE: &str = "Use space";
pub const CHOOSE_AXES: &str = "Choose axes";
pub const CHOOSE_COMPARED: &str = "Choose A and B";
pub const REMOVE_SNAPSHOT: &str = "Delete snapshot";
pub const DRAW_PATH: &str = "Draw path";
pub const ADD_PATH_POINT: &str = "Add path point";
pub const MOVE_PATH_POINT: &str = "Move path point";
pub const DELETE_PATH_POINT: &str = "Delete path point";
pub const CHANGE_PATH_LENGTH: &str = "Change path length";
pub const CHANGE_PATH_MEASURE: &str = "Switch path between distance and time";
pub const CHANGE_PATH_END: &str = "Change behavior at path end";
pub const CLEAR_PATH: &str = "Clear path";

/// Edit that lets an added texture take part in the whole space, or only in the authored textures that pin it.
pub fn used_where(name: &str, is_own: bool) -> String {
    if is_own { format!("Use {name} only where pinned") } else { format!("Use {name} in whole space") }
}

pub fn moved(name: &str) -> String {
    format!("Move {name}")
}

/// Edit that renames the selected authored texture.
pub fn renamed(name: &str) -> String {
    format!("Rename {name}")
}

/// Edit that gives a texture of the list this name.
pub fn renamed_to(name: &str) -> String {
    format!("Rename to {name}")
}

pub fn shaped(name: &str, control: ShapeControl) -> String {
    format!("Change {} of {name}", shape::name(control).to_lowercase())
}

pub fn unshaped(name: &str) -> String {
    format!("Reset shape of {name}")
}

pub fn colored(name: &str) -> String {
    format!("Color {name}")
}

pub fn noted(name: &str) -> String {
    format!("Change notes of {name}")
}

pub fn tagged(name: &str) -> String {
    format!("Change tags of {name}")
}

pub fn pictured(name: &str) -> String {
    format!("Set picture of {name}")
}

pub fn unpictured(name: &str) -> String {
    format!("Remove picture of {name}")
}

pub fn authored(name: &str) -> String {
    format!("Add {name}")
}

pub fn removed(name: &str) -> String {
    format!("Delete {name}")
}

/// Edit that gives an added texture a relief.
pub fn relief_of(name: &str) -> String {
    format!("Set relief of {name}")
}

/// Edit that gives an added texture an estimated position.
pub fn placed(name: &str) -> String {
    format!("Estimate position of {name}")
}

/// Edit that removes an added texture from the list.
pub fn removed_texture(name: &str) -> String {
    format!("Remove {name}")
}

pub fn selected(name: &str) -> String {
    format!("Select {name}")
}

pub fn kept_snapshot(name: &str) -> String {
    format!("Snapshot of {name}")
}

pub fn restored_snapshot(name: &str) -> String {
    format!("Restore snapshot of {name}")
}

pub fn opened(library: &str) -> String {
    format!("Open {library}")
}

pub fn starred(name: &str, is_starred: bool) -> String {
    if is_starred { format!("Star {name}") } else { format!("Unstar {name}") }
}

/// Edit that makes an authored texture exactly the texture `of` of the library.
pub fn taken(name: &str, of: &str) -> String {
    format!("Make {name} exactly {of}")
}
