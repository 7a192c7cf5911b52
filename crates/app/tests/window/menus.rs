//! Context menus of the canvas, the points and the pad, and drags of textures onto the canvas.

use egui::accesskit::Role;
use egui::{Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::command::Command;
use shagreen_app::strings::{self, authored as words, textures};
use shagreen_core::space::SpacePoint;
use shagreen_core::texture::blend::Mode;
use shagreen_formats::built_in::BuiltIn;

use crate::support::{
    self, Author, author, author_on, click, double_click, drag, is_locked, solo, unnamed_controls,
    wait_for_field, window,
};

const SIZE: [f32; 2] = [1280.0, 720.0];

fn names(harness: &Author) -> Vec<String> {
    window(harness).project().authored.iter().map(|texture| texture.name.clone()).collect()
}

fn at(harness: &Author) -> SpacePoint {
    window(harness).project().texture().at
}

fn point(harness: &Author) -> Pos2 {
    harness.get_by_label(strings::POINT).rect().center()
}

fn key(harness: &mut Author, modifiers: Modifiers, key: Key) {
    harness.key_press_modifiers(modifiers, key);
    harness.run_steps(3);
}

fn press(harness: &mut Author, pos: Pos2, button: PointerButton) {
    harness.hover_at(pos);
    for pressed in [true, false] {
        harness.event(egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE });
    }
    harness.run_steps(3);
}

/// Place on the canvas that is far from every texture and from the point.
pub(crate) fn empty_place(harness: &Author) -> Pos2 {
    let canvas = harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect().shrink(90.0);
    let textures = window(harness).session().textures().iter();
    let center = |name: &str| Some(harness.query_by_label(&strings::play_texture(name))?.rect().center());
    let mut taken: Vec<Pos2> = textures.filter_map(|texture| center(&texture.name)).collect();
    taken.push(point(harness));
    let room = |pos: &Pos2| taken.iter().map(|other| pos.distance(*other)).fold(f32::INFINITY, f32::min);
    let places = (0..100).map(|i| {
        let share = vec2((i % 10) as f32, (i / 10) as f32) / 9.0;
        canvas.min + share * canvas.size()
    });
    places.max_by(|a, b| room(a).total_cmp(&room(b))).expect("a place")
}

#[test]
fn the_menu_of_the_canvas_applies_where_it_was_opened() {
    let mut harness = author();
    let place = empty_place(&harness);
    press(&mut harness, place, PointerButton::Secondary);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, words::ADD_HERE);
    assert_eq!(names(&harness), ["New texture", "New texture 2"]);
    assert!((point(&harness) - place).length() < 1.5, "{} for {place}", point(&harness));
    key(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(names(&harness), ["New texture"]);

    let place = empty_place(&harness);
    press(&mut harness, place, PointerButton::Secondary);
    click(&mut harness, words::MOVE_HERE);
    assert_eq!(names(&harness), ["New texture"]);
    assert!((point(&harness) - place).length() < 1.5, "{} for {place}", point(&harness));

    // A click beside the menu closes it and moves nothing.
    let before = at(&harness);
    let place = empty_place(&harness);
    press(&mut harness, place, PointerButton::Secondary);
    assert!(harness.query_by_label(words::ADD_HERE).is_some());
    let canvas = harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect();
    press(&mut harness, canvas.left_bottom() + vec2(6.0, -6.0), PointerButton::Primary);
    assert!(harness.query_by_label(words::ADD_HERE).is_none());
    assert_eq!(at(&harness), before);
}

#[test]
fn the_keyboard_opens_the_menu_of_the_point() {
    let mut harness = author();
    harness.get_by_label(strings::POINT).focus();
    harness.run_steps(2);
    let before = at(&harness);
    key(&mut harness, Modifiers::SHIFT, Key::F10);
    assert!(harness.query_by_label(words::RENAME).is_some());
    // Arrow keys choose an entry, and do not move the point.
    key(&mut harness, Modifiers::NONE, Key::ArrowDown);
    assert_eq!(at(&harness), before);
    key(&mut harness, Modifiers::NONE, Key::Escape);
    assert!(harness.query_by_label(words::RENAME).is_none());
}

#[test]
fn a_menu_renames_the_texture_that_it_belongs_to() {
    let mut harness = author();
    click(&mut harness, words::ADD);
    harness.get_by_label(&words::select("New texture")).click_secondary();
    harness.run_steps(3);
    click(&mut harness, words::RENAME);
    harness.run_steps(2);
    assert_eq!(window(&harness).project().selected, 0);
    assert!(harness.get_by_role_and_label(Role::TextInput, strings::NAME).is_focused());
    harness.get_by_role_and_label(Role::TextInput, strings::NAME).type_text("Oak");
    harness.run_steps(2);
    assert_eq!(names(&harness), ["Oak", "New texture 2"], "typing replaces the name");
}

#[test]
fn a_new_texture_and_the_key_f2_select_the_name_so_that_typing_replaces_it() {
    let mut harness = author();
    click(&mut harness, words::ADD);
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::TextInput, strings::NAME).type_text("Elm");
    harness.run_steps(2);
    assert_eq!(names(&harness), ["New texture", "Elm"]);
    harness.get_by_label(strings::POINT).focus();
    harness.run_steps(3);
    key(&mut harness, Modifiers::NONE, Key::F2);
    harness.get_by_role_and_label(Role::TextInput, strings::NAME).type_text("Oak");
    harness.run_steps(2);
    assert_eq!(names(&harness), ["New texture", "Oak"]);
}

/// Enter keeps the name that was typed in the row, and Escape restores the one before.
#[test]
fn a_double_click_on_a_row_renames_the_texture_there() {
    let mut harness = author();
    click(&mut harness, words::ADD);
    for (left_by, expected) in [(Key::Enter, "Oak"), (Key::Escape, "Oak")] {
        let row = harness.get_by_label(&words::select(&names(&harness)[0])).rect().center();
        double_click(&mut harness, row);
        assert_eq!(window(&harness).project().selected, 0);
        let field = harness.get_by_role_and_label(Role::TextInput, words::ROW_NAME);
        assert!(field.is_focused());
        field.type_text(if left_by == Key::Enter { "Oak" } else { "Elm" });
        harness.run_steps(2);
        key(&mut harness, Modifiers::NONE, left_by);
        assert_eq!(names(&harness), [expected, "New texture 2"]);
        assert!(harness.query_by_role_and_label(Role::TextInput, words::ROW_NAME).is_none());
        // The next click is no third one of this double click.
        harness.run_steps(60);
    }
}

/// The right button opens the menu of the pad and strokes nothing.
#[test]
fn the_pad_has_a_menu() {
    let mut harness = author();
    let pad = harness.get_by_role_and_label(Role::Canvas, strings::PAD).rect().center();
    press(&mut harness, pad, PointerButton::Secondary);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    assert_eq!(window(&harness).session().touch().contact.force_n, 0.0);
    let mute = Command::ToggleMute.entry().expect("a listed command").label;
    click(&mut harness, mute);
    assert!(window(&harness).session().is_muted());
    press(&mut harness, pad, PointerButton::Secondary);
    let stroke = Command::ToggleHand.entry().expect("a listed command").label;
    click(&mut harness, stroke);
    assert!(window(&harness).session().hand_is_running());
}

/// A texture of the list becomes an authored texture that is exactly this one, by a drag or by its menu.
#[test]
fn a_texture_is_dragged_onto_the_canvas() {
    let mut harness = author();
    let (entry, place) = {
        let session = window(&harness).session();
        (session.textures()[0].clone(), session.space().position(0).expect("it is placed"))
    };
    let row = harness.get_by_label(&strings::texture(&entry.name)).rect().center();
    let canvas = harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect().center();
    // While it is dragged, a note says what a drop does.
    harness.hover_at(row);
    harness.drag_at(row);
    harness.hover_at(row.lerp(canvas, 0.5));
    harness.hover_at(canvas);
    harness.run_steps(2);
    let shapes = harness.output().shapes.iter();
    let said: Vec<String> = shapes.filter_map(|clipped| support::words(&clipped.shape)).collect();
    assert!(said.contains(&words::drop_adds(&entry.name)), "{said:?}");
    harness.drop_at(canvas);
    harness.run_steps(3);
    let check = |harness: &Author| {
        let texture = window(harness).project().texture();
        assert_eq!((texture.name.as_str(), texture.at), (entry.name.as_str(), place));
        assert_eq!((&texture.notes, &texture.tags), (&entry.description, &entry.tags));
        assert_eq!(texture.blend.mode, Mode::Field);
        assert_eq!(names(harness), ["New texture", entry.name.as_str()]);
    };
    check(&harness);
    wait_for_field(&mut harness);
    let parents = window(&harness).session().authored().expect("a texture").parents.clone();
    assert!(matches!(parents[..], [(0, weight)] if (weight - 1.0).abs() < 1e-6), "{parents:?}");
    key(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(names(&harness), ["New texture"]);

    harness.get_by_label(&strings::texture(&entry.name)).click_secondary();
    harness.run_steps(3);
    click(&mut harness, textures::AUTHOR);
    check(&harness);
    key(&mut harness, Modifiers::COMMAND, Key::Z);
    harness.get_by_label(&strings::texture(&entry.name)).click_secondary();
    harness.run_steps(3);
    click(&mut harness, textures::CHOOSE);
    assert_eq!((solo(&harness), at(&harness), names(&harness).len()), (None, place, 1));
    assert!(is_locked(&harness, 0));
}

#[test]
fn a_drag_to_another_place_or_left_by_escape_adds_nothing() {
    let mut harness = author();
    let name = window(&harness).session().textures()[0].name.clone();
    let row = harness.get_by_label(&strings::texture(&name)).rect().center();
    let pad = harness.get_by_role_and_label(Role::Canvas, strings::PAD).rect().center();
    drag(&mut harness, row, pad);
    assert_eq!(names(&harness).len(), 1);
    let canvas = harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect().center();
    harness.hover_at(row);
    harness.drag_at(row);
    harness.hover_at(row.lerp(canvas, 0.5));
    harness.run_steps(2);
    key(&mut harness, Modifiers::NONE, Key::Escape);
    harness.hover_at(canvas);
    harness.drop_at(canvas);
    harness.run_steps(3);
    assert_eq!(names(&harness).len(), 1);
}

#[test]
fn a_texture_without_a_position_is_not_dropped() {
    let mut library = BuiltIn::Starter.read().unwrap();
    library.textures[0].place = None;
    let name = library.textures[0].name.clone();
    let mut harness = author_on(library, SIZE);
    assert_eq!(window(&harness).session().space().position(0), None);
    let row = harness.get_by_label(&strings::texture(&name)).rect().center();
    let canvas = harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect().center();
    drag(&mut harness, row, canvas);
    assert_eq!(names(&harness).len(), 1);
}
