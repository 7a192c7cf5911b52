use proptest::collection::vec;
use proptest::prelude::{Just, Strategy, any, prop_assert, prop_oneof, proptest};
use proptest::sample::select;
use serde_json::{Value, json};
use shagreen_core::texture::height_map::HeightMapOptions;
use shagreen_core::texture::stick_slip::StickSlip;
use shagreen_core::units::MetersPerSecond;

use super::{CheckedGltf, GltfError, HeightSource, Maps, MapsV1, check_gltf, lost_in_maps, map_files};
use crate::picture::brightness_row;
use crate::starter::starter_library;

const N: usize = 16;

/// Heights from -3 to 3 µm, different in each row.
fn maps() -> Maps {
    let height_m = |index: usize| 1e-6 * ((3 * (index / N) + index % N) % 7) as f64 - 3e-6;
    Maps {
        name: "Cork".to_owned(),
        origin: "A board.".to_owned(),
        license: "CC-BY-4.0".to_owned(),
        heights_m: (0..N * N).map(height_m).collect(),
        side_m: 0.008,
        source: HeightSource::HeightMap(HeightMapOptions::HARD_PLASTIC),
        friction: Some(0.4),
        stick_slip: Some(StickSlip { static_ratio: 1.3, stribeck_speed: MetersPerSecond(0.02) }),
        stiffness_n_per_m: Some(17_782.8),
    }
}

/// The bytes of the file with this suffix.
fn file(maps: &Maps, suffix: &str) -> Vec<u8> {
    let files = map_files(maps, "my cork", "shagreen test").unwrap();
    files.into_iter().find(|(other, _)| *other == suffix).unwrap().1
}

fn scene() -> Value {
    serde_json::from_slice(&file(&maps(), "")).unwrap()
}

fn checked(scene: &Value) -> CheckedGltf {
    check_gltf(scene.to_string().as_bytes()).unwrap()
}

/// The description says how heights come back from the picture.
#[test]
fn heights_come_back_within_half_a_level() {
    let maps = maps();
    let described: MapsV1 = serde_json::from_slice(&file(&maps, ".maps.json")).unwrap();
    let height = &described.height;
    assert_eq!((height.pixels, height.side_mm, height.mm_per_pixel, height.tiles), (N, 8.0, 0.5, true));
    assert_eq!((height.black_um, height.white_um), (-3.0, 3.0));
    assert_eq!((height.force_n, height.patch_radius_mm), (Some(1.0), Some(0.1)));
    let picture = file(&maps, ".height.png");
    for (row, expected) in maps.heights_m.chunks(N).enumerate() {
        let levels = brightness_row(&picture, Some(row as u32)).unwrap();
        for (level, height_m) in levels.iter().zip(expected) {
            let um = height.black_um + level * (height.white_um - height.black_um);
            assert!((um - 1e6 * height_m).abs() <= 0.51 * 6.0 / 65_535.0, "{um} for {height_m} in row {row}");
        }
    }
    let simulated = Maps { source: HeightSource::Simulated, ..maps };
    let described: MapsV1 = serde_json::from_slice(&file(&simulated, ".maps.json")).unwrap();
    assert_eq!((described.height.source.as_str(), described.height.force_n), ("simulated", None));
}

#[test]
fn friction_comes_back_and_is_a_coefficient_in_itself() {
    for (friction, white) in [(0.4, 1.0), (1.0, 1.0), (1.39, 2.0), (0.0, 1.0)] {
        let maps = Maps { friction: Some(friction), ..maps() };
        let described: MapsV1 = serde_json::from_slice(&file(&maps, ".maps.json")).unwrap();
        let map = described.friction.unwrap();
        assert_eq!((map.black, map.white, map.coefficient), (0.0, white, friction));
        assert_eq!((map.static_ratio, map.stribeck_mm_per_s), (Some(1.3), Some(20.0)));
        let levels = brightness_row(&file(&maps, ".friction.png"), None).unwrap();
        assert_eq!(levels.len(), map.pixels);
        assert!(levels.iter().all(|level| (level * white - friction).abs() < white / 65_535.0), "{levels:?}");
    }
    let unknown = Maps { friction: None, stiffness_n_per_m: None, ..maps() };
    let files = map_files(&unknown, "a", "shagreen test").unwrap();
    let suffixes: Vec<&str> = files.iter().map(|(suffix, _)| *suffix).collect();
    assert_eq!(suffixes, ["", ".bin", ".height.png", ".maps.json"]);
    let scene = check_gltf(&files[0].1).unwrap();
    assert_eq!((scene.n_faults, scene.n_haptic_materials, scene.files.len()), (0, 1, 2));
}

/// The square has a side of 1; the upper left of the pictures lies at (0, 1).
#[test]
fn the_square_shows_the_pictures_upright() {
    let bin = file(&maps(), ".bin");
    let floats: Vec<f32> =
        bin[..128].as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
    let (corners, coordinates) = (&floats[..12], &floats[24..32]);
    for (corner, coordinate) in corners.chunks(3).zip(coordinates.chunks(2)) {
        assert_eq!(coordinate, [corner[0], 1.0 - corner[1]]);
        assert_eq!(corner[2], 0.0);
    }
    assert!(floats[12..24].chunks(3).all(|normal| normal == [0.0, 0.0, 1.0]));
    let indices: Vec<u16> =
        bin[128..].as_chunks::<2>().0.iter().map(|bytes| u16::from_le_bytes(*bytes)).collect();
    assert_eq!(indices, [0, 1, 2, 0, 2, 3]);
    let scene = scene();
    assert_eq!(scene["nodes"][0]["scale"], json!([0.008, 0.008, 1.0]), "the node scales it to meters");
}

#[test]
fn the_scene_refers_to_its_files_and_has_no_fault() {
    let scene = checked(&scene());
    assert_eq!((scene.faults.as_slice(), scene.n_faults, scene.n_haptic_materials), (&[][..], 0, 1));
    let names: Vec<(&str, u64)> = scene.files.iter().map(|file| (&*file.name, file.least_bytes)).collect();
    assert_eq!(names, [("my cork.bin", 140), ("my cork.height.png", 0), ("my cork.friction.png", 0)]);
    let text = String::from_utf8(file(&maps(), "")).unwrap();
    assert!(text.contains("my%20cork.bin") && text.contains("does not define it"), "{text}");
}

#[test]
fn what_maps_cannot_hold_is_said() {
    let library = starter_library().unwrap();
    let lost = |id: &str| lost_in_maps(&library.textures[library.index_of(id).unwrap()]).join("; ");
    let rubber = lost("bumpy-rubber");
    for part in ["grain", "tap", "picture", "position", "label of roughness"] {
        assert!(rubber.contains(part), "{part}: {rubber}");
    }
    assert!(!rubber.contains("across the lay") && !rubber.contains("stick-slip"), "{rubber}");
}

/// Negative tests: each broken field of a valid scene is found at its place.
#[test]
fn every_fault_is_found_at_its_place() {
    for (pointer, value, place, reason) in [
        ("/asset/version", json!("1.0"), "asset.version", "2.0"),
        ("/extensionsUsed", json!([]), "extensionsUsed", "not listed"),
        ("/scene", json!(1), "scene", "1 is no index of scenes, which has 1 entries"),
        ("/scenes/0/nodes/0", json!(3), "scenes[0].nodes[0]", "nodes"),
        ("/nodes/0/mesh", json!(-1), "nodes[0].mesh", "-1 is no index"),
        ("/nodes/0/children", json!([9]), "nodes[0].children[0]", "nodes"),
        ("/meshes/0/primitives", json!([]), "meshes[0]", "needs a primitive"),
        ("/meshes/0/primitives/0/attributes/NORMAL", json!(4), "attributes.NORMAL", "accessors"),
        ("/meshes/0/primitives/0/indices", json!("3"), "primitives[0].indices", "accessors"),
        ("/meshes/0/primitives/0/material", json!(1), "primitives[0].material", "materials"),
        (
            "/meshes/0/extensions/MPEG_haptic_material/hapticMaterialIndex",
            json!(1),
            "meshes[0].extensions.MPEG_haptic_material.hapticMaterialIndex",
            "the haptic materials",
        ),
        (
            "/extensions/MPEG_haptic_material/materials/0/friction/0/type",
            json!("Sharp"),
            "MPEG_haptic_material.materials[0].friction[0].type",
            "Low_Resolution",
        ),
        (
            "/extensions/MPEG_haptic_material/materials/0/friction/0/type",
            json!("Reference"),
            "MPEG_haptic_material.materials[0].friction[0]",
            "needs the index `haptic`",
        ),
        (
            "/extensions/MPEG_haptic_material/materials/0/vibrotactileTexture/0/texture",
            json!({}),
            "MPEG_haptic_material.materials[0].vibrotactileTexture[0].texture.index",
            "null is no index of textures",
        ),
        ("/textures/1/source", json!(2), "textures[1].source", "images"),
        ("/textures/1/sampler", json!(1), "textures[1].sampler", "samplers"),
        ("/images/0/bufferView", json!(0), "images[0]", "either"),
        ("/images/0/uri", json!("%"), "images[0].uri", "hexadecimal"),
        ("/bufferViews/0/buffer", json!(1), "bufferViews[0].buffer", "buffers"),
        ("/bufferViews/3/byteLength", json!(13), "bufferViews[3]", "beyond its buffer of 140 bytes"),
        ("/accessors/0/count", json!(5), "accessors[0]", "beyond its buffer view"),
        ("/accessors/0/type", json!("VEC5"), "accessors[0]", "unknown"),
        ("/accessors/0/componentType", json!(1), "accessors[0]", "unknown"),
        ("/accessors/0/bufferView", json!(4), "accessors[0].bufferView", "bufferViews"),
    ] {
        let mut scene = scene();
        let (parent, field) = pointer.rsplit_once('/').unwrap();
        let parent = scene.pointer_mut(parent).unwrap();
        match field.parse::<usize>() {
            Ok(index) => parent[index] = value,
            Err(_) => parent[field] = value,
        }
        let CheckedGltf { faults, n_faults, .. } = checked(&scene);
        assert_eq!(n_faults, 1, "{pointer}: {faults:?}");
        assert!(
            faults[0].place.ends_with(place) && faults[0].reason.contains(reason),
            "{pointer}: {}",
            faults[0]
        );
    }
    let mut scene = scene();
    scene["extensions"]["MPEG_haptic_material"]["materials"] = json!([]);
    let faults: Vec<String> = checked(&scene).faults.iter().map(ToString::to_string).collect();
    assert!(faults.len() == 2 && faults[0].contains("needs a haptic material"), "{faults:?}");
    for (bytes, reason) in [
        (&b""[..], "the file is empty"),
        (b"glTF\x02\0\0\0", "this is not a glTF scene"),
        (b"{\"asset\"", "it ends too early"),
    ] {
        let error = check_gltf(bytes).unwrap_err();
        assert!(error.to_string().contains(reason), "{error}");
        assert_eq!(matches!(error, GltfError::Damaged { .. }), bytes.starts_with(b"{"));
    }
}

fn json_of_any_shape() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<i64>().prop_map(Value::from),
        any::<f64>().prop_map(Value::from),
        select(vec!["VEC3", "2.0", "%41", "Reference"]).prop_map(Value::from),
    ];
    leaf.prop_recursive(4, 40, 5, |inner| {
        let names = select(vec![
            "buffer",
            "byteOffset",
            "byteLength",
            "count",
            "componentType",
            "type",
            "uri",
            "mesh",
        ]);
        prop_oneof![
            vec(inner.clone(), 0..5).prop_map(Value::from),
            vec((names, inner), 0..5).prop_map(|fields| {
                Value::Object(fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
            }),
        ]
    })
}

proptest! {
    /// Any JSON in the place of a part of a scene is checked without a panic.
    #[test]
    fn any_json_is_checked(any in json_of_any_shape(), pointer in select(vec![
        "", "/asset", "/extensions", "/extensions/MPEG_haptic_material", "/extensions/MPEG_haptic_material/materials",
        "/extensions/MPEG_haptic_material/materials/0/friction", "/meshes", "/meshes/0/primitives/0/attributes",
        "/accessors", "/accessors/0", "/bufferViews", "/bufferViews/0", "/buffers", "/images/0", "/textures",
    ])) {
        let mut scene = scene();
        *scene.pointer_mut(pointer).unwrap() = any;
        if let Ok(checked) = check_gltf(scene.to_string().as_bytes()) {
            prop_assert!(checked.faults.len() <= checked.n_faults);
        }
    }

    /// Heights of any range come back within half a level of the picture.
    #[test]
    fn any_heights_come_back(um in vec(-1e4_f64..1e4, N * N)) {
        let maps = Maps { heights_m: um.iter().map(|um| 1e-6 * um).collect(), ..maps() };
        let described: MapsV1 = serde_json::from_slice(&file(&maps, ".maps.json")).unwrap();
        let levels = brightness_row(&file(&maps, ".height.png"), Some(3)).unwrap();
        let (black_um, white_um) = (described.height.black_um, described.height.white_um);
        for (level, um) in levels.iter().zip(&um[3 * N..4 * N]) {
            let got_um = black_um + level * (white_um - black_um);
            // Half a level, and the rounding of the range to six digits.
            prop_assert!((got_um - um).abs() <= 0.51 * (white_um - black_um) / 65_535.0 + 0.02, "{got_um} for {um}");
        }
    }
}
