//! A session by keys alone.

use std::cell::Cell;
use std::time::{Duration, Instant};

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use shagreen_app::strings::studies;
use shagreen_core::people::study::answer::Response;
use shagreen_core::people::study::progress::Step;
use shagreen_studio::study::logs::{load_log, usual_log_folder};

use super::plans::{DISSIMILARITY, RATING, RELEVANCE, SIMILARITY, SORTING};
use super::{has_to_feel, open, plan_file, session, start, wait_until_felt};
use crate::support::{Author, author, says, wait, window};

fn keys(harness: &mut Author, keys: &[Key]) {
    for key in keys {
        harness.key_press(*key);
        // A widget that takes the keyboard focus keeps its arrow keys some frames later.
        harness.run_steps(4);
    }
}

/// Agrees to the consent text and begins the first part by keys. Enter alone does not agree: the button needs the focus.
fn agree_and_begin(harness: &mut Author) {
    keys(harness, &[Key::Enter]);
    for _ in 0..10 {
        assert_eq!(session(harness).step(), Step::Consent);
        if harness.get_by_label(studies::AGREE).is_focused() {
            break;
        }
        keys(harness, &[Key::Tab]);
    }
    keys(harness, &[Key::Enter, Key::Enter]);
    assert!(matches!(session(harness).step(), Step::Trial(_)));
}

/// Starts a stimulus by a key and waits until the automatic stroke has moved over it.
fn feel(harness: &mut Author, key: Key, label: &str) {
    keys(harness, &[key]);
    wait_until_felt(harness, label);
}

/// Waits until the automatic stroke has moved over the only stimulus.
fn feel_it(harness: &mut Author) {
    wait(harness, "it is felt", |h| !has_to_feel(h));
}

/// Types a number, without the key events that a keyboard sends beside the text.
fn type_number(harness: &mut Author, text: &str) {
    harness.get_by_role_and_label(Role::TextInput, studies::NUMBER).type_text(text);
    harness.run_steps(2);
}

/// Waits until this number of trials is answered.
fn answered(harness: &mut Author, n: usize) {
    wait(harness, "it is answered", |h| session(h).counts().n_answered == n);
    harness.run_steps(2);
}

#[test]
fn a_session_needs_no_pointer() {
    let folder = tempfile::tempdir().unwrap();
    let parts = [SORTING, RELEVANCE, RATING, DISSIMILARITY, SIMILARITY].concat();
    let parts = parts.replace("groups = [3]", "groups = [2]").replace("practice = 1\n", "");
    let parts = parts.replace("reference = [\"c\", \"d\"]\n", "").replace("repeats = 2", "repeats = 1");
    let path = plan_file(folder.path(), &parts);
    let mut harness = author();
    open(&mut harness, &path);
    start(&mut harness, studies::START);
    agree_and_begin(&mut harness);
    // Five textures: each is felt by its letter, and the last three go into the second group.
    keys(&mut harness, &[Key::Space]);
    for (key, label, groups) in [
        (Key::A, "A", &[Key::Num1][..]),
        (Key::B, "B", &[Key::Num1]),
        (Key::ArrowRight, "C", &[Key::Num2]),
        (Key::ArrowRight, "D", &[Key::Num1, Key::Num0, Key::Num2]),
    ] {
        feel(&mut harness, key, label);
        keys(&mut harness, groups);
    }
    keys(&mut harness, &[Key::Enter]);
    assert_eq!(session(&harness).counts().n_answered, 0, "one texture has no group");
    feel(&mut harness, Key::E, "E");
    keys(&mut harness, &[Key::Num2, Key::Enter]);
    answered(&mut harness, 1);
    // Adjectives: the first one has the keyboard focus.
    keys(&mut harness, &[Key::Enter, Key::Space]);
    feel_it(&mut harness);
    keys(&mut harness, &[Key::Enter]);
    answered(&mut harness, 2);
    feel_it(&mut harness);
    keys(&mut harness, &[Key::Enter]);
    answered(&mut harness, 3);
    // Two ratings of two textures: the first key places the mark in the middle.
    keys(&mut harness, &[Key::Enter]);
    for n in [4, 5] {
        keys(&mut harness, &[Key::ArrowRight, Key::ArrowRight, Key::Tab, Key::End]);
        feel_it(&mut harness);
        keys(&mut harness, &[Key::Enter]);
        answered(&mut harness, n);
    }
    // A difference.
    keys(&mut harness, &[Key::Enter]);
    feel(&mut harness, Key::A, "A");
    feel(&mut harness, Key::B, "B");
    type_number(&mut harness, "2");
    type_number(&mut harness, ",5");
    keys(&mut harness, &[Key::Enter]);
    answered(&mut harness, 6);
    // A grade.
    keys(&mut harness, &[Key::Enter]);
    feel(&mut harness, Key::A, "A");
    feel(&mut harness, Key::B, "B");
    keys(&mut harness, &[Key::Num4, Key::Enter]);
    answered(&mut harness, 7);
    assert_eq!(session(&harness).step(), Step::Done);
    keys(&mut harness, &[Key::Enter]);
    assert!(window(&harness).studies().running().is_none());
    let log = load_log(&usual_log_folder(&path).join("p01.jsonl")).unwrap();
    let given: Vec<Response> = log.record().answers.into_iter().map(|answer| answer.response).collect();
    assert_eq!(
        given,
        [
            Response::Groups(vec![0, 0, 1, 1, 1]),
            Response::Votes(vec![true, false, false]),
            Response::Votes(vec![false; 3]),
            Response::Sliders(vec![51.0, 100.0]),
            Response::Sliders(vec![51.0, 100.0]),
            Response::Magnitude(2.5),
            Response::Grade(4),
        ]
    );
}

#[test]
fn escape_asks_before_it_leaves() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = author();
    open(&mut harness, &plan_file(folder.path(), SIMILARITY));
    start(&mut harness, studies::START);
    agree_and_begin(&mut harness);
    keys(&mut harness, &[Key::Space]);
    feel(&mut harness, Key::A, "A");
    feel(&mut harness, Key::B, "B");
    keys(&mut harness, &[Key::Num3, Key::Escape]);
    assert!(says(&harness, studies::LEAVE_TITLE) && says(&harness, studies::LEAVE_BEFORE));
    keys(&mut harness, &[Key::Num5, Key::Escape, Key::Enter]);
    // What was entered before is still there.
    answered(&mut harness, 1);
    assert!(!says(&harness, studies::LEAVE_TITLE));
    keys(&mut harness, &[Key::Escape]);
    assert!(says(&harness, studies::LEAVE_SAVED));
    harness.get_by_label(studies::LEAVE_NOW).click();
    harness.run_steps(2);
    assert!(window(&harness).studies().running().is_none());
    wait(&mut harness, "the sessions are listed", |h| !window(h).studies().is_busy());
    assert!(window(&harness).studies().sessions()[0].can_resume());
}

/// A letter starts a stimulus, and so does a button; the automatic stroke makes it audible.
#[test]
fn a_stimulus_is_audible_only_while_it_is_selected() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = author();
    open(&mut harness, &plan_file(folder.path(), SIMILARITY));
    start(&mut harness, studies::START);
    agree_and_begin(&mut harness);
    keys(&mut harness, &[Key::Space]);
    wait(&mut harness, "the stroke runs", |h| window(h).session().touch().contact.force_n > 0.0);
    // The texture of the project may fade out for a moment, which the scope shows later. So silence must last.
    let silent_since = Cell::new(Instant::now());
    wait(&mut harness, "it is silent for some time", |h| {
        if window(h).session().scope().rms(0.2) >= 1e-6 {
            silent_since.set(Instant::now());
        }
        silent_since.get().elapsed() > Duration::from_millis(300)
    });
    assert!(window(&harness).session().scope().rms(0.2) < 1e-6, "nothing is selected");
    keys(&mut harness, &[Key::A]);
    wait(&mut harness, "it sounds", |h| window(h).session().scope().rms(0.2) > 1e-4);
    keys(&mut harness, &[Key::A]);
    wait(&mut harness, "it is silent", |h| window(h).session().scope().rms(0.2) < 1e-6);
}
