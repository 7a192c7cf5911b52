//! Stick-slip friction in a library.

use serde_json::{Map, Value};
use shagreen_core::texture::stick_slip::StickSlip;
use shagreen_core::units::MetersPerSecond;

use crate::library::LibraryError;
use crate::library::numbers::{CONVERSION_DIGITS, DIGITS, digits};
use crate::library::v1::StickSlipV1;

/// Converts and validates the stick-slip friction of the texture with this identifier.
pub(super) fn read(
    id: &str,
    wire: StickSlipV1,
    unknown: &mut Map<String, Value>,
) -> Result<StickSlip, LibraryError> {
    *unknown = wire.unknown;
    let stribeck_speed = MetersPerSecond::from_mm_per_s(wire.stribeck_mm_per_s);
    let stick_slip = StickSlip { static_ratio: wire.static_ratio, stribeck_speed };
    stick_slip.checked().map_err(|source| LibraryError::StickSlip { id: id.to_owned(), source })
}

/// Converts stick-slip friction to the form of a file.
pub(super) fn write(stick_slip: StickSlip, unknown: &Map<String, Value>) -> StickSlipV1 {
    StickSlipV1 {
        static_ratio: digits(stick_slip.static_ratio, DIGITS),
        stribeck_mm_per_s: digits(stick_slip.stribeck_speed.mm_per_s(), CONVERSION_DIGITS),
        unknown: unknown.clone(),
    }
}
