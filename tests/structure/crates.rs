//! Allowed dependencies between the crates, as in ARCHITECTURE.md. A crate that depends on a higher one fails this
//! test.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Every crate of the workspace, and the workspace crates that it may use.
const MAY_USE: &[(&str, &[&str])] = &[
    ("shagreen-synth", &[]),
    ("shagreen-runtime", &["shagreen-synth"]),
    ("shagreen-core", &["shagreen-synth"]),
    ("shagreen-formats", &["shagreen-core"]),
    ("shagreen-device", &["shagreen-synth"]),
    ("shagreen-learn", &["shagreen-core"]),
    ("shagreen-studio", &["shagreen-core", "shagreen-formats", "shagreen-device", "shagreen-learn"]),
    (
        "shagreen-app",
        &["shagreen-core", "shagreen-formats", "shagreen-device", "shagreen-learn", "shagreen-studio"],
    ),
    ("shagreen-python", &["shagreen-core", "shagreen-formats", "shagreen-studio"]),
    (
        "shagreen",
        &[
            "shagreen-app",
            "shagreen-core",
            "shagreen-formats",
            "shagreen-device",
            "shagreen-learn",
            "shagreen-studio",
        ],
    ),
];

/// Returns the rules that a manifest breaks; test dependencies are not checked.
fn broken_rules(manifest: &str) -> Vec<String> {
    let manifest: toml::Table = toml::from_str(manifest).expect("a manifest is TOML");
    let name = manifest["package"]["name"].as_str().expect("a package has a name").to_owned();
    let Some((_, allowed)) = MAY_USE.iter().find(|(n, _)| *n == name) else {
        return vec![format!(
            "{name} is not a known crate of the workspace: add it to ARCHITECTURE.md and to this test"
        )];
    };
    let mut used = Vec::new();
    house_crates(&toml::Value::Table(manifest.clone()), &mut used);
    used.iter()
        .filter(|d| !allowed.contains(&d.as_str()))
        .map(|d| format!("{name} must not depend on {d}"))
        .collect()
}

/// Collects the workspace crates in every table of dependencies, including those for one platform. Dev-dependencies are
/// not checked.
fn house_crates(value: &toml::Value, found: &mut Vec<String>) {
    for (key, inner) in value.as_table().into_iter().flatten() {
        if key == "dependencies" || key == "build-dependencies" {
            let names = inner.as_table().into_iter().flatten().map(|(name, _)| name);
            found.extend(names.filter(|name| name.starts_with("shagreen")).cloned());
        } else if key != "workspace" {
            // The root's list of versions does not use the crates.
            house_crates(inner, found);
        }
    }
}

fn manifests() -> BTreeMap<PathBuf, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = std::fs::read_dir(root.join("crates")).expect("the workspace has crates");
    let mut paths: Vec<PathBuf> =
        crates.map(|c| c.expect("a folder entry").path().join("Cargo.toml")).collect();
    paths.push(root.join("Cargo.toml"));
    paths.into_iter().map(|p| (p.clone(), std::fs::read_to_string(p).expect("a manifest"))).collect()
}

#[test]
fn no_crate_depends_upwards() {
    let manifests = manifests();
    assert_eq!(manifests.len(), MAY_USE.len(), "a crate is missing from this test, or gone");
    let broken: Vec<String> = manifests.values().flat_map(|m| broken_rules(m)).collect();
    assert!(broken.is_empty(), "{broken:#?}");
}

/// Negative control: the check detects violations.
#[test]
fn the_gate_can_fail() {
    let upwards = "[package]\nname = \"shagreen-device\"\n[dependencies]\nshagreen-core.workspace = true\n";
    assert_eq!(broken_rules(upwards), ["shagreen-device must not depend on shagreen-core"]);
    let runtime = "[package]\nname = \"shagreen-runtime\"\n[dependencies]\nshagreen-core.workspace = true\n";
    assert_eq!(broken_rules(runtime), ["shagreen-runtime must not depend on shagreen-core"]);
    let on_one_platform =
        "[package]\nname = \"shagreen-synth\"\n[target.'cfg(unix)'.dependencies]\nshagreen-core = \"0\"\n";
    assert_eq!(broken_rules(on_one_platform), ["shagreen-synth must not depend on shagreen-core"]);
    let unknown = "[package]\nname = \"shagreen-attic\"\n";
    assert_eq!(broken_rules(unknown).len(), 1);
    let downwards = "[package]\nname = \"shagreen-core\"\n[dependencies]\nshagreen-synth.workspace = true\n";
    assert!(broken_rules(downwards).is_empty());
}

/// Returns the files below `src/cli` that name the window's crate.
fn command_line_files_that_see_the_window(folder: &Path) -> Vec<String> {
    let mut seen = Vec::new();
    for entry in std::fs::read_dir(folder).expect("the command line") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            seen.extend(command_line_files_that_see_the_window(&path));
        } else if sees_the_window(&std::fs::read_to_string(&path).expect("a source file")) {
            seen.push(path.display().to_string());
        }
    }
    seen
}

fn sees_the_window(text: &str) -> bool {
    text.lines().any(|line| !line.trim_start().starts_with("//") && line.contains("shagreen_app"))
}

/// The window and the command line share `studio` and do not use each other.
#[test]
fn the_command_line_does_not_see_the_window() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/cli");
    let seen = command_line_files_that_see_the_window(&folder);
    assert!(seen.is_empty(), "{seen:#?}");
    assert!(sees_the_window("use shagreen_app::window::Window;") && !sees_the_window("// shagreen_app"));
}
