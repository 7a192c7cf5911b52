//! Answers that cannot be saved.

use std::io::Write as _;

use egui_kittest::kittest::Queryable as _;
use shagreen_app::strings::studies;
use shagreen_studio::study::logs::{load_log, usual_log_folder};

use super::designs::{answers, give};
use super::plans::SIMILARITY;
use super::{feel_all, go_to_trial, open, plan_file, session, start};
use crate::support::{author, click, says, wait, window};

/// Another program writes to the log: the window says so, keeps the answer, and goes on after a resume. Nothing is lost.
#[test]
fn an_answer_that_is_not_saved_is_said_and_never_dropped_silently() {
    let folder = tempfile::tempdir().unwrap();
    let path = plan_file(folder.path(), SIMILARITY);
    let log = usual_log_folder(&path).join("p01.jsonl");
    let wanted = answers(&path);
    let mut harness = author();
    open(&mut harness, &path);
    start(&mut harness, studies::START);
    assert!(go_to_trial(&mut harness));
    give(&mut harness, &wanted[0]);
    assert!(go_to_trial(&mut harness));
    std::fs::OpenOptions::new().append(true).open(&log).unwrap().write_all(b"not ours\n").unwrap();
    feel_all(&mut harness);
    harness.get_by_label(&studies::grade(studies::GRADE, 2)).click_accesskit();
    harness.run_steps(2);
    click(&mut harness, studies::NEXT);
    assert!(
        says(&harness, studies::NOT_SAVED_TITLE) && says(&harness, "another program has changed the log")
    );
    assert_eq!(session(&harness).counts().n_answered, 1);
    click(&mut harness, studies::TRY_AGAIN);
    assert!(says(&harness, studies::NOT_SAVED_TITLE), "it is still not saved");
    click(&mut harness, studies::LEAVE_PAGE);
    assert!(says(&harness, studies::LEAVE_UNSAVED));
    click(&mut harness, studies::LEAVE_NOW);
    wait(&mut harness, "the session is left", |h| window(h).studies().running().is_none());
    wait(&mut harness, "the sessions are listed", |h| !window(h).studies().is_busy());
    harness.run_steps(2);

    start(&mut harness, &studies::resume("p01"));
    assert!(go_to_trial(&mut harness));
    give(&mut harness, &wanted[1]);
    assert!(!go_to_trial(&mut harness));
    let read = load_log(&log).unwrap();
    assert_eq!((read.record().answers.len(), read.problems.len()), (2, 1));
}
