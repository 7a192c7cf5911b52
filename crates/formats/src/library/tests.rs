mod further_axes;

use super::{
    Library, LibraryError, PhysicalLabels, Place, TextureEntry, VERSION_MAJOR, VERSION_MINOR, read_library,
    write_library,
};
use crate::picture::{Rgb, encode_jpeg};
use proptest::prelude::{any, prop, proptest};
use serde_json::{Value, json};
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::texture::{GrainNode, TextureModel};
use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};

fn small() -> Library {
    let node = |mm_per_s: f64| GrainNode {
        speed: MetersPerSecond::from_mm_per_s(mm_per_s),
        force: Newtons(0.15),
        lsf: vec![0.5, 1.25, 3.0],
        level_mps2: 0.0625,
    };
    let model = TextureModel::new(Hertz(1000.0), vec![node(30.0), node(70.0)], Some(0.3)).unwrap();
    let cork = TextureEntry {
        tags: vec!["soft".into()],
        place: Some(Place::new(SpacePoint::new(30.25, 70.0).unwrap(), LabelSource::PhysicalLabels)),
        physical: Some(PhysicalLabels { roughness_log10_mps2: -0.5, hardness_log10_n_per_m: 4.25 }),
        picture: Some(encode_jpeg(&Rgb { width: 2, height: 1, pixels: vec![9; 6] }, 20.0).unwrap()),
        ..TextureEntry::new("cork", "Cork", model.clone())
    };
    let bare = TextureEntry::new("bare", "Bare", model);
    Library {
        name: "Small".into(),
        license: "CC0-1.0".into(),
        seed: Some(7),
        textures: vec![cork, bare],
        ..Library::default()
    }
}

fn wire() -> Value {
    serde_json::from_slice(&write_library(&small())).unwrap()
}

/// Reads the small library after a change to its JSON.
fn read_changed(change: impl FnOnce(&mut Value)) -> Result<Library, LibraryError> {
    let mut value = wire();
    change(&mut value);
    read_library(&serde_json::to_vec(&value).unwrap()).map(|imported| imported.value)
}

#[track_caller]
fn check_error(change: impl FnOnce(&mut Value), expected: &[&str]) {
    let message = read_changed(change).unwrap_err().to_string();
    for part in expected {
        assert!(message.contains(part), "{part:?} is not in {message:?}");
    }
}

#[test]
fn round_trip_is_exact_and_deterministic() {
    let bytes = write_library(&small());
    let imported = read_library(&bytes).unwrap();
    assert!(imported.warnings.is_empty());
    assert_eq!(imported.value, small());
    assert_eq!(write_library(&imported.value), bytes);
}

#[test]
fn the_file_says_what_it_holds() {
    let value = wire();
    assert_eq!((&value["format"], &value["version"]), (&json!("shagreen-library"), &json!("1.0")));
    assert_eq!(value["units"]["acceleration"], "m/s^2");
    let texture = &value["textures"][0];
    assert_eq!(texture["space"]["label_source"], "physical");
    assert_eq!(texture["mu"], 0.3);
    assert_eq!(texture["rate_hz"], 1000.0);
    let anchor =
        json!({"speed_mm_per_s": 30.0, "force_n": 0.15, "level_mps2": 0.0625, "lsf": [0.5, 1.25, 3.0]});
    assert_eq!(texture["anchors"][0], anchor);
}

#[test]
fn long_numbers_are_shortened_and_stay_close() {
    let mut library = small();
    let model = &library.textures[0].model;
    let mut nodes = model.nodes().to_vec();
    nodes[0].lsf[0] = 0.123_456_789;
    nodes[0].level_mps2 = 1.0 / 3.0;
    library.textures[0].model = TextureModel::new(model.rate(), nodes, None).unwrap();
    let back = read_library(&write_library(&library)).unwrap().value;
    let node = &back.textures[0].model.nodes()[0];
    assert_eq!((node.lsf[0], node.level_mps2), (0.123_457, 0.333_333));
}

#[test]
fn unknown_fields_survive() {
    let mut value = wire();
    value["mood"] = json!({"a": [1, 2.5, "x"]});
    value["units"]["temperature"] = json!("K");
    let texture = &mut value["textures"][0];
    texture["smell"] = json!([1, 2]);
    texture["space"]["raters"] = json!(12);
    texture["physical"]["method"] = json!("x");
    texture["picture"]["camera"] = json!("none");
    texture["anchors"][1]["ma_lsf"] = json!([0.5]);
    let read = read_library(&serde_json::to_vec(&value).unwrap()).unwrap().value;
    assert_eq!(serde_json::from_slice::<Value>(&write_library(&read)).unwrap(), value);
}

#[test]
fn unknown_fields_of_a_path_survive() {
    let mut value = wire();
    let texture = &mut value["textures"][0];
    let mut key = json!({"along": 0.0, "rough_smooth": 10.0, "hard_soft": 20.0, "stop": true, "anchors": texture["anchors"]});
    key["tap"] = json!({"frequency_hz": 200.0, "decay_per_s": 90.0, "amplitude_mps2": 3.0, "ring": "long"});
    key["mood"] = json!(1);
    key["anchors"][0]["extra"] = json!([2]);
    let mut end = key.clone();
    end["along"] = json!(5.0);
    texture["path"] = json!({"along": "distance", "at_end": "turn", "color": "red", "keys": [key, end]});
    let read = read_library(&serde_json::to_vec(&value).unwrap()).unwrap().value;
    let written: Value = serde_json::from_slice(&write_library(&read)).unwrap();
    assert_eq!(written["textures"][0]["path"], value["textures"][0]["path"]);
}

/// An output holds the textures of all keys at once, each with a height map of up to 512 by 512 heights.
#[test]
fn a_path_with_more_textures_than_an_output_holds_is_refused_before_they_are_decoded() {
    let with = |n: usize| {
        move |library: &mut Value| {
            let texture = &mut library["textures"][0];
            let mut key =
                json!({"rough_smooth": 10.0, "hard_soft": 20.0, "stop": true, "anchors": texture["anchors"]});
            key["height_map"] = json!({"side_mm": 20.0, "n": 512, "force_n": 1.0, "speed_exponent": 2.0, "patch_radius_mm": 0.2, "step_m": 1e-9, "base64": "damaged"});
            let mut keys = vec![key; n];
            for (index, key) in keys.iter_mut().enumerate() {
                key["along"] = json!(index);
            }
            texture["path"] = json!({"along": "distance", "at_end": "turn", "keys": keys});
        }
    };
    check_error(with(49), &["the path of texture \"cork\" has 49 textures, but at most 48 are possible"]);
    check_error(with(48), &["cork, key 1 of its path", "base64"]);
}

#[test]
fn a_tap_that_could_hurt_is_refused() {
    for (field, value, words) in [
        ("amplitude_mps2", -3.0, "amplitude is -3e0"),
        ("amplitude_mps2", 3e38, "amplitude is 3e38; it must be between 0 and 1000 m/s²"),
        ("decay_per_s", 1e-9, "decay is 1e-9; it must be between 0.5"),
        ("frequency_hz", 1e300, "frequency is 1e300"),
    ] {
        let mut tap = json!({"frequency_hz": 200.0, "decay_per_s": 90.0, "amplitude_mps2": 3.0});
        tap[field] = json!(value);
        check_error(|v| v["textures"][0]["tap"] = tap.clone(), &["`tap`", words]);
    }
}

#[test]
fn unknown_fields_of_anchors_are_not_given_to_others() {
    let read = read_changed(|v| v["textures"][0]["anchors"][1]["extra"] = json!(1)).unwrap();
    let mut library = read;
    let model = &library.textures[0].model;
    library.textures[0].model =
        TextureModel::new(model.rate(), model.nodes()[..1].to_vec(), model.friction()).unwrap();
    assert!(!String::from_utf8(write_library(&library)).unwrap().contains("extra"));
}

#[test]
fn other_kinds_and_versions_are_refused_with_the_reason() {
    check_error(|v| v["format"] = json!("other"), &["not a texture library", "other"]);
    check_error(|v| v["format"] = Value::Null, &["not a texture library", "missing"]);
    for none in ["[1, 2]", "[]", " [\"shagreen-library\", \"1.0\"]", "5", "null", "\"text\"", "{}"] {
        assert!(matches!(read_library(none.as_bytes()), Err(LibraryError::Format { .. })), "{none}");
    }
    check_error(|v| v["version"] = json!("2.0"), &["version 2.0", "reads 1.x"]);
    check_error(|v| v["version"] = json!("0.9"), &["version 0.9"]);
    check_error(|v| v["version"] = json!(1.0), &["not of the form"]);
    check_error(|v| v["units"]["speed"] = json!("m/s"), &["speed in m/s", "reads mm/s"]);
    // A file of a higher major version is rejected for its version, whatever else it contains.
    let alien = br#"{"format": "shagreen-library", "version": "7.1", "textures": 5}"#;
    assert!(matches!(read_library(alien), Err(LibraryError::Major { .. })));
}

#[test]
fn a_higher_minor_version_is_read_with_a_warning() {
    let mut value = wire();
    let newer = format!("{VERSION_MAJOR}.{}", VERSION_MINOR + 1);
    value["version"] = json!(newer);
    let imported = read_library(&serde_json::to_vec(&value).unwrap()).unwrap();
    assert_eq!(imported.value.textures.len(), 2);
    assert!(imported.warnings[0].contains(&newer), "{:?}", imported.warnings);
}

#[test]
fn wrong_values_name_the_texture() {
    let anchor = |v: &mut Value, field: &str, to: Value| v["textures"][0]["anchors"][1][field] = to;
    check_error(|v| anchor(v, "lsf", json!([1.25, 0.5, 3.0])), &["\"cork\"", "node 1", "ascend"]);
    check_error(|v| anchor(v, "lsf", json!([0.5, 1.25])), &["\"cork\"", "node 1"]);
    check_error(|v| anchor(v, "level_mps2", json!(-1.0)), &["\"cork\"", "level"]);
    check_error(|v| anchor(v, "speed_mm_per_s", json!(0)), &["\"cork\"", "speed"]);
    check_error(|v| anchor(v, "force_n", Value::Null), &["\"cork\"", "line"]);
    check_error(|v| v["textures"][1]["anchors"] = json!([]), &["\"bare\""]);
    check_error(|v| v["textures"][1]["id"] = json!("cork"), &["two textures", "\"cork\""]);
    check_error(|v| v["textures"][1]["id"] = json!(""), &["number 2"]);
    check_error(|v| v["textures"][0]["space"]["hard_soft"] = json!(101), &["\"cork\"", "hard-soft is 101"]);
    check_error(|v| v["textures"][0]["space"]["label_source"] = json!("guess"), &["\"cork\"", "guess"]);
    check_error(|v| v["textures"][0]["rate_hz"] = json!(44100), &["\"cork\"", "44100"]);
    check_error(|v| v["textures"][0]["mu"] = json!(-0.1), &["\"cork\"", "friction"]);
    check_error(|v| v["textures"][0]["picture"]["base64"] = json!("!"), &["\"cork\"", "base64"]);
    check_error(|v| v["textures"][0]["picture"]["width"] = json!(0), &["\"cork\"", "pixels"]);
    check_error(|v| v["textures"][0]["picture"]["media_type"] = json!("image/gif"), &["\"cork\"", "gif"]);
}

#[test]
fn numbers_that_are_none_are_refused() {
    let text = String::from_utf8(write_library(&small())).unwrap();
    for nonsense in ["NaN", "Infinity", "1e999", "-", "\"0.0625\""] {
        let bytes = text.replacen("0.0625", nonsense, 1).into_bytes();
        assert!(matches!(read_library(&bytes), Err(LibraryError::Damaged { .. })), "{nonsense}");
    }
}

#[test]
fn every_truncation_is_an_error() {
    let bytes = write_library(&small());
    // Without its final line feed the file is still complete.
    for end in 0..bytes.len() - 1 {
        assert!(read_library(&bytes[..end]).is_err(), "cut at {end} of {}", bytes.len());
    }
    assert!(read_library(&bytes[..bytes.len() - 1]).is_ok());
}

#[test]
fn an_empty_library_is_odd_but_usable() {
    let imported = read_library(&write_library(&Library::default())).unwrap();
    assert_eq!(imported.warnings.len(), 1);
    assert_eq!(imported.value.label_source(), None);
    assert_eq!(imported.value.label_sources(), []);
}

#[test]
fn mixed_label_sources_are_no_single_source() {
    let mut library = small();
    assert_eq!(library.label_source(), Some(LabelSource::PhysicalLabels));
    let at = SpacePoint::new(1.0, 2.0).unwrap();
    library.textures[1].place = Some(Place::new(at, LabelSource::HumanRatings));
    assert_eq!(library.label_source(), None);
    assert_eq!(library.label_sources(), [LabelSource::PhysicalLabels, LabelSource::HumanRatings]);
    assert_eq!(library.index_of("bare"), Some(1));
    assert_eq!(library.license_of(&library.textures[0]), "CC0-1.0");
}

#[test]
fn the_deviation_of_an_estimated_position_is_kept() {
    let mut library = small();
    let place = library.textures[0].place.as_mut().unwrap();
    (place.source, place.deviation) = (LabelSource::Estimated, Some([10.5, 25.0]));
    let bytes = write_library(&library);
    assert_eq!(read_library(&bytes).unwrap().value, library);
    let value: Value = serde_json::from_slice(&bytes).unwrap();
    assert_eq!(
        (&value["version"], &value["textures"][0]["space"]["sd"]),
        (&json!("1.7"), &json!([10.5, 25.0]))
    );
    assert!(wire()["textures"][0]["space"].get("sd").is_none(), "unknown deviations are not written");
    check_error(
        |library| library["textures"][0]["space"]["sd"] = json!([10.0, 101.0]),
        &["cork", "`sd`", "0 to 100"],
    );
    check_error(|library| library["textures"][0]["space"]["sd"] = json!([-1.0, 5.0]), &["cork", "0 to 100"]);
}

#[test]
fn a_damaged_picture_is_warned_of_and_kept() {
    let mut library = small();
    let picture = library.textures[0].picture.as_mut().unwrap();
    picture.bytes[0] = 0;
    let imported = read_library(&write_library(&library)).unwrap();
    assert_eq!(imported.warnings.len(), 1);
    assert!(
        imported.warnings[0].contains("\"cork\"") && imported.warnings[0].contains("damaged"),
        "{:?}",
        imported.warnings
    );
    assert_eq!(imported.value, library);
    let mut wider = wire();
    wider["textures"][0]["picture"]["width"] = json!(3);
    let imported = read_library(&serde_json::to_vec(&wider).unwrap()).unwrap();
    assert!(imported.warnings[0].contains("2 x 1 pixels"), "{:?}", imported.warnings);
}

proptest! {
    #[test]
    fn mutated_bytes_never_panic(edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8)) {
        let mut bytes = write_library(&small());
        for (at, byte) in &edits {
            let at = at.index(bytes.len());
            bytes[at] = *byte;
        }
        if let Ok(imported) = read_library(&bytes) {
            // Any value that was read can be written and read again.
            assert!(read_library(&write_library(&imported.value)).is_ok());
        }
    }
}

#[test]
fn attributes_without_meaning_are_refused() {
    let with = |values: Value, source: &str| {
        let attributes = json!({"label_source": source, "values": values});
        move |library: &mut Value| library["textures"][0]["attributes"] = attributes
    };
    let value = |name: &str, value: f64| json!({"name": name, "value": value});
    check_error(with(json!([value("a-b", 101.0)]), "human"), &["cork", "\"a-b\"", "0 and 100"]);
    check_error(with(json!([value("a-b", 1.0), value("a-b", 2.0)]), "human"), &["cork", "twice"]);
    check_error(with(json!([value(" ", 1.0)]), "human"), &["no name"]);
    check_error(with(json!([]), "guessed"), &["cork", "guessed"]);
    check_error(|library| library["space_report"] = json!([1]), &["space_report"]);
}
