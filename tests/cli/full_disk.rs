//! The session of a person on a full disk: the answer that cannot be written is reported and kept, the earlier lines stay, and
//! the session goes on when there is room again.
//!
//! This program starts itself as the session, either with a limit of the size of its files, or with its folder on a small file
//! system of its own. Where that cannot be mounted, the test says so and uses the limit alone.

use std::env;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Output};

use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
use shagreen_core::people::study::answer::{Measured, Response};
use shagreen_core::people::study::progress::Step;
use shagreen_core::people::study::setup::{ScreenScale, Setup};
use shagreen_formats::study_log::LogError;
use shagreen_studio::study::logs::load_log;
use shagreen_studio::study::plans::template;
use shagreen_studio::study::session::{LogPlace, NewSession, SessionError, StudySession};

/// Environment variable for the folder of the session; if it is set, this program is the session.
const FOLDER: &str = "SHAGREEN_FULL_DISK";
/// Environment variable for the kind of disk.
const DISK: &str = "SHAGREEN_FULL_DISK_KIND";
/// Environment variable for what follows when there is room.
const THEN: &str = "SHAGREEN_FULL_DISK_THEN";
/// Words that the session prints at its start and at its end.
const BEGUN: &str = "the session has begun";
const DONE: &str = "the session is done";
/// Number of trials of the plan.
const N_TRIALS: usize = 18;

/// A disk that can be filled.
enum Disk {
    /// Files have a largest size.
    Limited,
    /// A small file system, which this file fills.
    Small(PathBuf),
}

impl Disk {
    /// Leaves hardly any room for the log.
    fn fill(&self, log: &Path) {
        match self {
            Self::Limited => {
                let n_bytes = fs::metadata(log).unwrap().len();
                let maximum = getrlimit(Resource::Fsize).maximum;
                setrlimit(Resource::Fsize, Rlimit { current: Some(n_bytes + 100), maximum }).unwrap();
            }
            Self::Small(filler) => {
                let mut file = fs::File::create(filler).unwrap();
                while file.write_all(&[0; 512]).is_ok() {}
            }
        }
    }

    /// Makes room again.
    fn free(&self) {
        match self {
            Self::Limited => {
                let maximum = getrlimit(Resource::Fsize).maximum;
                setrlimit(Resource::Fsize, Rlimit { current: maximum, maximum }).unwrap();
            }
            Self::Small(filler) => fs::remove_file(filler).unwrap(),
        }
    }
}

/// The response to the trial with this index, different for each.
fn response(index: usize) -> Response {
    Response::Sliders(vec![index as f64])
}

/// What is measured is long enough to fill the last block of a small file system.
fn measured() -> Measured {
    Measured { stimulus_hashes: vec!["0".repeat(64); 3], ..Measured::default() }
}

/// Does what the next step asks for.
fn go_on(session: &mut StudySession) -> Result<(), SessionError> {
    match session.step() {
        Step::Consent => session.consent(),
        Step::Break => session.rest(),
        Step::Trial(_) => session.answer(response(session.counts().n_answered), measured()).map(|_| ()),
        Step::Done => panic!("there is a further step"),
    }
}

/// The session. As an ordinary test it does nothing unless the environment variable is set.
#[test]
fn session() {
    let Ok(folder) = env::var(FOLDER) else { return };
    println!("{BEGUN}");
    let folder = PathBuf::from(folder);
    let is_small = env::var(DISK).unwrap() == "small";
    let disk = if is_small { Disk::Small(folder.join("filler")) } else { Disk::Limited };
    let study = template("anchor-rating").unwrap().study;
    let place = LogPlace::Folder(&folder);
    let new = NewSession { plan: &study, place, participant: None, simulation_seed: None };
    let mut session = StudySession::begin(&new).unwrap();
    assert!(!session.is_simulated());
    let path = session.log_path().unwrap();
    while session.counts().n_answered < 3 {
        go_on(&mut session).unwrap();
    }
    disk.fill(&path);
    // A small file system has room up to the end of a block.
    let (before, step, error) = loop {
        let (before, step) = (fs::read(&path).unwrap(), session.step());
        if let Err(error) = go_on(&mut session) {
            break (before, step, error);
        }
    };
    let n_answered = session.counts().n_answered;
    assert!(matches!(error, SessionError::Log(LogError::NotSaved { .. })), "{error}");
    let text = error.to_string();
    assert!(text.contains("the answer is not saved") && text.contains("p01.jsonl"), "{text}");
    // The session stays where it is, keeps the answer, and does not go on without it.
    assert!(session.has_unsaved() && session.step() == step);
    assert!(session.retry().is_err() && session.has_unsaved());
    let again = session.answer(response(0), measured()).unwrap_err();
    assert!(matches!(again, SessionError::Unsaved), "{again}");
    session.set_up(&setup()).unwrap();
    assert!(fs::read(&path).unwrap().starts_with(&before), "earlier lines stay");
    if env::var(THEN).unwrap() == "resume" {
        // The program ends. Its log has all answers but the last one, which is asked again unless only its end was cut off.
        drop(session);
        disk.free();
        session = StudySession::resume(&path).unwrap();
        assert!((n_answered..=n_answered + 1).contains(&session.counts().n_answered));
    } else {
        disk.free();
        session.retry().unwrap();
        assert!(!session.has_unsaved());
        let is_trial = matches!(step, Step::Trial(_));
        assert_eq!(session.counts().n_answered, n_answered + usize::from(is_trial));
    }
    while session.step() != Step::Done {
        go_on(&mut session).unwrap();
    }
    session.end().unwrap();
    drop(session);
    let log = load_log(&path).unwrap();
    let given: Vec<Response> = log.record().answers.into_iter().map(|answer| answer.response).collect();
    assert_eq!(given, (0..N_TRIALS).map(response).collect::<Vec<_>>());
    // Nothing but the line that the full disk tore, at most once for each attempt.
    assert!(log.problems.len() <= 2, "{:?}", log.problems);
    println!("{DONE}");
}

fn setup() -> Setup {
    Setup {
        output: None,
        actuator: None,
        masking: None,
        pen: None,
        screen: ScreenScale::Assumed { pixels_per_mm: 3.8 },
        program: String::new(),
    }
}

/// Runs the session on a disk of this kind.
fn run(disk: &str, then: &str) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let program = env::current_exe().unwrap();
    let mut command = if disk == "small" {
        let mount = "mount -t tmpfs -o size=96k tmpfs \"$SHAGREEN_FULL_DISK\" && exec \"$0\" \"$@\"";
        let mut command = Command::new("unshare");
        command.args(["--user", "--map-root-user", "--mount", "sh", "-c", mount]);
        command
    } else {
        // The shell lets the program see the error of a full file; otherwise the kernel would end it.
        let mut command = Command::new("sh");
        command.args(["-c", "trap '' XFSZ; exec \"$0\" \"$@\""]);
        command
    };
    command.arg(program).args(["full_disk::session", "--exact", "--nocapture"]);
    command.env(FOLDER, folder.path()).env(DISK, disk).env(THEN, then);
    // Without the command, there is no output, as without the right to mount.
    let nothing = |_| Output { status: ExitStatus::default(), stdout: Vec::new(), stderr: Vec::new() };
    command.output().unwrap_or_else(nothing)
}

#[test]
fn a_full_disk_is_reported_and_loses_no_answer() {
    for disk in ["limited", "small"] {
        for then in ["retry", "resume"] {
            let output = run(disk, then);
            let said = String::from_utf8_lossy(&output.stdout);
            if disk == "small" && !said.contains(BEGUN) {
                println!("skipped: a small file system cannot be mounted here");
                continue;
            }
            let errors = String::from_utf8_lossy(&output.stderr);
            assert!(said.contains(DONE), "{disk}, {then}: {said}{errors}");
        }
    }
}
