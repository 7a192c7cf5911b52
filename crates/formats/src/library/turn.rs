//! Rotation of a texture in a library, in degrees counterclockwise.

use crate::library::LibraryError;
use crate::library::numbers::{CONVERSION_DIGITS, digits};

/// Largest rotation in a file, in degrees: one turn.
const MAX_DEGREES: f64 = 360.0;

/// Converts and validates the rotation of the texture with this identifier; returns rad, zero if there is none.
pub(super) fn read(id: &str, turn_deg: Option<f64>) -> Result<f64, LibraryError> {
    let turn_deg = turn_deg.unwrap_or_default();
    // Written so that NaN fails the test.
    if turn_deg.abs() <= MAX_DEGREES {
        Ok(turn_deg.to_radians())
    } else {
        Err(LibraryError::Turn { id: id.to_owned(), turn_deg })
    }
}

/// Converts a rotation in rad to the form of a file; `None` without a rotation.
pub(super) fn write(turn_rad: f64) -> Option<f64> {
    (turn_rad != 0.0).then(|| digits(turn_rad.to_degrees(), CONVERSION_DIGITS))
}
