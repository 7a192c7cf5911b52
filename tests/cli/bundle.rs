//! `shagreen bundle`.

use std::fs;

use shagreen_formats::library::{Provenance, write_library};
use shagreen_formats::starter::starter_library;

use crate::support::Bench;

/// A project comes back on another computer, with a signal that was rendered from it.
#[test]
fn a_project_is_shared_with_its_files() {
    let bench = Bench::new();
    bench.json("project new -o mine.shagreen");
    fs::create_dir(bench.path("signals")).unwrap();
    bench.json("render --texture cork --speed 60 --force 0.5 --seconds 0.1 -o signals/cork.wav");
    let made = bench.json("bundle mine.shagreen --export signals --out mine.zip");
    assert_eq!((&made["kind"], &made["name"]), (&"project".into(), &"mine".into()), "{made}");
    let paths: Vec<&str> =
        made["files"].as_array().unwrap().iter().map(|file| file["path"].as_str().unwrap()).collect();
    assert_eq!(paths, ["exports/signals/cork.json", "exports/signals/cork.wav", "mine.shagreen"]);
    // The same content gives the same bytes, and a bundle may be made again.
    let bytes = fs::read(bench.path("mine.zip")).unwrap();
    bench.json("bundle mine.shagreen --export signals --out mine.zip");
    assert_eq!(fs::read(bench.path("mine.zip")).unwrap(), bytes);
    let checked = bench.run("bundle --check mine.zip");
    assert!(checked.stdout.contains("every file is the one that was bundled"), "{checked:?}");
    let out = bench.run("bundle --extract mine.zip theirs");
    assert!(out.code == 0 && out.stdout.contains("open theirs/mine.shagreen"), "{out:?}");
    for (theirs, mine) in
        [("mine.shagreen", "mine.shagreen"), ("exports/signals/cork.wav", "signals/cork.wav")]
    {
        let theirs = fs::read(bench.path("theirs").join(theirs)).unwrap();
        assert_eq!(theirs, fs::read(bench.path(mine)).unwrap(), "{mine}");
    }
    bench.json("project show theirs/mine.shagreen");
    bench.fails("bundle --extract mine.zip theirs", 1, &["could be overwritten", "theirs"]);
}

#[test]
fn a_changed_bundle_is_found_and_not_unpacked() {
    let bench = Bench::new();
    bench.write("few.json", write_library(&starter_library().unwrap()));
    bench.json("bundle few.json --out few.zip");
    let mut bytes = fs::read(bench.path("few.zip")).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 4;
    bench.write("few.zip", &bytes);
    bench.fails("bundle --check few.zip", 1, &["of the bundle", "copy the bundle again", "few.zip"]);
    bench.fails("bundle --extract few.zip out", 1, &["of the bundle"]);
    bench.write("few.zip", &bytes[..middle]);
    bench.fails("bundle --check few.zip", 1, &["the bundle is damaged"]);
    bench.write("notes.txt", "notes");
    bench.fails("bundle --check notes.txt", 1, &["not a bundle"]);
    bench.fails("bundle few.json --out notes.txt", 1, &["would replace a file of another kind"]);
    bench.fails("bundle few.json --out d3.rar", 1, &["a .zip file, not to .rar", "d3.rar"]);
    bench.fails("bundle few.json --out -", 2, &["standard output"]);
    bench.fails("bundle notes.txt --out new.zip", 1, &["notes.txt"]);
    bench.fails("bundle few.json", 2, &["--out"]);
    bench.fails("bundle --check few.zip --out new.zip", 2, &["--check"]);
}

#[test]
fn restricted_textures_are_named_and_stop_a_bundle() {
    let bench = Bench::new();
    let mut library = starter_library().unwrap();
    library.textures.truncate(5);
    library.textures[2].provenance = Provenance::Restricted;
    let name = library.textures[2].name.clone();
    bench.write("few.json", write_library(&library));
    bench.fails(
        "bundle few.json --out few.zip",
        1,
        &[
            "must not be redistributed",
            &format!("1 texture: \"{name}\""),
            "--override-restriction",
            "few.json",
        ],
    );
    let said = bench.run("bundle few.json --override-restriction --out few.zip");
    assert!(said.code == 0 && said.stderr.contains("you have the right to share it"), "{said:?}");
    let list = bench.json("bundle --check few.zip");
    assert_eq!(list["restricted"], 1);
    assert!(list["override_restriction"].as_str().unwrap().contains("states the right"), "{list}");
}
