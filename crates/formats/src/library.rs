//! A texture library: one JSON file that says what it holds, in which units, and where it comes from.
//!
//! ```json
//! {
//!   "format": "shagreen-library",
//!   "version": "1.1",
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
//! Version 1.1 added, to a texture:
//!
//! - `"interpolation"`: how grain is found between anchors, `"barycentric"` (also where it is left out),
//!   `"radial_basis"`, or `"published"`. Anchors of the last have `"variance"` in (m/s²)², `"gain"` and `"ma_lsf"` in place
//!   of `level_mps2`, and include the boundary (speed or force zero).
//! - `"tap": {"frequency_hz": 180.0, "decay_per_s": 90.0, "amplitude_mps2": 4.0}`: the transient of a landing.
//! - `"provenance": "restricted"`: made from data that may not be passed on; see [`Provenance`].
//!
//! Version 1.2 added, to a texture:
//!
//! - `"attributes": {"label_source": "human", "values": [{"name": "rough-smooth", "value": 40.5}, …]}`: values from 0 to
//!   100 on any number of attributes, each named by its two poles; see [`Attributes`].
//!
//! and to the library:
//!
//! - `"space_report": {…}`: how its space was made and how far it can be believed, as `shagreen space build` prints it.
//!
//! Version 1.3 added, to the library:
//!
//! - `"axes": ["warm-cold", "flat-bumpy"]`: the attributes that `rough_smooth` and `hard_soft` of every place stand for,
//!   where they are others than their names say.
//!
//! Version 1.4 added, to a texture that changes along a stroke:
//!
//! - `"path": {"along": "distance", "at_end": "hold", "keys": [{"along": 0.0, "rough_smooth": 30.0, "hard_soft": 70.0,
//!   "stop": true, "mu": 0.4, "tap": {…}, "anchors": […]}, …]}`: textures at places of the stroke, in mm that the tip has
//!   traveled or (`"along": "time"`) in s that it has touched. `at_end` is `hold`, `turn` or `repeat`; `stop` marks the
//!   places that somebody chose. Its own anchors are those of the first key, for programs that know no paths.
//!
//! Version 1.5 added, to a texture and to the keys of its path:
//!
//! - `"relief": {"step_mm": 0.01, "force_n": 1.0, "mps2": [0.1, -0.2]}`: accelerations in m/s² a step apart, played by
//!   where the tip is, at the force at which they are as they stand here; back and forth beyond the last one.
//!
//! Version 1.6 added the label source `estimated`: a place that words, a picture or a recording were taken for.
//!
//! A file says the lowest version that has all it uses.
//!
//! Fields that this version does not know are kept in [`Unknown`] and written back. A file of a higher major version is
//! refused.

mod anchors;
pub(crate) mod attributes;
mod authored;
mod error;
mod id;
mod path;
mod provenance;
pub(crate) mod read;
mod relief;
pub(crate) mod v1;
pub(crate) mod write;

use serde_json::{Map, Value};
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::starter::Labels;
use shagreen_core::texture::TextureModel;
use shagreen_core::texture_path::TexturePath;

use crate::picture::Picture;

pub(crate) use crate::library::attributes::is_usual;
pub use crate::library::attributes::{Attribute, Attributes};
pub use crate::library::authored::ReliefSource;
pub use crate::library::error::LibraryError;
pub use crate::library::id::{free_id, free_name, id_from_name, name_from_file};
pub use crate::library::provenance::Provenance;
pub use crate::library::read::read_library;
pub use crate::library::write::write_library;
pub(crate) use crate::library::write::{DIGITS, digits, frequencies};

/// What the field `format` of a library holds.
pub const FORMAT: &str = "shagreen-library";
/// Major version that is read and written: files of another one are refused.
pub const VERSION_MAJOR: u32 = 1;
/// Highest minor version that is written: fields may be added by a higher one.
pub const VERSION_MINOR: u32 = 6;
/// Names of the two axes of a space, where a library names no others.
pub const USUAL_AXES: [&str; 2] = ["rough-smooth", "hard-soft"];

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
    /// Names of the attributes that the two coordinates of its places stand for, each by its two poles, the one at 0
    /// first; `None` for [`USUAL_AXES`]. Neither empty nor the same.
    pub axes: Option<[String; 2]>,
    /// How its space was made and how far it can be believed: a JSON object, as `shagreen space build` prints it.
    pub space_report: Option<Value>,
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
    /// Whether it may be passed on.
    pub provenance: Provenance,
    /// What it is.
    pub description: String,
    /// Where it lies in the space, where it has been placed.
    pub place: Option<Place>,
    /// How it is rated on attributes, of which two may be the axes of its space.
    pub attributes: Option<Attributes>,
    /// What was measured or computed of the surface itself, where that is known.
    pub physical: Option<PhysicalLabels>,
    /// What it does to a tip; where it changes along a stroke, at its beginning.
    pub model: TextureModel,
    /// How it changes along a stroke, where it does.
    pub path: Option<TexturePath>,
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

impl From<PhysicalLabels> for Labels {
    fn from(physical: PhysicalLabels) -> Self {
        Self {
            roughness_log10_mps2: physical.roughness_log10_mps2,
            hardness_log10_n_per_m: physical.hardness_log10_n_per_m,
        }
    }
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
    attributes: Map<String, Value>,
    /// Empty, or one for each value of the attributes.
    values: Vec<Map<String, Value>>,
    physical: Map<String, Value>,
    picture: Map<String, Value>,
    tap: Map<String, Value>,
    path: Map<String, Value>,
    relief: Map<String, Value>,
    /// Empty, or one for each key of the path.
    keys: Vec<UnknownOfKey>,
    /// Empty, or one for each node of the model.
    anchors: Vec<Map<String, Value>>,
}

/// The same of a key of a path.
#[derive(Clone, Debug, Default, PartialEq)]
struct UnknownOfKey {
    key: Map<String, Value>,
    tap: Map<String, Value>,
    relief: Map<String, Value>,
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
            provenance: Provenance::default(),
            description: String::new(),
            place: None,
            attributes: None,
            physical: None,
            model,
            path: None,
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

    /// Names of the attributes that the two coordinates of its places stand for.
    pub fn axis_names(&self) -> [&str; 2] {
        self.axes.as_ref().map_or(USUAL_AXES, |axes| axes.each_ref().map(String::as_str))
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

    /// The textures that may not be passed on.
    pub fn restricted(&self) -> impl Iterator<Item = &TextureEntry> {
        self.textures.iter().filter(|texture| texture.provenance == Provenance::Restricted)
    }

    /// Terms of a texture: its own, or those of the library.
    pub fn license_of<'a>(&'a self, texture: &'a TextureEntry) -> &'a str {
        if texture.license.is_empty() { &self.license } else { &texture.license }
    }
}

#[cfg(test)]
mod tests;
