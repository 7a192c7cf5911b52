//! Conversion of a library to bytes; the same library always gives the same bytes.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::Map;
use shagreen_core::space::texture_path::TexturePath;
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::texture::{Interpolation, TextureModel};

use crate::layout;
use crate::library::anchors::{anchors, anchors_of, interpolation_word};
use crate::library::coordinates::CoordinatesV1;
use crate::library::numbers::{CONVERSION_DIGITS, DIGITS, decimals, digits};
use crate::library::v1::{
    LibraryV1, PhysicalV1, PictureV1, RESTRICTED, SpaceV1, TapV1, TextureV1, UNITS, UnitsV1,
};
use crate::library::{FORMAT, Library, Place, Provenance, TextureEntry, USUAL_AXES, VERSION_MAJOR};
use crate::library::{attributes, height_map, path, relief, stick_slip, tap, turn};
use crate::picture::Picture;
/// Nesting depth up to which values get their own lines. Each anchor (in library, textures, texture, anchors) fills one
/// line.
const OPEN_DEPTH: usize = 4;

/// The minor version that introduced predictors of an order above [`ORDER_BEFORE`].
const WITH_HIGH_ORDERS: u32 = 9;
/// Highest order of a predictor in earlier versions.
const ORDER_BEFORE: usize = 32;
/// The minor version that introduced spaces with another number of axes than two.
const WITH_FURTHER_AXES: u32 = 8;
/// The minor version that introduced grain along the lay, rotation, height maps, stick-slip friction and standard
/// deviations of positions.
const WITH_DIRECTION: u32 = 7;
/// The minor version that introduced estimated labels.
const WITH_ESTIMATES: u32 = 6;
/// The minor version that introduced reliefs.
const WITH_RELIEFS: u32 = 5;
/// The minor version that introduced paths.
const WITH_PATHS: u32 = 4;
/// The minor version that introduced axis names.
const WITH_AXES: u32 = 3;
/// The minor version that introduced attributes and the space report.
const WITH_ATTRIBUTES: u32 = 2;

/// Serializes a library, with line spectral frequencies to six decimals and levels to six digits. Reading the result
/// and writing it again gives the same bytes.
pub fn write_library(library: &Library) -> Vec<u8> {
    layout::to_bytes(&wire(library), OPEN_DEPTH)
}

/// Converts a library to the form of a file or of a part of another file.
pub(crate) fn wire(library: &Library) -> LibraryV1 {
    let units = UNITS.map(|(_, unit)| unit.to_owned());
    let [speed, force, acceleration, rate, lsf, length] = units;
    LibraryV1 {
        format: FORMAT.to_owned(),
        version: format!("{VERSION_MAJOR}.{}", minor_version(library)),
        units: UnitsV1 {
            speed,
            force,
            acceleration,
            rate,
            lsf,
            length,
            unknown: library.unknown.units.clone(),
        },
        name: library.name.clone(),
        description: library.description.clone(),
        origin: library.origin.clone(),
        licence: library.license.clone(),
        created_by: library.created_by.clone(),
        seed: library.seed,
        axes: attributes::axes_for_file(library),
        space_report: library.space_report.clone(),
        unknown: library.unknown.library.clone(),
        textures: library.textures.iter().map(texture).collect(),
    }
}

/// Converts a texture to the form of a file.
pub(crate) fn texture(entry: &TextureEntry) -> TextureV1 {
    let unknown = &entry.unknown;
    TextureV1 {
        id: entry.id.clone(),
        name: entry.name.clone(),
        tags: entry.tags.clone(),
        licence: entry.license.clone(),
        origin: entry.origin.clone(),
        description: entry.description.clone(),
        space: entry.place.map(|at| SpaceV1 { unknown: unknown.space.clone(), ..place(at) }),
        attributes: entry.attributes.as_ref().map(|a| attributes::write(a, unknown)),
        physical: entry.physical.map(|labels| PhysicalV1 {
            roughness_log10_mps2: digits(labels.roughness_log10_mps2, DIGITS),
            hardness_log10_n_per_m: digits(labels.hardness_log10_n_per_m, DIGITS),
            unknown: unknown.physical.clone(),
        }),
        provenance: (entry.provenance == Provenance::Restricted).then(|| RESTRICTED.to_owned()),
        rate_hz: digits(entry.model.rate().0, CONVERSION_DIGITS),
        mu: entry.model.friction().map(|mu| digits(mu, DIGITS)),
        unknown: unknown.texture.clone(),
        interpolation: interpolation_word(&entry.model).map(str::to_owned),
        tap: entry.model.tap().map(|measured| TapV1 { unknown: unknown.tap.clone(), ..tap::write(measured) }),
        stick_slip: entry.model.stick_slip().map(|of| stick_slip::write(of, &unknown.stick_slip)),
        turn_deg: turn::write(entry.model.turn_rad()),
        anchors: anchors(&entry.model, &unknown.anchors),
        anchors_along: entry.model.along().map(|nodes| anchors_of(nodes, &unknown.along)),
        path: entry.path.as_ref().map(|way| path::write(way, unknown)),
        relief: entry.model.relief().map(|of| relief::write(of, &unknown.relief)),
        height_map: entry.model.height_map().map(|of| height_map::write(of, &unknown.height_map)),
        picture: entry
            .picture
            .as_ref()
            .map(|shown| PictureV1 { unknown: unknown.picture.clone(), ..picture(shown) }),
    }
}

/// Converts a position to the form of a file.
pub(crate) fn place(place: Place) -> SpaceV1 {
    SpaceV1 {
        at: CoordinatesV1::of(place.at, decimals),
        label_source: place.source.id().to_owned(),
        sd: place.deviation.map(|sd| sd.map(decimals)),
        unknown: Map::new(),
    }
}

/// Converts a picture to the form of a file.
pub(crate) fn picture(picture: &Picture) -> PictureV1 {
    PictureV1 {
        media_type: picture.format.media_type().to_owned(),
        width: picture.width,
        height: picture.height,
        millimeters: digits(picture.millimeters, CONVERSION_DIGITS),
        base64: STANDARD.encode(&picture.bytes),
        unknown: Map::new(),
    }
}

/// Models of a texture: its own, and those of the keys of its path.
fn models(entry: &TextureEntry) -> impl Iterator<Item = &TextureModel> {
    let keys = entry.path.iter().flat_map(TexturePath::keys);
    keys.map(|key| &key.model).chain([&entry.model])
}

/// Returns the lowest minor version that has all features of a library, so that older programs can read as much as
/// possible.
fn minor_version(library: &Library) -> u32 {
    let is_high = |model: &TextureModel| model.order() > ORDER_BEFORE;
    if library.textures.iter().any(|entry| models(entry).any(is_high)) {
        return WITH_HIGH_ORDERS;
    }
    let is_plane = |at: SpacePoint| at.n_axes() == USUAL_AXES.len();
    let has_two_axes = |entry: &TextureEntry| {
        let mut keys = entry.path.iter().flat_map(TexturePath::keys);
        entry.at().is_none_or(is_plane) && keys.all(|key| is_plane(key.stop.at))
    };
    if library.axis_names().len() != USUAL_AXES.len() || !library.textures.iter().all(has_two_axes) {
        return WITH_FURTHER_AXES;
    }
    let has_direction = |model: &TextureModel| {
        let has_layer = model.along().is_some() || model.height_map().is_some();
        has_layer || model.stick_slip().is_some() || model.turn_rad() != 0.0
    };
    let has_deviation = |entry: &TextureEntry| entry.place.is_some_and(|place| place.deviation.is_some());
    if library.textures.iter().any(|entry| models(entry).any(has_direction) || has_deviation(entry)) {
        return WITH_DIRECTION;
    }
    let is_estimated = |entry: &TextureEntry| {
        let sources = [entry.place.map(|place| place.source), entry.attributes.as_ref().map(|of| of.source)];
        sources.contains(&Some(LabelSource::Estimated))
    };
    if library.textures.iter().any(is_estimated) {
        return WITH_ESTIMATES;
    }
    let has_relief = |model: &TextureModel| model.relief().is_some();
    if library.textures.iter().any(|entry| models(entry).any(has_relief)) {
        return WITH_RELIEFS;
    }
    if library.textures.iter().any(|entry| entry.path.is_some()) {
        return WITH_PATHS;
    }
    if attributes::axes_for_file(library).is_some() {
        return WITH_AXES;
    }
    if library.space_report.is_some() || library.textures.iter().any(|entry| entry.attributes.is_some()) {
        return WITH_ATTRIBUTES;
    }
    let is_new = |entry: &TextureEntry| {
        entry.provenance != Provenance::Free
            || entry.model.interpolation() != Some(Interpolation::Barycentric)
            || entry.model.tap().is_some()
    };
    u32::from(library.textures.iter().any(is_new))
}
