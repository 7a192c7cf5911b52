//! The scope: selecting views, freezing, measuring and saving.

use std::path::Path;

use egui::accesskit::Role;
use egui::{Key, lerp, pos2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::choices::scope::View;
use shagreen_app::strings::{self, build, import, scope};
use shagreen_formats::thresholds::ThresholdKind;

use crate::support::{
    self, Author, author, choose, click, drag, enter_path, painted, says, unnamed_controls, wait, window,
    words,
};

/// Window with a running automatic stroke and some seconds of output signal.
fn stroking() -> Author {
    let mut harness = author();
    click(&mut harness, strings::HAND_START);
    wait(&mut harness, "it sounds", |h| window(h).session().scope().rms(0.3) > 1e-3);
    wait(&mut harness, "it has sounded", |h| window(h).session().scope().moments().len() > 20);
    harness
}

/// Shapes drawn in a view, as text.
fn lines(harness: &Author, view: View) -> Vec<String> {
    painted(harness, scope::view(view)).iter().map(|shape| format!("{shape:?}")).collect()
}

#[test]
fn every_view_is_shown_on_either_side() {
    let mut harness = stroking();
    for side in 0..2 {
        for view in View::ALL {
            choose(&mut harness, scope::VIEWS[side], scope::view(view));
            harness.run_steps(2);
            let canvases = harness.get_all_by_role_and_label(Role::Canvas, scope::view(view));
            assert!(canvases.count() >= 1, "{view:?}");
            assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
        }
    }
}

#[test]
fn what_is_held_stays_and_sounds_on() {
    let mut harness = stroking();
    click(&mut harness, scope::FREEZE);
    harness.run_steps(2);
    let held = lines(&harness, View::Waveform);
    assert!(!held.is_empty());
    let before = window(&harness).session().scope().newest(0.25);
    wait(&mut harness, "it sounds on", |h| window(h).session().scope().newest(0.25) != before);
    assert_eq!(lines(&harness, View::Waveform), held);
    harness.key_press(Key::F);
    harness.run_steps(3);
    assert_ne!(lines(&harness, View::Waveform), held, "it runs again");
}

/// The plot is 250 ms wide.
#[test]
fn a_drag_measures_and_a_click_ends_that() {
    let mut harness = stroking();
    click(&mut harness, scope::FREEZE);
    let area = harness.get_by_role_and_label(Role::Canvas, scope::view(View::Waveform)).rect();
    let at = |share: f32| pos2(lerp(area.left()..=area.right(), share), area.center().y);
    drag(&mut harness, at(0.4), at(0.8));
    assert!(says(&harness, "100.0 ms = 10.0 Hz"), "{:?}", support::shown(&harness));
    harness.hover_at(at(0.5));
    harness.drag_at(at(0.5));
    harness.run_steps(1);
    harness.drop_at(at(0.5));
    harness.run_steps(2);
    assert!(!says(&harness, "100.0 ms = 10.0 Hz"));
    // Pointing at the plot shows time and value.
    harness.hover_at(at(0.5));
    harness.run_steps(2);
    let read: Vec<String> = painted(&harness, scope::view(View::Waveform)).iter().filter_map(words).collect();
    assert!(read.iter().any(|text| text == "-125.0 ms"), "{read:?}");
    assert!(read.iter().any(|text| text.starts_with(scope::PLAYED)), "{read:?}");
}

/// Saves the right view to `path` in this format.
fn save(harness: &mut Author, format: &str, path: &Path) {
    harness.get_by_label(scope::SAVES[1]).click();
    harness.run_steps(3);
    click(harness, format);
    harness.run_steps(4);
    let field = harness.get_by_role_and_label(Role::TextInput, build::SAVE_PATH);
    assert!(field.accesskit_node().value().unwrap().ends_with(&format!(".{}", format.to_lowercase())));
    enter_path(harness, build::SAVE_PATH, path);
    let saved = import::saved(&path.display().to_string());
    wait(harness, "it is saved", |h| h.query_by_label(&saved).is_some());
    click(harness, import::CLOSE);
    harness.run_steps(2);
}

/// Detection threshold at the lowest frequency, from the saved numbers.
fn threshold_db(path: &Path) -> f64 {
    let csv = std::fs::read_to_string(path).unwrap();
    let line = csv.lines().find(|line| line.starts_with(scope::THRESHOLD_LINE)).unwrap();
    line.split(',').nth(3).unwrap().parse().unwrap()
}

#[test]
fn a_view_is_saved_as_picture_and_numbers_against_the_chosen_threshold() {
    let mut harness = stroking();
    let folder = tempfile::tempdir().unwrap();
    let [svg, png, held, skin] =
        ["s.svg", "s.png", "held.csv", "skin.csv"].map(|name| folder.path().join(name));
    save(&mut harness, "SVG", &svg);
    assert!(std::fs::read_to_string(&svg).unwrap().contains("Spectrum of "));
    save(&mut harness, "PNG", &png);
    assert!(std::fs::read(&png).unwrap().starts_with(b"\x89PNG"));
    save(&mut harness, "CSV", &held);
    click(&mut harness, scope::THRESHOLD);
    harness.run_steps(3);
    click(&mut harness, scope::threshold(ThresholdKind::Pacinian));
    harness.run_steps(2);
    save(&mut harness, "CSV", &skin);
    assert!((threshold_db(&skin) - threshold_db(&held) - 15.0).abs() < 1e-6);
}
