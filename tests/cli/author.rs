//! Authoring from the command line: modes, pinned textures, points outside the hull, and paths.

use crate::support::{Bench, rms};
use serde_json::Value;

fn psd(bench: &Bench, what: &str) -> Value {
    bench.json(&format!("texture psd {what} --speed 80 --force 0.6 --bins 40"))
}

fn parents(value: &Value) -> Vec<(String, f64)> {
    let parent = |p: &Value| (p["id"].as_str().unwrap().to_owned(), p["weight"].as_f64().unwrap());
    value["parents"].as_array().unwrap().iter().map(parent).collect()
}

/// Returns the largest difference of two spectra, in dB.
fn difference_db(a: &Value, b: &Value) -> f64 {
    let numbers = |v: &Value| -> Vec<f64> {
        v["psd"].as_array().unwrap().iter().map(|p| 10.0 * p.as_f64().unwrap().log10()).collect()
    };
    numbers(a).iter().zip(numbers(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn every_mode_authors_and_the_field_is_the_one_that_is_taken() {
    let bench = Bench::new();
    let usual = psd(&bench, "--at 45,40");
    assert_eq!(usual["blend"], "field");
    assert_eq!(parents(&usual).len(), 25, "every texture contributes");
    for mode in ["field", "parametric", "shared", "power", "paper"] {
        let authored = psd(&bench, &format!("--at 45,40 --blend {mode}"));
        let weights = parents(&authored);
        assert!((weights.iter().map(|p| p.1).sum::<f64>() - 1.0).abs() < 1e-9);
        assert!(mode == "field" || weights.len() == 3, "{mode}: {weights:?}");
        assert_eq!(authored == usual, mode == "field", "{mode}");
    }
    let natural = psd(&bench, "--at 45,40 --blend parametric --natural");
    assert!(parents(&natural).len() > 3);
}

#[test]
fn a_locked_texture_is_itself_at_its_own_place() {
    let bench = Bench::new();
    let list = bench.json("library list");
    let denim = list["textures"].as_array().unwrap().iter().find(|t| t["id"] == "denim").unwrap().clone();
    let at = format!("{},{}", denim["at"][0], denim["at"][1]);
    let own = psd(&bench, "--texture denim");
    let smoothed = psd(&bench, &format!("--at {at}"));
    let locked = psd(&bench, &format!("--at {at} --lock denim"));
    assert!(difference_db(&own, &locked) < 1e-6, "{}", difference_db(&own, &locked));
    assert!(difference_db(&own, &smoothed) > 0.3);
    assert_eq!(parents(&locked), [("denim".to_owned(), 1.0)]);
    bench.fails("texture psd --at 1,1 --speed 1 --force 1 --lock dennim", 1, &["dennim", "denim"]);
}

#[test]
fn outside_it_is_clamped_or_extrapolated_and_said() {
    let bench = Bench::new();
    let clamped = bench.run("texture psd --at 0,100 --speed 80 --force 0.6 --json");
    assert!(clamped.stderr.contains("nearest point"), "{}", clamped.stderr);
    let clamped: Value = serde_json::from_str(&clamped.stdout).unwrap();
    let further = bench.run("texture psd --at 0,100 --extrapolate --speed 80 --force 0.6 --json");
    assert!(further.stderr.contains("extrapolated"), "{}", further.stderr);
    let further: Value = serde_json::from_str(&further.stdout).unwrap();
    assert_eq!((&clamped["clamped"], &clamped["extrapolated"]), (&true.into(), &false.into()));
    assert_eq!(further["extrapolated"], true);
    assert_ne!(clamped["at"], further["at"]);
    bench.fails(
        "texture psd --at 0,100 --extrapolate --blend shared --speed 1 --force 1",
        1,
        &["extrapolation outside the convex hull is available only in mode field"],
    );
    bench.fails("texture psd --at 0,100 --natural --speed 1 --force 1", 1, &["parametric"]);
    bench.fails(
        "texture psd --at 50,50 --lock denim --blend power --speed 1 --force 1",
        1,
        &["textures can be pinned only in mode field"],
    );
}

#[test]
fn a_path_is_one_texture_that_changes_along_the_stroke() {
    let bench = Bench::new();
    // From rough to smooth within 100 mm, which is one second of this stroke.
    let made = bench.json("texture path --stop 20,40@0 --stop 75,35@100 --name Way -o way.json");
    assert_eq!(
        (&made["id"], &made["unit"], &made["along"]),
        (&"way".into(), &"mm".into(), &"distance".into())
    );
    assert!(made["keys"].as_u64().unwrap() >= 13, "{made}");
    bench.json("render --library way.json --texture way --speed 100 --force 1 --seconds 2 -o sound.wav");
    let (signal, rate_hz) = bench.wav("sound.wav");
    let level = |from: f64, to: f64| rms(&signal[(from * rate_hz) as usize..(to * rate_hz) as usize]);
    let ends = ["20,40", "75,35"].map(|at| {
        bench.json(&format!("texture psd --at {at} --speed 100 --force 1"))["rms"].as_f64().unwrap()
    });
    assert!(ends[0] > 2.0 * ends[1], "{ends:?}");
    assert!((level(0.0, 0.1) / ends[0] - 1.0).abs() < 0.4, "{} for {}", level(0.0, 0.1), ends[0]);
    assert!((level(1.1, 2.0) / ends[1] - 1.0).abs() < 0.2, "{} for {}", level(1.1, 2.0), ends[1]);
    let middle = level(0.4, 0.6);
    assert!(middle < level(0.0, 0.1) && middle > level(1.1, 2.0), "{middle}");
    let list = bench.json("library list --library way.json");
    assert_eq!(list["textures"].as_array().unwrap().len(), 1);
    bench.json("play --library way.json --texture way --speed 100 --force 1 --seconds 0.3");

    // A library of a path may be replaced by another path; other libraries may not.
    bench.json("texture path --stop 20,40@0 --stop 75,35@50 --name Way -o way.json");
    bench.json("library places --out places.csv");
    bench.json("space place --attributes places.csv --source physical --out mine.json");
    bench.fails("texture path --stop 20,40@0 --stop 75,35@50 -o mine.json", 1, &["mine.json"]);
    let lost =
        bench.json("export --library way.json --texture way --format hatt -o way.xml")["lost"].to_string();
    assert!(lost.contains("along the stroke"), "{lost}");

    bench.fails("texture path --stop 20,40@0 -o x.json", 1, &["at least two"]);
    bench.fails("texture path --stop 20,40@0 --stop 30,40@0 -o x.json", 1, &["point 2"]);
    bench.fails("texture path --stop 20,40@5 --stop 30,40@9 -o x.json", 1, &["point 1"]);
    bench.fails(
        "texture path --stop 20,40@0 --stop 30,40@9 --blend shared -o x.json",
        1,
        &["field or parametric"],
    );
    bench.fails("texture path --stop 20,40 --stop 30,40@9 -o x.json", 2, &["RS,HS@X"]);
}
