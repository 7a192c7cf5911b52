//! `shagreen predict` and `shagreen train`.

use crate::import::table;
use crate::support::{Bench, Said};
use serde_json::Value;

const FIVE: [&str; 5] = ["rough-smooth", "hard-soft", "flat-bumpy", "sticky-slippery", "irritating-pleasant"];

fn prompt(bench: &Bench, text: &str) -> Value {
    let output = bench.command("predict attributes --json --prompt").arg(text).output().unwrap();
    assert!(output.status.success(), "{text}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn attribute(said: &Value, name: &str) -> (f64, f64) {
    let of = &said["attributes"][name];
    (of["value"].as_f64().unwrap(), of["sd"].as_f64().unwrap())
}

#[test]
fn words_have_attributes_with_how_unsure_they_are() {
    let bench = Bench::new();
    let carpet = prompt(&bench, "a rough, soft carpet-like surface");
    for name in FIVE {
        let (value, sd) = attribute(&carpet, name);
        assert!((0.0..=100.0).contains(&value) && (3.0..29.0).contains(&sd), "{name}: {value} ± {sd}");
    }
    assert!(attribute(&carpet, "rough-smooth").0 < 40.0 && attribute(&carpet, "hard-soft").0 > 70.0);
    assert_eq!(carpet["label_source"], "estimated");
    assert_eq!(carpet["model_sha256"].as_str().unwrap().len(), 64);
    let glass = prompt(&bench, "perfectly smooth glass");
    assert!(attribute(&glass, "rough-smooth").0 > 85.0 && attribute(&glass, "hard-soft").0 < 15.0);
    assert!(attribute(&prompt(&bench, "not smooth"), "rough-smooth").0 < 40.0);
}

#[test]
fn words_that_say_nothing_leave_everything_open() {
    let bench = Bench::new();
    let long = "lorem ipsum ".repeat(3000);
    for text in [
        "",
        " ",
        "the meaning of life",
        "\u{7c97}\u{3044}\u{5e03}",
        "\u{0645}\u{062e}\u{0645}\u{0644}",
        &long,
    ] {
        let said = prompt(&bench, text);
        assert_eq!(said["is_about_touch"], false, "{said}");
        for name in FIVE {
            assert_eq!(attribute(&said, name), (50.0, 28.9));
        }
    }
    let contradiction = prompt(&bench, "rough and smooth");
    assert_eq!(contradiction["disputed"][0], "rough-smooth");
    assert!(attribute(&contradiction, "rough-smooth").1 > 20.0);
    bench.fails("predict attributes", 2, &["--prompt"]);
    bench.fails("predict attributes --prompt rough --recording x.wav", 2, &["--recording"]);
}

#[test]
fn a_recording_has_the_attributes_of_the_texture_it_was_made_of() {
    let bench = Bench::new();
    bench.write("stroke.csv", table(&bench, "loop-carpet"));
    let said = bench.json("predict attributes --recording stroke.csv --set acceleration_unit=m/s^2");
    // As a simulated panel rated the carpet: rough, soft, bumpy. Friction is not in the recording.
    for (name, rated, within) in
        [("rough-smooth", 25.2, 15.0), ("hard-soft", 90.9, 20.0), ("flat-bumpy", 69.3, 25.0)]
    {
        let (value, sd) = attribute(&said, name);
        assert!((value - rated).abs() < within && sd > 1.0, "{name}: {value} ± {sd} for {rated}");
    }
    assert_eq!(said["label_source"][0], "simulated");
    let starter =
        bench.json("predict attributes --recording stroke.csv --set acceleration_unit=g --library simulated");
    assert!(
        attribute(&starter, "rough-smooth").0 < attribute(&said, "rough-smooth").0 + 1.0,
        "ten times as strong"
    );
    bench.fails(
        "predict attributes --recording stroke.csv",
        1,
        &["acceleration_unit", "--set", "stroke.csv"],
    );
    bench.fails("predict attributes --recording nowhere.csv", 1, &["nowhere.csv"]);
}

#[test]
fn five_attributes_are_told_to_ten_points_and_better_than_by_a_line() {
    let bench = Bench::new();
    let said = bench.json("train attributes --library simulated");
    assert_eq!((&said["chosen"], &said["textures"]), (&"gaussian process".into(), &25.into()));
    for name in FIVE {
        let mae = said["mae"][name].as_f64().unwrap();
        assert!(mae < 10.0, "{name}: {mae}");
        let ratio = said["error_over_deviation"][name].as_f64().unwrap();
        assert!((0.5..2.0).contains(&ratio), "{name}: {ratio}");
        assert!(said["baselines"]["mean of the others"]["mae"][name].as_f64().unwrap() > mae);
    }
    // The starter library has places alone.
    let places = bench.json("train attributes");
    assert_eq!(places["mae"].as_object().unwrap().len(), 2);
    assert_eq!(places["label_source"][0], "physical");
}

#[test]
fn a_network_is_trained_kept_resumed_and_the_same_again() {
    let bench = Bench::new();
    // Each is told by the four others.
    let starter = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/starter/starter.json")).unwrap();
    let mut library: Value = serde_json::from_slice(&starter).unwrap();
    library["textures"].as_array_mut().unwrap().truncate(5);
    bench.write("five.json", library.to_string());
    let train = |more: &str| -> Said {
        bench.run(&format!(
            "train attributes --library five.json --network convolutions --share 0.2 --patience 0 --json {more}"
        ))
    };
    let begun = train("--epochs 1 --state kept");
    assert_eq!(begun.code, 0, "{}", begun.stderr);
    assert!(bench.path("kept/convolutions-without-glass.safetensors").exists());

    // Gone on with: the first round is not learned again.
    let resumed = train("--epochs 2 --state kept");
    assert_eq!(resumed.code, 0, "{}", resumed.stderr);
    assert!(
        !resumed.stderr.contains("round 1 of 2") && resumed.stderr.contains("round 2 of 2"),
        "{}",
        resumed.stderr
    );
    let said: Value = serde_json::from_str(&resumed.stdout).unwrap();
    assert_eq!(said["epochs"], 10);
    assert!(said["baselines"]["network convolutions"]["rmse"]["hard-soft"].as_f64().unwrap() > 0.0);
    // There is nothing left to learn: the same again, at once.
    let again: Value = serde_json::from_str(&train("--epochs 2 --state kept").stdout).unwrap();
    assert_eq!(again["baselines"], said["baselines"]);

    let other = train("--epochs 3 --seed 2 --state kept");
    assert_eq!(other.code, 1);
    assert!(
        other.stderr.contains("another training") || other.stderr.contains("other settings"),
        "{}",
        other.stderr
    );
    // What was kept is damaged.
    let path = bench.path("kept/convolutions-without-glass.safetensors");
    let mut bytes = std::fs::read(&path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&path, bytes).unwrap();
    let damaged = train("--epochs 3 --state kept");
    assert_eq!(damaged.code, 1);
    assert!(
        damaged.stderr.contains("changed or cut") && damaged.stderr.contains("glass"),
        "{}",
        damaged.stderr
    );
    bench.fails("train attributes -o x.safetensors", 1, &["--network"]);
}
