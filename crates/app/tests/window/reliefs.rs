//! Reliefs from pictures: a dropped picture, its size, the texture that gets it, undo, and what cannot be a relief.

use std::f64::consts::TAU;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::command::Command;
use shagreen_app::command::relief::ReliefCommand;
use shagreen_app::strings::{self, relief as words, textures};
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::blend::Mode;
use shagreen_formats::picture::encode_heights;

use crate::support::{
    Author, author, choose_mode, click, drop_files, says, shown, solo, unnamed_controls, wait,
    wait_for_field, window,
};
use crate::views::carry_out;

/// A gray PNG of eight ridges along y, which repeats without a seam.
fn ridges() -> Vec<u8> {
    let heights: Vec<f64> = (0..128 * 128).map(|i| (TAU * f64::from(i % 128) / 16.0).cos()).collect();
    encode_heights(&heights, 128).unwrap()
}

/// Highest height of the height map of a model, in µm.
fn highest_um(model: &TextureModel) -> f64 {
    let map = model.height_map().expect("a height map");
    1e6 * map.heights_m().iter().copied().fold(0.0, f64::max)
}

fn set(harness: &mut Author, name: &str, value: f64) {
    harness.get_by_role_and_label(Role::SpinButton, name).set_value_accesskit(value);
    harness.run_steps(2);
}

/// Number of sizes that are marked as defaults.
fn n_defaults(harness: &Author) -> usize {
    shown(harness).iter().filter(|text| *text == words::DEFAULT).count()
}

fn can_apply(harness: &Author) -> bool {
    harness.query_by_label(words::APPLY).is_some_and(|button| !button.accesskit_node().is_disabled())
}

fn apply(harness: &mut Author) {
    wait(harness, "the relief is computed", can_apply);
    click(harness, words::APPLY);
    harness.run_steps(4);
    assert!(harness.query_by_label(words::APPLY).is_none(), "the sheet closes");
}

/// Main use: drop a picture, state its size, feel it, and take it back in one step.
#[test]
fn a_dropped_picture_becomes_the_relief_of_the_authored_texture() {
    let mut harness = author();
    wait_for_field(&mut harness);
    let before = window(&harness).project().clone();
    drop_files(&mut harness, &[("ridges.png", &ridges())]);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    assert!(harness.query_by_label(words::FIND_POINT).is_some() && says(&harness, "ridges.png"));
    click(&mut harness, &words::use_as_relief("New texture"));
    harness.run_steps(2);
    assert!(says(&harness, &words::of_authored("New texture")));
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    // The default of both sizes is marked until it is changed.
    assert_eq!(n_defaults(&harness), 2);
    set(&mut harness, words::SIDE, 40.0);
    set(&mut harness, words::HEIGHT, 200.0);
    assert_eq!(n_defaults(&harness), 0);
    wait(&mut harness, "it is said what the heights rest on", |h| says(h, "200 µm (white)"));
    apply(&mut harness);

    let project = window(&harness).project().clone();
    let [entry] = &project.joined[..] else { panic!("{} joined", project.joined.len()) };
    assert_eq!(entry.name, "New texture with relief");
    assert!((highest_um(&entry.model) - 100.0).abs() < 0.1, "{}", highest_um(&entry.model));
    let side_mm = 1e3 * entry.model.height_map().unwrap().side_m();
    // The pad repeats a picture of this width where it is felt.
    let picture = entry.picture.as_ref().expect("the picture of the relief");
    assert!((side_mm - 40.0).abs() < 1e-9 && (picture.millimeters - side_mm).abs() < 1e-9);
    assert_eq!((entry.at(), project.solo.as_ref()), (Some(project.texture().at), Some(&entry.id)));
    assert!(project.texture().blend.locked.contains(&entry.id));
    click(&mut harness, strings::HAND_START);
    wait(&mut harness, "it sounds", |h| window(h).session().scope().rms(0.3) > 0.02);
    click(&mut harness, strings::HAND_STOP);

    click(&mut harness, strings::UNDO);
    assert_eq!(*window(&harness).project(), before, "one step takes it away");
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    harness.run_steps(3);
    assert_eq!(window(&harness).project().joined.len(), 1);
}

#[test]
fn a_texture_of_the_library_is_copied_and_an_added_one_is_changed() {
    let mut harness = author();
    click(&mut harness, &textures::more("Glass"));
    harness.run_steps(3);
    click(&mut harness, words::MENU);
    harness.run_steps(3);
    assert!(says(&harness, &words::of_library("Glass")));
    // With the sheet open, a dropped picture is its picture.
    drop_files(&mut harness, &[("ridges.png", &ridges())]);
    apply(&mut harness);
    let (n_textures, glass) = {
        let textures = window(&harness).session().textures();
        (textures.len(), textures[0].clone())
    };
    let copy = window(&harness).session().textures()[n_textures - 1].clone();
    assert_eq!((copy.name.as_str(), copy.place), ("Glass with relief", glass.place));
    assert!(glass.model.height_map().is_none() && (highest_um(&copy.model) - 50.0).abs() < 0.1);
    assert_eq!(solo(&harness), Some(n_textures - 1), "it plays");

    carry_out(&mut harness, Command::Relief(ReliefCommand::Begin(None, None)));
    assert!(says(&harness, &words::of_added("Glass with relief")) && says(&harness, words::REPLACES.trim()));
    drop_files(&mut harness, &[("ridges.png", &ridges())]);
    set(&mut harness, words::HEIGHT, 300.0);
    apply(&mut harness);
    let highest = |harness: &Author| {
        let joined = &window(harness).project().joined;
        assert_eq!(joined.len(), 1);
        // The list has the same model, which the output plays.
        assert_eq!(window(harness).session().textures()[n_textures - 1].model, joined[0].model);
        highest_um(&joined[0].model)
    };
    assert!((highest(&harness) - 150.0).abs() < 0.2, "{}", highest(&harness));
    click(&mut harness, strings::UNDO);
    harness.run_steps(3);
    assert!((highest(&harness) - 50.0).abs() < 0.1, "{}", highest(&harness));
}

#[test]
fn what_is_no_relief_is_said_and_what_is_impossible_is_warned_of() {
    let mut harness = author();
    carry_out(&mut harness, Command::Relief(ReliefCommand::Begin(None, None)));
    drop_files(&mut harness, &[("broken.png", b"hello")]);
    wait(&mut harness, "the error is shown", |h| says(h, "save it as JPEG or PNG: broken.png"));
    assert!(!can_apply(&harness));
    drop_files(&mut harness, &[("ridges.png", &ridges())]);
    wait(&mut harness, "it is read", can_apply);
    assert!(says(&harness, "ridges.png") && !says(&harness, "broken.png") && !says(&harness, "slopes of"));
    set(&mut harness, words::SIDE, 2.0);
    set(&mut harness, words::HEIGHT, 10_000.0);
    wait(&mut harness, "the slope is warned of", |h| says(h, "slopes of") && can_apply(h));
    // A picture that cannot be read leaves the present one.
    drop_files(&mut harness, &[("broken.png", b"hello")]);
    wait(&mut harness, "the error is shown", |h| says(h, "broken.png"));
    assert!(says(&harness, "ridges.png") && can_apply(&harness));
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(harness.query_by_label(words::APPLY).is_none());
    assert!(window(&harness).project().joined.is_empty());

    wait_for_field(&mut harness);
    choose_mode(&mut harness, Mode::Shared);
    carry_out(&mut harness, Command::Relief(ReliefCommand::Begin(None, None)));
    assert!(says(&harness, words::NO_MODEL) && !can_apply(&harness));
}
