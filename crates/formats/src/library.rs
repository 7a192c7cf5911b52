//! The texture library format: one JSON file that states its contents, units and sources.
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
//! - `"interpolation"`: interpolation of the AR models between anchors, `"barycentric"` (the default),
//!   `"radial_basis"`, or `"published"`. Anchors of `"published"` have `"variance"` in (m/s²)², `"gain"` and `"ma_lsf"`
//!   instead of `level_mps2`, and include the boundary (speed or force zero).
//! - `"tap": {"frequency_hz": 180.0, "decay_per_s": 90.0, "amplitude_mps2": 4.0}`: the tap transient.
//! - `"provenance": "restricted"`: made from data that must not be redistributed; see [`Provenance`].
//!
//! Version 1.2 added, to a texture:
//!
//! - `"attributes": {"label_source": "human", "values": [{"name": "rough-smooth", "value": 40.5}, …]}`: values from 0
//!   to 100 on any number of attributes, each named by its two poles; see [`Attributes`].
//!
//! and to the library:
//!
//! - `"space_report": {…}`: how its space was built and validated, in the form that `shagreen space build` prints.
//!
//! Version 1.3 added, to the library:
//!
//! - `"axes": ["warm-cold", "flat-bumpy"]`: the attributes that the fields `rough_smooth` and `hard_soft` of every
//!   position hold, if they differ from what these field names or the axes in `space_report` say.
//!
//! Version 1.4 added, to a texture that changes along a stroke:
//!
//! - `"path": {"along": "distance", "at_end": "hold", "keys": [{"along": 0.0, "rough_smooth": 30.0, "hard_soft": 70.0,
//!   "stop": true, "mu": 0.4, "tap": {…}, "anchors": […]}, …]}`: textures at points along the stroke, in mm of tip
//!   travel or, with `"along": "time"`, in s of contact. `at_end` is `hold`, `turn` or `repeat`; `stop` marks the
//!   points that a person chose. The texture's own anchors are those of the first key, for programs without path
//!   support.
//!
//! Version 1.5 added, to a texture and to the keys of its path:
//!
//! - `"relief": {"step_mm": 0.01, "force_n": 1.0, "mps2": [0.1, -0.2]}`: an acceleration profile in m/s² over tip
//!   position, sampled every `step_mm`. It has its stated level at `force_n`. Beyond its end it is traversed backwards
//!   and forwards.
//!
//! Version 1.6 added the label source `estimated`: a position estimated from words, a picture or a recording.
//!
//! Version 1.7 added, to a texture and to the keys of its path, what depends on the direction of the stroke, and
//! stick-slip friction. A texture has its own axes: its lay, the direction of its grain or brushing, runs along y, as in
//! its picture.
//!
//! - `"anchors_along": […]`: anchors as in `anchors`, for strokes along the lay; `anchors` are then for strokes across it. They
//!   have the speeds, forces and order of `anchors`, in the same sequence.
//! - `"turn_deg": 30.0`: angle of the texture's x axis on the pad in degrees, counterclockwise.
//! - `"height_map": {"side_mm": 20.0, "n": 256, "force_n": 1.0, "speed_exponent": 2.0, "patch_radius_mm": 0.2,
//!   "step_m": 1e-9, "base64": "…"}`: one square tile of `n` by `n` heights, row by row from y = 0, which repeats in both
//!   directions. Heights are integers of 16 bits, little endian, in steps of `step_m`. The acceleration grows with this
//!   power of the tip speed; at the force `force_n`, the contact patch has the radius `patch_radius_mm`.
//! - `"space": {…, "sd": [10.0, 25.0]}`: standard deviation of an estimated position on both axes.
//! - `"stick_slip": {"static_ratio": 1.6, "stribeck_mm_per_s": 20.0}`: static friction relative to the kinetic friction
//!   `mu`, and Stribeck speed.
//!
//! Version 1.8 added spaces with another number of axes than two:
//!
//! - `"axes"` has one to six names: attributes, or features of the vibration (`centroid`, `speed exponent`, `force exponent`,
//!   `tap frequency`).
//! - `"space"` and the keys of a path have the coordinate on the first axis in `rough_smooth`, on the second one in
//!   `hard_soft`, and on the others in `"further": [20.0, 55.5]`, whatever the axes are. With one axis, there is no
//!   `hard_soft`. Every `space` has as many coordinates as the library has axes. `sd` holds the first two axes. All keys of a
//!   path have the same number of coordinates; it is another one than that of the axes if the path was authored on others.
//!
//! Version 1.9 added predictors of the orders 33 to 64: that many frequencies in `lsf`.
//!
//! A file states the lowest version that has all features it uses.
//!
//! Unknown fields are kept in [`Unknown`] and written back. A file of a higher major version is rejected.

mod anchors;
pub(crate) mod attributes;
mod authored;
mod coordinates;
mod error;
mod height_map;
mod id;
pub(crate) mod numbers;
mod path;
mod provenance;
pub(crate) mod read;
mod relief;
mod stick_slip;
mod tap;
mod turn;
pub(crate) mod v1;
pub(crate) mod write;

use serde_json::{Map, Value};
use shagreen_core::space::texture_path::TexturePath;
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::surfaces::starter::Labels;
use shagreen_core::texture::TextureModel;

use crate::picture::Picture;

pub use crate::library::attributes::{Attribute, Attributes};
pub(crate) use crate::library::attributes::{are_axes, is_usual};
pub use crate::library::authored::ReliefSource;
pub use crate::library::coordinates::CoordinatesError;
pub(crate) use crate::library::coordinates::CoordinatesV1;
pub use crate::library::error::LibraryError;
pub use crate::library::id::{free_id, free_name, id_from_name, name_from_file};
pub(crate) use crate::library::numbers::{DIGITS, digits, frequencies};
pub use crate::library::provenance::Provenance;
pub use crate::library::read::read_library;
pub use crate::library::write::write_library;

/// Value of the `format` field of a library.
pub const FORMAT: &str = "shagreen-library";
/// Supported major version; files of another one are rejected.
pub const VERSION_MAJOR: u32 = 1;
/// Highest minor version that is written; a newer one may add fields.
pub const VERSION_MINOR: u32 = 9;
/// Names of the axes of a library that states none.
pub const USUAL_AXES: [&str; 2] = ["rough-smooth", "hard-soft"];

/// A set of textures with a common space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Library {
    /// Name to show.
    pub name: String,
    /// Description in a sentence or two.
    pub description: String,
    /// Where its textures come from.
    pub origin: String,
    /// Terms of use, as an SPDX expression if there is one.
    pub license: String,
    /// The program that wrote it, with its version.
    pub created_by: String,
    /// Random seed, if a program generated it.
    pub seed: Option<u64>,
    /// Names of the axes of the positions, one to [`MOST_AXES`](shagreen_core::space::MOST_AXES): attributes by their two
    /// poles, the one at 0 first, or features of the vibration such as `centroid`. `None` for [`USUAL_AXES`]. The names are
    /// neither empty nor equal. Every position has one coordinate for each of them.
    pub axes: Option<Vec<String>>,
    /// How its space was built and validated: a JSON object in the form that `shagreen space build` prints.
    pub space_report: Option<Value>,
    /// The textures, identified by their index here. Their `id`s are unique.
    pub textures: Vec<TextureEntry>,
    /// Fields that this version does not know.
    pub unknown: UnknownOfLibrary,
}

/// A texture with its metadata.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureEntry {
    /// Identifier, unique in its library; neither empty nor with white space.
    pub id: String,
    /// Name to show.
    pub name: String,
    /// Search terms.
    pub tags: Vec<String>,
    /// Terms of use of this texture; empty if those of the library apply.
    pub license: String,
    /// Where it comes from; empty if the origin of the library applies.
    pub origin: String,
    /// Whether it may be redistributed.
    pub provenance: Provenance,
    /// Description.
    pub description: String,
    /// Position in the space, if assigned.
    pub place: Option<Place>,
    /// Attribute values; some of the attributes may be axes of the space.
    pub attributes: Option<Attributes>,
    /// Measured or simulated physical quantities, if known.
    pub physical: Option<PhysicalLabels>,
    /// The texture model; for a texture that changes along a stroke, the model at the start.
    pub model: TextureModel,
    /// Changes along a stroke, if any.
    pub path: Option<TexturePath>,
    /// Picture of the surface.
    pub picture: Option<Picture>,
    /// Fields that this version does not know.
    pub unknown: Unknown,
}

/// A position in the space with its label source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The position.
    pub at: SpacePoint,
    /// What the position was derived from.
    pub source: LabelSource,
    /// Standard deviation of an estimated position on its first two axes, 0 to 100; the second is 0 in a space with one
    /// axis. `None` if it is not known.
    pub deviation: Option<[f64; 2]>,
}

impl Place {
    /// Position without a known standard deviation.
    pub fn new(at: SpacePoint, source: LabelSource) -> Self {
        Self { at, source, deviation: None }
    }
}

/// The physical quantities behind [`LabelSource::PhysicalLabels`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhysicalLabels {
    /// log₁₀ of the root mean square acceleration in m/s² at 100 mm/s and 1 N.
    pub roughness_log10_mps2: f64,
    /// log₁₀ of the contact stiffness in N/m at 1 N.
    pub hardness_log10_n_per_m: f64,
}

impl PhysicalLabels {
    /// Contact stiffness at 1 N, in N/m; `None` if it is beyond the range of numbers.
    pub fn stiffness_n_per_m(&self) -> Option<f64> {
        let stiffness = 10_f64.powf(self.hardness_log10_n_per_m);
        (stiffness.is_finite() && stiffness > 0.0).then_some(stiffness)
    }
}

impl From<PhysicalLabels> for Labels {
    fn from(physical: PhysicalLabels) -> Self {
        Self {
            roughness_log10_mps2: physical.roughness_log10_mps2,
            hardness_log10_n_per_m: physical.hardness_log10_n_per_m,
        }
    }
}

/// Unknown fields of a library, by the object that contains them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UnknownOfLibrary {
    library: Map<String, Value>,
    units: Map<String, Value>,
}

/// Unknown fields of a texture, by the object that contains them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Unknown {
    texture: Map<String, Value>,
    space: Map<String, Value>,
    attributes: Map<String, Value>,
    /// Empty, or one per attribute value.
    values: Vec<Map<String, Value>>,
    physical: Map<String, Value>,
    picture: Map<String, Value>,
    tap: Map<String, Value>,
    path: Map<String, Value>,
    relief: Map<String, Value>,
    height_map: Map<String, Value>,
    stick_slip: Map<String, Value>,
    /// Empty, or one per key of the path.
    keys: Vec<UnknownOfKey>,
    /// Empty, or one per node of the model.
    anchors: Vec<Map<String, Value>>,
    /// Empty, or one per node of the grain along the lay.
    along: Vec<Map<String, Value>>,
}

/// Unknown fields of a path key, by the object that contains them.
#[derive(Clone, Debug, Default, PartialEq)]
struct UnknownOfKey {
    key: Map<String, Value>,
    tap: Map<String, Value>,
    relief: Map<String, Value>,
    height_map: Map<String, Value>,
    stick_slip: Map<String, Value>,
    /// Empty, or one per node of the model.
    anchors: Vec<Map<String, Value>>,
    /// Empty, or one per node of the grain along the lay.
    along: Vec<Map<String, Value>>,
}

impl TextureEntry {
    /// Creates a texture from identifier, name and model; all other fields are empty.
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

    /// Position in the space, if assigned.
    pub fn at(&self) -> Option<SpacePoint> {
        self.place.map(|place| place.at)
    }

    /// What the position was derived from, if assigned.
    pub fn label_source(&self) -> Option<LabelSource> {
        self.place.map(|place| place.source)
    }
}

impl Library {
    /// Index of the texture with this identifier.
    pub fn index_of(&self, id: &str) -> Option<usize> {
        self.textures.iter().position(|texture| texture.id == id)
    }

    /// Names of the axes of the positions, one to six, in the order of the coordinates.
    pub fn axis_names(&self) -> Vec<&str> {
        names_or_usual(self.axes.as_deref())
    }

    /// Positions of all textures, indexed as [`Library::textures`]; the input of a space.
    pub fn positions(&self) -> Vec<Option<SpacePoint>> {
        self.textures.iter().map(TextureEntry::at).collect()
    }

    /// All label sources of the positions, each once, in texture order. Distances between textures of different label
    /// sources are hardly meaningful.
    pub fn label_sources(&self) -> Vec<LabelSource> {
        let mut sources = Vec::new();
        for source in self.textures.iter().filter_map(TextureEntry::label_source) {
            if !sources.contains(&source) {
                sources.push(source);
            }
        }
        sources
    }

    /// The single label source of all positions; `None` if there are no positions or several sources, see
    /// [`Library::label_sources`].
    pub fn label_source(&self) -> Option<LabelSource> {
        match self.label_sources()[..] {
            [source] => Some(source),
            _ => None,
        }
    }

    /// The textures that must not be redistributed.
    pub fn restricted(&self) -> impl Iterator<Item = &TextureEntry> {
        self.textures.iter().filter(|texture| texture.provenance == Provenance::Restricted)
    }

    /// Terms of use of a texture: its own, or those of the library.
    pub fn license_of<'a>(&'a self, texture: &'a TextureEntry) -> &'a str {
        if texture.license.is_empty() { &self.license } else { &texture.license }
    }

    /// A copy of a texture with its own terms of use and its own origin, for a place without this library.
    pub fn with_terms(&self, texture: &TextureEntry) -> TextureEntry {
        let origin = if texture.origin.is_empty() { &self.origin } else { &texture.origin };
        let (license, origin) = (self.license_of(texture).to_owned(), origin.clone());
        TextureEntry { license, origin, ..texture.clone() }
    }
}

/// These names of axes, or else [`USUAL_AXES`].
pub(crate) fn names_or_usual(axes: Option<&[String]>) -> Vec<&str> {
    axes.map_or_else(|| USUAL_AXES.to_vec(), |axes| axes.iter().map(String::as_str).collect())
}

#[cfg(test)]
mod tests;
