//! `shagreen batch`.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use crate::support::Bench;

const HEAD: &str = "format = \"shagreen-batch\"\nversion = \"1.0\"\nname = \"Test\"\nseed = 5\n";
/// Every texture of the starter library along a steady stroke.
const ALL: &str = "[[texture]]\nall = true\n[[stroke]]\nid = \"slow\"\nspeed_mm_per_s = 60\nforce_n = 0.5\nseconds = 0.5\n[[output]]\nid = \"wav\"\nformat = \"wav\"\nrate_hz = 4000\n";

/// All files of a folder by their paths.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if !path.file_name().unwrap().to_str().unwrap().starts_with(".shagreen-") {
                // A process that was killed leaves a temporary file, which is deleted after an hour.
                all.insert(
                    path.strip_prefix(folder).unwrap().display().to_string(),
                    fs::read(&path).unwrap(),
                );
            }
        }
    }
    all
}

/// A file of a batch is that of the command which makes a single one.
#[test]
fn files_are_those_of_the_other_commands() {
    let bench = Bench::new();
    bench.write("strokes/short.csv", "t_s,speed,force\n0,0,0.5\n0.2,150,1\n0.4,0,0.5\n");
    bench.write(
        "mine.toml",
        format!(
            "{HEAD}[[texture]]\nids = [\"cork\"]\nshape = \"level=-3\"\n[[texture]]\nat = [[30, 70]]\nblend = \"parametric\"\n[[stroke]]\nid = \"short\"\nfile = \"strokes/short.csv\"\n[[stroke]]\nid = \"steady\"\nspeed_mm_per_s = 60\nforce_n = 0.5\nseconds = 0.3\n[[output]]\nid = \"wav\"\nformat = \"wav\"\nrate_hz = 8000\nbits = 16\n[[output]]\nid = \"xml\"\nformat = \"hatt\"\n"
        ),
    );
    let done = bench.json("batch mine.toml --out made --jobs 1");
    assert_eq!((&done["jobs"], &done["written"], &done["kept"]), (&6.into(), &6.into(), &0.into()), "{done}");
    for (arguments, name) in [
        ("--texture cork --shape level=-3 --stroke strokes/short.csv", "cork--short"),
        ("--texture cork --shape level=-3 --speed 60 --force 0.5 --seconds 0.3", "cork--steady"),
        ("--at 30,70 --blend parametric --speed 60 --force 0.5 --seconds 0.3", "at-30-70--steady"),
    ] {
        bench.json(&format!("render {arguments} --seed 5 --rate 8000 --bits 16 -o one.wav"));
        for (made, ending) in [("one.wav", "wav"), ("one.json", "json")] {
            let of_batch = fs::read(bench.path(&format!("made/wav/{name}.{ending}"))).unwrap();
            assert_eq!(of_batch, fs::read(bench.path(made)).unwrap(), "{name}.{ending}");
        }
    }
    bench.json("export --texture cork --shape level=-3 --format hatt -o one.xml");
    assert_eq!(fs::read(bench.path("made/xml/cork.xml")).unwrap(), fs::read(bench.path("one.xml")).unwrap());
}

#[test]
fn parts_of_a_batch_are_the_whole() {
    let bench = Bench::new();
    bench.write("all.toml", format!("{HEAD}{ALL}"));
    let whole = bench.json("batch all.toml --out whole --jobs 2");
    assert_eq!(whole["jobs"], 25);
    let shards = [1, 2].map(|i| bench.json(&format!("batch all.toml --out parts --shard {i}/2 --jobs 1")));
    assert_eq!(shards.map(|shard| shard["written"].as_u64().unwrap()), [13, 12]);
    assert_eq!(files(&bench.path("parts")), files(&bench.path("whole")));
    // The run of the whole has nothing left to do.
    let again = bench.run("batch all.toml --out parts");
    assert!(again.stdout.contains("0 written, 25 done before, of 25 jobs"), "{again:?}");
    bench.fails("batch all.toml --out parts --shard 3/2", 2, &["part 3 of 2 does not exist"]);
}

/// Killed at any moment, a batch goes on and gives the same bytes.
#[test]
fn a_killed_batch_goes_on() {
    let bench = Bench::new();
    bench.write("all.toml", format!("{HEAD}{ALL}"));
    bench.json("batch all.toml --out whole");
    let records = bench.path("killed/records/wav");
    for n_before in [1, 8] {
        let mut child = bench
            .command("batch all.toml --out killed --jobs 1")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let begun = Instant::now();
        let n_records = || fs::read_dir(&records).map_or(0, Iterator::count);
        while n_records() < n_before && begun.elapsed() < Duration::from_secs(30) {
            std::thread::sleep(Duration::from_millis(2));
        }
        // It may have ended by itself on a fast machine.
        let _ = child.kill();
        child.wait().unwrap();
    }
    let done = bench.json("batch all.toml --out killed");
    let sum = done["written"].as_u64().unwrap() + done["kept"].as_u64().unwrap();
    assert!(sum == 25 && done["kept"].as_u64().unwrap() >= 5, "{done}");
    assert_eq!(files(&bench.path("killed")), files(&bench.path("whole")));
}

#[test]
fn a_job_that_fails_is_listed_at_the_end() {
    let bench = Bench::new();
    bench.write(
        "mine.toml",
        format!("{HEAD}{ALL}[[output]]\nid = \"flat\"\nformat = \"maps\"\n")
            .replace("all = true", "ids = [\"cork\", \"felt\"]\nshape = \"level=-6\""),
    );
    let said = bench.run("batch mine.toml --out made --json");
    assert_eq!(said.code, 1, "{said:?}");
    let result: serde_json::Value = serde_json::from_str(&said.stdout).unwrap();
    assert_eq!((&result["written"], result["failed"].as_array().unwrap().len()), (&2.into(), 2), "{result}");
    assert!(result["failed"][0]["job"].as_str().unwrap().starts_with("flat/"), "{result}");
    assert!(said.stderr.contains("2 of 4 jobs failed"), "{said:?}");
    let said = bench.run("batch mine.toml --out made");
    assert!(said.stdout.contains("failed: flat/cork: ") && said.stdout.contains("2 done before"), "{said:?}");
}

#[test]
fn a_manifest_that_cannot_be_run_says_everything_at_once() {
    let bench = Bench::new();
    let check = |text: &str, words: &[&str]| {
        bench.write("mine.toml", text);
        bench.fails("batch mine.toml --out made", 1, words);
    };
    check(
        &format!("{HEAD}{ALL}").replace("all = true", "idz = [\"cork\"]"),
        &["did you mean ids?", "line 6", "mine.toml"],
    );
    check(
        &format!("{HEAD}{ALL}actuator = \"none\"\n")
            .replace("all = true", "ids = [\"crok\"]")
            .replace("speed_mm_per_s = 60\nforce_n = 0.5\nseconds = 0.5", "file = \"none.csv\""),
        &["3 problems", "no texture \"crok\"; did you mean cork", "stroke[1].file", "output[1].actuator"],
    );
    check("a = [", &["line 1"]);
    // Keys, the library, strokes and actuators: a problem of one hides none of the others, and has no consequences.
    check(
        &format!("{HEAD}library = \"none.json\"\n{ALL}actuator = \"none\"\nbit = 16\n")
            .replace("all = true", "ids = [\"crok\"]")
            .replace("speed_mm_per_s = 60\nforce_n = 0.5\nseconds = 0.5", "file = \"none.csv\""),
        &["4 problems", "line 5, library: ", "did you mean bits", "stroke[1].file", "output[1].actuator"],
    );
    check(
        &format!("{HEAD}{ALL}").replace("rate_hz = 4000", "rate_hz = 500"),
        &["1 problem", "output[1].rate_hz: it is 500 Hz", "at least 1000 Hz"],
    );
    bench.write("mine.toml", format!("{HEAD}{ALL}"));
    bench.write("used/notes.txt", "x");
    bench.fails("batch mine.toml --out used", 1, &["no batch has written", "used"]);
    bench.fails("batch none.toml --out made", 1, &["there is no such file", "none.toml"]);
    assert_eq!(fs::read_to_string(bench.path("used/notes.txt")).unwrap(), "x");
}

/// Authored textures of a project, in the formats of haptic clips.
#[test]
fn a_project_is_a_source_too() {
    let bench = Bench::new();
    bench.json("project new -o mine.shagreen");
    bench.write(
        "mine.toml",
        format!("{HEAD}{ALL}[[output]]\nid = \"clip\"\nformat = \"haptic\"\n")
            .replace("seed = 5\n", "project = \"mine.shagreen\"\n")
            .replace("all = true", "authored = [\"New texture\"]"),
    );
    let done = bench.json("batch mine.toml --out made");
    assert_eq!(done["written"], 2, "{done}");
    assert!(bench.path("made/clip/new-texture--slow.haptic").is_file());
}
