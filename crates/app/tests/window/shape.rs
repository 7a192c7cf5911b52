//! Shape of an authored texture: effect of each control, undo, reset, and modes that mix library textures.

use std::sync::Arc;

use egui::accesskit::Role;
use egui::vec2;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::command::Command;
use shagreen_app::state::edit::Edit;
use shagreen_app::strings;
use shagreen_app::strings::shape as words;
use shagreen_core::dsp::spectrum::{centroid, rms};
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::profile::Profile;
use shagreen_core::texture::relief::Relief;
use shagreen_core::texture::shape::{Shape, ShapeControl};
use shagreen_core::texture::tap::Tap;
use shagreen_core::units::{Hertz, Newtons};
use shagreen_formats::starter::starter_library;

use crate::support::{
    Author, author, author_on, choose_mode, click, drag, says, unnamed_controls, wait, wait_for_field, window,
};
use crate::views::carry_out;

/// Properties of the audible texture.
#[derive(Debug, PartialEq)]
struct Heard {
    spectrum: Vec<(Hertz, f64)>,
    tap: Tap,
    friction: f64,
    relief_mps2: f64,
    turn_rad: f64,
}

impl Heard {
    fn centroid_hz(&self) -> f64 {
        centroid(&self.spectrum, Hertz(10.0), Hertz(500.0)).0
    }

    /// Level in the shown band, in m/s².
    fn level_mps2(&self) -> f64 {
        let steps = self.spectrum.windows(2).map(|pair| (pair[1].0.0 - pair[0].0.0) * pair[0].1);
        steps.sum::<f64>().sqrt()
    }
}

fn heard(harness: &Author) -> Heard {
    let session = window(harness).session();
    let authored = session.authored().expect("a texture");
    let model = authored.model.as_ref().expect("an interpolated texture");
    let relief_mps2 = model.relief().map_or(0.0, |relief| rms(relief.profile().values()));
    Heard {
        spectrum: spectrum(harness),
        tap: tap(harness),
        friction: model.friction().expect("a friction coefficient"),
        relief_mps2,
        turn_rad: model.turn_rad(),
    }
}

fn spectrum(harness: &Author) -> Vec<(Hertz, f64)> {
    let spectra = window(harness).session().spectra();
    spectra.frequencies.iter().copied().zip(spectra.blend.iter().copied()).collect()
}

fn tap(harness: &Author) -> Tap {
    let session = window(harness).session();
    let of = |texture: usize| session.textures()[texture].model.tap();
    session.authored().expect("a texture").tap(of).expect("a tap transient")
}

fn shape(harness: &Author) -> Shape {
    window(harness).project().texture().shape
}

pub(crate) fn set(harness: &mut Author, control: ShapeControl, value: f64) {
    harness.get_by_role_and_label(Role::Slider, &words::slider(control)).set_value_accesskit(value);
    harness.run_steps(3);
}

/// Presses a button that may lie below the visible part of the inspector.
fn press(harness: &mut Author, name: &str) {
    harness.get_by_role_and_label(Role::Button, name).click_accesskit();
    harness.run_steps(3);
}

/// Opens the group of the controls.
pub(crate) fn open(harness: &mut Author) {
    click(harness, words::HEADING);
    harness.run_steps(10);
}

/// Ratio of the audible values after and before a control is set.
fn check(control: ShapeControl, before: &Heard, after: &Heard) {
    let near = |value: f64, expected: f64| (value / expected - 1.0).abs() < 1e-6;
    match control {
        ShapeControl::Level => {
            for ((_, after), (_, before)) in after.spectrum.iter().zip(&before.spectrum) {
                assert!(near(after / before, 10_f64.powf(-0.6)), "{after} for {before}");
            }
            assert_eq!(after.tap, before.tap, "the tap has its own control");
        }
        ShapeControl::Grain => assert!(after.centroid_hz() < 0.8 * before.centroid_hz()),
        ShapeControl::Brightness => {
            assert!(after.centroid_hz() > 1.1 * before.centroid_hz());
            // The shown band ends at 500 Hz, half of the model rate.
            let ratio = after.level_mps2() / before.level_mps2();
            assert!((0.8..1.2).contains(&ratio), "{ratio}");
        }
        ShapeControl::Softness => {
            assert!(near(after.tap.frequency.0, 0.5 * before.tap.frequency.0));
            assert!(near(after.tap.decay_per_sec, 0.5 * before.tap.decay_per_sec));
            assert_eq!(after.spectrum, before.spectrum);
        }
        ShapeControl::Friction => assert!(near(after.friction, 0.5 * before.friction)),
        ShapeControl::Relief => assert!(near(after.relief_mps2, 2.0 * before.relief_mps2)),
        ShapeControl::Direction => {
            let turn = (after.turn_rad - before.turn_rad).rem_euclid(std::f64::consts::TAU);
            assert!(near(turn, 30_f64.to_radians()), "{turn} rad");
        }
    }
}

/// Each slider changes the project and the audible texture as its name says, and one undo restores both.
#[test]
fn each_control_changes_what_it_names() {
    let mut library = starter_library().unwrap();
    let profile = Profile::new(1e-4, vec![0.0, 0.2, -0.4, 0.1]).unwrap();
    let relief = Arc::new(Relief::new(profile, Newtons(1.0)).unwrap());
    for texture in &mut library.textures {
        texture.model = texture.model.clone().with_relief(Some(Arc::clone(&relief)));
    }
    let mut harness = author_on(library, [1280.0, 720.0]);
    wait_for_field(&mut harness);
    open(&mut harness);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    let before = heard(&harness);
    assert!(before.relief_mps2 > 0.0);
    for (control, value) in ShapeControl::ALL.into_iter().zip([-6.0, 2.0, 4.0, 2.0, 0.5, 2.0, 30.0]) {
        set(&mut harness, control, value);
        assert_eq!(shape(&harness), Shape::default().with(control, value), "{control:?}");
        check(control, &before, &heard(&harness));
        click(&mut harness, strings::UNDO);
        harness.run_steps(2);
        assert_eq!(shape(&harness), Shape::default());
        assert_eq!(heard(&harness), before, "{control:?} is undone");
    }
}

/// Modes that mix the signals of library textures shape each of them, and their taps.
#[test]
fn mixed_textures_are_shaped_too() {
    let mut harness = author();
    wait_for_field(&mut harness);
    open(&mut harness);
    for mode in [Mode::Shared, Mode::Power, Mode::Paper] {
        choose_mode(&mut harness, mode);
        harness.run_steps(2);
        let (spectrum_before, tap_before) = (spectrum(&harness), tap(&harness));
        set(&mut harness, ShapeControl::Level, -6.0);
        set(&mut harness, ShapeControl::Softness, 2.0);
        for ((_, after), (_, before)) in spectrum(&harness).iter().zip(&spectrum_before) {
            assert!((after / before / 10_f64.powf(-0.6) - 1.0).abs() < 1e-6, "{mode:?}");
        }
        assert!((tap(&harness).frequency.0 / tap_before.frequency.0 - 0.5).abs() < 1e-6, "{mode:?}");
        wait(&mut harness, "the shaped textures are loaded", |h| window(h).session().n_loaded() >= 3);
        press(&mut harness, words::RESET_ALL);
        assert_eq!(spectrum(&harness), spectrum_before, "{mode:?}");
    }
}

/// A control with nothing to act on is disabled and says why; it returns with a texture that has it.
#[test]
fn a_control_with_nothing_to_act_on_says_why() {
    let mut library = starter_library().unwrap();
    for texture in &mut library.textures {
        // Grain that is equal in all directions, and nothing else.
        let grain = TextureModel::new(texture.model.rate(), texture.model.nodes().to_vec(), None);
        texture.model = grain.unwrap();
    }
    let mut harness = author_on(library, [1280.0, 1000.0]);
    wait_for_field(&mut harness);
    open(&mut harness);
    let idle =
        [ShapeControl::Softness, ShapeControl::Friction, ShapeControl::Relief, ShapeControl::Direction];
    for control in ShapeControl::ALL {
        assert_eq!(is_disabled(&harness, control), idle.contains(&control), "{control:?}");
    }
    for control in idle {
        // A screen reader may set a disabled slider.
        set(&mut harness, control, *control.limits().end());
        harness.get_by_role_and_label(Role::Slider, &words::slider(control)).hover();
        wait(&mut harness, "it says why", |h| says(h, words::nothing(control)));
        harness.remove_cursor();
        harness.run_steps(4);
    }
    assert_eq!(shape(&harness), Shape::default());
    // A value that another texture needs can be made neutral.
    carry_out(&mut harness, Command::Edit(Edit::SetShape(ShapeControl::Relief, 2.0)));
    assert!(is_disabled(&harness, ShapeControl::Relief));
    press(&mut harness, &words::reset(ShapeControl::Relief));
    assert_eq!(shape(&harness), Shape::default());

    let mut harness = author();
    wait_for_field(&mut harness);
    open(&mut harness);
    for control in ShapeControl::ALL {
        // No texture of the starter library has a relief.
        assert_eq!(is_disabled(&harness, control), control == ShapeControl::Relief, "{control:?}");
    }
}

fn is_disabled(harness: &Author, control: ShapeControl) -> bool {
    let name = words::slider(control);
    harness.get_by_role_and_label(Role::Slider, &name).accesskit_node().is_disabled()
}

/// A whole drag of a slider is one step. While it lasts, the texture plays.
#[test]
fn a_drag_of_a_slider_is_one_step_and_is_heard() {
    let mut harness = author();
    wait_for_field(&mut harness);
    open(&mut harness);
    let area = harness.get_by_role_and_label(Role::Slider, &words::slider(ShapeControl::Level)).rect();
    // Neutral lies at two thirds of the slider, from -24 to 12 dB.
    let from = area.left_center() + vec2(0.667 * area.width(), 0.0);
    let to = area.left_center() + vec2(0.4 * area.width(), 0.0);
    harness.hover_at(from);
    harness.run_steps(2);
    harness.drag_at(from);
    harness.run_steps(2);
    harness.hover_at(to);
    harness.run_steps(3);
    assert!(window(&harness).session().hand_is_running(), "it plays while it is dragged");
    harness.drop_at(to);
    harness.run_steps(4);
    assert!(!window(&harness).session().hand_is_running());
    let quiet = shape(&harness).level_db;
    assert!((-16.0..-4.0).contains(&quiet), "{quiet} dB");
    // Another drag of the same slider is another step.
    drag(&mut harness, to, from);
    assert!(shape(&harness).level_db > quiet);
    click(&mut harness, strings::UNDO);
    assert_eq!(shape(&harness).level_db, quiet);
    click(&mut harness, strings::UNDO);
    assert_eq!(shape(&harness), Shape::default());
}

#[test]
fn a_number_out_of_range_becomes_the_limit_and_the_range_is_said() {
    let mut harness = author();
    wait_for_field(&mut harness);
    open(&mut harness);
    set(&mut harness, ShapeControl::Level, 99_999.0);
    assert_eq!(shape(&harness).level_db, 12.0);
    assert!(says(&harness, &words::limited(ShapeControl::Level)));
    assert_eq!(words::limited(ShapeControl::Level), "Level: -24.0 dB to 12.0 dB");
}

/// Buttons make one control or all of them neutral; copies and snapshots keep the shape.
#[test]
fn a_shape_is_reset_and_copied() {
    let mut harness = author();
    wait_for_field(&mut harness);
    open(&mut harness);
    let is_disabled = |harness: &Author, name: &str| {
        harness.get_by_role_and_label(Role::Button, name).accesskit_node().is_disabled()
    };
    assert!(is_disabled(&harness, words::RESET_ALL));
    assert!(is_disabled(&harness, &words::reset(ShapeControl::Grain)));
    set(&mut harness, ShapeControl::Grain, 2.0);
    set(&mut harness, ShapeControl::Friction, 0.5);
    assert!(says(&harness, &words::heading(2)));
    press(&mut harness, &words::reset(ShapeControl::Grain));
    assert_eq!(shape(&harness), Shape { friction: 0.5, ..Shape::default() });
    carry_out(&mut harness, Command::DuplicateTexture);
    assert_eq!(window(&harness).project().selected, 1);
    assert_eq!(shape(&harness).friction, 0.5, "a copy has the shape");
    carry_out(&mut harness, Command::Edit(Edit::KeepSnapshot));
    press(&mut harness, words::RESET_ALL);
    assert_eq!(shape(&harness), Shape::default());
    carry_out(&mut harness, Command::Edit(Edit::RestoreSnapshot(0)));
    assert_eq!(shape(&harness).friction, 0.5, "a snapshot has the shape");
}

/// The mark of the lay is there for a texture with a direction, and turns with it.
#[test]
fn the_lay_is_shown_and_turns() {
    let mut harness = author();
    wait_for_field(&mut harness);
    let lay_deg = |harness: &Author| window(harness).session().lay().map(|lay| lay.0.to_degrees().round());
    click(&mut harness, &strings::play_texture("Glass"));
    harness.run_steps(4);
    assert_eq!(lay_deg(&harness), None);
    click(&mut harness, &strings::play_texture("Brushed aluminium"));
    harness.run_steps(4);
    assert_eq!(lay_deg(&harness), Some(90.0));
    click(&mut harness, strings::textures::CHOOSE);
    carry_out(&mut harness, Command::Edit(Edit::SetShape(ShapeControl::Direction, 30.0)));
    wait(&mut harness, "the texture is turned", |h| lay_deg(h) == Some(120.0));
}
