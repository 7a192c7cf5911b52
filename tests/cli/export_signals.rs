//! `shagreen export` in formats of signals.

use crate::support::Bench;

use serde_json::Value;
use shagreen_formats::ahap::AhapPattern;
use shagreen_formats::haptic_clip::{ClipRules, HapticClip};

/// Lands after 0.3 s and stays in contact.
const STROKE: &str = "t_s,speed_mm/s,force_N\n0,100,0\n0.3,100,0\n0.31,100,1\n1,100,1\n";

fn value(bench: &Bench, name: &str) -> Value {
    serde_json::from_slice(&std::fs::read(bench.path(name)).unwrap()).unwrap()
}

fn clip(bench: &Bench, name: &str) -> HapticClip {
    HapticClip::from_json(&std::fs::read(bench.path(name)).unwrap(), ClipRules::Strict).unwrap()
}

#[test]
fn a_wav_file_is_that_of_render() {
    let bench = Bench::new();
    bench.write("s.csv", STROKE);
    for options in [
        "--speed 80 --force 0.5 --seconds 0.5",
        "--stroke s.csv",
        "--rate 8000 --bits 24",
        "--loop --normalize",
    ] {
        let motion = if options.contains("--s") { "" } else { "--speed 100 --force 1 --seconds 2" };
        bench.json(&format!("render --texture cork {options} {motion} -o rendered.wav"));
        let done = bench.json(&format!("export --texture cork --format wav {options} -o exported.wav"));
        assert_eq!(done["files"].as_array().unwrap().len(), 2, "{done}");
        for ending in ["wav", "json"] {
            let bytes = |name: &str| std::fs::read(bench.path(&format!("{name}.{ending}"))).unwrap();
            assert_eq!(bytes("exported"), bytes("rendered"), "{options}, {ending}");
        }
    }
}

#[test]
fn a_silent_signal_is_warned_of_and_a_loop_has_no_seam() {
    let bench = Bench::new();
    for (motion, words) in
        [("--speed 0 --force 1", "the speed is 0"), ("--speed 100 --force 0", "the force is 0")]
    {
        for command in
            ["render --texture cork -o a.wav", "export --texture cork --format haptic --replace -o a.haptic"]
        {
            let said = bench.run(&format!("{command} {motion} --seconds 0.2"));
            let warned = said.stderr.contains("warning: ") && said.stderr.contains(words);
            assert!(said.code == 0 && warned, "{command}: {}", said.stderr);
        }
    }
    bench.json("export --texture cork --format wav --loop --seconds 0.5 -o loop.wav");
    assert_eq!(value(&bench, "loop.json")["loop"], true);
    bench.json("export --texture cork --format haptic --loop --seconds 0.5 -o loop.haptic");
    let clip = clip(&bench, "loop.haptic");
    assert_eq!(clip.amplitude[0].amplitude, clip.amplitude.last().unwrap().amplitude);
    assert_eq!(clip.frequency[0].frequency, clip.frequency.last().unwrap().frequency);
}

#[test]
fn every_format_of_signals_is_written_and_says_what_is_lost() {
    let bench = Bench::new();
    for (format, ending, lost) in [
        ("wav", "wav", "all tip speeds"),
        ("haptic", "haptic", "the fine structure"),
        ("ahap", "ahap", "the spectrum"),
        ("android", "android.json", "short events"),
        ("openxr", "openxr.json", "the acceleration in m/s²"),
    ] {
        let command = format!("export --texture cork --format {format} -o cork.{ending}");
        let said = bench.run(&command);
        assert_eq!(said.code, 0, "{}", said.stderr);
        assert!(said.stderr.contains(&format!("note: not stored in the file: {lost}")), "{}", said.stderr);
        let done = bench.json(&format!("{command} --replace"));
        assert_eq!(done["files"][0], format!("cork.{ending}"), "{done}");
        assert_eq!((&done["seconds"], &done["licence"].is_string()), (&2.0.into(), &true), "{done}");
        assert!(
            done["lost"].as_array().unwrap().len() > 1 && done["warnings"].as_array().unwrap().is_empty()
        );
    }
    let clip = clip(&bench, "cork.haptic");
    assert!((clip.end_secs() - 2.0).abs() < 1e-9 && clip.amplitude.iter().any(|point| point.amplitude > 0.9));
    assert!(
        clip.metadata.editor.starts_with("shagreen")
            && clip.metadata.description.contains("MIT OR Apache-2.0")
    );
    assert!(clip.amplitude.iter().all(|point| point.emphasis.is_none()), "a steady motion has no onset");
    assert!(!bench.path("cork.transients.ahap").exists());
}

#[test]
fn a_landing_is_an_emphasis_and_a_pattern_of_its_own() {
    let bench = Bench::new();
    bench.write("s.csv", STROKE);
    bench.json("export --texture cork --format haptic --stroke s.csv -o cork.haptic");
    let clip = clip(&bench, "cork.haptic");
    let landings: Vec<f64> =
        clip.amplitude.iter().filter(|point| point.emphasis.is_some()).map(|point| point.time_secs).collect();
    assert!(landings.len() == 1 && (landings[0] - 0.305).abs() < 0.02, "{landings:?}");
    let done = bench.json("export --texture cork --format ahap --stroke s.csv -o cork.ahap");
    assert_eq!(done["files"][1], "cork.transients.ahap");
    let bytes = std::fs::read(bench.path("cork.transients.ahap")).unwrap();
    assert_eq!(AhapPattern::from_json(&bytes).unwrap().value.events.len(), 1);
    let openxr = bench.json("export --texture cork --format openxr --stroke s.csv -o cork.openxr.json");
    assert_eq!(
        openxr["lost"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|lost| lost.as_str().unwrap().contains("decay"))
            .count(),
        1
    );
    assert_eq!(value(&bench, "cork.openxr.json")["calls"][0]["transients"].as_array().unwrap().len(), 1);
}

#[test]
fn an_actuator_gives_its_band_and_its_configuration() {
    let bench = Bench::new();
    let actuators = bench.json("actuator list");
    let known =
        actuators["actuators"].as_array().unwrap().iter().find(|one| one["f0_hz"].is_number()).unwrap();
    let id = known["id"].as_str().unwrap();
    let done = bench.json(&format!("export --texture cork --format haptic --actuator {id} -o cork.haptic"));
    assert_eq!(done["files"], serde_json::json!(["cork.haptic", "cork.acf"]));
    bench.json(&format!("actuator acf {id} -o same.acf"));
    assert_eq!(value(&bench, "cork.acf"), value(&bench, "same.acf"));
    bench.json(&format!("export --texture cork --format openxr --actuator {id} -o cork.openxr.json"));
    let highest = &value(&bench, "same.acf")["continuous"]["frequency_max"];
    assert_eq!(&value(&bench, "cork.openxr.json")["max_frequency_hz"], highest);
    bench.fails(
        &format!("export --texture cork --format wav --actuator {id} -o a.wav"),
        2,
        &["--actuator", "haptic"],
    );
}

#[test]
fn all_textures_have_one_full_scale_and_are_replaced_only_when_that_was_said() {
    let bench = Bench::new();
    let all = "export --all --format haptic --seconds 0.3 -o made";
    let done = bench.json(all);
    let exported = done["exported"].as_array().unwrap();
    assert_eq!((exported.len(), done["files"].as_array().unwrap().len()), (25, 25));
    assert!(exported.iter().all(|one| one["full_scale"] == exported[0]["full_scale"]), "{done}");
    let highest = |id: &Value| {
        let clip = clip(&bench, &format!("made/{}.haptic", id.as_str().unwrap()));
        clip.amplitude.iter().map(|point| point.amplitude).fold(0.0, f64::max)
    };
    let levels: Vec<f64> = exported.iter().map(|one| highest(&one["id"])).collect();
    assert!(
        levels.iter().any(|level| *level > 0.99) && levels.iter().any(|level| *level < 0.5),
        "{levels:?}"
    );
    bench.fails(all, 1, &["25 of the 25 files exist already", "--replace", "made"]);
    bench.json(&format!("{all} --replace"));
    bench.write("made/glass.haptic", "mine");
    bench.fails(&format!("{all} --replace"), 1, &["would replace a file of another kind", "glass.haptic"]);
    assert_eq!(std::fs::read(bench.path("made/glass.haptic")).unwrap(), b"mine");
}

/// Nothing marks a clip as an export that nobody has changed.
#[test]
fn an_existing_clip_or_model_is_replaced_only_when_that_was_said() {
    let bench = Bench::new();
    let formats = [
        ("haptic --seconds 0.3", "own.haptic"),
        ("ahap --seconds 0.3", "own.ahap"),
        ("android --seconds 0.3", "own.android.json"),
        ("openxr --seconds 0.3", "own.openxr.json"),
        ("hatt", "own.xml"),
        ("runtime", "own.shgt"),
    ];
    for (format, file) in formats {
        let export = |texture: &str| format!("export --texture {texture} --format {format} -o {file}");
        let bytes = || std::fs::read(bench.path(file)).unwrap();
        bench.json(&export("cork"));
        let before = bytes();
        bench.fails(&export("brick"), 1, &["exist", "already", "--replace", file]);
        assert_eq!(bytes(), before, "{format}");
        bench.json(&format!("{} --replace", export("brick")));
        assert_ne!(bytes(), before, "{format}");
    }
}

#[test]
fn authored_textures_and_points_are_exported_as_they_are_rendered() {
    let bench = Bench::new();
    bench.json("project new --from ways-to-blend -o ways.shagreen");
    let field = "--project ways.shagreen --authored Field";
    for what in [field, "--project ways.shagreen --authored Shared", "--at 30,70"] {
        bench.json(&format!("render {what} --speed 100 --force 1 --seconds 0.3 -o rendered.wav"));
        bench.json(&format!("export {what} --format wav --seconds 0.3 -o exported.wav"));
        for ending in ["wav", "json"] {
            let bytes = |name: &str| std::fs::read(bench.path(&format!("{name}.{ending}"))).unwrap();
            assert_eq!(bytes("exported"), bytes("rendered"), "{what}, {ending}");
        }
    }
    let done = bench.json(&format!("export {field} --format haptic --seconds 0.3 -o field.haptic"));
    assert_eq!(done["files"][0], "field.haptic");
    let said = bench.run(&format!("export {field} --format hatt -o field.xml"));
    assert!(said.code == 0 && said.stdout.contains("Wrote \"Field\" as hatt"), "{said:?}");
    bench.fails(
        "export --project ways.shagreen --authored Shared --format hatt -o shared.xml",
        1,
        &["no single texture model"],
    );
    bench.fails("export --authored Field --format hatt -o a.xml", 2, &["--project"]);
    bench.fails("export --all --at 30,70 --format hatt -o a", 2, &["--all"]);
    let said = bench.run("export --all --project ways.shagreen --format hatt -o all");
    assert!(said.code == 0 && said.stderr.contains("note: left out: "), "{said:?}");
}

#[test]
fn what_cannot_be_exported_is_refused_before_anything_is_written() {
    let bench = Bench::new();
    bench.write("s.csv", STROKE);
    bench.write("notes.haptic", "mine");
    let before = bench.files();
    for (rest, code, words) in [
        ("--texture cork --format haptic -o cork.wav", 1, &["Haptic clip", ".haptic"][..]),
        ("--texture cork --format haptic -o notes.haptic", 1, &["would replace", "notes.haptic"]),
        ("--texture cork --format wav --stroke s.csv -o s.csv", 1, &["s.csv"]),
        ("--texture crok --format wav -o a.wav", 1, &["crok", "cork"]),
        ("--texture cork --format haptic --bits 16 -o a.haptic", 2, &["--bits", "haptic"]),
        ("--texture cork --format hatt --speed 50 -o a.xml", 2, &["--speed", "hatt"]),
        ("--texture cork --format hatt --rate 8000 -o a.xml", 2, &["--rate", "hatt"]),
        ("--texture cork --format wav --stroke s.csv --speed 50 -o a.wav", 2, &["--speed"]),
        ("--texture cork --format none -o a", 2, &["none", "haptic"]),
        ("--all --format ahap -o notes.haptic", 1, &["folder", "notes.haptic"]),
        ("--texture cork --format android -o ", 2, &["--out"]),
        ("--texture cork --format wav -o -", 2, &["--out", "standard output"]),
        ("--texture cork --format hatt -o -", 2, &["--out", "standard output"]),
        ("--texture cork --format android -o missing/a.android.json", 1, &["missing"]),
    ] {
        bench.fails(&format!("export {rest}"), code, words);
        assert_eq!(bench.files(), before, "{rest}");
    }
}
