//! Paths through the space: drawing, editing, playing, and adding them to the list.

use std::time::Duration;

use egui::accesskit::Role;
use egui::{Key, Modifiers, Pos2};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::strings;
use shagreen_app::strings::path;
use shagreen_core::space::SpacePoint;
use shagreen_core::space::texture_path::UserPath;
use shagreen_core::space::texture_path::{Along, AtEnd};
use shagreen_studio::project::new_project;

use crate::support::{
    Author, author, author_of, begin, choose, click, painted, solo, unnamed_controls, wait, wait_for_field,
    window, words,
};

fn center(harness: &Author, name: &str) -> Pos2 {
    harness.get_by_label(name).rect().center()
}

fn drawn(harness: &Author) -> UserPath {
    window(harness).project().texture().path.clone().expect("a path")
}

/// Draws a path from brick to cotton that takes `secs` seconds and holds at its end.
fn draw_in_time(harness: &mut Author, secs: f64) {
    click(harness, path::PATH);
    click(harness, &strings::play_texture("Brick"));
    click(harness, &strings::play_texture("Cotton weave"));
    choose(harness, path::ALONG, path::TIME);
    choose(harness, path::AT_END, path::HOLD);
    harness.get_by_role_and_label(Role::SpinButton, path::LENGTH).set_value_accesskit(secs);
    harness.run_steps(2);
    let set = drawn(harness);
    assert_eq!((set.points.len(), set.along, set.at_end), (2, Along::Time, AtEnd::Hold));
    assert!((set.length_secs - secs).abs() < 1e-9);
}

/// Draws a path freehand through three textures.
fn draw(harness: &mut Author, [from, by, to]: [&str; 3]) {
    let places = [from, by, to].map(|name| center(harness, &strings::play_texture(name)));
    harness.hover_at(places[0]);
    harness.run_steps(2);
    harness.drag_at(places[0]);
    harness.run_steps(1);
    for pair in places.windows(2) {
        for i in 1..=8 {
            harness.hover_at(pair[0].lerp(pair[1], i as f32 / 8.0));
            harness.run_steps(1);
        }
    }
    harness.drop_at(places[2]);
    harness.run_steps(3);
}

fn place(harness: &Author, name: &str) -> SpacePoint {
    let session = window(harness).session();
    let texture = session.textures().iter().position(|t| t.name == name).unwrap();
    session.space().position(texture).unwrap()
}

#[test]
fn a_path_is_drawn_changed_and_undone() {
    let mut harness = author();
    wait_for_field(&mut harness);
    let point = window(&harness).project().texture().at;
    harness.key_press(Key::P);
    harness.run_steps(4);
    draw(&mut harness, ["Rough sawn wood", "Cardboard", "Felt"]);
    let first = drawn(&harness);
    assert_eq!(window(&harness).project().texture().at, point, "the point stays");
    // A freehand path starts and ends within a few points of the axes.
    assert!(first.points.len() >= 3, "{:?}", first.points);
    assert!(first.points[0].distance(place(&harness, "Rough sawn wood")) < 2.0);
    assert!(first.points[first.points.len() - 1].distance(place(&harness, "Felt")) < 2.0);
    let farthest =
        first.points.iter().map(|p| p.distance(place(&harness, "Cardboard"))).fold(100.0, f64::min);
    assert!(farthest < 2.0, "the corner is kept");
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());

    // A click on a texture extends the path to it.
    click(&mut harness, &strings::play_texture("Glass"));
    let longer = drawn(&harness);
    assert_eq!(longer.points.last(), Some(&place(&harness, "Glass")));
    // Moves a point and deletes it.
    let (from, to) = (center(&harness, &path::point(1)), center(&harness, &strings::play_texture("Denim")));
    harness.hover_at(from);
    harness.run_steps(2);
    harness.drag_at(from);
    harness.run_steps(1);
    harness.hover_at(from.lerp(to, 0.5));
    harness.run_steps(1);
    harness.hover_at(to);
    harness.run_steps(1);
    harness.drop_at(to);
    harness.run_steps(3);
    assert!(drawn(&harness).points[0].distance(place(&harness, "Denim")) < 2.0);
    harness.get_by_label(&path::point(1)).click_secondary();
    harness.run_steps(3);
    assert_eq!(drawn(&harness).points, longer.points[1..]);
    for expected in [None, Some(&longer), Some(&first)] {
        click(&mut harness, strings::UNDO);
        if let Some(expected) = expected {
            assert_eq!(&drawn(&harness), expected);
        }
    }
    click(&mut harness, strings::UNDO);
    assert_eq!(window(&harness).project().texture().path, None, "the whole drawing is one step");
    click(&mut harness, strings::REDO);
    click(&mut harness, path::CLEAR);
    assert_eq!(window(&harness).project().texture().path, None);

    // Escape turns the path tool off, and a click on a texture plays it again.
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    click(&mut harness, &strings::play_texture("Cork"));
    assert_eq!(window(&harness).project().solo.as_deref(), Some("cork"));
    assert_eq!(window(&harness).project().texture().path, None);
}

/// Labels stay beside their lists, and the canvas stays where it is when the first point is placed.
#[test]
fn the_controls_of_a_path_wrap_as_groups_and_have_their_place_before_it() {
    for size in [[960.0, 600.0], [1280.0, 720.0]] {
        let mut harness = author_of(begin(new_project()), size);
        wait_for_field(&mut harness);
        click(&mut harness, path::PATH);
        harness.run_steps(4);
        let before = center(&harness, &strings::play_texture("Felt"));
        click(&mut harness, &strings::play_texture("Brick"));
        click(&mut harness, &strings::play_texture("Cotton weave"));
        harness.run_steps(4);
        let after = center(&harness, &strings::play_texture("Felt"));
        assert!((after - before).length() < 1.0, "{before:?}, then {after:?} in {size:?}");
        let row = |role: Role, name: &str| harness.get_by_role_and_label(role, name).rect();
        for group in [
            vec![
                harness.get_by_label(path::ALONG_LABEL).rect(),
                row(Role::ComboBox, path::ALONG),
                row(Role::SpinButton, path::LENGTH),
            ],
            vec![harness.get_by_label(path::AT_END_LABEL).rect(), row(Role::ComboBox, path::AT_END)],
            vec![row(Role::Button, path::KEEP), row(Role::Button, path::CLEAR)],
        ] {
            for pair in group.windows(2) {
                let is_beside = pair[0].right() <= pair[1].left() + 0.5;
                let is_level = (pair[0].center().y - pair[1].center().y).abs() < 3.0;
                assert!(is_beside && is_level, "{pair:?} in {size:?}");
            }
        }
    }
}

/// The texture follows the path during the stroke, and the point plays again afterwards.
#[test]
fn the_texture_follows_the_path() {
    let mut harness = author();
    wait_for_field(&mut harness);
    draw_in_time(&mut harness, 1.5);
    click(&mut harness, path::PLAY);
    assert!(window(&harness).session().is_path_playing());
    let says_wait =
        painted(&harness, strings::CANVAS).iter().filter_map(words).any(|text| text == path::WAITS);
    assert!(says_wait, "nothing strokes yet");
    let begin = window(&harness).session().path_point().unwrap();
    assert!(begin.distance(place(&harness, "Brick")) < 1e-9);
    click(&mut harness, strings::HAND_START);
    let mut visited: Vec<SpacePoint> = Vec::new();
    let end = place(&harness, "Cotton weave");
    let mut loudest: f64 = 0.0;
    while visited.last().is_none_or(|at| at.distance(end) > 1e-9) {
        harness.step();
        std::thread::sleep(Duration::from_millis(5));
        let session = window(&harness).session();
        visited.push(session.path_point().unwrap());
        // The audible texture is that of the path position.
        assert!(session.authored().unwrap().location.at.distance(visited[visited.len() - 1]) < 1e-6);
        assert!(session.n_loaded() <= 3, "{}", session.n_loaded());
        loudest = loudest.max(session.scope().rms(0.2));
        assert!(visited.len() < 5000);
    }
    let back = visited.windows(2).filter(|p| p[1].distance(end) > p[0].distance(end) + 1e-9).count();
    assert!(back <= 1, "it goes on, from its beginning when the touch begins: {back} steps back");
    assert!(visited.iter().filter(|at| at.distance(begin) > 5.0 && at.distance(end) > 5.0).count() > 5);
    wait(&mut harness, "it stays at the end", |h| {
        h.state().as_ref().unwrap().session().scope().rms(0.2) > 1e-4
    });
    // The level of brick is about ten times that of cotton.
    let quiet = {
        for _ in 0..40 {
            harness.step();
            std::thread::sleep(Duration::from_millis(10));
        }
        window(&harness).session().scope().rms(0.2)
    };
    assert!(loudest > 3.0 * quiet, "{loudest} at the loudest, {quiet} m/s² at the end");
    click(&mut harness, path::STOP);
    assert_eq!(window(&harness).session().path_point(), None);
    let point = window(&harness).project().texture().at;
    assert!(window(&harness).session().authored().unwrap().location.at.distance(point) < 1e-9);
}

/// A stroke while the path tool is on is meant for the path.
#[test]
fn a_stroke_follows_the_path_that_was_just_drawn() {
    let mut harness = author();
    wait_for_field(&mut harness);
    draw_in_time(&mut harness, 1.5);
    click(&mut harness, strings::HAND_START);
    assert!(window(&harness).session().is_path_playing());
    // The point plays again when that is asked for, and without the tool.
    click(&mut harness, path::STOP);
    click(&mut harness, strings::HAND_STOP);
    click(&mut harness, path::PATH);
    click(&mut harness, strings::HAND_START);
    assert!(!window(&harness).session().is_path_playing());
}

/// Adding a path creates a texture of the list that contains the path.
#[test]
fn a_path_is_kept_as_a_texture() {
    let mut harness = author();
    wait_for_field(&mut harness);
    click(&mut harness, path::PATH);
    click(&mut harness, &strings::play_texture("Sanded wood"));
    click(&mut harness, &strings::play_texture("Felt"));
    click(&mut harness, path::KEEP);
    harness.run_steps(2);
    let session = window(&harness).session();
    let kept = session.library().textures.last().unwrap();
    assert_eq!((kept.name.as_str(), kept.id.as_str()), ("New texture", "new-texture"));
    let made = kept.path.as_ref().expect("a path");
    assert!(made.keys().len() > 5 && (made.length() - 0.2).abs() < 1e-12, "{}", made.keys().len());
    assert_eq!(made.keys()[0].model, kept.model);
    assert_eq!(made.at_end(), AtEnd::Turn);
    assert_eq!(kept.license, session.library().license_of(&session.library().textures[0]));
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!(window(&harness).session().textures().len(), 25);
}

/// A soloed path of the list changes along the stroke too.
#[test]
fn a_kept_path_is_heard_along_the_stroke() {
    let mut harness = author();
    wait_for_field(&mut harness);
    draw_in_time(&mut harness, 1.0);
    click(&mut harness, path::KEEP);
    // The list scrolls to the new texture.
    harness.run_steps(40);
    click(&mut harness, &strings::texture("New texture"));
    assert_eq!(solo(&harness), Some(25));
    let keys = window(&harness).session().textures()[25].path.as_ref().unwrap().keys().to_vec();
    // The click has begun a stroke that ends by itself; the button starts one that does not.
    click(&mut harness, strings::HAND_START);
    let last = keys[keys.len() - 1].model.clone();
    wait(&mut harness, "it comes to the end of the path", |h| {
        h.state().as_ref().unwrap().session().authored().unwrap().model.as_ref() == Some(&last)
    });
    assert!(window(&harness).session().n_loaded() <= 3);
}
