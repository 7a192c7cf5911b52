//! The About sheet: version, licenses, and paths of files.

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::Begin;
use shagreen_app::state::files::StoragePaths;
use shagreen_app::strings::{about, help};
use shagreen_studio::about::{LICENSE, PARTS, VERSION, repository};
use shagreen_studio::project::new_project;

use crate::clipboard::on_clipboard;
use crate::support::{Author, author, author_of, begin, click, says, unnamed_controls, write_into};

fn is_open(harness: &Author) -> bool {
    says(harness, &about::version(VERSION))
}

#[test]
fn the_menu_shows_version_licenses_and_paths_which_can_be_copied() {
    let folder = tempfile::tempdir().unwrap();
    let settings = folder.path().join("settings.json");
    std::fs::write(&settings, r#"{"has_seen_tour": true}"#).unwrap();
    let keeping = StoragePaths { settings: Some(settings.clone()), ..StoragePaths::default() };
    let mut harness = author_of(Begin { keeping, ..begin(new_project()) }, [960.0, 600.0]);
    click(&mut harness, help::HELP);
    harness.run_steps(2);
    click(&mut harness, about::ABOUT);
    harness.run_steps(4);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    assert!(is_open(&harness) && says(&harness, &about::license(LICENSE)));
    for part in PARTS {
        assert!(says(&harness, part.name) && says(&harness, part.license), "{part:?}");
    }
    assert!(repository().is_none_or(|address| says(&harness, address)));
    let path = settings.display().to_string();
    assert!(says(&harness, &path) && says(&harness, about::NOT_STORED) && says(&harness, about::NO_LOG));
    harness.get_by_label(&about::copy_path_of(about::SETTINGS)).click_accesskit();
    harness.step();
    assert_eq!(on_clipboard(&harness), Some(path));
    let networks = about::copy_path_of(about::NETWORKS);
    assert!(harness.query_by_label(&networks).is_none(), "there is nothing to copy");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(!is_open(&harness));
}

#[test]
fn the_palette_finds_it_and_the_button_closes_it() {
    let mut harness = author();
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::P);
    harness.run_steps(3);
    write_into(&mut harness, help::FIND_COMMAND, "about");
    harness.key_press(Key::Enter);
    harness.run_steps(4);
    assert!(is_open(&harness));
    click(&mut harness, help::CLOSE);
    harness.run_steps(3);
    assert!(!is_open(&harness));
}
