//! Tap transients in a library.

use serde_json::{Map, Value};
use shagreen_core::texture::tap::Tap;
use shagreen_core::units::Hertz;

use crate::library::LibraryError;
use crate::library::numbers::{DIGITS, digits};
use crate::library::v1::TapV1;

pub(super) fn read(id: &str, wire: TapV1, unknown: &mut Map<String, Value>) -> Result<Tap, LibraryError> {
    *unknown = wire.unknown;
    let tap = Tap {
        frequency: Hertz(wire.frequency_hz),
        decay_per_sec: wire.decay_per_s,
        amplitude_mps2: wire.amplitude_mps2,
    };
    tap.checked().map_err(|source| LibraryError::Tap { id: id.to_owned(), source })
}

pub(super) fn write(tap: Tap) -> TapV1 {
    TapV1 {
        frequency_hz: digits(tap.frequency.0, DIGITS),
        decay_per_s: digits(tap.decay_per_sec, DIGITS),
        amplitude_mps2: digits(tap.amplitude_mps2, DIGITS),
        unknown: Map::new(),
    }
}
