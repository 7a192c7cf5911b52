//! `shagreen space place` and `shagreen space build`.

use crate::support::Bench;
use serde_json::{Value, json};

fn text(bench: &Bench, name: &str) -> String {
    std::fs::read_to_string(bench.path(name)).unwrap()
}

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
    // Some textures of the starter library have a direction.
    assert_eq!(attributes["version"], "1.7");
    // A library of the program may be replaced; an input may not.
    bench.json("space place --library l.json --attributes a.csv --source human --out l2.json");
    bench.json("space place --attributes a.csv --source human --out l2.json");
    let said = bench.run("space place --library l.json --attributes a.csv --source human --out l.json");
    assert!(said.code == 1 && said.stderr.contains("overwrite an input file"), "{said:?}");
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
    check(
        "--attributes unknown.csv --source human --out l.json",
        1,
        "no texture \"corkk\"; did you mean cork?",
    );
    check("--attributes twice.csv --source human --out l.json", 1, "line 2 and again in line 3");
    check("--attributes good.csv --out l.json", 1, "the source of the positions is not stated");
    check("--attributes good.csv --source me --out l.json", 2, "human, simulated, physical or estimated");
    check("--attributes good.csv --source human --out notes.json", 1, "notes.json");
    check("--attributes absent.csv --source human --out l.json", 1, "absent.csv");
    assert_eq!(bench.files(), ["good.csv", "notes.json", "twice.csv", "unknown.csv"]);
}

/// A simulated panel sorts and rates the starter library, and the whole pipeline runs on it.
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
    // Both axes are predicted well; an explicit placement is used nevertheless.
    let felt =
        "space build --sorting s.csv --ratings r.csv --out felt.json --permutations 0 --placement felt";
    for (report, placed_by) in [(&report, "predicted"), (&bench.json(felt), "felt")] {
        assert_eq!(report["placed_by"], placed_by);
        assert!(report["axes"].as_array().unwrap().iter().all(|axis| axis["placed_by"] == placed_by));
        let mut positions = report["positions"].as_array().unwrap().iter();
        assert!(positions.all(|position| position["at"] == position[placed_by]));
    }
    // Every output states that the ratings are simulated.
    let on_disk: Value =
        serde_json::from_slice(&std::fs::read(bench.path("l2.report.json")).unwrap()).unwrap();
    assert_eq!(
        (&on_disk["label_source"], &on_disk["positions"]),
        (&json!("simulated"), &report["positions"])
    );
    let page = std::fs::read_to_string(bench.path("l2.report.svg")).unwrap();
    assert!(
        page.contains("simulated raters")
            && page.contains("nested cross-validation r")
            && page.contains("Shepard")
    );
    // Nine figures, and the mean ratings on five pairs, each as SVG and CSV.
    assert_eq!(std::fs::read_dir(bench.path("figures")).unwrap().count(), 2 * (9 + 5));
    assert_eq!((&report["judgments"], &report["absent"]), (&json!("sorts and ratings"), &json!([])));
    // The second built-in library was made this way.
    bench.json("library places --library l2.json --out places.csv");
    let built_in = include_str!("../../assets/starter/simulated.csv");
    assert_eq!(std::fs::read_to_string(bench.path("places.csv")).unwrap(), built_in);
    let second = bench.json("library list --library simulated");
    assert_eq!(second["textures"][0]["label_source"], "simulated");
    let psd =
        bench.json("texture psd --library l2.json --at 50,50 --blend shared --speed 100 --force 1 --bins 2");
    assert_eq!(psd["parents"].as_array().unwrap().len(), 3);
}

#[test]
fn judgments_that_make_no_space_say_why_and_write_nothing() {
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
        let kept = text.lines().filter(|l| l.starts_with("part") || l.contains("rough-smooth"));
        kept.collect::<Vec<_>>().join("\n")
    });
    changed("r.csv", "r-unknown.csv", &|text| text.replace("cork", "corkk"));
    changed("r.csv", "r-large.csv", &|text| {
        let mut lines: Vec<&str> = text.lines().collect();
        lines[1] = "simulated-01,glass,rough-smooth,512";
        lines.join("\n")
    });
    changed("s.csv", "s-few.csv", &|text| {
        let kept =
            text.lines().filter(|l| ["part", ",cork,", ",felt,", ",glass,"].iter().any(|w| l.contains(w)));
        kept.collect::<Vec<_>>().join("\n")
    });
    changed("r.csv", "r-other.csv", &|text| {
        let kept = text.lines().filter(|l| l.starts_with("part") || l.contains(",brick,"));
        kept.collect::<Vec<_>>().join("\n")
    });
    bench.write("v.csv", "participant,adjective,relevant\nsimulated-01,rough,1\nsimulated-01,rough,0\n");
    changed("r.csv", "r-mixed.csv", &|text| text.replace("simulated-02", "anna"));
    let files = bench.files();
    let check = |arguments: &str, code: i32, words: &[&str]| {
        let said = bench.run(&format!("space build {arguments} --out l.json --permutations 5"));
        assert_eq!(said.code, code, "{said:?}");
        let has_all = words.iter().all(|word| said.stderr.contains(word));
        let n_lines =
            said.stderr.lines().filter(|line| !line.starts_with("note: building the space")).count();
        assert!(has_all && n_lines == 1, "{words:?}: {said:?}");
        assert_eq!(bench.files(), files);
    };
    // Every error names the file to correct.
    let unknown = ["\"corkk\" was sorted", "did you mean cork", "s-unknown.csv"];
    check("--sorting s-unknown.csv --ratings r.csv", 1, &unknown);
    check("--sorting s.csv --ratings r-unknown.csv", 1, &["\"corkk\" was rated", "r-unknown.csv"]);
    check("--sorting s-twice.csv --ratings r.csv", 1, &["assign each texture to one group", "s-twice.csv"]);
    check("--sorting s.csv --ratings r-same.csv", 1, &["not have two poles", "r-same.csv"]);
    check("--sorting s.csv --ratings r-again.csv", 1, &["the same adjectives", "r-again.csv"]);
    check("--sorting s.csv --ratings r-twice.csv", 1, &["twice on rough", "r-twice.csv"]);
    check("--sorting s.csv --ratings r-one.csv", 1, &["two are needed", "r-one.csv"]);
    check(
        "--sorting s-few.csv --ratings r-other.csv",
        1,
        &["both sorted and rated", "s-few.csv", "r-other.csv"],
    );
    check(
        "--sorting s.csv --ratings r-large.csv",
        1,
        &["value in line 2 is \"512\"", "0 to 100", "r-large.csv"],
    );
    check("--sorting s.csv --ratings r.csv --relevance v.csv", 1, &["voted twice", "v.csv"]);
    check("--sorting r.csv --ratings r.csv", 1, &["this looks like the ratings table", "r.csv"]);
    check("--sorting s.csv --ratings s.csv", 1, &["this looks like the sorting table", "s.csv"]);
    check("--sorting s.csv --ratings r.csv --source human", 1, &["is simulated"]);
    check("--sorting s.csv --ratings r-mixed.csv", 1, &["both simulated participants and others"]);
    check("--sorting s.csv --ratings r.csv --figures s.csv", 1, &["s.csv"]);
    check("--sorting s.csv --ratings r.csv --axes rough-smooth", 2, &["two pairs"]);
    check("--sorting s.csv --ratings r.csv --axes warm-cold,hard-soft", 1, &["it was not rated", "r.csv"]);
    check(
        "--sorting s.csv --ratings r.csv --features physical --mfcc htk",
        2,
        &["--mfcc htk", "leave it out"],
    );
}

/// Tables as spreadsheets write them, with columns besides the ratings.
#[test]
fn a_space_is_built_from_the_tables_of_spreadsheets() {
    let bench = Bench::new();
    bench.json("space panel --sorting s.csv --ratings r.csv --participants 6 --seed 1");
    let text = |name: &str| std::fs::read_to_string(bench.path(name)).unwrap();
    let people = |text: String| text.replace("simulated-01", "P1").replace("simulated-", "p");
    let sorting = people(text("s.csv")).replace("p02", "p1").replace(',', "\t").replace('\n', "\r\n");
    let units = format!("\u{feff}{sorting}").encode_utf16().collect::<Vec<u16>>();
    bench.write("unicode.txt", units.into_iter().flat_map(u16::to_le_bytes).collect::<Vec<u8>>());
    let rows = people(text("r.csv")).replace("p02", "p1").replace(',', ";").replace('.', ",");
    let with_columns = |(i, line): (usize, &str)| {
        format!("{line};{}\r\n", if i == 0 { "age;start-time" } else { "31;12:30" })
    };
    let rows: String = rows.lines().enumerate().map(with_columns).collect();
    bench.write("excel.csv", format!("sep=;\r\n{rows}"));
    let build = "space build --features physical --permutations 5 --sorting";
    // With few textures and physical features, an axis may be predicted: such positions are estimates.
    let said =
        bench.run(&format!("{build} unicode.txt --ratings excel.csv --placement felt --out human.json"));
    assert_eq!(said.code, 0, "{said:?}");
    for words in [
        "participants \"P1\", \"p1\" look alike",
        "columns age, start-time are not used",
        "assumed to be people",
    ] {
        assert!(said.stderr.contains(words), "{words}: {said:?}");
    }
    assert!(said.stdout.contains("Rated on 5 adjective pairs: rough-smooth, hard-soft"), "{said:?}");
    let json = |name: &str| serde_json::from_str::<Value>(&text(name)).unwrap();
    // They contain the same data as the plain tables.
    let report = bench.json(&format!("{build} s.csv --ratings r.csv --placement felt --out plain.json"));
    let of_tables: Vec<Value> = json("human.report.json")["warnings"].as_array().unwrap()[..2].to_vec();
    assert!(of_tables.iter().all(|warning| !report["warnings"].as_array().unwrap().contains(warning)));
    assert_eq!(
        json("human.report.json")["warnings"].as_array().unwrap()[2..],
        report["warnings"].as_array().unwrap()[..]
    );
    assert_eq!(json("human.report.json")["stress"], report["stress"]);
    // The text that nobody rated the textures is removed.
    let (human, plain) = (json("human.json"), json("plain.json"));
    let origin = human["origin"].as_str().unwrap();
    assert!(origin.ends_with("Positions come from human ratings.") && !origin.contains("nobody"), "{origin}");
    assert!(
        plain["origin"]
            .as_str()
            .unwrap()
            .ends_with("nobody rated one. Positions come from simulated raters.")
    );
    assert!(!text("human.json").contains("look alike"), "participants' names are not published");
}

/// Positions that features predict are estimates, even if people rated the textures.
#[test]
fn predicted_positions_of_people_are_estimates() {
    let bench = Bench::new();
    bench.json("space panel --sorting s.csv --ratings r.csv --seed 1");
    for name in ["s.csv", "r.csv"] {
        bench.write(name, text(&bench, name).replace("simulated-", "person-"));
    }
    let build = "space build --sorting s.csv --ratings r.csv --features physical --permutations 0";
    bench.json(&format!("{build} --placement predicted --out l.json"));
    let list = bench.json("library list --library l.json");
    assert!(
        list["textures"].as_array().unwrap().iter().all(|texture| texture["label_source"] == "estimated")
    );
    let sources = list["axis_sources"].as_str().unwrap();
    assert!(sources.contains("rough-smooth: predicted from vibration features"), "{sources}");
    assert!(sources.contains("trained on human ratings"), "{sources}");
    let library: Value = serde_json::from_str(&text(&bench, "l.json")).unwrap();
    assert!(library["origin"].as_str().unwrap().contains("Positions come from predictions from vibration"));
    assert!(!library["origin"].as_str().unwrap().contains("nobody rated"));
    assert_eq!(library["textures"][0]["attributes"]["label_source"], "human");
    bench.json("library places --library l.json --out p.csv");
    assert!(text(&bench, "p.csv").contains(",estimated,"));
    bench.json(&format!("{build} --placement felt --out l.json"));
    let list = bench.json("library list --library l.json");
    assert_eq!(
        (&list["textures"][0]["label_source"], &list["axis_sources"]),
        (&json!("human"), &json!(null))
    );
}

/// Sorts into few groups have degenerate nonmetric solutions, whose stress is nearly 0.
#[test]
fn a_degenerate_solution_is_said_and_replaced() {
    let bench = Bench::new();
    bench.json("space panel --sorting s.csv --ratings r.csv --participants 1 --groups 3,6 --seed 1");
    let build =
        "space build --sorting s.csv --ratings r.csv --features physical --permutations 0 --out l.json";
    let said = bench.run(build);
    assert!(said.code == 0 && said.stderr.contains("interval scaling was used instead"), "{said:?}");
    let report: Value = serde_json::from_str(&text(&bench, "l.report.json")).unwrap();
    assert_eq!((&report["ties"], &report["degenerate"]["replaced"]), (&json!("interval"), &json!(true)));
    let said = bench.run(&format!("{build} --ties primary"));
    assert!(said.code == 0 && said.stderr.contains("primary ties gave a degenerate solution"), "{said:?}");
    assert!(!said.stdout.contains("nearly perfect") && said.stdout.contains("is degenerate"), "{said:?}");
    let report: Value = serde_json::from_str(&text(&bench, "l.report.json")).unwrap();
    assert_eq!((&report["ties"], &report["stress_in_words"]), (&json!("primary"), &json!(null)));
}

#[test]
fn all_files_are_written_or_none() {
    let bench = Bench::new();
    bench.fails("space panel --sorting s.csv --ratings none/r.csv", 1, &["none/r.csv"]);
    let said = bench.run("space panel --sorting s.csv --ratings r.csv --participants 1");
    assert!(
        said.stdout.starts_with("Simulated 1 participant on 25 textures: 3 sorts and 125 ratings"),
        "{said:?}"
    );
    let before = std::fs::read(bench.path("s.csv")).unwrap();
    bench.fails("space panel --sorting s.csv --ratings none/r.csv --seed 2", 1, &["none/r.csv"]);
    assert_eq!(std::fs::read(bench.path("s.csv")).unwrap(), before);
    #[cfg(unix)]
    {
        bench.json("space panel --sorting s.csv --ratings r.csv --participants 6");
        // The library is written last and cannot be written: its folder does not exist, which shows only on writing.
        std::os::unix::fs::symlink("none/l.json", bench.path("l.json")).unwrap();
        let build =
            "space build --sorting s.csv --ratings r.csv --features physical --permutations 0 --out l.json";
        bench.fails(&format!("{build} --figures figures/of-space"), 1, &["l.json"]);
    }
}

#[test]
fn places_on_another_scale_are_noticed_and_taken() {
    let bench = Bench::new();
    bench.write("a.csv", "sep=,\nid,rs,hs,color,flat-bumpy\ncork,1,7,brown,4\nfelt,4,\"2,5\",gray,\n");
    let placed = bench.json("space place --attributes a.csv --source human --out l.json");
    let said = |placed: &Value, word: &str| {
        placed["warnings"].as_array().unwrap().iter().any(|w| w.as_str().unwrap().contains(word))
    };
    assert!(
        said(&placed, "between 1 and 7") && said(&placed, "--scale 1,7") && said(&placed, "column color"),
        "{placed}"
    );
    let placed = bench.json("space place --attributes a.csv --source human --scale 1,7 --out l.json");
    assert!(!said(&placed, "scale") && said(&placed, "the column color is not used"), "{placed}");
    let list = bench.json("library list --library l.json");
    let at = |id: &str| {
        list["textures"].as_array().unwrap().iter().find(|texture| texture["id"] == id).unwrap()["at"].clone()
    };
    assert_eq!((at("cork"), at("felt")), (json!([0.0, 100.0]), json!([50.0, 25.0])));
    let library = std::fs::read_to_string(bench.path("l.json")).unwrap();
    assert!(!library.contains("nobody rated") && library.contains("Positions come from human ratings."));
    let place = "space place --attributes a.csv --source human --out l.json";
    bench.fails(&format!("{place} --scale 1,6"), 1, &["hs in line 3 is 7", "between 1 and 6", "a.csv"]);
    for scale in ["7,1", "1", "1,x", "1,1", "0,inf"] {
        bench.fails(&format!("{place} --scale {scale}"), 2, &["--scale"]);
    }
    bench.write("b.csv", "id,rs,hs\ncork,-3,3\n");
    bench.fails(
        "space place --attributes b.csv --source human --out m.json",
        1,
        &["rs in line 2 is -3", "--scale"],
    );
    bench.json("space place --attributes b.csv --source human --out m.json --scale -3,3");
}

/// An old report of another space is neither removed by a command that writes none, nor taken for a report of these
/// positions.
#[test]
fn a_report_of_other_places_is_named_and_stays() {
    let bench = Bench::new();
    bench.write("a.csv", "id,rs,hs\ncork,10,20\nfelt,30,40\n");
    let report = "{\"format\": \"shagreen-space-report\", \"version\": \"1.0\"}";
    bench.write("l.report.json", report);
    bench.write("m.report.json", "{}");
    let place = |out: &str| bench.json(&format!("space place --attributes a.csv --source human --out {out}"));
    let warnings = place("l.json")["warnings"].to_string();
    assert!(warnings.contains("not these positions") && warnings.contains("l.report.json"), "{warnings}");
    assert_eq!(std::fs::read_to_string(bench.path("l.report.json")).unwrap(), report);
    assert!(!place("m.json")["warnings"].to_string().contains("report"));
}

/// Axes other than rough-smooth and hard-soft keep their names in every command.
#[test]
fn other_axes_keep_their_names() {
    let bench = Bench::new();
    bench.json("space panel --sorting s.csv --ratings r.csv --seed 1");
    let build = "space build --sorting s.csv --ratings r.csv --permutations 0 --features physical";
    // The first axis is rated as flat-bumpy: its poles are exchanged.
    bench.json(&format!("{build} --axes bumpy-flat,hard-soft --out l.json"));
    let list = bench.json("library list --library l.json");
    assert_eq!(list["axes"], json!(["bumpy-flat", "hard-soft"]));
    let written: Value = serde_json::from_slice(&std::fs::read(bench.path("l.json")).unwrap()).unwrap();
    assert_eq!((&written["version"], &written["axes"]), (&json!("1.7"), &list["axes"]));
    let names: Vec<&str> = written["textures"][0]["attributes"]["values"]
        .as_array()
        .unwrap()
        .iter()
        .map(|value| value["name"].as_str().unwrap())
        .collect();
    assert!(names.contains(&"bumpy-flat") && !names.contains(&"flat-bumpy"), "{names:?}");
    // A table of its positions gives the same library, and a panel can rate it.
    bench.json("library places --library l.json --out p.csv");
    assert!(text(&bench, "p.csv").starts_with("id,x:bumpy-flat,y:hard-soft,source,"));
    bench.json("space place --attributes p.csv --out l2.json");
    let again = bench.json("library list --library l2.json");
    assert_eq!(again["axes"], list["axes"]);
    let across = |list: &Value| list["textures"][3]["at"][0].as_f64().unwrap();
    // A table has six digits.
    assert!((across(&again) - across(&list)).abs() < 1e-3);
    bench.json("space panel --library l2.json --sorting s2.csv --ratings r2.csv");
    bench.json("space build --library l2.json --sorting s2.csv --ratings r2.csv --permutations 0 --features physical --out l3.json");
    // Files written before libraries named their axes have the names in their report.
    let mut older = written;
    older.as_object_mut().unwrap().remove("axes");
    older["version"] = json!("1.2");
    bench.write("older.json", older.to_string());
    assert_eq!(bench.json("library list --library older.json")["axes"], list["axes"]);
}

#[test]
fn few_textures_and_few_participants_are_said() {
    let bench = Bench::new();
    bench.json("space panel --sorting s.csv --ratings r.csv --participants 2");
    let report = bench.json(
        "space build --sorting s.csv --ratings r.csv --permutations 0 --features physical --out l.json",
    );
    assert_eq!(report["stability"], json!(null));
    let said = report["warnings"].to_string();
    assert!(said.contains("2 participants sorted and 2 rated, but at least 3 of each are needed"), "{said}");
    // The report and the page of figures say so too, beside what depends on it.
    let verdict = report["verdict"].to_string();
    assert!(verdict.contains("Few participants (2 sorted, 2 rated)"), "{verdict}");
    assert!(text(&bench, "l.report.svg").contains("ew participants"), "no word of it on the page");
    let keep: Vec<&str> = ["participant", "cork", "felt", "brick", "glass", "leather"].into();
    let five = |text: &str, n: usize| -> String {
        let kept = text.lines().filter(|line| keep[..=n].iter().any(|word| line.contains(word)));
        kept.collect::<Vec<_>>().join("\n")
    };
    bench.json("space panel --sorting s.csv --ratings r.csv");
    for (n, code) in [(5, 0), (3, 1)] {
        bench.write("s5.csv", five(&text(&bench, "s.csv"), n));
        let said =
            bench.run("space build --sorting s5.csv --ratings r.csv --permutations 0 --json --out l5.json");
        assert_eq!(said.code, code, "{said:?}");
        if code == 1 {
            assert!(
                said.stderr.contains("3 textures were sorted") && said.stderr.contains("s5.csv"),
                "{said:?}"
            );
        } else {
            let report: Value = serde_json::from_str(&said.stdout).unwrap();
            assert_eq!(report["axes"][0]["nested_cv_r"], json!(null));
            assert!(report["stability"]["deviation"][0].is_number());
            assert!(
                report["warnings"]
                    .to_string()
                    .contains("5 textures are too few to predict an axis from features")
            );
        }
    }
}

#[test]
fn ratings_on_another_scale_are_noticed_and_taken() {
    let bench = Bench::new();
    bench.json("space panel --sorting s.csv --ratings r.csv");
    let to_seven = |line: &str| match line.rsplit_once(',') {
        Some((rest, value)) => match value.parse::<f64>() {
            Ok(value) => format!("{rest},{}", 1.0 + 0.06 * value),
            Err(_) => line.to_owned(),
        },
        None => line.to_owned(),
    };
    let seven: Vec<String> = text(&bench, "r.csv").lines().map(to_seven).collect();
    bench.write("r7.csv", seven.join("\n"));
    let build = "space build --sorting s.csv --permutations 0 --features physical";
    let plain = bench.json(&format!("{build} --ratings r.csv --out l.json"));
    let scaled = bench.json(&format!("{build} --ratings r7.csv --scale 1,7 --out l7.json"));
    for (a, b) in plain["positions"].as_array().unwrap().iter().zip(scaled["positions"].as_array().unwrap()) {
        let at = |position: &Value| position["at"][0].as_f64().unwrap();
        assert!((at(a) - at(b)).abs() < 1e-6, "{a} {b}");
    }
    let said = bench.run(&format!("{build} --ratings r7.csv --out l8.json"));
    assert!(said.code == 0 && said.stderr.contains("warning: no rating is above 7"), "{said:?}");
    let said = bench.run(&format!("{build} --ratings r7.csv --scale 1,6 --out l9.json"));
    assert!(said.code == 1 && said.stderr.contains("not on the stated scale"), "{said:?}");
}
