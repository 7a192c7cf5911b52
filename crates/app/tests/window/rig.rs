//! Output, actuator and pen are restored in the next window, and unavailable devices are reported.

use std::path::Path;

use egui::Key;
use shagreen_app::Begin;
use shagreen_app::session::OutputChoice;
use shagreen_app::state::files::StoragePaths;
use shagreen_app::state::rig::Rig;
use shagreen_app::strings::{self, devices};
use shagreen_device::output::NULL_ID;
use shagreen_formats::rig_settings::{ActuatorSettings, ProfileSettings, RigSettings};
use shagreen_formats::settings::{Settings, read_settings, write_settings};
use shagreen_studio::project::new_project;

use crate::support::{Author, SILENT, author_of, begin, choose, click, says, wait, window, window_of};

const SIZE: [f32; 2] = [1280.0, 720.0];

/// Initial content of a window that stores its settings in this folder.
fn kept(folder: &Path, output: OutputChoice) -> Begin {
    let keeping = StoragePaths { settings: Some(folder.join("settings.json")), ..StoragePaths::default() };
    Begin { keeping, output, ..begin(new_project()) }
}

/// Writes settings in which the tour has been seen.
fn remember(folder: &Path, rig: Option<RigSettings>) {
    let settings = Settings { has_seen_tour: true, rig, ..Settings::default() };
    std::fs::write(folder.join("settings.json"), write_settings(&settings)).unwrap();
}

fn settings(folder: &Path) -> RigSettings {
    read_settings(&std::fs::read(folder.join("settings.json")).unwrap()).0.rig.unwrap_or_default()
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
    wait(&mut harness, "the pen is remembered", |_| settings(folder.path()).pressure.is_some());
    let left = settings(folder.path());
    let of_output = (left.output, left.buffer_frames, left.actuator);
    assert_eq!(of_output, (None, None, None), "the output was the command line's");
    wait(&mut harness, "the outputs are known", |h| !window(h).session().outputs().is_empty());
    choose(&mut harness, strings::OUTPUT, SILENT);
    wait(&mut harness, "it is remembered", |_| settings(folder.path()).output.as_deref() == Some(NULL_ID));
    assert!(settings(folder.path()).actuator.is_some(), "with what hangs on it");
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

    // An output given at program start is used but not stored.
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

/// The device setup for an output that was given at program start is not stored for another output.
#[test]
fn the_rig_of_one_output_is_not_remembered_for_another() {
    let folder = tempfile::tempdir().unwrap();
    let output = Some("gone-output".to_owned());
    let gone = RigSettings { output, buffer_frames: Some(128), ..RigSettings::default() };
    remember(folder.path(), Some(gone.clone()));
    let mut harness = author_of(kept(folder.path(), null()), SIZE);
    in_devices(&mut harness, devices::BUFFER, &devices::buffer(512, 48_000.0));
    in_devices(&mut harness, devices::ACTUATOR, "Haptuator Mark II-D");
    assert!(rig(&harness).buffer_frames == 512 && rig(&harness).actuator().is_some());
    wait(&mut harness, "the pen is remembered", |_| settings(folder.path()).pressure.is_some());
    harness.run_steps(5);
    // The pen does not belong to an output.
    let left = settings(folder.path());
    assert_eq!(RigSettings { pressure: None, pen: None, ..left }, gone);
}

/// Selects an option in the devices sheet.
fn in_devices(harness: &mut Author, name: &str, choice: &str) {
    click(harness, devices::OPEN);
    wait(harness, "the sheet opens", |h| says(h, devices::ACTUATOR));
    choose(harness, name, choice);
    harness.run_steps(3);
    harness.key_press(Key::Escape);
    wait(harness, "the sheet closes", |h| !says(h, devices::ACTUATOR));
    harness.run_steps(2);
}

fn is_refused(harness: &Author, words: &str) -> bool {
    let session = window(harness).session();
    session.is_output_released() && session.status().is_none() && says(harness, words)
}

/// Another actuator would have other limits. Until the user selects an actuator or none, nothing is driven, and the
/// stored one is kept.
#[test]
fn without_its_actuator_no_output_is_opened() {
    const WORDS: &str = "the last used actuator is unavailable";
    let folder = tempfile::tempdir().unwrap();
    let profile = ProfileSettings::BuiltIn("gone".to_owned());
    let actuator = Some(ActuatorSettings { profile, load_g: None });
    let pen = Some("hid:ffff:ffff:gone".to_owned());
    for (output, left) in [(OutputChoice::SystemDefault, Some(NULL_ID.to_owned())), (null(), None)] {
        let left = RigSettings {
            output: left,
            actuator: actuator.clone(),
            full_scale_volts: Some(2.0),
            pen: pen.clone(),
            ..RigSettings::default()
        };
        remember(folder.path(), Some(left.clone()));
        let mut harness = window_of(kept(folder.path(), output), SIZE);
        harness.run_steps(10);
        assert!(is_refused(&harness, WORDS), "{:?}", message(&harness));
        wait(&mut harness, "the pen is asked for", |h| window(h).session().pen_message().is_some());

        in_devices(&mut harness, devices::BUFFER, &devices::buffer(512, 48_000.0));
        wait(&mut harness, "it is remembered", |_| settings(folder.path()).pressure.is_some());
        let again = settings(folder.path());
        let kept = |rig: RigSettings| (rig.output, rig.actuator, rig.full_scale_volts, rig.pen);
        assert_eq!(kept(again), kept(left));
        wait(&mut harness, "the outputs are known", |h| !window(h).session().outputs().is_empty());
        choose(&mut harness, strings::OUTPUT, SILENT);
        harness.run_steps(10);
        assert!(is_refused(&harness, WORDS), "{:?}", message(&harness));

        in_devices(&mut harness, devices::ACTUATOR, devices::UNCALIBRATED);
        wait(&mut harness, "it opens", |h| window(h).session().status().is_some());
        wait(&mut harness, "it is remembered", |_| settings(folder.path()).actuator.is_none());
        assert_eq!(settings(folder.path()).pen, pen);
    }
}

/// An unreadable device setup is not treated as a first start: nothing is driven, and the file is not overwritten until
/// the user selects an output.
#[test]
fn settings_that_cannot_be_read_open_no_output_and_stay() {
    for text in [r#"{"has_seen_tour": true, "rig": {"output": "null", "channel": -1}}"#, "{\"recent\": []"] {
        for output in [OutputChoice::SystemDefault, null()] {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("settings.json");
            std::fs::write(&path, text).unwrap();
            let mut harness = window_of(kept(folder.path(), output), SIZE);
            harness.ctx.set_zoom_factor(1.25);
            for _ in 0..10 {
                harness.run_steps(1);
                std::thread::sleep(std::time::Duration::from_millis(10));
            }
            assert!(is_refused(&harness, "No output was opened"), "{:?}", message(&harness));
            assert!(says(&harness, &path.display().to_string()) && says(&harness, devices::OPEN));
            assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
            wait(&mut harness, "the outputs are known", |h| !window(h).session().outputs().is_empty());
            // The tour begins if the settings do not say that it was seen.
            harness.key_press(Key::Escape);
            harness.run_steps(2);
            choose(&mut harness, strings::OUTPUT, SILENT);
            wait(&mut harness, "it opens", |h| window(h).session().status().is_some());
            wait(&mut harness, "it is remembered", |_| {
                read_settings(&std::fs::read(&path).unwrap())
                    .0
                    .rig
                    .is_some_and(|rig| rig.output.as_deref() == Some(NULL_ID))
            });
        }
    }
}
