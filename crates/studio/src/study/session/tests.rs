use std::fs;
use std::io::Write as _;
use std::path::Path;

use shagreen_core::people::study::answer::{Event, Measured, Response};
use shagreen_core::people::study::progress::Step;
use shagreen_core::people::study::setup::{OutputDevice, ScreenScale, Setup};
use shagreen_core::people::study::simulated::{Observers, SimulatedParticipant, World};
use shagreen_core::people::study::trial::{Side, Task};
use shagreen_formats::study_log::{LogError, StudyLog};

use super::{LogPlace, NewSession, SessionError, StudySession};
use crate::study::logs::{load_log, log_path};
use crate::study::plans::{StudyPlan, template};

fn study(id: &str) -> StudyPlan {
    template(id).unwrap().study
}

fn new<'a>(plan: &'a StudyPlan, folder: &'a Path) -> NewSession<'a> {
    NewSession { plan, place: LogPlace::Folder(folder), participant: None, simulation_seed: None }
}

/// Answers up to `most` trials as a simulated participant does; returns how many.
fn answer(session: &mut StudySession, most: usize) -> usize {
    let plan = session.plan().clone();
    let world = World::invented(&plan, 3);
    let mut participant = SimulatedParticipant::new(&plan, &world, Observers::usual(), 1, 1).unwrap();
    let mut n_answers = 0;
    while n_answers < most {
        match session.step() {
            Step::Consent => session.consent().unwrap(),
            Step::Break => session.rest().unwrap(),
            Step::Trial(trial) => {
                let answer = participant.answer(trial);
                session.answer(answer.response, answer.measured).unwrap();
                n_answers += 1;
            }
            Step::Done => break,
        }
    }
    n_answers
}

#[test]
fn a_session_runs_to_its_end_and_every_answer_is_in_its_log() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("anchor-rating");
    let mut session = StudySession::begin(&new(&plan, folder.path())).unwrap();
    assert_eq!((session.participant(), session.number(), session.is_simulated()), ("p01", 1, false));
    assert_eq!(session.step(), Step::Consent);
    assert_eq!(session.counts().n_trials, Some(18));
    assert_eq!(answer(&mut session, usize::MAX), 18);
    assert_eq!((session.step(), session.counts().n_answered), (Step::Done, 18));
    session.end().unwrap();
    session.end().unwrap();
    let path = session.log_path().unwrap();
    drop(session);
    assert_eq!(path, log_path(folder.path(), "p01"));
    let log = load_log(&path).unwrap();
    assert_eq!((log.record().answers.len(), log.problems.len()), (18, 0));
    // The header and its copy, consent, a break, the answers, the end.
    assert_eq!(fs::read_to_string(&path).unwrap().lines().count(), 2 + 1 + 1 + 18 + 1);
    // A session that is over can be opened again, and adds nothing.
    let again = StudySession::resume(&path).unwrap();
    assert_eq!((again.step(), again.counts().n_answered), (Step::Done, 18));
    assert_eq!(load_log(&path).unwrap().events.len(), log.events.len());
}

#[test]
fn a_session_resumes_at_its_first_open_trial() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("gap-detection");
    let mut session = StudySession::begin(&new(&plan, folder.path())).unwrap();
    assert_eq!(session.counts().n_trials, None);
    answer(&mut session, 7);
    let (step, path) = (session.step(), session.log_path().unwrap());
    drop(session);
    // The program ends while it writes the last line.
    let whole = fs::read(&path).unwrap();
    fs::write(&path, &whole[..whole.len() - 20]).unwrap();
    let mut session = StudySession::resume(&path).unwrap();
    assert_eq!(session.counts().n_answered, 6);
    assert!(session.warnings()[0].contains("p01.jsonl, line 10: it is torn"), "{:?}", session.warnings());
    assert_ne!(session.step(), step);
    answer(&mut session, 1);
    assert_eq!(session.counts().n_answered, 7);
    assert!(fs::read(&path).unwrap().starts_with(&whole[..whole.len() - 20]), "nothing is removed");
    drop(session);
    answer(&mut StudySession::resume(&path).unwrap(), usize::MAX);
    assert_eq!(StudySession::resume(&path).unwrap().step(), Step::Done);
}

#[test]
fn two_sessions_cannot_use_one_log() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("abx");
    let session = StudySession::begin(&new(&plan, folder.path())).unwrap();
    let path = session.log_path().unwrap();
    let error = StudySession::resume(&path).unwrap_err();
    assert!(matches!(error.downcast_ref::<LogError>(), Some(LogError::InUse { .. })), "{error}");
    let named = NewSession { participant: Some("p01"), ..new(&plan, folder.path()) };
    let error = StudySession::begin(&named).unwrap_err();
    assert!(matches!(error.downcast_ref::<LogError>(), Some(LogError::Exists { .. })), "{error}");
    // A second participant gets the next number, and simulated ones have numbers of their own.
    let second = StudySession::begin(&new(&plan, folder.path())).unwrap();
    assert_eq!((second.participant(), second.number()), ("p02", 2));
    let simulated = NewSession { simulation_seed: Some(1), ..new(&plan, folder.path()) };
    let third = StudySession::begin(&simulated).unwrap();
    assert_eq!((third.participant(), third.number(), third.is_simulated()), ("simulated-01", 1, true));
}

#[test]
fn names_of_people_and_logs_of_other_plans_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("abx");
    let error = |new: &NewSession<'_>| StudySession::begin(new).unwrap_err().to_string();
    let ada = NewSession { participant: Some("Ada Lovelace"), ..new(&plan, folder.path()) };
    assert!(error(&ada).contains("is not a pseudonym"));
    let simulated = NewSession { participant: Some("p01"), simulation_seed: Some(1), ..ada };
    assert!(error(&simulated).contains("contains \"simulated\" exactly if"));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "a refused session leaves no log");
    drop(StudySession::begin(&new(&plan, folder.path())).unwrap());
    let other = study("anchor-rating");
    assert!(error(&new(&other, folder.path())).contains("the log of another study"));
}

#[test]
fn a_file_that_is_no_log_keeps_its_name() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(log_path(folder.path(), "p01"), b"notes").unwrap();
    let plan = study("abx");
    let session = StudySession::begin(&new(&plan, folder.path())).unwrap();
    assert_eq!((session.participant(), session.number()), ("p02", 2));
    assert_eq!(fs::read(log_path(folder.path(), "p01")).unwrap(), b"notes");
    let path = folder.path().join("by-hand/first.jsonl");
    let chosen = NewSession { place: LogPlace::File(&path), ..new(&plan, folder.path()) };
    assert_eq!(StudySession::begin(&chosen).unwrap().log_path(), Some(path));
}

#[test]
fn a_response_that_does_not_fit_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("anchor-rating");
    let mut session = StudySession::begin(&new(&plan, folder.path())).unwrap();
    let slider = |value: f64| Response::Sliders(vec![value]);
    let error = session.answer(slider(50.0), Measured::default()).unwrap_err();
    assert!(matches!(error, SessionError::NoTrial), "{error}");
    session.consent().unwrap();
    let before = session.step();
    for response in [Response::Grade(1), slider(101.0)] {
        let error = session.answer(response, Measured::default()).unwrap_err();
        assert!(matches!(error, SessionError::Response(_)), "{error}");
    }
    assert_eq!((session.step(), session.counts().n_answered), (before, 0));
    assert_eq!(session.answer(slider(50.0), Measured::default()).unwrap(), None);
}

fn setup(output: Option<&str>) -> Setup {
    Setup {
        output: output.map(|id| OutputDevice { id: id.to_owned(), name: id.to_uppercase() }),
        actuator: None,
        masking: None,
        pen: None,
        screen: ScreenScale::Assumed { pixels_per_mm: 3.8 },
        program: String::new(),
    }
}

/// Devices are stated once, and again after a change or a resume.
#[test]
fn the_log_states_the_devices_of_every_answer() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("anchor-rating");
    let mut session = StudySession::begin(&new(&plan, folder.path())).unwrap();
    session.set_up(&setup(Some("usb"))).unwrap();
    session.set_up(&setup(Some("usb"))).unwrap();
    assert_eq!(session.step(), Step::Consent, "the setup is no step");
    answer(&mut session, 3);
    session.set_up(&setup(None)).unwrap();
    answer(&mut session, 2);
    let path = session.log_path().unwrap();
    drop(session);
    let mut session = StudySession::resume(&path).unwrap();
    answer(&mut session, 1);
    session.set_up(&setup(None)).unwrap();
    answer(&mut session, usize::MAX);
    session.end().unwrap();
    session.set_up(&setup(Some("usb"))).unwrap();
    let log = load_log(&path).unwrap();
    let is_setup = |event: &&Event| matches!(event, Event::SetUp(_));
    assert_eq!((log.events().iter().filter(is_setup).count(), log.problems.len()), (3, 0));
    let record = log.record();
    let outputs: Vec<Option<Option<&str>>> = (0..8)
        .map(|index| {
            record.setup_at(index).map(|setup| setup.output.as_ref().map(|output| output.name.as_str()))
        })
        .collect();
    let [usb, silent] = [Some(Some("USB")), Some(None)];
    assert_eq!(outputs, [usb, usb, usb, silent, silent, None, silent, silent]);
    assert!(record.setup_at(0).unwrap().program.starts_with("shagreen "));
    // Practice alone has no log, and needs none.
    StudySession::practice(&plan, 1).unwrap().set_up(&setup(None)).unwrap();
}

#[test]
fn a_refusal_is_in_the_log_at_once_and_nothing_follows() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("anchor-rating");
    let mut session = StudySession::begin(&new(&plan, folder.path())).unwrap();
    session.set_up(&setup(Some("usb"))).unwrap();
    session.refuse().unwrap();
    let path = session.log_path().unwrap();
    let refused = fs::read(&path).unwrap();
    assert!(String::from_utf8_lossy(&refused).lines().last().unwrap().starts_with("{\"event\":\"refuse\""));
    assert_eq!((session.step(), session.has_refused(), session.place()), (Step::Done, true, None));
    let error = session.answer(Response::Sliders(vec![50.0]), Measured::default()).unwrap_err();
    assert!(matches!(error, SessionError::NoTrial), "{error}");
    assert!(matches!(session.refuse(), Err(SessionError::NoConsent)));
    session.end().unwrap();
    session.set_up(&setup(None)).unwrap();
    drop(session);
    let again = StudySession::resume(&path).unwrap();
    assert_eq!((again.step(), again.has_refused()), (Step::Done, true));
    drop(again);
    assert_eq!(fs::read(&path).unwrap(), refused, "nothing follows");
    // Who has agreed cannot refuse any more, but leave at any time.
    let mut second = StudySession::begin(&new(&plan, folder.path())).unwrap();
    assert_eq!((second.participant(), second.number()), ("p02", 1));
    second.consent().unwrap();
    assert!(matches!(second.refuse(), Err(SessionError::NoConsent)));
}

/// Nobody has met the orders of a participant who refused: the next one does, under another pseudonym.
#[test]
fn the_orders_of_a_refusal_are_used_again() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("anchor-rating");
    let begun = |refuses: bool| {
        let mut session = StudySession::begin(&new(&plan, folder.path())).unwrap();
        let decided = if refuses { session.refuse() } else { session.consent() };
        decided.unwrap();
        (session.participant().to_owned(), session.number())
    };
    let expected =
        [("p01", 1, false), ("p02", 2, true), ("p03", 2, false), ("p04", 3, true), ("p05", 3, true)];
    for (name, number, refuses) in expected.into_iter().chain([("p06", 3, false), ("p07", 4, false)]) {
        assert_eq!(begun(refuses), (name.to_owned(), number));
    }
}

/// A name that is taken, but not by a file that is listed, ends nothing.
#[test]
fn a_folder_with_the_name_of_a_log_is_passed_over() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(log_path(folder.path(), "p01")).unwrap();
    let session = StudySession::begin(&new(&study("abx"), folder.path())).unwrap();
    assert_eq!((session.participant(), session.number()), ("p02", 1));
}

/// The copy of the first line serves a session too, not only the analysis.
#[test]
fn a_session_goes_on_although_its_first_line_is_damaged() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("anchor-rating");
    let mut session = StudySession::begin(&new(&plan, folder.path())).unwrap();
    answer(&mut session, 4);
    let (step, path) = (session.step(), session.log_path().unwrap());
    drop(session);
    let mut bytes = fs::read(&path).unwrap();
    bytes[..200].fill(0);
    fs::write(&path, &bytes).unwrap();
    let mut session = StudySession::resume(&path).unwrap();
    assert_eq!((session.participant(), session.number(), session.step()), ("p01", 1, step));
    assert!(session.warnings()[0].contains("p01.jsonl, line 1: it is damaged"), "{:?}", session.warnings());
    assert_eq!(4 + answer(&mut session, usize::MAX), 18);
    assert_eq!(load_log(&path).unwrap().record().answers.len(), 18);
}

/// A staircase tells participants whether they were right at its beginning only.
#[test]
fn feedback_ends_with_the_first_reversals() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("gap-detection");
    let mut session = StudySession::begin(&new(&plan, folder.path())).unwrap();
    session.consent().unwrap();
    let mut told = Vec::new();
    while let Step::Trial(trial) = session.step() {
        let Task::Detect { target, level, .. } = trial.task else { panic!("a detection") };
        // Right above 1 mm only, so that there are reversals.
        let side = Side::second_if((target == Side::Second) == (level > 1.0));
        told.push(session.answer(Response::Side(side), Measured::default()).unwrap());
        if told.len() == 40 {
            break;
        }
    }
    assert_eq!(told[0], Some(true));
    assert!(told.contains(&Some(false)) && told[30..].iter().all(Option::is_none), "{told:?}");
}

#[test]
fn practice_alone_saves_nothing() {
    let plan = study("bipolar-rating");
    let mut session = StudySession::practice(&plan, 4).unwrap();
    assert!(session.is_practice() && session.log_path().is_none());
    assert_eq!(session.counts().n_trials, Some(2));
    let mut n_answers = 0;
    while let Step::Trial(trial) = session.step() {
        assert!(trial.is_practice);
        session.answer(Response::Sliders(vec![50.0; 5]), Measured::default()).unwrap();
        n_answers += 1;
    }
    assert_eq!((n_answers, session.step()), (2, Step::Done));
    let error = StudySession::practice(&study("cluster-sorting"), 1).unwrap_err().to_string();
    assert!(error.contains("no practice trials"), "{error}");
}

/// The answer stays in the session until its log takes it.
#[test]
fn an_answer_that_cannot_be_saved_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let plan = study("anchor-rating");
    let mut session = StudySession::begin(&new(&plan, folder.path())).unwrap();
    session.consent().unwrap();
    let path = session.log_path().unwrap();
    let step = session.step();
    // Another program writes to the log: the session must not go on as if its answer were saved.
    fs::OpenOptions::new().append(true).open(&path).unwrap().write_all(b"\n").unwrap();
    let slider = Response::Sliders(vec![25.0]);
    let error = session.answer(slider.clone(), Measured::default()).unwrap_err();
    assert!(matches!(error, SessionError::Log(LogError::Changed { .. })), "{error}");
    assert!(session.has_unsaved());
    assert_eq!((session.step(), session.counts().n_answered), (step, 0));
    let error = session.answer(slider, Measured::default()).unwrap_err();
    assert!(matches!(error, SessionError::Unsaved), "{error}");
    assert!(session.retry().is_err() && session.has_unsaved());
    // The same log, opened anew, takes it.
    session.log = None;
    session.log = Some(StudyLog::resume(&path).unwrap().0);
    session.retry().unwrap();
    assert_eq!((session.has_unsaved(), session.counts().n_answered), (false, 1));
    drop(session);
    let answers = load_log(&path).unwrap().record().answers;
    assert_eq!((answers.len(), &answers[0].response), (1, &Response::Sliders(vec![25.0])));
}
