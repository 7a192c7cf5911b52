//! Tooltips: they wait for a pointer that rests, not for the end of a drag, and do not teach what was learned.

use egui::{Event, Modifiers, PointerButton, vec2};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::state::files::StoragePaths;
use shagreen_app::strings;
use shagreen_formats::settings::read_settings;
use shagreen_studio::project::new_project;

use crate::support::{Author, author, author_of, begin, says, wait, wait_for_field, window};

const SIZE: [f32; 2] = [1280.0, 720.0];

/// First line of the tooltip of the point.
fn said_of_point(harness: &Author) -> String {
    let texture = window(harness).project().texture();
    format!("{} {}", texture.name, texture.at)
}

/// Drags the point, and lets the pointer rest where it was released.
fn drag_point(harness: &mut Author) {
    let from = harness.get_by_label(strings::POINT).rect().center();
    let to = from + vec2(40.0, -24.0);
    harness.hover_at(from);
    harness.drag_at(from);
    for share in [0.3, 0.6, 1.0] {
        harness.hover_at(from.lerp(to, share));
    }
    let button = PointerButton::Primary;
    harness.event(Event::PointerButton { pos: to, button, pressed: false, modifiers: Modifiers::NONE });
    harness.run_steps(1);
}

#[test]
fn a_tooltip_waits_for_a_pointer_that_rests_and_not_for_the_end_of_a_drag() {
    let mut harness = author();
    wait_for_field(&mut harness);
    harness.hover_at(harness.get_by_label(strings::POINT).rect().center());
    harness.run_steps(1);
    assert!(!says(&harness, strings::POINT_HELP), "at once");
    wait(&mut harness, "it explains", |h| says(h, strings::POINT_HELP));
    drag_point(&mut harness);
    // Frames of the test are 0.25 s apart.
    for _ in 0..3 {
        assert!(!says(&harness, &said_of_point(&harness)), "within 1 s after the drag");
        harness.run_steps(1);
    }
    wait(&mut harness, "it appears again", |h| says(h, &said_of_point(h)));
    assert!(!says(&harness, strings::POINT_HELP), "a drag needs no explanation any more");
}

#[test]
fn what_was_learned_is_remembered() {
    let folder = tempfile::tempdir().unwrap();
    let settings = folder.path().join("settings.json");
    std::fs::write(&settings, r#"{"has_seen_tour": true}"#).unwrap();
    let keeping = StoragePaths { settings: Some(settings.clone()), ..StoragePaths::default() };
    let begin = shagreen_app::Begin { keeping, ..begin(new_project()) };
    let mut harness = author_of(begin.clone(), SIZE);
    wait_for_field(&mut harness);
    drag_point(&mut harness);
    wait(&mut harness, "it is remembered", |_| {
        std::fs::read(&settings).is_ok_and(|bytes| read_settings(&bytes).0.learned_hints == ["drag-point"])
    });
    drop(harness);
    let mut harness = author_of(begin, SIZE);
    wait_for_field(&mut harness);
    harness.hover_at(harness.get_by_label(strings::POINT).rect().center());
    wait(&mut harness, "the tooltip appears", |h| says(h, &said_of_point(h)));
    assert!(!says(&harness, strings::POINT_HELP));
}
