//! Errors of reading a texture library.

use shagreen_core::space::texture_path::TexturePathError;
use shagreen_core::texture::TextureModelError;
use shagreen_core::texture::stick_slip::StickSlipError;
use shagreen_core::texture::tap::TapError;
use shagreen_core::words::counted;

use crate::foreign_file::Found;
use crate::library::coordinates::CoordinatesError;
use crate::library::{FORMAT, VERSION_MAJOR, VERSION_MINOR};
use crate::own_json::HeaderFault;
use crate::text_limits::TooLong;

/// Why bytes are not a texture library.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LibraryError {
    /// Not JSON, truncated, or a field is missing or of the wrong type.
    #[error("the library is damaged{}: {reason}; restore it from a copy", in_texture(.texture.as_ref()))]
    Damaged {
        /// The parser's message, with line and column.
        reason: String,
        /// Identifier of the texture that contains the damage, if known.
        texture: Option<String>,
    },
    /// The file is of another format.
    #[error("{}", .found.instead_of("a texture library", FORMAT))]
    Format {
        /// What the file is.
        found: Found,
    },
    /// `version` is not of the form `major.minor`.
    #[error(
        "the version {found} of the library is not of the form \"{VERSION_MAJOR}.{VERSION_MINOR}\"; restore the library from a copy"
    )]
    Version {
        /// Value of the `version` field.
        found: String,
    },
    /// The file has an unsupported major version.
    #[error(
        "the library has version {found}, but this program reads {VERSION_MAJOR}.x; open it with the version of Shagreen that wrote it, or a newer one"
    )]
    Major {
        /// The version of the file.
        found: String,
    },
    /// `axes` is not one to six different names.
    #[error(
        "`axes` must be one to six different names of axes; correct them, or remove `axes` to use rough-smooth and hard-soft"
    )]
    Axes,
    /// A position has another number of coordinates than the space has axes.
    #[error(
        "the position of texture \"{id}\" has {}, but the number of axes is {n_axes}; give it one coordinate for each axis, or correct `axes`",
        counted(*.n, "coordinate")
    )]
    AxisCount {
        /// Identifier of the texture.
        id: String,
        /// Number of its coordinates.
        n: usize,
        /// Number of axes.
        n_axes: usize,
    },
    /// A point of a path has another number of coordinates than the first one.
    #[error(
        "key {number} of the path of texture \"{id}\" has {}, but the first key has {expected}; give all keys the same number",
        counted(*.n, "coordinate")
    )]
    KeyCount {
        /// Identifier of the texture.
        id: String,
        /// Number of the key, from one.
        number: usize,
        /// Number of its coordinates.
        n: usize,
        /// Number of coordinates of the first key.
        expected: usize,
    },
    /// The space report is not an object.
    #[error("`space_report` is not an object; remove it, or build the space again")]
    Report,
    /// An attribute value is invalid.
    #[error("texture \"{id}\": the attribute \"{name}\" is invalid: {reason}; correct it")]
    Attribute {
        /// Identifier of the texture.
        id: String,
        /// Name of the attribute.
        name: String,
        /// Why it is invalid.
        reason: &'static str,
    },
    /// A quantity has an unsupported unit.
    #[error(
        "the library gives {quantity} in {found}, but this program reads {expected}; convert the numbers and the unit"
    )]
    Unit {
        /// The quantity.
        quantity: &'static str,
        /// The unit in the file.
        found: String,
        /// The supported unit.
        expected: &'static str,
    },
    /// An identifier is empty or contains white space.
    #[error("texture number {number} has the id \"{id}\"; use an id that is not empty and has no spaces")]
    Id {
        /// Position in the file, from one.
        number: usize,
        /// The identifier.
        id: String,
    },
    /// Two textures have the same identifier.
    #[error("two textures have the id \"{id}\"; rename one of them")]
    Duplicate {
        /// The identifier.
        id: String,
    },
    /// The numbers of a texture do not form a valid model.
    #[error("texture \"{id}\" is invalid: {source}; correct or remove it")]
    Model {
        /// Identifier of the texture.
        id: String,
        /// What is wrong.
        source: TextureModelError,
    },
    /// The nodes of the grain along the lay are invalid.
    #[error("the `anchors_along` of texture \"{id}\" is invalid: {source}; correct or remove it")]
    Along {
        /// Identifier of the texture.
        id: String,
        /// What is wrong.
        source: TextureModelError,
    },
    /// The position of a texture is outside the space.
    #[error("the position of texture \"{id}\" is invalid: {source}; correct or remove its `space`")]
    Place {
        /// Identifier of the texture.
        id: String,
        /// What is wrong.
        source: CoordinatesError,
    },
    /// A standard deviation of a position is outside 0 to 100.
    #[error(
        "the `sd` of the position of texture \"{id}\" is invalid; both numbers must be from 0 to 100; correct or remove it"
    )]
    Deviation {
        /// Identifier of the texture.
        id: String,
    },
    /// A label source is unknown.
    #[error(
        "texture \"{id}\" has the label source \"{found}\"; it must be human, simulated, physical or estimated"
    )]
    LabelSource {
        /// Identifier of the texture.
        id: String,
        /// The word in the file.
        found: String,
    },
    /// A field holds an unknown word.
    #[error("texture \"{id}\" has the {field} \"{found}\"; it must be {expected}")]
    Word {
        /// Identifier of the texture.
        id: String,
        /// Name of the field.
        field: &'static str,
        /// The word in the file.
        found: String,
        /// The permitted words.
        expected: &'static str,
    },
    /// An anchor lacks a number that the texture's interpolation mode needs.
    #[error("entry {index} of `{list}` of texture \"{id}\" has no {field}; add it, or remove the texture")]
    Anchor {
        /// Identifier of the texture.
        id: String,
        /// Name of the list of anchors: `anchors` or `anchors_along`.
        list: &'static str,
        /// Index of the anchor, from zero.
        index: usize,
        /// Name of the missing field.
        field: &'static str,
    },
    /// A relief is invalid.
    #[error("the relief of texture \"{id}\" is invalid: {reason}; correct or remove it")]
    Relief {
        /// Identifier of the texture.
        id: String,
        /// Why it is invalid.
        reason: String,
    },
    /// A height map is invalid.
    #[error("the `height_map` of texture \"{id}\" is invalid: {reason}; correct or remove it")]
    HeightMap {
        /// Identifier of the texture.
        id: String,
        /// Why it is invalid.
        reason: String,
    },
    /// Parameters of stick-slip friction are invalid.
    #[error("the `stick_slip` of texture \"{id}\" is invalid: {source}; correct or remove it")]
    StickSlip {
        /// Identifier of the texture.
        id: String,
        /// The invalid value.
        source: StickSlipError,
    },
    /// A rotation is out of range.
    #[error("texture \"{id}\" has the `turn_deg` {turn_deg}; it must be from -360 to 360 degrees")]
    Turn {
        /// Identifier of the texture.
        id: String,
        /// The rotation in the file, in degrees.
        turn_deg: f64,
    },
    /// A text is too long.
    #[error(transparent)]
    TooLong(#[from] TooLong),
    /// A path has too many textures.
    #[error("the path of texture \"{id}\" has {n} textures, but at most {most} are possible; remove some")]
    PathKeys {
        /// Identifier of the texture.
        id: String,
        /// Number of textures along the path.
        n: usize,
        /// Maximum number of textures.
        most: usize,
    },
    /// A tap transient is none that a tap on a surface could cause.
    #[error("the `tap` of texture \"{id}\" is invalid: {source}")]
    Tap {
        /// Identifier of the texture.
        id: String,
        /// The invalid value.
        source: TapError,
    },
    /// A path is invalid.
    #[error("the path of texture \"{id}\" is invalid: {source}; correct or remove it")]
    Path {
        /// Identifier of the texture.
        id: String,
        /// What is wrong.
        source: TexturePathError,
    },
    /// A picture is invalid.
    #[error("the picture of texture \"{id}\" is invalid: {reason}; correct or remove it")]
    Picture {
        /// Identifier of the texture.
        id: String,
        /// What is wrong.
        reason: String,
    },
}

impl LibraryError {
    /// Error of the model of the texture with this identifier.
    pub(super) fn of_model(id: &str, source: TextureModelError) -> Self {
        let id = id.to_owned();
        match source {
            TextureModelError::InAlong(source) => Self::Along { id, source: *source },
            source => Self::Model { id, source },
        }
    }
}

fn in_texture(texture: Option<&String>) -> String {
    texture.map_or_else(String::new, |id| format!(" in texture \"{id}\""))
}

impl From<HeaderFault> for LibraryError {
    fn from(fault: HeaderFault) -> Self {
        match fault {
            HeaderFault::TooDense(reason) | HeaderFault::Damaged(reason) => {
                Self::Damaged { reason, texture: None }
            }
            HeaderFault::Format(found) => Self::Format { found },
            HeaderFault::Version(found) => Self::Version { found },
            HeaderFault::Major(found) => Self::Major { found },
        }
    }
}
