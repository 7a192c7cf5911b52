//! Conversion of height maps from and to the library format.
//!
//! Heights are integers of 16 bits in steps of the largest height over 32,767: text would take several times the space.

use std::sync::Arc;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Map, Value};
use shagreen_core::texture::height_map::{HeightMap, HeightMapOptions};
use shagreen_core::units::Newtons;

use crate::library::LibraryError;
use crate::library::numbers::{CONVERSION_DIGITS, DIGITS, digits};
use crate::library::v1::HeightMapV1;

/// Number of heights along a side that this program reads; the model has its own limits within it.
const MAX_N: usize = 512;
/// Largest integer of a height.
const MAX_STEPS: f64 = 32_767.0;
/// Valid heights of one integer step, in m. The lowest is a hundredth of an atom, and keeps a flat map from a step of
/// zero.
const LEAST_STEP_M: f64 = 1e-12;
const MOST_STEP_M: f64 = 1e-4;

/// Factor of the heights of a map that rounding would lead beyond its limits. Rounding changes a second difference by at
/// most 2.5 integer steps, which is 0.2 % of the largest one on the smallest tile with the most heights.
const CLEAR_OF_LIMITS: f64 = 0.995;

/// Converts and validates the height map of the texture with this identifier.
pub(super) fn read(
    id: &str,
    wire: HeightMapV1,
    unknown: &mut Map<String, Value>,
) -> Result<Arc<HeightMap>, LibraryError> {
    let height_map =
        decoded(&wire).map_err(|reason| LibraryError::HeightMap { id: id.to_owned(), reason })?;
    *unknown = wire.unknown;
    Ok(Arc::new(height_map))
}

/// Converts a height map to the form of a file, which can always be read: a map at its limits is lowered by half a percent
/// if rounding would exceed them. Reading the result and writing it again gives the same.
pub(super) fn write(height_map: &HeightMap, unknown: &Map<String, Value>) -> HeightMapV1 {
    let wire = encoded(height_map, unknown);
    if decoded(&wire).is_ok() { wire } else { encoded(&height_map.scaled(CLEAR_OF_LIMITS), unknown) }
}

/// Height map of a file, or why it is none.
fn decoded(wire: &HeightMapV1) -> Result<HeightMap, String> {
    if !(LEAST_STEP_M..=MOST_STEP_M).contains(&wire.step_m) {
        return Err(format!(
            "its step_m is {:e} m; it must be from {LEAST_STEP_M:e} to {MOST_STEP_M:e} m",
            wire.step_m
        ));
    }
    if wire.n > MAX_N {
        return Err(format!("its n is {}; it may be at most {MAX_N}", wire.n));
    }
    let bytes = STANDARD.decode(&wire.base64).map_err(|error| format!("its base64 is damaged ({error})"))?;
    let (pairs, _) = bytes.as_chunks::<2>();
    if bytes.len() != 2 * wire.n * wire.n {
        return Err(format!(
            "its base64 holds {} bytes, but {n} by {n} heights have {}",
            bytes.len(),
            2 * wire.n * wire.n,
            n = wire.n
        ));
    }
    let heights_m = pairs.iter().map(|pair| wire.step_m * f64::from(i16::from_le_bytes(*pair))).collect();
    let options = HeightMapOptions {
        force: Newtons(wire.force_n),
        speed_exponent: wire.speed_exponent,
        patch_radius_m: 1e-3 * wire.patch_radius_mm,
    };
    HeightMap::new(heights_m, 1e-3 * wire.side_mm, options).map_err(|error| error.to_string())
}

/// Height map in the form of a file, with rounded heights.
fn encoded(height_map: &HeightMap, unknown: &Map<String, Value>) -> HeightMapV1 {
    let heights_m = height_map.heights_m();
    let highest_m = heights_m.iter().fold(0.0_f64, |highest, height| highest.max(height.abs()));
    let step_m = digits((highest_m / MAX_STEPS).max(LEAST_STEP_M), CONVERSION_DIGITS);
    let steps = |height_m: &f64| (height_m / step_m).round().clamp(-MAX_STEPS, MAX_STEPS) as i16;
    let bytes: Vec<u8> = heights_m.iter().flat_map(|height_m| steps(height_m).to_le_bytes()).collect();
    let options = height_map.options();
    HeightMapV1 {
        side_mm: digits(1e3 * height_map.side_m(), CONVERSION_DIGITS),
        n: height_map.n(),
        force_n: digits(options.force.0, CONVERSION_DIGITS),
        speed_exponent: digits(options.speed_exponent, DIGITS),
        patch_radius_mm: digits(1e3 * options.patch_radius_m, CONVERSION_DIGITS),
        step_m,
        base64: STANDARD.encode(bytes),
        unknown: unknown.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::{HeightMap, HeightMapOptions, Map, read, write};
    use shagreen_core::texture::height_map::HeightMapError;
    use shagreen_core::texture::relief::MAX_MPS2;

    /// Noise on a tile of 1 mm, as steep as a map can be.
    fn at_the_limit(seed: f64) -> HeightMap {
        let noise = |i: i32| (0.618_034 * f64::from(i * i) + seed).fract() - 0.5;
        let made = |factor: f64| {
            let heights_m = (0..128 * 128).map(|i| factor * noise(i)).collect();
            HeightMap::new(heights_m, 1e-3, HeightMapOptions::HARD_PLASTIC)
        };
        let Err(HeightMapError::Steep { mps2, .. }) = made(0.01) else { panic!("the noise is not steep") };
        made(0.01 * (1.0 - 1e-9) * MAX_MPS2 / mps2).unwrap()
    }

    #[test]
    fn a_map_at_its_limits_can_be_read_after_it_was_written() {
        let mut n_lowered = 0;
        for seed in 0..12 {
            let map = at_the_limit(0.083 * f64::from(seed));
            let wire = write(&map, &Map::new());
            let (base64, step_m) = (wire.base64.clone(), wire.step_m);
            let back = read("cork", wire, &mut Map::new()).unwrap();
            let again = write(&back, &Map::new());
            assert_eq!((again.base64, again.step_m), (base64, step_m));
            let highest = |map: &HeightMap| map.heights_m().iter().fold(0.0_f64, |most, h| most.max(h.abs()));
            let kept = highest(&back) / highest(&map);
            assert!((0.994..1.001).contains(&kept), "{kept} of the heights");
            n_lowered += usize::from(kept < 0.999);
        }
        // Without lowering, rounding exceeds the limit in about every second case.
        assert!(n_lowered > 0);
    }
}
