//! The commands of the guide, run in order: each page in a folder of its own, which holds only the files that the page
//! takes from the user.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use shagreen_formats::starter::{starter_bytes, starter_library};

use crate::support::Bench;

/// Parts of commands that a test cannot run, and why.
const NOT_RUN: [(&str, &str); 19] = [
    ("--output ID", "needs a sound output"),
    ("PORT", "needs a serial port"),
    ("--pty", "is an example program"),
    ("sudo ", "needs a pen"),
    ("pen.bin", "needs a pen"),
    ("reports.txt", "needs a pen"),
    ("recorded.wav", "needs the recording of a sweep"),
    ("model fetch", "downloads a network"),
    ("model add", "needs downloaded files"),
    ("--diffusion", "needs a downloaded network"),
    ("--photo", "needs a network or a photo of the user"),
    ("train ", "takes minutes to hours"),
    ("--model strokes.safetensors", "needs a trained model"),
    ("--blend all", "takes minutes"),
    ("--figures plots", "takes as long as the command before it"),
    ("evaluate codec", "takes a minute"),
    ("shagreen materials.json", "opens the window"),
    ("shagreen mine.shagreen", "opens the window"),
    ("shagreen ten.toml", "opens the window"),
];
/// Pages whose commands take models that may not be distributed.
const OF_OTHERS: [&str; 1] = ["Models/"];

/// Commands of a page, in order, without those that are not run.
fn commands(page: &str) -> Vec<String> {
    let blocks = page.split("```").skip(1).step_by(2).filter_map(|block| block.strip_prefix('\n'));
    let lines = blocks.flat_map(str::lines).map(|line| line.split("  #").next().unwrap_or(line).trim());
    let runs = |line: &&str| {
        (line.starts_with("shagreen ") || line.starts_with("printf "))
            && !NOT_RUN.iter().any(|(part, _)| line.contains(part))
            && !OF_OTHERS.iter().any(|part| line.contains(part))
    };
    lines.filter(runs).map(str::to_owned).collect()
}

/// The block of code of this kind on a page.
fn block<'a>(page: &'a str, kind: &str) -> &'a str {
    let start = page.find(&format!("```{kind}\n")).unwrap() + kind.len() + 4;
    &page[start..start + page[start..].find("```").unwrap()]
}

/// A recording in the columns that the map of the guide states: time, three accelerations in g, speed, force.
fn recording(of: &Bench, name: &str, separator: &str) {
    let mut text = ["t", "ax", "ay", "az", "v", "f"].join(separator) + "\n";
    for i in 0..6000 {
        let wave = (0.9 * f64::from(i)).sin() + 0.5 * (0.31 * f64::from(i * i % 977)).sin();
        let number = |value: f64| {
            if separator == ";" { format!("{value:.4}").replace('.', ",") } else { format!("{value:.4}") }
        };
        let row = [f64::from(i), 0.1 * wave, 0.05 * wave, 0.02 * wave, 100.0, 1.0].map(number);
        text += &(row.join(separator) + "\n");
    }
    of.write(name, text);
}

/// Puts the files that a page takes from the user into the folder.
fn give(bench: &Bench, page: &str, lines: &[String]) {
    let takes = |name: &str| lines.iter().any(|line| line.contains(name));
    let is_made = |name: &str| lines.iter().any(|line| line.contains(&format!("--out {name}")));
    if takes("recorded.json") && !is_made("recorded.json") {
        bench.write("recorded.json", starter_bytes());
    }
    if takes("recording.csv") {
        let rows = (0..4000).map(|i| {
            let wave = (0.9 * f64::from(i)).sin() + 0.5 * (0.31 * f64::from(i * i % 977)).sin();
            format!("{:.4},{wave:.4},100,1\n", f64::from(i) / 1000.0)
        });
        bench.write(
            "recording.csv",
            rows.fold("time_s,acceleration,speed_mm_s,force_n\n".to_owned(), |all, row| all + &row),
        );
    }
    if takes("map.toml") {
        bench.write("map.toml", block(page, "toml"));
    }
    if takes("pairs.csv") {
        bench.write("pairs.csv", block(page, "csv"));
    }
    if takes("batch.toml") {
        bench.write("batch.toml", block(page, "toml"));
    }
    if takes("buzz.haptic") {
        bench.write("buzz.haptic", crate::clips::clip());
    }
    if takes("a.csv") {
        recording(bench, "a.csv", ";");
        recording(bench, "b.csv", ";");
    }
    if takes("--stroke stroke.csv") {
        bench.write("stroke.csv", "t_s,speed,force\n0,0,0.5\n1,150,1\n2,0,0.5\n");
    }
    if takes("strokes/") {
        fs::create_dir(bench.path("strokes")).unwrap();
        let said = bench.run("render --texture cork --speed 100 --force 1 --seconds 2 -o strokes/one.wav");
        assert_eq!(said.code, 0, "{said:?}");
    }
    if takes("directions/") {
        crate::import_directional::write_folder(bench, "directions");
    }
    if takes("materials.toml") {
        let materials = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/starter/materials.toml");
        // Two materials are made quickly.
        let text = fs::read_to_string(materials).unwrap();
        let few: Vec<&str> = text.split("[[material]]").take(3).collect();
        bench.write("materials.toml", few.join("[[material]]"));
    }
    if takes("leather.png") {
        let grain = |x: u32, y: u32| image::Luma([((31 * x * x + 57 * y * y) % 251) as u8]);
        image::GrayImage::from_fn(64, 64, grain).save(bench.path("leather.png")).unwrap();
    }
    if takes("positions.csv") {
        let said = bench.run("library places --out positions.csv");
        assert_eq!(said.code, 0, "{said:?}");
    }
    if takes("texture.wav") && !takes("-o texture.wav") {
        let said = bench.run("render --texture cork --speed 100 --force 1 --seconds 1 -o texture.wav");
        assert_eq!(said.code, 0, "{said:?}");
    }
    if takes("back.wav") && !takes("-o back.wav") {
        let said = bench.run("render --texture felt --speed 100 --force 1 --seconds 1 -o back.wav");
        assert_eq!(said.code, 0, "{said:?}");
    }
    if takes("--texture recording") {
        let mut library = starter_library().unwrap();
        "recording".clone_into(&mut library.textures[0].id);
        bench.write("recorded.json", shagreen_formats::library::write_library(&library));
    }
}

#[test]
fn the_commands_of_the_guide_run_in_order() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/guide");
    let pages: BTreeMap<String, String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .map(|path| {
            (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read_to_string(path).unwrap())
        })
        .collect();
    let program = Path::new(env!("CARGO_BIN_EXE_shagreen")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let (mut n_run, mut failures) = (0, Vec::new());
    for (name, page) in &pages {
        let lines = commands(page);
        let bench = Bench::new();
        give(&bench, page, &lines);
        for line in &lines {
            n_run += 1;
            let begun = std::time::Instant::now();
            let output = Command::new("sh")
                .args(["-c", line])
                .env("PATH", &path)
                .env("XDG_DATA_HOME", bench.path("data"))
                .current_dir(bench.path("."))
                .output()
                .unwrap();
            println!("{:5.1} s  {line}", begun.elapsed().as_secs_f64());
            if !output.status.success() {
                failures
                    .push(format!("{name}: {line}\n    {}", String::from_utf8_lossy(&output.stderr).trim()));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(n_run >= 40, "only {n_run} commands were found");
}

/// A guide that was not followed would be noticed.
#[test]
fn a_command_that_cannot_run_is_found() {
    assert_eq!(
        commands("text\n```\nshagreen render --no-such-option   # a remark\n```\n"),
        ["shagreen render --no-such-option"]
    );
    assert_eq!(commands("```\nshagreen play --output ID\nls\n```\n```toml\nshagreen = 1\n```\n"), [""; 0]);
}
