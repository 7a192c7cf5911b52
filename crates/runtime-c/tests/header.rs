//! The committed header is the one that cbindgen generates from the code. `SHAGREEN_WRITE_HEADER=1` writes it.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::path::Path;

use cbindgen::{Builder, Config, EnumConfig, Language, RenameRule, Style};

const COMMENT: &str =
    "/* Runtime for textures that were exported from Shagreen: see docs/guide/runtime.md. */";
const WARNING: &str =
    "/* Generated from crates/runtime-c/src/abi.rs by its test \"header\". Do not edit it. */";

/// The header of a file of source code and its modules.
fn generated(source: &Path) -> String {
    let config = Config {
        language: Language::C,
        style: Style::Type,
        cpp_compat: true,
        usize_is_size_t: true,
        header: Some(COMMENT.to_owned()),
        autogen_warning: Some(WARNING.to_owned()),
        include_guard: Some("SHAGREEN_H".to_owned()),
        enumeration: EnumConfig {
            rename_variants: RenameRule::QualifiedScreamingSnakeCase,
            ..EnumConfig::default()
        },
        ..Config::default()
    };
    let bindings = Builder::new().with_config(config).with_src(source).generate().unwrap();
    let mut header = Vec::new();
    bindings.write(&mut header);
    String::from_utf8(header).unwrap()
}

#[test]
fn the_header_is_up_to_date() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("include/shagreen.h");
    let header = generated(&root.join("src/lib.rs"));
    if std::env::var_os("SHAGREEN_WRITE_HEADER").is_some() {
        std::fs::write(&path, &header).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap().replace("\r\n", "\n");
    let differs = committed.lines().zip(header.lines()).position(|(old, new)| old != new);
    assert!(
        committed == header,
        "include/shagreen.h differs from the code from line {:?} on; run this test with SHAGREEN_WRITE_HEADER=1",
        differs.map(|line| line + 1)
    );
    // Every exported function is in it.
    let sources = ["abi.rs", "abi/textures.rs", "abi/voices.rs"].map(|file| root.join("src").join(file));
    let code: String = sources.iter().map(|file| std::fs::read_to_string(file).unwrap()).collect();
    assert_eq!(code.matches("#[unsafe(no_mangle)]").count(), 15);
    assert_eq!(header.lines().filter(|line| is_function(line)).count(), 15);
}

fn is_function(line: &str) -> bool {
    line.contains("shagreen_") && line.contains('(') && !line.starts_with(' ')
}

/// Negative control: another parameter gives another header.
#[test]
fn the_comparison_can_fail() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lib.rs");
    let header = |parameters: &str| {
        let code = format!("#[unsafe(no_mangle)]\npub extern \"C\" fn shagreen_f({parameters}) {{}}\n");
        std::fs::write(&path, code).unwrap();
        generated(&path)
    };
    let (one, two) = (header("a: u32"), header("a: u32, b: usize"));
    assert!(one.contains("void shagreen_f(uint32_t a);"), "{one}");
    assert!(two.contains("void shagreen_f(uint32_t a, size_t b);"), "{two}");
    assert_eq!([&one, &two].map(|header| header.lines().filter(|line| is_function(line)).count()), [1, 1]);
}
