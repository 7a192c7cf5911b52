//! Positions with other numbers of coordinates than two, and the axes of projects.

use std::path::Path;
use std::sync::Arc;

use proptest::prelude::{prop, proptest};
use serde_json::{Value, json};
use shagreen_core::space::texture_path::UserPath;
use shagreen_core::space::{MOST_AXES, SpacePoint};

use super::{BY, back, full, named, nothing};
use crate::built_in::BuiltIn;
use crate::placed_space::PlacedSpace;
use crate::project::{AuthoredTexture, Project, ProjectLibrary, read_project, write_project};

/// Positions with three coordinates, and axes of all kinds.
#[test]
fn projects_with_further_axes_are_read() {
    let bytes = include_bytes!("../../../../../vectors/project/1.3.shagreen");
    let read = read_project(bytes, Path::new("/somewhere"), &nothing).unwrap();
    assert_eq!(read.warnings, Vec::<String>::new());
    let project = read.value;
    assert_eq!(project.axes, Some(named(&["warm-cold", "attribute:flat-bumpy", "centroid"])));
    let first = &project.authored[0];
    assert_eq!(first.at.coordinates(), [12.5, 87.25, 40.0]);
    let path = first.path.as_ref().unwrap();
    assert_eq!(path.points[1].coordinates(), [30.0, 40.5, 0.0]);
    assert_eq!(project.authored[1].at.coordinates(), [25.0]);
    assert_eq!(project.snapshots[0].at.coordinates(), [70.0, 30.0, 1.0, 2.0, 3.0, 4.0]);
    let of_snapshot = ["rough-smooth", "hard-soft", "centroid", "a-b", "attribute:c-d", "tap frequency"];
    assert_eq!(project.snapshots[0].axes, Some(named(&of_snapshot)));
    assert_eq!(project.authored[0].axes, None);
    let coordinate = |axis: &str| project.coordinates.get("made", axis);
    assert_eq!(["warm-cold", "attribute:flat-bumpy"].map(coordinate), [Some(15.25), Some(60.0)]);
    let space = project.space.as_ref().unwrap();
    assert_eq!(space.axis_names(), ["warm-cold", "flat-bumpy", "rough-smooth", "hard-soft"]);
    assert_eq!(space.textures[0].place.at.coordinates(), [40.0, 60.0, 20.0, 80.5]);
    assert_eq!(back(&project), project);
    let written: Value =
        serde_json::from_slice(&write_project(&project, Path::new("/somewhere"), BY)).unwrap();
    let before: Value = serde_json::from_slice(bytes).unwrap();
    for part in ["version", "axes", "authored", "snapshots", "space"] {
        assert_eq!(written[part], before[part], "{part}");
    }
    assert_eq!(written["joined"][0]["coordinates"], before["joined"][0]["coordinates"]);
}

#[test]
fn a_project_on_any_number_of_axes_goes_there_and_back() {
    let names = ["rough-smooth", "hard-soft", "warm-cold", "centroid", "a-b", "tap frequency"];
    for n_axes in [1, 2, 3, 6] {
        let mut project = full();
        project.axes = Some(named(&names[..n_axes]));
        for texture in project.authored.iter_mut().chain(&mut project.snapshots) {
            let texture = Arc::make_mut(texture);
            texture.at = texture.at.on(n_axes).with(n_axes - 1, 100.0 / 3.0);
            for point in texture.path.iter_mut().flat_map(|path| &mut path.points) {
                *point = point.on(n_axes).with(n_axes - 1, 7.0);
            }
        }
        assert_eq!(back(&project), project, "{n_axes} axes");
        let wire: Value = serde_json::from_slice(&write_project(&project, Path::new("/"), BY)).unwrap();
        // With two axes, the version is that of its other features.
        assert_eq!(wire["version"], if n_axes == 2 { "1.2" } else { "1.3" });
        let texture = &wire["authored"][1];
        assert_eq!(texture.get("hard_soft").is_some(), n_axes > 1);
        assert_eq!(texture["further"].as_array().map_or(0, Vec::len), n_axes.saturating_sub(2));
        assert_eq!(texture["path"]["points"][0].as_array().unwrap().len(), n_axes);
    }
}

/// A library file that changed on disk gives the position of a texture another number of coordinates than its path has.
#[test]
fn a_path_is_written_with_the_coordinates_of_its_texture() {
    for n_axes in [1, 2, 3, 6] {
        let mut project = full();
        let mut fitted = project.clone();
        for texture in project.authored.iter_mut().chain(&mut project.snapshots) {
            let texture = Arc::make_mut(texture);
            texture.at = texture.at.on(n_axes).with(n_axes - 1, 7.0);
        }
        for (texture, mixed) in fitted.authored.iter_mut().zip(&project.authored) {
            let texture = Arc::make_mut(texture);
            texture.at = mixed.at;
            texture.fit(n_axes);
        }
        let read = back(&project);
        assert_eq!(read.authored, fitted.authored, "{n_axes} axes");
        let wire: Value = serde_json::from_slice(&write_project(&project, Path::new("/"), BY)).unwrap();
        assert_eq!(wire["version"], if n_axes == 2 { "1.2" } else { "1.3" });
    }
    // A path with one more point, which has the coordinates of the new space.
    let mut project = full();
    let texture = Arc::make_mut(&mut project.authored[1]);
    texture.path.as_mut().unwrap().points.push(SpacePoint::of(&[1.0, 2.0, 3.0]).unwrap());
    let points = back(&project).authored[1].path.clone().unwrap().points;
    assert!(points.len() == 3 && points.iter().all(|point| point.n_axes() == 2), "{points:?}");
}

#[test]
fn axes_of_a_snapshot_fit_its_coordinates() {
    let mut project = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "New texture");
    let axes = named(&["centroid", "rough-smooth"]);
    let snapshot = AuthoredTexture { axes: Some(axes), ..AuthoredTexture::new(1, "New texture") };
    project.snapshots.push(Arc::new(snapshot));
    assert_eq!(back(&project), project);
    let wire: Value = serde_json::from_slice(&write_project(&project, Path::new("/"), BY)).unwrap();
    assert_eq!(wire["version"], "1.3");
    for wrong in [json!(["centroid"]), json!(["centroid", "Centroid"]), json!(["a", "b", "c"])] {
        let mut wire = wire.clone();
        wire["snapshots"][0]["axes"] = wrong;
        let error = read_project(wire.to_string().as_bytes(), Path::new("/"), &nothing).unwrap_err();
        assert!(error.to_string().contains("one different name for each of its coordinates (2)"), "{error}");
    }
}

/// Before version 1.3, the axes of a project were attributes, whatever the axes of the positions.
#[test]
fn two_axes_have_the_version_that_gives_them_again() {
    let wire = |project: &Project| -> Value {
        serde_json::from_slice(&write_project(project, Path::new("/somewhere"), BY)).unwrap()
    };
    let mut project = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Simulated), "New texture");
    for (axes, version, written) in [
        (["sticky-slippery", "flat-bumpy"], "1.0", ["sticky-slippery", "flat-bumpy"]),
        (["attribute:rough-smooth", "flat-bumpy"], "1.0", ["rough-smooth", "flat-bumpy"]),
        (["rough-smooth", "flat-bumpy"], "1.3", ["rough-smooth", "flat-bumpy"]),
        (["sticky-slippery", "centroid"], "1.3", ["sticky-slippery", "centroid"]),
        (["sticky-slippery", "attribute:centroid"], "1.0", ["sticky-slippery", "centroid"]),
        (["attribute:sticky-slippery", "flat-bumpy"], "1.3", ["attribute:sticky-slippery", "flat-bumpy"]),
    ] {
        project.axes = Some(named(&axes));
        let found = wire(&project);
        assert_eq!((&found["version"], &found["axes"]), (&json!(version), &json!(written)), "{axes:?}");
        assert_eq!(back(&project), project, "{axes:?}");
    }
    // The axes of the positions are those of a space that was built in the project.
    let space = PlacedSpace { textures: Vec::new(), axes: Some(named(&["a-b", "c-d"])), report: json!({}) };
    project.space = Some(Arc::new(space));
    project.axes = Some(named(&["rough-smooth", "attribute:a-b"]));
    assert_eq!((&wire(&project)["version"], back(&project)), (&json!("1.0"), project));
}

proptest! {
    #[test]
    fn points_of_authored_textures_go_there_and_back(
        coordinates in prop::collection::vec(0.0_f64..=100.0, 1..=MOST_AXES),
        n_points in 0_usize..4,
    ) {
        let point = SpacePoint::of(&coordinates).unwrap();
        let mut project = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "New texture");
        let texture = Arc::make_mut(&mut project.authored[0]);
        let points = (0..n_points).map(|i| point.with(0, 10.0 * i as f64)).collect();
        (texture.at, texture.path) = (point, Some(UserPath { points, ..UserPath::default() }));
        assert_eq!(back(&project), project);
    }
}
