//! The layers of `core` and of `app` (their top-level modules, "rooms" in ARCHITECTURE.md): each uses only itself and
//! lower ones.

use std::path::Path;

use crate::source_tree::SourceTree;

/// Layers of `core`, the lowest first.
const ROOMS: [&str; 11] = [
    "units",
    "words",
    "maths",
    "dsp",
    "texture",
    "recording",
    "people",
    "space",
    "surfaces",
    "signals",
    "actuator",
];

/// Layers of `app`, the lowest first; single files are layers too.
const ROOMS_OF_APP: [&str; 14] = [
    "choices",
    "strings",
    "look",
    "state",
    "session",
    "workspace",
    "panel",
    "command",
    "figure_ui",
    "author",
    "build",
    "signals",
    "sheets",
    "window",
];

/// Returns, as text, the imports from a layer to a higher one, and those from or to a module that is no layer.
fn upward_imports(tree: &SourceTree, rooms: &[&str]) -> Vec<String> {
    let rank = |room: &str| rooms.iter().position(|known| *known == room);
    let mut broken = Vec::new();
    for (from, to) in tree.arrows().iter().flat_map(|(from, all)| all.iter().map(move |to| (from, to))) {
        let (Some(room), Some(used)) = (from.first(), to.first()) else { continue };
        let is_allowed = rank(room).zip(rank(used)).is_some_and(|(room, used)| used <= room);
        if !is_allowed {
            broken.push(format!("{} must not use {}", from.join("::"), to.join("::")));
        }
    }
    broken
}

fn tree_of(files: &[(&str, &str)]) -> SourceTree {
    let module = |path: &str| path.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect();
    SourceTree::of(files.iter().map(|(path, text)| (module(path), *text)))
}

#[test]
fn no_room_of_core_uses_a_higher_one() {
    check("core", &ROOMS);
}

#[test]
fn no_room_of_app_uses_a_higher_one() {
    check("app", &ROOMS_OF_APP);
}

fn check(name: &str, rooms: &[&str]) {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates").join(name).join("src");
    let tree = SourceTree::read(&src);
    assert!(tree.n_modules() > 100, "{name} was not found");
    let broken = upward_imports(&tree, rooms);
    assert!(broken.is_empty(), "{broken:#?}");
    let entries = std::fs::read_dir(&src).expect("a crate has source files");
    for path in entries.map(|entry| entry.expect("an entry").path()).filter(|path| path.is_dir()) {
        let room = path.file_name().and_then(|name| name.to_str()).expect("a name in ASCII").to_owned();
        assert!(
            rooms.contains(&room.as_str()),
            "{room} is not a known room of {name}: add it here and to ARCHITECTURE.md"
        );
    }
}

/// Negative control.
#[test]
fn an_import_from_a_higher_room_is_found() {
    let files = [
        ("", "pub mod dsp;\npub mod texture;"),
        ("dsp", "pub mod ar;"),
        ("texture", "mod model;\npub use crate::texture::model::Model;"),
        ("texture::model", "use crate::dsp::ar::levinson;\npub struct Model;"),
    ];
    let upward = |text| tree_of(&[&files[..], &[("dsp::ar", text)]].concat());
    assert!(
        upward_imports(&upward("use crate::units::Hertz; // not crate::texture::Model"), &ROOMS).is_empty()
    );
    for text in [
        "use crate::texture::Model;",
        "use crate::{units::Hertz, texture::{self}};",
        "fn f() { crate::texture::Model }",
        "use super::super::texture::Model;",
    ] {
        assert_eq!(upward_imports(&upward(text), &ROOMS).len(), 1, "{text}");
    }
    assert_eq!(upward_imports(&upward("use crate::attic::Chest;"), &ROOMS).len(), 0, "no such module");
    let unknown = tree_of(&[("attic", "use crate::dsp::ar;"), ("dsp", "pub mod ar;"), ("dsp::ar", "")]);
    assert_eq!(upward_imports(&unknown, &ROOMS), ["attic must not use dsp::ar"]);
}
