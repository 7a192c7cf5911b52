//! `shagreen import` and `shagreen export`: recordings and models of other programs.

use std::fmt::Write as _;
use std::path::Path;

use crate::support::Bench;
use serde_json::Value;

const MADE_UP: &str = include_str!("../../vectors/hatt/made_up.xml");
const VECTORS: &str = include_str!("../../vectors/hatt/hatt_vectors.json");

fn floats(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// Returns the largest deviation in dB of a texture's spectrum from the reference spectra of the synthetic model.
fn worst_db(bench: &Bench, library: &str, texture: &str) -> f64 {
    let vectors: Value = serde_json::from_str(VECTORS).unwrap();
    let mut worst = 0.0_f64;
    for case in vectors["cases"].as_array().unwrap() {
        let (speed, force) = (&case["speed_mm_per_s"], &case["force_n"]);
        let psd = bench.json(&format!(
            "texture psd --library {library} --texture {texture} --speed {speed} --force {force} --bins 4000"
        ));
        let (hz, density) = (floats(&psd["hz"]), floats(&psd["psd"]));
        for (f, golden) in floats(&vectors["hz"]).iter().zip(floats(&case["psd"])) {
            // Between two bins an eighth of a hertz apart, the logarithm is nearly linear.
            let above = hz.partition_point(|h| h < f);
            let share = (f - hz[above - 1]) / (hz[above] - hz[above - 1]);
            let ln = density[above - 1].ln() * (1.0 - share) + density[above].ln() * share;
            worst = worst.max((10.0 * std::f64::consts::LOG10_E * (ln - golden.ln())).abs());
        }
    }
    worst
}

#[test]
fn a_published_model_has_the_spectra_of_its_published_rendering() {
    let bench = Bench::new();
    bench.write("Models_Slate.xml", MADE_UP);
    let done = bench.json("import hatt Models_Slate.xml --out slate.json");
    assert_eq!((&done["imported"], done["failed"].as_array().unwrap().len()), (&1.into(), 0));
    assert_eq!(done["textures"][0]["id"], "made-up-slate");
    assert_eq!((&done["textures"][0]["order"], &done["textures"][0]["ma_order"]), (&18.into(), &16.into()));
    let warnings = done["warnings"].to_string();
    assert!(warnings.contains("research"), "{warnings}");
    let worst = worst_db(&bench, "slate.json", "made-up-slate");
    assert!(worst < 0.02, "{worst} dB");
    // Negative control: with the first gain 2.6 times too high (16.15 instead of 6.15) the comparison fails.
    let wrong = MADE_UP.replacen("<gain>", "<gain>1", 1);
    bench.write("wrong.xml", wrong);
    bench.json("import hatt wrong.xml --out wrong.json");
    assert!(worst_db(&bench, "wrong.json", "made-up-slate") > 1.0);
}

#[test]
fn restricted_models_say_so_wherever_they_go() {
    let bench = Bench::new();
    bench.write("Models_Slate.xml", MADE_UP);
    bench.json("import hatt Models_Slate.xml --out slate.json");
    let list = bench.json("library list --library slate.json");
    let terms = list["textures"][0]["licence"].as_str().unwrap();
    assert!(terms.contains("non-profit research"), "{terms}");
    assert_eq!(list["textures"][0]["restricted"], true);
    let said = bench.run("export --library slate.json --texture made-up-slate --format hatt -o again.xml");
    assert_eq!(said.code, 0, "{}", said.stderr);
    assert!(said.stderr.contains("warning") && said.stderr.contains("research"), "{}", said.stderr);
    // After export and import the texture is still restricted, and the same.
    let again = bench.json("import hatt again.xml --out again.json");
    assert_eq!(again["textures"][0]["restricted"], true);
    let worst = worst_db(&bench, "again.json", "made-up-slate");
    assert!(worst < 0.1, "{worst} dB");
}

#[test]
fn own_models_leave_as_hatt_and_come_back() {
    let bench = Bench::new();
    let lost = bench.json("export --texture cork --format hatt -o cork.xml");
    assert!(lost["files"][0].as_str().unwrap().ends_with("cork.xml"), "{lost}");
    let back = bench.json("import hatt cork.xml --out cork.json");
    assert_eq!(back["textures"][0]["restricted"], false, "{back}");
    for (speed, force) in [(30, 0.15), (120, 0.8), (250, 3.0)] {
        let psd = |library: &str| {
            let psd =
                bench.json(&format!("texture psd {library} --texture cork --speed {speed} --force {force}"));
            floats(&psd["psd"])
        };
        for (ours, theirs) in psd("").iter().zip(psd("--library cork.json")) {
            let db = 10.0 * (theirs / ours).log10();
            assert!(db.abs() < 0.1, "{db} dB at {speed} mm/s, {force} N");
        }
    }
}

#[test]
fn all_textures_are_exported_at_once_and_replaced_only_when_that_was_said() {
    let bench = Bench::new();
    let all = "export --all --format hatt -o made";
    let done = bench.json(all);
    let exported = done["exported"].as_array().unwrap();
    assert_eq!((exported.len(), done["files"].as_array().unwrap().len()), (25, 25));
    assert!(exported.iter().any(|one| one["id"] == "cork" && one["files"][0] == "made/cork.xml"), "{done}");
    assert!(done["lost"].as_array().unwrap().contains(&"the tap transient".into()), "{done}");
    // The same files as those of single exports, and importable together.
    bench.json("export --texture cork --format hatt -o cork.xml");
    let bytes = |name: &str| std::fs::read(bench.path(name)).unwrap();
    assert_eq!(bytes("made/cork.xml"), bytes("cork.xml"));
    assert_eq!(bench.json("import hatt made --out back.json")["imported"], 25);

    bench.fails(all, 1, &["25 of the 25 files exist already", "--replace", "made"]);
    let said = bench.run(&format!("{all} --replace"));
    assert_eq!(said.code, 0, "{}", said.stderr);
    assert_eq!(said.stdout.lines().count(), 26, "{}", said.stdout);
    assert!(said.stdout.contains("cork: made/cork.xml\n") && said.stdout.contains("Exported 25 textures"));
    let n_noted = said.stderr.matches("not stored in the files: the tap transient").count();
    assert_eq!(n_noted, 1, "{}", said.stderr);
    bench.write("made/glass.xml", "mine");
    bench.fails(&format!("{all} --replace"), 1, &["would replace a file of another kind", "glass.xml"]);
    bench.fails("export --all --format hatt -o cork.xml", 1, &["folder", "cork.xml"]);
    bench.fails("export --all --texture cork --format hatt -o x", 2, &["--all"]);
    bench.fails("export --format hatt -o x", 2, &["--texture"]);
    // The textures of a project are those of its library and those added to it.
    bench.run("project new --out one.shagreen");
    assert!(bench.path("one.shagreen").exists());
    let of_project = bench.json("export --all --project one.shagreen --format hatt -o of_project");
    assert_eq!(of_project["exported"].as_array().unwrap().len(), 25);
}

#[test]
fn one_bad_model_does_not_keep_the_others_out() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("models")).unwrap();
    bench.write("models/good.xml", MADE_UP);
    bench.write("models/cut.xml", &MADE_UP[..MADE_UP.len() / 2]);
    bench.write("models/other.xml", "<svg/>");
    bench.write("models/notes.txt", "not a model");
    let done = bench.json("import hatt models --out all.json");
    assert_eq!((&done["imported"], done["failed"].as_array().unwrap().len()), (&1.into(), 2), "{done}");
    let other = &done["failed"][1];
    assert!(
        other["file"].as_str().unwrap().ends_with("other.xml")
            && !other["reason"].as_str().unwrap().is_empty()
    );
    bench.fails("import hatt models/other.xml --out none.json", 1, &["nothing was imported"]);
    assert!(!bench.path("none.json").exists());
    bench.fails("import hatt models/good.xml --out models/good.xml", 1, &["overwrite an input file"]);
    // A second import into the same library keeps the first texture.
    bench.json("import hatt models/good.xml --out all.json");
    assert_eq!(bench.json("library list --library all.json")["textures"].as_array().unwrap().len(), 2);
    bench.json("import hatt models/good.xml --out all.json --replace");
    assert_eq!(bench.json("library list --library all.json")["textures"].as_array().unwrap().len(), 2);
}

/// Returns a stroke of 40 s, back and forth at varying speed and force.
fn hand() -> String {
    let mut csv = String::from("t_s,speed_mm_per_s,force_n\n");
    for i in 0..8000 {
        let t = f64::from(i) / 200.0;
        let speed = (120.0 + 100.0 * (0.11 * t).sin()) * (2.2 * t).sin().abs();
        let force = 1.2 + 0.9 * (0.37 * t).sin();
        writeln!(csv, "{t:.3},{speed:.2},{force:.3}").unwrap();
    }
    csv
}

/// Returns a table of a recorded stroke: the signal that `render` makes of a texture, with its speed and force.
pub(crate) fn table(bench: &Bench, texture: &str) -> String {
    bench.write("hand.csv", hand());
    bench
        .json(&format!("render --texture {texture} --stroke hand.csv --rate 1000 --seed 5 -o {texture}.wav"));
    let samples: Vec<f32> = hound::WavReader::open(bench.path(&format!("{texture}.wav")))
        .unwrap()
        .samples()
        .map(Result::unwrap)
        .collect();
    let trace: Value =
        serde_json::from_slice(&std::fs::read(bench.path(&format!("{texture}.json"))).unwrap()).unwrap();
    let column = |name: &str| floats(&trace["trace"][name]);
    let (times, speeds, forces) = (column("time_s"), column("speed_mm_per_s"), column("force_n"));
    let at = |values: &[f64], t: f64| {
        let above = times.partition_point(|time| *time <= t).clamp(1, times.len() - 1);
        let share = ((t - times[above - 1]) / (times[above] - times[above - 1])).clamp(0.0, 1.0);
        values[above - 1] + share * (values[above] - values[above - 1])
    };
    let mut csv = String::from("time;acc;speed [mm/s];force [N]\n");
    for (i, sample) in samples.iter().enumerate() {
        let t = i as f64 / 1000.0;
        let line = format!("{t:.4};{sample:.6};{:.3};{:.4}", at(&speeds, t), at(&forces, t));
        csv.push_str(&line.replace('.', ","));
        csv.push('\n');
    }
    csv
}

#[test]
fn a_recorded_stroke_becomes_the_texture_it_was_made_of() {
    let bench = Bench::new();
    bench.write("stroke.csv", table(&bench, "cork"));
    // The file does not state the unit of acceleration, and it cannot be derived.
    let said = bench.run("import recording stroke.csv --out lib.json --json");
    assert_eq!(said.code, 1, "{}", said.stderr);
    let asked: Value = serde_json::from_str(&said.stdout).unwrap();
    let asks = |key: &str| asked["questions"].as_array().unwrap().iter().any(|q| q["key"] == key);
    assert!(asks("acceleration_unit") && !asks("force_unit"), "{asked}");
    assert!(!bench.path("lib.json").exists());
    bench.write("map.toml", "acceleration_unit = \"m/s^2\"\n");
    let done = bench.json("import recording stroke.csv --out lib.json --map map.toml --report report");
    let figures = &done["textures"][0];
    assert!(figures["segments"].as_u64().unwrap() >= 20, "{figures}");
    assert!(figures["gfc_median"].as_f64().unwrap() > 0.9, "{figures}");
    assert!(figures["level_error_db_median"].as_f64().unwrap() < 1.0, "{figures}");
    assert!(bench.path("report/stroke.svg").exists() && bench.path("report/stroke.csv").exists());
    // Comparison with the model that the stroke was rendered from.
    for (speed, force) in [(80, 0.8), (120, 1.2), (160, 1.6)] {
        let psd =
            |options: &str| bench.json(&format!("texture psd {options} --speed {speed} --force {force}"));
        let (truth, fitted) = (psd("--texture cork"), psd("--library lib.json --texture stroke"));
        let level = 20.0 * (fitted["rms"].as_f64().unwrap() / truth["rms"].as_f64().unwrap()).log10();
        assert!(level.abs() < 1.0, "{level} dB at {speed} mm/s");
        let (a, b) = (floats(&truth["psd"]), floats(&fitted["psd"]));
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        let gfc = dot(&a, &b) / (dot(&a, &a) * dot(&b, &b)).sqrt();
        assert!(gfc > 0.95, "GFC {gfc} at {speed} mm/s");
    }
}

/// A page of plots and a table are written for every texture, and never replace a recording.
#[test]
fn reports_have_names_of_their_own() {
    let bench = Bench::new();
    for folder in ["a", "b"] {
        std::fs::create_dir(bench.path(folder)).unwrap();
        bench.json(&format!(
            "render --texture cork --speed 90 --force 1 --seconds 3 --rate 1000 -o {folder}/run.wav"
        ));
    }
    let done = bench.json("import recording a/run.wav b/run.wav --out lib.json --report plots");
    let ids: Vec<&str> =
        done["textures"].as_array().unwrap().iter().map(|t| t["id"].as_str().unwrap()).collect();
    assert_eq!(ids, ["run", "run-2"]);
    for id in ids {
        assert!(
            bench.path(&format!("plots/{id}.svg")).exists()
                && bench.path(&format!("plots/{id}.csv")).exists()
        );
    }
    bench.write("a/wood.csv", "t_ms,acc_m/s2\n");
    let mut table = String::from("time_s,acc [m/s^2],speed [mm/s],force [N]\n");
    for i in 0..3000 {
        let (t, a) = (f64::from(i) / 1000.0, (f64::from(i * i % 1999) * 0.37).sin());
        writeln!(table, "{t:.3},{a:.5},100,1").unwrap();
    }
    bench.write("a/wood.csv", &table);
    let said = bench.run("import recording a/wood.csv --out wood.json --report a");
    assert_eq!(said.code, 1, "{}", said.stderr);
    assert!(said.stderr.contains("overwrite an input file"), "{}", said.stderr);
    assert_eq!(std::fs::read_to_string(bench.path("a/wood.csv")).unwrap(), table);
    // Unrelated files are not replaced either.
    bench.write("b/wood.csv", "mine");
    assert_eq!(bench.run("import recording a/wood.csv --out wood.json --report b").code, 1);
    bench.fails("export --texture cork --format hatt -o b/wood.csv", 1, &["would replace"]);
    assert_eq!(std::fs::read(bench.path("b/wood.csv")).unwrap(), b"mine");
    bench.fails("import recording a/wood.csv --out none/wood.json", 1, &["does not exist"]);
    bench.fails(
        "import recording a/wood.csv --out x.json --set speed=v --set speed=w",
        2,
        &["two values for speed"],
    );
}

#[test]
fn a_rendered_file_with_its_sidecar_needs_no_answers() {
    let bench = Bench::new();
    let _ = table(&bench, "denim");
    let done = bench.json("import recording denim.wav --out denim-again.json");
    assert_eq!(done["questions"].as_array().unwrap().len(), 0, "{done}");
    assert!(done["textures"][0]["gfc_median"].as_f64().unwrap() > 0.9, "{done}");
}

/// Returns three seconds of noise as a table with this header and one glitch.
fn glitched(header: &str) -> String {
    let mut table = format!("{header}\n");
    for i in 0..3000 {
        let (t, a) = (f64::from(i) / 1000.0, (f64::from(i * i % 1999) * 0.37).sin());
        writeln!(table, "{t:.3},{:.5},100,1.5", if i == 1234 { 480.0 } else { a }).unwrap();
    }
    table
}

#[test]
fn what_is_odd_in_a_recording_is_said() {
    let bench = Bench::new();
    bench.write("a.csv", glitched("Time in s,Acceleration in m/s^2,Speed in mm/s,Force in N"));
    let said = bench.run("import recording a.csv --out a.json");
    assert_eq!(said.code, 0, "{}", said.stderr);
    for words in ["spikes: 1 electrical glitch in acceleration, up to 480.0 m/s²", "first at 1.234 s"] {
        assert!(said.stderr.contains(words), "{}", said.stderr);
    }
    bench.write("map.toml", "speed = \"w\"\n");
    let said = bench.run(
        "import recording a.csv --out b.json --map map.toml --set speed=100mm/s --set acceleration_unit=g",
    );
    for words in [
        "note: --set speed=100mm/s overrides \"w\" of the column map",
        "the unit of Acceleration in m/s^2 is m/s^2; the column map states g, which is used",
        "\"Speed in mm/s\" is not used, because a constant speed is stated",
    ] {
        assert!(said.stderr.contains(words), "{}", said.stderr);
    }
    // Without a header, guesses are reported even if there are open questions.
    bench.write("bare.csv", glitched("").trim_start());
    let said = bench.run("import recording bare.csv --out c.json");
    assert!(
        said.code == 1 && said.stderr.contains("guessed time: the time column is not stated"),
        "{}",
        said.stderr
    );
    // The reason is stated once; the findings are separate.
    bench.write("zero.csv", format!("t_s,a [g],v [mm/s],F [N]\n{}", "0,0,100,1\n0.001,0,100,1\n"));
    let done = bench.run("import recording zero.csv --out d.json --json");
    let done: Value = serde_json::from_str(&done.stdout).unwrap();
    let reason = done["failed"][0]["reason"].as_str().unwrap();
    assert!(reason.starts_with("no signal: ") && !reason.contains("dead axis"), "{reason}");
    assert!(done["warnings"].to_string().contains("dead axis"), "{done}");
}

/// A gain that is switched during a recording is a warning.
#[test]
fn a_level_that_jumps_is_said() {
    let bench = Bench::new();
    let table = |gain: f64| {
        let noise = shagreen_core::maths::rng::lcg_noise(8000, 3);
        let mut text = "t_s,a [m/s^2],v [mm/s],F [N]\n".to_owned();
        let mut smooth = 0.0;
        for (i, x) in noise.iter().enumerate() {
            smooth = 0.7 * smooth + x;
            let a = smooth * if i < 4000 { 1.0 } else { gain };
            writeln!(text, "{:.3},{a:.5},100,1", i as f64 / 1000.0).unwrap();
        }
        text
    };
    for (gain, is_said) in [(4.0, true), (1.0, false)] {
        bench.write("one.csv", table(gain));
        let done = bench.json("import recording one.csv --out one.json --replace");
        let warnings = done["warnings"].to_string();
        assert_eq!(warnings.contains("one.csv: The level rises by 1"), is_said, "{warnings}");
    }
}

/// Noise with a line at 50 Hz, at four speeds; the same 50 times stronger is in a wrong unit.
#[test]
fn hum_wrong_units_and_what_the_model_rate_loses_are_said() {
    let bench = Bench::new();
    let table = |scale: f64, hum: f64| {
        let noise = shagreen_core::maths::rng::lcg_noise(32_000, 3);
        let mut text = "t_s,a [m/s^2],v [mm/s],F [N]\n".to_owned();
        let mut smooth = 0.0;
        for (i, x) in noise.iter().enumerate() {
            smooth = 0.7 * smooth + x;
            let t = i as f64 / 2000.0;
            let a = scale * (smooth + hum * (std::f64::consts::TAU * 50.0 * t).sin());
            writeln!(text, "{t:.4},{a:.5},{},1", 50 * (1 + i / 8000)).unwrap();
        }
        text
    };
    bench.write("hum.csv", table(1.0, 1.0));
    let done = bench.json("import recording hum.csv --out hum.json --rate 1000");
    let warnings = done["warnings"].to_string();
    assert!(
        warnings.contains("mains hum: line at 50 Hz") && warnings.contains("at every tip speed"),
        "{done}"
    );
    let notes = done["notes"].to_string();
    assert!(
        notes.contains("model rate 1000 Hz, order") && notes.contains("--rate 2000 keeps more"),
        "{notes}"
    );
    bench.write("loud.csv", table(500.0, 0.0));
    let done = bench.json("import recording loud.csv --out loud.json");
    let warnings = done["warnings"].to_string();
    assert!(warnings.contains("implausible acceleration") && !warnings.contains("mains hum"), "{done}");
    assert!(!done["notes"].to_string().contains("keeps more"), "{done}");
}

#[test]
fn three_axes_are_ordinary() {
    let bench = Bench::new();
    let mut text = "t_s,ax [m/s^2],ay [m/s^2],az [m/s^2],v [mm/s],F [N]\n".to_owned();
    for i in 0..6000 {
        let wave = (0.9 * f64::from(i)).sin() + 0.5 * (0.31 * f64::from(i * i % 977)).sin();
        let (t, b, c) = (f64::from(i) / 1000.0, 0.5 * wave, 0.2 * wave);
        writeln!(text, "{t:.4},{wave:.4},{b:.4},{c:.4},100,1").unwrap();
    }
    bench.write("axes.csv", text);
    let said = bench.run("import recording axes.csv --out axes.json --json");
    assert_eq!(said.code, 0, "{said:?}");
    let done: Value = serde_json::from_str(&said.stdout).unwrap();
    assert!(done["notes"].to_string().contains("axes combined"), "{done}");
    assert!(!done["warnings"].to_string().contains("axes combined"), "{done}");
    let is_note = |line: &str| line.starts_with("note: ") && line.contains("axes combined");
    assert!(said.stderr.lines().any(is_note), "{}", said.stderr);
}

#[test]
fn a_folder_is_the_recordings_in_it() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("strokes")).unwrap();
    std::fs::create_dir(bench.path("empty")).unwrap();
    let table = glitched("t_s,a [m/s^2],v [mm/s],F [N]");
    bench.write("strokes/b.csv", &table);
    bench.write("strokes/c.TXT", &table);
    bench.json("render --texture cork --speed 90 --force 1 --seconds 3 --rate 1000 -o strokes/a.wav");
    bench.write("strokes/notes.md", "not a recording");
    assert!(bench.path("strokes/a.json").exists());
    let done = bench.json("import recording strokes --out lib.json");
    let ids: Vec<&str> =
        done["textures"].as_array().unwrap().iter().map(|t| t["id"].as_str().unwrap()).collect();
    assert_eq!((ids, done["failed"].as_array().unwrap().len()), (vec!["a", "b", "c"], 0), "{done}");
    let done = bench.json("import recording strokes --name All --out one.json");
    assert_eq!((&done["imported"], done["textures"][0]["files"].as_array().unwrap().len()), (&1.into(), 3));
    bench.fails("import recording empty --out none.json", 1, &["the folder contains no recording", "empty"]);
    for out in [".", "strokes"] {
        bench.fails(
            &format!("import recording strokes/b.csv --out {out}"),
            2,
            &["--out is a folder", "mine.json"],
        );
    }
    bench.fails("import recording strokes --out strokes/b.csv", 1, &["overwrite an input file"]);
}

/// Before, of eight imports at once only one texture was left.
#[test]
fn imports_at_the_same_time_into_one_library_lose_nothing() {
    let bench = Bench::new();
    bench.write("Models_Slate.xml", MADE_UP);
    for out in ["new.json", "old.json"] {
        if out == "old.json" {
            bench.json("import hatt Models_Slate.xml --out old.json");
        }
        let commands = (0..8).map(|_| {
            let mut command = bench.command(&format!("import hatt Models_Slate.xml --out {out}"));
            command.stdout(std::process::Stdio::null()).stderr(std::process::Stdio::null()).spawn().unwrap()
        });
        let running: Vec<_> = commands.collect();
        for mut import in running {
            assert!(import.wait().unwrap().success());
        }
        let library: Value = serde_json::from_slice(&std::fs::read(bench.path(out)).unwrap()).unwrap();
        let textures = library["textures"].as_array().unwrap();
        let mut ids: Vec<&str> = textures.iter().map(|texture| texture["id"].as_str().unwrap()).collect();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), if out == "new.json" { 8 } else { 9 }, "{out}: {ids:?}");
    }
    // A texture with the same identifier is still replaced where that was said.
    bench.json("import hatt Models_Slate.xml --out new.json --replace");
    let library: Value = serde_json::from_slice(&std::fs::read(bench.path("new.json")).unwrap()).unwrap();
    assert_eq!(library["textures"].as_array().unwrap().len(), 8);
}

/// Real recordings that lack what a model needs: every reason is named, and no value is invented.
#[test]
fn real_recordings_that_cannot_be_modelled_say_why() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/recordings");
    if !folder.is_dir() {
        println!("skipped: ../shared/data/recordings does not exist");
        return;
    }
    let bench = Bench::new();
    for (files, words) in [
        (
            [
                "hapmat/Fabric.csv",
                "hapmat/Leather.csv",
                "hapmat/Metal.csv",
                "hapmat/Paper.csv",
                "hapmat/Wood.csv",
            ]
            .as_slice(),
            ["acceleration_unit", "speed", "force", "100", "500"].as_slice(),
        ),
        (
            ["force-press-slide/Material_Metal_raw_1.csv", "force-press-slide/Material_Wood_raw_1.csv"]
                .as_slice(),
            ["no acceleration", "bad clock"].as_slice(),
        ),
    ] {
        for file in files {
            let path = folder.join(file);
            let said = bench.run(&format!("import recording {} --out none.json --json", path.display()));
            assert_eq!(said.code, 1, "{said:?}");
            let done: Value = serde_json::from_str(&said.stdout).unwrap();
            assert_eq!(done["imported"], 0);
            let all = format!("{} {} {}", done["failed"], done["warnings"], done["questions"]);
            for word in words {
                assert!(all.contains(word), "{file} lacks \"{word}\": {all}");
            }
            assert!(!bench.path("none.json").exists());
        }
    }
}

#[test]
fn a_texture_without_a_name_is_refused() {
    let bench = Bench::new();
    for name in ["", " "] {
        let mut command = bench.command("import recording stroke.csv --out library.json --name");
        let output = command.arg(name).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && said.contains("a texture needs a name"), "{said}");
    }
}
