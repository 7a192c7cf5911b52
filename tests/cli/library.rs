//! `shagreen library list` and `shagreen library make`.

use crate::support::Bench;
use serde_json::Value;

const STARTER: &str = include_str!("../../assets/starter/starter.json");
const MATERIALS: &str = include_str!("../../assets/starter/materials.toml");

/// Returns a library with one texture of the starter library.
fn only(index: usize) -> String {
    let mut library: Value = serde_json::from_str(STARTER).unwrap();
    let texture = library["textures"][index].clone();
    library["textures"] = Value::Array(vec![texture]);
    library.to_string()
}

#[test]
fn the_starter_is_listed() {
    let list = Bench::new().json("library list");
    let textures = list["textures"].as_array().unwrap();
    assert_eq!(textures.len(), 25);
    for texture in textures {
        assert_eq!((&texture["label_source"], &texture["rate_hz"]), (&"physical".into(), &1000.0.into()));
        assert_eq!((&texture["nodes"], texture["at"].as_array().unwrap().len()), (&25.into(), 2));
        assert!((10..=20).contains(&texture["order"].as_u64().unwrap()));
        assert!(!texture["licence"].as_str().unwrap().is_empty());
    }
    let said = Bench::new().run("library list");
    assert!(said.stdout.contains("cork") && said.stdout.contains("physical labels"));
}

#[test]
fn the_list_says_what_depends_on_direction() {
    let bench = Bench::new();
    bench.write("layers.json", include_str!("../../crates/formats/tests/golden/library-1.7.json"));
    let list = bench.json("library list --library layers.json");
    let [cork, published] = [0, 1].map(|index| list["textures"][index].clone());
    assert_eq!((&cork["directional"], &published["directional"]), (&true.into(), &false.into()));
    assert_eq!((&cork["height_map"]["side_mm"], &cork["height_map"]["n"]), (&8.0.into(), &16.into()));
    assert_eq!(cork["stick_slip"]["static_ratio"], 1.6);
    assert!((cork["turn_deg"].as_f64().unwrap() - 30.0).abs() < 1e-9);
    assert_eq!((&published["height_map"], &published["stick_slip"]), (&Value::Null, &Value::Null));
    let said = bench.run("library list --library layers.json").stdout;
    assert!(said.contains("directional, height map of 8.0 mm, stick-slip"), "{said}");
}

#[test]
fn every_texture_is_itself_at_its_own_place() {
    let bench = Bench::new();
    for texture in bench.json("library list")["textures"].as_array().unwrap() {
        let at = format!("{},{}", texture["at"][0], texture["at"][1]);
        // The field smooths; mixtures of neighbors do not.
        let psd = bench.json(&format!("texture psd --at {at} --blend shared --speed 100 --force 1 --bins 2"));
        assert_eq!(psd["clamped"], false, "{texture}");
        assert_eq!(psd["parents"][0]["id"], texture["id"]);
        // Positions are written with six decimals.
        assert!(psd["parents"][0]["weight"].as_f64().unwrap() > 1.0 - 1e-4, "{psd}");
    }
}

#[test]
fn a_folder_is_one_library_and_clashes_are_named() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("lib")).unwrap();
    bench.write("lib/a.json", only(0));
    bench.write("lib/b.json", only(1));
    bench.write("lib/signal.json", "{\"format\": \"shagreen-signal\"}");
    bench.write("lib/notes.txt", "not a library");
    // JSON of other programs need not be an object.
    bench.write("lib/numbers.json", "[1, 2, 3]");
    bench.write("lib/text.json", "\"text\"");
    bench.write("lib/none.json", "{}");
    let list = bench.json("library list --library lib");
    assert_eq!(list["textures"].as_array().unwrap().len(), 2);
    assert_ne!(list["textures"][0]["licence"], "");
    bench.write("lib/c.json", only(1));
    bench.fails("library list --library lib", 1, &["polished-metal", "b.json", "c.json"]);
    bench.write("lib/c.json", &only(2)[..100]);
    bench.fails("library list --library lib", 1, &["damaged", "c.json"]);
    std::fs::create_dir(bench.path("empty")).unwrap();
    bench.fails("library list --library empty", 1, &["no texture library", "empty"]);
}

#[test]
fn label_sources_are_never_mixed_up() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("lib")).unwrap();
    bench.write("lib/a.json", only(0));
    bench.write("lib/b.json", only(1));
    assert_eq!(bench.run("library list --library lib").stderr, "");
    let mut rated: Value = serde_json::from_str(&only(2)).unwrap();
    rated["textures"][0]["space"]["label_source"] = "human".into();
    bench.write("lib/c.json", rated.to_string());
    let said = bench.run("library list --library lib --json");
    assert!(said.stderr.starts_with("warning: the positions come from different sources"), "{}", said.stderr);
    assert!(said.stderr.contains("physical labels, human ratings"), "{}", said.stderr);
    let list: Value = serde_json::from_str(&said.stdout).unwrap();
    let sources: Vec<&Value> =
        list["textures"].as_array().unwrap().iter().map(|texture| &texture["label_source"]).collect();
    assert_eq!(sources, ["physical", "physical", "human"]);
    bench.json("render --library lib --texture glass --speed 90 --force 1 --seconds 0.1 -o o.wav");
    let sidecar: Value = serde_json::from_slice(&std::fs::read(bench.path("o.json")).unwrap()).unwrap();
    assert_eq!(sidecar["label_source"], Value::Null);
}

#[test]
fn a_damaged_picture_is_warned_of() {
    let bench = Bench::new();
    let mut library: Value = serde_json::from_str(&only(0)).unwrap();
    library["textures"][0]["picture"]["base64"] = "AAAA".into();
    bench.write("l.json", library.to_string());
    let said = bench.run("library list --library l.json");
    assert_eq!(said.code, 0);
    assert!(said.stderr.contains("warning: the picture of texture \"glass\""), "{}", said.stderr);
    assert!(said.stderr.trim_end().ends_with("l.json"), "{}", said.stderr);
}

#[test]
fn textures_without_a_place_are_listed_and_rendered_by_name() {
    let bench = Bench::new();
    let mut library: Value = serde_json::from_str(&only(0)).unwrap();
    library["textures"][0].as_object_mut().unwrap().remove("space");
    bench.write("l.json", library.to_string());
    let list = bench.json("library list --library l.json");
    assert_eq!(
        (&list["textures"][0]["at"], &list["textures"][0]["label_source"]),
        (&Value::Null, &Value::Null)
    );
    bench.json("render --library l.json --texture glass --speed 90 --force 1 --seconds 0.1 -o o.wav");
    let at = "render --library l.json --at 30,70 --speed 90 --force 1 --seconds 0.1 -o p.wav";
    bench.fails(at, 1, &["no texture of the library has a position"]);
}

#[test]
fn a_library_is_made_of_materials_and_is_the_same_again() {
    let bench = Bench::new();
    let text = one_material();
    bench.write("m.toml", &text);
    let made = bench.json("library make m.toml --out a.json --name Mine --licence CC0-1.0");
    assert_eq!(made["textures"], 1);
    bench.json("library make m.toml --out b.json --name Mine --licence CC0-1.0");
    let read = |name: &str| std::fs::read(bench.path(name)).unwrap();
    assert!(read("a.json") == read("b.json"));
    let list = bench.json("library list --library a.json");
    assert_eq!((&list["library"], &list["textures"][0]["licence"]), (&"Mine".into(), &"CC0-1.0".into()));
    bench.write("bad.toml", text.replacen("hurst = ", "hurst = 7", 1));
    bench.fails("library make bad.toml --out c.json", 1, &["hurst of glass", "bad.toml"]);
    bench.write("bad.toml", text.replacen("hurst", "hearst", 1));
    bench.fails("library make bad.toml --out c.json", 1, &["hearst", "bad.toml"]);
}

/// A library that has other textures is replaced only if the user says so.
#[test]
fn a_library_with_other_textures_is_replaced_only_where_that_is_said() {
    let bench = Bench::new();
    bench.write("m.toml", one_material());
    let other = only(1);
    bench.write("mine.json", &other);
    bench.fails("library make m.toml --out mine.json", 1, &["--replace", "mine.json"]);
    assert_eq!(std::fs::read_to_string(bench.path("mine.json")).unwrap(), other);
    bench.json("library make m.toml --out mine.json --replace");
    let list = bench.json("library list --library mine.json");
    assert_eq!(list["textures"][0]["id"], "glass");
}

/// Returns the head of the starter library's materials with only the first material.
fn one_material() -> String {
    let first = MATERIALS.find("[[material]]").unwrap();
    let second = first + 1 + MATERIALS[first + 1..].find("[[material]]").unwrap();
    MATERIALS[..second].to_owned()
}
