//! Long work shows on standard error that it goes on.

use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use crate::support::Bench;

/// Longest time to the first line: 0.3 s of work, and the start of the program on a busy machine.
const SOON: Duration = Duration::from_secs(30);

#[test]
fn long_work_says_soon_what_it_does() {
    let bench = Bench::new();
    let materials = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/starter/materials.toml");
    let text = std::fs::read_to_string(materials).unwrap();
    // The same materials under other names, for work of many seconds.
    let (head, first) = text.split_once("[[material]]").unwrap();
    let body = format!("[[material]]{first}");
    let copies: String = (0..3).map(|i| body.replace("\nid = \"", &format!("\nid = \"copy-{i}-"))).collect();
    bench.write("materials.toml", format!("{head}{copies}"));
    for command in [
        "library make materials.toml --out made.json",
        "generate rough-sandstone --size 2048 --out made",
        "train photo --drawn 2000 --epochs 1 --heads 1",
        "render --texture cork --speed 100 --force 1 --seconds 3600 -o long.wav",
        "space build --sorting s.csv --ratings r.csv --permutations 100000 --out l.json",
    ] {
        if command.starts_with("space build") {
            bench.json("space panel --sorting s.csv --ratings r.csv");
        }
        let begun = Instant::now();
        let mut child = bench.command(command).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stderr.take().unwrap()).read_line(&mut line).unwrap();
        let elapsed = begun.elapsed();
        // It may have ended by itself.
        child.kill().ok();
        child.wait().unwrap();
        assert!(line.starts_with("note: ") && line.trim_end().ends_with(": started"), "{command}: {line:?}");
        assert!(elapsed < SOON, "{command}: {elapsed:?}");
    }
}

#[test]
fn quick_work_says_nothing_of_its_progress() {
    let bench = Bench::new();
    assert_eq!(bench.run("library list").stderr, "");
    assert_eq!(bench.run("actuator list").stderr, "");
}
