//! Conversion of texture paths from and to the library format.

use shagreen_core::space::SpacePoint;
use shagreen_core::space::texture_path::{Along, AtEnd, Key, Stop, TexturePath};
use shagreen_core::units::Hertz;

use crate::library::anchors::{anchors, grain};
use crate::library::numbers::{CONVERSION_DIGITS, DIGITS, decimals, digits};
use crate::library::v1::{KeyV1, PathV1, TapV1};
use crate::library::{LibraryError, Unknown, UnknownOfKey};
use crate::library::{relief, tap};

/// Maximum number of textures along a path; the program writes up to 48.
const MAX_KEYS: usize = 512;

/// Converts and validates the path of a texture.
pub(super) fn read(
    id: &str,
    wire: PathV1,
    rate: Hertz,
    unknown: &mut Unknown,
) -> Result<TexturePath, LibraryError> {
    let word = |field, found: &str, expected| LibraryError::Word {
        id: id.to_owned(),
        field,
        found: found.to_owned(),
        expected,
    };
    let along =
        Along::from_id(&wire.along).ok_or_else(|| word("path.along", &wire.along, "distance or time"))?;
    let at_end = AtEnd::from_id(&wire.at_end)
        .ok_or_else(|| word("path.at_end", &wire.at_end, "hold, turn or repeat"))?;
    if wire.keys.len() > MAX_KEYS {
        return Err(LibraryError::PathKeys { id: id.to_owned(), n: wire.keys.len(), most: MAX_KEYS });
    }
    unknown.path = wire.unknown;
    let key = |(index, wire): (usize, KeyV1)| {
        let id = &format!("{id}, key {} of its path", index + 1);
        let mut left = UnknownOfKey { key: wire.unknown, ..UnknownOfKey::default() };
        let at = SpacePoint::new(wire.rough_smooth, wire.hard_soft)
            .map_err(|source| LibraryError::Place { id: id.to_owned(), source })?;
        let tap = wire.tap.map(|wire| tap::read(id, wire, &mut left.tap)).transpose()?;
        let relief = wire.relief.map(|wire| relief::read(id, wire, &mut left.relief)).transpose()?;
        let model = grain(id, None, wire.anchors, &mut left.anchors)?
            .model(rate, wire.mu)
            .map_err(|source| LibraryError::Model { id: id.to_owned(), source })?
            .with_tap(tap)
            .with_relief(relief);
        unknown.keys.push(left);
        Ok(Key { stop: Stop { at, along: along.unit().0 * wire.along }, is_stop: wire.stop, model })
    };
    let keys = wire.keys.into_iter().enumerate().map(key).collect::<Result<_, LibraryError>>()?;
    if unknown.keys.iter().all(|left| *left == UnknownOfKey::default()) {
        unknown.keys.clear();
    }
    TexturePath::new(along, at_end, keys).map_err(|source| LibraryError::Path { id: id.to_owned(), source })
}

/// Converts a path to the form of a file.
pub(super) fn write(path: &TexturePath, unknown: &Unknown) -> PathV1 {
    // If keys were added or removed, the unknown fields cannot be assigned to keys and are dropped.
    let left_at = |index: usize| match unknown.keys.get(index) {
        Some(left) if unknown.keys.len() == path.keys().len() => left.clone(),
        _ => UnknownOfKey::default(),
    };
    let key = |(index, key): (usize, &Key)| {
        let UnknownOfKey { key: unknown, tap, relief: of_relief, anchors: of_anchors } = left_at(index);
        KeyV1 {
            unknown,
            along: digits(key.stop.along / path.along().unit().0, CONVERSION_DIGITS),
            rough_smooth: decimals(key.stop.at.rough_smooth),
            hard_soft: decimals(key.stop.at.hard_soft),
            stop: key.is_stop,
            mu: key.model.friction().map(|mu| digits(mu, DIGITS)),
            tap: key.model.tap().map(|of| TapV1 { unknown: tap, ..tap::write(of) }),
            anchors: anchors(&key.model, &of_anchors),
            relief: key.model.relief().map(|of| relief::write(of, &of_relief)),
        }
    };
    PathV1 {
        along: path.along().id().to_owned(),
        at_end: path.at_end().id().to_owned(),
        unknown: unknown.path.clone(),
        keys: path.keys().iter().enumerate().map(key).collect(),
    }
}
