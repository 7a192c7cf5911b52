//! Positions with other numbers of coordinates than two, and the names of axes.

use serde_json::{Value, json};
use shagreen_core::space::{LabelSource, SpacePoint};

use crate::library::{Library, Place, read_library, write_library};

const V1_2: &[u8] = include_bytes!("../../../tests/golden/library-1.2.json");
const V1_4: &[u8] = include_bytes!("../../../tests/golden/library-1.4.json");
const V1_8: &[u8] = include_bytes!("../../../tests/golden/library-1.8.json");

fn read(bytes: &[u8]) -> Library {
    read_library(bytes).unwrap().value
}

/// Positions on one to six axes; two of them need no version of their own.
#[test]
fn positions_on_any_number_of_axes_go_there_and_back() {
    let names = ["rough-smooth", "hard-soft", "a-b", "tap frequency", "warm", "c-d"];
    for n_axes in 1..=6 {
        let mut library = read(V1_4);
        library.axes = Some(names[..n_axes].iter().map(|name| (*name).to_owned()).collect());
        for (index, texture) in library.textures.iter_mut().enumerate() {
            let at = SpacePoint::plane(10.5, 20.0).on(n_axes).with(n_axes - 1, 1.25 * index as f64);
            texture.place = Some(Place::new(at, LabelSource::HumanRatings));
        }
        // A path keeps the axes on which it was authored.
        let bytes = write_library(&library);
        assert_eq!(read(&bytes), library, "{n_axes} axes");
        assert_eq!(write_library(&read(&bytes)), bytes);
        let value: Value = serde_json::from_slice(&bytes).unwrap();
        assert_eq!(value["version"], if n_axes == 2 { "1.4" } else { "1.8" });
        let space = &value["textures"][1]["space"];
        assert_eq!(space.get("hard_soft").is_some(), n_axes > 1);
        assert_eq!(space["further"].as_array().map_or(0, Vec::len), n_axes.saturating_sub(2));
    }
}

#[test]
fn wrong_numbers_of_coordinates_name_the_texture() {
    let edits: [(&str, Value, &str); 7] = [
        ("/axes", json!(["a-b", "c-d"]), "texture \"cork\" has 4 coordinates, but the number of axes is 2"),
        ("/axes", json!(["a-b"]), "texture \"cork\" has 4 coordinates, but the number of axes is 1"),
        (
            "/textures/0/space/further",
            json!([1.0]),
            "texture \"cork\" has 3 coordinates, but the number of axes is 4",
        ),
        ("/textures/2/space/further", json!([]), "has 2 coordinates, but the number of axes is 4"),
        ("/textures/0/space/hard_soft", Value::Null, "`further` coordinates, but no `hard_soft`"),
        ("/textures/0/space/further", json!([1.0, 101.0]), "coordinate 4 is 101"),
        (
            "/textures/0/path/keys/1/further",
            json!([1.0]),
            "key 2 of the path of texture \"cork\" has 3 coordinates",
        ),
    ];
    for (pointer, to, words) in edits {
        let mut value: Value = serde_json::from_slice(V1_8).unwrap();
        *value.pointer_mut(pointer).unwrap() = to;
        let message = read_library(value.to_string().as_bytes()).unwrap_err().to_string();
        assert!(message.contains(words), "{pointer}: {message}");
    }
    let mut value: Value = serde_json::from_slice(V1_8).unwrap();
    value["textures"][0]["space"]["further"] = json!([1, 2, 3, 4, 5]);
    let message = read_library(value.to_string().as_bytes()).unwrap_err().to_string();
    assert!(message.contains("\"cork\"") && message.contains("got 7"), "{message}");
}

/// Files before version 1.3 name the axes in the report of their space only.
#[test]
fn axes_of_a_report_never_rename_positions_on_the_usual_axes() {
    let mut library = read(V1_2);
    library.space_report = Some(json!({"axes": [{"name": "warm-cold"}, {"name": "flat-bumpy"}]}));
    let bytes = write_library(&library);
    assert_eq!(read(&bytes), library);
    let mut older: Value = serde_json::from_slice(&bytes).unwrap();
    older.as_object_mut().unwrap().remove("axes");
    let older = read(&serde_json::to_vec(&older).unwrap());
    assert_eq!(older.axis_names(), ["warm-cold", "flat-bumpy"]);
}
