//! `shagreen evaluate leave-one-out`.

use crate::support::Bench;
use serde_json::Value;

const MODES: [&str; 5] = ["field", "parametric", "shared", "power", "paper"];

fn number(report: &Value, method: &str, field: &str) -> f64 {
    let summary = if method == "nearest" { &report["nearest"] } else { &report["modes"][method] };
    summary[field].as_f64().unwrap()
}

/// The interpolated texture is closer to the one left out than a copy of the nearest texture, by a quarter; the
/// published mixing is not. Signals confirm the result of the models.
fn check(library: &str, source: &str) -> Value {
    let bench = Bench::new();
    let report = bench
        .json(&format!("evaluate leave-one-out --blend all --signals 3 --seconds 8 {library} --figures f"));
    assert_eq!(
        (&report["measured"], &report["label_sources"][0]),
        (&"measured on signals".into(), &source.into())
    );
    let error = |method: &str| number(&report, method, "error_db_mean");
    // With two dozen textures a difference of 1 % is within chance: parametric comes that close on one library.
    for method in MODES {
        assert!(
            error("field") < 1.02 * error(method),
            "{method} has a lower error than the default: {report}"
        );
    }
    let best = MODES.into_iter().min_by(|a, b| error(a).total_cmp(&error(b)));
    assert_eq!(report["best"].as_str(), best);
    assert!(error("field") < 0.75 * error("nearest"), "{report}");
    assert!(error("paper") > error("nearest"), "{report}");
    let rank1 = |method: &str| number(&report, method, "rank1");
    assert!(rank1("field") >= 3.0 * rank1("paper") && rank1("field") > 0.0, "{report}");
    assert_eq!(rank1("nearest"), 0.0);
    let textures = report["textures"].as_array().unwrap();
    for method in MODES.into_iter().chain(["nearest"]) {
        let of = |field: &str| number(&report, method, field);
        assert_eq!(of("n") as usize, textures.len());
        let sum: f64 = textures.iter().map(|texture| texture["error_db"][method].as_f64().unwrap()).sum();
        assert!((sum / of("n") - of("error_db_mean")).abs() < 1e-9);
        for field in ["error_db_median", "level_error_db_mean", "shape_error_db_mean", "top5", "nrs_mean"] {
            assert!(of(field).is_finite());
        }
        // The overall level is a part of the error.
        assert!(of("shape_error_db_mean") <= of("error_db_mean"), "{method}: {report}");
        let summary = if method == "nearest" { &report["nearest"] } else { &report["modes"][method] };
        let signals = |field: &str| summary["signals"][field].as_f64().unwrap();
        assert!(signals("n") >= 3.0 && signals("mean_difference_db") < 0.5, "{method}: {summary}");
        // Both errors are means over the same textures.
        let rendered: Vec<f64> = textures
            .iter()
            .filter(|texture| texture["signal_error_db"][method].is_number())
            .map(|texture| texture["error_db"][method].as_f64().unwrap())
            .collect();
        assert_eq!(signals("n") as usize, rendered.len());
        let mean = rendered.iter().sum::<f64>() / rendered.len() as f64;
        assert!((signals("model_error_db_mean") - mean).abs() < 1e-9, "{method}: {summary}");
        // Rendered signals have the spectrum of their model; over eight seconds chance accounts for 0.3 dB.
        assert!(signals("from_model_db") < 0.8, "{method}: {summary}");
        let map = std::fs::read_to_string(bench.path(&format!("f/error-{method}.svg"))).unwrap();
        assert!(map.contains("measured on signals"), "{method}");
    }
    let methods = std::fs::read_to_string(bench.path("f/methods.csv")).unwrap();
    assert_eq!(methods.lines().count(), 1 + MODES.len() + 1);
    report
}

#[test]
fn the_field_evaluates_best_on_the_starter_library() {
    let report = check("", "physical");
    let error = |method: &str| number(&report, method, "error_db_mean");
    // 43 % lower when this test was written.
    assert!(error("field") < 0.6 * error("paper"), "{report}");
    // The positions are computed from the level. Without the level, the gain over a copy is smaller (28 %).
    let shape = |method: &str| number(&report, method, "shape_error_db_mean");
    assert!(shape("field") < 0.8 * shape("nearest"), "{report}");
}

#[test]
fn the_field_evaluates_best_on_the_simulated_library() {
    check("--library simulated", "simulated");
}

#[test]
fn a_table_says_what_was_measured_and_which_is_best() {
    let bench = Bench::new();
    let said = bench.run("evaluate leave-one-out --signals 0");
    assert_eq!(said.code, 0, "{said:?}");
    assert!(
        said.stdout
            .contains("measured on signals, positions from physical labels; the errors are computed, not rated by people"),
        "{said:?}"
    );
    let lines: Vec<&str> = said.stdout.lines().collect();
    assert!(lines[2].starts_with("  nearest") && lines[3].starts_with("* field"), "{said:?}");
    assert!(
        lines[1].contains("shape error") && said.stdout.contains("contains part of its answer"),
        "{said:?}"
    );
    assert!(!said.stdout.contains("signal (n") && bench.files().is_empty(), "{said:?}");
    let said = bench.run("evaluate leave-one-out --library simulated --signals 1 --seconds 4 --blend paper");
    assert!(said.stdout.contains("simulated raters") && said.stdout.contains("* nearest"), "{said:?}");
    assert!(!said.stdout.contains("part of its answer"), "positions from sorts and ratings: {said:?}");
    // The mean of one texture stands beside the model error of the same texture, not of all textures.
    assert!(
        said.stdout.contains("model (n=1) signal (n=1)") && said.stdout.contains("mean error of 1 texture")
    );
}

#[test]
fn what_cannot_be_evaluated_is_one_sentence() {
    let bench = Bench::new();
    let place = |name: &str, rows: &str| {
        bench.write("places.csv", format!("id,rs,hs\n{rows}"));
        bench.json(&format!("space place --attributes places.csv --source physical --out {name}"));
    };
    place("three.json", "cork,10,10\nfelt,90,10\nglass,50,90\n");
    place("square.json", "cork,0,0\nfelt,100,0\nglass,0,100\nbrick,100,100\n");
    let fails = |arguments: &str, code: i32, words: &[&str]| {
        bench.fails(&format!("evaluate leave-one-out {arguments}"), code, words);
    };
    fails("--library three.json", 1, &["needs 4 textures", "got 3", "three.json"]);
    fails("--library square.json", 1, &["none of the 4 textures", "strictly inside", "square.json"]);
    fails("--blend loud", 2, &["loud", "field", "all"]);
    fails("--seconds 1", 2, &["4 to 600"]);
    bench.write("notes.txt", "x");
    fails("--figures notes.txt", 1, &["folder", "notes.txt"]);
}

/// Parts that several computers make are the whole evaluation, to the last digit.
#[test]
fn parts_of_an_evaluation_are_the_whole() {
    let bench = Bench::new();
    let options = "--blend power --signals 2 --seconds 4";
    let whole = bench.json(&format!("evaluate leave-one-out {options}"));
    let mut n = 0;
    for shard in [1, 2] {
        let part = bench
            .json(&format!("evaluate leave-one-out {options} --shard {shard}/2 --part part{shard}.json"));
        n += part["n"].as_u64().unwrap();
        assert_eq!(part["of"], whole["n"]);
    }
    assert_eq!(n, whole["n"].as_u64().unwrap());
    let joined = bench
        .json(&format!("evaluate leave-one-out {options} --merge part2.json part1.json --figures plots"));
    assert_eq!(joined, whole);
    assert!(bench.path("plots/methods.csv").is_file());
    let fails = |arguments: &str, code: i32, words: &[&str]| {
        bench.fails(&format!("evaluate leave-one-out {arguments}"), code, words);
    };
    fails(&format!("{options} --merge part1.json"), 1, &["part 2/2 is missing"]);
    fails(&format!("{options} --merge part1.json part1.json"), 1, &["part 1/2 is given twice"]);
    fails(
        &format!("{options} --seed 2 --merge part1.json part2.json"),
        1,
        &["another evaluation", "part1.json"],
    );
    fails(&format!("{options} --shard 1/2"), 2, &["--part"]);
    fails(&format!("{options} --shard 0/2 --part x.json"), 2, &["part 0 of 2 does not exist"]);
    bench.write("notes.json", "{}");
    fails(&format!("{options} --shard 1/2 --part notes.json"), 1, &["would replace"]);
}
