//! Saving and unsaved work under faults of the disk, injected by the kernel: no file is torn, and nothing is lost.
#![allow(clippy::print_stdout, reason = "the window that is killed reports to its parent")]

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use shagreen_core::maths::rng::Random;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::project::{Project, ProjectLibrary};

use super::support::{read, wait};
use super::{Came, Document};
use crate::state::edit::{Edit, edited};
use crate::state::recovery::{Recovery, leftovers};

#[path = "../../../../../../tests/support/disk_faults.rs"]
mod disk_faults;
use disk_faults::{Act, EIO, ENOSPC, STEPS, Step, inject};

/// Environment variable with the folder of the window that is killed.
const FOLDER: &str = "SHAGREEN_KILLED_WINDOW";
/// Environment variable with the number of faults to inject.
const COUNT: &str = "SHAGREEN_FAULTS";
const USUAL_KILLS: usize = 10;

fn project(name: &str) -> Project {
    Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), name)
}

/// Saves a project to a file that has an older one, while `step` fails.
fn save_under(step: Step, errno: u32) {
    let folder = tempfile::tempdir().unwrap();
    let (file, slots) = (folder.path().join("woods.shagreen"), folder.path().join("recovery"));
    let ctx = egui::Context::default();
    let (old, new) = (project("old"), edited(&project("old"), Edit::Rename("new".to_owned())));
    let mut document = Document::new(&old, None);
    document.save(&old, file.clone(), &ctx);
    assert!(matches!(wait(&mut document), Came::Saved(_)));
    let before = std::fs::read(&file).unwrap();
    let mut recovery = Recovery::new(&slots).unwrap();
    recovery.write_now(&old, document.file());

    // The filter stays on its thread.
    let (mut document, mut recovery) = std::thread::scope(|scope| {
        let work = || {
            inject(step, Act::Fail(errno));
            document.follow(&new, 1);
            document.save(&new, file.clone(), &ctx);
            let Came::NotSaved(reason) = wait(&mut document) else { panic!("{step:?}: saved") };
            assert!(reason.contains("woods.shagreen") && !reason.contains(".shagreen-"), "{reason}");
            assert!(recovery.keep_aside(&new, document.file()).is_err(), "{step:?}: kept");
            (document, recovery)
        };
        scope.spawn(work).join().unwrap()
    });
    assert_eq!(std::fs::read(&file).unwrap(), before, "{step:?}");
    document.follow(&new, 2);
    assert!(document.is_changed(), "{step:?}: the changes count as saved");
    // Afterwards both work again.
    recovery.write_now(&new, document.file());
    recovery.crash();
    let left = leftovers(&slots);
    assert_eq!(
        left.iter().map(|left| read(&left.path()).0.texture().name.clone()).collect::<Vec<_>>(),
        ["new"]
    );
    document.save(&new, file.clone(), &ctx);
    assert!(matches!(wait(&mut document), Came::Saved(_)));
    assert_eq!(read(&file).0.texture().name, "new");
    let names = std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name());
    assert!(names.map(|name| name.into_string().unwrap()).all(|name| !name.starts_with('.')), "{step:?}");
}

#[test]
fn a_failed_save_leaves_the_old_file_and_the_changes() {
    for step in STEPS {
        save_under(step, EIO);
        save_under(step, ENOSPC);
    }
}

/// A window that edits, autosaves and saves until it is killed, and reports what it has done. As an ordinary test it does
/// nothing.
#[test]
fn killed_window() {
    let Some(folder) = std::env::var_os(FOLDER).map(PathBuf::from) else { return };
    let ctx = egui::Context::default();
    let (mut project, file) = read(&folder.join("woods.shagreen"));
    let path = file.path.clone();
    let mut document = Document::new(&project, Some(file));
    let mut recovery = Recovery::new(&folder.join("recovery")).unwrap();
    let begun: usize = project.texture().name.parse().unwrap();
    let report = |what: &str, number: usize| {
        println!("\n{what} {number}");
        std::io::stdout().flush().unwrap();
    };
    for number in begun + 1.. {
        project = edited(&project, Edit::Rename(number.to_string()));
        recovery.write_now(&project, document.file());
        report("kept", number);
        if number % 3 == 0 {
            document.save(&project, path.clone(), &ctx);
            assert!(matches!(wait(&mut document), Came::Saved(_)));
            report("saved", number);
            recovery.restart();
        }
    }
}

#[test]
fn a_killed_window_loses_nothing_that_it_kept() {
    let count = std::env::var(COUNT).map_or(USUAL_KILLS, |count| count.parse().unwrap());
    let folder = tempfile::tempdir().unwrap();
    let (file, slots) = (folder.path().join("woods.shagreen"), folder.path().join("recovery"));
    let first = project("0");
    let mut document = Document::new(&first, None);
    document.save(&first, file.clone(), &egui::Context::default());
    assert!(matches!(wait(&mut document), Came::Saved(_)));
    let mut random = Random::new(5);
    let mut n_left = 0;
    for kill in 0..count {
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["state::document::faults::killed_window", "--exact", "--nocapture", "--quiet"])
            .env(FOLDER, folder.path())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
        let mut done = (0, 0);
        let mut note = |line: &str| match line.split_once(' ') {
            Some(("kept", number)) => done.0 = number.parse().unwrap(),
            Some(("saved", number)) => done.1 = number.parse().unwrap(),
            _ => {}
        };
        loop {
            let line = lines.next().unwrap().unwrap();
            note(&line);
            if line.starts_with("saved") {
                break;
            }
        }
        std::thread::sleep(Duration::from_micros(random.next_u64() % 60_000));
        child.kill().unwrap();
        child.wait().unwrap();
        lines.map_while(Result::ok).for_each(|line| note(&line));
        let number = |path: &Path| read(path).0.texture().name.parse::<usize>().unwrap();
        let saved = number(&file);
        let left = leftovers(&slots);
        let kept = left.iter().map(|left| number(&left.path())).max().unwrap_or(0);
        assert!(saved >= done.1, "kill {kill}: {saved} is in the file, {} was saved", done.1);
        assert!(kept.max(saved) >= done.0, "kill {kill}: {kept} and {saved} are there, {} was kept", done.0);
        n_left += left.len();
        left.into_iter().for_each(crate::state::recovery::Leftover::discard);
    }
    assert!(n_left > count / 4, "the window was hardly ever killed with unsaved work: {n_left} of {count}");
}
