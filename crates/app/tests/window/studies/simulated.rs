//! A simulated participant in the window.

use std::path::Path;

use shagreen_app::Begin;
use shagreen_app::strings::studies;
use shagreen_core::people::panel::simulated_name;
use shagreen_core::people::study::answer::{Event, Response};
use shagreen_core::people::study::progress::Step;
use shagreen_core::people::study::simulated::{Observers, simulated_session};
use shagreen_core::people::study::trial::Task;
use shagreen_formats::study_log::ReadLog;
use shagreen_studio::project::new_project;
use shagreen_studio::study::logs::{load_log, log_path, usual_simulated_log_folder};
use shagreen_studio::study::plans::load_plan;
use shagreen_studio::study::simulation::Simulation;

use super::plans::{ABX, LIKERT, RATING, SAME_DIFFERENT, SORTING, STAIRCASE, TOUCH_MM};
use super::{leave, open, plan_file, session};
use crate::support::{Author, author_of, begin, says, wait, window};

const SEED: u64 = 7;

/// Window that the program opens with `--simulate-participant`.
fn simulating(path: &Path) -> Author {
    let begin = Begin { take: Some(path.to_owned()), simulation_seed: Some(SEED), ..begin(new_project()) };
    let mut harness = author_of(begin, [1280.0, 720.0]);
    wait(&mut harness, "the session runs", |h| window(h).studies().running().is_some());
    harness
}

fn responses(log: &ReadLog) -> Vec<Response> {
    log.record().answers.into_iter().map(|answer| answer.response).collect()
}

/// Responses of the same participant without a window.
fn expected(path: &Path) -> Vec<Response> {
    let plan = load_plan(path).unwrap().plan;
    let world = Simulation::usual(1, SEED).world(&plan);
    let events = simulated_session(&plan, &world, &Observers::usual(), 1, SEED).unwrap();
    let response =
        |event: Event| if let Event::Answered(answer) = event { Some(answer.response) } else { None };
    events.into_iter().filter_map(response).collect()
}

/// The window gives the answers of the simulation, whether it is killed in the middle or not, and says who answered.
#[test]
fn a_simulated_session_is_killed_and_goes_on_as_if_nothing_had_happened() {
    let folder = tempfile::tempdir().unwrap();
    let parts = [SORTING, RATING, SAME_DIFFERENT, LIKERT, ABX].concat();
    let path = plan_file(folder.path(), &parts);
    let mut harness = simulating(&path);
    wait(&mut harness, "some trials are answered", |h| session(h).counts().n_answered >= 4);
    assert!(says(&harness, studies::SIMULATED));
    drop(harness);
    let log = log_path(&usual_simulated_log_folder(&path), &simulated_name(1));
    assert!(load_log(&log).unwrap().record().answers.len() >= 4);

    let mut harness = simulating(&path);
    assert!(session(&harness).counts().n_answered >= 4, "it goes on");
    wait(&mut harness, "it is done", |h| session(h).step() == Step::Done);
    harness.run_steps(2);
    assert!(says(&harness, studies::DONE) && says(&harness, studies::SIMULATED));
    drop(harness);
    let log = load_log(&log).unwrap();
    assert!(log.header.is_simulated() && log.header.seed() == SEED && log.problems.is_empty());
    assert_eq!(responses(&log), expected(&path));
    // It has moved over each texture, except in a succession, in which the tip moves by itself.
    for answer in log.record().answers {
        let touched_m = answer.measured.touched_m;
        let is_passive = matches!(answer.trial.task, Task::Discriminate { .. });
        assert!(is_passive || touched_m.iter().all(|m| *m >= 1e-3 * TOUCH_MM), "{touched_m:?}");
        assert!(is_passive || answer.measured.motion.is_some_and(|motion| motion.distance_m > 0.0));
    }
}

#[test]
fn a_simulated_staircase_is_that_of_the_simulation() {
    let folder = tempfile::tempdir().unwrap();
    let path = plan_file(folder.path(), STAIRCASE);
    let mut harness = simulating(&path);
    wait(&mut harness, "it is done", |h| session(h).step() == Step::Done);
    leave(&mut harness);
    // Its folder is not remembered: people answer in another one.
    assert_eq!(window(&harness).studies().sessions().len(), 1);
    open(&mut harness, &path);
    assert!(window(&harness).studies().sessions().is_empty());
    drop(harness);
    let log = load_log(&log_path(&usual_simulated_log_folder(&path), &simulated_name(1))).unwrap();
    assert_eq!(responses(&log), expected(&path));
    // The surface disappears after its time; the response time counts from then.
    let secs =
        log.record().answers.iter().filter_map(|answer| answer.measured.response_secs).fold(0.0, f64::max);
    assert!(secs < 60.0, "{secs}");
}
