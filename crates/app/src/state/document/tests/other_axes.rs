//! A project whose library file gets another axis on disk.

use std::path::Path;
use std::sync::Arc;

use shagreen_core::space::SpacePoint;
use shagreen_core::space::texture_path::UserPath;
use shagreen_formats::library::{Library, write_library};
use shagreen_formats::project::{LibraryFile, Project, ProjectLibrary, sha256_hex, write_project};
use shagreen_formats::starter::starter_library;
use shagreen_studio::axes::placed_on;

use super::support::{read, wait};
use super::{CREATED_BY, Came, Document};
use crate::choices::conflict::{Change, Part};
use crate::state::edit::{Edit, PathChange, edited};
use crate::state::recovery::{Recovery, leftovers};

/// Writes the starter library with these axes to a file.
fn write(path: &Path, axes: &[&str]) -> LibraryFile {
    let axes: Vec<String> = axes.iter().map(|name| (*name).to_owned()).collect();
    let library: Library = placed_on(&starter_library().unwrap(), &axes).unwrap();
    let bytes = write_library(&library);
    std::fs::write(path, &bytes).unwrap();
    LibraryFile { path: path.to_owned(), sha256: sha256_hex(&bytes), library }
}

/// Project with two axes and a path, whose library file has three axes now.
fn changed_on_disk(folder: &Path) -> Project {
    let library = folder.join("mine.json");
    let file = write(&library, &["rough-smooth", "hard-soft"]);
    let path = vec![SpacePoint::plane(20.0, 30.0), SpacePoint::plane(60.0, 70.0)];
    let edits = [
        Edit::MovePoint(path[0]),
        Edit::ChangePath(PathChange::Draw, Some(UserPath { points: path, ..UserPath::default() })),
        Edit::KeepSnapshot,
    ];
    let begun = Project::new(ProjectLibrary::File(Arc::new(file)), "New texture");
    let project = edits.into_iter().fold(begun, |project, edit| edited(&project, edit));
    write(&library, &["rough-smooth", "hard-soft", "centroid"]);
    project
}

fn n_axes(project: &Project) -> Vec<usize> {
    let texture = project.texture();
    let points = texture.path.iter().flat_map(|path| &path.points).chain([&texture.at]);
    points.chain([&project.snapshots[0].at]).map(|point| point.n_axes()).collect()
}

/// A drag stores a position with three coordinates. The path had two.
#[test]
fn a_dragged_point_with_a_path_is_saved_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("Woods.shagreen");
    let project = changed_on_disk(folder.path());
    std::fs::write(&path, write_project(&project, folder.path(), CREATED_BY)).unwrap();
    let (opened, file) = read(&path);
    assert_eq!(n_axes(&opened), [3; 4]);
    let mut document = Document::new(&opened, Some(file));
    document.follow(&opened, 1);
    assert!(!document.is_changed(), "opening is no edit");
    let at = SpacePoint::of(&[1.0, 2.0, 3.0]).unwrap();
    let mut drawn = opened.texture().path.clone().unwrap();
    drawn.points.push(at);
    let edits = [Edit::MovePoint(at), Edit::ChangePath(PathChange::AddPoint, Some(drawn))];
    let edited = edits.into_iter().fold(opened, |project, edit| edited(&project, edit));
    document.save(&edited, path.clone(), &egui::Context::default());
    assert!(matches!(wait(&mut document), Came::Saved(_)));
    assert_eq!(read(&path).0, edited);
}

#[test]
fn a_dragged_point_with_a_path_is_recovered() {
    let folder = tempfile::tempdir().unwrap();
    let [path, recovery] = ["Woods.shagreen", "recovery"].map(|name| folder.path().join(name));
    std::fs::write(&path, write_project(&changed_on_disk(folder.path()), folder.path(), CREATED_BY)).unwrap();
    let edit = Edit::MovePoint(SpacePoint::of(&[1.0, 2.0, 3.0]).unwrap());
    let dragged = edited(&read(&path).0, edit);
    let slot = Recovery::new(&recovery).unwrap();
    slot.keep_aside(&dragged, None).unwrap();
    let found = leftovers(&recovery).remove(0);
    assert_eq!((read(&found.path()).0, n_axes(&dragged)), (dragged.clone(), vec![3; 4]));
}

/// Another window has changed the notes alone: the number of coordinates follows from the library.
#[test]
fn points_of_a_changed_file_are_compared_on_the_axes_of_the_space() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("Woods.shagreen");
    let project = changed_on_disk(folder.path());
    std::fs::write(&path, write_project(&project, folder.path(), CREATED_BY)).unwrap();
    let (opened, file) = read(&path);
    let mut document = Document::new(&opened, Some(file));
    let there = edited(&project, Edit::SetProjectNotes("theirs".to_owned()));
    std::fs::write(&path, write_project(&there, folder.path(), CREATED_BY)).unwrap();
    let here = edited(&opened, Edit::Rename("Oak".to_owned()));
    document.save(&here, path, &egui::Context::default());
    let Came::Conflict(conflict) = wait(&mut document) else { panic!("a conflict") };
    let found: Vec<(Part, Change)> =
        conflict.differences.unwrap().into_iter().map(|one| (one.part, one.change)).collect();
    assert_eq!(found, [(Part::Texture("Oak".to_owned()), Change::Here), (Part::Notes, Change::There)]);
}
