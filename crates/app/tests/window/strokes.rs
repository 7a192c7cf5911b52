//! Stroke recordings: recording with the mouse, repeating, saving and opening.

use std::time::Duration;

use egui::accesskit::Role;
use egui::{Key, ViewportId, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::Begin;
use shagreen_app::session::OutputChoice;
use shagreen_app::state::recorded_stroke::RecordedStroke;
use shagreen_app::strings::{self, stroke};
use shagreen_device::touch::Touch;
use shagreen_formats::stroke::{PressUnit, Stroke};
use shagreen_formats::stroke_csv::read_stroke_csv;
use shagreen_studio::project::new_project;

use crate::support::{
    Author, SILENT, author, author_of, begin, choose, click, drop_files, enter_path, says, unnamed_controls,
    wait, wait_for_field, window, window_of,
};

/// Strokes to the right on the pad for about half a second.
fn stroke_pad(harness: &mut Author) {
    let middle = harness.get_by_role_and_label(Role::Canvas, strings::PAD).rect().center();
    let from = middle - vec2(90.0, 0.0);
    harness.hover_at(from);
    harness.run_steps(2);
    harness.drag_at(from);
    harness.run_steps(1);
    for i in 1..=36 {
        harness.hover_at(from + vec2(5.0 * i as f32, 0.0));
        harness.step();
        std::thread::sleep(Duration::from_millis(15));
    }
    harness.drop_at(from + vec2(180.0, 0.0));
    harness.run_steps(2);
}

/// Window with a stroke recording.
fn recorded() -> Author {
    let mut harness = author();
    click(&mut harness, stroke::RECORD);
    stroke_pad(&mut harness);
    click(&mut harness, stroke::FINISH);
    harness.run_steps(2);
    harness
}

fn session_stroke(harness: &Author) -> &RecordedStroke {
    window(harness).session().stroke().expect("a stroke")
}

fn touch(harness: &Author) -> Touch {
    window(harness).session().touch()
}

#[test]
fn a_stroke_is_recorded_and_repeated_until_a_person_strokes() {
    let mut harness = author();
    assert!(harness.query_by_role_and_label(Role::SpinButton, stroke::TEMPO).is_none());
    click(&mut harness, stroke::RECORD);
    harness.run_steps(2);
    assert!(window(&harness).session().recording().is_some_and(|(samples, secs)| {
        // Time before the first touch is not recorded.
        samples.is_empty() && secs.is_none()
    }));
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    stroke_pad(&mut harness);
    click(&mut harness, stroke::FINISH);
    harness.run_steps(2);
    assert!(window(&harness).session().recording().is_none());
    let recorded = session_stroke(&harness).clone();
    let (samples, secs) = (recorded.samples(), recorded.track().duration_secs());
    assert!(!samples[0].touching && samples[0].time_secs == 0.0 && secs > 0.5, "{secs} s");
    assert!(samples[1].touching && samples[1].time_secs < 0.02, "it lands at once");
    let n_lifted = samples.iter().filter(|sample| !sample.touching).count();
    assert_eq!(n_lifted, 2, "before its landing and at its end");
    // 180 points correspond to 60 mm.
    let way_m = samples[samples.len() - 1].x_m - samples[0].x_m;
    assert!((way_m - 0.06).abs() < 0.003, "{way_m} m");

    // The recording is selected at once, and the numbers scale its tempo and force.
    assert!(says(&harness, stroke::RECORDED));
    for name in [stroke::TEMPO, stroke::FORCE] {
        let percent = harness.get_by_role_and_label(Role::SpinButton, name);
        assert_eq!(percent.accesskit_node().numeric_value(), Some(100.0));
    }
    assert!(harness.query_by_role_and_label(Role::SpinButton, strings::HAND_SPEED).is_none());
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, strings::HAND_START);
    wait(&mut harness, "it sounds", |h| window(h).session().scope().rms(0.3) > 0.01);
    for _ in 0..2 {
        wait(&mut harness, "it presses as it did", |h| {
            touch(h).contact.force_n > 0.0 && (touch(h).contact.force_n - 0.8).abs() < 0.01
        });
        wait(&mut harness, "it lifts before it begins again", |h| touch(h).contact.force_n == 0.0);
    }
    harness.get_by_role_and_label(Role::SpinButton, stroke::FORCE).set_value_accesskit(50.0);
    wait(&mut harness, "it presses half as hard", |h| (touch(h).contact.force_n - 0.4).abs() < 0.01);

    // A person takes over, and the automatic stroke continues afterwards.
    let middle = harness.get_by_role_and_label(Role::Canvas, strings::PAD).rect().center();
    harness.hover_at(middle);
    harness.run_steps(2);
    harness.drag_at(middle);
    wait(&mut harness, "the person strokes", |h| window(h).session().status().unwrap().follows_live);
    harness.drop_at(middle);
    wait(&mut harness, "the hand goes on", |h| !window(h).session().status().unwrap().follows_live);
    click(&mut harness, strings::HAND_STOP);
    wait(&mut harness, "it stops", |h| touch(h).contact.force_n == 0.0);
    assert!(!window(&harness).session().hand_is_running());

    // Selecting another path gives an ordinary automatic stroke.
    choose(&mut harness, strings::HAND_PATH, strings::CIRCLE);
    assert!(harness.query_by_role_and_label(Role::SpinButton, strings::HAND_SPEED).is_some());
}

#[test]
fn a_repeated_stroke_survives_that_the_output_is_opened_again() {
    let mut harness = recorded();
    click(&mut harness, strings::HAND_START);
    let n_frames = |h: &Author| window(h).session().status().map_or(0, |status| status.frames_played);
    wait(&mut harness, "it strokes for a while", |h| n_frames(h) > 96_000 && touch(h).contact.force_n > 0.0);
    choose(&mut harness, strings::OUTPUT, SILENT);
    wait(&mut harness, "the output is another", |h| n_frames(h) < 96_000);
    wait(&mut harness, "it strokes again", |h| touch(h).contact.force_n > 0.0);
}

#[test]
fn a_stroke_is_saved_and_read_again_where_it_is_dropped_or_opened() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("walk.csv");
    let mut harness = recorded();
    let first = session_stroke(&harness).clone();
    choose(&mut harness, strings::HAND_PATH, stroke::SAVE);
    assert!(says(&harness, stroke::SAVE_TITLE));
    enter_path(&mut harness, stroke::SAVE_PATH, &path);
    let saved = strings::import::saved(&path.display().to_string());
    wait(&mut harness, "it is saved", |h| says(h, &saved));
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    let bytes = std::fs::read(&path).unwrap();
    assert_eq!(bytes, first.csv());
    // `shagreen render --stroke` reads the same file.
    let imported = read_stroke_csv(&bytes).unwrap();
    assert_eq!(imported.warnings, Vec::<String>::new());
    let Stroke::Pen { samples, press_unit: PressUnit::Newtons } = imported.value else { panic!("a pen") };
    assert_eq!(samples.len(), first.samples().len());

    // A new recording replaces the stroke; a recording without a touch does not.
    click(&mut harness, stroke::RECORD);
    stroke_pad(&mut harness);
    click(&mut harness, stroke::FINISH);
    assert_eq!(window(&harness).session().n_strokes(), 2);
    harness.run_steps(2);
    assert!(says(&harness, stroke::REPLACED));
    click(&mut harness, stroke::RECORD);
    harness.run_steps(2);
    assert!(!says(&harness, stroke::REPLACED), "that is over");
    click(&mut harness, stroke::FINISH);
    assert_eq!(window(&harness).session().n_strokes(), 2);

    // The header identifies a stroke, whatever the file name.
    drop_files(&mut harness, &[("notes.txt", &bytes)]);
    wait(&mut harness, "it is read", |h| window(h).session().n_strokes() == 3);
    assert_eq!(session_stroke(&harness).samples().len(), first.samples().len());
    assert!(window(&harness).import().is_none(), "it is no recording to be imported");

    choose(&mut harness, strings::HAND_PATH, stroke::OPEN);
    assert!(says(&harness, stroke::OPEN_TITLE));
    std::fs::write(folder.path().join("other.csv"), "a,b\n1,2\n").unwrap();
    enter_path(&mut harness, strings::document::OPEN_PATH, &folder.path().join("other.csv"));
    wait(&mut harness, "it is refused", |h| says(h, "other.csv: "));
    enter_path(&mut harness, strings::document::OPEN_PATH, &path);
    wait(&mut harness, "it is read", |h| window(h).session().n_strokes() == 4);
    harness.run_steps(2);
    assert!(!says(&harness, stroke::OPEN_TITLE), "the sheet is closed");
}

/// Only one stroke is repeated, and a message names the others.
#[test]
fn of_several_strokes_that_are_dropped_one_is_repeated() {
    let mut harness = author();
    let table = b"t_s,x_mm,y_mm,force_n\n0,0,0,1\n1,20,0,1\n";
    let lifted = b"t_s,x_mm,y_mm,force_n,touching\n0,0,0,1,0\n1,20,0,1,0\n";
    for (first, n_strokes, said) in [
        (&table[..], 1, [""; 2]),
        (&table[..], 2, [stroke::REPLACED, ""]),
        (&lifted[..], 2, [stroke::NEVER_TOUCHES, "a.csv: "]),
    ] {
        drop_files(&mut harness, &[("a.csv", first), ("b.csv", table), ("c.csv", table)]);
        wait(&mut harness, "the others are named", |h| says(h, "a.csv was read and not b.csv, c.csv"));
        wait(&mut harness, "the outcome is said", |h| said.iter().all(|words| says(h, words)));
        assert_eq!(window(&harness).session().n_strokes(), n_strokes);
    }
}

/// Negative control: a table with acceleration is still imported.
#[test]
fn a_recording_that_is_dropped_is_imported() {
    let mut harness = author();
    let row = |i: u32| format!("{},{},80,1\n", f64::from(i) * 1e-3, i % 7);
    let mut table = "time_s,acc,speed_mm/s,force_N\n".to_owned();
    table.extend((0..2000).map(row));
    drop_files(&mut harness, &[("felt.csv", table.as_bytes())]);
    wait(&mut harness, "it is imported", |h| window(h).import().is_some());
    assert_eq!(window(&harness).session().n_strokes(), 0);
}

#[test]
fn the_row_above_the_pad_is_not_cut_off() {
    for size in [[1280.0, 720.0], [960.0, 600.0]] {
        let mut harness = author_of(begin(new_project()), size);
        for recorded in [false, true] {
            if recorded {
                let table = b"t_s,x_mm,y_mm,force_n\n0,0,0,1\n1,20,0,1\n";
                drop_files(&mut harness, &[("walk.csv", table)]);
                wait(&mut harness, "it is read", |h| window(h).session().n_strokes() == 1);
                harness.run_steps(3);
            }
            let pad = harness.get_by_role_and_label(Role::Canvas, strings::PAD).rect();
            let in_row = |rect: &egui::Rect| {
                rect.center().y > pad.top() - 34.0 && rect.center().y < pad.top() && rect.left() < pad.right()
            };
            let nodes = harness.root().children_recursive();
            let shown = nodes.filter(|node| node.accesskit_node().bounding_box().is_some());
            let rects: Vec<egui::Rect> = shown.map(|node| node.rect()).filter(in_row).collect();
            assert!(rects.len() >= 5, "{rects:?}");
            for rect in rects {
                assert!(rect.right() <= pad.right() + 0.5, "{rect:?} beyond {pad:?} at {size:?}");
            }
        }
    }
}

/// A press without motion gets frames at once, so that the tip is drawn as soon as the output reports it.
#[test]
fn a_press_that_rests_asks_for_frames() {
    // Without an output no signal keeps the window drawing.
    let output = OutputChoice::Id("none".to_owned());
    let mut harness = window_of(Begin { output, ..begin(new_project()) }, [1280.0, 720.0]);
    wait_for_field(&mut harness);
    let delay = |h: &Author| h.output().viewport_output.get(&ViewportId::ROOT).unwrap().repaint_delay;
    let middle = harness.get_by_role_and_label(Role::Canvas, strings::PAD).rect().center();
    harness.hover_at(middle);
    wait(&mut harness, "the window rests", |h| delay(h) > Duration::ZERO);
    harness.drag_at(middle);
    harness.run_steps(6);
    assert_eq!(delay(&harness), Duration::ZERO);
    harness.drop_at(middle);
    harness.run_steps(2);
}
