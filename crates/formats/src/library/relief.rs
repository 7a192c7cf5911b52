//! Conversion of reliefs (acceleration profiles over tip position) from and to the library format.

use std::sync::Arc;

use serde_json::{Map, Value};
use shagreen_core::texture::profile::Profile;
use shagreen_core::texture::relief::Relief;
use shagreen_core::units::Newtons;

use crate::library::LibraryError;
use crate::library::numbers::{CONVERSION_DIGITS, DIGITS, digits};
use crate::library::v1::ReliefV1;

/// Converts and validates the relief of the texture with this identifier.
pub(super) fn read(
    id: &str,
    wire: ReliefV1,
    unknown: &mut Map<String, Value>,
) -> Result<Arc<Relief>, LibraryError> {
    *unknown = wire.unknown;
    let failed = |reason: String| LibraryError::Relief { id: id.to_owned(), reason };
    let profile = Profile::new(1e-3 * wire.step_mm, wire.mps2).map_err(|error| failed(error.to_string()))?;
    let relief = Relief::new(profile, Newtons(wire.force_n)).map_err(|error| failed(error.to_string()))?;
    Ok(Arc::new(relief))
}

/// Converts a relief to the form of a file.
pub(super) fn write(relief: &Relief, unknown: &Map<String, Value>) -> ReliefV1 {
    let profile = relief.profile();
    ReliefV1 {
        step_mm: digits(1e3 * profile.step_m(), CONVERSION_DIGITS),
        force_n: digits(relief.force().0, CONVERSION_DIGITS),
        mps2: profile.values().iter().map(|value| digits(*value, DIGITS)).collect(),
        unknown: unknown.clone(),
    }
}
