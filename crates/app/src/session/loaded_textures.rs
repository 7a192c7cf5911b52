//! The textures that are open: the library, what the project adds to it, and what is computed from both.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use shagreen_core::space::SpacePoint;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::rate::highest_rate;
use shagreen_core::units::Hertz;
use shagreen_formats::library::{Library, Place, TextureEntry};
use shagreen_formats::placed_space::PlacedSpace;
use shagreen_formats::project::{AddedCoordinates, OwnTextures, ProjectLibrary};
use shagreen_studio::axes::AxisColumns;

use super::places::Opened;
use super::planes_worker::PlanesWorker;

/// The textures of the library and of the project, by one index.
pub(super) struct Textures {
    pub(super) library: Library,
    /// The library of the open project.
    pub(super) base: ProjectLibrary,
    /// Libraries that were open before, except the built-in ones.
    pub(super) others: Vec<ProjectLibrary>,
    /// Positions and names as the library's file states them. The textures behind its own are the project's.
    pub(super) opened: Opened,
    /// Textures that the project added.
    pub(super) joined: Vec<Arc<TextureEntry>>,
    /// Identifiers of added textures that take part only in the authored textures that pin them.
    pub(super) own_ids: BTreeSet<String>,
    /// These textures, by index.
    pub(super) own: OwnTextures,
    /// Coordinates of added textures where nothing else gives one.
    pub(super) coordinates: AddedCoordinates,
    /// New names by id.
    pub(super) renamed: BTreeMap<String, String>,
    /// The space that gave the textures their positions.
    pub(super) used: Option<Arc<PlacedSpace>>,
    /// The axes that the project chooses.
    pub(super) axes: Option<Vec<String>>,
    /// Names of the axes in use.
    pub(super) axis_names: Vec<String>,
    /// Coordinates on the axes that the project chooses.
    pub(super) columns: AxisColumns,
    /// Position of each texture on the canvas.
    pub(super) places: Vec<Option<Place>>,
    /// Words at the low and the high end of each axis.
    pub(super) poles: Vec<[String; 2]>,
    /// Each texture over speed and force.
    pub(super) planes: Vec<Arc<Plane>>,
    /// Sample rate of each plane, in Hz.
    pub(super) rates_hz: Vec<f64>,
    /// Planes prepared for the renderer, by a worker.
    pub(super) planes_ahead: PlanesWorker,
    /// Sample rate of the textures in the space, in Hz.
    pub(super) space_rate_hz: f64,
}

/// Sample rate of the space: the highest rate of its textures, because signals of different rates cannot be mixed.
/// Without positions it is the rate of the first texture.
pub(super) fn rate_of_space(textures: &[TextureEntry], places: &[Option<Place>]) -> Hertz {
    let first = textures.first().map(|texture| texture.model.rate());
    let placed = textures.iter().zip(places).filter(|(_, place)| place.is_some()).map(|(t, _)| &t.model);
    highest_rate(placed).or(first).unwrap_or(Hertz(1000.0))
}

/// Sample rate at which a texture plays: that of the space, or its own if it has no position and can only be soloed.
pub(super) fn rate_in(texture: &TextureEntry, place: Option<&Place>, rate_of_space: Hertz) -> Hertz {
    place.map_or(texture.model.rate(), |_| rate_of_space)
}

/// Position of each texture; `None` for those without a place and those that are left out.
pub(super) fn positions_without(places: &[Option<Place>], left_out: &[usize]) -> Vec<Option<SpacePoint>> {
    let mut positions = positions(places);
    for texture in left_out {
        if let Some(position) = positions.get_mut(*texture) {
            *position = None;
        }
    }
    positions
}

pub(super) fn positions(places: &[Option<Place>]) -> Vec<Option<SpacePoint>> {
    places.iter().map(|place| place.map(|place| place.at)).collect()
}
