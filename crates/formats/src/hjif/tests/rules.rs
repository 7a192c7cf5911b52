//! A negative test for each rule.

use serde_json::{Value, json};

use crate::hjif::{Checked, CurveType, HjifError, check_hjif, read_hjif};

/// A small file that follows all rules and has every kind of part.
const VALID: &str = r#"{
  "version": "2023-1", "profile": "Main", "level": 1, "date": "2026-01-31T10:00:00Z", "description": "",
  "timescale": 1000, "syncs": [{"timestamp": 0, "timescale": 500}],
  "avatars": [
    {"id": 1, "lod": 0, "type": "Custom", "mesh": "hand.glb"},
    {"id": 2, "lod": 0, "type": "Vibration"}
  ],
  "perceptions": [{
    "id": 0, "avatar_id": 1, "description": "", "perception_modality": "Vibrotactile",
    "reference_devices": [
      {"id": 4, "name": "coil", "minimum_frequency": 20, "resonance_frequency": 65.5, "maximum_frequency": 500, "type": "VCA"}
    ],
    "effect_library": [
      {"effect_type": "Basis", "id": 7, "position": 0, "phase": 0.0, "base_signal": "Sine",
       "semantic_keywords": "Texture/Wood", "keyframes": [{"relative_position": 0, "amplitude_modulation": 0.5}]},
      {"effect_type": "Composite", "id": 8}
    ],
    "channels": [{
      "id": 3, "description": "", "gain": 1.0, "mixing_coefficient": 1, "body_part_mask": 4294967295,
      "reference_device_id": 4, "direction": {"X": 127, "Y": 0, "Z": 0},
      "actuator_resolution": {"X": 2, "Y": 1, "Z": 0}, "actuator_target": [{"X": 1, "Y": 1, "Z": 0}],
      "bands": [
        {"band_type": "VectorialWave", "lower_frequency_limit": 50, "upper_frequency_limit": 50,
         "effects": [{"effect_type": "Reference", "id": 7, "position": 10}]},
        {"band_type": "Curve", "curve_type": "B-spline", "lower_frequency_limit": 0, "upper_frequency_limit": 72,
         "effects": [{"effect_type": "Basis", "position": 0, "phase": 0, "base_signal": "SawToothUp", "keyframes": [
           {"relative_position": 0, "amplitude_modulation": -1},
           {"relative_position": 5, "amplitude_modulation": 1, "frequency_modulation": 80}]}]},
        {"band_type": "WaveletWave", "block_length": 1024, "lower_frequency_limit": 72, "upper_frequency_limit": 1000,
         "effects": [{"effect_type": "Basis", "position": 0, "wavelet_stream": "AAEC"}]}
      ]
    }]
  }]
}"#;

pub(super) fn valid() -> Value {
    serde_json::from_str(VALID).unwrap()
}

pub(super) fn checked(file: &Value) -> Result<Checked, HjifError> {
    check_hjif(file.to_string().as_bytes())
}

#[test]
fn a_file_that_follows_the_rules_has_no_fault() {
    let file = checked(&valid()).unwrap();
    assert_eq!((file.faults.as_slice(), file.n_faults), (&[][..], 0));
    assert_eq!(file.file.perceptions[0].channels[0].bands[1].curve_type, Some(CurveType::BSpline));
    let mut with_mark = b"\xef\xbb\xbf".to_vec();
    with_mark.extend(valid().to_string().into_bytes());
    assert_eq!(read_hjif(&with_mark).unwrap(), file.file);
}

/// Broken fields of [`VALID`]: the field, its value, the place of the fault, and words of its reason.
const BROKEN: &str = r#"
/version | "2022" | version | 2022
/version | "2023-0" | version | 2023-0
/version | "1.0" | version | no version
/level | 3 | level | 1 or 2
/level | 0 | level | 1 or 2
/date | "yesterday" | date | ISO 8601
/timescale | 48001 | timescale | 1 to 48000
/timescale | 0 | timescale | 1 to 48000
/syncs/0/timescale | 50000 | syncs[0].timescale | 1 to 48000
/avatars/1/id | 0 | avatars[1].id | must not be 0
/avatars/1/id | 1 | avatars[1].id | given twice
/avatars/0/mesh | "" | avatars[0].mesh | mesh
/avatars/0/type | "Pressure" | avatars[0].mesh | Custom
/perceptions/0/avatar_id | 9 | perceptions[0].avatar_id | no avatar with the id 9
/perceptions/0/reference_devices/0/minimum_frequency | 70 | reference_devices[0] | above the resonance
/perceptions/0/reference_devices/0/maximum_frequency | 60 | reference_devices[0] | above the highest
/perceptions/0/reference_devices/0/minimum_frequency | -1 | reference_devices[0] | 0 or more
/perceptions/0/effect_library/1/id | 7 | effect_library[1].id | given twice
/perceptions/0/effect_library/1/id | null | effect_library[1] | needs id
/perceptions/0/effect_library/0/position | null | effect_library[0] | needs position
/perceptions/0/effect_library/0/phase | null | effect_library[0] | needs phase
/perceptions/0/effect_library/0/base_signal | null | effect_library[0] | needs base_signal
/perceptions/0/effect_library/0/keyframes | [] | effect_library[0] | needs keyframes
/perceptions/0/effect_library/0/semantic_keywords | "Texture/Cheese" | semantic_keywords | Texture/Cheese
/perceptions/0/effect_library/0/semantic_keywords | "wood" | semantic_keywords | no semantic keyword
/perceptions/0/effect_library/0/keyframes/0/amplitude_modulation | 1.001 | effect_library[0].keyframes[0] | -1 to 1
/perceptions/0/channels/0/reference_device_id | 5 | reference_device_id | no reference device with the id 5
/perceptions/0/channels/0/actuator_resolution | null | channels[0] | needs actuator_resolution
/perceptions/0/channels/0/direction/X | 125 | channels[0].direction | length 0.984
/perceptions/0/channels/0/actuator_resolution/Z | -1 | actuator_resolution | 0 or more
/perceptions/0/channels/0/actuator_target/0/X | 3 | actuator_target[0] | 0 to 2
/perceptions/0/channels/0/bands/0/lower_frequency_limit | 51 | bands[0] | above the upper
/perceptions/0/channels/0/bands/0/lower_frequency_limit | -1 | bands[0].lower_frequency_limit | 0 or more
/perceptions/0/channels/0/bands/0/curve_type | "Linear" | bands[0].curve_type | type Curve
/perceptions/0/channels/0/bands/0/block_length | 64 | bands[0].block_length | type WaveletWave
/perceptions/0/channels/0/bands/2/block_length | 1000 | bands[2].block_length | power of two
/perceptions/0/channels/0/bands/2/block_length | -4 | bands[2].block_length | power of two
/perceptions/0/channels/0/bands/2/block_length | null | bands[2] | needs block_length
/perceptions/0/channels/0/bands/0/effects/0/id | 70 | bands[0].effects[0].id | no effect in the library
/perceptions/0/channels/0/bands/0/effects/0/id | null | bands[0].effects[0] | needs id
/perceptions/0/channels/0/bands/0/effects/0/position | null | bands[0].effects[0] | needs position
/perceptions/0/channels/0/bands/0/effects/0/wavelet_stream | "AAEC" | wavelet_stream | type WaveletWave
/perceptions/0/channels/0/bands/1/effects/0/keyframes/1/relative_position | -1 | keyframes[1] | sort
/perceptions/0/channels/0/bands/1/effects/0/keyframes/1/frequency_modulation | -80 | keyframes[1] | 0 or more
/perceptions/0/channels/0/bands/2/effects/0/wavelet_stream | "~" | wavelet_stream | base64
/perceptions/0/channels/0/bands/2/effects/0/wavelet_stream | null | effects[0] | needs wavelet_stream
"#;

/// Each rule refuses a file that breaks it, and names the place.
#[test]
fn every_rule_is_enforced_at_its_place() {
    for row in BROKEN.trim().lines() {
        let [pointer, value, place, reason] = row.split(" | ").collect::<Vec<_>>()[..] else {
            panic!("{row}")
        };
        let mut file = valid();
        let (parent, field) = pointer.rsplit_once('/').unwrap();
        file.pointer_mut(parent).unwrap()[field] = serde_json::from_str(value).unwrap();
        check_fault(&file, place, reason);
    }
}

fn check_fault(file: &Value, place: &str, reason: &str) {
    let Checked { faults, n_faults, .. } = checked(file).unwrap();
    assert_eq!(n_faults, 1, "{place}, {reason}: {faults:?}");
    let text = faults[0].to_string();
    assert!(faults[0].place.contains(place) && text.contains(reason), "{place}, {reason}: {text}");
    assert!(matches!(read_hjif(file.to_string().as_bytes()), Err(HjifError::Rules { n: 1, .. })), "{text}");
}

/// Rules that need more than one field.
#[test]
fn limits_of_levels_and_profiles_are_enforced() {
    let copies = |of: &Value, n: usize| -> Vec<Value> {
        let copy = |id: usize| {
            let mut copy = of.clone();
            copy["id"] = json!(id);
            copy
        };
        (0..n).map(copy).collect()
    };
    let empty_channel = json!({"id": 0, "description": "", "gain": 1, "mixing_coefficient": 1, "body_part_mask": 0, "bands": []});
    for (n, is_valid) in [(127, true), (128, false)] {
        let mut file = valid();
        file["perceptions"][0]["channels"] = json!(copies(&empty_channel, n));
        if is_valid {
            assert_eq!(checked(&file).unwrap().n_faults, 0);
        } else {
            check_fault(&file, "perceptions[0].channels", "the level 1 allows 127");
        }
        file["level"] = json!(2);
        assert_eq!(checked(&file).unwrap().n_faults, 0, "level 2 allows more");
    }
    let band = json!({"band_type": "Transient", "lower_frequency_limit": 0, "upper_frequency_limit": 9, "effects": []});
    for (n, level) in [(8, 1), (64, 2)] {
        let mut file = valid();
        file["level"] = json!(level);
        file["perceptions"][0]["channels"][0]["bands"] = json!(vec![band.clone(); n]);
        check_fault(&file, "channels[0].bands", "too many");
    }
    for (list, place) in [
        ("/perceptions/0/channels", "channels[1].id"),
        ("/perceptions", "perceptions[1].id"),
        ("/perceptions/0/reference_devices", "reference_devices[1].id"),
    ] {
        let mut file = valid();
        let list = file.pointer_mut(list).unwrap();
        *list = json!([list[0], list[0]]);
        check_fault(&file, place, "given twice");
    }

    // The simple profile has neither wavelets nor composite effects.
    let mut simple = valid();
    simple["profile"] = json!("Simple Parametric");
    simple["syncs"] = json!([]);
    let faults: Vec<String> = checked(&simple).unwrap().faults.iter().map(ToString::to_string).collect();
    assert_eq!(faults.len(), 2, "{faults:?}");
    assert!(
        faults[0].contains("no composite effects") && faults[1].contains("no bands of wavelets"),
        "{faults:?}"
    );
    simple["perceptions"][0]["effect_library"].as_array_mut().unwrap().pop();
    simple["perceptions"][0]["channels"][0]["bands"].as_array_mut().unwrap().pop();
    assert_eq!(checked(&simple).unwrap().n_faults, 0);
    simple["timescale"] = json!(2000);
    check_fault(&simple, "timescale", "only 1000");
    simple["timescale"] = Value::Null;
    simple["perceptions"][0]["perception_modality"] = json!("Friction");
    check_fault(&simple, "perception_modality", "has only Force");
    simple["level"] = json!(2);
    assert_eq!(checked(&simple).unwrap().n_faults, 0);
    // Another scheme of keywords is not that of the standard.
    let mut file = valid();
    file["perceptions"][0]["effect_semantic_scheme"] = json!("urn:mine");
    file["perceptions"][0]["effect_library"][0]["semantic_keywords"] = json!("anything");
    assert_eq!(checked(&file).unwrap().n_faults, 0);
}

/// Types, unknown words and missing fields are found by the parser, which names line and column.
#[test]
fn a_damaged_tree_is_named_with_its_place() {
    for (pointer, value, reason) in [
        ("/profile", json!("Full"), "`Full` is unknown; the known words are `Main`"),
        ("/perceptions/0/perception_modality", json!("Texture"), "`Texture` is unknown"),
        ("/perceptions/0/channels/0/bands/0/band_type", json!("Wave"), "`Wave` is unknown"),
        ("/perceptions/0/channels/0/bands/1/curve_type", json!("Round"), "`Round` is unknown"),
        ("/perceptions/0/effect_library/0/effect_type", json!("Own"), "`Own` is unknown"),
        ("/perceptions/0/effect_library/0/base_signal", json!("Noise"), "`Noise` is unknown"),
        ("/avatars/0/type", json!("Hand"), "`Hand` is unknown"),
        ("/perceptions/0/reference_devices/0/type", json!("Motor"), "`Motor` is unknown"),
        ("/perceptions/0/channels/0/bands/0/lower_frequency_limit", json!(0.5), "a whole number is needed"),
        ("/perceptions/0/channels/0/direction/X", json!(128), "a whole number is needed"),
        ("/perceptions/0/channels/0/body_part_mask", json!(4_294_967_296_u64), "a whole number"),
        ("/perceptions/0/channels/0/gain", json!("1"), "a number is needed"),
        ("/timescale", json!(-1), "0 or greater"),
        ("/perceptions", Value::Null, "a list is needed"),
    ] {
        let mut file = valid();
        *file.pointer_mut(pointer).unwrap() = value;
        let error = checked(&file).unwrap_err().to_string();
        assert!(error.contains(reason) && error.contains("(line 1, column "), "{pointer}: {error}");
    }
    for field in ["version", "profile", "level", "date", "description", "avatars", "perceptions", "syncs"] {
        let mut file = valid();
        file.as_object_mut().unwrap().remove(field);
        let error = checked(&file).unwrap_err().to_string();
        assert!(error.contains(&format!("the field `{field}` is missing")), "{error}");
    }
    for (bytes, reason) in [
        (&b""[..], "the file is empty"),
        (b"\x89PNG\r\n\x1a\n", "this is a PNG picture, not an MPEG haptic file"),
        (b"[1]", "this is not an MPEG haptic file"),
        (b"{\"version\": ", "it ends too early"),
        (b"{\"version\": \"\xff\"}", "correct the file"),
    ] {
        let error = check_hjif(bytes).unwrap_err().to_string();
        assert!(error.contains(reason), "{error}");
    }
}

/// A file with many faults does not take memory for each.
#[test]
fn the_first_hundred_faults_are_kept() {
    let mut file = valid();
    file["syncs"] = json!(vec![json!({"timestamp": 0, "timescale": 0}); 250]);
    let Checked { faults, n_faults, .. } = checked(&file).unwrap();
    assert_eq!((faults.len(), n_faults), (100, 250));
    let error = read_hjif(file.to_string().as_bytes()).unwrap_err().to_string();
    assert!(error.contains("rules at 250 places") && error.contains("syncs[0].timescale"), "{error}");
}
