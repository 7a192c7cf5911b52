//! `shagreen devices --descriptor` and `--decode`, and strokes recorded from pens.

use std::fmt::Write as _;

use crate::support::{Bench, shared_data};
use serde_json::json;

/// Descriptor of a pen with an area of 209.66 by 157.25 mm and 4.016 N at a pressure of 4095, report 26.
const PEN: &str = "05 0d 09 02 a1 01 85 1a 09 20 a1 00 15 00 25 01 75 01 95 06 09 42 09 44 09 45 09 3c 09 5a 09 32 \
    81 02 95 02 81 03 05 01 a4 75 10 95 01 65 11 55 0d 09 30 26 e6 51 46 e6 51 81 02 09 31 26 6d 3d 46 6d 3d 81 02 \
    b4 05 0d 75 10 95 01 67 11 e1 00 00 55 02 26 ff 0f 46 b0 0f 09 30 81 02 65 14 55 0e 16 d8 dc 26 28 23 36 d8 dc \
    46 28 23 09 3d 09 3e 95 02 81 02 c0 c0";
const KEYBOARD: &str = "05 01 09 06 a1 01 05 07 19 e0 29 e7 15 00 25 01 75 01 95 08 81 02 c0";

fn bytes(hex: &str) -> Vec<u8> {
    hex.split_whitespace().map(|pair| u8::from_str_radix(pair, 16).unwrap()).collect()
}

/// Returns a stroke to the right at 100 mm/s and half of full pressure, as hid-recorder lines: 1 mm every 10 ms.
fn events() -> String {
    let mut text = String::new();
    for i in 0..100_u16 {
        let [low, high] = (5000 + 100 * i).to_le_bytes();
        let switches = if i < 5 { 0x20 } else { 0x21 };
        writeln!(
            text,
            "E: {:.6} 12 1a {switches:02x} {low:02x} {high:02x} b6 1e 00 08 00 00 00 00",
            0.01 * f64::from(i)
        )
        .unwrap();
    }
    text
}

fn recording() -> String {
    format!("# made up\nR: {} {PEN}\nN: Test pen\nI: 3 0001 0002\n{}", bytes(PEN).len(), events())
}

#[test]
fn what_descriptors_declare() {
    let bench = Bench::new();
    bench.write("pen.bin", bytes(PEN));
    bench.write("pen.txt", PEN);
    bench.write("pen.rec", recording());
    bench.write("keyboard.bin", bytes(KEYBOARD));
    bench.write("broken.bin", &bytes(PEN)[..40]);
    bench.write("nonsense.bin", [0xc0, 0xff]);
    bench.write("empty.bin", []);
    let files = "pen.bin pen.txt pen.rec keyboard.bin broken.bin nonsense.bin empty.bin missing.bin";
    let said = bench.run(&format!("devices --descriptor {files} --json"));
    assert_eq!(said.code, 1);
    assert!(said.stderr.contains("3 of 8 could not be read"), "{}", said.stderr);
    let found: serde_json::Value = serde_json::from_str(&said.stdout).unwrap();
    let found = found["descriptors"].as_array().unwrap();
    let names: Vec<&str> = found.iter().map(|entry| entry["file"].as_str().unwrap()).collect();
    assert_eq!(names, files.split(' ').collect::<Vec<_>>());
    for pen in &found[..3] {
        assert_eq!(pen["pen"], true);
        assert_eq!(
            (&pen["report_id"], &pen["tilt"], &pen["error"]),
            (&json!(26), &json!(true), &json!(null))
        );
        assert_eq!(pen["x"], json!({"logical_min": 0, "logical_max": 20966, "mm": 209.66}));
        assert_eq!(pen["y"]["mm"], 157.25);
        let pressure = json!({"bits": 16, "logical_min": 0, "logical_max": 4095, "newtons_max": 4.016});
        assert_eq!(pen["pressure"], pressure);
    }
    assert_eq!(found[2]["name"], "Test pen");
    assert_eq!((&found[3]["pen"], &found[3]["error"]), (&json!(false), &json!(null)));
    for (index, word) in [(4, "collection"), (5, "byte 0"), (6, "empty"), (7, "cannot read")] {
        let entry = &found[index];
        assert_eq!(
            (&entry["pen"], &entry["x"], &entry["pressure"]),
            (&json!(false), &json!(null), &json!(null))
        );
        if index > 4 {
            let error = entry["error"].as_str().unwrap();
            assert!(error.contains(word), "{error}");
        }
    }
    let said = bench.run(&format!("devices --descriptor {files}"));
    assert_eq!((said.code, said.stdout.lines().count()), (1, 8));
    assert!(
        said.stdout
            .contains("pen.bin: pen, report 26, 209.66 x 157.25 mm, pressure up to 4095 (4.016 N), tilt")
    );
}

#[test]
fn reports_are_decoded_by_a_descriptor_or_their_own() {
    let bench = Bench::new();
    bench.write("pen.bin", bytes(PEN));
    bench.write("events.txt", events());
    bench.write("pen.rec", recording());
    let mut dump = format!("001:002:003:DESCRIPTOR 1234567.5\n {PEN}\n\n");
    for line in events().lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        write!(dump, "001:002:003:STREAM {}\n {}\n\n", words[1], words[3..].join(" ")).unwrap();
    }
    bench.write("pen.dump", dump);
    let by_file = bench.json("devices --decode pen.bin events.txt");
    for own in ["pen.rec", "pen.dump", "pen.bin pen.rec", "pen.bin pen.dump"] {
        assert_eq!(bench.json(&format!("devices --decode {own}"))["samples"], by_file["samples"], "{own}");
    }
    let samples = by_file["samples"].as_array().unwrap();
    assert_eq!((samples.len(), &by_file["ignored"]), (100, &json!(0)));
    assert_eq!((&samples[4]["tip"], &samples[5]["tip"]), (&json!(false), &json!(true)));
    let number = |index: usize, name: &str| samples[index][name].as_f64().unwrap();
    assert!((number(50, "x_mm") - 100.0).abs() < 1e-6 && (number(50, "y_mm") - 78.62).abs() < 1e-6);
    assert!((number(50, "t") - 0.5).abs() < 1e-9);
    assert!((number(50, "pressure") - 2048.0 / 4095.0).abs() < 1e-6);
    assert!((number(50, "force_n") - 4.016 * 2048.0 / 4095.0).abs() < 1e-6);
    assert!((number(99, "speed") - 100.0).abs() < 0.1);
}

#[test]
fn a_decoded_stroke_is_a_table_that_renders_the_same() {
    let bench = Bench::new();
    bench.write("pen.rec", recording());
    bench.json("devices --decode pen.rec -o stroke.csv");
    for stroke in ["pen.rec", "stroke.csv"] {
        let rendered =
            bench.json(&format!("render --texture cork --stroke {stroke} --seed 1 -o {stroke}.wav"));
        assert!(rendered["rms"].as_f64().unwrap() > 0.0);
    }
    let ((a, _), (b, _)) = (bench.wav("pen.rec.wav"), bench.wav("stroke.csv.wav"));
    assert_eq!(a.len(), b.len());
    // The table has the same positions and forces up to its last digits.
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-4));
}

/// The JSON object and the table have the same rows, with the same origin of positions and time.
#[test]
fn the_table_says_what_the_object_says() {
    let bench = Bench::new();
    // A clock with an offset, two reports at the same time, and a pen that is temporarily out of range.
    let mut events = events().replace("E: 0.", "E: 1234.").replace("E: 1234.310000", "E: 1234.300000");
    for i in 40..50 {
        events = events.replace(&format!("E: 1234.{i}0000 12 1a 21"), &format!("E: 1234.{i}0000 12 1a 00"));
    }
    bench.write("pen.rec", format!("R: {} {PEN}\nI: 3 0001 0002\n{events}", bytes(PEN).len()));
    let decoded = bench.json("devices --decode pen.rec -o stroke.csv");
    let samples = decoded["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 89);
    assert_eq!((&decoded["out_of_range"], &decoded["same_time"]), (&json!(10), &json!(1)));
    assert_eq!((&decoded["start_s"], &samples[0]["t"]), (&json!(1234.0), &json!(0.0)));
    let table = std::fs::read_to_string(bench.path("stroke.csv")).unwrap();
    let mut lines = table.lines();
    // The impact speed is known of the first report of a contact only.
    assert_eq!(lines.next(), Some("t_s,x_mm,y_mm,force_n,touching,speed_normal"));
    let number = |field: &str| if field.is_empty() { f64::NAN } else { field.parse().unwrap() };
    let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(number).collect()).collect();
    assert_eq!(rows.len(), samples.len());
    for (row, sample) in rows.iter().zip(samples) {
        for (value, name) in row.iter().zip(["t", "x_mm", "y_mm", "force_n"]) {
            // The table has a resolution of one millionth.
            assert!((value - sample[name].as_f64().unwrap()).abs() < 1e-6, "{name}: {value} in {sample}");
        }
        assert_eq!(row[4] == 1.0, sample["tip"] == true);
    }
    assert!((rows[0][1] - 50.0).abs() < 1e-9 && (rows[0][2] - 78.62).abs() < 1e-9, "{:?}", rows[0]);
}

#[test]
fn a_pen_without_a_size_takes_one() {
    let bench = Bench::new();
    let unit = PEN.replace("65 11 55 0d", "65 00 55 00");
    bench.write("pen.rec", recording().replace(PEN, &unit));
    let bare = bench.json("devices --decode pen.rec");
    assert_eq!((&bare["samples"][9]["x_mm"], &bare["size_mm"]), (&json!(null), &json!(null)));
    let sized = bench.json("devices --decode pen.rec --size-mm 209.66x157.25");
    assert_eq!(sized["samples"][50]["x_mm"], 100.0);
    bench.fails("render --texture cork --stroke pen.rec -o a.wav", 1, &["declares no size", "--size-mm"]);
    bench.json("render --texture cork --stroke pen.rec --size-mm 209.66x157.25 -o a.wav");
}

#[test]
fn what_cannot_be_decoded_says_why() {
    let bench = Bench::new();
    bench.write("pen.bin", bytes(PEN));
    bench.write("keyboard.bin", bytes(KEYBOARD));
    bench.write("events.txt", events());
    bench.write("other.txt", "E: 0.0 3 01 02 03\n");
    bench.write("notes.txt", "nothing");
    bench.fails("devices --decode events.txt", 1, &["no pen is declared", "events.txt"]);
    bench.fails("devices --decode keyboard.bin events.txt", 1, &["no pen is declared"]);
    let unlike =
        ["none of the 1 reports", "12 bytes that begin with 1a", "3 bytes and begins with 01", "other.txt"];
    bench.fails("devices --decode pen.bin other.txt", 1, &unlike);
    bench.write("torn.txt", "E: 0.0 12 1a 20 88\nE: 0.1 nonsense\nR: 3 05 0d\n");
    bench.fails("devices --decode pen.bin torn.txt", 1, &["not a recording", "torn.txt"]);
    bench.fails("devices --decode pen.bin notes.txt", 1, &["not a recording", "notes.txt"]);
    bench.fails("devices --decode pen.bin missing.txt", 1, &["missing.txt"]);
    bench.fails("devices --decode missing.bin events.txt", 1, &["missing.bin"]);
    bench.fails("devices --decode pen.bin events.txt -o events.txt", 1, &["overwrite an input file"]);
    bench.fails("devices --decode pen.bin events.txt --size-mm 12", 2, &["width and height"]);
    bench.fails("devices --descriptor pen.bin --decode pen.bin events.txt", 2, &[]);
    bench.fails("devices --size-mm 216x135", 2, &["--decode"]);
    bench.fails("devices --descriptor pen.bin --size-mm 216x135", 2, &["cannot be used with"]);
    bench.fails("devices -o stroke.csv", 2, &["--decode"]);
    bench.fails("devices --descriptor pen.bin -o stroke.csv", 2, &["cannot be used with"]);
    // Both files are named.
    let said = bench.run("devices --decode missing.bin missing.txt");
    assert_eq!((said.code, said.stderr.lines().count()), (1, 2), "{}", said.stderr);
    assert!(said.stderr.contains("missing.bin") && said.stderr.contains("missing.txt"), "{}", said.stderr);
}

/// UTF-16, as some shells write redirected output.
#[test]
fn recordings_in_utf_16_are_read() {
    let bench = Bench::new();
    let wide = |text: &str| -> Vec<u8> {
        format!("\u{feff}{}", text.replace('\n', "\r\n")).encode_utf16().flat_map(u16::to_le_bytes).collect()
    };
    bench.write("pen.rec", recording());
    bench.write("wide.rec", wide(&recording()));
    bench.write("wide.hex", wide(PEN));
    let narrow = bench.json("devices --decode pen.rec");
    assert_eq!(bench.json("devices --decode wide.rec")["samples"], narrow["samples"]);
    assert_eq!(bench.json("devices --decode wide.hex wide.rec")["samples"], narrow["samples"]);
    bench.json("render --texture cork --stroke wide.rec -o a.wav");
}

#[test]
fn descriptors_of_real_devices() {
    let Some(folder) = shared_data("hid-descriptors") else { return };
    let bench = Bench::new();
    let mut files: Vec<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().path().display().to_string())
        .filter(|file| std::path::Path::new(file).extension().is_some_and(|end| end == "bin"))
        .collect();
    files.sort();
    let found = bench.json(&format!("devices --descriptor {}", files.join(" ")));
    let found = found["descriptors"].as_array().unwrap();
    assert_eq!(found.len(), files.len());
    for entry in found {
        assert_eq!(entry["error"], json!(null), "{entry}");
        assert_eq!(entry["pen"], !entry["x"].is_null(), "{entry}");
    }
}

/// A real stroke on a pen whose descriptor declares no pen: positions and speeds are plausible.
#[test]
fn a_recorded_pen_partner_draws_a_plausible_stroke() {
    let Some(file) = shared_data("hid-descriptors/penpartner-hid-recorder.txt") else { return };
    let bench = Bench::new();
    let decoded = bench.json(&format!("devices --decode {}", file.display()));
    let samples = decoded["samples"].as_array().unwrap();
    assert_eq!((samples.len(), &decoded["out_of_range"]), (746, &json!(11)));
    assert!(samples.iter().all(|sample| sample["in_range"] == true));
    let touching = samples.iter().filter(|sample| sample["tip"] == true);
    assert_eq!(touching.clone().count(), 38);
    for sample in touching {
        assert!(sample["pressure"].as_f64().unwrap() > 0.2);
        assert!((0.0..=81.25).contains(&sample["x_mm"].as_f64().unwrap()));
        // The speed limit of handwriting.
        assert!(sample["speed"].as_f64().unwrap() < 1000.0);
    }
    bench.json(&format!("render --texture cork --stroke {} --seed 1 -o a.wav", file.display()));
}

#[test]
fn a_haptic_pen_is_no_pen_to_read_but_an_output() {
    use shagreen_device::haptic_pen::simulated::{LISTING_PEN, STATING_PEN};
    let bench = Bench::new();
    bench.write("listing.bin", LISTING_PEN);
    bench.write("stating.bin", STATING_PEN);
    let found = bench.json("devices --descriptor listing.bin stating.bin");
    let haptic = |index: usize| &found["descriptors"][index]["haptic"];
    assert_eq!(haptic(0), &json!({"entries": 6, "waveforms": [], "intensity": true, "automatic": true}));
    let waveforms = ["click", "ball pen"];
    assert_eq!(
        haptic(1),
        &json!({"entries": 2, "waveforms": waveforms, "intensity": true, "automatic": false})
    );
    let said = bench.run("devices --descriptor listing.bin stating.bin");
    assert!(said.stdout.contains("listing.bin: haptic output with up to 6 waveforms"), "{}", said.stdout);
}

#[test]
fn each_stylus_says_how_it_is_read_and_what_it_provides() {
    let devices = Bench::new().json("devices");
    let styluses = devices["styluses"].as_array().unwrap();
    assert_eq!((&styluses[0]["backend"], &styluses[1]["backend"]), (&json!("mouse"), &json!("window")));
    for stylus in styluses {
        assert!(stylus["provides"].as_str().unwrap().contains("position"), "{stylus}");
        let is_refused = ["denied", "exclusive"].contains(&stylus["access"].as_str().unwrap());
        assert_eq!(stylus["advice"].is_string(), is_refused, "{stylus}");
    }
}
