//! A texture library: one JSON file that says what it holds, in which units, and where it comes from.
//!
//! ```json
//! {
//!   "format": "shagreen-library",
//!   "version": "1.0",
//!   "units": {"speed": "mm/s", "force": "N", "acceleration": "m/s^2", "rate": "Hz", "lsf": "rad", "length": "mm"},
//!   "name": "…", "description": "…", "origin": "…", "licence": "…", "created_by": "…", "seed": 1,
//!   "textures": [{
//!     "id": "cork", "name": "Cork", "tags": ["soft"], "licence": "…", "origin": "…", "description": "…",
//!     "space": {"rough_smooth": 40.5, "hard_soft": 71.0, "label_source": "physical"},
//!     "physical": {"roughness_log10_mps2": -0.01, "hardness_log10_n_per_m": 4.1},
//!     "rate_hz": 1000.0, "mu": 0.4,
//!     "anchors": [{"speed_mm_per_s": 100.0, "force_n": 1.0, "level_mps2": 0.97, "lsf": [0.1, 0.2]}],
//!     "picture": {"media_type": "image/jpeg", "width": 256, "height": 256, "millimeters": 20.0, "base64": "…"}
//!   }]
//! }
//! ```
//!
//! Fields that this version does not know are kept in [`Unknown`] and written back. A file of a higher major version is
//! refused.

mod id;
mod read;
mod v1;
mod write;

use serde_json::{Map, Value};
use shagreen_core::space::{LabelSource, SpacePoint, SpacePointError};
use shagreen_core::texture::{TextureModel, TextureModelError};

use crate::picture::Picture;

pub use crate::library::id::id_from_name;
pub use crate::library::read::read_library;
pub use crate::library::write::write_library;

/// What the field `format` of a library holds.
pub const FORMAT: &str = "shagreen-library";
/// Major version that is read and written: files of another one are refused.
pub const VERSION_MAJOR: u32 = 1;
/// Minor version that is written: fields may be added by a higher one.
pub const VERSION_MINOR: u32 = 0;

/// Textures that belong together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library {
    /// Name to show.
    pub name: String,
    /// What it is, in a sentence or two.
    pub description: String,
    /// Where its textures come from.
    pub origin: String,
    /// Under which terms it may be used, as an SPDX expression where there is one.
    pub license: String,
    /// The program that wrote it, with its version.
    pub created_by: String,
    /// Seed of all that is random in it, where it was made by a program.
    pub seed: Option<u64>,
    /// The textures. Identifiers are unique; a texture is known by its index here.
    pub textures: Vec<TextureEntry>,
    /// Fields that this version does not know.
    pub unknown: UnknownOfLibrary,
}

/// A texture and what is known about it.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureEntry {
    /// Identifier, unique in its library, neither empty nor with white space.
    pub id: String,
    /// Name to show.
    pub name: String,
    /// Words to search by.
    pub tags: Vec<String>,
    /// Terms of this texture; those of the library where it is empty.
    pub license: String,
    /// Where it comes from; as the library where it is empty.
    pub origin: String,
    /// What it is.
    pub description: String,
    /// Where it lies in the space, where it has been placed.
    pub place: Option<Place>,
    /// What was measured or computed of the surface itself, where that is known.
    pub physical: Option<PhysicalLabels>,
    /// What it does to a tip.
    pub model: TextureModel,
    /// What it looks like.
    pub picture: Option<Picture>,
    /// Fields that this version does not know.
    pub unknown: Unknown,
}

/// A position in the space, which always says where it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The position.
    pub at: SpacePoint,
    /// What it was derived from.
    pub source: LabelSource,
}

/// Physical quantities that stand behind [`LabelSource::PhysicalLabels`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhysicalLabels {
    /// log₁₀ of the root mean square acceleration in m/s² at 100 mm/s and 1 N.
    pub roughness_log10_mps2: f64,
    /// log₁₀ of the stiffness of the contact in N/m at 1 N.
    pub hardness_log10_n_per_m: f64,
}

/// Fields of a library that this version does not know, by the object that they stood in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UnknownOfLibrary {
    library: Map<String, Value>,
    units: Map<String, Value>,
}

/// Fields of a texture that this version does not know, by the object that they stood in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Unknown {
    texture: Map<String, Value>,
    space: Map<String, Value>,
    physical: Map<String, Value>,
    picture: Map<String, Value>,
    /// Empty, or one for each node of the model.
    anchors: Vec<Map<String, Value>>,
}

impl TextureEntry {
    /// A texture of which only identifier, name and model are known.
    pub fn new(id: impl Into<String>, name: impl Into<String>, model: TextureModel) -> Self {
        Self {
            id: id.into(),
            name: name.into(),
            tags: Vec::new(),
            license: String::new(),
            origin: String::new(),
            description: String::new(),
            place: None,
            physical: None,
            model,
            picture: None,
            unknown: Unknown::default(),
        }
    }

    /// Where it lies in the space, where it has been placed.
    pub fn at(&self) -> Option<SpacePoint> {
        self.place.map(|place| place.at)
    }

    /// What its position was derived from, where it has one.
    pub fn label_source(&self) -> Option<LabelSource> {
        self.place.map(|place| place.source)
    }
}

impl Library {
    /// Index of the texture with this identifier.
    pub fn index_of(&self, id: &str) -> Option<usize> {
        self.textures.iter().position(|texture| texture.id == id)
    }

    /// Positions of all textures, indexed as [`Library::textures`]: what a space is made of.
    pub fn positions(&self) -> Vec<Option<SpacePoint>> {
        self.textures.iter().map(TextureEntry::at).collect()
    }

    /// All that the positions were derived from, each once, in the order of the textures. Where there are several, no
    /// one word stands for the library, and distances between textures of different sources mean little.
    pub fn label_sources(&self) -> Vec<LabelSource> {
        let mut sources = Vec::new();
        for source in self.textures.iter().filter_map(TextureEntry::label_source) {
            if !sources.contains(&source) {
                sources.push(source);
            }
        }
        sources
    }

    /// What the positions were derived from; `None` where there are none or they are of several kinds, which
    /// [`Library::label_sources`] tells apart.
    pub fn label_source(&self) -> Option<LabelSource> {
        match self.label_sources()[..] {
            [source] => Some(source),
            _ => None,
        }
    }

    /// Terms of a texture: its own, or those of the library.
    pub fn license_of<'a>(&'a self, texture: &'a TextureEntry) -> &'a str {
        if texture.license.is_empty() { &self.license } else { &texture.license }
    }
}

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
    #[error("texture \"{id}\" has the label source \"{found}\"; it must be human, simulated or physical")]
    LabelSource {
        /// Identifier of the texture.
        id: String,
        /// The word in the file.
        found: String,
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

#[cfg(test)]
mod tests;
