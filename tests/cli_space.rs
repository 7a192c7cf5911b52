//! `shagreen space place` and `shagreen space build`.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

mod support;

use serde_json::{Value, json};
use support::Bench;

#[test]
fn a_table_places_textures_and_says_who_is_missing() {
    let bench = Bench::new();
    bench.write("a.csv", "id,rs,hs,flat-bumpy\ncork,10,20,30\nfelt,90.5,80,70\nbrick,0,0,\n");
    let placed = bench.json("space place --attributes a.csv --source human --out l.json");
    assert_eq!(placed["placed"], 3);
    let missing = placed["missing"].as_array().unwrap();
    assert!(missing.len() == 22 && missing.contains(&json!("glass")), "{missing:?}");
    let list = bench.json("library list --library l.json");
    let of = |id: &str| {
        list["textures"].as_array().unwrap().iter().find(|texture| texture["id"] == id).unwrap().clone()
    };
    assert_eq!((&of("felt")["at"], &of("felt")["label_source"]), (&json!([90.5, 80.0]), &json!("human")));
    assert_eq!(of("glass")["at"], json!(null));
    let attributes: Value = serde_json::from_slice(&std::fs::read(bench.path("l.json")).unwrap()).unwrap();
    assert_eq!(attributes["version"], "1.2");
    // What it wrote, it may write over; what it reads, it may not.
    bench.json("space place --library l.json --attributes a.csv --source human --out l2.json");
    bench.json("space place --attributes a.csv --source human --out l2.json");
    let said = bench.run("space place --library l.json --attributes a.csv --source human --out l.json");
    assert!(said.code == 1 && said.stderr.contains("write over"), "{said:?}");
}

#[test]
fn a_table_that_places_nothing_says_why_and_writes_nothing() {
    let bench = Bench::new();
    bench.write("unknown.csv", "id,rs,hs\ncorkk,10,20\n");
    bench.write("twice.csv", "id,rs,hs\ncork,10,20\ncork,10,20\n");
    bench.write("good.csv", "id,rs,hs\ncork,10,20\n");
    bench.write("notes.json", "{}");
    let check = |arguments: &str, code: i32, words: &str| {
        let said = bench.run(&format!("space place {arguments}"));
        assert_eq!(said.code, code, "{said:?}");
        assert!(said.stderr.contains(words) && said.stderr.lines().count() == 1, "{said:?}");
    };
    check("--attributes unknown.csv --source human --out l.json", 1, "no texture \"corkk\"");
    check("--attributes twice.csv --source human --out l.json", 1, "line 2 and again in line 3");
    check("--attributes good.csv --out l.json", 1, "where the places come from");
    check("--attributes good.csv --source me --out l.json", 2, "human, simulated or physical");
    check("--attributes good.csv --source human --out notes.json", 1, "notes.json");
    check("--attributes absent.csv --source human --out l.json", 1, "absent.csv");
    assert_eq!(bench.files(), ["good.csv", "notes.json", "twice.csv", "unknown.csv"]);
}

/// A simulated panel sorts and rates the starter library, and the whole pipeline is run on it.
#[test]
fn a_space_is_built_from_a_simulated_panel() {
    let bench = Bench::new();
    let panel = bench.json("space panel --sorting s.csv --ratings r.csv --seed 1");
    assert_eq!((&panel["label_source"], &panel["sorts"]), (&json!("simulated"), &json!(30)));
    let build = "space build --sorting s.csv --ratings r.csv --out l2.json --seed 1 --permutations 19";
    let report = bench.json(&format!("{build} --figures figures"));
    let number = |value: &Value| value.as_f64().unwrap();
    let stress: Vec<f64> = report["stress"].as_array().unwrap().iter().map(number).collect();
    assert!(stress.len() == 10 && stress.windows(2).all(|s| s[1] <= s[0] + 1e-9), "{stress:?}");
    assert!(number(&report["stress_chosen"]) < 0.1);
    let adjectives = report["adjectives"].as_array().unwrap();
    assert_eq!(adjectives.len(), 5);
    for adjective in adjectives {
        let has = |field: &str, n: usize| adjective[field].as_array().is_some_and(|a| a.len() == n);
        assert!(
            has("direction", 2) && has("correlation", 2) && number(&adjective["r2"]) > 0.3,
            "{adjective}"
        );
    }
    for (axis, name) in report["axes"].as_array().unwrap().iter().zip(["rough-smooth", "hard-soft"]) {
        assert_eq!(axis["name"], name);
        assert!(number(&axis["nested_cv_r"]) > 0.7 && number(&axis["cv_r"]) > 0.7, "{axis}");
        assert!(number(&axis["nested_cv_rms_percent"]) > 75.0 && number(&axis["permutation_p"]) <= 0.05);
        assert!(!axis["features"].as_array().unwrap().is_empty());
    }
    let positions = report["positions"].as_array().unwrap();
    assert_eq!(positions.len(), 25);
    // Everything says that nobody felt anything.
    let on_disk: Value =
        serde_json::from_slice(&std::fs::read(bench.path("l2.report.json")).unwrap()).unwrap();
    assert_eq!(
        (&on_disk["label_source"], &on_disk["positions"]),
        (&json!("simulated"), &report["positions"])
    );
    let page = std::fs::read_to_string(bench.path("l2.report.svg")).unwrap();
    assert!(page.contains("simulated raters") && page.contains("nested r") && page.contains("Shepard"));
    assert_eq!(std::fs::read_dir(bench.path("figures")).unwrap().count(), 16);
    // It is what the second library of the program was made by.
    bench.json("library places --library l2.json --out places.csv");
    let built_in = include_str!("../assets/starter/simulated.csv");
    assert_eq!(std::fs::read_to_string(bench.path("places.csv")).unwrap(), built_in);
    let second = bench.json("library list --library simulated");
    assert_eq!(second["textures"][0]["label_source"], "simulated");
    let psd = bench.json("texture psd --library l2.json --at 50,50 --speed 100 --force 1 --bins 2");
    assert_eq!(psd["parents"].as_array().unwrap().len(), 3);
}

#[test]
fn judgements_that_make_no_space_say_why_and_write_nothing() {
    let bench = Bench::new();
    bench.json("space panel --sorting s.csv --ratings r.csv --participants 4 --groups 3,6");
    let changed = |from: &str, to: &str, change: &dyn Fn(&str) -> String| {
        let text = std::fs::read_to_string(bench.path(from)).unwrap();
        bench.write(to, change(&text));
    };
    changed("s.csv", "s-unknown.csv", &|text| text.replace("cork", "corkk"));
    changed("s.csv", "s-twice.csv", &|text| format!("{text}simulated-01,3 groups,3,cork,1\n"));
    changed("r.csv", "r-same.csv", &|text| text.replace("hard-soft", "rough-rough"));
    changed("r.csv", "r-again.csv", &|text| text.replace("hard-soft", "Smooth-Rough"));
    changed("r.csv", "r-twice.csv", &|text| format!("{text}simulated-01,cork,rough-smooth,5\n"));
    changed("r.csv", "r-one.csv", &|text| {
        text.lines()
            .filter(|l| l.starts_with("part") || l.contains("rough-smooth"))
            .map(|l| format!("{l}\n"))
            .collect()
    });
    let files = bench.files();
    let check = |arguments: &str, code: i32, words: &str| {
        let said = bench.run(&format!("space build {arguments} --out l.json --permutations 5"));
        assert_eq!(said.code, code, "{said:?}");
        assert!(said.stderr.contains(words) && said.stderr.lines().count() == 1, "{words}: {said:?}");
        assert_eq!(bench.files(), files);
    };
    check("--sorting s-unknown.csv --ratings r.csv", 1, "\"corkk\" was sorted");
    check("--sorting s-twice.csv --ratings r.csv", 1, "a texture goes into one group");
    check("--sorting s.csv --ratings r-same.csv", 1, "no two poles");
    check("--sorting s.csv --ratings r-again.csv", 1, "the same adjectives");
    check("--sorting s.csv --ratings r-twice.csv", 1, "twice on rough");
    check("--sorting s.csv --ratings r-one.csv", 1, "two are needed");
    check("--sorting r.csv --ratings r.csv", 1, "r.csv");
    check("--sorting s.csv --ratings s.csv", 1, "s.csv");
    check("--sorting s.csv --ratings r.csv --source human", 1, "is simulated");
    check("--sorting s.csv --ratings r.csv --axes rough-smooth", 2, "two pairs");
    check("--sorting s.csv --ratings r.csv --axes warm-cold,hard-soft", 1, "it was not rated");
}
