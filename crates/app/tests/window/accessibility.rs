//! Accessibility of every view: contrast in both themes, order of the keyboard focus, names of controls.

mod contrast;
mod focus;

use std::collections::BTreeSet;

use egui::{Button, Color32, Context, RichText, Shape, Stroke, Theme, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::NodeT as _;
use shagreen_app::choices::signals::Slot;
use shagreen_app::command::signals::SignalsCommand;
use shagreen_app::command::stroke::StrokeCommand;
use shagreen_app::command::{Command, FileCommand};
use shagreen_app::look::theme::{DARK, LIGHT, install};
use shagreen_app::strings::{document, export, help, import, textures};
use shagreen_studio::export::WAV;
use shagreen_studio::project::new_project;

use self::contrast::{contrast, illegible};
use self::focus::{Stop, focusable, out_of_order, tab_through, unmarked, unnamed};
use crate::frame::painted;
use crate::support::{Author, author_at, begin, wait_for_field, window};
use crate::views::{Kind, carry_out, each_view};

const SIZE: [f32; 2] = [1280.0, 720.0];
/// Least contrast of a control to its surroundings (WCAG 2.1, criterion 1.4.11).
const LEAST_OF_CONTROLS: f64 = 3.0;

/// Controls that the Tab key reaches after a panel whose area theirs overlaps: the second column of a sheet below a row
/// over both, a button under a scrolled list, and buttons below a figure.
const LATE: [&str; 5] = ["Remove sorting", "Save CSV…", "Actuator", "Close", "Name of the imported texture"];

fn opened() -> Author {
    author_at(begin(new_project()), SIZE, 1.0)
}

/// Calls `faults` for every view and returns the faults with the name of the first view that has them.
fn of_all_views(
    harness: &mut Author,
    mut faults: impl FnMut(&mut Author, Kind) -> Vec<String>,
) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    let (mut known, mut found) = (BTreeSet::new(), Vec::new());
    each_view(harness, folder.path(), &mut |harness, view, kind| {
        for fault in faults(harness, kind) {
            if known.insert(fault.clone()) {
                found.push(format!("{view}: {fault}"));
            }
        }
    });
    found
}

fn assert_none(found: &[String]) {
    assert!(found.is_empty(), "{} faults:\n{}", found.len(), found.join("\n"));
}

/// The colors of all texts, on the backgrounds on which they are painted. Each view is looked at in both themes, because to
/// reach it takes much longer than to draw it.
#[test]
fn every_text_is_legible_in_both_themes() {
    let mut harness = opened();
    assert_eq!(harness.ctx.theme(), Theme::Dark);
    let found = of_all_views(&mut harness, |harness, _| {
        let mut faults = Vec::new();
        for theme in [Theme::Light, Theme::Dark] {
            harness.ctx.set_theme(theme);
            harness.run_steps(2);
            let of_theme = illegible(harness);
            faults.extend(of_theme.into_iter().map(|fault| format!("{theme:?}: {fault}")));
        }
        faults
    });
    assert_none(&found);
}

/// Negative control: another theme has other colors from the next frame on.
#[test]
fn both_themes_are_looked_at() {
    let mut harness = opened();
    let panel = |harness: &Author| harness.ctx.global_style().visuals.panel_fill;
    assert_eq!(panel(&harness), DARK.panel);
    harness.ctx.set_theme(Theme::Light);
    harness.run_steps(2);
    assert_eq!(panel(&harness), LIGHT.panel);
    let bright = |color: Color32| contrast(color, Color32::BLACK) > 10.0;
    let is_bright = painted(&harness).iter().any(|painted| match painted.shape {
        Shape::Rect(rect) => rect.rect.area() > 1e4 && rect.fill.is_opaque() && bright(rect.fill),
        _ => false,
    });
    assert!(is_bright, "the panels are painted in the light theme");
}

/// Negative control: gray on gray and a translucent text are found, white on black is not, and neither is a disabled
/// control.
#[test]
fn an_illegible_text_is_found() {
    let mut harness = Harness::builder().with_size([300.0, 200.0]).build_ui(|ui| {
        ui.painter().rect_filled(ui.max_rect().expand(20.0), 0.0, Color32::BLACK);
        ui.label(RichText::new("good").color(Color32::WHITE));
        ui.label(RichText::new("faint").color(Color32::from_gray(70)));
        ui.label(RichText::new("translucent").color(Color32::from_white_alpha(60)));
        ui.add_enabled(false, Button::new(RichText::new("disabled").color(Color32::from_gray(70))));
        let button = Button::new(RichText::new("button").color(Color32::from_gray(90)));
        ui.add(button.fill(Color32::from_gray(110)));
    });
    harness.run_steps(2);
    let found = illegible(&harness);
    let is_found = |text: &str| found.iter().any(|fault| fault.contains(&format!("{text:?}")));
    assert!(is_found("faint") && is_found("translucent") && is_found("button"), "{found:?}");
    assert!(!is_found("good") && !is_found("disabled"), "{found:?}");
}

/// Parts of controls that are hardly distinguishable from the panels on which they lie.
fn faint_controls(theme: Theme) -> Vec<&'static str> {
    let ctx = Context::default();
    install(&ctx);
    let style = ctx.style_of(theme);
    let t = match theme {
        Theme::Dark => &DARK,
        Theme::Light => &LIGHT,
    };
    let visuals = &style.visuals;
    let widgets = &visuals.widgets;
    let without_outline = |color| (Stroke::NONE, color);
    let parts = [
        ("handle of a slider", (widgets.inactive.fg_stroke, widgets.inactive.bg_fill)),
        ("control under the pointer", (widgets.hovered.bg_stroke, widgets.hovered.weak_bg_fill)),
        ("control with the focus", (widgets.active.bg_stroke, widgets.active.weak_bg_fill)),
        ("field with the focus", (visuals.selection.stroke, visuals.text_edit_bg_color())),
        ("check box", (widgets.inactive.bg_stroke, widgets.inactive.bg_fill)),
        ("empty field", (widgets.inactive.bg_stroke, visuals.text_edit_bg_color())),
        ("primary button", without_outline(t.accent)),
    ];
    let is_faint = |(stroke, fill): (Stroke, Color32)| {
        [t.panel, t.raised].iter().any(|surface| {
            let of_stroke = if stroke.is_empty() { 1.0 } else { contrast(stroke.color, *surface) };
            of_stroke.max(contrast(fill, *surface)) < LEAST_OF_CONTROLS
        })
    };
    let mut faint: Vec<&str> =
        parts.into_iter().filter(|(_, part)| is_faint(*part)).map(|(name, _)| name).collect();
    // The mark lies on the box.
    if contrast(widgets.inactive.fg_stroke.color, widgets.inactive.bg_fill) < LEAST_OF_CONTROLS {
        faint.push("check mark");
    }
    faint
}

#[test]
fn controls_stand_out() {
    for theme in [Theme::Dark, Theme::Light] {
        assert_eq!(faint_controls(theme), Vec::<&str>::new(), "{theme:?}");
    }
}

/// Every control of a workspace is reached by the Tab key, in reading order, with a visible mark, and has a name. In a
/// sheet, the same holds for its own controls.
#[test]
fn the_tab_key_goes_through_every_view_in_reading_order() {
    let mut harness = opened();
    let mut below = BTreeSet::new();
    let found = of_all_views(&mut harness, |harness, kind| {
        // Widgets of a sheet are those that the workspace below does not have.
        let mut expected = focusable(harness);
        match kind {
            Kind::Workspace => below = expected.iter().map(|stop| stop.id).collect(),
            Kind::Menu => return unnamed(&expected),
            // A message may have appeared in the status bar since.
            Kind::Sheet => expected.retain(|stop| !below.contains(&stop.id) && !stop.is_label()),
        }
        let walk = tab_through(harness);
        let reached: BTreeSet<_> = walk.stops.iter().map(|stop| stop.id).collect();
        // A message that came or went meanwhile is another widget.
        let there: BTreeSet<_> = focusable(harness).iter().map(|stop| stop.id).collect();
        let is_missed = |stop: &&Stop| !reached.contains(&stop.id) && there.contains(&stop.id);
        let missed = expected.iter().filter(is_missed);
        let mut faults: Vec<String> = missed.map(|stop| format!("not reached: {stop}")).collect();
        faults.extend(unnamed(&walk.stops));
        let is_known = |fault: &String| LATE.iter().any(|name| fault.contains(&format!("{name:?} at")));
        faults.extend(out_of_order(&walk.stops).into_iter().filter(|fault| !is_known(fault)));
        faults.extend(unmarked(&walk));
        faults
    });
    assert_none(&found);
}

/// A sheet that asks for a text has the keyboard focus in its first field, so that one can type at once.
#[test]
fn a_sheet_with_a_field_has_the_focus_there() {
    let mut harness = opened();
    wait_for_field(&mut harness);
    let first = window(&harness).session().textures()[0].id.clone();
    for (command, field) in [
        (Command::OpenImport, import::PATHS),
        (Command::OpenSave, import::SAVE_PATH),
        (Command::File(FileCommand::SaveAs), document::SAVE_PATH),
        (Command::File(FileCommand::Export(WAV.id)), export::PATH),
        (Command::File(FileCommand::AskWhatToOpen), document::OPEN_PATH),
        (Command::Stroke(StrokeCommand::AskWhatToOpen), document::OPEN_PATH),
        (Command::Signals(SignalsCommand::AskWhatToOpen(Slot::A)), document::OPEN_PATH),
        (Command::OpenPalette, help::FIND_COMMAND),
        (Command::RenameTexture(first), textures::NAME),
    ] {
        carry_out(&mut harness, command);
        harness.run_steps(4);
        let focused = harness.root().children_recursive().find(egui_kittest::Node::is_focused);
        let name = focused.and_then(|node| node.accesskit_node().label());
        assert_eq!(name.as_deref(), Some(field));
        carry_out(&mut harness, Command::CloseSheet);
        harness.run_steps(4);
    }
}

/// Negative control: a wrong order, a control without a name, and one that is not marked are found.
#[test]
fn a_bad_order_is_found() {
    let size = vec2(80.0, 24.0);
    let button = |ui: &mut egui::Ui, at, name: &str| {
        ui.put(egui::Rect::from_min_size(at, size), Button::new(name));
    };
    let mut good = Harness::builder().with_size([300.0, 200.0]).build_ui(move |ui| {
        for (x, y, name) in
            [(10.0, 10.0, "1"), (10.0, 50.0, "2"), (10.0, 90.0, "3"), (150.0, 10.0, "4"), (150.0, 50.0, "5")]
        {
            button(ui, pos2(x, y), name);
        }
    });
    good.run_steps(2);
    let walk = tab_through(&mut good);
    assert_eq!(walk.stops.len(), 5);
    assert_eq!(focusable(&good).len(), 5);
    assert_eq!(out_of_order(&walk.stops), Vec::<String>::new());
    assert_eq!(unnamed(&walk.stops), Vec::<String>::new());

    let mut bad =
        Harness::builder().with_size([300.0, 200.0]).with_accessibility_check(false).build_ui(move |ui| {
            for (x, y, name) in [(10.0, 10.0, "1"), (10.0, 90.0, "2"), (10.0, 50.0, "3"), (10.0, 130.0, "4")]
            {
                button(ui, pos2(x, y), name);
            }
            // Neither a name nor a mark.
            let area = egui::Rect::from_min_size(pos2(10.0, 165.0), size);
            ui.interact(area, ui.scope_id().with("bare"), egui::Sense::click());
        });
    bad.run_steps(2);
    let walk = tab_through(&mut bad);
    assert_eq!(walk.stops.len(), 5);
    assert!(!out_of_order(&walk.stops).is_empty());
    let last: &Stop = &walk.stops[4];
    assert_eq!(unnamed(&walk.stops), [format!("no name: {last}")]);
    assert!(unmarked(&walk).contains(&format!("no mark: {last}")), "{:?}", unmarked(&walk));
}
