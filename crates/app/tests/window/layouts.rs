//! Layout of every view at the supported sizes and scales: no label is cut off, shortened without need, or covered by
//! another one. The layout does not depend on the theme, so one theme suffices.
//!
//! One window goes through all views and takes every size in each of them: to reach a view takes much longer than to lay it
//! out. Windows that open at each size are tested in five views: the sheet at the start and every workspace.

mod texts;

use std::collections::BTreeSet;
use std::path::Path;

use egui::{Align2, Color32, FontId, Label, Popup, Rect, ScrollArea, TextEdit, ViewportId, pos2, vec2};
use egui_kittest::Harness;
use shagreen_app::choices::signals::Slot;
use shagreen_app::command::Command;
use shagreen_app::workspace::Workspace;
use shagreen_studio::project::new_project;

use self::texts::{Fault, Problem, faults};
use crate::support::{Author, SILENT, author_at, begin, wait_for_field, window};
use crate::views::{Kind, SIZES, carry_out, each_view, points, with_leftover};

/// Size in pixels of the window in which the views are reached, at a scale of 1.
const OPENED: [f32; 2] = [1280.0, 720.0];
/// Number of frames after which a window has settled at another size: widths of groups and places of names follow those of
/// the frame before.
const SETTLING: usize = 6;

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

/// Faults of views, one a line. A fault that several views share at a size is listed for the first.
#[derive(Default)]
struct Found {
    known: BTreeSet<String>,
    lines: Vec<String>,
}

impl Found {
    /// Adds the faults of the view on the screen, at one of [`SIZES`].
    fn look(&mut self, harness: &Author, view: &str, (pixels, scale): ([f32; 2], f32)) {
        let names = names(harness);
        let at = format!("{}x{} at {scale}", pixels[0], pixels[1]);
        for fault in faults(harness, &|text| may_be_shortened(text, &names)) {
            let is_smallest = pixels == SIZES[0].0;
            let is_known = CROWDED.contains(&fault.text.as_str()) || covers_a_crowded_one(&fault);
            // Names of textures that lie close together touch on a small canvas.
            let is_name_over_name = matches!(&fault.problem, Problem::Over(other) if names.contains(other))
                && names.contains(&fault.text);
            if is_smallest && (is_known || is_name_over_name) {
                continue;
            }
            if self.known.insert(format!("{at}: {fault}")) {
                self.lines.push(format!("{view}, {at}: {fault}"));
            }
        }
    }

    fn assert_none(&self) {
        assert!(self.lines.is_empty(), "{} faults:\n{}", self.lines.len(), self.lines.join("\n"));
    }
}

/// Gives the window another size and scale, and shows frames until it has settled.
fn resize(harness: &mut Author, pixels: [f32; 2], scale: f32) {
    harness.set_size(points(pixels, scale).into());
    let viewport = harness.input_mut().viewports.get_mut(&ViewportId::ROOT).expect("the window");
    viewport.native_pixels_per_point = Some(scale);
    harness.run_steps(SETTLING);
}

#[test]
fn nothing_is_cut_off_in_any_view_at_any_size() {
    let folder = tempfile::tempdir().unwrap();
    let mut found = Found::default();
    let mut harness = author_at(begin(new_project()), OPENED, 1.0);
    each_view(&mut harness, folder.path(), &mut |harness, view, kind| {
        let has_menu = kind == Kind::Menu && Popup::is_any_open(&harness.ctx);
        for (pixels, scale) in SIZES {
            resize(harness, pixels, scale);
            assert!(!has_menu || Popup::is_any_open(&harness.ctx), "{view} stays open");
            found.look(harness, view, (pixels, scale));
        }
        resize(harness, OPENED, 1.0);
    });
    found.assert_none();
}

/// A window that opens at a size lays itself out as one that gets it later.
#[test]
fn nothing_is_cut_off_in_a_window_that_opens_at_any_size() {
    let mut found = Found::default();
    for (pixels, scale) in SIZES {
        let folder = tempfile::tempdir().unwrap();
        let mut harness = author_at(with_leftover(folder.path()), points(pixels, scale), scale);
        // Until the field is there, the panels below the sheet still change.
        wait_for_field(&mut harness);
        harness.run_steps(4);
        found.look(&harness, "sheet unsaved work", (pixels, scale));
        carry_out(&mut harness, Command::CloseSheet);
        for workspace in Workspace::ALL {
            carry_out(&mut harness, Command::Show(workspace));
            harness.run_steps(SETTLING);
            found.look(&harness, &format!("{workspace:?}, just opened"), (pixels, scale));
        }
    }
    found.assert_none();
}

/// Otherwise all views would be looked at in one size.
#[test]
fn a_window_takes_the_size_that_it_is_given() {
    let mut harness = author_at(begin(new_project()), OPENED, 1.0);
    resize(&mut harness, [1920.0, 1080.0], 1.5);
    assert_eq!(harness.ctx.content_rect().size(), vec2(1280.0, 720.0));
    assert_eq!((harness.ctx.pixels_per_point(), harness.ctx.zoom_factor()), (1.5, 1.0));
    resize(&mut harness, [960.0, 600.0], 1.0);
    assert_eq!(harness.ctx.content_rect().size(), vec2(960.0, 600.0));
    assert_eq!(harness.ctx.pixels_per_point(), 1.0);
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
