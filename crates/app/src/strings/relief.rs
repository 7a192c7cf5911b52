//! Reliefs of textures from pictures.

pub const TITLE: &str = "Relief from a picture";
pub const MENU: &str = "Relief from a picture…";
pub const MENU_HELP: &str = "Gives the texture the heights of a photo or a height map (JPEG, PNG, WebP, BMP, TIFF), in a size that you state.";
pub const IS_PATH: &str =
    "A texture path cannot have a relief. Add the relief to the textures from which the path is made.";
pub const NO_MODEL: &str = "This interpolation mode mixes signals, so there is no texture that can have a relief; choose Field or Parametric.";
pub const GONE: &str = "The texture is no longer in the project; close this sheet and choose another one.";

/// Follows the sentence about what happens to the texture.
pub const REPLACES: &str = " It replaces the present height map.";

// Picture.
pub const PATH: &str = "Path of the picture";
pub const PATH_HINT: &str = "Path of a photo or height map, or drop it here…";
/// Kind of file in the dialog of the system.
pub const KIND: &str = "Pictures";
pub const READ: &str = "Read";
/// Name of the picture of the authored texture.
pub const OWN_PICTURE: &str = "Picture of the texture";
pub const NO_PICTURE: &str = "No picture";
pub const PREVIEW: &str = "Picture of the relief";
pub const BROKEN: &str = "Reading the picture stopped unexpectedly; choose another picture.";

// Size.
pub const SIDE: &str = "Side of the picture";
pub const SIDE_HELP: &str =
    "Side of the surface in the central square of the picture, in mm. Measure it, or estimate it.";
pub const HEIGHT: &str = "Height of white above black";
pub const HEIGHT_HELP: &str = "Height of the white places above the black ones, in µm. For a photo, it is your estimate. For a TIFF with floating-point or signed numbers, the height of the highest place above the lowest.";
pub const DEFAULT: &str = "default, not measured";

pub const APPLY: &str = "Apply";
pub const CANCEL: &str = "Cancel";

// What a picture is for.
pub const ASK_TITLE: &str = "Use of the picture";
pub const FIND_POINT: &str = "Estimate its position";
pub const FIND_POINT_HELP: &str =
    "Estimates a position from the picture, and adds an authored texture there.";
pub const FIND_POINT_WITH_HELP: &str = "Estimates a position from the picture and from the words in the prompt box, and adds an authored texture there.";
pub const RELIEF_HELP: &str =
    "Gives the texture the heights of the picture; the next sheet asks for side and height.";

/// Button that estimates a position from a picture and these words.
pub fn find_point_with(words: &str) -> String {
    format!("Estimate its position, with \"{words}\"")
}

/// Button that uses a picture as the relief of this texture.
pub fn use_as_relief(name: &str) -> String {
    format!("Use as relief of {name}…")
}

/// What happens to a texture that was added to the project.
pub fn of_added(name: &str) -> String {
    format!("{name} gets the heights of the picture. Undo removes them.")
}

/// What happens to a texture of the library.
pub fn of_library(name: &str) -> String {
    format!("{name} is part of the library. A copy with the heights of the picture is added to the project.")
}

/// What happens to an authored texture.
pub fn of_authored(name: &str) -> String {
    format!(
        "A copy of {name} with the heights of the picture is added to the project, and {name} pins it: it then feels and looks like the picture. Undo removes both."
    )
}

/// Name of a texture that gets a relief.
pub fn with_relief(name: &str) -> String {
    if name.ends_with(" with relief") { name.to_owned() } else { format!("{name} with relief") }
}
