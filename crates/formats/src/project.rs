//! A project: what somebody makes with the program, in one JSON file.
//!
//! ```json
//! {
//!   "format": "shagreen-project",
//!   "version": "1.0",
//!   "units": {"length": "mm", "time": "s"},
//!   "created_by": "…", "notes": "…",
//!   "library": {"built_in": "starter"},
//!   "axes": ["warm-cold", "flat-bumpy"],
//!   "renamed": {"cork": "Cork, sanded"}, "starred": ["oak"],
//!   "selected": 1, "solo": "oak",
//!   "authored": [{
//!     "key": 1, "name": "Oak copy", "color": 3, "notes": "…", "tags": ["wood"],
//!     "rough_smooth": 41.5, "hard_soft": 70.0,
//!     "blend": {"mode": "field", "outside": "clamped", "weights": "barycentric", "locked": ["oak"]},
//!     "path": {"along": "distance", "at_end": "turn", "length_mm": 200.0, "length_s": 3.0, "points": [[41.5, 70.0], …]},
//!     "picture": {"media_type": "image/jpeg", "width": 256, "height": 256, "millimeters": 20.0, "base64": "…"}
//!   }],
//!   "snapshots": […],
//!   "space": {"axes": […], "textures": [{"id": "cork", "space": {…}, "attributes": {…}}], "report": {…}},
//!   "joined": […]
//! }
//! ```
//!
//! - `library` is one of the program's (`built_in`), another file (`{"file": "woods.json", "sha256": "…"}`, relative to the
//!   folder of the project where it lies in there), or inside (`{"inside": {…}}`, a whole library).
//! - `joined` are textures that came to those of the library, as a library has them; `renamed`, `starred`, `locked` and
//!   `solo` know textures by their identifiers.
//! - `snapshots` are states of authored textures that somebody wanted to come back to.
//! - `space` is a space that was built here and gives the textures their places, in the way of a library.
//!
//! Fields that this version does not know are kept where they stood in the project or in an authored texture, and written
//! back. A file of a higher major version is refused.

mod error;
mod read;
mod v1;
mod write;

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;
use std::sync::Arc;

use serde_json::{Map, Value};
use shagreen_core::authoring::{Blending, Outside, Weights};
use shagreen_core::blend::Mode;
use shagreen_core::drawn_path::DrawnPath;
use shagreen_core::space::SpacePoint;

use crate::built_in::BuiltIn;
use crate::library::{Library, Provenance, TextureEntry};
use crate::picture::Picture;
use crate::placed_space::PlacedSpace;
use crate::starter::SimulatedLibraryError;

pub use crate::project::error::ProjectError;
pub use crate::project::read::{read_project, sha256_hex};
pub use crate::project::write::write_project;

/// What the field `format` of a project holds.
pub const FORMAT: &str = "shagreen-project";
/// Major version that is read and written: files of another one are refused.
pub const VERSION_MAJOR: u32 = 1;
/// Minor version that is written: fields may be added by a higher one.
pub const VERSION_MINOR: u32 = 0;
/// What the names of files end with.
pub const EXTENSION: &str = "shagreen";
/// How many colors authored textures may be told apart by.
pub const N_COLORS: u8 = 8;

/// What somebody makes. Large parts are shared, so that a copy is cheap.
#[derive(Clone, Debug, PartialEq)]
pub struct Project {
    // What changes often stands first, so that two that differ are found to differ soon.
    /// What was authored, never empty.
    pub authored: Vec<Arc<AuthoredTexture>>,
    /// The one that is being worked on, by its place among those.
    pub selected: usize,
    /// The texture of the library or among those that joined that is heard alone instead, by identifier.
    pub solo: Option<String>,
    /// States of authored textures to come back to, oldest first.
    pub snapshots: Vec<Arc<AuthoredTexture>>,
    /// What somebody wants to remember of it.
    pub notes: String,
    /// Names that textures were given here, by identifier.
    pub renamed: BTreeMap<String, String>,
    /// Identifiers of textures to be found again soon.
    pub starred: BTreeSet<String>,
    /// Names of the attributes across and up, where they are the axes; `None` takes the places.
    pub axes: Option<[String; 2]>,
    /// The space that gives the textures their places and attributes; `None` leaves them as their files have them.
    pub space: Option<Arc<PlacedSpace>>,
    /// The textures to author from.
    pub library: ProjectLibrary,
    /// Textures that joined those of the library, in the order in which they came.
    pub joined: Vec<Arc<TextureEntry>>,
    /// Fields that this version does not know.
    pub unknown: Map<String, Value>,
}

/// Where the library of a project is.
#[derive(Clone, Debug)]
pub enum ProjectLibrary {
    /// It is one of the program's.
    BuiltIn(BuiltIn),
    /// It is a file of its own.
    File(Arc<LibraryFile>),
    /// It is a part of the project.
    Inside(Arc<Library>),
}

impl ProjectLibrary {
    /// The textures of the library; those of the program take some milliseconds to read.
    ///
    /// # Errors
    /// The program is damaged.
    pub fn read(&self) -> Result<Library, SimulatedLibraryError> {
        match self {
            Self::BuiltIn(built_in) => built_in.read(),
            Self::Inside(library) => Ok(Library::clone(library)),
            Self::File(file) => Ok(file.library.clone()),
        }
    }
}

impl PartialEq for ProjectLibrary {
    /// Libraries are long and never change: what is shared is the same.
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
    /// Where it was read from.
    pub path: PathBuf,
    /// SHA-256 of its bytes, in hexadecimal digits: tells whether it is still the same.
    pub sha256: String,
    /// What it held.
    pub library: Library,
}

/// A texture that is authored: a place in the space, and how it is made of what lies around.
#[derive(Clone, Debug, PartialEq)]
pub struct AuthoredTexture {
    /// Tells it from the others of its project, whatever their order and names.
    pub key: u32,
    /// Its name.
    pub name: String,
    /// The color that it is known by, below [`N_COLORS`].
    pub color: u8,
    /// What somebody wants to remember of it.
    pub notes: String,
    /// Words to search by.
    pub tags: Vec<String>,
    /// Where it lies.
    pub at: SpacePoint,
    /// How textures become one there.
    pub blend: BlendChoice,
    /// The way through the space that it can follow along a stroke, where one is drawn.
    pub path: Option<DrawnPath>,
    /// What it looks like, where that is not left to the pictures of its neighbors.
    pub picture: Option<Arc<Picture>>,
    /// Fields that this version does not know.
    pub unknown: Map<String, Value>,
}

/// How textures become one, with what other modes than the chosen one were asked to do: they are to be compared without
/// losing that.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BlendChoice {
    /// How textures become one.
    pub mode: Mode,
    /// Which of them count, in the mode parametric.
    pub weights: Weights,
    /// What happens outside their hull, in the mode field.
    pub outside: Outside,
    /// Identifiers of textures that the field must meet exactly at their own places.
    pub locked: BTreeSet<String>,
}

impl BlendChoice {
    /// The blending without what its mode cannot do: it always passes [`Blending::check`]. `index_of` finds a texture by its
    /// identifier; locks of those that are not there have no effect.
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

    /// Whether textures can be locked in the chosen mode.
    pub fn can_lock(&self) -> bool {
        self.mode == Mode::Field
    }

    /// Whether the field meets the texture of this identifier exactly at its own place.
    pub fn is_locked(&self, id: &str) -> bool {
        self.can_lock() && self.locked.contains(id)
    }
}

impl AuthoredTexture {
    /// Whether another one is heard as this one is, whatever it is called and looks like.
    pub fn sounds_like(&self, other: &Self) -> bool {
        (self.at, &self.blend, &self.path) == (other.at, &other.blend, &other.path)
    }

    /// A texture at the middle of the space, with the first color.
    pub fn new(key: u32, name: &str) -> Self {
        Self {
            key,
            name: name.to_owned(),
            color: 0,
            notes: String::new(),
            tags: Vec::new(),
            at: SpacePoint { rough_smooth: 50.0, hard_soft: 50.0 },
            blend: BlendChoice::default(),
            path: None,
            picture: None,
            unknown: Map::new(),
        }
    }
}

impl Project {
    /// A project of one texture, at the middle of the space.
    pub fn new(library: ProjectLibrary, name: &str) -> Self {
        Self {
            notes: String::new(),
            library,
            joined: Vec::new(),
            renamed: BTreeMap::new(),
            starred: BTreeSet::new(),
            space: None,
            axes: None,
            authored: vec![Arc::new(AuthoredTexture::new(1, name))],
            selected: 0,
            solo: None,
            snapshots: Vec::new(),
            unknown: Map::new(),
        }
    }

    /// The authored texture that is being worked on.
    ///
    /// # Panics
    /// Nothing was authored, which no project allows.
    pub fn texture(&self) -> &AuthoredTexture {
        &self.authored[self.selected]
    }

    /// The textures as they are shown and heard here: those of `base`, which is the project's library, then those that joined,
    /// in the places of the space that is in use, under the names that they were given.
    pub fn textures_on(&self, base: Library) -> Library {
        let mut library = base;
        library.join(&self.joined);
        if let Some(space) = &self.space {
            library = space.place(&library);
        }
        for texture in &mut library.textures {
            if let Some(name) = self.renamed.get(&texture.id) {
                texture.name.clone_from(name);
            }
        }
        library
    }

    /// The textures that a file of the project would hold and that may not be passed on: those of a library inside, and
    /// those that joined.
    pub fn restricted(&self) -> impl Iterator<Item = &TextureEntry> {
        let inside =
            if let ProjectLibrary::Inside(library) = &self.library { &library.textures[..] } else { &[] };
        let all = inside.iter().chain(self.joined.iter().map(|entry| &**entry));
        all.filter(|entry| entry.provenance == Provenance::Restricted)
    }

    /// A key that no authored texture of the project has, nor had as long as a snapshot knows it.
    pub fn free_key(&self) -> u32 {
        let highest = self.authored.iter().chain(&self.snapshots).map(|texture| texture.key).max();
        highest.unwrap_or(0) + 1
    }
}

#[cfg(test)]
mod tests;
