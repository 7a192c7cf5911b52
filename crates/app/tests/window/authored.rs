//! Several authored textures: creating, selecting, comparing, snapshots, heat maps and the view.

use egui::accesskit::{Role, Toggled};
use egui::{Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, Pos2, Shape, TouchPhase, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::look::theme::DARK;
use shagreen_app::strings;
use shagreen_app::strings::{authored as words, compare, map, view};
use shagreen_core::space::heat_map::Quantity;
use shagreen_core::texture::blend::Mode;

use crate::support::{
    self, Author, author, choose, choose_mode, click, drag, painted, says, unnamed_controls, wait,
    wait_for_field, window,
};

fn slide(harness: &mut Author, name: &str, value: f64) {
    harness.get_by_role_and_label(Role::Slider, name).set_value_accesskit(value);
    harness.run_steps(3);
}

fn names(harness: &Author) -> Vec<String> {
    window(harness).project().authored.iter().map(|texture| texture.name.clone()).collect()
}

fn key(harness: &mut Author, modifiers: Modifiers, key: Key) {
    harness.key_press_modifiers(modifiers, key);
    harness.run_steps(3);
}

/// Opens the context menu of a widget and clicks an entry.
fn take_of_menu(harness: &mut Author, name: &str, entry: &str) {
    harness.get_by_label(name).click_secondary();
    harness.run_steps(3);
    click(harness, entry);
    harness.run_steps(2);
}

/// Library indices and weights of the contributing textures.
fn heard(harness: &Author) -> Vec<(usize, f64)> {
    window(harness).session().authored().expect("it is shown").parents.clone()
}

/// Two distant authored textures, in a mode with three contributing textures. The second one is selected.
fn two() -> Author {
    let mut harness = author();
    choose_mode(&mut harness, Mode::Shared);
    slide(&mut harness, strings::ROUGH_SMOOTH, 20.0);
    click(&mut harness, words::ADD);
    slide(&mut harness, strings::ROUGH_SMOOTH, 80.0);
    assert_eq!(window(&harness).project().authored.len(), 2);
    harness
}

#[test]
fn textures_are_made_selected_and_taken_away() {
    let mut harness = two();
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    let colors: Vec<u8> = window(&harness).project().authored.iter().map(|texture| texture.color).collect();
    assert_ne!(colors[0], colors[1], "they are told apart");
    assert_eq!(window(&harness).project().texture().blend.mode, Mode::Shared, "blended as the one before");
    // Selection on the canvas, then in the list.
    let second = heard(&harness);
    let first = window(&harness).project().authored[0].clone();
    harness.get_by_label(&words::on_canvas(&first.name)).click();
    harness.run_steps(3);
    assert_eq!(window(&harness).project().selected, 0);
    assert_ne!(heard(&harness), second, "the one that is selected is heard");
    assert_eq!(slider(&harness, strings::ROUGH_SMOOTH), 20.0);

    let names = names(&harness);
    assert_eq!(names, ["New texture", "New texture 2"]);
    click(&mut harness, &words::select(&names[1]));
    assert_eq!(window(&harness).project().selected, 1);
    assert_eq!(heard(&harness), second);

    // Two selections that cancel each other form no undo step.
    key(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(slider(&harness, strings::ROUGH_SMOOTH), 50.0);
    key(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(window(&harness).project().authored.len(), 1);
}

fn slider(harness: &Author, name: &str) -> f64 {
    harness.get_by_role_and_label(Role::Slider, name).accesskit_node().numeric_value().unwrap()
}

/// A drag of an unselected texture selects and moves it.
#[test]
fn another_texture_is_dragged_without_being_selected_first() {
    let mut harness = two();
    let first = window(&harness).project().authored[0].clone();
    let from = harness.get_by_label(&words::on_canvas(&first.name)).rect().center();
    let to = from + vec2(60.0, -40.0);
    drag(&mut harness, from, to);
    harness.run_steps(3);
    assert_eq!(window(&harness).project().selected, 0);
    let moved = window(&harness).project().texture().at;
    assert!(moved.x() > first.at.x() + 2.0 && moved.y() > first.at.y() + 2.0, "{moved}");
    let place = harness.get_by_label(strings::POINT).rect().center();
    assert!((place - to).length() < 1.5, "{place} for {to}");
}

#[test]
fn a_texture_has_a_color_tags_and_notes_and_each_is_one_step() {
    let mut harness = author();
    click(&mut harness, words::DETAILS);
    harness.run_steps(2);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, &words::color(4));
    assert_eq!(window(&harness).project().texture().color, 4);
    harness.get_by_role_and_label(Role::TextInput, words::TAGS).focus();
    harness.run_steps(2);
    for letters in ["wo", "od,", " dry"] {
        harness.get_by_role_and_label(Role::TextInput, words::TAGS).type_text(letters);
        harness.run_steps(2);
    }
    assert_eq!(window(&harness).project().texture().tags, ["wood", "dry"]);
    harness.get_by_role_and_label(Role::MultilineTextInput, words::NOTES).focus();
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::MultilineTextInput, words::NOTES).type_text("for the handle");
    harness.run_steps(2);
    assert_eq!(window(&harness).project().texture().notes, "for the handle");
    harness.get_by_label(strings::CANVAS).focus();
    harness.run_steps(3);
    for (step, left) in [("Change notes of", 2), ("Change tags of", 1), ("Color ", 0)] {
        let before = window(&harness).project().texture().clone();
        harness.get_by_label(strings::UNDO).hover();
        key(&mut harness, Modifiers::COMMAND, Key::Z);
        assert_ne!(window(&harness).project().texture(), &before, "{step} {left}");
    }
    assert_eq!(window(&harness).project().texture(), shagreen_studio::project::new_project().texture());
}

#[test]
fn a_copy_and_a_snapshot_keep_what_was() {
    let mut harness = author();
    slide(&mut harness, strings::ROUGH_SMOOTH, 30.0);
    click(&mut harness, words::KEEP);
    slide(&mut harness, strings::ROUGH_SMOOTH, 70.0);
    let name = window(&harness).project().texture().name.clone();
    click(&mut harness, &words::snapshot(1, &name));
    assert_eq!(window(&harness).project().texture().at.x(), 30.0);
    key(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(window(&harness).project().texture().at.x(), 70.0);

    take_of_menu(&mut harness, strings::POINT, words::DUPLICATE);
    assert_eq!(names(&harness), [name.clone(), words::copy_of(&name)]);
    let copy = window(&harness).project().texture();
    assert!(copy.sounds_like(&window(&harness).project().authored[0]), "exactly the same texture");
    let other = harness.get_by_label(&words::on_canvas(&name)).rect().center();
    let point = harness.get_by_label(strings::POINT).rect().center();
    assert!(point.distance(other) > 12.0, "both are seen");
    take_of_menu(&mut harness, strings::POINT, words::DELETE);
    assert_eq!(names(&harness), std::slice::from_ref(&name));
    take_of_menu(&mut harness, &words::snapshot(1, &name), &words::delete_snapshot(1));
    assert!(window(&harness).project().snapshots.is_empty());
}

/// A snapshot belongs to its texture, whatever is selected. A texture that was deleted comes back with it.
#[test]
fn a_snapshot_restores_the_texture_that_it_was_taken_of() {
    let mut harness = author();
    let name = window(&harness).project().texture().name.clone();
    slide(&mut harness, strings::ROUGH_SMOOTH, 30.0);
    click(&mut harness, words::KEEP);
    slide(&mut harness, strings::ROUGH_SMOOTH, 70.0);
    click(&mut harness, words::ADD);
    let other = window(&harness).project().texture().clone();
    click(&mut harness, &words::snapshot(1, &name));
    assert!(says(&harness, &words::restored(1, &name, "")));
    let project = window(&harness).project();
    assert_eq!((project.selected, project.texture().at.x()), (0, 30.0));
    assert_eq!(*project.authored[1], other, "the other one stays");
    take_of_menu(&mut harness, strings::POINT, words::DELETE);
    assert_eq!(names(&harness), std::slice::from_ref(&other.name));
    click(&mut harness, &words::snapshot(1, &name));
    assert_eq!(names(&harness), [other.name, name]);
    assert_eq!(window(&harness).project().texture().at.x(), 30.0);
}

/// A point that is drawn beside another one at its position does not jump when it is dragged.
#[test]
fn a_point_of_a_stack_is_dragged_from_its_position() {
    let mut harness = author();
    let before = window(&harness).project().texture().at;
    take_of_menu(&mut harness, strings::POINT, words::DUPLICATE);
    let from = harness.get_by_label(strings::POINT).rect().center();
    drag(&mut harness, from, from + vec2(30.0, 0.0));
    let moved = window(&harness).project().texture().at;
    assert!(moved.x() > before.x() + 1.0, "{moved}");
    assert!((moved.y() - before.y()).abs() < 0.5, "{moved} after {before}");
}

#[test]
fn a_texture_that_is_deleted_in_its_details_is_named() {
    let mut harness = author();
    click(&mut harness, words::ADD);
    let name = window(&harness).project().texture().name.clone();
    click(&mut harness, words::DETAILS);
    harness.run_steps(2);
    let duplicate = harness.get_by_label(words::DUPLICATE).rect();
    assert!(harness.get_by_label(words::DELETE).rect().left() > duplicate.right() + 20.0, "apart");
    click(&mut harness, words::DELETE);
    assert!(names(&harness).len() == 1 && says(&harness, &words::deleted(&name, "")));
}

/// Names of the authored textures that the list marks.
fn marked(harness: &Author) -> Vec<String> {
    let is_marked = |name: &String| {
        let label = words::select(name);
        let row = harness.get_by_label(&label);
        row.accesskit_node().toggled() == Some(Toggled::True)
    };
    names(harness).into_iter().filter(is_marked).collect()
}

/// The list marks the audible texture, which the inspector names, and none while a blind comparison hides it. Then the
/// inspector says why it is empty.
#[test]
fn a_comparison_marks_what_is_audible() {
    let mut harness = two();
    let names = names(&harness);
    assert_eq!(marked(&harness), names[1..]);
    click(&mut harness, &compare::hear("A"));
    assert_eq!(marked(&harness), names[..1]);
    assert_eq!(window(&harness).project().selected, 1, "the other one stays selected");
    assert!(!says(&harness, compare::HIDDEN_HELP));
    click(&mut harness, compare::BLIND);
    assert!(marked(&harness).is_empty() && says(&harness, compare::HIDDEN_HELP));
    click(&mut harness, compare::END);
    assert_eq!(marked(&harness), names[1..]);
    assert!(!says(&harness, compare::HIDDEN_HELP));
}

/// Keys and buttons play A and B under the same stroke. A blind comparison shows nothing that identifies the texture.
#[test]
fn two_textures_are_compared() {
    let mut harness = two();
    harness.get_by_label(strings::CANVAS).focus();
    click(&mut harness, strings::HAND_START);
    wait(&mut harness, "the hand strokes", |h| window(h).session().touch().contact.force_n > 0.0);
    let second = heard(&harness);
    click(&mut harness, &compare::hear("A"));
    let first = heard(&harness);
    assert_ne!(first, second);
    assert_eq!(window(&harness).project().selected, 1, "nothing is selected by listening");
    assert!(window(&harness).session().hand_is_running(), "the stroke goes on");
    click(&mut harness, &compare::hear("B"));
    assert_eq!(heard(&harness), second);
    click(&mut harness, &compare::hear("B"));
    assert_eq!(heard(&harness), second, "the selected one again");
    click(&mut harness, &compare::hear("X"));
    assert!(window(&harness).session().authored().is_none() && says(&harness, compare::HIDDEN));
    assert!(window(&harness).session().spectra().parents.is_empty());
    assert!(!says(&harness, "dB re 1 m/s²"), "nor its level");
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, &compare::x_is("A"));
    assert!(says(&harness, " of 1 correct: may be guessing (p = "));
    key(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(!says(&harness, compare::HIDDEN) && heard(&harness) == second, "Escape ends it");
    click(&mut harness, compare::BLIND);
    click(&mut harness, &compare::hear("A"));
    assert!(window(&harness).session().authored().is_none(), "nobody sees which it is");
    assert!(harness.query_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).is_none());
    click(&mut harness, compare::BLIND);
    assert!(heard(&harness) == first, "revealed");
    // The inspector shows the audible texture. It can be edited only after it is selected, which ends the comparison.
    let names = names(&harness);
    let said = compare::you_hear("A", &names[0]);
    assert!(says(&harness, &said));
    assert_eq!(slider(&harness, strings::ROUGH_SMOOTH), 20.0);
    slide(&mut harness, strings::ROUGH_SMOOTH, 60.0);
    let authored = window(&harness).project().authored.iter();
    let places: Vec<f64> = authored.map(|texture| texture.at.x()).collect();
    assert_eq!(places, [20.0, 80.0], "neither is edited");
    click(&mut harness, compare::EDIT);
    assert_eq!((window(&harness).project().selected, heard(&harness)), (0, first.clone()));
    assert!(!says(&harness, &said));
    slide(&mut harness, strings::ROUGH_SMOOTH, 60.0);
    assert_ne!(heard(&harness), first, "now it is edited");
    key(&mut harness, Modifiers::COMMAND, Key::Z);
    click(&mut harness, &words::select(&names[1]));
    take_of_menu(&mut harness, &words::on_canvas(&names[0]), &compare::compare_as("B"));
    click(&mut harness, &compare::hear("B"));
    assert_eq!(heard(&harness), first, "they have changed sides");
}

/// Whether the point at a position is a disc in the color of the audible texture, and the letters on it.
fn mark_at(harness: &Author, at: Pos2) -> (bool, Vec<String>) {
    let shapes = painted(harness, strings::CANVAS);
    let is_filled = shapes.iter().any(|shape| match shape {
        Shape::Circle(disc) => disc.fill == DARK.accent && disc.center.distance(at) < 1.0,
        _ => false,
    });
    let is_on_it = |shape: &&Shape| match shape {
        Shape::Text(text) => text.visual_bounding_rect().center().distance(at) < 4.0,
        _ => false,
    };
    (is_filled, shapes.iter().filter(is_on_it).filter_map(support::words).collect())
}

/// During a comparison, the canvas shows A and B by their letters, and the audible one as filled. A blind one tells nothing.
#[test]
fn the_canvas_marks_the_texture_that_a_comparison_plays() {
    let mut harness = two();
    let first = window(&harness).project().authored[0].name.clone();
    let first = harness.get_by_label(&words::on_canvas(&first)).rect().center();
    let second = harness.get_by_label(strings::POINT).rect().center();
    let check = |harness: &Author, filled: [bool; 2], letters: [&str; 2]| {
        for (i, at) in [first, second].into_iter().enumerate() {
            let (is_filled, found) = mark_at(harness, at);
            assert_eq!((is_filled, found.concat().as_str()), (filled[i], letters[i]), "point {i}");
        }
    };
    check(&harness, [false, true], ["", ""]);
    click(&mut harness, &compare::hear("A"));
    check(&harness, [true, false], ["A", "B"]);
    click(&mut harness, &compare::hear("B"));
    check(&harness, [false, true], ["A", "B"]);
    click(&mut harness, &compare::hear("X"));
    check(&harness, [false, false], ["A", "B"]);
    click(&mut harness, compare::BLIND);
    check(&harness, [false, false], ["", ""]);
    click(&mut harness, &compare::hear("A"));
    check(&harness, [false, false], ["", ""]);
}

/// The card of a contributing texture solos it. The same button ends solo.
#[test]
fn a_neighbor_is_heard_alone() {
    let mut harness = author();
    wait_for_field(&mut harness);
    let (parent, name) = {
        let (parent, _) = window(&harness).session().shown_parents()[0];
        (parent, strings::solo(&window(&harness).session().textures()[parent].name))
    };
    let at = window(&harness).project().texture().at;
    click(&mut harness, &name);
    assert_eq!(support::solo(&harness), Some(parent));
    assert_eq!(window(&harness).session().shown_parents(), [(parent, 1.0)]);
    click(&mut harness, &name);
    assert_eq!((support::solo(&harness), window(&harness).project().texture().at), (None, at));
    assert!(harness.get_by_label(strings::UNDO).accesskit_node().is_disabled(), "listening leaves no step");
}

/// A snapshot becomes a texture and is compared with the present state.
#[test]
fn a_snapshot_becomes_a_texture_of_its_own() {
    let mut harness = author();
    wait_for_field(&mut harness);
    let name = window(&harness).project().texture().name.clone();
    let at = window(&harness).project().texture().at;
    click(&mut harness, words::KEEP);
    slide(&mut harness, strings::ROUGH_SMOOTH, 81.0);
    take_of_menu(&mut harness, &words::snapshot(1, &name), words::AS_OWN);
    assert_eq!(names(&harness), [name.clone(), words::state_of(&name, 1)]);
    assert_eq!(window(&harness).project().texture().at, at);
    wait_for_field(&mut harness);
    let kept = heard(&harness);
    click(&mut harness, &compare::hear("A"));
    wait_for_field(&mut harness);
    assert_ne!(heard(&harness), kept, "what became of it");
    click(&mut harness, &compare::hear("B"));
    wait_for_field(&mut harness);
    assert_eq!(heard(&harness), kept);
}

#[test]
fn maps_are_worked_out_and_shown_with_their_scale() {
    let mut harness = author();
    choose_mode(&mut harness, Mode::Shared);
    for quantity in Quantity::ALL {
        choose(&mut harness, map::MAP, map::name(Some(quantity)));
        let scale = map::scale(map::name(Some(quantity)), "", "").split(',').next().unwrap().to_owned();
        wait(&mut harness, "the map is there", |h| {
            says(h, &format!("{scale}, from ")) && !says(h, map::WAITING)
        });
    }
    choose(&mut harness, map::MAP, map::name(None));
    assert!(!says(&harness, "Texture distance, from"));
}

#[test]
fn the_view_comes_nearer_moves_and_shows_everything_again() {
    let mut harness = author();
    let cork = |h: &Author| h.get_by_label("Play Cork").rect().center();
    let before = cork(&harness);
    // Zooming with the wheel keeps the position under the pointer.
    harness.hover_at(before);
    harness.run_steps(2);
    for _ in 0..4 {
        harness.event(Event::MouseWheel {
            unit: MouseWheelUnit::Point,
            delta: vec2(0.0, 60.0),
            modifiers: Modifiers::NONE,
            phase: TouchPhase::Move,
            source: MouseWheelSource::Unknown,
        });
        harness.run_steps(3);
    }
    harness.run_steps(20);
    let felt = harness.get_by_label("Play Felt").rect().center();
    assert!((cork(&harness) - before).length() < 2.0, "{} for {before}", cork(&harness));
    click(&mut harness, view::FIT);
    harness.run_steps(3);
    assert_ne!(harness.get_by_label("Play Felt").rect().center(), felt);
    for _ in 0..12 {
        if harness.get_by_label(view::FARTHER).accesskit_node().is_disabled() {
            break;
        }
        click(&mut harness, view::FARTHER);
    }
    assert!((cork(&harness) - before).length() < 1.0);
    assert!(harness.get_by_label(view::FARTHER).accesskit_node().is_disabled(), "the whole space is in view");
    click(&mut harness, view::NEARER);
    assert!((cork(&harness) - before).length() > 1.0);
}
