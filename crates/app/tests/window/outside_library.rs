//! The question before a project reads a library outside its folder.

use std::path::{Path, PathBuf};

use egui_kittest::kittest::Queryable as _;
use shagreen_app::Begin;
use shagreen_app::state::files::StoragePaths;
use shagreen_app::strings::document;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::project::{ProjectLibrary, write_project};
use shagreen_formats::starter::starter_bytes;
use shagreen_studio::project::new_project;

use crate::projects::open;
use crate::support::{
    Author, author_of, begin, click, enter_path, says, unnamed_controls, wait, window, write_into,
};

const SIZE: [f32; 2] = [1280.0, 720.0];

/// Folder with projects that name a library outside their own folders, and the settings of a user.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        for name in ["elsewhere", "near"] {
            std::fs::create_dir(folder.path().join(name)).unwrap();
            std::fs::write(folder.path().join(name).join("mine.json"), starter_bytes()).unwrap();
        }
        std::fs::write(folder.path().join("settings.json"), r#"{"has_seen_tour": true}"#).unwrap();
        Self(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a project that names the library elsewhere.
    fn project(&self, name: &str) -> PathBuf {
        let written = write_project(&new_project(), Path::new(""), "test");
        let mut wire: serde_json::Value = serde_json::from_slice(&written).unwrap();
        wire["library"] = serde_json::json!({"file": "../elsewhere/mine.json"});
        let path = self.path("near").join(name);
        std::fs::write(&path, wire.to_string()).unwrap();
        path
    }

    fn begin(&self) -> Begin {
        let keeping = StoragePaths { settings: Some(self.path("settings.json")), ..StoragePaths::default() };
        Begin { keeping, ..begin(new_project()) }
    }
}

fn library_path(harness: &Author) -> Option<PathBuf> {
    match &window(harness).project().library {
        ProjectLibrary::File(file) => Some(file.path.clone()),
        ProjectLibrary::BuiltIn(_) | ProjectLibrary::Inside(_) => None,
    }
}

fn wait_until_open(harness: &mut Author) {
    wait(harness, "it is open", |h| !says(h, document::OUTSIDE_TITLE));
    harness.run_steps(2);
}

#[test]
fn a_library_outside_the_folder_is_asked_about_once_for_each_project() {
    let folder = Folder::new();
    let (first, second) = (folder.project("a.shagreen"), folder.project("b.shagreen"));
    let mut harness = author_of(folder.begin(), SIZE);
    open(&mut harness, &first);
    assert!(says(&harness, document::OUTSIDE_TITLE));
    assert!(says(&harness, &folder.path("elsewhere/mine.json").display().to_string()), "the path is shown");
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, document::CANCEL);
    harness.run_steps(3);
    assert_eq!(window(&harness).project(), &new_project(), "nothing was opened");
    open(&mut harness, &first);
    click(&mut harness, document::READ_LIBRARY);
    wait_until_open(&mut harness);
    assert_eq!(window(&harness).document().path(), Some(&*first));
    assert!(library_path(&harness).is_some() && !window(&harness).document().is_changed());
    let settings = folder.path("settings.json");
    wait(&mut harness, "it is remembered", |_| {
        std::fs::read_to_string(&settings).is_ok_and(|text| text.contains("elsewhere"))
    });
    drop(harness);
    // The next window remembers the answer, for this project only. A file that was named at the start is asked about too.
    let mut harness = author_of(Begin { take: Some(second), ..folder.begin() }, SIZE);
    wait(&mut harness, "it is asked", |h| says(h, document::OUTSIDE_TITLE));
    click(&mut harness, document::CANCEL);
    harness.run_steps(3);
    open(&mut harness, &first);
    assert!(!says(&harness, document::OUTSIDE_TITLE));
    assert_eq!(window(&harness).document().path(), Some(&*first));
}

#[test]
fn a_project_opens_with_another_library_or_without() {
    let folder = Folder::new();
    let project = folder.project("a.shagreen");
    let mut harness = author_of(folder.begin(), SIZE);
    open(&mut harness, &project);
    click(&mut harness, document::OPEN_WITHOUT);
    wait_until_open(&mut harness);
    assert_eq!(window(&harness).project().library, ProjectLibrary::BuiltIn(BuiltIn::Starter));
    assert!(window(&harness).document().path().is_none(), "a copy does not replace the project");

    let mut harness = author_of(folder.begin(), SIZE);
    open(&mut harness, &project);
    click(&mut harness, document::CHOOSE_LIBRARY);
    // A project is no library.
    enter_path(&mut harness, document::OTHER_LIBRARY, &project);
    wait(&mut harness, "it is refused", |h| says(h, "neither a project nor a texture library"));
    write_into(&mut harness, document::OTHER_LIBRARY, "mine.json");
    click(&mut harness, document::USE_LIBRARY);
    wait_until_open(&mut harness);
    assert_eq!(library_path(&harness).unwrap(), folder.path("near/mine.json"));
    assert_eq!(window(&harness).document().path(), Some(&*project));
    assert!(window(&harness).document().is_changed(), "the file still names the other library");
    assert!(harness.query_by_label(document::OUTSIDE_TITLE).is_none());
}
