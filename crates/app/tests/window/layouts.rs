//! Layout of every view at the supported sizes and scales: no label is cut off, shortened without need, or covered by
//! another one. The layout does not depend on the theme, so one theme suffices.

mod texts;

use std::collections::BTreeSet;
use std::path::Path;

use egui::{Align2, Color32, FontId, Label, Rect, ScrollArea, TextEdit, pos2, vec2};
use egui_kittest::Harness;
use shagreen_app::choices::signals::Slot;
use shagreen_studio::project::new_project;

use self::texts::{Fault, Problem, faults};
use crate::support::{Author, SILENT, author_at, begin, wait_for_field, window};
use crate::views::{each_view, with_leftover};

/// Pixels per point of usual screens.
const SCALES: [f32; 3] = [1.0, 1.5, 2.0];
/// Minimum size of the window, in points. A screen that is smaller at a scale is not tested at that scale.
const LEAST_SIZE: [f32; 2] = [960.0, 600.0];

/// Known faults in the smallest window: three figures beside each other need more width than it has, and one long title
/// and one unit are shortened.
const CROWDED: [&str; 9] = [
    "Fidelity (from these signals)",
    "waveform",
    "window width in mm",
    "correlation (A, B: envelope)",
    "spatial frequency in 1/mm",
    "Predicted d' by codec bit rate (model prediction, not rated by people)",
    "dB re 1 (m/s²)²/Hz",
    "segment 1 of 18",
    "sample rate",
];

/// Texts of the user or the system, of any length: a label may shorten those that contain one. Paths may be shortened
/// too.
fn names(harness: &Author) -> Vec<String> {
    let window = window(harness);
    let mut names = vec![SILENT.to_owned(), window.document().name()];
    names.extend(window.session().textures().iter().map(|texture| texture.name.clone()));
    names.extend(window.session().textures().iter().map(|texture| texture.tags.join(", ")));
    names.extend(window.project().authored.iter().map(|texture| texture.name.clone()));
    // The status bar shows the complete message under the pointer.
    names.extend(window.session().messages().map(str::to_owned));
    names.extend(Slot::ALL.iter().filter_map(|slot| window.signals().signal(*slot)).map(|s| s.name.clone()));
    names
}

fn may_be_shortened(text: &str, names: &[String]) -> bool {
    Path::new(text).is_absolute() || names.iter().any(|name| !name.is_empty() && text.contains(name))
}

fn covers_a_crowded_one(fault: &Fault) -> bool {
    matches!(&fault.problem, Problem::Over(other) if CROWDED.contains(&other.as_str()))
}

/// Faults of all views in a window with this number of pixels, one a line. A fault that several views share is listed
/// for the first.
fn faults_at(pixels: [f32; 2]) -> Vec<String> {
    let mut found = Vec::new();
    for scale in SCALES {
        let size = pixels.map(|length| (length / scale).floor());
        if size[0] < LEAST_SIZE[0] || size[1] < LEAST_SIZE[1] {
            continue;
        }
        let folder = tempfile::tempdir().unwrap();
        let mut known = BTreeSet::new();
        let mut look = |harness: &mut Author, view: &str| {
            let names = names(harness);
            for fault in faults(harness, &|text| may_be_shortened(text, &names)) {
                let is_smallest = size[0] <= LEAST_SIZE[0];
                let is_known = CROWDED.contains(&fault.text.as_str()) || covers_a_crowded_one(&fault);
                // Names of textures that lie close together touch on a small canvas.
                let is_name_over_name = matches!(&fault.problem, Problem::Over(other) if names.contains(other))
                    && names.contains(&fault.text);
                if is_smallest && (is_known || is_name_over_name) {
                    continue;
                }
                let fault = fault.to_string();
                if known.insert(fault.clone()) {
                    found.push(format!("{view}, {}x{} at {scale}: {fault}", pixels[0], pixels[1]));
                }
            }
        };
        let mut harness = author_at(begin(new_project()), size, scale);
        each_view(&mut harness, folder.path(), &mut |harness, view, _| look(harness, view));
        drop(harness);
        let mut harness = author_at(with_leftover(folder.path()), size, scale);
        // Until the field is there, the panels below the sheet still change.
        wait_for_field(&mut harness);
        harness.run_steps(4);
        look(&mut harness, "sheet unsaved work");
    }
    found
}

fn check(pixels: [f32; 2]) {
    let found = faults_at(pixels);
    assert!(found.is_empty(), "{} faults:\n{}", found.len(), found.join("\n"));
}

#[test]
fn nothing_is_cut_off_at_the_smallest_size() {
    check(LEAST_SIZE);
}

#[test]
fn nothing_is_cut_off_at_1280_by_720() {
    check([1280.0, 720.0]);
}

#[test]
fn nothing_is_cut_off_at_1920_by_1080() {
    check([1920.0, 1080.0]);
}

#[test]
fn nothing_is_cut_off_at_2560_by_1440() {
    check([2560.0, 1440.0]);
}

/// Negative control: labels that are cut off, shortened, or on each other are found, and so is a button outside the
/// window.
#[test]
fn bad_labels_are_found() {
    let mut harness = Harness::builder().with_size([300.0, 300.0]).build_ui(|ui| {
        let font = || FontId::proportional(14.0);
        let painter = ui.painter();
        let write = |painter: &egui::Painter, at, text: &str| {
            painter.text(at, Align2::LEFT_TOP, text, font(), Color32::WHITE);
        };
        let narrow = Rect::from_min_size(pos2(10.0, 100.0), vec2(40.0, 30.0));
        write(&painter.with_clip_rect(narrow), narrow.min, "too wide for its area");
        let low = Rect::from_min_size(pos2(10.0, 140.0), vec2(200.0, 7.0));
        write(&painter.with_clip_rect(low), low.min, "too high");
        write(painter, pos2(10.0, 180.0), "first label");
        write(painter, pos2(20.0, 184.0), "second label");
        ui.scope(|ui| {
            ui.set_max_width(60.0);
            ui.add(Label::new("a label that is shortened").truncate());
            ui.add(Label::new("a name that is shortened").truncate());
        });
        let outside = Rect::from_min_size(pos2(280.0, 220.0), vec2(60.0, 24.0));
        ui.put(outside, egui::Button::new("B").min_size(outside.size()));
    });
    harness.run_steps(2);
    let found = faults(&harness, &|text| text.contains("name"));
    let of = |text: &str| -> Vec<Problem> {
        found.iter().filter(|fault| fault.text == text).map(|fault| fault.problem.clone()).collect()
    };
    assert_eq!(of("too wide for its area"), [Problem::CutOff]);
    assert_eq!(of("too high"), [Problem::CutOff]);
    assert_eq!(of("a label that is shortened"), [Problem::Shortened]);
    assert_eq!(of("a name that is shortened"), Vec::<Problem>::new());
    assert_eq!(of("second label"), [Problem::Over("first label".to_owned())]);
    assert_eq!(of("B").last(), Some(&Problem::OutsideWindow));
}

/// Positive control: what scrolls may be cut off in that direction, and what lies on an opaque area hides what is
/// below.
#[test]
fn good_labels_are_not_found() {
    let mut text = "a text in a field that is longer than the field shows".to_owned();
    let mut harness = Harness::builder().with_size([300.0, 300.0]).build_ui(move |ui| {
        let field = ui.label("Name");
        ui.add(TextEdit::singleline(&mut text).desired_width(80.0)).labelled_by(field.id);
        ScrollArea::vertical().max_height(95.0).auto_shrink(false).show(ui, |ui| {
            for i in 0..30 {
                ui.label(format!("row {i}"));
            }
        });
        let painter = ui.painter();
        let write = |at, text: &str| {
            painter.text(at, Align2::LEFT_TOP, text, FontId::proportional(14.0), Color32::WHITE);
        };
        write(pos2(20.0, 200.0), "below");
        painter.rect_filled(
            Rect::from_min_size(pos2(10.0, 190.0), vec2(100.0, 40.0)),
            0.0,
            Color32::DARK_BLUE,
        );
        write(pos2(22.0, 202.0), "above");
    });
    harness.run_steps(4);
    let found: Vec<String> = faults(&harness, &|_| false).iter().map(ToString::to_string).collect();
    assert_eq!(found, Vec::<String>::new());
}
