//! The devices sheet.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, Shape};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::Begin;
use shagreen_app::session::OutputChoice;
use shagreen_app::state::rig::{Mounted, Rig};
use shagreen_app::strings::{clipboard, devices as strings};
use shagreen_core::actuator::Actuator;
use shagreen_device::haptic_pen::system::SIMULATED_ID;
use shagreen_formats::actuator_toml::{built_in_actuators, write_actuator};
use shagreen_studio::project::new_project;

use crate::frame::painted;
use crate::support::{
    Author, author, author_at, author_of, begin, choose, click, says, shown, unnamed_controls, wait, window,
};

fn opened() -> Author {
    let mut harness = author();
    click(&mut harness, strings::OPEN);
    wait(&mut harness, "the sheet opens", |h| says(h, strings::TITLE));
    harness
}

fn rig(harness: &Author) -> &Rig {
    window(harness).session().rig()
}

#[test]
fn the_sheet_opens_and_closes_by_keys_and_names_everything() {
    let mut harness = author();
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::D);
    wait(&mut harness, "the sheet opens", |h| says(h, strings::ACTUATOR));
    assert_eq!(unnamed_controls(&harness), [""; 0]);
    assert!(says(&harness, "48000 Hz, 2 channels"));
    let limits = strings::latency_limits(30.0, 6.0);
    for line in [strings::LATENCY_OF_STROKES, strings::LATENCY_OF_TAPS, &limits] {
        assert!(says(&harness, line), "{line}");
    }
    // A bar without a handle.
    let meter = harness.get_by_role_and_label(Role::ProgressIndicator, strings::METER).rect();
    assert!(meter.height() < 10.0 && meter.width() < 120.0, "{meter:?}");
    harness.key_press(Key::Escape);
    wait(&mut harness, "the sheet closes", |h| !says(h, strings::ACTUATOR));
}

#[test]
fn numbers_have_the_same_decimals_at_every_scale() {
    for scale in [1.0, 1.5, 2.0] {
        let mut harness = author_at(begin(new_project()), [1280.0, 720.0], scale);
        click(&mut harness, strings::OPEN);
        wait(&mut harness, "the sheet opens", |h| says(h, strings::TITLE));
        assert!(says(&harness, "1.00 m/s²"), "{scale}");
    }
}

#[test]
fn an_actuator_is_chosen_equalized_and_limits_the_output() {
    let mut harness = opened();
    choose(&mut harness, strings::ACTUATOR, "Haptuator Mark II-D");
    wait(&mut harness, "it is taken over", |h| rig(h).actuator().is_some());
    assert!(says(&harness, "65 Hz, Q 4.1") && says(&harness, "1.41 V rms continuous, 4.5 V peak"));
    wait(&mut harness, "the output is open again", |h| window(h).session().status().is_some());
    let drive = rig(&harness).drive().unwrap();
    assert!(drive.inverse.is_some() && drive.budget.is_some());
    click(&mut harness, strings::EQUALIZE);
    wait(&mut harness, "the equalizer is off", |h| !rig(h).equalizes);
    assert!(rig(&harness).drive().unwrap().inverse.is_none());
    choose(&mut harness, strings::ACTUATOR, strings::UNCALIBRATED);
    wait(&mut harness, "none is known", |h| rig(h).actuator().is_none());
}

#[test]
fn an_actuator_without_a_response_is_named_and_can_be_left() {
    let mut harness = opened();
    choose(&mut harness, strings::ACTUATOR, "Haptuator MM1C");
    wait(&mut harness, "what to do is said", |h| says(h, "calibrate"));
    // The drive signal of another actuator is not used for this one.
    wait(&mut harness, "the output is closed", |h| window(h).session().is_output_released());
    assert!(window(&harness).session().status().is_none());
    choose(&mut harness, strings::ACTUATOR, "Haptuator Mark II-D");
    wait(&mut harness, "the output is open again", |h| window(h).session().status().is_some());
}

#[test]
fn a_sheet_that_is_opened_again_knows_the_profile_that_was_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let built_in = built_in_actuators().unwrap();
    let known = built_in.into_iter().find(|a| a.name == "Haptuator Mark II-D").unwrap();
    // It has the same id as a built-in profile.
    let mine = Actuator { name: "Mine".to_owned(), ..known };
    std::fs::write(&path, write_actuator(&mine)).unwrap();
    let mut harness = opened();
    read_profile(&mut harness, path.to_str().unwrap());
    wait(&mut harness, "it is taken over", |h| rig(h).actuator().is_some());
    click(&mut harness, strings::CLOSE);
    wait(&mut harness, "the sheet closes", |h| !says(h, strings::ACTUATOR));
    click(&mut harness, strings::OPEN);
    wait(&mut harness, "the sheet opens", |h| says(h, strings::TITLE));
    let load = harness.get_by_role_and_label(Role::SpinButton, strings::LOAD);
    load.focus();
    load.type_text("77");
    harness.key_press(Key::Enter);
    wait(&mut harness, "another load is taken", |h| {
        rig(h).mounted.as_ref().and_then(Mounted::load).is_some_and(|load| (load.g() - 77.0).abs() < 1.0)
    });
    assert_eq!(rig(&harness).actuator().unwrap().name, "Mine");
}

fn read_profile(harness: &mut Author, path: &str) {
    let field = harness.get_by_role_and_label(Role::TextInput, strings::PROFILE_PATH);
    field.focus();
    field.type_text(path);
    harness.step();
    click(harness, strings::OPEN_PROFILE);
}

#[test]
fn buffers_and_channels_open_the_output_again() {
    let mut harness = opened();
    choose(&mut harness, strings::BUFFER, &strings::buffer(512, 48_000.0));
    wait(&mut harness, "the buffer is taken", |h| {
        window(h).session().stream().is_some_and(|(.., frames)| frames == Some(512))
    });
    choose(&mut harness, strings::CHANNELS, &strings::channel(1));
    wait(&mut harness, "the channel is taken", |h| rig(h).channel == Some(1));
}

#[test]
fn a_controller_names_its_channels_and_is_driven_before_it_is_calibrated() {
    let mut harness = opened();
    choose(&mut harness, strings::ACTUATOR, "DualSense controller (USB)");
    wait(&mut harness, "it is taken over", |h| rig(h).actuator().is_some());
    wait(&mut harness, "its channels are named", |h| says(h, "left grip, right grip"));
    assert!(says(&harness, strings::PROPORTIONAL));
    assert!(rig(&harness).drive().unwrap().inverse.is_none());
}

#[test]
fn a_pen_is_chosen_automatically_and_its_backend_is_named() {
    let harness = opened();
    assert_eq!(rig(&harness).pen.as_deref(), Some("auto"));
    let session = window(&harness).session();
    match session.pen_facts() {
        Some(facts) => assert!(says(&harness, &facts.name)),
        None => assert!(says(&harness, strings::WINDOW_POINTER)),
    }
}

#[test]
fn a_haptic_pen_says_that_it_approximates() {
    let output = OutputChoice::Id(SIMULATED_ID.to_owned());
    let mut harness = author_of(Begin { output, ..begin(new_project()) }, [1280.0, 720.0]);
    click(&mut harness, strings::OPEN);
    wait(&mut harness, "the sheet opens", |h| says(h, strings::TITLE));
    assert!(says(&harness, strings::HAPTIC_PEN_SILENT));
    assert!(window(&harness).session().haptic_reading().is_some());
    // What does not apply to it is not offered.
    assert!(says(&harness, strings::NO_ACTUATOR_ON_PEN) && says(&harness, strings::FULL_SCALE));
    for list in [strings::ACTUATOR, strings::CHANNELS] {
        assert!(harness.query_by_role_and_label(Role::ComboBox, list).is_none(), "{list}");
    }
    assert!(!says(&harness, strings::CALIBRATE) && !says(&harness, strings::LEAVE_ACTUATOR_OUT));
}

#[test]
fn only_channels_that_the_profile_names_are_offered() {
    let mut harness = opened();
    choose(&mut harness, strings::CHANNELS, &strings::channel(1));
    wait(&mut harness, "the channel is taken over", |h| rig(h).channel == Some(1));
    let actuators = built_in_actuators().unwrap();
    let dualsense = actuators.iter().find(|actuator| actuator.id == "dualsense").unwrap();
    choose(&mut harness, strings::ACTUATOR, &dualsense.name);
    wait(&mut harness, "it is taken over", |h| rig(h).actuator().is_some());
    assert_eq!(rig(&harness).channel, None, "the profile does not name it");
    harness.get_by_role_and_label(Role::ComboBox, strings::CHANNELS).click();
    harness.run_steps(3);
    for channel_idx in [0, 1] {
        let name = strings::channel(channel_idx);
        assert!(harness.query_by_role_and_label(Role::Button, &name).is_none(), "{channel_idx}");
    }
}

#[test]
fn a_tone_plays_and_ends() {
    let mut harness = opened();
    click(&mut harness, strings::PLAY_TONE);
    wait(&mut harness, "the tone plays", |h| {
        window(h).session().status().is_some_and(|s| s.plays_signal && s.peak > 0.01)
    });
    wait(&mut harness, "it can be stopped", |h| h.query_by_label(strings::STOP_TONE).is_some());
    click(&mut harness, strings::STOP_TONE);
    wait(&mut harness, "the tone ends", |h| window(h).session().status().is_some_and(|s| !s.plays_signal));
}

/// How often the window says this.
fn n_said(harness: &Author, words: &str) -> usize {
    shown(harness).iter().filter(|text| text.contains(words)).count()
}

/// What the status bar says is repeated only if it is about the output.
#[test]
fn the_sheet_repeats_no_message_about_anything_else() {
    let mut harness = author();
    harness.event(Event::Cut);
    harness.run_steps(3);
    let in_bar = n_said(&harness, clipboard::CANNOT_CUT);
    assert!(in_bar > 0);
    click(&mut harness, strings::OPEN);
    wait(&mut harness, "the sheet opens", |h| says(h, strings::TITLE));
    assert_eq!(n_said(&harness, clipboard::CANNOT_CUT), in_bar);
    choose(&mut harness, strings::ACTUATOR, "Haptuator MM1C");
    wait(&mut harness, "the sheet says it, too", |h| {
        window(h).session().output_message().is_some_and(|message| n_said(h, message) > in_bar)
    });
}

/// In a small window, a message takes the place of the figures of the output, and all of it can be read.
#[test]
fn a_message_has_room_in_a_small_window() {
    const LEVEL: &str = "dB re 1 m/s²";
    for (size, has_figures) in [([960.0, 600.0], false), ([1920.0, 1080.0], true)] {
        let mut harness = author_of(begin(new_project()), size);
        harness.run_steps(2);
        assert!(says(&harness, LEVEL), "{size:?}");
        harness.event(Event::Cut);
        harness.run_steps(3);
        assert_eq!(says(&harness, LEVEL), has_figures, "{size:?}");
        let is_whole = |shape: &Shape| match shape {
            Shape::Text(text) => text.galley.text() == clipboard::CANNOT_CUT && !text.galley.elided,
            _ => false,
        };
        assert!(painted(&harness).iter().any(|painted| is_whole(painted.shape)), "{size:?}");
    }
}

#[test]
fn a_profile_that_cannot_be_read_is_said() {
    let mut harness = opened();
    read_profile(&mut harness, "no/such/profile.toml");
    wait(&mut harness, "the error is shown", |h| says(h, "profile no/such/profile.toml cannot be read: "));
    assert!(rig(&harness).actuator().is_none());
}
