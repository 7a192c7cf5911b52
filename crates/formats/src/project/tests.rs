mod further_axes;

use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde_json::{Value, json};
use shagreen_core::space::authoring::{Outside, Weights};
use shagreen_core::space::texture_path::UserPath;
use shagreen_core::space::texture_path::{Along, AtEnd};
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::shape::Shape;

use super::{
    AuthoredTexture, BlendChoice, LibraryFile, Project, ProjectError, ProjectLibrary, read_project,
    read_project_on, sha256_hex, write_project,
};
use crate::built_in::BuiltIn;
use crate::library::{Attribute, Attributes, Place, TextureEntry, read_library, write_library};
use crate::placed_space::{PlacedSpace, PlacedTexture};
use crate::starter::{starter_bytes, starter_library};

const BY: &str = "shagreen test";

fn at(rough_smooth: f64, hard_soft: f64) -> SpacePoint {
    SpacePoint::plane(rough_smooth, hard_soft)
}

fn named(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn nothing(_: &Path) -> io::Result<Vec<u8>> {
    Err(io::ErrorKind::NotFound.into())
}

/// A project that uses every feature.
fn full() -> Project {
    let library = starter_library().unwrap();
    let path = UserPath {
        points: vec![at(1.0 / 3.0, 2.0), at(50.0, 60.25)],
        along: Along::Time,
        length_m: 0.123,
        length_secs: 2.5,
        at_end: AtEnd::Repeat,
    };
    let blend = BlendChoice {
        mode: Mode::Parametric,
        weights: Weights::Natural,
        outside: Outside::Extrapolated,
        locked: BTreeSet::from(["cork".to_owned()]),
    };
    let oak = AuthoredTexture {
        color: 5,
        notes: "line one\nline two".to_owned(),
        tags: vec!["wood".to_owned()],
        at: at(100.0 / 7.0, 33.3),
        blend,
        shape: Shape { level_db: -10.0 / 3.0, direction_deg: 45.0, ..Shape::default() },
        path: Some(path),
        picture: library.textures[3].picture.clone().map(Arc::new),
        ..AuthoredTexture::new(7, "Oak \"copy\"")
    };
    let values = vec![Attribute { name: "warm-cold".to_owned(), value: 12.5 }];
    let placed = |id: &str| PlacedTexture {
        id: id.to_owned(),
        place: Place::new(at(10.5, 20.25), LabelSource::SimulatedRaters),
        attributes: Some(Attributes { source: LabelSource::SimulatedRaters, values: values.clone() }),
    };
    let space = PlacedSpace {
        textures: vec![placed("cork"), placed("felt")],
        axes: Some(vec!["warm-cold".to_owned(), "flat-bumpy".to_owned()]),
        report: json!({"stress": [0.1, 0.05]}),
    };
    let mut project = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Simulated), "New texture");
    project.authored.push(Arc::new(oak.clone()));
    project.snapshots.push(Arc::new(oak));
    let added = TextureEntry { id: "added".to_owned(), ..library.textures[2].clone() };
    project.joined.push(Arc::new(added));
    project.own.insert("added".to_owned());
    project.renamed.insert("cork".to_owned(), "Cork, sanded".to_owned());
    project.starred.insert("felt".to_owned());
    project.notes = "für später".to_owned();
    (project.selected, project.solo) = (1, Some("cork".to_owned()));
    project.compared = Some([2, 1]);
    (project.space, project.axes) = (Some(Arc::new(space)), Some(named(&["a-b", "c-d"])));
    project
}

fn back(project: &Project) -> Project {
    let bytes = write_project(project, Path::new("/somewhere"), BY);
    let read = read_project(&bytes, Path::new("/somewhere"), &nothing).unwrap();
    assert_eq!(read.warnings, Vec::<String>::new());
    assert_eq!(write_project(&read.value, Path::new("/somewhere"), BY), bytes);
    read.value
}

#[test]
fn what_is_written_is_read_back() {
    for project in [Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "New texture"), full()] {
        assert_eq!(back(&project), project);
    }
    let mut inside = full();
    inside.library = ProjectLibrary::Inside(Arc::new(starter_library().unwrap()));
    assert_eq!(back(&inside), inside);
}

/// Files of every version open with all their contents, and writing them again loses nothing.
#[test]
fn every_version_opens() {
    let bytes = include_bytes!("../../../../vectors/project/1.0.shagreen");
    let read = read_project(bytes, Path::new("/somewhere"), &nothing).unwrap();
    assert_eq!(read.warnings, Vec::<String>::new());
    let project = read.value;
    let [first, second] = &project.authored[..] else { panic!("not two textures") };
    assert_eq!((first.key, first.name.as_str(), first.at), (3, "First", at(12.5, 87.25)));
    assert_eq!((first.blend.mode, first.blend.outside), (Mode::Shared, Outside::Clamped));
    assert_eq!((second.at, second.color, second.notes.as_str()), (at(100.0 / 3.0, 0.0), 6, "noted"));
    assert_eq!((second.blend.mode, second.blend.outside), (Mode::Field, Outside::Extrapolated));
    assert!(second.blend.is_locked("cork"));
    let path = second.path.as_ref().unwrap();
    assert_eq!(
        (path.along, path.at_end, path.length_m, path.points.len()),
        (Along::Distance, AtEnd::Hold, 0.08, 3)
    );
    assert_eq!((project.selected, project.solo.as_deref()), (1, Some("cork")));
    let [snapshot] = &project.snapshots[..] else { panic!("not one snapshot") };
    assert_eq!((snapshot.blend.mode, snapshot.blend.weights), (Mode::Power, Weights::Natural));
    let space = project.space.as_ref().unwrap();
    assert_eq!((space.textures[0].id.as_str(), space.textures[0].place.at), ("cork", at(40.0, 60.0)));
    assert_eq!(space.textures[0].place.source, LabelSource::SimulatedRaters);
    // Its axes are attributes, not the axes of its positions with the same names.
    assert_eq!(project.axes, Some(named(&["attribute:warm-cold", "attribute:flat-bumpy"])));
    assert_eq!(project.starred.len(), 2);
    assert_eq!(project.library, ProjectLibrary::BuiltIn(BuiltIn::Starter));
    assert_eq!(back(&project), project);
    let written: Value =
        serde_json::from_slice(&write_project(&project, Path::new("/somewhere"), BY)).unwrap();
    assert_eq!(written["of_a_later_version"], json!({ "kept": [1, 2, 3] }));
    assert_eq!((&written["version"], &written["axes"]), (&json!("1.0"), &json!(["warm-cold", "flat-bumpy"])));
}

/// A shape has only the values that are not neutral, and a project without shapes has the version that older programs
/// read completely.
#[test]
fn shapes_are_read_and_written() {
    let bytes = include_bytes!("../../../../vectors/project/1.1.shagreen");
    let read = read_project(bytes, Path::new("/somewhere"), &nothing).unwrap();
    assert_eq!(read.warnings, Vec::<String>::new());
    let mut project = read.value;
    let all = Shape {
        level_db: -4.5,
        grain: 0.8,
        brightness_db_per_octave: 1.25,
        softness: 2.0,
        friction: 0.0,
        relief: 1.5,
        direction_deg: -45.0,
    };
    let expected = [all, Shape { grain: 2.0, ..Shape::default() }, Shape::default()];
    let shapes: Vec<Shape> = project.authored.iter().map(|texture| texture.shape).collect();
    assert_eq!(shapes, expected);
    assert_eq!(project.snapshots[0].shape, Shape { direction_deg: 90.0, ..Shape::default() });
    assert_eq!(back(&project), project);
    let wire = |project: &Project| -> Value {
        serde_json::from_slice(&write_project(project, Path::new("/somewhere"), BY)).unwrap()
    };
    let written = wire(&project);
    assert_eq!(written["version"], "1.1");
    assert_eq!(written["authored"][0]["shape"]["of_a_later_version"], json!({ "kept": true }));
    assert_eq!(written["authored"][1]["shape"], json!({ "grain": 2.0 }));
    assert_eq!(written["authored"][2].get("shape"), None);
    project.snapshots.clear();
    for texture in &mut project.authored {
        Arc::make_mut(texture).shape = Shape::default();
    }
    // What a later version knows of the shape is kept.
    assert_eq!(wire(&project)["version"], "1.1");
    project.authored.remove(0);
    let plain = wire(&project);
    assert_eq!((&plain["version"], plain["authored"][0].get("shape")), (&json!("1.0"), None));
}

/// Marks say which added textures belong to the authored textures that pin them, and a project without marks has the
/// version that older programs read completely.
#[test]
fn added_textures_belong_to_the_authored_textures_that_pin_them() {
    let bytes = include_bytes!("../../../../vectors/project/1.2.shagreen");
    let read = read_project(bytes, Path::new("/somewhere"), &nothing).unwrap();
    assert_eq!(read.warnings, Vec::<String>::new());
    let mut project = read.value;
    assert_eq!(project.own, BTreeSet::from(["dial", "handle"].map(str::to_owned)));
    assert_eq!(back(&project), project);
    let wire = |project: &Project| -> Value {
        serde_json::from_slice(&write_project(project, Path::new("/somewhere"), BY)).unwrap()
    };
    let written = wire(&project);
    assert_eq!((&written["version"], &written["joined"][0]["own"]), (&json!("1.2"), &json!(true)));
    assert_eq!(written["joined"][1]["of_a_later_version"], json!({ "kept": true }));
    assert!([1, 2].into_iter().all(|joined| written["joined"][joined].get("own").is_none()));

    let list = project.textures_on(starter_library().unwrap());
    let n = list.textures.len();
    let left_out = |project: &Project, key: usize| {
        let locked = &project.authored[key].blend.locked;
        project.left_out(&list.textures, |id| locked.contains(id))
    };
    // The pin counts in every mode.
    assert_eq!((left_out(&project, 0), left_out(&project, 1)), (vec![n - 1], vec![n - 4]));
    let with_places = project.with_places_of(&list, |id| id == "dial");
    let changed: Vec<usize> =
        (0..n).filter(|index| with_places.textures[*index] != list.textures[*index]).collect();
    assert_eq!((changed, with_places.textures[n - 4].place), (vec![n - 4], None));
    assert_eq!((project.n_without_pin("dial"), project.n_without_pin("recorded")), (1, 2));

    project.own.clear();
    assert!(left_out(&project, 0).is_empty());
    assert_eq!(wire(&project)["version"], "1.0");
    project.own.insert("gone".to_owned());
    assert_eq!(wire(&project)["version"], "1.0", "no added texture has this id");
}

/// The library has a `cork`, so that the list shows the added ones under other identifiers, which pins use.
#[test]
fn added_textures_have_their_identifiers_of_the_list() {
    let cork = |id: &str| {
        let library = starter_library().unwrap();
        Arc::new(TextureEntry { id: id.to_owned(), ..library.textures[0].clone() })
    };
    let mut project = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "New texture");
    project.joined = vec![cork("cork"), cork("cork"), cork("cork-2")];
    project.own.insert("cork".to_owned());
    let bytes = write_project(&project, Path::new("/somewhere"), BY);
    let mut wire: Value = serde_json::from_slice(&bytes).unwrap();
    wire["joined"][1]["own"] = json!(false);
    let bytes = serde_json::to_vec(&wire).unwrap();
    let mut project = read_project(&bytes, Path::new("/somewhere"), &nothing).unwrap().value;
    let list = project.textures_on(starter_library().unwrap());
    let of_list: Vec<&str> = list.textures[list.textures.len() - 3..].iter().map(|t| &*t.id).collect();
    let of_project: Vec<&str> = project.joined.iter().map(|entry| &*entry.id).collect();
    assert_eq!((&of_project, of_project.as_slice()), (&of_list, ["cork-2", "cork-3", "cork-2-2"].as_slice()));
    assert_eq!(project.own, BTreeSet::from(["cork-2".to_owned()]), "only the marked one");
    assert_eq!(back(&project), project);

    // A pin of the library's texture is not one of the added texture.
    let locked = ["cork", "cork-2"].map(str::to_owned);
    Arc::make_mut(&mut project.authored[0]).blend.locked = BTreeSet::from(locked);
    assert_eq!(project.blend_of_new().locked, BTreeSet::from(["cork".to_owned()]));
    project.add_textures(vec![cork("cork"), cork("new")]);
    assert_eq!((&*project.joined[3].id, &*project.joined[4].id), ("cork-4", "new"));
    // A new identifier is not too long for a file.
    let long = "x".repeat(200);
    project.add_textures(vec![cork(&long), cork(&long)]);
    assert_eq!(back(&project), project);
}

/// A project and the library in its folder may be moved together; a changed library raises a warning.
#[test]
fn a_library_beside_the_project_is_found_where_both_went() {
    let bytes = write_library(&starter_library().unwrap());
    let file = LibraryFile {
        path: PathBuf::from("/somewhere/libraries/woods.json"),
        sha256: sha256_hex(&bytes),
        library: read_library(&bytes).unwrap().value,
    };
    let project = Project::new(ProjectLibrary::File(Arc::new(file)), "New texture");
    let written = write_project(&project, Path::new("/somewhere"), BY);
    let other = Path::new("/elsewhere");
    let read_there = |path: &Path| {
        if path == Path::new("/elsewhere/libraries/woods.json") { Ok(bytes.clone()) } else { nothing(path) }
    };
    let moved = read_project(&written, other, &read_there).unwrap();
    assert!(moved.warnings.is_empty());
    let ProjectLibrary::File(found) = &moved.value.library else { panic!("not a file") };
    assert_eq!(found.library, starter_library().unwrap());
    // Outside the project's folder, the path is absolute.
    let far = write_project(&project, Path::new("/elsewhere"), BY);
    let wire: Value = serde_json::from_slice(&far).unwrap();
    assert_eq!(wire["library"]["file"], "/somewhere/libraries/woods.json");
    // Another library under the same name raises a warning.
    let mut changed = starter_library().unwrap();
    changed.textures.truncate(3);
    let changed = write_library(&changed);
    let read = read_project(&written, other, &|_| Ok(changed.clone())).unwrap();
    assert!(read.warnings[0].contains("was changed since"), "{:?}", read.warnings);
    let missing = read_project(&written, other, &nothing).unwrap_err().to_string();
    assert!(missing.contains("restore the file") && missing.contains("woods.json"), "{missing}");
    let none = read_project(&written, other, &|_| Ok(b"{}".to_vec())).unwrap_err().to_string();
    assert!(none.contains("not a texture library") && none.contains("woods.json"), "{none}");
}

/// On every system, a project on this computer cannot name a library on another one.
#[test]
fn a_library_on_another_computer_is_not_asked_for() {
    let project = |library: &str| {
        let wire = json!({"format": "shagreen-project", "version": "1.0", "units": {"length": "mm", "time": "s"},
            "library": {"file": library}, "authored": []});
        serde_json::to_vec(&wire).unwrap()
    };
    let never = |path: &Path| -> io::Result<Vec<u8>> { panic!("{} was read", path.display()) };
    for library in [r"\\server\share\woods.json", "//server/share/woods.json", r"\\?\UNC\server\woods.json"] {
        for folder in ["/somewhere", r"\\other\share"] {
            let error = read_project(&project(library), Path::new(folder), &never).unwrap_err();
            assert!(matches!(error, ProjectError::Network { .. }), "{library} in {folder}: {error}");
        }
        // A project on the same computer was opened there by the user.
        let beside = read_project(&project(library), Path::new(r"\\server\share"), &nothing).unwrap_err();
        assert!(matches!(beside, ProjectError::LibraryFile { .. }), "{beside}");
        let other = ProjectLibrary::BuiltIn(BuiltIn::Starter);
        assert_eq!(read_project_on(&project(library), other.clone()).unwrap().value.library, other);
    }
}

fn changed(change: impl FnOnce(&mut Value)) -> Result<(Project, Vec<String>), ProjectError> {
    let mut wire: Value = serde_json::from_slice(&write_project(&full(), Path::new("/"), BY)).unwrap();
    change(&mut wire);
    let read = read_project(&serde_json::to_vec(&wire).unwrap(), Path::new("/"), &nothing)?;
    Ok((read.value, read.warnings))
}

/// Part of an error text, and the change that causes the error.
type Fault = (&'static str, fn(&mut Value));

#[test]
fn each_fault_is_named() {
    let faults: [Fault; 28] = [
        ("not a project", |wire| wire["format"] = json!("shagreen-library")),
        ("version 2.0", |wire| wire["version"] = json!("2.0")),
        ("version \"one\"", |wire| wire["version"] = json!("one")),
        ("length in inch", |wire| wire["units"]["length"] = json!("inch")),
        ("the field `authored` is missing", |wire| drop(wire.as_object_mut().unwrap().remove("authored"))),
        ("library \"other\"", |wire| wire["library"] = json!({"built_in": "other"})),
        ("exactly one of the fields \"built_in\"", |wire| wire["library"] = json!({})),
        ("cannot be read", |wire| wire["library"] = json!({"file": "none.json"})),
        ("the position of", |wire| wire["authored"][1]["rough_smooth"] = json!(101)),
        ("the position of", |wire| wire["authored"][1]["path"]["points"][0] = json!([0, -1])),
        ("the position of \"Oak \"copy\"\" is invalid: it has `further`", |wire| {
            wire["authored"][1]["further"] = json!([5]);
            drop(wire["authored"][1].as_object_mut().unwrap().remove("hard_soft"));
        }),
        ("point 2 of the path of \"Oak \"copy\"\" has 3 coordinates, but its position has 2", |wire| {
            wire["authored"][1]["path"]["points"][1] = json!([1, 2, 3]);
        }),
        ("point 1 of the path of \"Oak \"copy\"\" has 2 coordinates, but its position has 3", |wire| {
            wire["authored"][1]["further"] = json!([5]);
        }),
        ("position of texture \"felt\" has 1 coordinate, but the number of axes is 2", |wire| {
            drop(wire["space"]["textures"][1]["space"].as_object_mut().unwrap().remove("hard_soft"));
        }),
        ("one to six different names", |wire| wire["axes"] = json!(["a", "b", "c"])),
        ("one to six different names", |wire| {
            (wire["version"], wire["axes"]) = (json!("1.3"), json!(["a-b", "attribute:A-B"]));
        }),
        ("one to six different names", |wire| {
            (wire["version"], wire["axes"]) = (json!("1.3"), json!(["a", "b", "c", "d", "e", "f", "g"]));
        }),
        ("blend.mode \"x\"", |wire| wire["authored"][1]["blend"]["mode"] = json!("x")),
        ("blend.weights \"x\"", |wire| wire["authored"][1]["blend"]["weights"] = json!("x")),
        ("blend.outside \"x\"", |wire| wire["authored"][1]["blend"]["outside"] = json!("x")),
        ("the shape of \"Oak \"copy\"\" is invalid: level of the shape is 99", |wire| {
            wire["authored"][1]["shape"]["level_db"] = json!(99);
        }),
        ("softness of the shape is 0; it must be from 0.25 to 4", |wire| {
            wire["snapshots"][0]["shape"] = json!({"softness": 0});
        }),
        ("damaged", |wire| wire["authored"][0]["shape"] = json!({"grain": "coarse"})),
        ("`own` of the added texture", |wire| wire["joined"][0]["own"] = json!(1)),
        ("color 8", |wire| wire["authored"][0]["color"] = json!(8)),
        ("same key 7", |wire| wire["authored"][0]["key"] = json!(7)),
        ("length_mm 0", |wire| wire["authored"][1]["path"]["length_mm"] = json!(0)),
        ("picture", |wire| wire["snapshots"][0]["picture"]["media_type"] = json!("image/gif")),
    ];
    for (words, change) in faults {
        let error = changed(change).unwrap_err().to_string();
        assert!(error.contains(words), "{words}: {error}");
    }
    for cut in [0, 1, 20, 400] {
        let bytes = write_project(&full(), Path::new("/"), BY);
        assert!(read_project(&bytes[..cut], Path::new("/"), &nothing).is_err());
    }
    let of_library = read_project(starter_bytes(), Path::new("/"), &nothing).unwrap_err();
    assert!(of_library.to_string().contains("not a project"), "{of_library}");
}

#[test]
fn what_a_newer_program_wrote_is_kept() {
    let (project, warnings) = changed(|wire| {
        wire["version"] = json!("1.9");
        wire["moods"] = json!(["calm"]);
        wire["authored"][1]["mood"] = json!("calm");
    })
    .unwrap();
    assert!(warnings[0].contains("newer than 1.3"), "{warnings:?}");
    let wire: Value = serde_json::from_slice(&write_project(&project, Path::new("/"), BY)).unwrap();
    assert_eq!((&wire["moods"][0], &wire["authored"][1]["mood"]), (&json!("calm"), &json!("calm")));
}

#[test]
fn a_project_without_anything_has_something_to_begin_with() {
    let (project, warnings) = changed(|wire| wire["authored"] = json!([])).unwrap();
    assert_eq!((project.authored.len(), project.selected), (1, 0));
    assert!(warnings[0].contains("no authored texture"), "{warnings:?}");
    let (project, _) = changed(|wire| wire["selected"] = json!(99)).unwrap();
    assert_eq!(project.selected, 1);
}

#[test]
fn what_is_heard_is_what_the_mode_can_do() {
    let choice = full().authored[1].blend.clone();
    let index_of = |id: &str| (id == "cork").then_some(4);
    for mode in Mode::ALL {
        let blending = BlendChoice { mode, ..choice.clone() }.blending(index_of);
        assert_eq!((blending.check(), blending.mode), (Ok(()), mode));
        assert_eq!(blending.weights == Weights::Natural, mode == Mode::Parametric);
        assert_eq!(blending.locked == [4], mode == Mode::Field);
    }
    let field = BlendChoice { mode: Mode::Field, ..choice };
    assert!(field.is_locked("cork") && !field.is_locked("felt"));
    assert!(!BlendChoice { mode: Mode::Paper, ..field.clone() }.is_locked("cork"));
    assert!(field.blending(|_| None).locked.is_empty());
}

#[test]
fn the_mode_is_field_without_triangles_and_the_choice_stays() {
    let paper = BlendChoice { mode: Mode::Paper, ..full().authored[1].blend.clone() };
    for n_axes in [1, 2] {
        assert_eq!((paper.mode_in_space(n_axes), &*paper.in_space(n_axes)), (Mode::Paper, &paper));
    }
    let field = BlendChoice { mode: Mode::Field, ..paper.clone() };
    assert_eq!((&*paper.in_space(3), &*field.in_space(6)), (&field, &field));
    assert_eq!((paper.mode_in_space(3), field.mode_in_space(6)), (Mode::Field, Mode::Field));
}
