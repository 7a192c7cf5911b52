//! Unsafe code is forbidden everywhere except in `device` and `runtime-c`, where each use states its reason.

use std::path::{Path, PathBuf};

/// Crates that talk to systems, or to callers in other languages, which no safe code can.
const MAY_BE_UNSAFE: [&str; 2] = ["device", "runtime-c"];
/// Lines above an unsafe block that are searched for its reason: a statement may begin there.
const LINES_ABOVE: usize = 3;

/// Returns whether a crate's root has this attribute; a mention in a comment does not count.
fn carries(text: &str, attribute: &str) -> bool {
    text.lines().any(|line| line.trim() == attribute)
}

/// Returns the rule that the root file of a crate breaks.
fn broken_rule(name: &str, root: &str) -> Option<String> {
    let level = if MAY_BE_UNSAFE.contains(&name) { "deny" } else { "forbid" };
    let attribute = format!("#![{level}(unsafe_code)]");
    (!carries(root, &attribute)).then(|| format!("{name} lacks {attribute}"))
}

#[test]
fn every_crate_but_two_forbids_unsafe_code() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let crates = std::fs::read_dir(root.join("crates")).expect("the workspace has crates");
    let mut files: Vec<(String, PathBuf)> = crates
        .map(|entry| entry.expect("an entry"))
        .map(|entry| (entry.file_name().to_string_lossy().into_owned(), entry.path().join("src/lib.rs")))
        .collect();
    assert!(MAY_BE_UNSAFE.iter().all(|name| files.iter().any(|(known, _)| known == name)));
    files.push(("the program".to_owned(), root.join("src/main.rs")));
    let text = |path: &Path| std::fs::read_to_string(path).expect("a crate has a root file");
    let broken: Vec<String> =
        files.iter().filter_map(|(name, path)| broken_rule(name, &text(path))).collect();
    assert!(broken.is_empty(), "{broken:#?}");
}

/// Numbers of the lines with an unsafe block without a reason above it.
fn without_reason(text: &str) -> Vec<usize> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let is_block = |line: &str| line.contains("unsafe {") && !line.starts_with("//");
    let has_reason = |index: usize| {
        lines[index.saturating_sub(LINES_ABOVE)..index].iter().any(|l| l.starts_with("// SAFETY:"))
    };
    (0..lines.len())
        .filter(|index| is_block(lines[*index]) && !has_reason(*index))
        .map(|index| index + 1)
        .collect()
}

#[test]
fn unsafe_code_of_the_runtime_states_its_reason() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/runtime-c/src");
    let mut n_blocks = 0;
    for file in
        ["abi.rs", "abi/textures.rs", "abi/voices.rs", "pointers.rs", "status.rs", "texture.rs", "lib.rs"]
    {
        let text = std::fs::read_to_string(src.join(file)).expect("a file of the runtime");
        n_blocks += text.matches("unsafe {").count();
        assert_eq!(without_reason(&text), [0; 0], "{file}");
    }
    assert!(n_blocks > 10, "the blocks were not found");
}

/// Negative control.
#[test]
fn unsafe_code_is_found() {
    assert!(!carries("// #![forbid(unsafe_code)]", "#![forbid(unsafe_code)]"));
    let (forbids, denies) = ("#![forbid(unsafe_code)]\n", "#![deny(unsafe_code)]\n");
    assert_eq!(broken_rule("core", denies), Some("core lacks #![forbid(unsafe_code)]".to_owned()));
    assert_eq!(broken_rule("attic", ""), Some("attic lacks #![forbid(unsafe_code)]".to_owned()));
    assert_eq!(broken_rule("runtime-c", ""), Some("runtime-c lacks #![deny(unsafe_code)]".to_owned()));
    assert_eq!((broken_rule("core", forbids), broken_rule("runtime-c", denies)), (None, None));
    assert_eq!(without_reason("let a = 1;\nlet b = unsafe { f() };\n"), [2]);
    let fine = "// SAFETY: f has no rules.\nlet b =\n    unsafe { f() };\n// an unsafe { in words\n";
    assert!(without_reason(fine).is_empty());
}
