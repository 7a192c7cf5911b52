//! The Author workspace: drags of the point, and the resulting sliders, weights and output signal.

use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use shagreen_app::strings;
use shagreen_app::strings::{document, stroke};
use shagreen_core::texture::blend::Mode;
use shagreen_studio::project::new_project;

use crate::support::{
    Author, author, author_of, begin, choose_mode, click, drag, shown, unnamed_controls, wait,
    wait_for_field, window,
};

/// Runs frames for some seconds in real time.
fn listen(harness: &mut Author, seconds: f64) {
    let start = Instant::now();
    while start.elapsed().as_secs_f64() < seconds {
        harness.step();
        std::thread::sleep(Duration::from_millis(10));
    }
}

fn slider(harness: &Author, name: &str) -> f64 {
    harness
        .get_by_role_and_label(Role::Slider, name)
        .accesskit_node()
        .numeric_value()
        .expect("a slider has a value")
}

fn center(harness: &Author, name: &str) -> Pos2 {
    harness.get_by_label(name).rect().center()
}

fn parents(harness: &Author) -> Vec<(String, f64)> {
    let session = window(harness).session();
    let authored = session.authored().expect("a blend");
    authored.parents.iter().map(|(t, w)| (session.textures()[*t].name.clone(), *w)).collect()
}

#[test]
fn every_control_has_a_name() {
    let harness = author();
    for (role, name) in [
        (Role::Slider, strings::ROUGH_SMOOTH),
        (Role::Slider, strings::HARD_SOFT),
        (Role::SpinButton, strings::HAND_SPEED),
        (Role::SpinButton, strings::HAND_FORCE),
        (Role::Slider, strings::POINT),
        (Role::TextInput, strings::NAME),
        (Role::TextInput, strings::SEARCH),
        (Role::Canvas, strings::CANVAS),
        (Role::Canvas, strings::PAD),
        (Role::ComboBox, strings::HAND_PATH),
        (Role::ComboBox, strings::OUTPUT),
        (Role::ComboBox, strings::BLEND_MODE),
        (Role::CheckBox, strings::BEYOND),
    ] {
        assert!(harness.query_by_role_and_label(role, name).is_some(), "no {role:?} is named {name}");
    }
    for name in [strings::UNDO, strings::REDO, strings::MUTE, strings::HAND_START] {
        assert!(harness.query_by_label(name).is_some(), "nothing is named {name}");
    }
    for texture in window(&harness).session().textures() {
        assert!(harness.query_by_label(&format!("Play {}", texture.name)).is_some());
    }
}

#[test]
fn no_control_is_without_a_name() {
    let harness = author();
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
}

/// Negative control: a slider without an accessible name is found.
#[test]
fn a_control_without_a_name_is_found() {
    let harness = Harness::builder().with_accessibility_check(false).build_ui(|ui| {
        ui.add(egui::Slider::new(&mut 1.0_f64, 0.0..=2.0).show_value(false));
    });
    assert_eq!(unnamed_controls(&harness).len(), 1);
}

/// Main use: a drag of the point changes sliders, weights and output signal. The interpolation mode does not smooth
/// textures at their own positions.
#[test]
fn dragging_the_point_changes_sliders_weights_and_sound() {
    let mut harness = author();
    choose_mode(&mut harness, Mode::Shared);
    click(&mut harness, strings::HAND_START);
    wait(&mut harness, "the hand strokes", |h| window(h).session().touch().contact.force_n > 0.0);

    let smooth = center(&harness, "Play Glass");
    let from = center(&harness, strings::POINT);
    drag(&mut harness, from, smooth);
    assert!(slider(&harness, strings::ROUGH_SMOOTH) > 95.0 && slider(&harness, strings::HARD_SOFT) < 5.0);
    assert!(parents(&harness)[0].0 == "Glass" && parents(&harness)[0].1 > 0.9, "{:?}", parents(&harness));
    assert!(harness.query_by_label_contains("Glass, ").is_some(), "the weight is shown");
    listen(&mut harness, 1.0);
    let quiet = window(&harness).session().scope().rms(0.6);

    let (from, rough) = (center(&harness, strings::POINT), center(&harness, "Play Brick"));
    drag(&mut harness, from, rough);
    assert!(slider(&harness, strings::ROUGH_SMOOTH) < 5.0);
    assert_eq!(parents(&harness)[0].0, "Brick");
    listen(&mut harness, 1.0);
    let loud = window(&harness).session().scope().rms(0.6);
    // The models differ in level by a factor of about fifty.
    assert!(quiet > 1e-3 && loud > 5.0 * quiet, "glass {quiet} m/s², brick {loud} m/s²");

    // The shown spectrum is that of the output signal: its level equals that of the model, within the noise of 0.6 s.
    let spectra = window(&harness).session().spectra();
    let steps = spectra.frequencies.windows(2).map(|f| f[1].0 - f[0].0);
    let power: f64 = steps.zip(&spectra.blend).map(|(df, p)| df * p).sum();
    assert!((power.sqrt() / loud).log10().abs() < 0.15, "shown {} m/s², heard {loud}", power.sqrt());

    click(&mut harness, strings::HAND_STOP);
    listen(&mut harness, 0.8);
    assert!(window(&harness).session().scope().rms(0.3) < 1e-3, "silence when the hand stops");
}

#[test]
fn sliders_move_the_point_and_undo_brings_it_back() {
    let mut harness = author();
    let start = window(&harness).project().texture().at;
    let before = center(&harness, strings::POINT);
    harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).set_value_accesskit(80.0);
    harness.run_steps(3);
    assert!((window(&harness).project().texture().at.x() - 80.0).abs() < 1e-9);
    assert!(center(&harness, strings::POINT).x > before.x + 50.0, "the point follows the slider");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!(window(&harness).project().texture().at, start);
    assert!((slider(&harness, strings::ROUGH_SMOOTH) - start.x()).abs() < 0.1);
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    harness.run_steps(3);
    assert!((window(&harness).project().texture().at.x() - 80.0).abs() < 1e-9);
}

/// A slider with hardly any rail could not be dragged: there, the number has its name instead.
#[test]
fn the_stroke_has_sliders_only_where_their_rails_have_room() {
    for (size, role, is_named) in
        [([960.0, 600.0], Role::SpinButton, true), ([1920.0, 1080.0], Role::Slider, false)]
    {
        let mut harness = author_of(begin(new_project()), size);
        harness.run_steps(2);
        for (name, word) in
            [(strings::HAND_SPEED, stroke::SPEED), (strings::HAND_FORCE, stroke::NORMAL_FORCE)]
        {
            assert!(harness.query_by_role_and_label(role, name).is_some(), "{name} at {size:?}");
            assert_eq!(shown(&harness).iter().any(|text| text == word), is_named, "{word}");
        }
    }
}

#[test]
fn a_whole_drag_is_one_step_of_undo() {
    let mut harness = author();
    let start = window(&harness).project().texture().at;
    let (from, to) = (center(&harness, strings::POINT), center(&harness, "Play Felt"));
    drag(&mut harness, from, to);
    assert_ne!(window(&harness).project().texture().at, start);
    click(&mut harness, strings::UNDO);
    assert_eq!(window(&harness).project().texture().at, start);
}

/// In a slow window, the end of a drag, the release and a later movement arrive in one frame. The position of the
/// release counts.
#[test]
fn a_drag_ends_where_it_was_let_go_however_slow_the_window_is() {
    let mut harness = author();
    let start = window(&harness).project().texture().at;
    let (from, to) = (center(&harness, strings::POINT), center(&harness, "Play Felt"));
    harness.hover_at(from);
    harness.run_steps(2);
    harness.drag_at(from);
    harness.run_steps(2);
    harness.hover_at(from.lerp(to, 0.3));
    harness.step();
    let release = Event::PointerButton {
        pos: to,
        button: PointerButton::Primary,
        pressed: false,
        modifiers: Modifiers::NONE,
    };
    let away = from.lerp(to, 0.6);
    harness.input_mut().events.extend([Event::PointerMoved(to), release, Event::PointerMoved(away)]);
    harness.run_steps(3);
    let point = window(&harness).project().texture().at;
    let nearest = window(&harness)
        .session()
        .space()
        .sites()
        .iter()
        .map(|(_, at)| at.distance(point))
        .fold(100.0, f64::min);
    assert!(nearest < 1.0, "let go at {point}, {nearest} from the nearest texture");
    click(&mut harness, strings::UNDO);
    assert_eq!(window(&harness).project().texture().at, start, "one step of undo");
}

#[test]
fn the_keyboard_moves_the_point_and_starts_the_hand() {
    let mut harness = author();
    let start = window(&harness).project().texture().at;
    harness.key_press(Key::ArrowRight);
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::SHIFT, Key::ArrowUp);
    harness.run_steps(2);
    let moved = window(&harness).project().texture().at;
    assert_eq!((moved.x(), moved.y()), (start.x() + 1.0, start.y() + 5.0));
    harness.key_press(Key::Space);
    harness.run_steps(2);
    assert!(window(&harness).session().hand_is_running());
    // While a text field has the focus, the space key types a space.
    harness.get_by_role_and_label(Role::TextInput, strings::NAME).focus();
    harness.run_steps(2);
    harness.key_press(Key::Space);
    harness.key_press(Key::ArrowRight);
    harness.run_steps(2);
    assert!(window(&harness).session().hand_is_running());
    assert_eq!(window(&harness).project().texture().at, moved);
}

#[test]
fn the_mouse_strokes_the_pad() {
    let mut harness = author();
    let middle = harness.get_by_role_and_label(Role::Canvas, strings::PAD).rect().center();
    harness.hover_at(middle);
    harness.run_steps(2);
    harness.drag_at(middle);
    harness.run_steps(1);
    let mut loudest = 0.0_f64;
    for i in 0..80 {
        harness.hover_at(middle + vec2(100.0 * (f64::from(i) * 0.15).sin() as f32, 0.0));
        harness.step();
        std::thread::sleep(Duration::from_millis(10));
        loudest = loudest.max(window(&harness).session().scope().rms(0.1));
    }
    assert!(loudest > 0.02, "stroking sounds: {loudest}");
    harness.drop_at(middle);
    harness.run_steps(2);
    listen(&mut harness, 0.8);
    assert!(window(&harness).session().scope().rms(0.3) < 1e-3, "lifting is silence");
}

#[test]
fn outside_the_measured_textures_the_window_says_so() {
    let mut harness = author();
    harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).set_value_accesskit(100.0);
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::Slider, strings::HARD_SOFT).set_value_accesskit(100.0);
    harness.run_steps(2);
    let authored = window(&harness).session().authored().unwrap().clone();
    assert!(authored.location.clamped);
    assert_eq!(window(&harness).project().texture().at.y(), 100.0, "the wish is kept");
}

#[test]
fn the_blend_is_chosen_and_a_search_narrows_the_list() {
    let mut harness = author();
    for mode in Mode::ALL.into_iter().rev() {
        choose_mode(&mut harness, mode);
        harness.run_steps(2);
    }
    choose_mode(&mut harness, Mode::Paper);
    harness.get_by_role_and_label(Role::TextInput, strings::SEARCH).focus();
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::TextInput, strings::SEARCH).type_text("wood");
    harness.run_steps(3);
    assert!(harness.query_by_label("Texture Sanded wood").is_some());
    assert!(harness.query_by_label("Texture Glass").is_none());
}

/// The point plays while it is dragged, unless that is turned off, and is silent again afterwards.
#[test]
fn the_point_plays_while_it_is_dragged() {
    let mut harness = author();
    wait_for_field(&mut harness);
    let from = harness.get_by_role_and_label(Role::Slider, strings::POINT).rect().center();
    for is_silent in [false, true] {
        assert!(!window(&harness).session().hand_is_running());
        harness.drag_at(from);
        harness.run_steps(2);
        harness.hover_at(from + vec2(60.0, -20.0));
        harness.run_steps(3);
        assert_eq!(window(&harness).session().hand_is_running(), !is_silent);
        harness.drop_at(from + vec2(60.0, -20.0));
        harness.run_steps(3);
        assert!(!window(&harness).session().hand_is_running(), "it stops with the drag");
        harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        harness.run_steps(3);
        if !is_silent {
            click(&mut harness, document::FILE);
            click(&mut harness, document::DRAG_STROKE);
            harness.run_steps(3);
        }
    }
}
