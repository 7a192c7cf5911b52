//! The Python module: its own tests, where a wheel can be built, and its stub beside its source.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test may panic on an unexpected result, and prints what it skips"
)]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Variable that asks for the tests in Python. They build the wheel, which takes minutes the first time.
const ASKED: &str = "SHAGREEN_TEST_PYTHON";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_owned()
}

#[test]
fn the_module_passes_its_tests_in_python() {
    if std::env::var_os(ASKED).is_none_or(|value| value != "1") {
        println!("skipped: set {ASKED}=1 to build the wheel and test it (scripts/python-test)");
        return;
    }
    let mut command = Command::new(root().join("scripts/python-test"));
    let output = command.env("SHAGREEN", env!("CARGO_BIN_EXE_shagreen")).output().unwrap();
    let said = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(output.status.success(), "{}\n{}", said(&output.stdout), said(&output.stderr));
}

/// Names that the module exports, by the text of its root.
fn exported(root: &str) -> BTreeSet<String> {
    let uses = root.split("#[pymodule_export]").skip(1).filter_map(|rest| rest.split(';').next());
    let names = uses.flat_map(|path| {
        let last = path.rsplit("::").next().unwrap_or_default();
        last.trim_matches(['{', '}']).split(',').map(str::trim).collect::<Vec<_>>()
    });
    // A class of Rust has another name, because the library has a type of its name.
    names.map(|name| name.trim_start_matches("Py").to_owned()).collect()
}

/// Names that a stub declares: classes and functions at the beginning of a line.
fn declared(stub: &str) -> BTreeSet<String> {
    let name = |line: &str| {
        let rest = line.strip_prefix("class ").or_else(|| line.strip_prefix("def "))?;
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_')?;
        Some(rest[..end].to_owned())
    };
    stub.lines().filter_map(name).collect()
}

#[test]
fn the_stub_declares_what_the_module_exports() {
    let folder = root().join("crates/python");
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let exported = exported(&read("src/lib.rs"));
    let mut declared = declared(&read("shagreen.pyi"));
    assert!(declared.remove("Tap"), "the type of a dictionary");
    assert_eq!(exported, declared);
    assert!(exported.len() > 10, "{exported:?}");
}

/// Negative control.
#[test]
fn an_export_without_a_stub_is_found() {
    let source = "#[pymodule_export]\nuse crate::a::{PyNew, made};\n#[pymodule_export]\nuse crate::b::other;";
    let stub = "class New:\n    def inner(self) -> int: ...\n\ndef made() -> None: ...\n";
    let missing: Vec<String> = exported(source).difference(&declared(stub)).cloned().collect();
    assert_eq!(missing, ["other"]);
}
