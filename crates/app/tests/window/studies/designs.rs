//! Each design from start to end by clicks, with the answers of a simulated participant.

use std::path::Path;

use egui::accesskit::Role;
use egui::vec2;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::strings::studies;
use shagreen_app::studies::page::SessionState;
use shagreen_core::people::study::answer::{Answer, Event, Response};
use shagreen_core::people::study::plan::Design;
use shagreen_core::people::study::progress::Step;
use shagreen_core::people::study::simulated::{Observers, World, simulated_session};
use shagreen_core::people::study::touch::n_touched;
use shagreen_core::people::study::trial::Side;
use shagreen_studio::study::logs::{load_log, usual_log_folder};
use shagreen_studio::study::plans::load_plan;

use super::plans::{
    ABX, ANCHORS, DISSIMILARITY, HIDDEN, LIKERT, MUSHRA, RATING, RELEVANCE, SAME_DIFFERENT, SIMILARITY,
    SORTING, STAIRCASE,
};
use super::{feel_all, go_to_trial, has_to_feel, leave, open, plan_file, session, start};
use crate::support::{Author, author, click, drag, says, shown, unnamed_controls, wait, window, write_into};

/// Smallest side of what a finger touches, in points; positions are rounded to pixels.
const TARGET: f32 = 43.5;

/// Answers of a simulated participant with the number 1 to a plan.
pub(super) fn answers(path: &Path) -> Vec<Answer> {
    let plan = load_plan(path).unwrap().plan;
    let world = World::invented(&plan, 3);
    let events = simulated_session(&plan, &world, &Observers::usual(), 1, 3).unwrap();
    let answer = |event: Event| if let Event::Answered(answer) = event { Some(*answer) } else { None };
    events.into_iter().filter_map(answer).collect()
}

fn press(harness: &mut Author, name: &str) {
    harness.get_by_label(name).click_accesskit();
    harness.run_steps(2);
}

/// Gives an answer to the trial on the screen by clicks.
pub(super) fn give(harness: &mut Author, answer: &Answer) {
    assert_eq!(session(harness).step(), Step::Trial(answer.trial.clone()));
    let n_before = session(harness).counts().n_answered;
    let design = session(harness).next_part().unwrap().design.clone();
    feel_all(harness);
    match (&answer.response, &design) {
        (Response::Groups(groups), _) => {
            let labels: Vec<String> =
                answer.trial.task.shown().into_iter().map(|shown| shown.label).collect();
            for (label, group) in labels.iter().zip(groups) {
                let tile = harness.get_by_label(&studies::play(label)).rect().center();
                let place = harness.get_by_label(&studies::group(*group)).rect();
                drag(harness, tile, place.center() + vec2(0.0, 40.0));
            }
        }
        (Response::Votes(votes), Design::Relevance { adjectives, .. }) => {
            for (adjective, vote) in adjectives.iter().zip(votes) {
                if *vote {
                    harness.get_by_role_and_label(Role::CheckBox, adjective).click();
                    harness.run_steps(2);
                }
            }
        }
        (Response::Sliders(values), _) => {
            let labels = answer.trial.task.shown();
            for (index, value) in values.iter().enumerate() {
                let name = match &design {
                    Design::Rating { pairs, .. } => studies::between(&pairs[index].low, &pairs[index].high),
                    Design::Mushra { .. } => studies::quality(&labels[index + 1].label),
                    _ => studies::PLACE.to_owned(),
                };
                harness.get_by_role_and_label(Role::Slider, &name).set_value_accesskit(*value);
                harness.run_steps(2);
            }
        }
        (Response::Magnitude(number), _) => write_into(harness, studies::NUMBER, &number.to_string()),
        (Response::IsDifferent(is_different), _) => {
            let name = if *is_different { studies::DIFFERENT } else { studies::SAME };
            choose(harness, name);
        }
        (Response::Side(side), Design::Staircase { .. }) => {
            choose(harness, if *side == Side::First { studies::LEFT } else { studies::RIGHT });
        }
        (Response::Side(side), _) => {
            choose(harness, if *side == Side::First { studies::X_IS_A } else { studies::X_IS_B });
        }
        (Response::Grade(grade), _) => press(harness, &studies::grade(studies::GRADE, *grade)),
        (Response::Grades { prompt, grades }, Design::Likert { statements, .. }) => {
            if harness.query_by_label(studies::DESCRIBE).is_some() {
                write_into(harness, studies::TEXT, prompt);
                press(harness, studies::DESCRIBE);
            }
            let first = studies::grade(&statements[0].text, 1);
            wait(harness, "the texture is made", |h| h.query_by_label(&first).is_some());
            for (statement, grade) in statements.iter().zip(grades) {
                press(harness, &studies::grade(&statement.text, *grade));
            }
        }
        other => panic!("{other:?}"),
    }
    // The texture of a question can be felt only now.
    let is_answered = |h: &Author| session(h).counts().n_answered > n_before;
    wait(harness, "all is felt", |h| is_answered(h) || !has_to_feel(h));
    if harness.query_by_label(studies::NEXT).is_some() && session(harness).counts().n_answered == n_before {
        click(harness, studies::NEXT);
    }
    wait(harness, "the answer is saved", |h| session(h).counts().n_answered == n_before + 1);
}

/// Waits until everything was presented and chooses an alternative.
fn choose(harness: &mut Author, name: &str) {
    wait(harness, "it was presented", |h| {
        h.query_by_label(name).is_some_and(|node| !node.accesskit_node().is_disabled())
    });
    press(harness, name);
}

/// Checks what holds for every trial on the screen.
fn check_screen(harness: &Author) {
    let shown = shown(harness);
    for name in HIDDEN {
        assert!(!shown.iter().any(|text| text.contains(name)), "{name} is visible: {shown:?}");
    }
    assert_eq!(unnamed_controls(harness), Vec::<String>::new());
    for role in [Role::Button, Role::CheckBox, Role::Slider] {
        for node in harness.query_all_by_role(role) {
            let (size, name) = (node.rect().size(), node.accesskit_node().label());
            // The width of a check box is that of its text.
            let width = if role == Role::CheckBox { TARGET } else { size.x };
            assert!(size.y >= TARGET && width >= TARGET, "{name:?} is {size:?}");
        }
    }
}

/// Runs a plan from start to end, and checks its log.
fn run(parts: &str) {
    let folder = tempfile::tempdir().unwrap();
    let path = plan_file(folder.path(), parts);
    let wanted = answers(&path);
    let mut harness = author();
    open(&mut harness, &path);
    start(&mut harness, studies::START);
    assert!(says(&harness, "You can stop at any time."), "{:?}", shown(&harness));
    for answer in &wanted {
        assert!(go_to_trial(&mut harness), "{}", answer.trial.number);
        check_screen(&harness);
        give(&mut harness, answer);
    }
    assert!(!go_to_trial(&mut harness), "all trials are answered");
    leave(&mut harness);
    let sessions = window(&harness).studies().sessions();
    assert!(
        sessions.len() == 1 && sessions[0].state == SessionState::Done && !sessions[0].is_simulated,
        "{sessions:?}"
    );
    check_log(&usual_log_folder(&path).join("p01.jsonl"), &wanted);
}

/// The log has these answers and was measured.
fn check_log(path: &Path, wanted: &[Answer]) {
    let log = load_log(path).unwrap();
    assert!(log.problems.is_empty() && !log.header.is_simulated());
    assert_eq!(log.events().last(), Some(&Event::Ended));
    let given = log.record().answers;
    assert_eq!(given.len(), wanted.len());
    for (given, wanted) in given.iter().zip(wanted) {
        assert_eq!((&given.trial, &given.response), (&wanted.trial, &wanted.response));
        let measured = &given.measured;
        assert!(measured.response_secs.is_some_and(|secs| (0.0..300.0).contains(&secs)));
        assert_eq!(measured.stimulus_hashes.len(), measured.n_plays.len());
        assert!(measured.n_plays.iter().all(|n| *n >= 1), "{measured:?}");
        assert!(measured.stimulus_hashes.iter().all(|hash| hash.len() == 64));
        assert_eq!(measured.touched_m.len(), n_touched(&given.trial.task));
    }
}

#[test]
fn textures_are_sorted_by_drag_and_drop() {
    run(SORTING);
}

#[test]
fn adjectives_are_chosen() {
    run(RELEVANCE);
}

#[test]
fn textures_are_rated_after_practice() {
    run(RATING);
}

#[test]
fn differences_are_numbers_with_a_break_between() {
    run(DISSIMILARITY);
}

#[test]
fn vibrations_in_succession_are_the_same_or_different() {
    run(SAME_DIFFERENT);
}

#[test]
fn gaps_are_detected_along_a_staircase() {
    run(STAIRCASE);
}

#[test]
fn similarities_are_graded() {
    run(SIMILARITY);
}

#[test]
fn textures_from_texts_are_graded_under_three_conditions() {
    run(LIKERT);
}

#[test]
fn the_third_stimulus_is_named() {
    run(ABX);
}

#[test]
fn versions_are_rated_beside_their_reference() {
    run(MUSHRA);
}

#[test]
fn textures_are_placed_between_anchors() {
    run(ANCHORS);
}

/// The program ends in the middle of a session; the session goes on where it was, and no answer is lost or asked twice.
#[test]
fn a_killed_session_goes_on_at_its_trial() {
    let folder = tempfile::tempdir().unwrap();
    let path = plan_file(folder.path(), &format!("{RATING}{SIMILARITY}"));
    let wanted = answers(&path);
    let mut harness = author();
    open(&mut harness, &path);
    start(&mut harness, studies::START);
    for answer in &wanted[..2] {
        assert!(go_to_trial(&mut harness));
        give(&mut harness, answer);
    }
    drop(harness);

    let mut harness = author();
    open(&mut harness, &path);
    let sessions = window(&harness).studies().sessions().to_vec();
    assert!(sessions.len() == 1 && sessions[0].can_resume() && sessions[0].n_answers == 2, "{sessions:?}");
    start(&mut harness, &studies::resume("p01"));
    assert!(!says(&harness, studies::CONSENT), "consent was given");
    for answer in &wanted[2..] {
        assert!(go_to_trial(&mut harness));
        give(&mut harness, answer);
    }
    assert!(!go_to_trial(&mut harness));
    leave(&mut harness);
    let log = load_log(&usual_log_folder(&path).join("p01.jsonl")).unwrap();
    let given: Vec<Response> = log.record().answers.into_iter().map(|answer| answer.response).collect();
    assert_eq!(given, wanted.into_iter().map(|answer| answer.response).collect::<Vec<_>>());
    assert_eq!(log.events().iter().filter(|event| **event == Event::Resumed).count(), 1);
}

/// Practice alone writes nothing.
#[test]
fn practice_leaves_no_log() {
    let folder = tempfile::tempdir().unwrap();
    let path = plan_file(folder.path(), RATING);
    let wanted = answers(&path);
    let mut harness = author();
    open(&mut harness, &path);
    start(&mut harness, studies::PRACTICE_ONLY);
    assert!(go_to_trial(&mut harness) && says(&harness, studies::PRACTICE));
    give(&mut harness, &wanted[0]);
    assert!(!go_to_trial(&mut harness));
    leave(&mut harness);
    assert!(window(&harness).studies().sessions().is_empty() && !usual_log_folder(&path).exists());
}
