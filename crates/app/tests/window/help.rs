//! Help: the command palette, the guide, and exports listed in the palette.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::strings::{export, help, import, papers};
use shagreen_app::workspace::Workspace;
use shagreen_formats::hatt::read_hatt;
use shagreen_formats::printed_results::Paper;
use shagreen_studio::export::FORMATS;
use shagreen_studio::guide::page;

use crate::support::{
    Author, author, choose, click, enter_path, says, unnamed_controls, wait, wait_for_field, window,
    write_into,
};

fn open_palette(harness: &mut Author) {
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::P);
    harness.run_steps(3);
}

#[test]
fn the_palette_finds_a_command_by_its_words_and_runs_it() {
    let mut harness = author();
    open_palette(&mut harness);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    write_into(&mut harness, help::FIND_COMMAND, "build show");
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(window(&harness).workspace(), Workspace::Build);
    assert!(!says(&harness, help::NO_COMMAND));
    open_palette(&mut harness);
    write_into(&mut harness, help::FIND_COMMAND, "fly to the moon");
    assert!(says(&harness, help::NO_COMMAND));
    harness.key_press(Key::Enter);
    harness.run_steps(2);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(harness.query_by_label(help::FIND_COMMAND).is_none());
}

/// Fast typing brings letters and *Enter* in one frame. Before, *Enter* ran the first command of the whole list, which
/// replaces the project by a new one.
#[test]
fn enter_runs_what_the_letters_typed_with_it_find() {
    let mut harness = author();
    let enter = Event::Key {
        key: Key::Enter,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    open_palette(&mut harness);
    harness.input_mut().events.extend([Event::Text("build show".to_owned()), enter.clone()]);
    harness.run_steps(3);
    assert_eq!(window(&harness).workspace(), Workspace::Build);
    assert!(harness.query_by_label(help::FIND_COMMAND).is_none());
    // Without letters and arrows, it runs nothing.
    open_palette(&mut harness);
    harness.input_mut().events.push(enter);
    harness.run_steps(3);
    assert!(harness.query_by_label(help::FIND_COMMAND).is_some());
    assert_eq!(window(&harness).workspace(), Workspace::Build);
}

/// The palette closes before the command opens another sheet.
#[test]
fn arrows_choose_a_command_that_opens_a_sheet() {
    let mut harness = author();
    open_palette(&mut harness);
    write_into(&mut harness, help::FIND_COMMAND, "open");
    harness.key_press(Key::ArrowDown);
    harness.run_steps(2);
    harness.key_press(Key::ArrowUp);
    harness.run_steps(2);
    write_into(&mut harness, help::FIND_COMMAND, "guide");
    harness.key_press(Key::Enter);
    harness.run_steps(4);
    assert!(says(&harness, page("index").unwrap().title()));
}

#[test]
fn the_guide_is_read_page_by_page() {
    let mut harness = author();
    click(&mut harness, help::HELP);
    harness.run_steps(2);
    click(&mut harness, help::GUIDE);
    harness.run_steps(4);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    let title = page("first-steps").unwrap().title();
    // Links to the page have its title, too.
    harness.get_by_role_and_label(Role::Button, title).click();
    harness.run_steps(4);
    let second = page("first-steps").unwrap().text.lines().nth(2).unwrap();
    let begin = second.split(['*', '`', '[', '.']).next().unwrap().trim();
    assert!(says(&harness, begin), "{begin}");
    click(&mut harness, help::CLOSE);
    harness.run_steps(3);
    assert!(!says(&harness, begin));
}

#[test]
fn a_paper_is_repeated_and_its_printed_numbers_stand_beside_ours() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = author();
    click(&mut harness, help::HELP);
    harness.run_steps(2);
    click(&mut harness, papers::MENU);
    harness.run_steps(4);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    choose(&mut harness, papers::PAPER, papers::name(Paper::S4));
    enter_path(&mut harness, papers::FOLDER, folder.path());
    wait(&mut harness, "the paper is repeated", |h| says(h, "Fig. 1 (section III-B)"));
    assert!(says(&harness, "Ours: simulated noise") && says(&harness, papers::COLUMNS[1]));
    assert!(says(&harness, papers::COLUMNS[3]), "the tolerance");
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    assert!(folder.path().join("S4.md").is_file() && folder.path().join("index.md").is_file());
    // The sheet takes its new size around the results.
    harness.run_steps(5);
    click(&mut harness, help::CLOSE);
    harness.run_steps(3);
    assert!(!says(&harness, papers::PURPOSE));
}

#[test]
fn the_authored_texture_is_exported_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = author();
    wait_for_field(&mut harness);
    // Without heights, there are no maps of them.
    for format in FORMATS.into_iter().filter(|format| format.id() != "maps") {
        open_palette(&mut harness);
        write_into(&mut harness, help::FIND_COMMAND, format.name());
        harness.key_press(Key::Enter);
        harness.run_steps(4);
        let path = folder.path().join("mine").with_extension(format.ending());
        enter_path(&mut harness, export::PATH, &path);
        let saved = import::saved(&path.display().to_string());
        wait(&mut harness, "it is exported", |h| h.query_by_label(&saved).is_some());
        let bytes = std::fs::read(&path).unwrap();
        assert!(format.is_like(&bytes));
        if format.id() == "hatt" {
            assert!(read_hatt(&bytes).unwrap().value.model.n_nodes() > 10);
        }
        harness.key_press(Key::Escape);
        harness.run_steps(3);
    }
}

#[test]
fn the_keys_are_shown_and_each_is_named() {
    let mut harness = author();
    harness.key_press(Key::F1);
    harness.run_steps(6);
    let close = harness.get_by_label(help::CLOSE).rect();
    assert!(close.bottom() < 720.0 && harness.get_by_label(help::SHORTCUTS).rect().top() > 0.0, "{close:?}");
    for command in shagreen_app::command::listed() {
        let entry = command.entry().expect("every listed command has words");
        assert!(entry.shortcut.is_none() || says(&harness, entry.label), "{}", entry.label);
    }
    click(&mut harness, help::CLOSE);
    harness.run_steps(2);
    assert!(!says(&harness, help::MORE_KEYS[0].1));
}
