//! What the experimenter sees before a session, and what its log says about devices, consent and its folder.

use std::path::Path;

use shagreen_app::command::Command;
use shagreen_app::strings::{devices, studies};
use shagreen_app::studies::page::SessionState;
use shagreen_core::people::study::answer::Event;
use shagreen_core::people::study::progress::Step;
use shagreen_core::people::study::setup::{ScreenScale, Setup};
use shagreen_studio::study::logs::{load_log, log_path, usual_log_folder};

use super::plans::{RATING, SIMILARITY, plan_text};
use super::{leave, open, plan_file, session, start};
use crate::support::{author, choose, click, enter_path, says, shown, wait, window};
use crate::views::carry_out;

fn events(log: &Path) -> Vec<Event> {
    load_log(log).unwrap().events()
}

fn setups(log: &Path) -> Vec<Setup> {
    let setup = |event| if let Event::SetUp(setup) = event { Some(*setup) } else { None };
    events(log).into_iter().filter_map(setup).collect()
}

/// The start page says plainly what is missing and leads to Devices. The log says the same.
#[test]
fn missing_devices_are_said_before_the_session_and_in_its_log() {
    let folder = tempfile::tempdir().unwrap();
    let path = plan_file(folder.path(), RATING);
    let mut harness = author();
    open(&mut harness, &path);
    for missing in [studies::SILENT_OUTPUT, studies::NO_ACTUATOR, studies::NOT_CALIBRATED] {
        assert!(says(&harness, missing), "{missing}: {:?}", shown(&harness));
    }
    start(&mut harness, studies::START);
    leave(&mut harness);
    let log = |name: &str| log_path(&usual_log_folder(&path), name);
    let first = setups(&log("p01"));
    let [Setup { output: None, actuator: None, masking: None, pen: None, screen, program }] = &first[..]
    else {
        panic!("{first:?}")
    };
    assert!(matches!(screen, ScreenScale::Assumed { pixels_per_mm } if *pixels_per_mm > 1.0), "{screen:?}");
    assert!(program.contains("hagreen"), "{program}");

    click(&mut harness, studies::OPEN_DEVICES);
    wait(&mut harness, "the sheet opens", |h| says(h, devices::TITLE));
    choose(&mut harness, devices::ACTUATOR, "Haptuator Mark II-D");
    wait(&mut harness, "it is taken over", |h| window(h).session().rig().actuator().is_some());
    wait(&mut harness, "the output is open again", |h| window(h).session().status().is_some());
    click(&mut harness, devices::CLOSE);
    harness.run_steps(4);
    assert!(
        says(&harness, &studies::actuator("Haptuator Mark II-D")) && !says(&harness, studies::NO_ACTUATOR)
    );
    start(&mut harness, studies::START);
    let id = window(&harness).session().rig().actuator().unwrap().id.clone();
    leave(&mut harness);
    let second = setups(&log("p02"));
    assert!(
        !second.is_empty() && second.iter().all(|setup| setup.actuator.as_ref() == Some(&id)),
        "{second:?}"
    );
}

/// A mute outlasts the start of a session, in which no button ends it.
#[test]
fn a_muted_output_is_said_before_the_session() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = author();
    open(&mut harness, &plan_file(folder.path(), SIMILARITY));
    assert!(!says(&harness, studies::OUTPUT_MUTED));
    carry_out(&mut harness, Command::ToggleMute);
    assert!(says(&harness, studies::OUTPUT_MUTED), "{:?}", shown(&harness));
    carry_out(&mut harness, Command::ToggleMute);
    assert!(!says(&harness, studies::OUTPUT_MUTED));
}

/// A refusal is in the log at once, and nothing else is. The next participant has another pseudonym and the same orders.
#[test]
fn who_does_not_agree_is_logged_at_once_and_asked_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = plan_file(folder.path(), SIMILARITY);
    let log = log_path(&usual_log_folder(&path), "p01");
    let mut harness = author();
    open(&mut harness, &path);
    start(&mut harness, studies::START);
    click(&mut harness, studies::DISAGREE);
    assert_eq!(events(&log).last(), Some(&Event::Refused));
    assert_eq!(session(&harness).step(), Step::Done);
    assert!(says(&harness, studies::REFUSED) && says(&harness, studies::REFUSED_HELP));
    click(&mut harness, studies::CLOSE);
    wait(&mut harness, "the session is left", |h| window(h).studies().running().is_none());
    wait(&mut harness, "the sessions are listed", |h| !window(h).studies().is_busy());
    harness.run_steps(2);
    let listed = &window(&harness).studies().sessions()[0];
    assert!(
        listed.state == SessionState::Refused && listed.n_answers == 0 && !listed.can_resume(),
        "{listed:?}"
    );
    assert!(says(&harness, studies::REFUSED_LOG));
    let others = events(&log).into_iter().filter(|event| !matches!(event, Event::SetUp(_) | Event::Refused));
    assert_eq!(others.count(), 0);
    start(&mut harness, studies::START);
    assert_eq!((session(&harness).participant(), session(&harness).number()), ("p02", 1));
    // To leave before the first answer is no refusal.
    click(&mut harness, studies::LEAVE);
    assert!(says(&harness, studies::LEAVE_BEFORE));
    click(&mut harness, studies::LEAVE_NOW);
    wait(&mut harness, "the session is left", |h| window(h).studies().running().is_none());
    wait(&mut harness, "the sessions are listed", |h| !window(h).studies().is_busy());
    assert!(window(&harness).studies().sessions()[1].can_resume());
}

/// After a change of the plan, one click leads to a folder in which sessions can begin. It is remembered for the plan.
#[test]
fn a_changed_plan_gets_a_new_folder_in_one_click() {
    let folder = tempfile::tempdir().unwrap();
    let path = plan_file(folder.path(), SIMILARITY);
    let mut harness = author();
    open(&mut harness, &path);
    start(&mut harness, studies::START);
    leave(&mut harness);
    assert!(!says(&harness, studies::OTHER_PLAN_HERE));
    std::fs::write(&path, plan_text(&SIMILARITY.replace("points = 5", "points = 7"))).unwrap();
    click(&mut harness, studies::READ_AGAIN);
    wait(&mut harness, "it is read", |h| !window(h).studies().is_busy());
    harness.run_steps(2);
    assert!(says(&harness, studies::OTHER_PLAN_HERE), "{:?}", shown(&harness));
    click(&mut harness, studies::START);
    wait(&mut harness, "it is refused", |h| says(h, "choose another folder for the logs"));
    click(&mut harness, studies::NEW_FOLDER);
    wait(&mut harness, "the sessions are listed", |h| !window(h).studies().is_busy());
    harness.run_steps(2);
    assert!(!says(&harness, studies::OTHER_PLAN_HERE) && window(&harness).studies().sessions().is_empty());
    start(&mut harness, studies::START);
    assert_eq!(session(&harness).participant(), "p01", "its own first participant");
    leave(&mut harness);
    let new = folder.path().join("plan-logs-2");
    assert!(log_path(&new, "p01").is_file() && log_path(&usual_log_folder(&path), "p01").is_file());
    open(&mut harness, &path);
    assert_eq!(window(&harness).studies().sessions()[0].path, log_path(&new, "p01"));
}

/// The folder of the logs can be typed.
#[test]
fn logs_are_saved_in_the_folder_that_is_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let path = plan_file(folder.path(), SIMILARITY);
    let mut harness = author();
    open(&mut harness, &path);
    let chosen = folder.path().join("elsewhere");
    enter_path(&mut harness, studies::LOGS, &chosen);
    start(&mut harness, studies::START);
    leave(&mut harness);
    assert!(log_path(&chosen, "p01").is_file() && !usual_log_folder(&path).exists());
    assert_eq!(window(&harness).studies().sessions().len(), 1);
}
