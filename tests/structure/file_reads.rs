//! Files are read through `formats::bounded_file`, which refuses devices, pipes and files without bound.

use std::path::Path;

/// Calls that read a file of any kind and size.
const UNBOUNDED: [&str; 3] = ["fs::read(", "fs::read_to_string(", "File::open("];

/// Files that may read on their own, with the reason.
const ALLOWED: [(&str, &str); 5] = [
    ("crates/formats/src/bounded_file.rs", "the bound itself"),
    ("crates/formats/src/atomic.rs", "opens folders to flush them"),
    ("crates/device/src/hid/system.rs", "descriptors that the kernel publishes"),
    ("crates/device/src/output_claim.rs", "its own file in the runtime folder"),
    ("crates/device/src/pulse/connection.rs", "the cookie of the sound server"),
];

/// Returns the unbounded calls in code before its tests.
fn unbounded_in(text: &str) -> Vec<&'static str> {
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    let lines = || code.lines().filter(|line| !line.trim_start().starts_with("//"));
    // `SettingsFile::open` and `bounded_file::read` only end like the calls.
    let is_in = |line: &str, call: &str| {
        let before = |at: usize| line[..at].chars().next_back();
        line.match_indices(call).any(|(at, _)| before(at).is_none_or(|c| !c.is_alphanumeric() && c != '_'))
    };
    let is_called = |call: &&str| lines().any(|line| is_in(line, call));
    UNBOUNDED.into_iter().filter(is_called).collect()
}

/// Files of tests that are not in a folder of their own.
fn is_test(name: &str) -> bool {
    name.ends_with("tests.rs")
}

fn check_folder(folder: &Path, root: &Path, found: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).expect("a folder of source files") {
        let path = entry.expect("an entry").path();
        let name = path.strip_prefix(root).expect("below the root").to_string_lossy().replace('\\', "/");
        if path.is_dir() {
            if !name.ends_with("/tests") {
                check_folder(&path, root, found);
            }
        } else if path.extension().is_some_and(|ending| ending == "rs") && !is_test(&name) {
            let text = std::fs::read_to_string(&path).expect("UTF-8");
            let is_allowed = ALLOWED.iter().any(|(allowed, _)| *allowed == name);
            if !is_allowed {
                found.extend(unbounded_in(&text).into_iter().map(|call| format!("{name} calls {call}…)")));
            }
        }
    }
}

#[test]
fn files_are_read_with_a_bound() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    for name in ["app", "core", "device", "formats", "learn", "python", "runtime-c", "studio", "synth"] {
        check_folder(&root.join("crates").join(name).join("src"), root, &mut found);
    }
    check_folder(&root.join("src"), root, &mut found);
    assert!(found.is_empty(), "use formats::bounded_file instead: {found:#?}");
}

/// Negative control.
#[test]
fn a_read_without_a_bound_is_found() {
    assert_eq!(unbounded_in("let a = std::fs::read(path);"), ["fs::read("]);
    assert_eq!(unbounded_in("let a = File::open(path);\n"), ["File::open("]);
    let fine = "// fs::read(x)\nlet a = bounded_file::read(path, kind);\nSettingsFile::open(x);\n#[cfg(test)]\nmod tests { fs::read(x) }";
    assert!(unbounded_in(fine).is_empty());
}
