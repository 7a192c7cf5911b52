//! `shagreen space place` and `shagreen space build`.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

mod support;

use serde_json::json;
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
    let attributes: serde_json::Value =
        serde_json::from_slice(&std::fs::read(bench.path("l.json")).unwrap()).unwrap();
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
