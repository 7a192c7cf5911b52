use std::fs;

use shagreen_core::people::panel::is_simulated;
use shagreen_formats::study_log::read_study_log;

use super::{ReplacesLogs, Simulation, replace_simulated_logs, simulated_logs, write_simulated_logs};
use crate::study::logs::{list_logs, log_path};
use crate::study::plans::{StudyPlan, template, templates};
use crate::study::session::{LogPlace, NewSession, StudySession};

fn simulate(study: &StudyPlan, n: usize, seed: u64) -> super::SimulatedLogs {
    simulated_logs(study, &Simulation::usual(n, seed), &mut |_, _| true).unwrap()
}

#[test]
fn every_built_in_plan_is_answered_completely_by_participants_who_are_named_simulated() {
    for template in templates().unwrap() {
        let simulated = simulate(&template.study, 2, 1);
        for (name, bytes) in &simulated.logs {
            let log = read_study_log(bytes).unwrap();
            assert!(is_simulated(name) && log.header.is_simulated(), "{}", template.id);
            assert_eq!((log.header.participant(), log.problems.len()), (name.as_str(), 0));
            assert_eq!((log.header.seed(), log.header.plan_text()), (1, template.study.text.as_str()));
        }
        let again = simulate(&template.study, 2, 1);
        assert_eq!(again.logs, simulated.logs, "{}", template.id);
        assert_ne!(simulate(&template.study, 2, 2).logs, simulated.logs);
    }
}

#[test]
fn the_effect_is_the_distance_of_what_is_compared() {
    let world = |id: &str, points: f64| {
        let study = template(id).unwrap().study;
        Simulation { effect_points: Some(points), ..Simulation::usual(1, 5) }.world(&study.plan)
    };
    let ratings = world("bipolar-rating", 30.0);
    for dimension in 0..ratings.dimensions.len() {
        let of_all = || ratings.positions.values().map(|position| position[dimension]);
        let (low, high) =
            (of_all().fold(f64::INFINITY, f64::min), of_all().fold(f64::NEG_INFINITY, f64::max));
        assert!((high - low - 30.0).abs() < 1e-9 && (high + low - 100.0).abs() < 1e-9, "{low} {high}");
    }
    let pairs = world("authored-dissimilarity", 25.0);
    let distance = |a: &str, b: &str| {
        let squares = pairs.positions[a].iter().zip(&pairs.positions[b]).map(|(a, b)| (a - b) * (a - b));
        squares.sum::<f64>().sqrt()
    };
    assert!((distance("cork", "cork-authored") - 25.0).abs() < 1e-9);
    let questionnaire = world("text-to-texture", 60.0);
    let shares = ["txt-t", "txt-ti", "txt-tis"].map(|id| questionnaire.conditions[id]);
    for (share, expected) in shares.into_iter().zip([0.2, 0.5, 0.8]) {
        assert!((share - expected).abs() < 1e-12, "{shares:?}");
    }
}

#[test]
fn simulated_logs_replace_their_like_and_no_log_of_a_person() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let study = template("abx").unwrap().study;
    let new = NewSession {
        plan: &study,
        place: LogPlace::Folder(folder),
        participant: None,
        simulation_seed: None,
    };
    drop(StudySession::begin(&new).unwrap());
    let person = fs::read(log_path(folder, "p01")).unwrap();
    let first = simulate(&study, 3, 1);
    write_simulated_logs(&study, &first, folder).unwrap();
    // Not without being asked.
    let second = simulate(&study, 3, 2);
    let error = write_simulated_logs(&study, &second, folder).unwrap_err();
    let expected = ReplacesLogs { path: log_path(folder, "simulated-01") };
    assert_eq!(error.downcast_ref::<ReplacesLogs>(), Some(&expected), "{error}");
    assert_eq!(fs::read(log_path(folder, "simulated-02")).unwrap(), first.logs[1].1);
    replace_simulated_logs(&study, &second, folder).unwrap();
    assert_eq!(list_logs(folder).unwrap().len(), 4);
    assert_eq!(fs::read(log_path(folder, "p01")).unwrap(), person);
    assert_eq!(fs::read(log_path(folder, "simulated-02")).unwrap(), second.logs[1].1);
    // Fewer participants would leave some of another simulation.
    let error = replace_simulated_logs(&study, &simulate(&study, 2, 3), folder).unwrap_err().to_string();
    assert!(error.contains("further simulated participants") && error.contains("simulated-03"), "{error}");
    let other = template("mushra").unwrap().study;
    let error = write_simulated_logs(&other, &simulate(&other, 3, 1), folder).unwrap_err().to_string();
    assert!(error.contains("another study"), "{error}");
    fs::write(log_path(folder, "simulated-01"), b"notes").unwrap();
    let error = replace_simulated_logs(&study, &second, folder).unwrap_err().to_string();
    assert!(error.contains("not a log"), "{error}");
    assert_eq!(fs::read(log_path(folder, "simulated-01")).unwrap(), b"notes");
}

#[test]
fn a_simulation_can_be_ended() {
    let study = template("abx").unwrap().study;
    let ended = simulated_logs(&study, &Simulation::usual(3, 1), &mut |n_done, _| n_done < 1);
    assert!(ended.unwrap_err().to_string().contains("ended"));
}
