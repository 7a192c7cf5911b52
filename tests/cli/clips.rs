//! `shagreen import` with haptic clips, and what it recognizes by content.

use crate::support::Bench;

use serde_json::{Value, json};
use shagreen_formats::starter::starter_bytes;

/// A number from 0 to 1 that looks random.
fn drawn(i: u32) -> f64 {
    f64::from(i * i * 7919 % 1009) / 1009.0
}

/// A clip of three seconds whose amplitude and frequency change twenty times a second.
pub(crate) fn clip() -> String {
    let point = |i: u32, key: &str, value: f64| json!({"time": 0.05 * f64::from(i), key: value});
    let amplitude: Vec<Value> = (0..=60).map(|i| point(i, "amplitude", 0.4 + 0.5 * drawn(i))).collect();
    let frequency: Vec<Value> = (0..=60).map(|i| point(i, "frequency", drawn(i + 500))).collect();
    let envelopes = json!({"amplitude": amplitude, "frequency": frequency});
    json!({"version": {"major": 1}, "signals": {"continuous": {"envelopes": envelopes}}}).to_string()
}

#[test]
fn a_clip_becomes_a_texture_once_its_stroke_is_stated() {
    let bench = Bench::new();
    bench.write("buzz.haptic", clip());
    let said = bench.run("import buzz.haptic --out mine.json");
    assert_eq!(said.code, 1, "{said:?}");
    for words in ["tip speed", "normal force", "--set", "assumed: 60-300", "assumed: 1"] {
        assert!(said.stderr.contains(words), "{words}: {}", said.stderr);
    }
    assert_eq!(bench.files(), ["buzz.haptic"]);
    let stroke = "--set speed=100mm/s --set force=1N";
    let done = bench.json(&format!("import buzz.haptic --out mine.json {stroke}"));
    assert_eq!((&done["imported"], &done["textures"][0]["id"]), (&1.into(), &"buzz".into()), "{done}");
    let keys: Vec<&str> = done["questions"]
        .as_array()
        .unwrap()
        .iter()
        .map(|question| question["key"].as_str().unwrap())
        .collect();
    assert_eq!(keys, ["frequency_range", "full_scale"]);
    // The band of an actuator answers one of them.
    let actuators = bench.json("actuator list");
    let id = actuators["actuators"][0]["id"].as_str().unwrap();
    bench.json(&format!("actuator acf {id} -o it.acf"));
    for actuator in [id, "it.acf"] {
        let done = bench
            .json(&format!("import buzz.haptic --out mine.json --replace {stroke} --set full_scale=2 --set acceleration_unit=m/s^2 --actuator {actuator}"));
        assert!(done["questions"].as_array().unwrap().is_empty(), "{done}");
    }
    bench.fails(
        &format!("import buzz.haptic --out o.json {stroke} --actuator none"),
        1,
        &["neither a built-in actuator"],
    );
    // The texture is one like any other.
    bench.json("render --library mine.json --texture buzz --speed 100 --force 1 --seconds 1 -o buzz.wav");
    let predicted = bench.json(&format!("predict attributes --recording buzz.haptic {stroke}"));
    assert!(predicted.is_object());
}

#[test]
fn a_wrong_speed_is_named_and_so_is_a_wrong_name_of_the_library() {
    let bench = Bench::new();
    bench.write("buzz.haptic", clip());
    for (wrong, code) in [("speed=100", 1), ("speed=100mph", 1), ("speed=-1mm/s", 2)] {
        let said = bench.run(&format!("import buzz.haptic --out o.json --set force=1N --set {wrong}"));
        let given = wrong.split_once('=').unwrap().1;
        assert_eq!(said.code, code, "{said:?}");
        for words in [given, "(mm/s, cm/s, m/s)", "100 mm/s"] {
            assert!(said.stderr.contains(words), "{words}: {}", said.stderr);
        }
        assert!(!said.stderr.contains("not stated"), "{}", said.stderr);
    }
    let import = "import buzz.haptic --set speed=100mm/s --set force=1N --out";
    bench.fails(&format!("{import} n2.wav"), 1, &["a .json file, not to .wav", "n2.wav"]);
    bench.fails(&format!("{import} -"), 2, &["standard output"]);
    assert_eq!(bench.files(), ["buzz.haptic"]);
}

#[test]
fn a_clip_of_another_program_is_refused_with_its_place() {
    let bench = Bench::new();
    bench.write("late.haptic", clip().replace("\"time\":0.05", "\"time\":9.05"));
    bench.write("loud.csv", "time,amplitude,frequency\n0,3,100\n1,3,100\n");
    bench.write("cut.ahap", "{\"Version\": 1.0, \"Pattern\": [");
    bench.write("scale.json", "{\"duration\": 5, \"parameters\": {\"amplitude\": {\"data\": [{\"t\": 0, \"value\": 7}]}, \"frequency\": {\"data\": []}}}");
    for (file, words) in [
        ("late.haptic", "before the previous point"),
        ("loud.csv", "from 0 to 1; divide them"),
        ("cut.ahap", "it ends too early"),
        ("scale.json", "point 1 of amplitude is 7"),
    ] {
        let said = bench.run(&format!("import {file} --out o.json --set speed=100mm/s --set force=1N"));
        assert_eq!(said.code, 1, "{said:?}");
        assert!(said.stderr.contains(words) && said.stderr.contains(file), "{words}: {}", said.stderr);
    }
    let said = bench.run("check late.haptic");
    assert_eq!(said.code, 1, "{said:?}");
    assert!(said.stdout.contains("before the previous point"), "{}", said.stdout);
    bench.write("buzz.haptic", clip());
    assert_eq!(bench.json("check buzz.haptic")["valid"], true);
}

#[test]
fn models_and_recordings_are_told_apart_by_their_content() {
    let bench = Bench::new();
    bench.write("slate", include_str!("../../vectors/hatt/made_up.xml"));
    let done = bench.json("import slate --out all.json");
    assert_eq!((&done["imported"], &done["textures"][0]["id"]), (&1.into(), &"made-up-slate".into()));
    assert!(done["warnings"].to_string().contains("research"), "{done}");
    bench.write("starter", starter_bytes());
    let done = bench.json("import starter --out all.json");
    assert_eq!(done["imported"], 25);
    assert_eq!(bench.json("library list --library all.json")["textures"].as_array().unwrap().len(), 26);
    bench.write("buzz.haptic", clip());
    bench.fails("import slate buzz.haptic --out o.json", 2, &["one after the other"]);
    bench.fails("import slate --out o.json --name Slate", 2, &["--name applies only to recordings"]);
    bench.fails("import --out o.json", 2, &["FILE"]);
    bench.fails("import none.csv --out o.json", 1, &["nothing was imported"]);
    // The commands for one kind stay.
    assert_eq!(bench.json("import hatt slate --out hatt.json")["imported"], 1);
}
