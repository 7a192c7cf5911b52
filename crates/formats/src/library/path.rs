//! Conversion of texture paths from and to the library format.

use shagreen_core::space::texture_path::{Along, AtEnd, Key, MAX_KEYS, Stop, TexturePath};
use shagreen_core::units::Hertz;

use crate::library::anchors::{anchors, anchors_of, grain, nodes_along};
use crate::library::coordinates::CoordinatesV1;
use crate::library::numbers::{CONVERSION_DIGITS, DIGITS, decimals, digits};
use crate::library::v1::{KeyV1, PathV1, TapV1};
use crate::library::{LibraryError, Unknown, UnknownOfKey};
use crate::library::{height_map, relief, stick_slip, tap, turn};

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
    // Before anything is decoded: a height map can take 2 MB, and eight times as much when it is played.
    if wire.keys.len() > MAX_KEYS {
        return Err(LibraryError::PathKeys { id: id.to_owned(), n: wire.keys.len(), most: MAX_KEYS });
    }
    unknown.path = wire.unknown;
    let key = |(index, wire): (usize, KeyV1)| {
        let id = &format!("{id}, key {} of its path", index + 1);
        let mut left = UnknownOfKey { key: wire.unknown, ..UnknownOfKey::default() };
        let at = wire.at.point().map_err(|source| LibraryError::Place { id: id.to_owned(), source })?;
        let tap = wire.tap.map(|wire| tap::read(id, wire, &mut left.tap)).transpose()?;
        let relief = wire.relief.map(|wire| relief::read(id, wire, &mut left.relief)).transpose()?;
        let height_map =
            wire.height_map.map(|wire| height_map::read(id, wire, &mut left.height_map)).transpose()?;
        let stick_slip =
            wire.stick_slip.map(|wire| stick_slip::read(id, wire, &mut left.stick_slip)).transpose()?;
        let turn_rad = turn::read(id, wire.turn_deg)?;
        let nodes = wire.anchors_along.map(|nodes| nodes_along(id, nodes, &mut left.along)).transpose()?;
        let model = grain(id, None, wire.anchors, &mut left.anchors)?
            .model(rate, wire.mu)
            .and_then(|model| model.with_along(nodes))
            .map_err(|source| LibraryError::of_model(id, source))?
            .with_tap(tap)
            .with_relief(relief)
            .with_height_map(height_map)
            .with_stick_slip(stick_slip)
            .with_turn_rad(turn_rad);
        unknown.keys.push(left);
        Ok(Key { stop: Stop { at, along: along.unit().0 * wire.along }, is_stop: wire.stop, model })
    };
    let keys: Vec<Key> = wire.keys.into_iter().enumerate().map(key).collect::<Result<_, LibraryError>>()?;
    check_counts(id, &keys)?;
    if unknown.keys.iter().all(|left| *left == UnknownOfKey::default()) {
        unknown.keys.clear();
    }
    TexturePath::new(along, at_end, keys).map_err(|source| LibraryError::Path { id: id.to_owned(), source })
}

/// Checks that all keys of a path lie on the same number of axes. They may be others than those of the library: a path that was
/// authored on further axes keeps its points.
fn check_counts(id: &str, keys: &[Key]) -> Result<(), LibraryError> {
    let Some(first) = keys.first() else { return Ok(()) };
    let n_axes = first.stop.at.n_axes();
    match keys.iter().position(|key| key.stop.at.n_axes() != n_axes) {
        None => Ok(()),
        Some(index) => Err(LibraryError::KeyCount {
            id: id.to_owned(),
            number: index + 1,
            n: keys[index].stop.at.n_axes(),
            expected: n_axes,
        }),
    }
}

/// Converts a path to the form of a file.
pub(super) fn write(path: &TexturePath, unknown: &Unknown) -> PathV1 {
    // If keys were added or removed, the unknown fields cannot be assigned to keys and are dropped.
    let left_at = |index: usize| match unknown.keys.get(index) {
        Some(left) if unknown.keys.len() == path.keys().len() => left.clone(),
        _ => UnknownOfKey::default(),
    };
    let key = |(index, key): (usize, &Key)| {
        let left = left_at(index);
        KeyV1 {
            unknown: left.key,
            along: digits(key.stop.along / path.along().unit().0, CONVERSION_DIGITS),
            at: CoordinatesV1::of(key.stop.at, decimals),
            stop: key.is_stop,
            mu: key.model.friction().map(|mu| digits(mu, DIGITS)),
            tap: key.model.tap().map(|of| TapV1 { unknown: left.tap, ..tap::write(of) }),
            stick_slip: key.model.stick_slip().map(|of| stick_slip::write(of, &left.stick_slip)),
            turn_deg: turn::write(key.model.turn_rad()),
            anchors: anchors(&key.model, &left.anchors),
            anchors_along: key.model.along().map(|nodes| anchors_of(nodes, &left.along)),
            relief: key.model.relief().map(|of| relief::write(of, &left.relief)),
            height_map: key.model.height_map().map(|of| height_map::write(of, &left.height_map)),
        }
    };
    PathV1 {
        along: path.along().id().to_owned(),
        at_end: path.at_end().id().to_owned(),
        unknown: unknown.path.clone(),
        keys: path.keys().iter().enumerate().map(key).collect(),
    }
}
