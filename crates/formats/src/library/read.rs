//! Conversion of bytes to a library.

use std::collections::HashSet;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;
use shagreen_core::space::LabelSource;
use shagreen_core::units::Hertz;

use crate::imported::Imported;
use crate::library::anchors::{grain, nodes_along};
use crate::library::v1::{LibraryV1, PictureV1, RESTRICTED, SpaceV1, TextureV1, UNITS, UnitsV1};
use crate::library::{
    FORMAT, Library, LibraryError, PhysicalLabels, Place, Provenance, TextureEntry, USUAL_AXES, Unknown,
    UnknownOfLibrary, VERSION_MAJOR, VERSION_MINOR,
};
use crate::library::{attributes, height_map, path, relief, stick_slip, tap, turn};
use crate::own_json::{Header, HeaderFault, minor_version};
use crate::parser_words::plain;
use crate::picture::{self, MAX_SIDE, Picture, PictureFormat};
use crate::text_limits::{self, MAX_ID, MAX_NAME, MAX_NOTES, TooLong};

/// Reads a library.
///
/// Pictures are decoded only for display, by [`picture::decode`]. A picture with a damaged header is kept, with a
/// warning.
///
/// # Errors
/// See [`LibraryError`]; every number is checked.
pub fn read_library(bytes: &[u8]) -> Result<Imported<Library>, LibraryError> {
    let minor = minor_version(bytes, FORMAT, VERSION_MAJOR).map_err(|fault| match fault {
        // The full parser's message is more specific than the header's: it names the texture.
        HeaderFault::Damaged(reason) => damaged(reason, bytes),
        fault => fault.into(),
    })?;
    let wire: LibraryV1 =
        serde_json::from_slice(bytes).map_err(|error| damaged(plain(&error.to_string()), bytes))?;
    checked(wire, minor)
}

/// Converts a library that is part of another file.
///
/// # Errors
/// Those of [`read_library`].
pub(crate) fn library_inside(wire: LibraryV1) -> Result<Imported<Library>, LibraryError> {
    let minor = Header::of(&wire.format, &wire.version).minor_version(FORMAT, VERSION_MAJOR)?;
    checked(wire, minor)
}

fn checked(wire: LibraryV1, minor: u32) -> Result<Imported<Library>, LibraryError> {
    let mut warnings = Vec::new();
    if minor > VERSION_MINOR {
        warnings.push(format!(
            "the library has version {VERSION_MAJOR}.{minor}, newer than {VERSION_MAJOR}.{VERSION_MINOR}; fields that this program does not know are kept but have no effect"
        ));
    }
    check_units(&wire.units)?;
    text_limits::check("the name of the library", &wire.name, MAX_NAME)?;
    for text in [&wire.description, &wire.origin, &wire.licence] {
        text_limits::check("a text of the library", text, MAX_NOTES)?;
    }
    let mut ids = HashSet::new();
    for (index, texture) in wire.textures.iter().enumerate() {
        let id = &texture.id;
        if id.is_empty() || id.contains(|c: char| c.is_whitespace() || c.is_control()) {
            return Err(LibraryError::Id { number: index + 1, id: id.clone() });
        }
        if !ids.insert(id.clone()) {
            return Err(LibraryError::Duplicate { id: id.clone() });
        }
    }
    if wire.textures.is_empty() {
        warnings.push("the library has no textures".to_owned());
    }
    let textures: Vec<TextureEntry> = wire.textures.into_iter().map(texture).collect::<Result<_, _>>()?;
    for TextureEntry { id, picture, .. } in &textures {
        if let Some(Err(error)) = picture.as_ref().map(picture::check) {
            warnings.push(format!("the picture of texture \"{id}\" cannot be shown: {error}"));
        }
    }
    let space_report = attributes::report(wire.space_report)?;
    let axes = attributes::axes_in_file(attributes::axes(wire.axes)?, space_report.as_ref());
    let n_axes = axes.as_ref().map_or(USUAL_AXES.len(), Vec::len);
    for TextureEntry { id, place, .. } in &textures {
        if let Some(place) = place {
            check_count(id, place, n_axes)?;
        }
    }
    let library = Library {
        name: wire.name,
        description: wire.description,
        origin: wire.origin,
        license: wire.licence,
        created_by: wire.created_by,
        seed: wire.seed,
        axes,
        space_report,
        textures,
        unknown: UnknownOfLibrary { library: wire.unknown, units: wire.units.unknown },
    };
    Ok(Imported { value: library, warnings })
}

/// Returns the parser's error, with the texture that contains it if the file is intact enough to tell.
fn damaged(reason: String, bytes: &[u8]) -> LibraryError {
    let texture = serde_json::from_slice::<Value>(bytes).ok().and_then(|value| {
        // If the file is not JSON, the parser's line and column locate the error.
        let textures = value.get("textures")?.as_array()?;
        let bad = textures.iter().find(|t| serde_json::from_value::<TextureV1>((*t).clone()).is_err())?;
        Some(bad.get("id")?.as_str()?.to_owned())
    });
    LibraryError::Damaged { reason, texture }
}

fn check_texts(texture: &TextureV1) -> Result<(), TooLong> {
    text_limits::check("the identifier of a texture", &texture.id, MAX_ID)?;
    text_limits::check("the name of a texture", &texture.name, MAX_NAME)?;
    for tag in &texture.tags {
        text_limits::check("a tag of a texture", tag, MAX_NAME)?;
    }
    for text in [&texture.description, &texture.origin, &texture.licence] {
        text_limits::check("a text of a texture", text, MAX_NOTES)?;
    }
    Ok(())
}

fn check_units(units: &UnitsV1) -> Result<(), LibraryError> {
    let found = [&units.speed, &units.force, &units.acceleration, &units.rate, &units.lsf, &units.length];
    for (found, (quantity, expected)) in found.into_iter().zip(UNITS) {
        if found != expected {
            return Err(LibraryError::Unit { quantity, found: found.clone(), expected });
        }
    }
    Ok(())
}

pub(crate) fn texture(wire: TextureV1) -> Result<TextureEntry, LibraryError> {
    check_texts(&wire)?;
    let id = wire.id;
    let mut unknown = Unknown { texture: wire.unknown, ..Unknown::default() };
    let place = wire.space.map(|space| place(&id, space, &mut unknown)).transpose()?;
    let attributes = wire.attributes.map(|wire| attributes::read(&id, wire, &mut unknown)).transpose()?;
    let picture = wire.picture.map(|wire| picture(&id, wire, &mut unknown)).transpose()?;
    let physical = wire.physical.map(|wire| {
        unknown.physical = wire.unknown;
        PhysicalLabels {
            roughness_log10_mps2: wire.roughness_log10_mps2,
            hardness_log10_n_per_m: wire.hardness_log10_n_per_m,
        }
    });
    let provenance = wire.provenance.map(|word| provenance(&id, word)).transpose()?.unwrap_or_default();
    let tap = wire.tap.map(|wire| tap::read(&id, wire, &mut unknown.tap)).transpose()?;
    let relief = wire.relief.map(|wire| relief::read(&id, wire, &mut unknown.relief)).transpose()?;
    let height_map =
        wire.height_map.map(|wire| height_map::read(&id, wire, &mut unknown.height_map)).transpose()?;
    let stick_slip =
        wire.stick_slip.map(|wire| stick_slip::read(&id, wire, &mut unknown.stick_slip)).transpose()?;
    let turn_rad = turn::read(&id, wire.turn_deg)?;
    let along = wire.anchors_along.map(|along| nodes_along(&id, along, &mut unknown.along)).transpose()?;
    let rate = Hertz(wire.rate_hz);
    let path = wire.path.map(|wire| path::read(&id, wire, rate, &mut unknown)).transpose()?;
    let model = grain(&id, wire.interpolation.as_deref(), wire.anchors, &mut unknown.anchors)?
        .model(rate, wire.mu)
        .and_then(|model| model.with_along(along))
        .map_err(|source| LibraryError::of_model(&id, source))?
        .with_tap(tap)
        .with_relief(relief)
        .with_height_map(height_map)
        .with_stick_slip(stick_slip)
        .with_turn_rad(turn_rad);
    Ok(TextureEntry {
        id,
        name: wire.name,
        tags: wire.tags,
        license: wire.licence,
        origin: wire.origin,
        provenance,
        description: wire.description,
        place,
        attributes,
        physical,
        model,
        path,
        picture,
        unknown,
    })
}

fn provenance(id: &str, word: String) -> Result<Provenance, LibraryError> {
    match word.as_str() {
        RESTRICTED => Ok(Provenance::Restricted),
        _ => Err(LibraryError::Word {
            id: id.to_owned(),
            field: "provenance",
            found: word,
            expected: "restricted or absent",
        }),
    }
}

/// Checks that the position of the texture with this identifier has as many coordinates as its space has axes.
pub(crate) fn check_count(id: &str, place: &Place, n_axes: usize) -> Result<(), LibraryError> {
    match place.at.n_axes() {
        n if n == n_axes => Ok(()),
        n => Err(LibraryError::AxisCount { id: id.to_owned(), n, n_axes }),
    }
}

pub(crate) fn place(id: &str, wire: SpaceV1, unknown: &mut Unknown) -> Result<Place, LibraryError> {
    unknown.space = wire.unknown;
    let at = wire.at.point().map_err(|source| LibraryError::Place { id: id.to_owned(), source })?;
    let source = LabelSource::from_id(&wire.label_source)
        .ok_or_else(|| LibraryError::LabelSource { id: id.to_owned(), found: wire.label_source })?;
    if wire.sd.is_some_and(|sd| sd.iter().any(|sd| !(0.0..=100.0).contains(sd))) {
        return Err(LibraryError::Deviation { id: id.to_owned() });
    }
    Ok(Place { deviation: wire.sd, ..Place::new(at, source) })
}

pub(crate) fn picture(id: &str, wire: PictureV1, unknown: &mut Unknown) -> Result<Picture, LibraryError> {
    let failed = |reason: String| LibraryError::Picture { id: id.to_owned(), reason };
    let format = PictureFormat::from_media_type(&wire.media_type).ok_or_else(|| {
        failed(format!("its media type is {}, not image/jpeg or image/png", wire.media_type))
    })?;
    let fits = |side: u32| (1..=MAX_SIDE).contains(&side);
    if !(fits(wire.width) && fits(wire.height)) {
        return Err(failed(format!(
            "its size is {} x {} pixels, but each side must be 1 to {MAX_SIDE}",
            wire.width, wire.height
        )));
    }
    if wire.millimeters <= 0.0 {
        return Err(failed(format!("its width is {} mm, but must be greater than zero", wire.millimeters)));
    }
    let bytes =
        STANDARD.decode(&wire.base64).map_err(|error| failed(format!("its base64 is damaged ({error})")))?;
    unknown.picture = wire.unknown;
    Ok(Picture { width: wire.width, height: wire.height, millimeters: wire.millimeters, format, bytes })
}
