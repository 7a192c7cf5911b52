//! Why bytes are not a library.

use shagreen_core::space::SpacePointError;
use shagreen_core::texture::TextureModelError;
use shagreen_core::texture_path::TexturePathError;

use crate::library::{FORMAT, VERSION_MAJOR, VERSION_MINOR};
use crate::own_json::HeaderFault;

/// Why bytes are not a library.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LibraryError {
    /// Not JSON, cut off, or a field is missing or of the wrong kind.
    #[error("the library is damaged{}: {reason}; restore it from a copy", in_texture(.texture.as_ref()))]
    Damaged {
        /// What the parser says, with line and column.
        reason: String,
        /// Identifier of the texture, where the damage is inside one.
        texture: Option<String>,
    },
    /// The file is JSON but of another kind.
    #[error("this is not a texture library: `format` is {found}, not \"{FORMAT}\"; choose another file")]
    Format {
        /// What the field `format` holds.
        found: String,
    },
    /// `version` is not of the form `major.minor`.
    #[error(
        "the version {found} of the library is not of the form \"{VERSION_MAJOR}.{VERSION_MINOR}\"; restore it from a copy"
    )]
    Version {
        /// What the field `version` holds.
        found: String,
    },
    /// The file is of another major version.
    #[error(
        "the library has version {found}, this program reads {VERSION_MAJOR}.x; open it with the Shagreen that wrote it, or a newer one"
    )]
    Major {
        /// The version of the file.
        found: String,
    },
    /// The axes are not two attributes.
    #[error(
        "`axes` must be the names of two attributes that differ; correct them, or leave them out for rough-smooth and hard-soft"
    )]
    Axes,
    /// The report on the space is no object.
    #[error("`space_report` is not an object; leave it out, or build the space again")]
    Report,
    /// A value on an attribute has no meaning.
    #[error("texture \"{id}\": the attribute \"{name}\" cannot be used: {reason}; correct it")]
    Attribute {
        /// Identifier of the texture.
        id: String,
        /// Name of the attribute.
        name: String,
        /// Why.
        reason: &'static str,
    },
    /// A quantity has another unit.
    #[error(
        "the library gives {quantity} in {found}, this program reads {expected}; convert the numbers and the unit"
    )]
    Unit {
        /// The quantity.
        quantity: &'static str,
        /// The unit in the file.
        found: String,
        /// The unit that is read.
        expected: &'static str,
    },
    /// An identifier is empty or has white space.
    #[error("texture number {number} has the id \"{id}\"; give it one that is not empty and has no spaces")]
    Id {
        /// Place in the file, from one.
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
    /// A texture's numbers are no model.
    #[error("texture \"{id}\" cannot be used: {source}; correct or remove it")]
    Model {
        /// Identifier of the texture.
        id: String,
        /// What is wrong.
        source: TextureModelError,
    },
    /// A texture's position is outside the space.
    #[error("texture \"{id}\" has no valid place: {source}; correct or remove its `space`")]
    Place {
        /// Identifier of the texture.
        id: String,
        /// What is wrong.
        source: SpacePointError,
    },
    /// A position does not say where it comes from in a word that is known.
    #[error(
        "texture \"{id}\" has the label source \"{found}\"; it must be human, simulated, physical or estimated"
    )]
    LabelSource {
        /// Identifier of the texture.
        id: String,
        /// The word in the file.
        found: String,
    },
    /// A word of the format is not one that is known.
    #[error("texture \"{id}\" has the {field} \"{found}\"; it must be {expected}")]
    Word {
        /// Identifier of the texture.
        id: String,
        /// The field.
        field: &'static str,
        /// The word in the file.
        found: String,
        /// The words that are known.
        expected: &'static str,
    },
    /// An anchor lacks a number that its texture's interpolation needs.
    #[error("anchor {index} of texture \"{id}\" has no {field}; correct or remove the texture")]
    Anchor {
        /// Identifier of the texture.
        id: String,
        /// Place among the anchors, from zero.
        index: usize,
        /// The field.
        field: &'static str,
    },
    /// A relief is none.
    #[error("the relief of texture \"{id}\" cannot be played: {reason}")]
    Relief {
        /// Identifier of the texture.
        id: String,
        /// Why.
        reason: String,
    },
    /// A landing is no decaying oscillation.
    #[error("the tap of texture \"{id}\" has {field} {value}; {needs}")]
    Tap {
        /// Identifier of the texture.
        id: String,
        /// The field.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        needs: &'static str,
    },
    /// A path is no way.
    #[error("the path of texture \"{id}\" cannot be used: {source}; correct or remove it")]
    Path {
        /// Identifier of the texture.
        id: String,
        /// What is wrong.
        source: TexturePathError,
    },
    /// A picture is not usable.
    #[error("the picture of texture \"{id}\" cannot be used: {reason}; correct or remove it")]
    Picture {
        /// Identifier of the texture.
        id: String,
        /// What is wrong.
        reason: String,
    },
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
