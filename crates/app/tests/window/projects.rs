//! Project files: saving, opening, leaving and recovery. Unsaved changes are never discarded without asking.

use std::path::{Path, PathBuf};

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::Begin;
use shagreen_app::choices::tour::Step;
use shagreen_app::state::files::StoragePaths;
use shagreen_app::state::recovery::INTERVAL;
use shagreen_app::strings;
use shagreen_app::strings::{document, gallery, help};
use shagreen_formats::gallery::GALLERY;
use shagreen_formats::project::{Project, ProjectLibrary};
use shagreen_formats::starter::starter_bytes;
use shagreen_studio::open::{self, Opened};
use shagreen_studio::permitted_libraries::Permitted;
use shagreen_studio::project::new_project;

use crate::support::{
    Author, author, author_of, begin, click, drop_files, enter_path, says, unnamed_controls, wait, window,
    write_into,
};

const SIZE: [f32; 2] = [1280.0, 720.0];

/// Renames the authored texture and moves the focus away.
pub(crate) fn rename(harness: &mut Author, name: &str) {
    write_into(harness, strings::NAME, name);
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(window(harness).project().texture().name, name);
}

fn keys(harness: &mut Author, modifiers: Modifiers, key: Key) {
    harness.key_press_modifiers(modifiers, key);
    harness.run_steps(3);
}

/// Clicks an entry of the file menu.
pub(crate) fn menu(harness: &mut Author, entry: &str) {
    click(harness, document::FILE);
    harness.run_steps(2);
    assert_eq!(unnamed_controls(harness), Vec::<String>::new());
    click(harness, entry);
    harness.run_steps(2);
}

/// Saves the project to a path in the save sheet.
pub(crate) fn save_as(harness: &mut Author, path: &Path) {
    keys(harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    enter_path(harness, document::SAVE_PATH, path);
}

pub(crate) fn wait_until_saved(harness: &mut Author) {
    wait(harness, "it is saved", |h| !window(h).document().is_changed());
    harness.run_steps(2);
}

pub(crate) fn project_in(path: &Path) -> Project {
    match open::open(path, &Permitted::All).unwrap() {
        Opened::Project(opened) => opened.project,
        Opened::Library(_) => panic!("a project"),
    }
}

pub(crate) fn open(harness: &mut Author, path: &Path) {
    keys(harness, Modifiers::COMMAND, Key::O);
    enter_path(harness, document::OPEN_PATH, path);
    wait(harness, "it is read", |h| !window(h).document().is_opening());
    harness.run_steps(2);
}

#[test]
fn a_project_is_saved_left_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("Woods.shagreen");
    let mut harness = author();
    assert!(!window(&harness).document().is_changed() && says(&harness, document::UNTITLED));
    rename(&mut harness, "Oak copy");
    assert!(window(&harness).document().is_changed());
    assert_eq!(harness.query_all_by_label_contains("Untitled •").count(), 1, "the title tells");
    save_as(&mut harness, &path);
    wait_until_saved(&mut harness);
    assert_eq!(&project_in(&path), window(&harness).project());
    assert!(says(&harness, "Woods") && !says(&harness, "Woods •"));
    assert!(harness.query_by_label(document::SAVE_TITLE).is_none(), "the sheet is gone");

    // Saving again needs no path.
    harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).set_value_accesskit(63.0);
    harness.run_steps(3);
    assert!(says(&harness, "Woods •"));
    keys(&mut harness, Modifiers::COMMAND, Key::S);
    wait_until_saved(&mut harness);
    let saved = project_in(&path);
    assert_eq!(saved.texture().at.x(), 63.0);

    menu(&mut harness, document::NEW);
    assert_eq!(window(&harness).project(), &new_project());
    assert!(window(&harness).document().path().is_none());
    assert!(
        harness.get_by_label(strings::UNDO).accesskit_node().is_disabled(),
        "another project's history is gone"
    );
    open(&mut harness, &path);
    assert_eq!(window(&harness).project(), &saved);
    assert_eq!(window(&harness).document().path(), Some(&*path));
    assert!(!window(&harness).document().is_changed());
}

#[test]
fn nothing_is_left_unasked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.shagreen");
    let mut harness = author();
    rename(&mut harness, "Oak copy");
    let project = window(&harness).project().clone();
    for entry in [document::NEW, document::QUIT] {
        menu(&mut harness, entry);
        assert!(says(&harness, document::LEAVE_TITLE), "{entry}");
        assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
        click(&mut harness, document::CANCEL);
        harness.run_steps(2);
        assert_eq!(window(&harness).project(), &project);
    }
    // Canceling the save also cancels leaving, for later saves too.
    let kept = folder.path().join("kept.shagreen");
    menu(&mut harness, document::NEW);
    click(&mut harness, document::SAVE_FIRST);
    harness.run_steps(2);
    click(&mut harness, document::CANCEL);
    save_as(&mut harness, &kept);
    wait_until_saved(&mut harness);
    harness.run_steps(5);
    assert_eq!((window(&harness).project(), window(&harness).document().path()), (&project, Some(&*kept)));
    menu(&mut harness, document::NEW);
    rename(&mut harness, "Oak copy");
    let project = window(&harness).project().clone();
    // "Save first" asks for a path if there is none, and then leaves the project.
    menu(&mut harness, document::NEW);
    click(&mut harness, document::SAVE_FIRST);
    harness.run_steps(2);
    enter_path(&mut harness, document::SAVE_PATH, &path);
    wait(&mut harness, "a new project", |h| window(h).project() == &new_project());
    assert_eq!(project_in(&path), project);

    rename(&mut harness, "Lost");
    open(&mut harness, &path);
    assert!(says(&harness, document::LEAVE_TITLE), "what was read waits");
    click(&mut harness, document::DO_NOT_SAVE);
    harness.run_steps(3);
    assert_eq!(window(&harness).project(), &project);
    // Undoing back to the saved state leaves no unsaved changes.
    harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).set_value_accesskit(1.0);
    harness.run_steps(3);
    assert!(window(&harness).document().is_changed());
    keys(&mut harness, Modifiers::COMMAND, Key::Z);
    assert!(!window(&harness).document().is_changed());
}

#[test]
fn what_cannot_be_opened_or_saved_is_said_and_nothing_changes() {
    let folder = tempfile::tempdir().unwrap();
    let damaged = folder.path().join("damaged.shagreen");
    std::fs::write(&damaged, b"{\"format\": \"shagreen-project\", \"version\": \"1.0\"").unwrap();
    let mut harness = author();
    let project = window(&harness).project().clone();
    open(&mut harness, &damaged);
    assert!(says(&harness, "the project is damaged") && says(&harness, "damaged.shagreen"));
    click(&mut harness, document::CANCEL);
    open(&mut harness, &folder.path().join("none.shagreen"));
    assert!(says(&harness, "the file cannot be read"));
    click(&mut harness, document::CANCEL);
    assert_eq!(window(&harness).project(), &project);

    rename(&mut harness, "Oak copy");
    // Another kind of file is not overwritten.
    let notes = folder.path().join("notes.shagreen");
    std::fs::write(&notes, "my notes").unwrap();
    save_as(&mut harness, &notes);
    wait(&mut harness, "it is refused", |h| says(h, "is not a project and is not replaced"));
    assert_eq!(std::fs::read(&notes).unwrap(), b"my notes");
    enter_path(&mut harness, document::SAVE_PATH, &folder.path().join("no/x.shagreen"));
    wait(&mut harness, "it cannot be written", |h| says(h, "cannot write the file"));
    assert!(window(&harness).document().is_changed());
}

#[test]
fn a_library_is_opened_by_the_same_sheet_and_by_a_walk_through_folders() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("woods")).unwrap();
    let path = folder.path().join("woods/mine.json");
    std::fs::write(&path, starter_bytes()).unwrap();
    let mut harness = author();
    open(&mut harness, folder.path());
    wait(&mut harness, "the folder is read", |h| says(h, "woods/"));
    click(&mut harness, "woods/");
    wait(&mut harness, "the folder is read", |h| says(h, "mine.json"));
    click(&mut harness, "mine.json");
    wait(&mut harness, "it is open", |h| matches!(window(h).project().library, ProjectLibrary::File(_)));
    harness.run_steps(2);
    assert_eq!(window(&harness).session().textures().len(), 25);
    let file = window(&harness).project().library.clone();
    keys(&mut harness, Modifiers::COMMAND, Key::Z);
    assert_eq!(window(&harness).project(), &new_project(), "it can be undone");
    keys(&mut harness, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    assert_eq!(window(&harness).project().library, file);

    // A library file in the same folder is stored by its file name; an embedded library is part of the project.
    let beside = folder.path().join("woods/project.shagreen");
    save_as(&mut harness, &beside);
    wait_until_saved(&mut harness);
    let text = std::fs::read_to_string(&beside).unwrap();
    assert!(text.contains("\"file\":\"mine.json\"") || text.contains("\"file\": \"mine.json\""), "{text}");
    menu(&mut harness, document::KEEP_INSIDE);
    assert!(matches!(window(&harness).project().library, ProjectLibrary::Inside(_)));
    keys(&mut harness, Modifiers::COMMAND, Key::S);
    wait_until_saved(&mut harness);
    std::fs::remove_file(&path).unwrap();
    assert_eq!(project_in(&beside).library, window(&harness).project().library);
}

#[test]
fn a_project_that_is_dropped_is_opened() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.shagreen");
    let mut harness = author();
    rename(&mut harness, "Oak copy");
    save_as(&mut harness, &path);
    wait_until_saved(&mut harness);
    let project = window(&harness).project().clone();
    menu(&mut harness, document::NEW);
    drop_files(&mut harness, &[(&path.display().to_string(), b"")]);
    wait(&mut harness, "it is open", |h| window(h).project() == &project);
}

fn keeping(folder: &Path) -> StoragePaths {
    StoragePaths {
        recovery: Some(folder.join("recovery")),
        settings: Some(folder.join("settings.json")),
        ..StoragePaths::default()
    }
}

fn files_in(folder: &Path) -> Vec<PathBuf> {
    std::fs::read_dir(folder).map_or(Vec::new(), |all| all.map(|entry| entry.unwrap().path()).collect())
}

/// After a kill at any time, the state of at most [`INTERVAL`] before can be recovered.
#[test]
fn work_survives_a_crash() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let kept = || Begin { keeping: keeping(folder.path()), ..begin(new_project()) };
    let mut harness = author_of(kept(), SIZE);
    assert!(!says(&harness, document::RECOVERED_TITLE));
    rename(&mut harness, "Oak copy");
    let project = window(&harness).project().clone();
    let has_it =
        || files_in(&at("recovery")).iter().any(|path| path.extension().is_some_and(|e| e == "shagreen"));
    let begun = std::time::Instant::now();
    wait(&mut harness, "it is written", |_| has_it());
    assert!(begun.elapsed() < 2 * INTERVAL, "{:?}", begun.elapsed());
    // Simulates the files after a kill, with the lock released.
    harness.run_steps(2);
    std::fs::create_dir(at("crashed")).unwrap();
    for path in files_in(&at("recovery")) {
        std::fs::copy(&path, at("crashed").join(path.file_name().unwrap())).unwrap();
    }
    drop(harness);
    assert!(files_in(&at("recovery")).is_empty(), "closed in peace, it leaves nothing");
    std::fs::remove_dir(at("recovery")).unwrap();
    std::fs::rename(at("crashed"), at("recovery")).unwrap();

    let mut harness = author_of(kept(), SIZE);
    assert!(says(&harness, document::RECOVERED_TITLE) && says(&harness, document::RECOVERED_HELP));
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, &document::about(document::RECOVER, document::UNTITLED));
    harness.run_steps(3);
    assert_eq!(window(&harness).project(), &project);
    assert!(window(&harness).document().is_changed(), "no file has it yet");
    save_as(&mut harness, &at("saved.shagreen"));
    wait_until_saved(&mut harness);
    harness.run_steps(3);
    let left: Vec<PathBuf> = files_in(&at("recovery"))
        .into_iter()
        .filter(|path| path.extension().is_none_or(|e| e != "lock"))
        .collect();
    assert_eq!(left, Vec::<PathBuf>::new(), "what is saved needs no rescue");
    drop(harness);

    // The settings contain the project as recent.
    let mut harness = author_of(kept(), SIZE);
    // Ends the tour.
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    click(&mut harness, document::FILE);
    harness.run_steps(2);
    click(&mut harness, "saved");
    wait(&mut harness, "it is open", |h| window(h).project() == &project);
}

#[test]
fn what_was_left_can_be_discarded() {
    let folder = tempfile::tempdir().unwrap();
    let recovery = folder.path().join("recovery");
    std::fs::create_dir(&recovery).unwrap();
    let bytes = shagreen_formats::project::write_project(&new_project(), Path::new(""), "test");
    std::fs::write(recovery.join("1-1.shagreen"), bytes).unwrap();
    std::fs::write(recovery.join("1-1.origin"), "/somewhere/Woods.shagreen").unwrap();
    std::fs::write(recovery.join("1-1.lock"), "").unwrap();
    let mut harness = author_of(Begin { keeping: keeping(folder.path()), ..begin(new_project()) }, SIZE);
    click(&mut harness, &document::about(document::DISCARD, "Woods"));
    harness.run_steps(2);
    assert!(!says(&harness, document::RECOVERED_TITLE));
    assert!(!recovery.join("1-1.shagreen").exists() && !recovery.join("1-1.lock").exists());
}

/// The tour is shown once to new users and can be started again.
#[test]
fn the_first_steps_are_shown_once() {
    let folder = tempfile::tempdir().unwrap();
    let kept = || Begin { keeping: keeping(folder.path()), ..begin(new_project()) };
    let mut harness = author_of(kept(), SIZE);
    for (number, step) in Step::ALL.into_iter().enumerate() {
        let [heading, _] = help::step(step);
        assert!(says(&harness, heading) && says(&harness, &help::progress(number + 1, 4)), "{heading}");
        assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
        // Keyboard and screen reader reach everything during the tour.
        let value = 10.0 + 20.0 * number as f64;
        harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).set_value_accesskit(value);
        harness.run_steps(3);
        assert_eq!(window(&harness).project().texture().at.x(), value);
        click(&mut harness, if number == 3 { help::DONE } else { help::NEXT });
        harness.run_steps(2);
    }
    let settings = folder.path().join("settings.json");
    wait(&mut harness, "it is remembered", |_| settings.exists());
    harness.run_steps(5);
    drop(harness);
    let mut harness = author_of(kept(), SIZE);
    assert!(!says(&harness, help::step(Step::Drag)[0]));
    click(&mut harness, help::HELP);
    harness.run_steps(2);
    click(&mut harness, help::TOUR);
    harness.run_steps(2);
    assert!(says(&harness, help::step(Step::Drag)[0]));
    click(&mut harness, help::SKIP);
    harness.run_steps(2);
    assert!(!says(&harness, help::SKIP));
}

#[test]
fn a_project_of_the_gallery_is_opened_and_heard() {
    let mut harness = author();
    menu(&mut harness, gallery::GALLERY);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    for each in GALLERY {
        assert!(harness.query_by_label(&gallery::open(each.title)).is_some(), "{}", each.title);
    }
    click(&mut harness, &gallery::open("Couch fabrics"));
    harness.run_steps(3);
    let project = window(&harness).project().clone();
    assert_eq!((project.authored.len(), project.texture().name.as_str()), (5, "Bouclé"));
    assert!(!window(&harness).document().is_changed());
    assert!(window(&harness).session().authored().is_some());
    rename(&mut harness, "Mine");
    menu(&mut harness, gallery::GALLERY);
    click(&mut harness, &gallery::open("Garden"));
    harness.run_steps(2);
    assert!(says(&harness, document::LEAVE_TITLE), "what was changed is not lost");
}

/// New projects are copies of the template, or default projects while the template is unreadable. Unsaved changes are
/// never discarded without asking.
#[test]
fn new_projects_begin_like_a_chosen_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("Woods.shagreen");
    let mut harness = author();
    rename(&mut harness, "Oak copy");
    save_as(&mut harness, &path);
    wait_until_saved(&mut harness);
    let saved = window(&harness).project().clone();
    menu(&mut harness, document::TEMPLATE);
    menu(&mut harness, document::NEW);
    wait(&mut harness, "a copy of it", |h| window(h).document().path().is_none());
    assert_eq!(window(&harness).project(), &saved);
    assert!(!window(&harness).document().is_changed());
    // The copy has no file, so the template is not overwritten.
    rename(&mut harness, "Ash copy");
    keys(&mut harness, Modifiers::COMMAND, Key::S);
    harness.run_steps(3);
    assert!(says(&harness, document::SAVE_TITLE), "it asks where");
    click(&mut harness, document::CANCEL);
    harness.run_steps(4);

    let other = folder.path().join("Other.shagreen");
    std::fs::rename(&path, &other).unwrap();
    let changed = window(&harness).project().clone();
    menu(&mut harness, document::NEW);
    wait(&mut harness, "it is asked", |h| says(h, document::LEAVE_TITLE));
    assert_eq!(window(&harness).project(), &changed);
    click(&mut harness, document::DO_NOT_SAVE);
    wait(&mut harness, "it begins as usual", |h| *window(h).project() == new_project());
    assert!(says(&harness, &document::no_template("")) && says(&harness, "Woods.shagreen"), "why is said");

    // A library cannot be a template, and a project opened afterwards is not a copy.
    std::fs::write(&path, starter_bytes()).unwrap();
    menu(&mut harness, document::NEW);
    wait(&mut harness, "why is said", |h| says(h, &document::is_library(&path.display().to_string())));
    assert_eq!(window(&harness).project(), &new_project());
    open(&mut harness, &other);
    assert_eq!((window(&harness).project(), window(&harness).document().path()), (&saved, Some(&*other)));

    // The template stayed selected. Changes made while it is read are not discarded without asking, and the question
    // appears once.
    std::fs::rename(&other, &path).unwrap();
    harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).set_value_accesskit(63.0);
    let (key, modifiers) = (Key::N, Modifiers::COMMAND);
    harness.input_mut().events.push(egui::Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers,
    });
    wait(&mut harness, "it is asked", |h| says(h, document::LEAVE_TITLE));
    assert_eq!(window(&harness).project().texture().at.x(), 63.0);
    click(&mut harness, document::DO_NOT_SAVE);
    wait(&mut harness, "a copy of it", |h| window(h).document().path().is_none());
    assert_eq!(window(&harness).project(), &saved);
}

/// The zoom factor is stored and restored within bounds.
#[test]
fn the_scale_is_remembered() {
    let folder = tempfile::tempdir().unwrap();
    let settings = folder.path().join("settings.json");
    let keeping = StoragePaths { settings: Some(settings.clone()), ..StoragePaths::default() };
    for (before, after) in [("1.5", 1.5), ("40.0", 1.8)] {
        std::fs::write(&settings, format!(r#"{{"has_seen_tour": true, "scale": {before}}}"#)).unwrap();
        let harness = author_of(Begin { keeping: keeping.clone(), ..begin(new_project()) }, [1920.0, 1080.0]);
        assert_eq!(harness.ctx.zoom_factor(), after);
    }
    let mut harness = author_of(Begin { keeping, ..begin(new_project()) }, [1920.0, 1080.0]);
    harness.ctx.set_zoom_factor(1.25);
    wait(&mut harness, "it is written", |_| {
        std::fs::read_to_string(&settings).is_ok_and(|text| text.contains("\"scale\": 1.25"))
    });
}
