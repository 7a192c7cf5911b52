//! A project: the textures that a user authors, in one JSON file.
//!
//! ```json
//! {
//!   "format": "shagreen-project",
//!   "version": "1.3",
//!   "units": {"length": "mm", "time": "s"},
//!   "created_by": "…", "notes": "…",
//!   "library": {"built_in": "starter"},
//!   "axes": ["warm-cold", "flat-bumpy", "centroid"],
//!   "renamed": {"cork": "Cork, sanded"}, "starred": ["oak"],
//!   "selected": 1, "solo": "oak", "compared": [1, 3],
//!   "authored": [{
//!     "key": 1, "name": "Oak copy", "color": 3, "notes": "…", "tags": ["wood"],
//!     "rough_smooth": 41.5, "hard_soft": 70.0, "further": [25.0],
//!     "blend": {"mode": "field", "outside": "clamped", "weights": "barycentric", "locked": ["oak"]},
//!     "shape": {"level_db": -3.0, "grain": 1.2, "brightness_db_per_octave": 1.0, "softness": 2.0, "friction": 0.5,
//!       "relief": 1.5, "direction_deg": 30.0},
//!     "path": {"along": "distance", "at_end": "turn", "length_mm": 200.0, "length_s": 3.0, "points": [[41.5, 70.0, 25.0], …]},
//!     "picture": {"media_type": "image/jpeg", "width": 256, "height": 256, "millimeters": 20.0, "base64": "…"}
//!   }],
//!   "snapshots": […],
//!   "space": {"axes": […], "textures": [{"id": "cork", "space": {…}, "attributes": {…}}], "report": {…}},
//!   "joined": [{"id": "felt-2", "own": true, "coordinates": {"flat-bumpy": 25.0}, …}]
//! }
//! ```
//!
//! - `library` is a built-in library (`built_in`), another file (`{"file": "woods.json", "sha256": "…"}`, relative to
//!   the folder of the project if it lies inside that folder), or embedded (`{"inside": {…}}`, a whole library).
//! - `joined` are textures added to those of the library, in the library format. `renamed`, `starred`, `locked` and
//!   `solo` refer to textures by their identifiers. An added texture that is `own` belongs to the authored textures that
//!   have it in `locked`, and takes part in no other. `coordinates` are estimated coordinates of an added texture, by the name of
//!   the axis, where neither its position nor its attributes nor its vibration give one.
//! - `locked` are the pinned textures of the interpolation mode Field.
//! - `compared` are the keys of the authored textures on the sides A and B of a comparison.
//! - `shape` has the values of [`Shape`] that are not neutral.
//! - `rough_smooth` and `hard_soft` are the coordinates on the first two axes, whatever these are, and `further` those on the
//!   others. A position on one axis has no `hard_soft`. Points of a path have as many numbers as the position of its texture has
//!   coordinates. The position may have another number of them than the space, if its library has changed.
//! - `axes` are one to six names: axes of the positions, attributes, or features of the vibration (`centroid`, `speed exponent`,
//!   `force exponent`, `tap frequency`). If several have the same name, it is that of the first of these; `attribute:` before a
//!   name selects the attribute. Before version 1.3, the two names are those of attributes. Without `axes`, the textures have the
//!   positions of `space` or of the library.
//! - A project has version 1.3 if a position in it has another number of coordinates than two, if its `axes` are not two
//!   attributes, or if it has `coordinates` or a snapshot with `axes`; otherwise 1.2 if it has `own` textures, 1.1 if it has
//!   shapes, or 1.0.
//! - `snapshots` are saved states of authored textures. A snapshot that was taken on other axes than those of the project has
//!   `axes` of its own: their names, one for each of its coordinates.
//! - `space` is a space that was built in this project; it gives the textures their positions, in the library format.
//!
//! Unknown fields of the project or of an authored texture are kept and written back. A file of a higher major version
//! is rejected.

mod axes;
pub mod clipboard;
mod coordinates;
mod error;
mod listed_ids;
mod own;
mod points;
mod read;
mod shape;
mod v1;
mod write;

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::sync::Arc;

use serde_json::{Map, Value};
use shagreen_core::space::authoring::{Blending, Outside, Weights};
use shagreen_core::space::texture_path::UserPath;
use shagreen_core::space::{MIDDLE, SpacePoint};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::shape::Shape;

use crate::built_in::BuiltIn;
use crate::library::{Library, Provenance, TextureEntry};
use crate::picture::Picture;
use crate::placed_space::PlacedSpace;
use crate::starter::SimulatedLibraryError;

pub use crate::project::axes::{ATTRIBUTE_PREFIX, different_axes, is_same_axis, plain_axis_name};
pub use crate::project::coordinates::AddedCoordinates;
pub use crate::project::error::ProjectError;
pub use crate::project::own::OwnTextures;
pub use crate::project::read::{read_project, read_project_on, sha256_hex};
pub use crate::project::write::write_project;

/// Value of the `format` field of a project.
pub const FORMAT: &str = "shagreen-project";
/// Supported major version; files of another one are rejected.
pub const VERSION_MAJOR: u32 = 1;
/// Highest minor version that is read completely; a newer one may add fields.
pub const VERSION_MINOR: u32 = 3;
/// File name extension.
pub const EXTENSION: &str = "shagreen";
/// Number of colors for authored textures.
pub const N_COLORS: u8 = 8;

/// The work of a user. Large parts are shared, so a copy is cheap.
#[derive(Clone, Debug, PartialEq)]
pub struct Project {
    // Frequently changed fields come first, so that comparing two different projects ends early.
    /// Authored textures; never empty.
    pub authored: Vec<Arc<AuthoredTexture>>,
    /// Index of the selected authored texture.
    pub selected: usize,
    /// Identifier of a library or added texture that is rendered alone instead of the selected one.
    pub solo: Option<String>,
    /// Keys of the authored textures on the sides A and B of a comparison; `None` if the user has not chosen them. A texture
    /// with such a key may be deleted.
    pub compared: Option<[u32; 2]>,
    /// Saved states of authored textures, oldest first.
    pub snapshots: Vec<Arc<AuthoredTexture>>,
    /// Notes of the user.
    pub notes: String,
    /// Names given to textures in this project, by identifier.
    pub renamed: BTreeMap<String, String>,
    /// Identifiers of favorite textures.
    pub starred: BTreeSet<String>,
    /// Names of the axes, one to [`MOST_AXES`](shagreen_core::space::MOST_AXES), the horizontal one first, then the vertical
    /// one: axes of the positions, attributes or features of the vibration. One that begins with [`ATTRIBUTE_PREFIX`] is an
    /// attribute. `None` uses the positions.
    pub axes: Option<Vec<String>>,
    /// The space that gives the textures their positions and attributes; `None` keeps those of the files.
    pub space: Option<Arc<PlacedSpace>>,
    /// The library of textures to interpolate from.
    pub library: ProjectLibrary,
    /// Textures added to those of the library, in the order of addition. Their identifiers are those of the list; see
    /// [`Project::follow_listed_ids`].
    pub joined: Vec<Arc<TextureEntry>>,
    /// Identifiers of added textures that take part only in the authored textures that pin them;
    /// see [`OwnTextures`].
    pub own: BTreeSet<String>,
    /// Coordinates of added textures where nothing else gives one; see [`AddedCoordinates`].
    pub coordinates: AddedCoordinates,
    /// Fields that this version does not know.
    pub unknown: Map<String, Value>,
}

/// Location of the library of a project.
#[derive(Clone, Debug)]
pub enum ProjectLibrary {
    /// A built-in library.
    BuiltIn(BuiltIn),
    /// A separate file.
    File(Arc<LibraryFile>),
    /// Embedded in the project.
    Inside(Arc<Library>),
}

impl ProjectLibrary {
    /// Returns the library; a built-in one takes some milliseconds to read.
    ///
    /// # Errors
    /// Fails only if the program file is damaged.
    pub fn read(&self) -> Result<Library, SimulatedLibraryError> {
        match self {
            Self::BuiltIn(built_in) => built_in.read(),
            Self::Inside(library) => Ok(Library::clone(library)),
            Self::File(file) => Ok(file.library.clone()),
        }
    }
}

impl PartialEq for ProjectLibrary {
    /// Libraries are large and immutable, so shared ones are compared by pointer first.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::BuiltIn(a), Self::BuiltIn(b)) => a == b,
            (Self::File(a), Self::File(b)) => Arc::ptr_eq(a, b) || a == b,
            (Self::Inside(a), Self::Inside(b)) => Arc::ptr_eq(a, b) || a == b,
            _ => false,
        }
    }
}

/// A library that was read from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct LibraryFile {
    /// Path of the file.
    pub path: PathBuf,
    /// SHA-256 of the file in hexadecimal digits; detects later changes.
    pub sha256: String,
    /// Contents of the file.
    pub library: Library,
}

/// An authored texture: a position in the space, and how to interpolate there.
#[derive(Clone, Debug, PartialEq)]
pub struct AuthoredTexture {
    /// Key that identifies it in its project, independent of order and name.
    pub key: u32,
    /// Name to show.
    pub name: String,
    /// Index of its color, below [`N_COLORS`].
    pub color: u8,
    /// Notes of the user.
    pub notes: String,
    /// Search terms.
    pub tags: Vec<String>,
    /// Position in the space.
    pub at: SpacePoint,
    /// Names of the axes of its position and path, if they are not those of the space: only a snapshot that was taken on other axes
    /// has them.
    pub axes: Option<Vec<String>>,
    /// Interpolation options at that position.
    pub blend: BlendChoice,
    /// Shape of the interpolated texture.
    pub shape: Shape,
    /// Drawn path through the space that it can follow along a stroke.
    pub path: Option<UserPath>,
    /// Its own picture; `None` derives one from the pictures of its neighbors.
    pub picture: Option<Arc<Picture>>,
    /// Fields that this version does not know.
    pub unknown: Map<String, Value>,
}

/// Interpolation options. Options of other modes than the selected one are kept, so that modes can be compared without
/// losing them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlendChoice {
    /// Interpolation mode.
    pub mode: Mode,
    /// Weighting of the neighbors, in the mode Parametric.
    pub weights: Weights,
    /// Behavior outside the convex hull, in the mode Field.
    pub outside: Outside,
    /// Identifiers of pinned textures: the field passes through them at their positions.
    pub locked: BTreeSet<String>,
}

impl BlendChoice {
    /// Returns the options that the selected mode supports; the result always passes [`Blending::check`]. `index_of`
    /// maps identifiers to library indices; pinned textures that do not exist are ignored.
    pub fn blending(&self, index_of: impl Fn(&str) -> Option<usize>) -> Blending {
        match self.mode {
            Mode::Field => {
                let mut locked: Vec<usize> = self.locked.iter().filter_map(|id| index_of(id)).collect();
                locked.sort_unstable();
                Blending { mode: self.mode, weights: Weights::default(), outside: self.outside, locked }
            }
            Mode::Parametric => Blending { weights: self.weights, ..self.mode.into() },
            Mode::Shared | Mode::Power | Mode::Paper => self.mode.into(),
        }
    }

    /// Returns the mode as it applies in a space with this number of axes. Modes that interpolate in triangles need a space
    /// with one or two axes; with more, the mode is [`Mode::Field`].
    pub fn mode_in_space(&self, n_axes: usize) -> Mode {
        if Blending::from(self.mode).check_in(n_axes).is_ok() { self.mode } else { Mode::Field }
    }

    /// Returns the options with the mode as it applies in a space with this number of axes
    /// ([`BlendChoice::mode_in_space`]).
    #[must_use]
    pub fn in_space(&self, n_axes: usize) -> Cow<'_, Self> {
        let mode = self.mode_in_space(n_axes);
        if mode == self.mode { Cow::Borrowed(self) } else { Cow::Owned(Self { mode, ..self.clone() }) }
    }

    /// Returns whether the selected mode supports pinned textures.
    pub fn can_lock(&self) -> bool {
        self.mode == Mode::Field
    }

    /// Returns whether the texture with this identifier is pinned in the selected mode.
    pub fn is_locked(&self, id: &str) -> bool {
        self.can_lock() && self.locked.contains(id)
    }
}

impl AuthoredTexture {
    /// Returns whether both textures give the same signal, regardless of name and appearance.
    pub fn sounds_like(&self, other: &Self) -> bool {
        (self.at, &self.blend, self.shape, &self.path) == (other.at, &other.blend, other.shape, &other.path)
    }

    /// Creates a texture at the center of a space with two axes, with the first color.
    pub fn new(key: u32, name: &str) -> Self {
        Self {
            key,
            name: name.to_owned(),
            color: 0,
            notes: String::new(),
            tags: Vec::new(),
            at: SpacePoint::plane(MIDDLE, MIDDLE),
            axes: None,
            blend: BlendChoice::default(),
            shape: Shape::default(),
            path: None,
            picture: None,
            unknown: Map::new(),
        }
    }
}

impl Project {
    /// Creates a project with one authored texture at the center of the space.
    pub fn new(library: ProjectLibrary, name: &str) -> Self {
        Self {
            notes: String::new(),
            library,
            joined: Vec::new(),
            own: BTreeSet::new(),
            coordinates: AddedCoordinates::default(),
            renamed: BTreeMap::new(),
            starred: BTreeSet::new(),
            space: None,
            axes: None,
            authored: vec![Arc::new(AuthoredTexture::new(1, name))],
            selected: 0,
            solo: None,
            compared: None,
            snapshots: Vec::new(),
            unknown: Map::new(),
        }
    }

    /// The selected authored texture.
    ///
    /// # Panics
    /// If `authored` is empty, which no project allows.
    pub fn texture(&self) -> &AuthoredTexture {
        &self.authored[self.selected]
    }

    /// Returns the textures as the project shows and renders them: those of `base` (the project's library), then the
    /// added ones, at the positions of the current space and under their names in the project.
    pub fn textures_on(&self, base: Library) -> Library {
        let mut library = base;
        library.join(&self.joined);
        if let Some(space) = &self.space {
            library = space.place(&library);
        }
        self.place_added(&mut library);
        for texture in &mut library.textures {
            if let Some(name) = self.renamed.get(&texture.id) {
                texture.name.clone_from(name);
            }
        }
        library
    }

    /// The restricted textures that a file of the project would contain: those of an embedded library, and added ones.
    pub fn restricted(&self) -> impl Iterator<Item = &TextureEntry> {
        let inside =
            if let ProjectLibrary::Inside(library) = &self.library { &library.textures[..] } else { &[] };
        let all = inside.iter().chain(self.joined.iter().map(|entry| &**entry));
        all.filter(|entry| entry.provenance == Provenance::Restricted)
    }

    /// Returns a key that no authored texture or snapshot of the project has.
    pub fn free_key(&self) -> u32 {
        let used = || self.authored.iter().chain(&self.snapshots).map(|texture| texture.key);
        let highest = used().max().unwrap_or(0);
        highest.checked_add(1).unwrap_or_else(|| {
            let used: BTreeSet<u32> = used().collect();
            // A project cannot hold as many textures as there are keys.
            (1..u32::MAX).find(|key| !used.contains(key)).unwrap_or(u32::MAX)
        })
    }
}

#[cfg(test)]
mod tests;
