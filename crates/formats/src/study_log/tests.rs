use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::sync::Arc;

use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
use shagreen_core::people::study::answer::{Answer, Event, Measured, Motion, Response};
use shagreen_core::people::study::progress::{Step, replay};
use shagreen_core::people::study::setup::{OutputDevice, ScreenScale, Setup};
use shagreen_core::people::study::simulated::{Observers, World, simulated_session};
use shagreen_core::people::study::trial::{Task, Trial};

use super::{
    LogError, LogHeader, LogHeaderError, ReadLog, StudyLog, TimedEvent, read_study_log, write_study_log,
};
use crate::study_plan::{read_study_plan, study_template};

fn plan_text(id: &str) -> &'static str {
    study_template(id).unwrap().text
}

fn header(id: &str) -> LogHeader {
    LogHeader::new("simulated-01", 1, true, 5, "shagreen test", 1.5e9, plan_text(id)).unwrap()
}

/// Events of a simulated participant of a built-in plan.
fn events(id: &str) -> Vec<TimedEvent> {
    let plan = Arc::new(read_study_plan(plan_text(id).as_bytes()).unwrap());
    let world = World::invented(&plan, 3);
    let events = simulated_session(&plan, &world, &Observers::usual(), 1, 5).unwrap();
    let timed = |(index, event): (usize, Event)| TimedEvent { unix_secs: 1.5e9 + index as f64, event };
    events.into_iter().enumerate().map(timed).collect()
}

fn write(path: &Path, id: &str, events: &[TimedEvent]) {
    let mut log = StudyLog::create(path, &header(id)).unwrap();
    for event in events {
        log.append(event).unwrap();
    }
}

/// Bytes of a log with these events.
fn bytes(id: &str, events: &[TimedEvent]) -> Vec<u8> {
    write_study_log(&header(id), events)
}

fn read(bytes: &[u8]) -> ReadLog {
    read_study_log(bytes).unwrap()
}

/// The line of an answer with another seed, as after a damage of one digit.
pub(super) fn with_other_seed(line: &str) -> String {
    let (begin, rest) = line.split_once("\"seed\":").unwrap();
    let (seed, end) = rest.split_once(',').unwrap();
    let seed: u64 = seed.parse().unwrap();
    format!("{begin}\"seed\":{},{end}", seed ^ 1)
}

#[test]
fn every_design_comes_back() {
    for template in [
        "cluster-sorting",
        "adjective-relevance",
        "bipolar-rating",
        "authored-dissimilarity",
        "gap-detection",
        "reconstruction-similarity",
        "text-to-texture",
        "abx",
        "mushra",
        "anchor-rating",
    ] {
        let events = events(template);
        let log = read(&bytes(template, &events));
        assert_eq!((log.problems.len(), log.is_torn), (0, false), "{template}");
        assert_eq!(log.events, events, "{template}");
        assert_eq!(log.header, header(template));
        assert!(log.record().is_simulated && !log.record().answers.is_empty());
        let replayed = replay(Arc::new(log.plan.clone()), 1, &log.events()).unwrap();
        assert_eq!(replayed.progress.step(), Step::Done);
    }
}

#[test]
fn what_was_measured_comes_back() {
    let trial = Trial {
        part: "roughness".to_owned(),
        number: 3,
        is_practice: false,
        seed: i64::MAX as u64,
        task: Task::Place { stimulus: "cork".to_owned(), low: "glass".to_owned(), high: "brick".to_owned() },
    };
    let measured = Measured {
        response_secs: Some(2.5),
        motion: Some(Motion { distance_m: 0.5, mean_speed_mps: 0.125, mean_force_n: 0.75 }),
        touched_m: vec![0.25, 0.125, 0.125],
        latency_secs: Some(0.015_625),
        device: "haptuator-mark-ii".to_owned(),
        stimulus_hashes: vec!["ab".to_owned(), "cd".to_owned()],
        n_plays: vec![1, 2, 3],
    };
    let response = Response::Sliders(vec![0.1 + 0.2]);
    let event = Event::Answered(Box::new(Answer { trial, response, measured }));
    let events = [TimedEvent { unix_secs: 1.5e9, event }];
    let bytes = bytes("anchor-rating", &events);
    assert_eq!(read(&bytes).events, events);
    let text = String::from_utf8(bytes).unwrap();
    assert!(text.contains("\"distance_mm\":500.0") && text.contains("\"latency_ms\":15.625"), "{text}");
    assert!(text.contains("\"touched_mm\":[250.0,125.0,125.0]"), "{text}");
    // The header and its copy, and the answer.
    assert_eq!(text.lines().count(), 3);
}

/// The devices, and that there are none, can be read in the file.
#[test]
fn the_setup_of_the_devices_and_a_refusal_come_back() {
    let full = Setup {
        output: Some(OutputDevice { id: "pulse:usb".to_owned(), name: "USB Audio".to_owned() }),
        actuator: Some("haptuator-mark-ii".to_owned()),
        masking: Some("Headphones".to_owned()),
        pen: Some("Pen \"8\"".to_owned()),
        screen: ScreenScale::Measured { pixels_per_mm: 5.125 },
        program: "shagreen test".to_owned(),
    };
    let empty = Setup {
        output: None,
        actuator: None,
        masking: None,
        pen: None,
        screen: ScreenScale::Assumed { pixels_per_mm: 3.78 },
        program: String::new(),
    };
    let events: Vec<TimedEvent> =
        [Event::SetUp(Box::new(full)), Event::SetUp(Box::new(empty)), Event::Refused]
            .into_iter()
            .map(|event| TimedEvent { unix_secs: 1.5e9, event })
            .collect();
    let bytes = bytes("abx", &events);
    let log = read(&bytes);
    assert_eq!((&log.events, log.problems.len(), log.has_refused()), (&events, 0, true));
    assert!(!read(&write_study_log(&header("abx"), &events[..2])).has_refused());
    let text = String::from_utf8(bytes).unwrap();
    for words in [
        "\"output\":\"USB Audio\",\"output_id\":\"pulse:usb\"",
        "\"output\":\"no output\",\"output_id\":null,\"actuator\":null,\"masking_output\":null",
        "\"screen\":\"assumed\",\"pixels_per_mm\":3.78",
        "{\"event\":\"refuse\",\"unix_s\":1500000000.0}",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
}

/// Logs of version 1.0: without the copy, without devices, without the distances over the stimuli.
#[test]
fn logs_of_the_first_version_are_read() {
    let events = events("anchor-rating");
    let now = String::from_utf8(bytes("anchor-rating", &events)).unwrap();
    let then: Vec<String> = now
        .lines()
        .enumerate()
        .filter(|(index, _)| *index != 1)
        .map(|(_, line)| match line.split_once(",\"touched_mm\":[") {
            Some((begin, rest)) => format!("{begin}{}", rest.split_once(']').unwrap().1),
            None => line.replacen("\"version\":\"1.1\"", "\"version\":\"1.0\"", 1),
        })
        .collect();
    let then = then.join("\n") + "\n";
    assert!(then.contains("\"version\":\"1.0\"") && !then.contains("touched_mm"));
    let log = read(then.as_bytes());
    assert_eq!(
        (log.problems.len(), log.events.len(), log.header),
        (0, events.len(), header("anchor-rating"))
    );
    let record = read(then.as_bytes()).record();
    assert!(record.setups.is_empty() && record.setup_at(0).is_none());
    assert!(record.answers.iter().all(|answer| answer.measured.touched_m.is_empty()));
}

#[test]
fn a_torn_line_stays_and_its_trial_is_asked_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.jsonl");
    let events = events("anchor-rating");
    write(&path, "anchor-rating", &events[..5]);
    let whole = fs::read(&path).unwrap();
    assert_eq!(whole, bytes("anchor-rating", &events[..5]));
    let torn = &whole[..whole.len() - 9];
    fs::write(&path, torn).unwrap();
    let (mut log, before) = StudyLog::resume(&path).unwrap();
    assert!(before.is_torn);
    assert_eq!(before.events, events[..4]);
    assert_eq!((before.problems.len(), before.problems[0].line), (1, 7));
    assert!(before.problems[0].to_string().starts_with("line 7: it is torn"), "{}", before.problems[0]);
    let progress = replay(Arc::new(before.plan.clone()), 1, &before.events()).unwrap().progress;
    let Event::Answered(lost) = &events[4].event else { panic!("an answer") };
    assert_eq!(progress.step(), Step::Trial(lost.trial.clone()));
    for event in &events[4..] {
        log.append(event).unwrap();
    }
    drop(log);
    let bytes = fs::read(&path).unwrap();
    assert!(bytes.starts_with(torn), "nothing is removed");
    let after = read(&bytes);
    assert_eq!((after.events, after.is_torn), (events, false));
    assert_eq!((after.problems.len(), after.problems[0].line), (1, 7));
}

#[test]
fn damaged_lines_in_the_middle_are_named_and_skipped() {
    let events = events("anchor-rating");
    let good = bytes("anchor-rating", &events);
    let lines: Vec<&[u8]> = good.split_inclusive(|byte| *byte == b'\n').collect();
    let with = |at: usize, line: &[u8]| {
        let (before, after) = (lines[..at].concat(), lines[at + 1..].concat());
        [&before[..], line, &after[..]].concat()
    };
    let fifth = String::from_utf8(lines[5].to_vec()).unwrap();
    let other_part = fifth.replace("\"roughness\"", "\"smoothness\"");
    let out_of_range = fifth.replace("\"sliders\":[", "\"sliders\":[1e3,");
    for (line, words) in [
        (&b"\0\0\0\0\n"[..], "it is skipped"),
        (b"{\"event\":\"answer\"\n", "it is skipped: it ends too early"),
        (b"\xff\xfe\n", "it is skipped"),
        (b"{\"event\":\"sneeze\"}\n", "`sneeze` is unknown"),
        (other_part.as_bytes(), "the plan has no part \"smoothness\""),
        (out_of_range.as_bytes(), "2 values are given, but 1 are needed"),
        (lines[4], "is answered before; the first answer counts"),
    ] {
        let log = read(&with(5, line));
        assert_eq!(
            (log.problems.len(), log.problems[0].line, log.is_torn),
            (1, 6, false),
            "{:?}",
            log.problems
        );
        assert!(log.problems[0].text.contains(words), "{:?}", log.problems);
        assert_eq!(log.events.len(), events.len() - 1);
        assert!(!log.events.contains(&events[3]) && log.events.contains(&events[4]));
    }
    // A digit of the seed has changed: the line is readable, but not an answer to the trial of this participant.
    let flipped = with_other_seed(&fifth);
    let log = read(&with(5, flipped.as_bytes()));
    assert_eq!((log.problems.len(), log.problems[0].line, log.events.len()), (1, 6, events.len() - 1));
    assert!(log.problems[0].text.contains("has another seed"), "{:?}", log.problems);
    // The trial is asked again, and its second answer counts.
    let log = read(&[with(5, flipped.as_bytes()), lines[5].to_vec()].concat());
    assert_eq!((log.problems.len(), log.events.len()), (1, events.len()));
    // Empty lines mean nothing.
    let spaced = read(&with(5, &[&b"\n"[..], lines[5], b"  \r\n"].concat()));
    assert_eq!((spaced.events, spaced.problems.len()), (events, 0));
}

#[test]
fn a_log_without_its_header_says_what_is_wrong() {
    let good = String::from_utf8(bytes("abx", &[])).unwrap();
    let check = |text: &str, words: &str| {
        let message = read_study_log(text.as_bytes()).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    };
    check("", "the file is empty");
    check("{\"format\":\"shagreen-project\",\"version\":\"1.0\"}\n", "this is not the log of a study");
    check(&good.replace("\"version\":\"1.1\"", "\"version\":\"2.0\""), "the log has version 2.0");
    let first = good.lines().next().unwrap();
    check(&first[..first.len() - 20], "the first line of the log is damaged");
    check(&good.replace("\"number\":1", "\"number\":0"), "numbered from 1");
    check(&good.replace("simulated-01", "p01"), "exactly if the participant is");
    check(
        &good.replace("design = \\\"abx\\\"", "design = \\\"abc\\\""),
        "the plan in the first line of the log",
    );
    // A changed plan is a warning.
    let log = read(good.replace("Which one is X?", "Which one is it?").as_bytes());
    assert!(log.problems[0].text.contains("the plan was changed after the session began"));
}

#[test]
fn two_sessions_cannot_use_one_log() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.jsonl");
    let mut first = StudyLog::create(&path, &header("abx")).unwrap();
    assert!(matches!(StudyLog::create(&path, &header("abx")), Err(LogError::Exists { .. })));
    assert!(matches!(StudyLog::resume(&path), Err(LogError::InUse { .. })));
    let event = |unix_secs: f64| TimedEvent { unix_secs, event: Event::Consented };
    first.append(&event(1.0)).unwrap();
    drop(first);
    let (mut second, read) = StudyLog::resume(&path).unwrap();
    assert_eq!((read.events.len(), second.path()), (1, path.as_path()));
    second.append(&event(2.0)).unwrap();
    // A program that does not ask for the lock.
    fs::OpenOptions::new().append(true).open(&path).unwrap().write_all(b"{}\n").unwrap();
    let error = second.append(&event(3.0)).unwrap_err();
    assert!(matches!(error, LogError::Changed { .. }), "{error}");
    drop(second);
    let (_, read) = StudyLog::resume(&path).unwrap();
    assert_eq!((read.events.len(), read.problems.len()), (2, 1));
}

#[test]
fn a_log_that_cannot_be_created_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("none/p.jsonl");
    assert!(matches!(StudyLog::create(&missing, &header("abx")), Err(LogError::NotOpened { .. })));
    assert!(matches!(StudyLog::resume(&folder.path().join("p.jsonl")), Err(LogError::NotOpened { .. })));
    assert!(StudyLog::resume(folder.path()).unwrap_err().to_string().contains("folder"));
    fs::write(folder.path().join("notes.txt"), "hello").unwrap();
    let error = StudyLog::resume(&folder.path().join("notes.txt")).unwrap_err().to_string();
    assert!(error.contains("this is not the log of a study") && error.contains("notes.txt"), "{error}");
    assert_eq!(fs::read(folder.path().join("notes.txt")).unwrap(), b"hello");
}

#[test]
fn names_of_people_and_unnamed_simulations_are_refused() {
    let new =
        |name: &str, is_simulated: bool| LogHeader::new(name, 1, is_simulated, 1, "", 0.0, "").map(|_| ());
    assert_eq!((new("p01", false), new("simulated-01", true)), (Ok(()), Ok(())));
    for name in ["", "Ada Lovelace", "ada@example.org", "ä", &"p".repeat(41)] {
        assert!(matches!(new(name, false), Err(LogHeaderError::Pseudonym { .. })), "{name}");
    }
    assert!(matches!(new("p01", true), Err(LogHeaderError::Simulated { .. })));
    assert!(matches!(new("simulated-01", false), Err(LogHeaderError::Simulated { .. })));
}

proptest! {
    /// Wherever a log is cut, the answers before the cut are read.
    #[test]
    fn a_cut_log_loses_only_its_last_line(share in 0.0..1.0_f64) {
        let events = events("abx");
        let whole = bytes("abx", &events);
        // The header and its copy.
        let first = bytes("abx", &[]).len();
        let cut = first + (share * (whole.len() - first) as f64) as usize;
        let log = read(&whole[..cut]);
        let n_whole = whole[first..cut].split(|byte| *byte == b'\n').count() - 1;
        // A line that lacks only its line break is whole.
        prop_assert!(log.events.len() == n_whole || (log.events.len() == n_whole + 1 && !log.is_torn));
        prop_assert_eq!(&log.events[..], &events[..log.events.len()]);
        prop_assert_eq!(log.problems.len(), usize::from(log.is_torn));
    }

    /// Whatever bytes follow the header, reading neither fails nor invents answers.
    #[test]
    fn any_bytes_after_the_header_are_survived(noise in proptest::collection::vec(0_u8..=255, 0..200)) {
        let header = bytes("abx", &[]);
        let log = read(&[header, noise].concat());
        prop_assert!(log.events.is_empty());
    }
}
