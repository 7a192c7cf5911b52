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

/// Room of `app` above the pages of the workspaces. A single file that is not listed is such a page.
const ABOVE_PAGES: &str = "sheets";

/// Layers of `app`, the lowest first; single files are layers too.
const ROOMS_OF_APP: [&str; 16] = [
    "choices",
    "strings",
    "look",
    "state",
    "browse",
    "session",
    "workspace",
    "panel",
    "command",
    "figure_ui",
    "author",
    "build",
    "signals",
    "studies",
    "sheets",
    "window",
];

/// Returns, as text, the imports from a layer to a higher one, and those from or to a module that is no layer. Modules that
/// are not listed lie directly below `above_others`.
fn upward_imports(tree: &SourceTree, rooms: &[&str], above_others: Option<&str>) -> Vec<String> {
    let listed = |room: &str| rooms.iter().position(|known| *known == room).map(|rank| 2 * rank);
    let rank = |room: &str| listed(room).or_else(|| above_others.and_then(listed).map(|above| above - 1));
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
    check("core", &ROOMS, None);
}

#[test]
fn no_room_of_app_uses_a_higher_one() {
    check("app", &ROOMS_OF_APP, Some(ABOVE_PAGES));
}

fn check(name: &str, rooms: &[&str], above_others: Option<&str>) {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("crates").join(name).join("src");
    let tree = SourceTree::read(&src);
    assert!(tree.n_modules() > 100, "{name} was not found");
    let broken = upward_imports(&tree, rooms, above_others);
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
        upward_imports(&upward("use crate::units::Hertz; // not crate::texture::Model"), &ROOMS, None)
            .is_empty()
    );
    for text in [
        "use crate::texture::Model;",
        "use crate::{units::Hertz, texture::{self}};",
        "fn f() { crate::texture::Model }",
        "use super::super::texture::Model;",
    ] {
        assert_eq!(upward_imports(&upward(text), &ROOMS, None).len(), 1, "{text}");
    }
    assert_eq!(upward_imports(&upward("use crate::attic::Chest;"), &ROOMS, None).len(), 0, "no such module");
    let unknown = tree_of(&[("attic", "use crate::dsp::ar;"), ("dsp", "pub mod ar;"), ("dsp::ar", "")]);
    assert_eq!(upward_imports(&unknown, &ROOMS, None), ["attic must not use dsp::ar"]);
    // A page that is not listed may use what lies below the pages, and nothing above them.
    let page = |text| {
        let files = [
            ("", "mod notes;\nmod look;\nmod window;"),
            ("look", "pub struct Color;"),
            ("window", "pub struct Window;"),
        ];
        tree_of(&[&files[..], &[("notes", text)]].concat())
    };
    let broken = |text| upward_imports(&page(text), &ROOMS_OF_APP, Some(ABOVE_PAGES));
    assert!(broken("use crate::look::Color;").is_empty());
    assert_eq!(broken("use crate::window::Window;"), ["notes must not use window"]);
}
