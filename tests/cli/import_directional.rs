//! `shagreen import directional`: a folder of strokes in several directions.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use serde_json::Value;
use shagreen_core::maths::rng::lcg_noise;

use crate::support::{Bench, rms};

/// Sample rate of the accelerations, in Hz.
const RATE_HZ: f64 = 6000.0;
const STROKE_SECS: f64 = 1.3;
const EIGHT: [u32; 8] = [0, 45, 90, 135, 180, 225, 270, 315];
/// Speed in mm/s and force in mN of the strokes in each direction.
const CONTACTS: [(u32, u32); 2] = [(20, 200), (40, 400)];
/// Root mean square acceleration across the lay, in g.
const LEVEL_G: f64 = 0.1;

/// Noise with a resonance of some 35 Hz bandwidth, with the root mean square 1.
fn noise(hz: f64, n: usize, seed: u64) -> Vec<f64> {
    let radius = 0.9_f64.powf(1000.0 / RATE_HZ);
    let middle = 2.0 * radius * (TAU * hz / RATE_HZ).cos();
    let mut x = lcg_noise(n, seed);
    for i in 2..n {
        x[i] += middle * x[i - 1] - radius * radius * x[i - 2];
    }
    let scale = 1.0 / rms(&x);
    x.iter().map(|x| scale * x).collect()
}

/// Table of accelerations in g on three axes, with gravity along z. Across the lay, at 90°, the texture is twice as
/// strong as along it and has another resonance; `along` is the level along the lay.
fn acceleration(direction: u32, along: f64, seed: u64) -> String {
    let n = (STROKE_SECS * RATE_HZ) as usize;
    let share = f64::from(direction).to_radians().cos().powi(2);
    let across_grain = noise(90.0, n, 2 * seed);
    let along_grain = noise(if along < 1.0 { 250.0 } else { 90.0 }, n, 2 * seed + 1);
    let mut text = String::from("time,X,Y,Z\n");
    for i in 0..n {
        let grain = (1.0 - share).sqrt() * across_grain[i] + along * share.sqrt() * along_grain[i];
        let a = LEVEL_G * grain;
        // The squares of the three shares add up to one.
        let [x, y, z] = [0.6 * a, 0.64 * a, 1.0 + 0.48 * a];
        writeln!(text, "{:.6},{x:.6},{y:.6},{z:.6}", i as f64 / RATE_HZ).unwrap();
    }
    text
}

/// Table at 100 Hz over the duration of a stroke.
fn slow(header: &str, row: impl Fn(f64) -> String) -> String {
    let n = (100.0 * STROKE_SECS) as usize;
    (0..=n).map(|i| i as f64 / 100.0).fold(format!("{header}\n"), |text, t| text + &row(t) + "\n")
}

/// Writes the folder: `brushed` with a lay at 0°, measured completely, and `felt` without a lay, with accelerations only.
pub(crate) fn write_folder(bench: &Bench, folder: &str) {
    let mut seed = 1;
    for direction in EIGHT {
        for (speed, force) in CONTACTS {
            let name = format!("brushed_{direction}_{speed}_{force}_1.csv");
            bench.write(&format!("{folder}/acceleration/{name}"), acceleration(direction, 0.5, seed));
            let newtons = 1e-3 * f64::from(force);
            let force = slow("time,force", |t| format!("{t:.2},{newtons:.3}"));
            bench.write(&format!("{folder}/force/{name}"), force);
            let (sin, cos) = f64::from(direction).to_radians().sin_cos();
            let at = |t: f64| f64::from(speed) * t;
            let position = slow("time,X,Y", |t| format!("{t:.2},{:.4},{:.4}", at(t) * cos, at(t) * sin));
            bench.write(&format!("{folder}/position/{name}"), position);
            let name = format!("felt_{direction}_{speed}_{}_1_acc.csv", CONTACTS[0].1);
            bench.write(&format!("{folder}/felt/{name}"), acceleration(direction, 1.0, seed + 1));
            seed += 2;
        }
    }
}

#[test]
fn a_folder_becomes_textures_with_and_without_a_lay() {
    let bench = Bench::new();
    write_folder(&bench, "strokes");
    bench.write("strokes/felt/notes.txt", "not a stroke");
    let done = bench.json("import directional strokes --out lib.json --licence CC-BY-4.0");
    assert_eq!((&done["imported"], done["failed"].as_array().unwrap().len()), (&2.into(), 0), "{done}");
    let [brushed, felt] = [&done["textures"][0], &done["textures"][1]];
    assert_eq!((&brushed["id"], &felt["id"]), (&"brushed".into(), &"felt".into()));

    let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("{value} is no number: {done}"));
    assert_eq!((&brushed["isotropic"], &brushed["strokes"]), (&false.into(), &16.into()), "{brushed}");
    let degrees: Vec<f64> = brushed["directions"]
        .as_array()
        .unwrap()
        .iter()
        .map(|direction| number(&direction["degrees"]).round())
        .collect();
    assert_eq!(degrees, EIGHT.map(f64::from));
    let lay = number(&brushed["lay_degrees"]).to_radians();
    assert!(lay.sin().abs() < 10_f64.to_radians().sin(), "{brushed}");
    // Five seconds of a bandwidth of 100 Hz along each axis have a standard error of 0.2 dB.
    assert!((number(&brushed["modulation_db"]) - 6.0).abs() < 1.0, "{brushed}");
    // At 45° to the lay, the model has one resonance between the two, so its spectra agree less there.
    assert!(number(&brushed["gfc_median"]) > 0.6 && number(&brushed["level_error_db_median"]) < 1.0);
    assert_eq!((&felt["isotropic"], felt["lay_degrees"].is_null()), (&true.into(), true), "{felt}");

    let warnings = done["warnings"].to_string();
    for words in ["notes.txt", "felt: 16 strokes", "there is no force file", "there is no position file"] {
        assert!(warnings.contains(words), "{words:?} is not in {warnings}");
    }
    assert!(done["notes"].to_string().contains("brushed: 16 strokes in 8 directions: lay at"), "{done}");

    let library: Value = serde_json::from_slice(&std::fs::read(bench.path("lib.json")).unwrap()).unwrap();
    let [brushed, felt] = [&library["textures"][0], &library["textures"][1]];
    assert!(brushed["anchors_along"].is_array() && felt["anchors_along"].is_null(), "{brushed}");
    assert!((number(&brushed["turn_deg"]).abs() - 90.0).abs() < 10.0, "across the lay is at 90°");
    assert_eq!(brushed["licence"], "CC-BY-4.0");
    // The level across the lay, which is that of strokes at 90°.
    let psd = |direction: &str| {
        bench.json(&format!(
            "texture psd --library lib.json --texture brushed --speed 20 --force 0.2{direction}"
        ))
    };
    let across = psd(" --direction 90");
    let level_db = 20.0 * (number(&across["rms"]) / (9.806_65 * LEVEL_G)).log10();
    assert!(level_db.abs() < 1.0, "{level_db} dB");
    assert_eq!(across["direction_degrees"], 90.0);
    // Without a direction it is that of a stroke to the right, as in a rendered steady stroke.
    let right = psd("");
    assert_eq!(right["direction_degrees"], 0.0);
    assert!((number(&psd(" --direction 180")["rms"]) / number(&right["rms"]) - 1.0).abs() < 1e-9);
    let steady =
        "render --library lib.json --texture brushed --speed 20 --force 0.2 --seconds 60 -o right.wav";
    let rendered = number(&bench.json(steady)["rms"]);
    let error_db = 20.0 * (rendered / number(&right["rms"])).log10();
    // A minute of noise some tens of Hz wide: a standard error of 2 %.
    assert!(error_db.abs() < 0.6, "{error_db} dB");
    assert!(number(&right["rms"]) < 0.8 * number(&across["rms"]), "{right}");
}

#[test]
fn directions_without_an_angle_are_asked_for() {
    let bench = Bench::new();
    for (direction, angle) in [("with", 0), ("against", 90)] {
        for repeat in 1..=2 {
            let name = format!("strokes/acc/cloth_{direction}_20_200_{repeat}.csv");
            bench.write(&name, acceleration(angle, 0.5, u64::from(angle) + repeat));
        }
    }
    bench.fails("import directional strokes --out lib.json", 1, &["nothing was imported"]);
    let said = bench.run("import directional strokes --out lib.json");
    assert!(said.stderr.contains("no angle is known for the directions against, with"), "{}", said.stderr);
    assert!(said.stderr.contains("--direction against=90"), "{}", said.stderr);
    let stated = "import directional strokes --out lib.json --direction with=0 --direction against=90";
    let cloth = &bench.json(stated)["textures"][0];
    // Two directions show a lay along one of them.
    let lay = cloth["lay_degrees"].as_f64().unwrap().to_radians();
    assert!(lay.sin().abs() < 1e-9 && cloth["isotropic"] == false, "{cloth}");
    let said = bench.run(&format!("{stated} --direction up=90"));
    assert!(said.stderr.contains("--direction up=90 has no effect"), "{}", said.stderr);
    bench.fails("import directional strokes --out lib2.json --direction with", 2, &["NAME=DEGREES"]);
}

#[test]
fn damaged_files_and_folders_say_what_to_do() {
    let bench = Bench::new();
    bench.write("strokes/acc/tile_0_20_200_1.csv", "time,X,Y,Z\n0,0,0,1\n0.1,0,oops,1\n");
    bench.write("strokes/acc/tile_0_20_200_2.csv", acceleration(0, 1.0, 3));
    let done = bench.json("import directional strokes --out lib.json --order 10 --rate 1000");
    assert_eq!(done["imported"], 1, "{done}");
    let failed = &done["failed"][0];
    assert!(failed["file"].as_str().unwrap().ends_with("tile_0_20_200_1.csv"), "{failed}");
    assert!(failed["reason"].as_str().unwrap().contains("line 3"), "{failed}");
    bench.write("empty/notes.md", "");
    bench.fails("import directional empty --out l.json", 1, &["cork_45_20_200_1.csv", "empty"]);
    bench.fails("import directional nowhere --out l.json", 1, &["cannot list the folder nowhere"]);
    bench.fails("import directional strokes --out strokes", 2, &["--out is a folder"]);
}
