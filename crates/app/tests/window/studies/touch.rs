//! A trial can be answered only after each of its stimuli was touched with motion.

use egui::Key;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::strings::studies;
use shagreen_core::people::study::answer::Answer;
use shagreen_studio::study::logs::{load_log, usual_log_folder};

use super::plans::{SIMILARITY, TOUCH_MM};
use super::{feel_all, go_to_trial, open, plan_file, session, start, still_to_feel, wait_until_felt};
use crate::support::{Author, author, click, says, wait};

/// Trial of two textures with a grade, of which none was touched.
fn graded(folder: &std::path::Path, parts: &str) -> Author {
    let mut harness = author();
    open(&mut harness, &plan_file(folder, parts));
    start(&mut harness, studies::START);
    assert!(go_to_trial(&mut harness));
    assert!(says(&harness, studies::SELECT_FIRST));
    for label in ["A", "B"] {
        click(&mut harness, &studies::play(label));
        assert!(says(&harness, &studies::move_here_to_feel(label)), "the surface says what it is");
    }
    harness.get_by_label(&studies::grade(studies::GRADE, 2)).click_accesskit();
    harness.run_steps(2);
    harness
}

fn can_go_on(harness: &Author) -> bool {
    !harness.get_by_label(studies::NEXT).accesskit_node().is_disabled()
}

fn answers(folder: &std::path::Path) -> Vec<Answer> {
    load_log(&usual_log_folder(&folder.join("plan.toml")).join("p01.jsonl")).unwrap().record().answers
}

#[test]
fn a_texture_that_was_started_but_not_stroked_is_named_and_cannot_be_answered() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = graded(folder.path(), SIMILARITY);
    // Neither the button nor a key answers.
    assert!(!can_go_on(&harness));
    assert_eq!(still_to_feel(&harness), ["A", "B"]);
    harness.key_press(Key::Enter);
    harness.run_steps(4);
    assert_eq!(session(&harness).counts().n_answered, 0);
    // B plays, and only its distance counts.
    click(&mut harness, studies::STROKE_START);
    wait_until_felt(&mut harness, "B");
    assert_eq!(still_to_feel(&harness), ["A"]);
    assert!(!can_go_on(&harness));
    click(&mut harness, &studies::play("A"));
    wait_until_felt(&mut harness, "A");
    assert!(can_go_on(&harness));
    harness.key_press(Key::Enter);
    wait(&mut harness, "it is answered", |h| session(h).counts().n_answered == 1);
    drop(harness);
    let answers = answers(folder.path());
    let touched_m = &answers[0].measured.touched_m;
    assert!(touched_m.len() == 2 && touched_m.iter().all(|m| *m >= 1e-3 * TOUCH_MM), "{touched_m:?}");
}

#[test]
fn a_plan_can_do_without_touch() {
    let folder = tempfile::tempdir().unwrap();
    let parts = SIMILARITY.replace("points = 5", "points = 5\nrequire_touch = false");
    let mut harness = graded(folder.path(), &parts);
    assert!(can_go_on(&harness) && still_to_feel(&harness).is_empty());
    click(&mut harness, studies::NEXT);
    wait(&mut harness, "it is answered", |h| session(h).counts().n_answered == 1);
    drop(harness);
    assert_eq!(answers(folder.path())[0].measured.touched_m, [0.0, 0.0]);
}

/// The participant strokes with the pointer.
#[test]
fn the_pointer_moves_over_a_texture() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = graded(folder.path(), SIMILARITY);
    let surface = harness.get_by_label(studies::SURFACE).rect();
    for label in ["A", "B"] {
        if !says(&harness, &studies::move_here_to_feel(label)) {
            click(&mut harness, &studies::play(label));
        }
        harness.drag_at(surface.center());
        harness.run_steps(2);
        let mut n = 0;
        while still_to_feel(&harness).iter().any(|left| left == label) {
            n += 1;
            let share = 0.5 + 0.3 * (f64::from(n) * 0.2).sin() as f32;
            harness.hover_at(surface.lerp_inside(egui::vec2(share, 0.5)));
            harness.step();
            std::thread::sleep(std::time::Duration::from_millis(10));
            assert!(n < 3000, "{label} is not felt");
        }
        harness.drop_at(surface.center());
        harness.run_steps(2);
    }
    assert!(can_go_on(&harness));
}

/// The helper of other tests leaves nothing to be felt.
#[test]
fn what_was_felt_stays_felt() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = graded(folder.path(), SIMILARITY);
    feel_all(&mut harness);
    assert!(can_go_on(&harness));
    click(&mut harness, studies::STROKE_STOP);
    assert!(can_go_on(&harness) && still_to_feel(&harness).is_empty());
}
