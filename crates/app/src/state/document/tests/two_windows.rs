//! Two windows on one project file: whatever they do and however they end, no work is lost that nobody discarded.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use shagreen_core::maths::rng::Random;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::project::{Project, ProjectLibrary};

use super::support::{read, wait};
use super::{Came, Document};
use crate::state::edit::{Edit, edited};
use crate::state::recovery::{Recovery, leftovers};

const N_RUNS: u64 = 100;
const N_STEPS: usize = 25;

/// One window that is open.
struct Window {
    document: Document,
    project: Project,
    recovery: Recovery,
}

impl Window {
    fn open(file: &Path, folder: &Path) -> Self {
        let (project, file) = read(file);
        Self {
            document: Document::new(&project, Some(file)),
            project,
            recovery: Recovery::new(folder).unwrap(),
        }
    }
}

fn work_in(project: &Project) -> String {
    project.texture().name.clone()
}

/// All work that can be found: in open windows, in project files, and in what crashed windows left.
fn found(windows: &[Option<Window>; 2], files: &[PathBuf], recovery: &Path) -> BTreeSet<String> {
    let open = windows.iter().flatten().map(|window| work_in(&window.project));
    let saved = files.iter().map(|file| work_in(&read(file).0));
    let left =
        leftovers(recovery).iter().map(|leftover| work_in(&read(&leftover.path()).0)).collect::<Vec<_>>();
    open.chain(saved).chain(left).collect()
}

/// One run with random steps.
fn run(seed: u64) {
    let folder = tempfile::tempdir().unwrap();
    let ctx = egui::Context::default();
    let (file, recovery) = (folder.path().join("woods.shagreen"), folder.path().join("recovery"));
    let begun = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "begin");
    let mut first = Document::new(&begun, None);
    first.save(&begun, file.clone(), &ctx);
    while first.collect().is_none() {}
    let mut files = vec![file.clone()];
    let mut windows = [(); 2].map(|()| Some(Window::open(&file, &recovery)));
    let mut random = Random::new(seed);
    // Work that nobody has replaced or discarded.
    let mut alive = BTreeSet::from(["begin".to_owned()]);
    for step in 0..N_STEPS {
        let slot = random.below(2);
        match (&mut windows[slot], random.below(5)) {
            (Some(window), 0 | 1) => {
                let before = work_in(&window.project);
                let name = format!("work {step}");
                window.project = edited(&window.project, Edit::Rename(name.clone()));
                window.recovery.write_now(&window.project, window.document.file());
                alive.insert(name);
                // The window's own earlier work is replaced, unless it lies in a file.
                let is_saved = files.iter().any(|file| work_in(&read(file).0) == before);
                if !is_saved {
                    alive.remove(&before);
                }
            }
            (Some(window), 2 | 3) => {
                let path = window.document.path().unwrap().to_owned();
                let there = work_in(&read(&path).0);
                window.document.save(&window.project, path.clone(), &ctx);
                match wait(&mut window.document) {
                    Came::Saved(_) => {}
                    Came::Conflict(conflict) => match random.below(3) {
                        0 => {
                            // The user chose to lose what is in the file.
                            window.document.overwrite(&window.project, &conflict, &ctx);
                            assert!(matches!(wait(&mut window.document), Came::Saved(_)));
                        }
                        1 => {
                            window.recovery.keep_aside(&window.project, window.document.file()).unwrap();
                            window.recovery.restart();
                            let (project, file) = read(&path);
                            window.document = Document::new(&project, Some(file));
                            window.project = project;
                            continue;
                        }
                        _ => {
                            let other = folder.path().join(format!("other {step}.shagreen"));
                            window.document.save(&window.project, other.clone(), &ctx);
                            assert!(matches!(wait(&mut window.document), Came::Saved(_)));
                            files.push(other);
                            window.recovery.restart();
                            continue;
                        }
                    },
                    _ => panic!("saving failed"),
                }
                window.recovery.restart();
                // What was in the file was this window's own, or the user chose to lose it.
                alive.remove(&there);
                alive.extend(windows[slot].as_ref().map(|window| work_in(&window.project)));
            }
            (place @ Some(_), _) => {
                let window = place.take().unwrap();
                window.recovery.crash();
            }
            (place @ None, _) => {
                let mut left = leftovers(&recovery);
                *place = Some(if left.is_empty() {
                    Window::open(&file, &recovery)
                } else {
                    let leftover = left.remove(0);
                    let (project, _) = read(&leftover.path());
                    let mut window = Window {
                        document: Document::unsaved(leftover.origin.clone().or_else(|| Some(read(&file).1))),
                        project,
                        recovery: Recovery::new(&recovery).unwrap(),
                    };
                    window.recovery.write_now(&window.project, window.document.file());
                    leftover.discard();
                    window
                });
            }
        }
        let found = found(&windows, &files, &recovery);
        let lost: Vec<&String> = alive.difference(&found).collect();
        assert!(lost.is_empty(), "run {seed}, step {step}: {lost:?} is lost; {found:?} is there");
    }
}

#[test]
fn nothing_is_lost_whatever_two_windows_do() {
    (0..N_RUNS).for_each(run);
}
