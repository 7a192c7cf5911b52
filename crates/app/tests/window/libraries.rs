//! Opening another library: its positions state their source, and nothing is lost.

use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect, Shape};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::strings;
use shagreen_app::workspace::Workspace;
use shagreen_core::space::authoring::Authored;
use shagreen_core::texture::blend::Mode;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::Library;
use shagreen_studio::library_names::built_in_name;

use crate::support::{
    Author, author, author_on, choose_mode, click, drop_files, painted, says, shown, unnamed_controls, wait,
    wait_for_field, window, words,
};

const NOBODY: &str = "Positions: simulated raters, no human data";

/// Clicks an entry of the library menu.
fn open(harness: &mut Author, name: &str) {
    click(harness, strings::LIBRARIES);
    harness.run_steps(2);
    assert_eq!(unnamed_controls(harness), Vec::<String>::new());
    click(harness, name);
    harness.run_steps(3);
}

fn library(harness: &Author) -> Library {
    window(harness).session().library().clone()
}

fn authored(harness: &Author) -> Authored {
    window(harness).session().authored().unwrap().clone()
}

/// Texts on the canvas.
fn names_on_canvas(harness: &Author) -> Vec<String> {
    painted(harness, strings::CANVAS).into_iter().filter_map(|shape| words(&shape)).collect()
}

#[test]
fn the_simulated_library_is_opened_and_says_so_wherever_its_places_are_shown() {
    let mut harness = author();
    choose_mode(&mut harness, Mode::Shared);
    harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).set_value_accesskit(63.0);
    harness.run_steps(3);
    let (point, before) = (window(&harness).project().texture().at, library(&harness));
    let (space, blend) = (window(&harness).session().space().clone(), authored(&harness));
    assert!(says(&harness, "Positions: physical labels") && !says(&harness, NOBODY));

    open(&mut harness, built_in_name(BuiltIn::Simulated));
    let read = BuiltIn::Simulated.read().unwrap();
    assert_eq!(library(&harness), read);
    assert_eq!(window(&harness).project().texture().at, point, "the point is where it is");
    assert_ne!(authored(&harness).parents, blend.parents, "its neighbors are others");
    // In the list and on the canvas; where there is no canvas, in the status bar.
    assert!(says(&harness, NOBODY), "{:?}", shown(&harness));
    assert!(shown(&harness).iter().any(|text| text == "Positions: simulated raters"));
    harness.key_press_modifiers(Modifiers::COMMAND, Workspace::Signals.info().key);
    harness.run_steps(3);
    assert!(says(&harness, "positions: simulated raters"));
    harness.key_press_modifiers(Modifiers::COMMAND, Workspace::Author.info().key);
    harness.run_steps(3);
    harness.get_by_label(&strings::play_texture("Cork")).hover();
    wait(&mut harness, "the place says whom it is from", |h| says(h, "(simulated raters)"));

    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!((library(&harness), window(&harness).session().space()), (before, &space));
    assert_eq!((window(&harness).project().texture().at, authored(&harness)), (point, blend));
    assert!(!says(&harness, NOBODY));
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    harness.run_steps(3);
    assert_eq!(library(&harness), read);
    open(&mut harness, built_in_name(BuiltIn::Starter));
    assert!(says(&harness, "Positions: physical labels"));
    assert_eq!(window(&harness).project().texture().at, point);
}

/// Opening the open library changes nothing and forms no undo step.
#[test]
fn the_open_library_is_marked_and_opening_it_does_nothing() {
    let mut harness = author();
    open(&mut harness, built_in_name(BuiltIn::Starter));
    assert!(harness.get_by_label(strings::UNDO).accesskit_node().is_disabled());
    open(&mut harness, built_in_name(BuiltIn::Simulated));
    assert!(!harness.get_by_label(strings::UNDO).accesskit_node().is_disabled());
    click(&mut harness, strings::LIBRARIES);
    harness.run_steps(2);
    let all = harness.query_all_by_label_contains("Starter library").count();
    assert_eq!(all, 2, "each of the program's once");
}

/// A library from a file can be left and reopened, with the added textures.
#[test]
fn a_library_that_was_open_is_offered_too() {
    let mut mine = BuiltIn::Starter.read().unwrap();
    mine.name = "Mine".to_owned();
    mine.textures.truncate(6);
    let mut harness = author_on(mine.clone(), [1280.0, 720.0]);
    open(&mut harness, built_in_name(BuiltIn::Simulated));
    assert_eq!(window(&harness).session().textures().len(), 25);
    wait(&mut harness, "it is heard", |h| window(h).session().authored().is_some());
    open(&mut harness, "Mine");
    assert_eq!(library(&harness), mine);
    click(&mut harness, strings::UNDO);
    harness.run_steps(2);
    assert_eq!(window(&harness).session().textures().len(), 25);
}

/// Judgments stay loaded when another library is opened.
#[test]
fn judgments_survive_another_library() {
    let mut harness = author();
    click(&mut harness, Workspace::Build.info().name);
    let csv: &[u8] = b"participant,trial,groups,texture,group\np1,1,2,cork,a\np1,1,2,felt,b\n";
    drop_files(&mut harness, &[("sorting.csv", csv)]);
    wait(&mut harness, "it is read", |h| !window(h).build().judgments().is_reading());
    click(&mut harness, Workspace::Author.info().name);
    open(&mut harness, built_in_name(BuiltIn::Simulated));
    assert_eq!(window(&harness).build().judgments().sorting.values().len(), 1);
}

#[test]
fn every_texture_of_both_libraries_has_its_name_on_the_canvas() {
    let mut harness = author();
    for built_in in BuiltIn::ALL {
        open(&mut harness, built_in_name(built_in));
        let names = names_on_canvas(&harness);
        let textures = window(&harness).session().textures();
        let nameless: Vec<&str> = textures
            .iter()
            .map(|t| t.name.as_str())
            .filter(|name| !names.iter().any(|n| n == name))
            .collect();
        assert!(nameless.is_empty(), "{nameless:?} in {}", built_in_name(built_in));
    }
}

/// On a small canvas, no name lies partly below another one or below the authored point.
#[test]
fn a_name_is_shown_whole_or_not_at_all() {
    let mut harness = author_on(BuiltIn::Starter.read().unwrap(), [960.0, 600.0]);
    wait_for_field(&mut harness);
    harness.remove_cursor();
    for rough_smooth in [30.0, 50.0, 62.0] {
        harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).set_value_accesskit(rough_smooth);
        harness.run_steps(4);
        let textures = window(&harness).session().textures();
        let is_name = |text: &str| textures.iter().any(|texture| texture.name == text);
        let area = |shape: &Shape| match shape {
            Shape::Text(text) if is_name(text.galley.text()) => Some(text.visual_bounding_rect().shrink(2.0)),
            _ => None,
        };
        let names: Vec<Rect> = painted(&harness, strings::CANVAS).iter().filter_map(area).collect();
        assert!(names.len() > 10, "{} names at {rough_smooth}", names.len());
        let point = harness.get_by_role_and_label(Role::Slider, strings::POINT).rect().shrink(4.0);
        for (i, name) in names.iter().enumerate() {
            assert!(!name.intersects(point), "{name:?} at {rough_smooth}");
            assert!(
                !names[i + 1..].iter().any(|other| other.intersects(*name)),
                "{name:?} at {rough_smooth}"
            );
        }
    }
}

/// In a window with too little room for all names, the name under the pointer or with the keyboard focus is shown at
/// once.
#[test]
fn a_texture_that_is_pointed_at_always_has_its_name() {
    let mut heap = BuiltIn::Starter.read().unwrap();
    for (i, texture) in heap.textures.iter_mut().enumerate() {
        let place = texture.place.as_mut().unwrap();
        place.at = place.at.with(0, 40.0 + (i % 5) as f64 * 1.5);
        place.at = place.at.with(1, 40.0 + (i / 5) as f64 * 2.5 + (i % 3) as f64);
    }
    let mut harness = author_on(heap, [960.0, 600.0]);
    harness.run_steps(2);
    let names = names_on_canvas(&harness);
    let textures = window(&harness).session().textures();
    let nameless = textures.iter().map(|t| t.name.clone()).find(|name| !names.contains(name));
    let nameless = nameless.expect("a heap has more names than room");
    harness.get_by_label(&strings::play_texture(&nameless)).focus();
    harness.run_steps(2);
    assert!(names_on_canvas(&harness).contains(&nameless), "{nameless}");
}
