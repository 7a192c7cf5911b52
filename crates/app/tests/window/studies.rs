//! The Studies workspace: plans, sessions over the whole window, their logs and results.

mod designs;
mod faults;
mod keyboard;
pub(crate) mod plans;
mod setup;
mod simulated;
mod touch;

use std::path::{Path, PathBuf};

use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use shagreen_app::command::{Command, FileCommand};
use shagreen_app::strings::{build, studies};
use shagreen_app::workspace::Workspace;
use shagreen_core::people::panel::simulated_name;
use shagreen_core::people::study::progress::Step;
use shagreen_studio::study::logs::usual_log_folder;
use shagreen_studio::study::plans::load_plan;
use shagreen_studio::study::session::StudySession;
use shagreen_studio::study::simulation::{Simulation, simulated_logs, write_simulated_logs};

use self::plans::{RATING, plan_text};
use crate::support::{
    Author, author, click, drop_files, says, shown, unnamed_controls, wait, window, write_into,
};
use crate::views::carry_out;

/// Writes a plan with these parts into a folder.
pub(crate) fn plan_file(folder: &Path, parts: &str) -> PathBuf {
    let path = folder.join("plan.toml");
    std::fs::write(&path, plan_text(parts)).unwrap();
    path
}

/// Opens a plan in the window, as the command line and the file dialog do.
pub(crate) fn open(harness: &mut Author, path: &Path) {
    carry_out(harness, Command::File(FileCommand::Open(path.to_owned())));
    wait(harness, "the plan is read", |h| !window(h).studies().is_busy());
    harness.run_steps(2);
    assert_eq!(window(harness).workspace(), Workspace::Studies);
}

/// Presses a button by its name and waits until a session runs.
pub(crate) fn start(harness: &mut Author, button: &str) {
    harness.get_by_label(button).click_accesskit();
    wait(harness, "the session runs", |h| window(h).studies().running().is_some());
    harness.run_steps(2);
}

/// The session that runs.
pub(crate) fn session(harness: &Author) -> &StudySession {
    window(harness).studies().running().expect("a session runs")
}

/// Goes past the pages of text up to the next trial; returns whether there is one.
pub(crate) fn go_to_trial(harness: &mut Author) -> bool {
    loop {
        let page = [studies::AGREE, studies::CONTINUE, studies::BEGIN]
            .into_iter()
            .find(|button| harness.query_by_label(button).is_some());
        match page {
            Some(button) => click(harness, button),
            None if session(harness).step() == Step::Done => return false,
            None if harness.query_by_label(studies::SURFACE).is_some() => return true,
            None => harness.step(),
        }
    }
}

/// Labels of the stimuli over which the participant still has to move, as the screen says.
pub(crate) fn still_to_feel(harness: &Author) -> Vec<String> {
    let said = shown(harness).into_iter().find(|text| text.starts_with(studies::TOUCH_EACH));
    let labels = said.as_deref().and_then(|text| text.rsplit_once(": "));
    let labels = labels.map_or("", |(_, labels)| labels.trim_end_matches('.'));
    labels.split(", ").filter(|label| !label.is_empty()).map(str::to_owned).collect()
}

/// Whether the participant still has to move over something.
pub(crate) fn has_to_feel(harness: &Author) -> bool {
    let said = [studies::TOUCH_ONE, studies::TOUCH_BOTH, studies::TOUCH_EACH];
    said.into_iter().any(|text| says(harness, text))
}

/// Waits until the automatic stroke has moved over a stimulus.
pub(crate) fn wait_until_felt(harness: &mut Author, label: &str) {
    wait(harness, "it is felt", |h| !still_to_feel(h).iter().any(|left| left == label));
}

/// Lets the automatic stroke run, starts every stimulus that does not start by itself, and waits until each was felt.
pub(crate) fn feel_all(harness: &mut Author) {
    let Step::Trial(trial) = session(harness).step() else { panic!("a trial") };
    if harness.query_by_label(studies::STROKE_START).is_some() {
        click(harness, studies::STROKE_START);
    }
    let shown = trial.task.shown();
    let has_buttons = shown.len() > 1
        && shown.iter().all(|shown| harness.query_by_label(&studies::play(&shown.label)).is_some());
    if has_buttons {
        for shown in shown {
            click(harness, &studies::play(&shown.label));
            wait_until_felt(harness, &shown.label);
        }
    }
    wait(harness, "all is felt", |h| !has_to_feel(h));
}

/// Leaves a session that is over or not.
pub(crate) fn leave(harness: &mut Author) {
    let is_over = session(harness).step() == Step::Done;
    if is_over {
        wait(harness, "the last page is shown", |h| says(h, studies::DONE));
        click(harness, studies::CLOSE);
    } else {
        click(harness, studies::LEAVE);
        click(harness, studies::LEAVE_NOW);
    }
    wait(harness, "the session is left", |h| window(h).studies().running().is_none());
    wait(harness, "the sessions are listed", |h| !window(h).studies().is_busy());
    harness.run_steps(2);
}

#[test]
fn a_built_in_plan_is_previewed_and_its_problems_are_none() {
    let mut harness = author();
    click(&mut harness, Workspace::Studies.info().name);
    assert!(says(&harness, studies::EMPTY_TITLE));
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, &studies::template(&studies::template_title("cluster-sorting")));
    wait(&mut harness, "the plan is read", |h| window(h).studies().has_plan());
    harness.run_steps(2);
    assert!(says(&harness, "Cluster sorting") && says(&harness, "3 trials"), "{:?}", shown(&harness));
    assert!(says(&harness, "sort into") && says(&harness, studies::MASKING_MISSING));
    assert!(says(&harness, studies::SILENT_OUTPUT), "the experimenter learns that nothing is felt");
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
}

#[test]
fn problems_of_a_plan_are_named_with_their_lines() {
    let folder = tempfile::tempdir().unwrap();
    let path =
        plan_file(folder.path(), &RATING.replace("stimuli = [\"a\", \"b\"]", "stimuli = [\"a\", \"z\"]"));
    let mut harness = author();
    open(&mut harness, &path);
    let problems = window(&harness).studies().problems().to_vec();
    assert!(
        !problems.is_empty() && problems.iter().all(|problem| problem.starts_with("line ")),
        "{problems:?}"
    );
    assert!(says(&harness, &problems[0]) && !window(&harness).studies().has_plan());
    // Corrected in an editor, and read again.
    std::fs::write(&path, plan_text(RATING)).unwrap();
    click(&mut harness, studies::READ_AGAIN);
    wait(&mut harness, "the plan is read", |h| window(h).studies().has_plan());
    assert!(window(&harness).studies().problems().is_empty());
}

#[test]
fn a_dropped_plan_opens_here_from_any_workspace() {
    let mut harness = author();
    drop_files(&mut harness, &[("study.toml", plan_text(RATING).as_bytes())]);
    assert_eq!(window(&harness).workspace(), Workspace::Studies);
    wait(&mut harness, "the plan is read", |h| window(h).studies().has_plan());
    drop_files(&mut harness, &[("other.toml", b"format = \"shagreen-actuator\"\nversion = \"1.0\"\n")]);
    wait(&mut harness, "it is refused", |h| !window(h).studies().problems().is_empty());
    assert!(window(&harness).studies().problems()[0].contains("not a plan"), "{:?}", shown(&harness));
}

/// Three clicks: the workspace, the study, and its start. Its consent text is a placeholder, which the experimenter has to
/// confirm.
#[test]
fn the_authored_textures_of_a_project_are_a_study_in_three_clicks() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = author();
    click(&mut harness, Workspace::Studies.info().name);
    click(&mut harness, studies::RATE_PROJECT);
    wait(&mut harness, "the plan is made", |h| window(h).studies().has_plan());
    harness.run_steps(2);
    // The plan would be saved in the current folder; a test has a folder of its own.
    let path = folder.path().join("mine.toml");
    write_into(&mut harness, studies::SAVED_TO, &path.display().to_string());
    assert!(says(&harness, studies::PLACEHOLDER_CONSENT));
    for answer in [studies::CANCEL, studies::START_ANYWAY] {
        harness.get_by_label(studies::START).click_accesskit();
        harness.run_steps(2);
        assert!(says(&harness, studies::PLACEHOLDER_QUESTION) && !window(&harness).studies().is_busy());
        harness.get_by_label(answer).click_accesskit();
        harness.run_steps(2);
    }
    wait(&mut harness, "the session runs", |h| window(h).studies().running().is_some());
    harness.run_steps(2);
    assert_eq!(session(&harness).participant(), "p01");
    assert_eq!(load_plan(&path).unwrap().plan.stimuli.len(), 1);
    leave(&mut harness);
    assert_eq!(window(&harness).studies().sessions().len(), 1);
    assert!(usual_log_folder(&path).join("p01.jsonl").is_file());
}

#[test]
fn the_measured_scale_of_the_screen_is_remembered() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = author();
    open(&mut harness, &plan_file(folder.path(), RATING));
    assert!(says(&harness, studies::NOT_CALIBRATED));
    harness.get_by_label(studies::CALIBRATE).click_accesskit();
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::Slider, studies::CARD_WIDTH).set_value_accesskit(428.0);
    harness.run_steps(2);
    click(&mut harness, studies::SAVE_SCALE);
    harness.run_steps(2);
    // 428 points at one pixel a point are 85.6 mm.
    assert!(says(&harness, "5.00 pixels per mm"), "{:?}", shown(&harness));
    start(&mut harness, studies::START);
    assert!(go_to_trial(&mut harness));
    let line = harness.get_by_role_and_label(Role::Slider, &studies::between("rough", "smooth")).rect();
    // 127 mm, and a margin at both ends that takes the pointer.
    assert!((line.width() - 635.0 - 20.0).abs() < 2.0, "{}", line.width());
}

/// Results say whether people answered, are never mixed, and become judgments for Build and files.
#[test]
fn results_are_shown_saved_and_handed_to_build() {
    let folder = tempfile::tempdir().unwrap();
    let path = plan_file(folder.path(), RATING);
    let study = load_plan(&path).unwrap();
    let simulated = simulated_logs(&study, &Simulation::usual(4, 1), &mut |_, _| true).unwrap();
    write_simulated_logs(&study, &simulated, &usual_log_folder(&path)).unwrap();
    let mut harness = author();
    open(&mut harness, &path);
    assert_eq!(window(&harness).studies().sessions().len(), 4);
    assert!(says(&harness, &simulated_name(1)) && says(&harness, studies::SIMULATED_LOG));
    harness.get_by_label(studies::ANALYZE).click_accesskit();
    wait(&mut harness, "it is analyzed", |h| window(h).studies().report().is_some());
    harness.run_steps(2);
    assert!(says(&harness, "SIMULATED"), "{:?}", shown(&harness));
    let report = window(&harness).studies().report().unwrap().clone();
    assert_eq!((report.n_participants, report.n_complete), (4, 4));
    assert!(report.parts[0].findings.iter().all(|finding| says(&harness, finding)));

    click(&mut harness, studies::SAVE_REPORT);
    wait(&mut harness, "it is saved", |h| !window(h).studies().is_busy());
    harness.run_steps(2);
    let saved = folder.path().join("plan-report");
    for file in ["report.json", "answers.csv", "ratings.csv"] {
        assert!(saved.join(file).is_file(), "{file}: {:?}", shown(&harness));
    }

    click(&mut harness, studies::USE_IN_BUILD);
    assert_eq!(window(&harness).workspace(), Workspace::Build);
    let judgments = window(&harness).build().judgments();
    assert_eq!(judgments.ratings.values(), report.judgments.ratings);
    assert!(judgments.sorting.read.is_none() && !judgments.are_people());
    assert!(says(&harness, &studies::judgments_of("Test")) && says(&harness, build::BUILD_SPACE));
}
