//! Dialogs under a real pointer and fast keys: lists above their sheet, wrong answers, failed files, and an export that
//! stays in place.

use std::fmt::Write as _;

use egui::accesskit::Role;
use egui::{Event, Id, Key, Modifiers, PointerButton, Popup, Pos2, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::command::axes::AxesCommand;
use shagreen_app::command::networks::NetworksCommand;
use shagreen_app::command::relief::ReliefCommand;
use shagreen_app::command::{Command, FileCommand};
use shagreen_app::strings::{self, authored, devices, document, export, help, import, shape, signal};
use shagreen_core::texture::shape::ShapeControl;
use shagreen_core::units::Hertz;
use shagreen_formats::recording::Ask;
use shagreen_formats::wav::{SidecarV1, write_wav};
use shagreen_studio::export::{FORMATS, WAV};

use crate::import::{import_recording, recording};
use crate::projects::{menu, project_in, rename, save_as, wait_until_saved};
use crate::shape::{open, set};
use crate::support::{
    Author, author, click, drop_files, enter_path, says, wait, wait_for_field, window, write_into,
};
use crate::views::carry_out;

/// Greatest distance of the button that closes a sheet from its lower right corner, in points.
const CORNER: f32 = 26.0;

/// Presses and releases the pointer within one frame, as a touchpad or a slow frame does.
fn click_fast(harness: &mut Author, at: Pos2) {
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    let event = |pressed| Event::PointerButton { pos: at, button, pressed, modifiers };
    harness.input_mut().events.extend([Event::PointerMoved(at), event(true), event(false)]);
    harness.run_steps(4);
}

fn center(harness: &Author, role: Role, name: &str) -> Pos2 {
    harness.get_by_role_and_label(role, name).rect().center()
}

/// The button that closes a sheet is in its lower right corner.
#[test]
fn every_sheet_is_closed_at_the_same_place() {
    let mut harness = author();
    wait_for_field(&mut harness);
    let first = window(&harness).session().textures()[0].id.clone();
    for (sheet, closing, command) in [
        ("import sheet", import::CANCEL, Command::OpenImport),
        ("save sheet", import::CANCEL, Command::File(FileCommand::SaveAs)),
        ("export sheet", import::CANCEL, Command::File(FileCommand::Export(WAV.id))),
        ("axes of the space", import::CANCEL, Command::Axes(AxesCommand::Open)),
        ("devices sheet", help::CLOSE, Command::OpenDevices),
        ("networks sheet", help::CLOSE, Command::Networks(NetworksCommand::Open)),
        ("open sheet", import::CANCEL, Command::File(FileCommand::AskWhatToOpen)),
        ("gallery", help::CLOSE, Command::File(FileCommand::OpenGallery)),
        ("shortcuts", help::CLOSE, Command::OpenShortcuts),
        ("guide", help::CLOSE, Command::OpenGuide),
        ("papers sheet", help::CLOSE, Command::OpenPapers),
        ("about", help::CLOSE, Command::OpenAbout),
        ("texture sheet", help::CLOSE, Command::OpenTexture(first)),
        ("relief sheet", import::CANCEL, Command::Relief(ReliefCommand::Begin(None, None))),
    ] {
        carry_out(&mut harness, command);
        harness.run_steps(6);
        let area = harness.ctx.memory(|memory| memory.area_rect(Id::unique(sheet))).expect(sheet);
        let button = harness.get_by_role_and_label(Role::Button, closing).rect();
        let from_corner = area.max - button.max;
        assert!(from_corner.x < CORNER && from_corner.y < CORNER, "{sheet}: {button:?} in {area:?}");
        assert!(from_corner.x > 0.0 && from_corner.y > 0.0, "{sheet}: {button:?} in {area:?}");
        carry_out(&mut harness, Command::CloseSheet);
    }
}

/// Text of a field or list.
fn text(harness: &Author, role: Role, name: &str) -> String {
    harness.get_by_role_and_label(role, name).accesskit_node().value().unwrap_or_default()
}

/// Opens a list of a sheet and picks an entry by the pointer, after a click on the heading of the sheet.
fn pick_above_sheet(harness: &mut Author, heading: &str, list: &str, entry: &str) {
    // The list is known from an earlier opening.
    for _ in 0..2 {
        let at = center(harness, Role::ComboBox, list);
        click_fast(harness, at);
    }
    assert!(!Popup::is_any_open(&harness.ctx));
    let at = center(harness, Role::Label, heading);
    click_fast(harness, at);
    let at = center(harness, Role::ComboBox, list);
    click_fast(harness, at);
    let at = center(harness, Role::Button, entry);
    let layer = harness.ctx.layer_id_at(at).expect("a layer");
    assert!(Popup::is_id_open(&harness.ctx, layer.id), "the list is above the sheet");
    click_fast(harness, at);
    assert!(!Popup::is_any_open(&harness.ctx));
    assert_eq!(text(harness, Role::ComboBox, list), entry);
}

#[test]
fn lists_open_above_their_sheet_after_a_click_on_an_empty_area() {
    let mut harness = author();
    wait_for_field(&mut harness);
    menu(&mut harness, export::EXPORT);
    harness.run_steps(4);
    pick_above_sheet(&mut harness, export::TITLE, signal::RATE, &signal::rate(16_000));
    carry_out(&mut harness, Command::CloseSheet);
    harness.run_steps(4);

    click(&mut harness, devices::OPEN);
    wait(&mut harness, "the sheet opens", |h| says(h, devices::TITLE));
    harness.run_steps(4);
    pick_above_sheet(&mut harness, devices::TITLE, devices::ACTUATOR, "Haptuator Mark II-D");
    carry_out(&mut harness, Command::CloseSheet);
    harness.run_steps(4);

    drop_files(&mut harness, &[("oak.csv", recording("cork", 6.0, Hertz(1000.0)).as_bytes())]);
    let unit = import::answer_of("acceleration_unit");
    wait(&mut harness, "it is asked", |h| h.query_by_role_and_label(Role::ComboBox, &unit).is_some());
    harness.run_steps(4);
    pick_above_sheet(&mut harness, import::TITLE, &unit, "m/s²");
    wait(&mut harness, "the fit", |h| h.query_by_label(import::GFC_MEDIAN).is_some());
}

#[test]
fn enter_chooses_from_a_list_and_escape_closes_only_the_list() {
    let mut harness = author();
    drop_files(&mut harness, &[("oak.csv", recording("cork", 6.0, Hertz(1000.0)).as_bytes())]);
    let unit = import::answer_of("acceleration_unit");
    wait(&mut harness, "it is asked", |h| h.query_by_role_and_label(Role::ComboBox, &unit).is_some());
    harness.get_by_role_and_label(Role::ComboBox, &unit).focus();
    harness.run_steps(2);
    let press = |harness: &mut Author, key: Key| {
        harness.key_press(key);
        harness.run_steps(3);
    };
    press(&mut harness, Key::Enter);
    assert!(Popup::is_any_open(&harness.ctx));
    press(&mut harness, Key::Escape);
    assert!(!Popup::is_any_open(&harness.ctx) && window(&harness).import().is_some());
    harness.get_by_role_and_label(Role::ComboBox, &unit).focus();
    harness.run_steps(2);
    for key in [Key::Enter, Key::ArrowDown, Key::Enter] {
        press(&mut harness, key);
    }
    assert!(!Popup::is_any_open(&harness.ctx));
    assert_ne!(text(&harness, Role::ComboBox, &unit), import::CHOOSE);
    assert!(harness.get_by_role_and_label(Role::ComboBox, &unit).is_focused());
}

/// A WAV file of one channel, without its sidecar.
fn wav() -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.wav");
    let samples: Vec<f32> = (0..4000_u16).map(|i| 0.1 * (f32::from(i) * 0.7).sin()).collect();
    write_wav(&path, &samples, &SidecarV1::new(4000, 1.0, 1, "test")).unwrap();
    std::fs::read(&path).unwrap()
}

#[test]
fn a_wrong_answer_is_marked_in_its_row_and_fields_begin_empty() {
    let mut harness = author();
    let bytes = wav();
    let force = import::typed(&import::answer_of("force"));
    let is_asked = |h: &Author| h.query_by_role_and_label(Role::TextInput, &force).is_some();
    drop_files(&mut harness, &[("hand.wav", &bytes)]);
    wait(&mut harness, "the force is asked for", is_asked);
    write_into(&mut harness, &force, "20fast");
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert!(says(&harness, &import::no_quantity(Ask::Force, "20fast")) && says(&harness, import::WRONG));
    assert!(!says(&harness, import::ANSWERED) && !says(&harness, "names columns"));
    assert!(harness.query_by_label(&import::file("hand.wav", import::QUESTION)).is_some());
    write_into(&mut harness, &force, "1 N");
    harness.key_press(Key::Enter);
    wait(&mut harness, "it is answered", |h| says(h, import::ANSWERED));
    assert!(!says(&harness, import::WRONG));
    assert_eq!(text(&harness, Role::TextInput, &force), "1 N");

    carry_out(&mut harness, Command::CloseSheet);
    harness.run_steps(4);
    drop_files(&mut harness, &[("hand.wav", &bytes)]);
    wait(&mut harness, "the force is asked for", is_asked);
    assert_eq!(text(&harness, Role::TextInput, &force), "");
}

/// White noise whose level follows the speed, at 4 kHz.
fn wide_band() -> String {
    let mut text = "time_s,acc,speed_mm/s,force_N\n".to_owned();
    let mut state = 1_u32;
    for i in 0..40_000_u32 {
        let t = f64::from(i) / 4000.0;
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let noise = f64::from(state >> 8) / f64::from(1_u32 << 24) - 0.5;
        let speed = 20.0 + 180.0 * (0.9 * t).sin().powi(2);
        let force = 1.2 + 0.8 * (0.23 * t).sin();
        let _ = writeln!(text, "{t:.5},{:.6},{speed:.3},{force:.4}", 0.05 * speed * noise);
    }
    text
}

#[test]
fn an_automatic_rate_goes_no_higher_than_a_position_permits() {
    let mut harness = author();
    let space_rate_hz = window(&harness).session().space_rate_hz();
    import_recording(&mut harness, "noise.csv", &wide_band());
    let rate_hz = |h: &Author| {
        let batch = window(h).import().expect("the sheet").batch();
        let draft = batch.draft_of(batch.files()[0].id).expect("a texture");
        draft.fitted().map(|fitted| fitted.report.rate.0)
    };
    assert_eq!(rate_hz(&harness), Some(space_rate_hz));
    assert!(says(&harness, &import::placed_at(space_rate_hz)));
    // Without positions, the recording has its own rate.
    click(&mut harness, import::PLACE_THEM);
    wait(&mut harness, "another fit", |h| rate_hz(h).is_some_and(|rate_hz| rate_hz > space_rate_hz));
    click(&mut harness, import::PLACE_THEM);
    wait(&mut harness, "the first fit", |h| rate_hz(h) == Some(space_rate_hz));
    harness.run_steps(3);
    click(&mut harness, &import::add(1));
    harness.run_steps(4);
    assert!(window(&harness).session().textures().last().unwrap().place.is_some());
}

#[test]
fn every_file_that_fails_has_a_row_with_its_reason() {
    let mut harness = author();
    drop_files(&mut harness, &[("oak.csv", recording("cork", 3.0, Hertz(1000.0)).as_bytes())]);
    let unit = import::answer_of("acceleration_unit");
    wait(&mut harness, "it is read", |h| h.query_by_role_and_label(Role::ComboBox, &unit).is_some());
    let files =
        [("broken.png", b"no picture".as_slice()), ("what.xyz", b"\x00\x9f\x92\x96\x00\x01".as_slice())];
    for (name, bytes) in files {
        drop_files(&mut harness, &[(name, bytes)]);
        let row = import::file(name, import::FAILED);
        wait(&mut harness, "it has a row", |h| h.query_by_label(&row).is_some());
        harness.run_steps(2);
        assert!(says(&harness, import::ACCEPTED), "{name} is selected");
    }
    assert!(window(&harness).import().is_some());
}

#[test]
fn the_export_stays_in_place_and_names_what_it_writes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("oak.wav");
    let mut harness = author();
    wait_for_field(&mut harness);
    rename(&mut harness, "Oak");
    click(&mut harness, authored::ADD);
    harness.run_steps(4);
    rename(&mut harness, "Elm");
    wait_for_field(&mut harness);
    menu(&mut harness, export::EXPORT);
    harness.run_steps(4);
    assert!(says(&harness, &export::subject("Elm", false, None)));
    let areas = |h: &Author| {
        let button = |name: &str| h.get_by_role_and_label(Role::Button, name).rect();
        [button(WAV.name), button(FORMATS[0].name()), button(export::EXPORT_NOW), button(import::CANCEL)]
    };
    let terms = export::lost("tags, description, license and origin");
    harness.run_steps(10);
    let before = areas(&harness);
    click(&mut harness, FORMATS[0].name());
    wait(&mut harness, "it is checked", |h| says(h, &terms));
    harness.run_steps(4);
    assert_eq!(areas(&harness), before, "nothing moves");
    click(&mut harness, WAV.name);

    click(&mut harness, &export::all_of(2));
    harness.run_steps(2);
    assert!(says(&harness, &export::subject("", false, Some(2))));
    assert!(says(&harness, &export::all_to_save("oak.wav, elm.wav", 2, WAV.name)));
    assert!(!text(&harness, Role::TextInput, export::PATH).contains("elm"), "it is the path of a folder");
    click(&mut harness, &export::all_of(2));
    harness.run_steps(2);
    assert!(text(&harness, Role::TextInput, export::PATH).ends_with("elm.wav"));
    enter_path(&mut harness, export::PATH, &path);
    let saved = import::saved(&path.display().to_string());
    wait(&mut harness, "it is exported", |h| says(h, &saved));
    let beside = std::fs::read(path.with_extension("json")).unwrap();
    let sidecar: SidecarV1 = serde_json::from_slice(&beside).unwrap();
    assert_eq!(sidecar.name.as_deref(), Some("Elm"));

    click(&mut harness, import::CLOSE);
    harness.run_steps(4);
    menu(&mut harness, export::EXPORT);
    harness.run_steps(4);
    let before = areas(&harness);
    enter_path(&mut harness, export::PATH, &path);
    wait(&mut harness, "it asks", |h| says(h, &export::exists("oak.wav", 1)));
    harness.run_steps(4);
    assert_eq!(areas(&harness), before, "no button takes the place of another one");
    assert!(
        harness.get_by_role_and_label(Role::Button, export::EXPORT_NOW).accesskit_node().is_disabled(),
        "a double click replaces nothing"
    );
    click(&mut harness, import::REPLACE);
    wait(&mut harness, "it is replaced", |h| says(h, &saved));
}

#[test]
fn an_undo_before_a_save_is_saved_even_in_one_frame() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.shagreen");
    let mut harness = author();
    rename(&mut harness, "Oak");
    save_as(&mut harness, &path);
    wait_until_saved(&mut harness);
    assert!(says(&harness, document::SAVED));
    let project = window(&harness).project().clone();
    harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).set_value_accesskit(1.0);
    harness.run_steps(3);
    assert_ne!(window(&harness).project(), &project);
    let press = |key| Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: Modifiers::COMMAND,
    };
    harness.input_mut().events.extend([press(Key::Z), press(Key::S)]);
    harness.run_steps(2);
    wait(&mut harness, "it is written", |h| !window(h).document().is_saving());
    assert_eq!(window(&harness).project(), &project);
    assert_eq!(project_in(&path), project);
    carry_out(&mut harness, Command::File(FileCommand::SaveAs));
    harness.run_steps(4);
    assert!(harness.query_by_label(document::FOLDERS).is_some(), "recent folders are offered");
}

#[test]
fn the_scroll_bar_covers_no_reset_button() {
    let mut harness = author();
    wait_for_field(&mut harness);
    open(&mut harness);
    set(&mut harness, ShapeControl::Level, -6.0);
    let button = shape::reset(ShapeControl::Level);
    harness.get_by_role_and_label(Role::Button, &button).scroll_to_me();
    harness.run_steps(10);
    let area = harness.get_by_role_and_label(Role::Button, &button).rect();
    let at = area.right_center() - vec2(1.0, 0.0);
    // The bar grows as the pointer arrives.
    harness.hover_at(at);
    harness.run_steps(20);
    click_fast(&mut harness, at);
    assert!(window(&harness).project().texture().shape.is_neutral());
}

#[test]
fn escape_and_the_cross_clear_the_search() {
    let mut harness = author();
    for is_cross in [false, true] {
        write_into(&mut harness, strings::SEARCH, "felt");
        assert_eq!(text(&harness, Role::TextInput, strings::SEARCH), "felt");
        if is_cross {
            click(&mut harness, strings::textures::CLEAR_SEARCH);
        } else {
            harness.key_press(Key::Escape);
        }
        harness.run_steps(3);
        assert_eq!(text(&harness, Role::TextInput, strings::SEARCH), "");
    }
}
