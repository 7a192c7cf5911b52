//! Files that were made to do harm, and absurd numbers: each gets one short error, quickly and in little memory.

use std::time::{Duration, Instant};

use serde_json::{Value, json};
use shagreen_formats::starter::starter_bytes;

use crate::support::Bench;

/// Longest time that a refusal may take.
const AT_ONCE: Duration = Duration::from_secs(10);
/// Longest error, in characters.
const SHORT: usize = 1500;

/// The starter library, with a change to its first texture.
fn library(change: impl Fn(&mut Value)) -> Vec<u8> {
    let mut library: Value = serde_json::from_slice(starter_bytes()).unwrap();
    change(&mut library["textures"][0]);
    serde_json::to_vec(&library).unwrap()
}

/// Checks that a command fails with these words, in one short line, and quickly.
fn check(bench: &Bench, command: &str, code: i32, words: &[&str]) {
    let begun = Instant::now();
    bench.fails(command, code, words);
    assert!(begun.elapsed() < AT_ONCE, "{command} took {:?}", begun.elapsed());
    let said = bench.run(command);
    assert!(said.stderr.chars().count() < SHORT, "{} characters", said.stderr.chars().count());
}

#[cfg(target_os = "linux")]
#[test]
fn devices_and_pipes_are_no_files() {
    let bench = Bench::new();
    let pipe = bench.path("pipe");
    rustix::fs::mkfifoat(rustix::fs::CWD, &pipe, rustix::fs::Mode::RUSR | rustix::fs::Mode::WUSR).unwrap();
    for library in ["/dev/zero", "pipe"] {
        check(&bench, &format!("library list --library {library}"), 1, &["pipe or a device", library]);
        check(&bench, &format!("quality {library} a.wav"), 1, &["pipe or a device", library]);
    }
    let project = |file: &str| {
        json!({"format": "shagreen-project", "version": "1.0", "units": {"length": "mm", "time": "s"},
            "library": {"file": file}, "authored": []})
        .to_string()
    };
    bench.write("zero.shagreen", project("/dev/zero"));
    check(&bench, "project show zero.shagreen", 1, &["pipe or a device", "/dev/zero"]);
    bench.write("pipe.shagreen", project("pipe"));
    check(&bench, "project show pipe.shagreen", 1, &["pipe or a device"]);
    // A sidecar that is a pipe.
    let sidecar = bench.path("a.json");
    rustix::fs::mkfifoat(rustix::fs::CWD, &sidecar, rustix::fs::Mode::RUSR | rustix::fs::Mode::WUSR).unwrap();
    bench.write("a.wav", b"RIFF");
    check(&bench, "import recording a.wav --out b.json", 1, &["nothing was imported"]);
}

#[test]
fn taps_and_filters_that_could_hurt_are_refused() {
    let bench = Bench::new();
    for (field, value, words) in [
        ("decay_per_s", 1e-9, "decay is 1e-9"),
        ("amplitude_mps2", 3e38, "amplitude is 3e38"),
        ("frequency_hz", 1e300, "frequency is 1e300"),
    ] {
        let mut tap = json!({"frequency_hz": 150.0, "decay_per_s": 90.0, "amplitude_mps2": 3.0});
        tap[field] = json!(value);
        bench.write("tap.json", library(|texture| texture["tap"] = tap.clone()));
        check(&bench, "library list --library tap.json", 1, &["tap", words, "tap.json"]);
    }
    let near: Vec<f64> = (0..10).map(|i| 0.5 + 0.01 * f64::from(i)).collect();
    let unstable = library(|texture| {
        for node in texture["anchors"].as_array_mut().unwrap() {
            node["lsf"] = json!(near);
        }
    });
    bench.write("near.json", unstable);
    check(&bench, "library list --library near.json", 1, &["unstable in single precision", "near.json"]);
    let profile = "format = \"shagreen-actuator\"\nversion = \"1.0\"\nid = \"x\"\nname = \"x\"\nsource = \"x\"\nlowest_hz = 20\n[limits]\npeak_v = 1e30\nthermal_time_s = 10\n";
    bench.write("coil.toml", profile);
    check(&bench, "actuator show coil.toml", 1, &["peak voltage in V", "at most 100", "coil.toml"]);
}

#[test]
fn long_texts_and_absurd_counts_are_refused() {
    let bench = Bench::new();
    let long = "x".repeat(65_536);
    bench.write("id.json", library(|texture| texture["id"] = json!(long)));
    check(&bench, "library list --library id.json", 1, &["65536 characters", "at most 200"]);
    bench.write("name.json", library(|texture| texture["name"] = json!(long)));
    check(&bench, "library list --library name.json", 1, &["65536 characters", "at most 1000"]);
    bench.write("word.json", library(|texture| texture["provenance"] = json!(long)));
    check(&bench, "library list --library word.json", 1, &["…"]);
    bench.write("level.json", library(|texture| texture["anchors"][0]["level_mps2"] = json!(1e300)));
    check(&bench, "library list --library level.json", 1, &["(301 digits)"]);
    let project = json!({"format": "shagreen-project", "version": "1.0", "units": {"length": "mm", "time": "s"},
        "library": {"built_in": "starter"}, "authored": [{"key": 1, "name": long, "rough_smooth": 1.0,
        "hard_soft": 1.0, "blend": {"mode": "field"}}]});
    bench.write("name.shagreen", project.to_string());
    check(&bench, "project show name.shagreen", 1, &["name.shagreen"]);
    for participants in ["0", "100000000", "99999999999999999999"] {
        let command = format!("space panel --participants {participants} --sorting s.csv --ratings r.csv");
        check(&bench, &command, 2, &["--participants", "from 1 to 10000"]);
    }
    let command = "space build --library simulated --sorting s.csv --ratings r.csv --out l.json --permutations 9999999999";
    check(&bench, command, 2, &["--permutations", "from 0 to 1000000"]);
    bench.write("line.csv", format!("participant,trial,{}\n", "cork,".repeat(400_000)));
    let command = "space build --library simulated --sorting line.csv --ratings r.csv --out l.json";
    check(&bench, command, 1, &["line 1 is longer than", "line.csv"]);
}

#[test]
fn two_names_of_one_file_are_not_two_files() {
    let bench = Bench::new();
    check(&bench, "space panel --library simulated --sorting x.csv --ratings ./x.csv", 1, &["same file"]);
    assert_eq!(bench.files(), Vec::<String>::new());
}

#[test]
fn a_line_of_millions_of_cells_is_no_table() {
    let bench = Bench::new();
    bench.write("line.csv", "1,".repeat(10 << 20));
    check(&bench, "import recording line.csv --out b.json", 1, &["nothing was imported"]);
    let said = bench.run("import recording line.csv --out b.json");
    assert!(said.stderr.contains("line 1 is longer than"), "{}", said.stderr);
}

#[test]
fn a_library_outside_the_folder_of_its_project_is_named() {
    let bench = Bench::new();
    bench.write("elsewhere/mine.json", starter_bytes());
    bench.write("near/mine.json", starter_bytes());
    let project = |library: &str| {
        json!({"format": "shagreen-project", "version": "1.0", "units": {"length": "mm", "time": "s"},
            "library": {"file": library}, "authored": []})
        .to_string()
    };
    bench.write("near/far.shagreen", project("../elsewhere/mine.json"));
    bench.write("near/near.shagreen", project("mine.json"));
    assert!(bench.run("project show near/far.shagreen").stderr.contains("outside the folder of the project"));
    assert!(!bench.run("project show near/near.shagreen").stderr.contains("outside"));
}
