//! Opening of files: Escape cancels it, and without a file dialog a path is typed.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::command::stroke::StrokeCommand;
use shagreen_app::command::{Command, FileCommand};
use shagreen_app::strings::{browse, document, stroke};
use shagreen_formats::project::{Project, write_project};
use shagreen_studio::project::new_project;

use crate::projects::open;
use crate::support::{Author, author, click, enter_path, says, wait, window, write_into};
use crate::views::carry_out;

/// Notes by which the written project is recognized.
const NOTES: &str = "from the file";

fn project_in(folder: &Path) -> PathBuf {
    let path = folder.join("Woods.shagreen");
    let project = Project { notes: NOTES.to_owned(), ..new_project() };
    std::fs::write(&path, write_project(&project, folder, "test")).unwrap();
    path
}

/// Presses Enter and Escape within one frame, so that the file cannot be read in between.
fn enter_and_escape(harness: &mut Author) {
    for key in [Key::Enter, Key::Escape] {
        let (physical_key, modifiers) = (None, Modifiers::NONE);
        let event = Event::Key { key, physical_key, pressed: true, repeat: false, modifiers };
        harness.input_mut().events.push(event);
    }
    harness.run_steps(3);
}

/// Runs frames for a time in which a small file is read.
fn wait_for_reading(harness: &mut Author) {
    let begun = Instant::now();
    wait(harness, "it would be read", |_| begun.elapsed() > Duration::from_millis(700));
}

#[test]
fn escape_cancels_the_opening_of_a_project_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = project_in(folder.path());
    let mut harness = author();
    carry_out(&mut harness, Command::File(FileCommand::AskWhatToOpen));
    write_into(&mut harness, document::OPEN_PATH, &path.display().to_string());
    enter_and_escape(&mut harness);
    assert!(says(&harness, &document::canceled("Woods.shagreen")));
    assert!(!window(&harness).document().is_opening());
    assert!(harness.query_by_label(document::OPEN_TITLE).is_none());
    wait_for_reading(&mut harness);
    assert_eq!(window(&harness).project(), &new_project());
    // It can be opened afterwards.
    open(&mut harness, &path);
    assert_eq!(window(&harness).project().notes, NOTES);
}

#[test]
fn escape_cancels_the_opening_of_a_stroke() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("walk.csv");
    std::fs::write(&path, "t_s,x_mm,y_mm,force_n\n0,0,0,1\n1,20,0,1\n").unwrap();
    let mut harness = author();
    for is_canceled in [true, false] {
        carry_out(&mut harness, Command::Stroke(StrokeCommand::AskWhatToOpen));
        if is_canceled {
            write_into(&mut harness, document::OPEN_PATH, &path.display().to_string());
            enter_and_escape(&mut harness);
            assert!(says(&harness, stroke::CANCELED));
            wait_for_reading(&mut harness);
            assert_eq!(window(&harness).session().n_strokes(), 0);
        } else {
            enter_path(&mut harness, document::OPEN_PATH, &path);
            wait(&mut harness, "it is read", |h| window(h).session().n_strokes() == 1);
        }
    }
}

/// Tests run without file dialogs, as on a system that lacks them.
#[test]
fn without_a_file_dialog_a_line_says_so_and_a_typed_path_works() {
    let folder = tempfile::tempdir().unwrap();
    let path = project_in(folder.path());
    let mut harness = author();
    carry_out(&mut harness, Command::File(FileCommand::AskWhatToOpen));
    assert!(!says(&harness, browse::MISSING), "the sheet asks nothing by itself");
    click(&mut harness, &browse::browse_for(document::OPEN_PATH));
    harness.remove_cursor();
    harness.run_steps(4);
    assert!(says(&harness, browse::MISSING), "it stays without the pointer");
    enter_path(&mut harness, document::OPEN_PATH, &path);
    wait(&mut harness, "it is open", |h| window(h).project().notes == NOTES);
    harness.run_steps(3);
    assert!(!says(&harness, browse::MISSING));

    let saved = folder.path().join("Again.shagreen");
    carry_out(&mut harness, Command::File(FileCommand::SaveAs));
    click(&mut harness, &browse::browse_for(document::SAVE_PATH));
    assert!(says(&harness, browse::MISSING));
    enter_path(&mut harness, document::SAVE_PATH, &saved);
    wait(&mut harness, "it is saved", |h| window(h).document().path() == Some(&*saved));
}
