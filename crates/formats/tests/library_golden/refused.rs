//! Changed golden files that are no libraries any more.

use serde_json::{Value, json};
use shagreen_formats::library::read_library;

use super::{V1_3, V1_4, V1_7};

#[test]
fn layers_that_are_none_are_refused() {
    let edits: [(&str, Value, &str); 15] = [
        ("/anchors_along/0/level_mps2", Value::Null, "entry 0 of `anchors_along`"),
        (
            "/anchors_along/0/level_mps2",
            json!(-1.0),
            "the `anchors_along` of texture \"cork\" is invalid: level",
        ),
        ("/anchors_along/1/speed_mm_per_s", json!(71.0), "of node 1 is 0.071"),
        ("/anchors_along/1/lsf", json!([0.5, 1.0]), "the `anchors_along` of texture"),
        ("/anchors_along/1/lsf", json!(vec![0.5; 200]), "the `anchors_along` of texture"),
        ("/anchors_along", json!([]), "along the lay has 0 nodes"),
        ("/turn_deg", json!(361.0), "`turn_deg` 361"),
        ("/stick_slip/static_ratio", json!(0.5), "`stick_slip`"),
        ("/stick_slip/stribeck_mm_per_s", json!(-20.0), "`stick_slip`"),
        ("/height_map/n", json!(17), "512 bytes, but 17 by 17 heights have 578"),
        ("/height_map/n", json!(u64::MAX >> 12), "may be at most 512"),
        ("/height_map/step_m", json!(0.0), "its step_m is 0e0 m"),
        ("/height_map/base64", json!("!"), "base64 is damaged"),
        ("/height_map/side_mm", json!(0.0), "`height_map`"),
        ("/height_map/force_n", json!(-1.0), "`height_map`"),
    ];
    for (pointer, to, words) in edits {
        let mut value: Value = serde_json::from_slice(V1_7).unwrap();
        *value["textures"][0].pointer_mut(pointer).unwrap() = to;
        let message = read_library(value.to_string().as_bytes()).unwrap_err().to_string();
        assert!(message.contains(words) && message.contains("cork"), "{pointer}: {message}");
    }
    let published = |texture: &mut Value| texture["anchors_along"] = texture["anchors"].clone();
    let mut value: Value = serde_json::from_slice(V1_7).unwrap();
    published(&mut value["textures"][1]);
    let message = read_library(value.to_string().as_bytes()).unwrap_err().to_string();
    assert!(message.contains("\"published\"") && message.contains("along"), "{message}");
}

#[test]
fn paths_that_lead_nowhere_are_refused() {
    let edits: [(&str, Value, &str); 5] = [
        ("/textures/0/path/along", json!("mood"), "distance or time"),
        ("/textures/0/path/at_end", json!("stop"), "hold, turn or repeat"),
        ("/textures/0/path/keys/1/along", json!(40.0), "point 3"),
        ("/textures/0/path/keys/1/hard_soft", json!(140.0), "hard-soft is 140"),
        ("/textures/0/path/keys", json!([]), "at least two"),
    ];
    for (pointer, to, words) in edits {
        let mut value: Value = serde_json::from_slice(V1_4).unwrap();
        *value.pointer_mut(pointer).unwrap() = to;
        let message = read_library(value.to_string().as_bytes()).unwrap_err().to_string();
        assert!(message.contains(words) && message.contains("cork"), "{message}");
    }
}

#[test]
fn axes_are_one_to_six_different_names() {
    let seven = json!(["a", "b", "c", "d", "e", "f", "g"]);
    for axes in [json!([]), json!(["a-b", "A-B"]), json!(["", "a-b"]), json!(["a", "b", "a"]), seven] {
        let mut value: Value = serde_json::from_slice(V1_3).unwrap();
        value["axes"] = axes;
        let message = read_library(value.to_string().as_bytes()).unwrap_err().to_string();
        assert!(message.contains("one to six different names"), "{message}");
    }
    for (axes, n_axes) in [(json!(["warm-cold"]), 1), (json!(["a", "b", "c"]), 3)] {
        let mut value: Value = serde_json::from_slice(V1_3).unwrap();
        value["axes"] = axes;
        let message = read_library(value.to_string().as_bytes()).unwrap_err().to_string();
        let words = format!("texture \"cork\" has 2 coordinates, but the number of axes is {n_axes}");
        assert!(message.contains(&words), "{message}");
    }
}
