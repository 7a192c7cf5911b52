//! Unsafe code is forbidden everywhere except in `device`.

use std::path::Path;

/// Returns whether a crate's root has this attribute; a mention in a comment does not count.
fn carries(text: &str, attribute: &str) -> bool {
    text.lines().any(|line| line.trim() == attribute)
}

/// Unsafe code is forbidden everywhere except in `device`, where each use must state its reason.
#[test]
fn every_crate_but_device_forbids_unsafe_code() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let roots = ["synth", "core", "formats", "learn", "studio", "app"]
        .map(|c| root.join("crates").join(c).join("src/lib.rs"));
    for path in roots.into_iter().chain([root.join("src/main.rs")]) {
        let text = std::fs::read_to_string(&path).expect("a crate has a root file");
        assert!(carries(&text, "#![forbid(unsafe_code)]"), "{} does not forbid unsafe code", path.display());
    }
    let device =
        std::fs::read_to_string(root.join("crates/device/src/lib.rs")).expect("device has a root file");
    assert!(carries(&device, "#![deny(unsafe_code)]"));
    assert!(!carries("// #![forbid(unsafe_code)]", "#![forbid(unsafe_code)]"), "the check can fail");
}
