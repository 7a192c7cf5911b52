//! Spaces with one to six axes: `--axes`, points by the names of the axes, and `shagreen evaluate axes`.

use crate::support::Bench;
use serde_json::{Value, json};

/// Three axes that the simulated library knows.
const THREE: &str = "--library simulated --axes rough-smooth,hard-soft,sticky-slippery";

fn psd(bench: &Bench, what: &str) -> Value {
    bench.json(&format!("texture psd {what} --speed 80 --force 0.6 --bins 40"))
}

/// Position of a texture on three axes, as arguments in the order of the axes and by name.
fn point_of(bench: &Bench, id: &str) -> [String; 2] {
    let list = bench.json(&format!("library list {THREE}"));
    let found = list["textures"].as_array().unwrap().iter().find(|texture| texture["id"] == id).unwrap();
    let [rough, hard, sticky] = [0, 1, 2].map(|axis| found["at"][axis].as_f64().unwrap());
    let named = format!("sticky-slippery={sticky},rough-smooth={rough},hard-soft={hard}");
    [format!("{rough},{hard},{sticky}"), named]
}

#[test]
fn a_third_axis_gives_another_texture_and_order_and_names_the_same_one() {
    let bench = Bench::new();
    let [ordered, named] = point_of(&bench, "cork");
    let three = psd(&bench, &format!("{THREE} --at {ordered}"));
    assert_eq!(psd(&bench, &format!("--library simulated --at {named}")), three);
    assert_eq!(psd(&bench, &format!("{THREE} --at {named}")), three);
    let coordinates: Vec<f64> = ordered.split(',').map(|text| text.parse().unwrap()).collect();
    assert_eq!((&three["at"], &three["clamped"]), (&json!(coordinates), &false.into()));
    assert_eq!(three["at_named"]["sticky-slippery"], coordinates[2]);
    let two = psd(&bench, &format!("--library simulated --at {},{}", coordinates[0], coordinates[1]));
    assert_eq!(two["at"].as_array().unwrap().len(), 2);
    assert_ne!(two["psd"], three["psd"]);
    // The third coordinate matters.
    let moved = format!("{},{},{}", coordinates[0], coordinates[1], 0.5 * coordinates[2]);
    assert_ne!(psd(&bench, &format!("{THREE} --at {moved}"))["psd"], three["psd"]);
    let render = |point: &str| {
        let said = bench.json(&format!("render {point} --speed 100 --force 1 --seconds 0.2 -o out.wav"));
        let sidecar: Value = serde_json::from_slice(&std::fs::read(bench.path("out.json")).unwrap()).unwrap();
        assert_eq!((&sidecar["at"], &sidecar["at_named"]), (&said["at"], &said["at_named"]));
        (bench.wav("out.wav").0, sidecar["at"].clone())
    };
    let (sound, at) = render(&format!("{THREE} --at {ordered}"));
    assert_eq!(at, json!(coordinates));
    assert_eq!(three["at_named"].as_object().unwrap().len(), 3);
    assert_ne!(render(&format!("--library simulated --at {},{}", coordinates[0], coordinates[1])).0, sound);
}

#[test]
fn the_two_axes_of_the_positions_by_name_change_no_sample() {
    let bench = Bench::new();
    let rendered = |point: &str| {
        bench.json(&format!("render {point} --speed 100 --force 1 --seconds 0.2 -o out.wav"));
        ["out.wav", "out.json"].map(|name| std::fs::read(bench.path(name)).unwrap())
    };
    let before = rendered("--at 45,40");
    for point in [
        "--at rough-smooth=45,hard-soft=40",
        "--at hard-soft=40,rough-smooth=45",
        "--axes rough-smooth,hard-soft --at 45,40",
    ] {
        assert!(rendered(point) == before, "{point}");
    }
    let named = psd(&bench, "--at 45,40")["at_named"].clone();
    assert_eq!(named, json!({"rough-smooth": 45.0, "hard-soft": 40.0}));
    assert!(psd(&bench, "--texture cork")["at_named"].is_null());
}

#[test]
fn a_note_says_that_axes_do_not_change_a_texture_of_the_library() {
    let bench = Bench::new();
    let said =
        |axes: &str| bench.run(&format!("texture psd --texture cork {axes} --speed 80 --force 0.6 --json"));
    let (plain, on_axes) = (said(""), said("--axes rough-smooth,centroid"));
    assert_eq!((on_axes.code, &on_axes.stdout), (0, &plain.stdout), "{on_axes:?}");
    let note = "note: the axes of --axes do not change the texture of --texture";
    assert!(on_axes.stderr.contains(note) && !plain.stderr.contains(note), "{on_axes:?}");
}

/// The example of the guide plays inside the convex hull of the starter library.
#[test]
fn the_path_of_the_guide_lies_inside_the_hull() {
    let page = include_str!("../../docs/guide/more-axes.md");
    let line = page.lines().find(|line| line.starts_with("shagreen texture path")).expect("an example");
    let bench = Bench::new();
    let made = bench.json(line.trim_start_matches("shagreen "));
    assert_eq!((&made["clamped"], &made["warnings"]), (&json!(0), &json!([])), "{made}");
}

#[test]
fn an_axis_that_is_not_named_has_its_local_mean_and_a_note_says_so() {
    let bench = Bench::new();
    let said = bench.run("texture psd --at centroid=50 --extrapolate --speed 80 --force 0.6 --json");
    assert_eq!(said.code, 0, "{said:?}");
    for axis in ["rough-smooth", "hard-soft"] {
        assert!(said.stderr.contains(&format!("note: {axis} is not given; its local mean is")), "{said:?}");
    }
    let psd: Value = serde_json::from_str(&said.stdout).unwrap();
    assert_eq!(psd["at"].as_array().unwrap().len(), 3);
    // One axis alone is a space too.
    let one = bench.json("texture psd --axes centroid --at 60 --speed 80 --force 0.6");
    assert_eq!(one["at"].as_array().unwrap().len(), 1);
    assert!((one["at_named"]["centroid"].as_f64().unwrap() - 60.0).abs() < 1e-9, "{one}");
}

#[test]
fn wrong_axes_and_points_are_named() {
    let bench = Bench::new();
    let fails = |what: &str, code: i32, words: &[&str]| {
        bench.fails(&format!("texture psd {what} --speed 80 --force 0.6"), code, words);
    };
    fails("--at rough-smooth=30,warm-cold=5", 1, &["\"warm-cold\"", "hard-soft", "tap frequency"]);
    fails("--axes rough-smoth,hard-soft --at 1,2", 1, &["did you mean \"rough-smooth\""]);
    fails("--axes centroid,centroid --at 1,2", 1, &["\"centroid\"", "twice"]);
    let seven =
        "rough-smooth,hard-soft,flat-bumpy,sticky-slippery,irritating-pleasant,centroid,tap-frequency";
    fails(&format!("--library simulated --axes {seven} --at 1,2,3,4,5,6,7"), 1, &["1 to 6 axes", "7"]);
    fails("--at 30,70,45", 2, &["3 coordinates", "2 axes (rough-smooth, hard-soft)", "--axes"]);
    fails(&format!("{THREE} --at 30,70"), 2, &["2 coordinates", "3 axes"]);
    fails("--axes rough-smooth,hard-soft --at centroid=4", 2, &["\"centroid\"", "add it to --axes"]);
    fails("--axes hard-soft,centroid --at 30,130", 2, &["centroid is 130", "0 and 100", "dull"]);
    fails("--at hard-soft=-1", 2, &["hard-soft is -1", "100 = soft"]);
    fails("--at hard-soft=3,70", 2, &["\"70\" has no name"]);
    fails(
        "--axes rough-smooth,hard-soft,centroid --at 3,4,5 --blend shared",
        1,
        &["mode shared interpolates in triangles", "choose mode field, or fewer axes"],
    );
}

#[test]
fn a_library_lists_the_axes_that_it_knows() {
    let bench = Bench::new();
    let known = |library: &str| {
        let list = bench.json(&format!("library list {library}"));
        assert_eq!(list["axes"], json!(["rough-smooth", "hard-soft"]));
        list["known_axes"].as_array().unwrap().clone()
    };
    let names = |known: &[Value]| known.iter().map(|axis| axis["name"].clone()).collect::<Vec<_>>();
    let starter = known("");
    let computed = ["centroid", "speed exponent", "force exponent", "tap frequency"];
    let expected: Vec<&str> = ["rough-smooth", "hard-soft"].into_iter().chain(computed).collect();
    assert_eq!(names(&starter), expected);
    assert!(starter.iter().all(|axis| axis["textures"] == 25), "{starter:?}");
    assert_ne!(starter[0]["source"], starter[2]["source"]);
    assert!(names(&known("--library simulated")).contains(&json!("sticky-slippery")));
    let said = bench.run("library list --axes tap-frequency").stdout;
    assert!(said.contains("axes: tap frequency") && said.contains("known axes"), "{said}");
    let range = starter[2]["range"].as_array().unwrap();
    let [low, high] = [0, 1].map(|end| range[end].as_f64().unwrap());
    assert!(0.0 < low && low < high && high < 100.0, "{range:?}");
    assert!(said.contains(&format!("centroid (vibration, 25, {low:.0} to {high:.0})")), "{said}");
}

#[test]
fn positions_on_three_axes_are_written_to_a_table_and_a_library() {
    let bench = Bench::new();
    let axes = "rough-smooth,hard-soft,centroid";
    bench.json(&format!("library places --axes {axes} --out p.csv"));
    let table = std::fs::read_to_string(bench.path("p.csv")).unwrap();
    assert!(table.starts_with("id,x:rough-smooth,y:hard-soft,z:centroid,source"), "{table}");
    let placed = bench.json("space place --attributes p.csv --out l.json");
    assert_eq!(placed["axes"], json!(["rough-smooth", "hard-soft", "centroid"]));
    let written: Value = serde_json::from_slice(&std::fs::read(bench.path("l.json")).unwrap()).unwrap();
    assert_eq!(written["version"], "1.8");
    let list = bench.json("library list --library l.json");
    assert_eq!((&list["axes"], list["textures"][3]["at"].as_array().unwrap().len()), (&placed["axes"], 3));
    // A table has six digits.
    let level = |what: &str| psd(&bench, &format!("{what} --at 45,40,50"))["rms"].as_f64().unwrap();
    let (of_file, direct) = (level("--library l.json"), level(&format!("--axes {axes}")));
    assert!((of_file / direct - 1.0).abs() < 1e-3, "{of_file} for {direct}");
}

#[test]
fn a_path_leads_through_three_axes() {
    let bench = Bench::new();
    let axes = "--axes rough-smooth,hard-soft,centroid";
    let made = bench.json(&format!(
        "texture path {axes} --stop 40,40,45@0 --stop centroid=60,rough-smooth=60,hard-soft=40@100 --name Way -o way.json"
    ));
    assert!(made["keys"].as_u64().unwrap() > 2, "{made}");
    let start = psd(&bench, &format!("{axes} --at 40,40,45"));
    let of_path = psd(&bench, "--library way.json --texture way");
    // A file rounds the model.
    let ratio = of_path["rms"].as_f64().unwrap() / start["rms"].as_f64().unwrap();
    assert!((ratio - 1.0).abs() < 1e-3, "{ratio}");
    let fails = |stop: &str, words: &[&str]| {
        bench.fails(&format!("texture path {axes} --stop 40,40,45@0 --stop {stop} -o x.json"), 2, words);
    };
    fails("60,40@100", &["2 coordinates", "3 axes"]);
    fails("60,40,101@100", &["centroid is 101"]);
}

#[test]
fn a_project_renders_on_its_own_axes() {
    let bench = Bench::new();
    bench.json("project new -o a.shagreen");
    let mut project: Value =
        serde_json::from_slice(&std::fs::read(bench.path("a.shagreen")).unwrap()).unwrap();
    project["version"] = json!("1.3");
    project["axes"] = json!(["rough-smooth", "hard-soft", "centroid"]);
    let blend = json!({"mode": "field", "weights": "barycentric", "outside": "clamped"});
    project["authored"] = json!([
        {"key": 1, "name": "first", "rough_smooth": 45.0, "hard_soft": 40.0, "further": [50.0], "blend": blend}
    ]);
    let mixed = json!({"mode": "shared", "weights": "barycentric", "outside": "clamped"});
    let mut second = project["authored"][0].clone();
    (second["key"], second["name"], second["blend"]) = (json!(2), json!("second"), mixed);
    project["authored"].as_array_mut().unwrap().push(second);
    bench.write("a.shagreen", project.to_string());
    let shown = bench.json("project show a.shagreen");
    assert_eq!((&shown["axes"], &shown["authored"][0]["at"]), (&project["axes"], &json!([45.0, 40.0, 50.0])));
    let authored = psd(&bench, "--project a.shagreen --authored first");
    assert_eq!(authored, psd(&bench, "--axes rough-smooth,hard-soft,centroid --at 45,40,50"));
    assert_eq!(authored, psd(&bench, "--project a.shagreen --at 45,40,50"));
    // A mode that needs triangles stays in the project; the field is used on three axes.
    assert_eq!(psd(&bench, "--project a.shagreen --authored second"), authored);
    assert_eq!(
        psd(&bench, "--project a.shagreen --axes rough-smooth,hard-soft --at 45,40"),
        psd(&bench, "--at 45,40")
    );
    bench.fails(
        "texture psd --project a.shagreen --authored first --axes centroid --speed 80 --force 0.6",
        2,
        &["--axes", "--authored"],
    );
}

/// Checks an evaluation of the axes that a library knows, and returns it.
fn check_evaluation(library: &str, n_axes: usize) -> Value {
    let report = Bench::new().json(&format!("evaluate axes {library}"));
    assert_eq!(report["first"], json!(["rough-smooth", "hard-soft"]));
    let steps = report["steps"].as_array().unwrap();
    let counts: Vec<u64> = steps.iter().map(|step| step["n_axes"].as_u64().unwrap()).collect();
    assert_eq!(counts, (2..=n_axes as u64).collect::<Vec<_>>());
    assert!(steps[0]["gain_db"].is_null() && steps[0]["helps"].is_null());
    for step in steps {
        for field in ["error_db", "nearest_db"] {
            assert!(step[field].as_f64().unwrap() > 0.0, "{step}");
        }
        for field in ["rank1", "nearest_rank1", "agreement"] {
            assert!((0.0..=1.0).contains(&step[field].as_f64().unwrap()), "{step}");
        }
    }
    let error = |step: &Value| step["error_db"].as_f64().unwrap();
    let mut base = 0;
    for (at, step) in steps.iter().enumerate().skip(1) {
        let gain = step["gain_db"].as_f64().unwrap();
        assert!((error(&steps[base]) - error(step) - gain).abs() < 1e-9, "{step}");
        let standard_error = step["gain_standard_error_db"].as_f64().unwrap();
        assert_eq!(step["helps"], gain > 2.0 * standard_error);
        if step["helps"] == true {
            base = at;
        }
    }
    let candidates = report["candidates"].as_array().unwrap();
    assert_eq!(candidates.len(), steps.len() - 1);
    for (candidate, step) in candidates.iter().zip(&steps[1..]) {
        assert_eq!((&candidate["name"], &candidate["error_db_mean"]), (&step["axis"], &step["error_db"]));
        assert!(candidate["source"].is_string() && candidate["rank1"] == step["rank1"]);
    }
    let chosen = report["chosen"].as_array().unwrap();
    assert_eq!(chosen.len(), 2 + base, "the axes up to the last step that helps");
    report
}

#[test]
fn further_axes_of_the_starter_library_are_evaluated() {
    let report = check_evaluation("", 6);
    // Errors by measurement contain a part of the answer.
    assert!(report.to_string().contains("part of the answer"), "{report}");
}

#[test]
fn further_axes_of_the_simulated_library_are_evaluated() {
    check_evaluation("--library simulated", 6);
}

#[test]
fn an_evaluation_of_axes_is_a_table_that_says_what_helps() {
    let bench = Bench::new();
    let said = bench.run("evaluate axes --candidates centroid");
    assert_eq!(said.code, 0, "{said:?}");
    let lines: Vec<&str> = said.stdout.lines().collect();
    assert!(lines[0].contains("25 textures") && lines[0].contains("not rated by people"), "{said:?}");
    assert!(lines[1].contains("rank 1") && lines[1].contains("helps"), "{said:?}");
    assert!(lines[2].contains("2  rough-smooth, hard-soft "), "all axes that come first: {said:?}");
    assert!(lines[3].contains("3  + centroid "), "{said:?}");
    // The columns are aligned.
    let end =
        |line: &str, word: &str| line.chars().count() - line.rsplit(word).next().unwrap().chars().count();
    assert_eq!(end(lines[2], " dB"), end(lines[1], "nearest"), "{said:?}");
    assert!(lines[3].contains('±') && lines[3].contains('%'), "{said:?}");
    assert!(said.stdout.contains("part of the answer"), "{said:?}");

    // Values by chance.
    let list = bench.json("library list");
    let mut rows = vec!["id,rs,hs,odd-even".to_owned()];
    rows.extend(list["textures"].as_array().unwrap().iter().enumerate().map(|(i, texture)| {
        let at = &texture["at"];
        format!("{},{},{},{}", texture["id"].as_str().unwrap(), at[0], at[1], (i * 37 + 11) % 97)
    }));
    bench.write("p.csv", rows.join("\n"));
    bench.json("space place --attributes p.csv --source physical --out l.json");
    let said = bench.run("evaluate axes --library l.json --candidates odd-even").stdout;
    assert!(said.contains("No further axis lowers the error"), "{said}");
    assert!(!said.contains("part of the answer"), "{said}");
    // Nothing was evaluated, so nothing fails to help.
    for what in ["--candidates rough-smooth", "--candidates hard-soft,rough-smooth"] {
        let said = bench.run(&format!("evaluate axes {what}")).stdout;
        assert!(said.contains("No further axis was evaluated: none is given"), "{said}");
        assert!(!said.contains("lowers the error"), "{said}");
    }
    let free = bench.json("evaluate axes --library l.json --candidates rough-smooth,odd-even --free");
    assert_eq!((&free["first"], &free["steps"][0]["n_axes"]), (&json!([]), &json!(1)));
    assert_eq!(free["chosen"][0], free["steps"][0]["axis"]);
    assert!(!free["notes"].to_string().contains("part of the answer"), "{free}");

    bench.fails("evaluate axes --candidates warm-cold", 1, &["\"warm-cold\"", "centroid"]);
    bench.fails("evaluate axes --first centroid,centroid", 1, &["different"]);
    bench.fails("evaluate axes --first centroid --free", 2, &["--first", "--free"]);
}

#[test]
fn leave_one_out_evaluates_the_field_on_three_axes() {
    let bench = Bench::new();
    let report = bench.json(&format!("evaluate leave-one-out {THREE} --signals 0"));
    assert_eq!(report["axes"], json!(["rough-smooth", "hard-soft", "sticky-slippery"]));
    let textures = report["textures"].as_array().unwrap();
    // All textures are evaluated, also those on the hull.
    assert_eq!((textures.len(), report["on_hull"].as_array().unwrap().len()), (25, 0));
    assert!(textures.iter().all(|texture| texture["at"].as_array().unwrap().len() == 3));
    let error = |summary: &Value| summary["error_db_mean"].as_f64().unwrap();
    assert!(error(&report["modes"]["field"]) < error(&report["nearest"]), "{report}");
    assert!(report["axes_caveat"].is_null());

    let all = bench.run(&format!("evaluate leave-one-out {THREE} --signals 0 --blend all --json"));
    assert!(all.stderr.contains("parametric") && all.stderr.contains("left out"), "{}", all.stderr);
    let all: Value = serde_json::from_str(&all.stdout).unwrap();
    assert_eq!(all["modes"], report["modes"]);
    bench.fails(
        &format!("evaluate leave-one-out {THREE} --blend paper"),
        1,
        &["mode paper interpolates in triangles", "choose mode field, or fewer axes"],
    );
    // On one axis, only the textures at its ends are not evaluated.
    let line = bench.json("evaluate leave-one-out --axes centroid --signals 0");
    let [n_evaluated, n_ends] = ["textures", "on_hull"].map(|field| line[field].as_array().unwrap().len());
    assert!(n_evaluated + n_ends == 25 && n_evaluated > 10 && n_ends >= 2, "{line}");
    assert!(line["axes_caveat"].as_str().unwrap().contains("part of the answer"), "{line}");
    let computed =
        bench.run("evaluate leave-one-out --axes rough-smooth,hard-soft,centroid --signals 0").stdout;
    assert!(computed.contains("contains a part of the answer"), "{computed}");
    assert!(computed.contains("all are evaluated"), "{computed}");
    assert!(computed.contains("not comparable with those of two axes"), "{computed}");
    assert!(computed.contains("shagreen evaluate axes"), "{computed}");
    let two = bench.run("evaluate leave-one-out --signals 0").stdout;
    assert!(!two.contains("not comparable"), "{two}");
}
