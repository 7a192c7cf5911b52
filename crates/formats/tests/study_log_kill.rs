//! Answers survive the end of the program: this program starts itself as a session that answers, and kills it at random times.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test may panic on an unexpected result, and the session reports its answers to its parent"
)]

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::{env, thread};

use shagreen_core::maths::rng::Random;
use shagreen_core::people::study::answer::Event;
use shagreen_core::people::study::progress::{Progress, Step, replay};
use shagreen_core::people::study::simulated::{Observers, SimulatedParticipant, World};
use shagreen_formats::study_log::{LogHeader, StudyLog, TimedEvent};
use shagreen_formats::study_plan::{read_study_plan, study_template};

use self::killed::{itself, kill_after};

#[path = "support/killed.rs"]
mod killed;

/// Environment variable for the path of the log; if it is set, this program is the session.
const FILE: &str = "SHAGREEN_STUDY_LOG";
/// Word before the number of answers that are saved.
const SAVED: &str = "saved";
/// Maximum lifetime of a session after its start, in µs.
const LONGEST_MICROS: u64 = 60_000;
/// Number of killed sessions.
const KILLS: u32 = 200;

fn plan_text() -> &'static str {
    study_template("authored-dissimilarity").unwrap().text
}

fn event(event: Event) -> TimedEvent {
    TimedEvent { unix_secs: 1.5e9, event }
}

/// The session: begins or goes on, and answers until it is done or killed. It reports each answer after it is saved. As an
/// ordinary test it does nothing unless the environment variable is set.
#[test]
fn session() {
    let Ok(file) = env::var(FILE) else { return };
    let path = PathBuf::from(file);
    let plan = Arc::new(read_study_plan(plan_text().as_bytes()).unwrap());
    let (mut log, mut progress) = if path.exists() {
        let (log, read) = StudyLog::resume(&path).unwrap();
        (log, replay(Arc::clone(&plan), 1, &read.events()).unwrap().progress)
    } else {
        let header = LogHeader::new("simulated-01", 1, true, 1, "test", 1.5e9, plan_text()).unwrap();
        (StudyLog::create(&path, &header).unwrap(), Progress::new(Arc::clone(&plan), 1).unwrap())
    };
    let world = World::invented(&plan, 3);
    let mut participant = SimulatedParticipant::new(&plan, &world, Observers::usual(), 1, 1).unwrap();
    println!("\n{SAVED} {}", n_answered(&progress));
    loop {
        match progress.step() {
            Step::Consent => {
                log.append(&event(Event::Consented)).unwrap();
                progress.consent();
            }
            Step::Break => {
                log.append(&event(Event::Rested)).unwrap();
                progress.rest();
            }
            Step::Trial(trial) => {
                let answer = participant.answer(trial);
                log.append(&event(Event::Answered(Box::new(answer.clone())))).unwrap();
                progress.answer(&answer.trial, &answer.response).unwrap();
                println!("{SAVED} {}", n_answered(&progress));
                std::io::stdout().flush().unwrap();
            }
            Step::Done => return,
        }
    }
}

/// Number of answered trials of the only part; its number of trials when all are answered.
fn n_answered(progress: &Progress) -> usize {
    progress.place().map_or(usize::MAX, |place| place.n_answered)
}

/// Starts a session and kills it after `micros` microseconds; returns the last number of answers that it reported.
fn kill_session(path: &Path, micros: u64) -> usize {
    let mut child = itself("session").env(FILE, path).spawn().unwrap();
    let lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let reader = thread::spawn(move || {
        let mut last = 0;
        for line in lines.map_while(Result::ok) {
            let number = line.strip_prefix(SAVED).and_then(|rest| rest.trim().parse().ok());
            last = number.unwrap_or(last);
        }
        last
    });
    kill_after(child, micros);
    reader.join().unwrap()
}

#[test]
fn a_killed_session_loses_nothing_that_was_saved() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = Random::new(7);
    let mut n_saved = 0;
    let mut n_files = 0;
    for kill in 0..KILLS {
        // A new session after each ten kills; the others go on with the same log.
        let path = folder.path().join(format!("{}.jsonl", kill / 10));
        let before =
            if path.exists() { StudyLog::resume(&path).unwrap().1.record().answers.len() } else { 0 };
        let reported = kill_session(&path, random.next_u64() % LONGEST_MICROS);
        if !path.exists() {
            continue;
        }
        let Ok((_, read)) = StudyLog::resume(&path) else {
            // Killed while the first line was written, before any answer.
            assert_eq!((before, reported), (0, 0));
            std::fs::remove_file(&path).unwrap();
            continue;
        };
        let n = read.record().answers.len();
        assert!(n >= before && (n >= reported || reported == usize::MAX), "{n} of {reported} answers");
        n_saved += n - before;
        n_files += 1;
    }
    // The test is only meaningful if sessions answered before they were killed.
    assert!(n_saved > 20 && n_files > 5, "{n_saved} answers in {n_files} sessions");
}
