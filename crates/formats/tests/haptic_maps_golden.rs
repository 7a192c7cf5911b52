//! Scene and description of height and friction maps, compared value by value with files that never change.

#![allow(clippy::unwrap_used, reason = "a test may panic on an unexpected result")]

use serde_json::Value;
use shagreen_core::texture::height_map::HeightMapOptions;
use shagreen_core::texture::stick_slip::StickSlip;
use shagreen_core::units::MetersPerSecond;
use shagreen_formats::haptic_maps::{HeightSource, Maps, MapsV1, check_gltf, map_files};

const SCENE: &[u8] = include_bytes!("golden/cork.gltf");
const DESCRIPTION: &[u8] = include_bytes!("golden/cork.maps.json");

#[test]
fn the_golden_files_are_those_of_their_maps() {
    let heights_m = (0..256).map(|index| 1e-6 * f64::from((3 * (index / 16) + index % 16) % 7) - 3e-6);
    let maps = Maps {
        name: "Cork".to_owned(),
        origin: "A board.".to_owned(),
        license: "CC-BY-4.0".to_owned(),
        heights_m: heights_m.collect(),
        side_m: 0.008,
        source: HeightSource::HeightMap(HeightMapOptions::HARD_PLASTIC),
        friction: Some(0.4),
        stick_slip: Some(StickSlip { static_ratio: 1.3, stribeck_speed: MetersPerSecond(0.02) }),
        stiffness_n_per_m: Some(17_782.8),
    };
    let files = map_files(&maps, "cork", "shagreen 0.1.0").unwrap();
    let value = |bytes: &[u8]| serde_json::from_slice::<Value>(bytes).unwrap();
    assert_eq!(value(&files[0].1), value(SCENE));
    let description = |bytes: &[u8]| serde_json::from_slice::<MapsV1>(bytes).unwrap();
    assert_eq!(description(&files[3].1), description(DESCRIPTION));
    assert_eq!(String::from_utf8_lossy(&files[3].1), String::from_utf8_lossy(DESCRIPTION));
    let checked = check_gltf(SCENE).unwrap();
    assert_eq!((checked.n_faults, checked.n_haptic_materials), (0, 1), "{:?}", checked.faults);
}
