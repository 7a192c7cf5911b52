use super::{LibraryOrigin, OTHER_ENDINGS, Opened, open, open_on};
use crate::axes::placed_on;
use crate::permitted_libraries::{OutsideLibrary, Permitted};
use crate::project::new_project;
use shagreen_core::space::SpacePoint;
use shagreen_core::space::texture_path::UserPath;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::write_library;
use shagreen_formats::picture::PHOTO_ENDINGS;
use shagreen_formats::project::{ProjectLibrary, write_project};
use shagreen_formats::starter::{starter_bytes, starter_library};
use std::sync::Arc;

/// The library file gets a third axis after the project was saved, and loses it again.
#[test]
fn points_have_the_coordinates_of_the_space() {
    let folder = tempfile::tempdir().unwrap();
    let [path, library] = ["a.shagreen", "mine.json"].map(|name| folder.path().join(name));
    std::fs::write(&library, starter_bytes()).unwrap();
    let at = SpacePoint::plane(20.0, 30.0);
    let mut project = new_project();
    let texture = Arc::make_mut(&mut project.authored[0]);
    (texture.at, texture.path) = (at, Some(UserPath { points: vec![at; 2], ..UserPath::default() }));
    project.snapshots.push(Arc::clone(&project.authored[0]));
    let mut wire: serde_json::Value =
        serde_json::from_slice(&write_project(&project, folder.path(), "test")).unwrap();
    wire["library"] = serde_json::json!({ "file": "mine.json" });
    std::fs::write(&path, wire.to_string()).unwrap();
    let opened = || {
        let Ok(Opened::Project(opened)) = open(&path, &Permitted::All) else { panic!("a project") };
        opened
    };
    assert_eq!(opened().warnings, Vec::<String>::new());
    let axes = ["rough-smooth", "hard-soft", "centroid"].map(str::to_owned);
    let three = placed_on(&starter_library().unwrap(), &axes).unwrap();
    std::fs::write(&library, write_library(&three)).unwrap();
    let fitted = opened();
    assert!(fitted.warnings[0].contains("axes (rough-smooth, hard-soft, centroid)"), "{:?}", fitted.warnings);
    for texture in fitted.project.authored.iter().chain(&fitted.project.snapshots) {
        let path = texture.path.clone().unwrap();
        assert_eq!((texture.at, path.points), (at.on(3), vec![at.on(3); 2]));
    }
    // With the starter library, there are two axes again.
    std::fs::write(&path, write_project(&fitted.project, folder.path(), "test")).unwrap();
    assert_eq!(opened().project, fitted.project);
    let on_starter = open_on(&path, None).unwrap();
    assert_eq!((on_starter.project.texture().at, on_starter.warnings.len()), (at, 2));
}

#[test]
fn what_cannot_be_opened_is_explained() {
    let folder = tempfile::tempdir().unwrap();
    let error_of =
        |path: &std::path::Path| format!("{:#}", open(path, &Permitted::All).err().expect("no file to open"));
    let faults: [(&str, &[u8], &str); 6] = [
        ("a", b"hello", "neither a project nor"),
        ("empty", b"", "the file is empty"),
        ("picture", b"\x89PNG\r\n\x1a\n", "this is a PNG picture, neither a project nor"),
        ("b", b"{\"format\": \"shagreen-library\"}", "version missing"),
        ("c", b"{\"format\": \"shagreen-project\"}", "version missing"),
        ("d", b"{\"format\": \"shagreen-project\", \"version\": \"1.0\"}", "damaged"),
    ];
    for (name, bytes, words) in faults {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let error = error_of(&path);
        assert!(error.contains(words) && error.contains(&path.display().to_string()), "{error}");
    }
    assert!(error_of(folder.path()).contains("not a file"));
    assert!(error_of(&folder.path().join("none")).contains("cannot be read"));
}

#[test]
fn photos_of_all_formats_are_taken() {
    assert!(PHOTO_ENDINGS.iter().all(|ending| OTHER_ENDINGS.contains(ending)));
}

#[test]
fn a_library_is_opened_too() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("starter.json");
    std::fs::write(&path, starter_bytes()).unwrap();
    let Ok(Opened::Library(imported)) = open(&path, &Permitted::All) else { panic!("a library") };
    assert_eq!((imported.value.path, imported.value.library.textures.len()), (path, 25));
}

#[test]
fn a_library_outside_the_folder_is_read_with_permission_only() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().canonicalize().unwrap();
    for name in ["elsewhere", "near"] {
        std::fs::create_dir(root.join(name)).unwrap();
        std::fs::write(root.join(name).join("mine.json"), starter_bytes()).unwrap();
    }
    let project = root.join("near/a.shagreen");
    let name_library = |library: &str| {
        let written = write_project(&new_project(), &root, "test");
        let mut wire: serde_json::Value = serde_json::from_slice(&written).unwrap();
        wire["library"] = serde_json::json!({"file": library});
        std::fs::write(&project, wire.to_string()).unwrap();
    };
    let only = |places: &[&str]| Permitted::Only(places.iter().map(|place| root.join(place)).collect());
    let opened = |permitted: &Permitted| match open(&project, permitted) {
        Ok(Opened::Project(opened)) => Ok(opened),
        Ok(Opened::Library(_)) => panic!("a project"),
        Err(error) => Err(error),
    };
    name_library("mine.json");
    assert!(opened(&only(&[])).is_ok(), "beside the project");
    name_library("../elsewhere/mine.json");
    let refused = opened(&only(&["elsewhere/other.json"])).unwrap_err();
    let refused = refused.downcast_ref::<OutsideLibrary>().expect("it is outside");
    assert_eq!(refused.library, root.join("elsewhere/mine.json"));
    for places in [["elsewhere"], ["elsewhere/mine.json"]] {
        assert!(opened(&only(&places)).unwrap().warnings.is_empty(), "{places:?}");
    }
    let warned = opened(&Permitted::AllWarned(Vec::new())).unwrap();
    assert!(warned.warnings[0].contains("outside the folder of the project"), "{:?}", warned.warnings);
    assert!(opened(&Permitted::All).unwrap().warnings.is_empty());
    // A link beside the project: the refusal names what it leads to, which can then be permitted.
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(root.join("elsewhere/mine.json"), root.join("near/link.json")).unwrap();
        name_library("link.json");
        let refused = opened(&only(&[])).unwrap_err();
        let refused = refused.downcast_ref::<OutsideLibrary>().expect("it is outside");
        assert_eq!(refused.library, root.join("elsewhere/mine.json"));
        assert!(opened(&only(&["elsewhere/mine.json"])).is_ok());
        name_library("../elsewhere/mine.json");
    }
    // Another library in its place.
    let chosen = open_on(&project, Some(&root.join("near/mine.json"))).unwrap();
    let ProjectLibrary::File(file) = &chosen.project.library else { panic!("a file") };
    assert_eq!((&file.path, chosen.origin), (&root.join("near/mine.json"), LibraryOrigin::Chosen));
    let without = open_on(&project, None).unwrap();
    assert_eq!(without.project.library, ProjectLibrary::BuiltIn(BuiltIn::Starter));
    assert_eq!((without.warnings.len(), without.origin), (1, LibraryOrigin::Starter));
    assert!(open_on(&project, Some(&project)).is_err(), "a project is no library");
}
