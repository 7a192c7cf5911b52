//! What the logs of sessions say about their answers: damaged first lines, refusals, devices, touches.

use std::fs;
use std::path::Path;

use shagreen_core::people::study::analysis::limits::Limit;
use shagreen_core::people::study::answer::{Measured, Motion, Response};
use shagreen_core::people::study::setup::{OutputDevice, ScreenScale, Setup};

use super::{analyzed, assert_warned, study, write};
use crate::study::analysis::{ParticipantKind, analyze, read_logs, read_logs_with, report_files};
use crate::study::logs::log_path;
use crate::study::session::{LogPlace, NewSession, StudySession};
use crate::study::simulation::Simulation;

/// Removes the first line and its copy, as a damaged disk does.
fn behead(path: &Path) {
    let text = fs::read_to_string(path).unwrap();
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    fs::write(path, ["\0\0\0\n", "\0\0\0\n", &lines[2..].concat()].concat()).unwrap();
}

#[test]
fn answers_of_a_log_without_its_first_line_count() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("anchor-rating");
    write(&plan, &Simulation::usual(4, 1), folder.path());
    let whole = analyzed(folder.path());
    let path = log_path(folder.path(), "simulated-03");
    behead(&path);
    // With the plan of the other logs.
    let report = analyzed(folder.path());
    assert_eq!((report.n_participants, report.n_complete), (4, 4));
    assert_eq!(report.json["results"], whole.json["results"]);
    let words = "simulated-03.jsonl, line 1: it is damaged; the answers are read with the plan of the study as those of participant 3";
    assert_warned(&report, words);
    // Alone, it needs the plan file.
    let error = format!("{:#}", read_logs(std::slice::from_ref(&path)).unwrap_err());
    assert!(error.contains("simulated-03.jsonl"), "{error}");
    let logs = read_logs_with(std::slice::from_ref(&path), Some(&plan)).unwrap();
    let report = analyze(&logs, None).unwrap();
    assert_eq!((report.n_participants, report.json["participants"][0]["number"].as_u64()), (1, Some(3)));
    // Another plan does not fit.
    assert!(read_logs_with(std::slice::from_ref(&path), Some(&study("abx"))).is_err());
}

/// A folder in which a person took part, another refused, and a third has not decided.
#[test]
fn refusals_are_counted_and_no_missing_answers() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("anchor-rating");
    let new = NewSession {
        plan: &plan,
        place: LogPlace::Folder(folder.path()),
        participant: None,
        simulation_seed: None,
    };
    StudySession::begin(&new).unwrap().refuse().unwrap();
    let logs = read_logs(&[folder.path().to_owned()]).unwrap();
    assert_eq!((logs.counts(), logs.n_refused(ParticipantKind::People)), ([0, 0], 1));
    let error = analyze(&logs, None).unwrap_err().to_string();
    assert!(error.contains("1 participant did not agree to the consent text"), "{error}");
    let mut session = StudySession::begin(&new).unwrap();
    session.consent().unwrap();
    session.answer(Response::Sliders(vec![50.0]), Measured::default()).unwrap();
    drop(session);
    let report = analyzed(folder.path());
    assert_eq!((report.n_participants, report.n_refused), (1, 1));
    assert_eq!(report.json["n_refused"].as_u64(), Some(1));
    assert!(report.who().ends_with("; 1 participant did not agree to the consent text"), "{}", report.who());
    assert!(!report.warnings.iter().any(|warning| warning.contains("p01.jsonl")), "{:?}", report.warnings);
}

/// A person answers three trials on a silent output, without profile, masking noise, calibration and touch, and two trials as
/// planned.
#[test]
fn conditions_that_limit_the_answers_are_warnings_with_counts() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("bipolar-rating");
    let new = NewSession {
        plan: &plan,
        place: LogPlace::Folder(folder.path()),
        participant: None,
        simulation_seed: None,
    };
    let mut session = StudySession::begin(&new).unwrap();
    let bad = Setup {
        output: None,
        actuator: None,
        masking: None,
        pen: None,
        screen: ScreenScale::Assumed { pixels_per_mm: 3.8 },
        program: String::new(),
    };
    let good = Setup {
        output: Some(OutputDevice { id: "usb".to_owned(), name: "USB Audio".to_owned() }),
        actuator: Some("mark-ii".to_owned()),
        masking: Some("Headphones".to_owned()),
        screen: ScreenScale::Measured { pixels_per_mm: 5.0 },
        ..bad.clone()
    };
    let touched = Measured {
        motion: Some(Motion { distance_m: 0.5, mean_speed_mps: 0.125, mean_force_n: 1.0 }),
        touched_m: vec![0.5],
        ..Measured::default()
    };
    session.consent().unwrap();
    // Two trials of practice, which do not count, come first.
    for (setup, measured, n) in [(&bad, Measured::default(), 5), (&good, touched, 2)] {
        session.set_up(setup).unwrap();
        for _ in 0..n {
            session.answer(Response::Sliders(vec![50.0; 5]), measured.clone()).unwrap();
        }
    }
    drop(session);
    let report = analyzed(folder.path());
    let limits: Vec<(Limit, usize)> = report.limited.iter().map(|of| (of.limit, of.n_answers)).collect();
    let expected = [Limit::Silent, Limit::NoActuator, Limit::NoMasking, Limit::AssumedScale, Limit::NoTouch];
    assert_eq!(limits, expected.map(|limit| (limit, 3)));
    for words in [
        "the output was silent: nothing was felt (3 answers of 1 participant)",
        "no actuator profile was selected",
        "but no output played it",
        "the screen was not calibrated",
        "answered without a touch (distance 0) (3 answers of 1 participant)",
        "the participants agreed to the placeholder of the consent text",
    ] {
        assert_warned(&report, words);
    }
    assert_eq!(report.json["limits"]["silent_output"]["answers"].as_u64(), Some(3));
    let files = report_files(&report, Path::new("out"));
    let bytes = |name: &str| &files.iter().find(|(path, _)| path.ends_with(name)).unwrap().1;
    let page = String::from_utf8_lossy(bytes("report.svg"));
    assert!(page.contains("silent output") && page.contains("answered without touch"));
    let answers = String::from_utf8_lossy(bytes("answers.csv"));
    let with = |output: &str| answers.lines().filter(|line| line.contains(output)).count();
    // Five values for each trial.
    assert_eq!(
        (
            with(",no output,none,none,pointer,assumed,"),
            with(",USB Audio,mark-ii,Headphones,pointer,measured,")
        ),
        (25, 10)
    );
}

/// Logs of earlier versions do not state the devices.
#[test]
fn unknown_devices_and_simulated_participants_are_named() {
    let folder = tempfile::tempdir().unwrap();
    write(&study("abx"), &Simulation::usual(2, 1), folder.path());
    let report = analyzed(folder.path());
    assert_eq!((report.limited.len(), report.limited[0].limit), (1, Limit::Simulated));
    assert!(
        report.warnings[0].contains("SIMULATED")
            && report.warnings[0].contains("96 answers of 2 participants"),
        "{:?}",
        report.warnings
    );
    // The log of a person of an earlier version, with the answers of a simulated participant.
    let text = fs::read_to_string(log_path(folder.path(), "simulated-01")).unwrap();
    let person =
        text.replace("\"simulated-01\"", "\"p01\"").replace("\"simulated\":true", "\"simulated\":false");
    fs::write(log_path(folder.path(), "p01"), person).unwrap();
    let logs = read_logs(&[folder.path().to_owned()]).unwrap();
    let report = analyze(&logs, Some(ParticipantKind::People)).unwrap();
    let limits: Vec<Limit> = report.limited.iter().map(|of| of.limit).collect();
    assert_eq!(limits, [Limit::UnknownDevices]);
}

#[test]
fn same_different_pairs_are_a_file_of_the_report() {
    let folder = tempfile::tempdir().unwrap();
    write(&study("same-different"), &Simulation::usual(2, 1), folder.path());
    let report = analyzed(folder.path());
    let files = report_files(&report, folder.path());
    let (_, pairs) = files.iter().find(|(path, _)| path.ends_with("pairs.csv")).unwrap();
    let text = String::from_utf8_lossy(pairs);
    assert_eq!(text.lines().count(), 1 + 25);
    let second = text.lines().nth(1).unwrap();
    assert!(
        second.starts_with("steel,steel,steel-3.15,polished-metal,polished-metal,coded,3.15,,1,2,36,"),
        "{second}"
    );
    let json = &report.json["results"]["steel"]["pairs"]["steel|steel-3.15"];
    assert!(second.contains(&format!(",{},", json["dprime"])), "{second}: {json}");
}
