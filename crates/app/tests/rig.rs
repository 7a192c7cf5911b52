//! Output, actuator and pen as they were left: they come back with the next window, and what is gone is said.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may stop at what it did not expect")]

mod support;

use std::path::Path;

use egui::Key;
use shagreen_app::Begin;
use shagreen_app::files::Keeping;
use shagreen_app::rig::Rig;
use shagreen_app::session::OutputChoice;
use shagreen_app::strings::{self, devices};
use shagreen_app::window::new_project;
use shagreen_device::output::NULL_ID;
use shagreen_formats::rig_settings::{ActuatorSettings, ProfileSettings, RigSettings};
use shagreen_formats::settings::{Settings, read_settings, write_settings};

use support::{Author, author_of, begin, choose, click, says, wait, window, window_of};

const SIZE: [f32; 2] = [1280.0, 720.0];
/// The silent output, as people choose it.
const SILENT: &str = "No output (silent, real clock)";

/// What a window opens with that keeps its settings in this folder.
fn kept(folder: &Path, output: OutputChoice) -> Begin {
    let keeping = Keeping { recovery: None, settings: Some(folder.join("settings.json")) };
    Begin { keeping, output, ..begin(new_project()) }
}

/// Settings of somebody who has seen the tour.
fn remember(folder: &Path, rig: Option<RigSettings>) {
    let settings = Settings { has_seen_tour: true, rig, ..Settings::default() };
    std::fs::write(folder.join("settings.json"), write_settings(&settings)).unwrap();
}

fn settings(folder: &Path) -> RigSettings {
    read_settings(&std::fs::read(folder.join("settings.json")).unwrap()).rig.unwrap_or_default()
}

fn rig(harness: &Author) -> &Rig {
    window(harness).session().rig()
}

fn message(harness: &Author) -> Option<&str> {
    window(harness).session().output_message()
}

fn null() -> OutputChoice {
    OutputChoice::Id(NULL_ID.to_owned())
}

#[test]
fn what_was_chosen_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    remember(folder.path(), None);
    let mut harness = author_of(kept(folder.path(), null()), SIZE);
    assert_eq!(rig(&harness), &Rig::default(), "nobody has chosen any");
    click(&mut harness, devices::OPEN);
    wait(&mut harness, "the sheet opens", |h| says(h, devices::TITLE));
    choose(&mut harness, devices::BUFFER, &devices::buffer(512, 48_000.0));
    choose(&mut harness, devices::ACTUATOR, "Haptuator Mark II-D");
    wait(&mut harness, "they are taken over", |h| rig(h).buffer_frames == 512 && rig(h).actuator().is_some());
    harness.key_press(Key::Escape);
    harness.run_steps(4);
    wait(&mut harness, "it is remembered", |_| settings(folder.path()).actuator.is_some());
    assert_eq!(settings(folder.path()).output, None, "the output was the command line's");
    wait(&mut harness, "the outputs are known", |h| !window(h).session().outputs().is_empty());
    choose(&mut harness, strings::OUTPUT, SILENT);
    wait(&mut harness, "it is remembered", |_| settings(folder.path()).output.as_deref() == Some(NULL_ID));
    let before = rig(&harness).clone();
    drop(harness);

    let harness = author_of(kept(folder.path(), OutputChoice::SystemDefault), SIZE);
    assert_eq!(rig(&harness), &before);
    let session = window(&harness).session();
    assert_eq!((session.output_id(), session.stream().unwrap().2), (Some(NULL_ID), Some(512)));
    assert_eq!(message(&harness), None, "it is no stand-in for the default");
}

#[test]
fn an_output_that_is_gone_is_said_and_none_is_opened_in_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let gone = RigSettings { output: Some("gone-output".to_owned()), ..RigSettings::default() };
    remember(folder.path(), Some(gone.clone()));
    let mut harness = window_of(kept(folder.path(), OutputChoice::SystemDefault), SIZE);
    wait(&mut harness, "it is said", |h| message(h).is_some_and(|message| message.contains("gone-output")));
    harness.run_steps(3);
    assert!(says(&harness, "gone-output") && says(&harness, strings::NO_OUTPUT));
    let session = window(&harness).session();
    assert!(session.status().is_none() && session.is_output_released());
    assert_eq!(settings(folder.path()), gone, "it may come back");
    wait(&mut harness, "the outputs are known", |h| !window(h).session().outputs().is_empty());
    choose(&mut harness, strings::OUTPUT, SILENT);
    wait(&mut harness, "another is open", |h| window(h).session().status().is_some());
    wait(&mut harness, "it is remembered", |_| settings(folder.path()).output.as_deref() == Some(NULL_ID));
    drop(harness);

    // Who says which output is meant is heard, and remembered by nobody.
    remember(folder.path(), Some(gone.clone()));
    let mut harness = author_of(kept(folder.path(), null()), SIZE);
    harness.run_steps(5);
    assert_eq!((window(&harness).session().output_id(), message(&harness)), (Some(NULL_ID), None));
    assert_eq!(settings(folder.path()), gone);
}

#[test]
fn a_pen_that_is_gone_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let pen = Some("hid:ffff:ffff:gone".to_owned());
    remember(folder.path(), Some(RigSettings { pen, ..RigSettings::default() }));
    let mut harness = author_of(kept(folder.path(), null()), SIZE);
    wait(&mut harness, "it is said", |h| window(h).session().pen_message().is_some());
    harness.run_steps(3);
    let message = window(&harness).session().pen_message().unwrap().to_owned();
    assert!(says(&harness, &message), "{message}");
}

/// What would be driven in the place of an actuator has other limits.
#[test]
fn without_its_actuator_no_output_is_opened() {
    let folder = tempfile::tempdir().unwrap();
    let profile = ProfileSettings::BuiltIn("gone".to_owned());
    let actuator = Some(ActuatorSettings { profile, load_g: None });
    remember(folder.path(), Some(RigSettings { actuator, ..RigSettings::default() }));
    for output in [OutputChoice::SystemDefault, null()] {
        let mut harness = window_of(kept(folder.path(), output), SIZE);
        harness.run_steps(10);
        assert!(says(&harness, "the actuator of last time"), "{:?}", message(&harness));
        assert!(window(&harness).session().is_output_released());
    }
}
