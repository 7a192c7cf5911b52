//! Conversion of the shape of an authored texture.

use serde_json::{Map, Value};
use shagreen_core::texture::shape::{Shape, ShapeControl, ShapeError};

use crate::project::AuthoredTexture;
use crate::project::v1::ShapeV1;

/// Name of the shape among the fields of an authored texture. Fields of a shape that this version does not know are kept
/// under this name among the unknown fields of the texture.
const FIELD: &str = "shape";

/// Reads a shape, and puts its unknown fields into those of its texture.
pub(super) fn read(wire: Option<ShapeV1>, unknown: &mut Map<String, Value>) -> Result<Shape, ShapeError> {
    let Some(wire) = wire else { return Ok(Shape::default()) };
    if !wire.unknown.is_empty() {
        unknown.insert(FIELD.to_owned(), Value::Object(wire.unknown));
    }
    let neutral = Shape::default();
    let shape = Shape {
        level_db: wire.level_db.unwrap_or(neutral.level_db),
        grain: wire.grain.unwrap_or(neutral.grain),
        brightness_db_per_octave: wire.brightness_db_per_octave.unwrap_or(neutral.brightness_db_per_octave),
        softness: wire.softness.unwrap_or(neutral.softness),
        friction: wire.friction.unwrap_or(neutral.friction),
        relief: wire.relief.unwrap_or(neutral.relief),
        direction_deg: wire.direction_deg.unwrap_or(neutral.direction_deg),
    };
    shape.checked()
}

/// The values of a shape that are not neutral, with its unknown fields, which it takes from those of its texture.
/// `None` if there are none.
pub(super) fn write(shape: &Shape, unknown: &mut Map<String, Value>) -> Option<ShapeV1> {
    let known = |control: ShapeControl| Some(shape.get(control)).filter(|value| *value != control.neutral());
    let unknown = match unknown.remove(FIELD) {
        Some(Value::Object(fields)) => fields,
        _ => Map::new(),
    };
    let is_empty = shape.is_neutral() && unknown.is_empty();
    (!is_empty).then(|| ShapeV1 {
        level_db: known(ShapeControl::Level),
        grain: known(ShapeControl::Grain),
        brightness_db_per_octave: known(ShapeControl::Brightness),
        softness: known(ShapeControl::Softness),
        friction: known(ShapeControl::Friction),
        relief: known(ShapeControl::Relief),
        direction_deg: known(ShapeControl::Direction),
        unknown,
    })
}

/// Whether a texture needs a version with shapes.
pub(super) fn is_needed(texture: &AuthoredTexture) -> bool {
    !texture.shape.is_neutral() || texture.unknown.contains_key(FIELD)
}
