//! Who may use whom, as ARCHITECTURE.md draws it. A crate that depends upwards fails here, before anybody gets used to it.

#![allow(clippy::expect_used, reason = "a test may stop at what it did not expect")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Every crate of the house and the crates of the house that it may use.
const MAY_USE: &[(&str, &[&str])] = &[
    ("shagreen-synth", &[]),
    ("shagreen-core", &["shagreen-synth"]),
    ("shagreen-formats", &["shagreen-core"]),
    ("shagreen-device", &["shagreen-synth"]),
    ("shagreen-learn", &["shagreen-core"]),
    ("shagreen-app", &["shagreen-core", "shagreen-formats", "shagreen-device", "shagreen-learn"]),
    ("shagreen", &["shagreen-app", "shagreen-core", "shagreen-formats", "shagreen-device", "shagreen-learn"]),
];

/// The rules that a manifest breaks; test dependencies may look anywhere below.
fn broken_rules(manifest: &str) -> Vec<String> {
    let manifest: toml::Table = toml::from_str(manifest).expect("a manifest is TOML");
    let name = manifest["package"]["name"].as_str().expect("a package has a name").to_owned();
    let Some((_, allowed)) = MAY_USE.iter().find(|(n, _)| *n == name) else {
        return vec![format!(
            "{name} is not a crate of the house: add it to ARCHITECTURE.md and to this test"
        )];
    };
    let mut used = Vec::new();
    house_crates(&toml::Value::Table(manifest.clone()), &mut used);
    used.iter()
        .filter(|d| !allowed.contains(&d.as_str()))
        .map(|d| format!("{name} must not depend on {d}"))
        .collect()
}

/// The crates of the house in every table of dependencies, those for one platform too. Tests may look anywhere.
fn house_crates(value: &toml::Value, found: &mut Vec<String>) {
    for (key, inner) in value.as_table().into_iter().flatten() {
        if key == "dependencies" || key == "build-dependencies" {
            let names = inner.as_table().into_iter().flatten().map(|(name, _)| name);
            found.extend(names.filter(|name| name.starts_with("shagreen")).cloned());
        } else if key != "workspace" {
            // The root's list of versions is no use of a crate.
            house_crates(inner, found);
        }
    }
}

fn manifests() -> BTreeMap<PathBuf, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = std::fs::read_dir(root.join("crates")).expect("the house has rooms");
    let mut paths: Vec<PathBuf> = crates.map(|c| c.expect("a room").path().join("Cargo.toml")).collect();
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

/// The negative control: the gate sees what it is there for.
#[test]
fn the_gate_can_fail() {
    let upwards = "[package]\nname = \"shagreen-device\"\n[dependencies]\nshagreen-core.workspace = true\n";
    assert_eq!(broken_rules(upwards), ["shagreen-device must not depend on shagreen-core"]);
    let on_one_platform =
        "[package]\nname = \"shagreen-synth\"\n[target.'cfg(unix)'.dependencies]\nshagreen-core = \"0\"\n";
    assert_eq!(broken_rules(on_one_platform), ["shagreen-synth must not depend on shagreen-core"]);
    let unknown = "[package]\nname = \"shagreen-attic\"\n";
    assert_eq!(broken_rules(unknown).len(), 1);
    let downwards = "[package]\nname = \"shagreen-core\"\n[dependencies]\nshagreen-synth.workspace = true\n";
    assert!(broken_rules(downwards).is_empty());
}

/// Whether a crate's root carries this attribute; the word in a comment is not enough.
fn carries(text: &str, attribute: &str) -> bool {
    text.lines().any(|line| line.trim() == attribute)
}

/// Unsafe code is forbidden everywhere but in `device`, where each use would have to give its reason.
#[test]
fn every_crate_but_device_forbids_unsafe_code() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let roots = ["synth", "core", "formats", "app"].map(|c| root.join("crates").join(c).join("src/lib.rs"));
    for path in roots.into_iter().chain([root.join("src/main.rs")]) {
        let text = std::fs::read_to_string(&path).expect("a crate has a root");
        assert!(carries(&text, "#![forbid(unsafe_code)]"), "{} does not forbid unsafe code", path.display());
    }
    let device = std::fs::read_to_string(root.join("crates/device/src/lib.rs")).expect("device has a root");
    assert!(carries(&device, "#![deny(unsafe_code)]"));
    assert!(!carries("// #![forbid(unsafe_code)]", "#![forbid(unsafe_code)]"), "the gate can fail");
}
