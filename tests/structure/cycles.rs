//! No import cycles: at every level of a crate's module tree, sibling modules with their descendants do not import each
//! other cyclically.
//!
//! A module and its own children may use each other: they are one concept in several files.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use crate::source_tree::{ModulePath, SourceTree};

/// Folders of the source files of the checked crates.
const SOURCES: [&str; 10] = [
    "crates/app/src",
    "crates/core/src",
    "crates/device/src",
    "crates/formats/src",
    "crates/learn/src",
    "crates/python/src",
    "crates/runtime-c/src",
    "crates/studio/src",
    "crates/synth/src",
    "src",
];

type Graph = BTreeMap<String, BTreeSet<String>>;

/// Returns every cycle among siblings as text: the parent's path and the names of the siblings.
fn cycles(tree: &SourceTree) -> Vec<String> {
    let arrows = tree.arrows();
    let mut siblings: BTreeMap<ModulePath, Graph> = BTreeMap::new();
    for (from, to) in arrows.iter().flat_map(|(from, all)| all.iter().map(move |to| (from, to))) {
        let n_common = from.iter().zip(to).take_while(|(a, b)| a == b).count();
        // Otherwise one of them is an ancestor of the other.
        if let (Some(a), Some(b)) = (from.get(n_common), to.get(n_common)) {
            let graph = siblings.entry(from[..n_common].to_vec()).or_default();
            graph.entry(a.clone()).or_default().insert(b.clone());
        }
    }
    let of_parent = |(parent, graph): (&ModulePath, &Graph)| {
        let parent = if parent.is_empty() { "the root".to_owned() } else { parent.join("::") };
        groups(graph)
            .into_iter()
            .map(move |group| format!("in {parent}: {}", group.join(", ")))
            .collect::<Vec<_>>()
    };
    siblings.iter().flat_map(of_parent).collect()
}

/// Returns the groups of names that reach each other: the strongly connected components with more than one member.
fn groups(graph: &Graph) -> Vec<Vec<String>> {
    let reached: BTreeMap<&String, BTreeSet<&String>> =
        graph.keys().map(|from| (from, reachable(graph, from))).collect();
    let mut groups: Vec<Vec<String>> = Vec::new();
    for from in graph.keys() {
        let comes_back = |to: &&String| reached.get(*to).is_some_and(|reached| reached.contains(from));
        let group: Vec<String> = reached[from].iter().copied().filter(|to| comes_back(to)).cloned().collect();
        if group.len() > 1 && !groups.contains(&group) {
            groups.push(group);
        }
    }
    groups
}

fn reachable<'a>(graph: &'a Graph, from: &'a String) -> BTreeSet<&'a String> {
    let mut reached = BTreeSet::new();
    let mut open = vec![from];
    while let Some(next) = open.pop() {
        open.extend(graph.get(next).into_iter().flatten().filter(|to| reached.insert(*to)));
    }
    reached
}

#[test]
fn no_modules_import_each_other_in_a_circle() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    for source in SOURCES {
        let tree = SourceTree::read(&root.join(source));
        assert!(tree.n_modules() > 5, "{source} was not found");
        found.extend(cycles(&tree).into_iter().map(|cycle| format!("{source}, {cycle}")));
    }
    assert!(found.is_empty(), "{found:#?}");
}

/// Negative control.
#[test]
fn a_circle_of_imports_is_found() {
    let found = |files: &[(&str, &str)]| {
        let module =
            |path: &str| path.split("::").filter(|part| !part.is_empty()).map(str::to_owned).collect();
        cycles(&SourceTree::of(files.iter().map(|(path, text)| (module(path), *text))))
    };
    let circle = found(&[
        ("a", "use crate::b::B;\npub struct A;"),
        ("b", "pub use crate::b::inner::B;\nmod inner;"),
        ("b::inner", "use crate::c::C;\npub struct B;"),
        ("c", "fn f() { crate::a::A }\npub struct C;"),
        ("d", "use crate::a::A;"),
    ]);
    assert_eq!(circle, ["in the root: a, b, c"]);
    let in_a_room =
        found(&[("", ""), ("r", ""), ("r::x", "use super::y::Y;"), ("r::y", "use crate::r::x::X;")]);
    assert_eq!(in_a_room, ["in r: x, y"]);
    // A parent and its child form no cycle, and comments and tests do not count.
    let none = found(&[
        ("p", "use crate::p::q::Q;\npub struct P;"),
        ("p::q", "use crate::p::P; // crate::r\nuse crate::r::R;"),
        ("r", "pub struct R;\n#[cfg(test)]\nmod tests { use crate::p::P; }"),
    ]);
    assert!(none.is_empty(), "{none:?}");
    // Re-exports lead to the module of the definition.
    let handed_on = found(&[
        ("p", "mod q;\nmod r;\npub use crate::p::q::Q;\npub use crate::p::r::R;"),
        ("p::q", "use crate::p::R;\npub struct Q;"),
        ("p::r", "use crate::p::Q;\npub struct R;"),
    ]);
    assert_eq!(handed_on, ["in p: q, r"]);
}
