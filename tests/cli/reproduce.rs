//! `shagreen reproduce`.

use std::fs::read_to_string;

use crate::support::Bench;

#[test]
fn a_paper_has_a_page_its_tables_and_figures_and_an_index() {
    let bench = Bench::new();
    let said = bench.json("reproduce S4 --out papers");
    assert_eq!(said["format"], "shagreen-reproduction-report");
    assert_eq!(said["papers"][0]["command"], "shagreen reproduce S4 --out papers --seed 1");
    let items = said["items"].as_array().unwrap();
    let one = |name: &str| items.iter().find(|item| item["name"].as_str().unwrap().contains(name)).unwrap();
    let threshold = one("mean threshold");
    assert!(threshold["printed"] == 0.96 && threshold["ours"].is_f64(), "{threshold}");
    assert!(threshold["source"].as_str().unwrap().contains("SIMULATED"), "{threshold}");
    assert!(one("rating")["ours"].is_null() && one("rating")["reason"].as_str().unwrap().contains("people"));
    // Every difference beyond the tolerance has a reason, and every file is there.
    for item in items {
        let is_explained = item["printed"].is_null()
            || item["equal"] == true
            || item["reason"].as_str().is_some_and(|reason| !reason.is_empty());
        assert!(is_explained, "{item}");
        for file in item["files"].as_array().unwrap() {
            assert!(bench.path("papers").join(file.as_str().unwrap()).is_file(), "{file}");
        }
    }
    let page = read_to_string(bench.path("papers/S4.md")).unwrap();
    for words in ["# S4: ", "| 0.96 |", "![", "](S4-figure-5-envelopes.svg)", "SIMULATED participants"] {
        assert!(page.contains(words), "{words}");
    }
    let table = read_to_string(bench.path("papers/S4-figure-2.csv")).unwrap();
    assert!(table.starts_with("quantity,unit,printed,ours,difference,"), "{table}");
    let index = read_to_string(bench.path("papers/index.md")).unwrap();
    assert!(index.contains("](S4.md)") && index.contains("`shagreen reproduce S0`"), "{index}");

    let text = bench.run("reproduce S4 --seed 2").stdout;
    assert!(text.contains("printed 0.96, ours ") && !text.contains("Pages, tables"), "{text}");
}

#[test]
fn wrong_usage_is_two_and_other_files_stay() {
    let bench = Bench::new();
    for (arguments, words) in [
        ("reproduce", &["PAPER"][..]),
        ("reproduce S5", &["S5", "S4"]),
        ("reproduce S4 --sorting s.csv", &["--ratings"]),
        ("reproduce S4 --ratings r.csv", &["--ratings", "S0, S2"]),
        ("reproduce S4 --library l.json", &["--library", "S3"]),
        ("reproduce S0 --epochs 1", &["--epochs", "S1, S2"]),
        ("reproduce S0 S2 --epochs 1", &["--epochs has no effect on S2 without --full"]),
        ("reproduce S1 --epochs 0", &["--epochs", "1 to"]),
    ] {
        bench.fails(arguments, 2, words);
    }
    bench.fails("reproduce S0 --library none.json", 1, &["none.json"]);
    bench.fails("reproduce S0 --ratings none.csv", 1, &["none.csv"]);
    bench.write("papers/index.md", "# Mine");
    bench.fails("reproduce S4 --out papers", 1, &["would replace a file of another kind", "index.md"]);
    bench.fails("reproduce S4 --out papers/index.md", 1, &["this is a file"]);
    bench.fails("reproduce S4 --out papers/index.md/in", 1, &["cannot create the folder"]);
    assert_eq!(read_to_string(bench.path("papers/index.md")).unwrap(), "# Mine");
}
