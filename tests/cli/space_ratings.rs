//! `shagreen space build` without sorts, `shagreen space questionnaire`, and `shagreen space panel` by a questionnaire.

use std::fmt::Write as _;

use serde_json::{Value, json};
use shagreen_formats::starter::starter_library;

use crate::support::Bench;

/// A made-up table of ratings: nobody felt a texture. Six raters give the positions of the starter library with deviations of
/// up to 8 points; the third pair has no relation to the textures.
fn made_up_ratings() -> String {
    let library = starter_library().unwrap();
    let mut table = "participant,texture,rough-smooth,hard-soft,sticky-slippery\n".to_owned();
    for rater in 0..6 {
        for (i, texture) in library.textures.iter().enumerate() {
            let at = texture.at().unwrap();
            let off = |step: usize| ((step * i + 13 * rater) % 17) as f64 - 8.0;
            let [rough, hard] = [at.x() + off(7), at.y() + off(11)].map(|v| v.clamp(0.0, 100.0).round());
            let sticky = ((i * 37) % 90) as f64 + off(3).abs();
            writeln!(table, "made-up-{rater},{},{rough},{hard},{sticky}", texture.id).unwrap();
        }
    }
    table
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// The main use: a ratings table without sorts gives the report with its cross-validation.
#[test]
fn a_space_is_built_from_a_made_up_ratings_table_alone() {
    let bench = Bench::new();
    bench.write("r.csv", made_up_ratings());
    let build =
        "space build --ratings r.csv --source simulated --axes rough-smooth,hard-soft --permutations 19";
    let report = bench.json(&format!("{build} --out l.json --figures figures"));
    assert_eq!((&report["judgments"], &report["label_source"]), (&json!("ratings"), &json!("simulated")));
    for (axis, name) in report["axes"].as_array().unwrap().iter().zip(["rough-smooth", "hard-soft"]) {
        assert_eq!((&axis["name"], &axis["placed_by"]), (&json!(name), &json!("felt")));
        assert!(number(&axis["nested_cv_r"]) > 0.5 && number(&axis["cv_r"]) > 0.5, "{axis}");
        assert!(number(&axis["permutation_p"]) <= 0.05 && axis["folds"] == 5, "{axis}");
        assert!(number(&axis["nested_cv_rms_percent"]) > number(&axis["mean_rms_percent"]), "{axis}");
        assert_eq!((&axis["direction"], &axis["r2"]), (&json!(null), &json!(null)));
    }
    // What needs sorts is absent, and said to be.
    for absent in ["dimensions", "stress_chosen", "ties", "angle_degrees", "stability", "degenerate"] {
        assert_eq!(report[absent], json!(null), "{absent}");
        assert!(report["absent"].as_array().unwrap().contains(&json!(absent)), "{absent}");
    }
    assert_eq!((&report["stress"], &report["sorters"]), (&json!([]), &json!([])));
    assert_eq!(report["why_absent"], "there are no sorts");
    for adjective in report["adjectives"].as_array().unwrap() {
        let alpha: Vec<f64> = adjective["alpha"].as_array().unwrap().iter().map(number).collect();
        assert!(alpha[0] > 0.9 && alpha[1] < alpha[0] && alpha[0] < alpha[2], "{adjective}");
        assert!(adjective["why_no_line"].as_str().unwrap().contains("there are no sorts"), "{adjective}");
        assert_eq!(adjective["standard_errors"].as_array().unwrap().len(), 25);
    }
    let components = &report["mean_rating_components"];
    let explained: f64 = components["explained"].as_array().unwrap().iter().map(number).sum();
    assert!((explained - 1.0).abs() < 1e-9 && components["textures"] == 25, "{components}");
    // The positions are the mean ratings, computed here from the table.
    let positions = report["positions"].as_array().unwrap();
    assert_eq!(positions.len(), 25);
    let table = made_up_ratings();
    for position in positions {
        let id = position["id"].as_str().unwrap();
        let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
        let of: Vec<f64> =
            rows.iter().filter(|row| row[1] == id).map(|row| row[2].parse().unwrap()).collect();
        let mean = of.iter().sum::<f64>() / 6.0;
        assert!((number(&position["at"][0]) - mean).abs() < 1e-9, "{position}");
        assert!(number(&position["felt_standard_error"][0]) > 0.0 && position["perceptual"] == json!(null));
    }
    // Figures: nine of every space, and the mean ratings on three pairs, each as SVG and CSV.
    assert_eq!(std::fs::read_dir(bench.path("figures")).unwrap().count(), 2 * (9 + 3));
    let text = |name: &str| std::fs::read_to_string(bench.path(name)).unwrap();
    assert!(text("figures/stress.svg").contains("empty,"), "the title says why");
    let csv = text("figures/mean-ratings-1.csv");
    assert!(csv.lines().filter(|line| line.starts_with("mean rating,")).count() == 25, "{csv}");
    assert!(csv.lines().filter(|line| line.starts_with("95 % confidence interval,")).count() == 50, "{csv}");
    assert!(csv.contains("simulated raters") && text("figures/mean-ratings-2.svg").contains("cork"));
    assert!(text("l.report.svg").contains("mean ratings"));
    let list = bench.json("library list --library l.json");
    assert_eq!(list["textures"][0]["label_source"], "simulated");
    assert!(!text("l.json").contains("made-up-"), "participants' names are not published");
    let said = bench.run(&format!("{build} --out l.json"));
    assert!(
        said.code == 0 && said.stdout.contains("Built from ratings alone, by 6 participants"),
        "{said:?}"
    );
}

#[test]
fn the_axes_of_ratings_alone_are_chosen_by_correlation_and_reliability() {
    let bench = Bench::new();
    bench.write("r.csv", made_up_ratings());
    let build = "space build --ratings r.csv --source simulated --permutations 0 --features physical";
    let report = bench.json(&format!("{build} --out l.json"));
    let r = number(&report["axis_correlation"]).abs();
    // No other choice of two of the three pairs has a lower correlation.
    for axes in ["rough-smooth,hard-soft", "rough-smooth,sticky-slippery", "sticky-slippery,hard-soft"] {
        let other = bench.json(&format!("{build} --axes {axes} --out other.json"));
        assert!(r <= number(&other["axis_correlation"]).abs() + 1e-12, "{axes}");
    }
    // Votes on adjectives exclude pairs, as published.
    bench.write("v.csv", "participant,rough,smooth,sticky\nmade-up-0,1,1,0\nmade-up-1,1,1,0\n");
    let report = bench.json(&format!("{build} --relevance v.csv --out l.json"));
    let names: Vec<&Value> = report["axes"].as_array().unwrap().iter().map(|axis| &axis["name"]).collect();
    assert_eq!(names, [&json!("rough-smooth"), &json!("hard-soft")]);
}

#[test]
fn ratings_alone_that_make_no_space_say_why_and_write_nothing() {
    let bench = Bench::new();
    bench.write("r.csv", made_up_ratings());
    let few: Vec<String> = made_up_ratings().lines().take(3).map(str::to_owned).collect();
    bench.write("few.csv", few.join("\n"));
    bench.write("one.csv", "participant,texture,rough-smooth\nmade-up-0,cork,41\nmade-up-0,felt,50\n");
    bench.write("blank.csv", "participant,texture,rough-smooth,hard-soft\nmade-up-0,cork,,\n");
    let build = "space build --source simulated --permutations 0 --features physical --out l.json --ratings";
    bench.fails(&format!("{build} one.csv"), 1, &["two are needed", "one.csv"]);
    bench.fails(&format!("{build} few.csv"), 1, &["fewer than 3 textures were rated on it", "few.csv"]);
    bench.fails(&format!("{build} blank.csv"), 1, &["no rating is filled in", "blank.csv"]);
    bench.fails(&format!("{build} r.csv --axes warm-cold,hard-soft"), 1, &["it was not rated", "r.csv"]);
    for option in ["--ties primary", "--dimensions 3", "--orthogonal"] {
        let name = option.split(' ').next().unwrap();
        bench.fails(&format!("{build} r.csv {option}"), 2, &[name, "no effect without --sorting"]);
    }
}

#[test]
fn a_questionnaire_yields_blank_tables_that_a_build_reads_once_they_are_filled_in() {
    let bench = Bench::new();
    let said = bench.run("space questionnaire");
    assert!(said.code == 0 && said.stdout.contains("vrst-2023") && said.stdout.contains("authoring-2020"));
    let shown = bench.json("space questionnaire vrst-2023");
    assert_eq!(shown["adjectives"].as_array().unwrap().len(), 25);
    let five = ["rough-smooth", "flat-bumpy", "sticky-slippery", "hard-soft", "irritating-pleasant"];
    assert_eq!(shown["pairs"], json!(five));
    bench.fails("space questionnaire vrst", 1, &["choose vrst-2023 or authoring-2020"]);
    bench.fails("space questionnaire --ratings r.csv", 2, &["QUESTIONNAIRE"]);

    let write =
        "space questionnaire vrst-2023 --ratings r.csv --votes v.csv --instructions i.txt --participants 3";
    let written = bench.json(write);
    assert_eq!((&written["participants"], &written["textures"]), (&json!(3), &json!(25)));
    let text = |name: &str| std::fs::read_to_string(bench.path(name)).unwrap();
    assert_eq!((text("r.csv").lines().count(), text("v.csv").lines().count()), (1 + 75, 1 + 75));
    assert!(text("i.txt").contains("0 = extremely rough, 100 = extremely smooth"));
    let build = "space build --ratings r.csv --permutations 0 --features physical --out l.json";
    bench.fails(build, 1, &["no rating is filled in", "r.csv"]);
    // A blank table may be replaced, one with an answer may not.
    bench.json(write);
    let filled: String = text("r.csv")
        .lines()
        .enumerate()
        .map(|(i, line)| match i {
            0 => format!("{line}\n"),
            _ => line.replace(",,,,,", &format!(",{},{},40,{},60\n", i % 90, (i * 7) % 80, (i * 13) % 100)),
        })
        .collect();
    bench.write("r.csv", &filled);
    bench.fails(write, 1, &["would replace a file of another kind", "r.csv"]);
    assert_eq!(text("r.csv"), filled);
    // Filled in without relation to the textures, so the axes are stated.
    let report = bench.json(&format!("{build} --source simulated --axes rough-smooth,hard-soft"));
    assert_eq!(report["adjectives"].as_array().unwrap().len(), 5);

    // Votes select the pairs, as published.
    bench.write("filled.csv", "participant,thick,thin,hard,soft,rough\np01,1,1,1,1,1\np02,1,0,1,1,0\n");
    let chosen = bench.json("space questionnaire vrst-2023 --relevance filled.csv --ratings s.csv");
    assert_eq!(chosen["pairs"], json!(["hard-soft", "thick-thin"]));
    assert!(text("s.csv").starts_with("participant,texture,hard-soft,thick-thin\n"));
    bench.write("none.csv", "participant,thick\np01,1\n");
    bench.fails(
        "space questionnaire vrst-2023 --relevance none.csv --ratings t.csv",
        1,
        &["0 pairs", "none.csv"],
    );
}

#[test]
fn a_simulated_panel_rates_by_a_questionnaire_without_sorting() {
    let bench = Bench::new();
    let panel = bench.json("space panel --questionnaire authoring-2020 --ratings r.csv --participants 6");
    assert_eq!((&panel["label_source"], &panel["sorts"]), (&json!("simulated"), &json!(0)));
    let four = ["rough-smooth", "sticky-slippery", "hard-soft", "irritating-pleasant"];
    assert_eq!((&panel["adjectives"], bench.files()), (&json!(four), vec!["r.csv".to_owned()]));
    let report = bench.json("space build --ratings r.csv --permutations 0 --features physical --out l.json");
    assert_eq!((&report["label_source"], &report["judgments"]), (&json!("simulated"), &json!("ratings")));
    assert_eq!(report["raters"].as_array().unwrap().len(), 6);
    bench.fails("space panel --questionnaire none --ratings r.csv", 1, &["choose vrst-2023"]);
    bench.fails("space panel --ratings r.csv --groups 3", 2, &["--sorting"]);
}
