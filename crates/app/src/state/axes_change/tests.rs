use super::AxesChange;
use crate::state::edit::{Edit, PathChange, edited};
use crate::state::history::{Gesture, History};
use shagreen_core::space::texture_path::UserPath;
use shagreen_core::space::{LabelSource, LocalMean, SpacePoint};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::{Attribute, Attributes, Library, Place};
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary, read_project, write_project};
use shagreen_formats::starter::{simulated_library, starter_library};
use shagreen_studio::axes::{axis_values, placed_on, placed_with};
use std::path::Path;
use std::sync::Arc;

fn names(axes: &[&str]) -> Vec<String> {
    axes.iter().map(|name| (*name).to_owned()).collect()
}

/// Project with a texture, its snapshot at another point, and a path.
fn project() -> (Project, Library) {
    let start = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "Oak copy");
    let at = SpacePoint::plane(20.0, 30.0);
    let path = UserPath { points: vec![at, SpacePoint::plane(60.0, 70.0)], ..UserPath::default() };
    let edits = [
        Edit::KeepSnapshot,
        Edit::MovePoint(at),
        Edit::ChangePath(PathChange::Draw, Some(path)),
        Edit::Author(Box::new(AuthoredTexture::new(0, "Felt"))),
    ];
    let project = edits.into_iter().fold(start, |project, edit| edited(&project, edit));
    (project, starter_library().unwrap())
}

fn change(project: &Project, library: &Library, axes: &[&str]) -> Edit {
    let own = names(&library.axis_names());
    let positions = placed_on(library, project.axes.as_ref().unwrap_or(&own)).unwrap().positions();
    Edit::SetAxes(Box::new(AxesChange::new(project, library, &positions, &names(axes))))
}

fn changed(project: &Project, library: &Library, axes: &[&str]) -> Project {
    edited(project, change(project, library, axes))
}

#[test]
fn swapped_axes_keep_every_point() {
    let (project, library) = project();
    let swapped = changed(&project, &library, &["hard-soft", "rough-smooth"]);
    assert_eq!(swapped.axes, Some(names(&["hard-soft", "rough-smooth"])));
    for (before, after) in project.authored.iter().zip(&swapped.authored) {
        assert_eq!(after.at, SpacePoint::plane(before.at.y(), before.at.x()));
    }
    // The snapshot stays on its axes.
    let (snapshot, before) = (&swapped.snapshots[0], &project.snapshots[0]);
    assert_eq!((snapshot.at, &snapshot.axes), (before.at, &Some(names(&["rough-smooth", "hard-soft"]))));
    let points = &swapped.authored[0].path.as_ref().unwrap().points;
    assert_eq!(points[1], SpacePoint::plane(70.0, 60.0));
    // Back again, nothing has changed: the axes are those of the positions.
    assert_eq!(changed(&swapped, &library, &["rough-smooth", "hard-soft"]), project);
}

#[test]
fn a_further_axis_is_at_its_local_mean_and_undo_restores_everything() {
    let (project, library) = project();
    let mut now = project.clone();
    let mut history = History::default();
    let edit = change(&now, &library, &["rough-smooth", "hard-soft", "centroid"]);
    history.apply(&mut now, edit, Gesture(1));
    for texture in &now.authored {
        assert_eq!(texture.at.n_axes(), 3);
        assert!(texture.at.get(2).is_some_and(|mean| (0.0..=100.0).contains(&mean)), "{}", texture.at);
    }
    let path = now.authored[0].path.as_ref().unwrap();
    assert_eq!((path.points[0], path.points[1].n_axes()), (now.authored[0].at, 3), "the same point");
    let further = now.clone();
    assert!(history.undo(&mut now) && now == project);
    assert!(history.redo(&mut now) && now == further);
    assert_eq!(changed(&further, &library, &["rough-smooth", "hard-soft"]), project);
}

#[test]
fn a_new_axis_has_the_local_mean_or_the_middle() {
    let library = simulated_library().unwrap();
    let at = SpacePoint::plane(30.0, 70.0);
    let begun = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Simulated), "Oak copy");
    let begun = edited(&begun, Edit::MovePoint(at));
    let moved = changed(&begun, &library, &["hard-soft", "flat-bumpy", "warm-cold"]).texture().at;
    let mean = LocalMean::new(&library.positions(), &axis_values(&library, "flat-bumpy").unwrap());
    assert_eq!(moved.coordinates(), [70.0, mean.unwrap().at(at), 50.0], "nothing is warm");
    // From there, only the axes that were left are means.
    let three = changed(&begun, &library, &["hard-soft", "flat-bumpy"]);
    let other = changed(&three, &library, &["centroid", "hard-soft"]);
    let positions = placed_on(&library, three.axes.as_ref().unwrap()).unwrap().positions();
    let mean = LocalMean::new(&positions, &axis_values(&library, "centroid").unwrap()).unwrap();
    assert_eq!(other.texture().at.coordinates(), [mean.at(three.texture().at), 70.0]);
}

/// It sounds like the texture as before, where a local mean is another coordinate.
#[test]
fn a_point_at_a_texture_stays_there() {
    let (project, library) = project();
    let [cork, glass] = ["cork", "glass"].map(|id| library.index_of(id).unwrap());
    let sites = library.positions();
    let path = UserPath { points: vec![sites[glass].unwrap(), sites[cork].unwrap()], ..UserPath::default() };
    let edits = [Edit::MovePoint(sites[cork].unwrap()), Edit::ChangePath(PathChange::Draw, Some(path))];
    let project = edits.into_iter().fold(project, |project, edit| edited(&project, edit));
    let axes = ["rough-smooth", "hard-soft", "centroid", "tap frequency"];
    let after = changed(&project, &library, &axes);
    let on_axes = placed_on(&library, &names(&axes)).unwrap().positions();
    let texture = after.texture();
    assert_eq!(Some(texture.at), on_axes[cork]);
    let points: Vec<Option<SpacePoint>> =
        texture.path.as_ref().unwrap().points.iter().copied().map(Some).collect();
    assert_eq!(points, [on_axes[glass], on_axes[cork]]);
    let mean = LocalMean::new(&sites, &axis_values(&library, "centroid").unwrap()).unwrap();
    assert!((mean.at(sites[cork].unwrap()) - on_axes[cork].unwrap().get(2).unwrap()).abs() > 1e-3);
}

#[test]
fn of_two_textures_at_one_position_the_pinned_one_counts() {
    let (project, mut library) = project();
    let [cork, glass] = ["cork", "glass"].map(|id| library.index_of(id).unwrap());
    library.textures[cork].place = library.textures[glass].place;
    let project = edited(&project, Edit::MovePoint(library.textures[cork].at().unwrap()));
    let centroid = axis_values(&library, "centroid").unwrap();
    for (pin, expected) in [(None, cork.min(glass)), (Some("cork"), cork), (Some("glass"), glass)] {
        let pin = pin.map(|id| Edit::Lock { id: id.to_owned(), name: String::new(), is_locked: true });
        let pinned = pin.map_or_else(|| project.clone(), |pin| edited(&project, pin));
        let after = changed(&pinned, &library, &["rough-smooth", "hard-soft", "centroid"]);
        assert_eq!(after.texture().at.get(2), centroid[expected]);
    }
    // A texture that takes no part in the authored texture does not count.
    let mut own = library.textures[glass].clone();
    "own".clone_into(&mut own.id);
    let mut project = edited(&project, Edit::AddTextures(vec![Arc::new(own)]));
    project.own.insert("own".to_owned());
    library.textures.retain(|texture| texture.id != "cork" && texture.id != "glass");
    let list = project.textures_on(library);
    let common = project.with_places_of(&list, |_| false).positions();
    let mean = LocalMean::new(&common, &axis_values(&list, "centroid").unwrap()).unwrap();
    let after = changed(&project, &list, &["rough-smooth", "hard-soft", "centroid"]);
    assert_eq!(after.texture().at.get(2), Some(mean.at(project.texture().at)));
}

/// A project with both could not be opened again.
#[test]
fn axes_that_differ_only_in_case_are_one() {
    let (project, mut library) = project();
    let value = |name: &str| Attribute { name: name.to_owned(), value: 30.0 };
    let values = vec![value("Sticky-Slippery"), value("sticky-slippery")];
    library.textures[0].attributes = Some(Attributes { source: LabelSource::HumanRatings, values });
    let project = Project { library: ProjectLibrary::Inside(Arc::new(library.clone())), ..project };
    let axes = ["hard-soft", "Sticky-Slippery", "sticky-slippery", "attribute:Hard-Soft"];
    let after = changed(&project, &library, &axes);
    assert_eq!(after.axes, Some(names(&axes[..2])));
    let bytes = write_project(&after, Path::new("/somewhere"), "test");
    let nothing = |_: &Path| Err(std::io::ErrorKind::NotFound.into());
    let read = read_project(&bytes, Path::new("/somewhere"), &nothing).unwrap().value;
    assert_eq!((&read.axes, &read.authored), (&after.axes, &after.authored));
}

/// An imported texture whose position was estimated has no attributes.
#[test]
fn an_estimated_texture_has_the_local_mean_on_an_axis_that_it_lacks() {
    let (project, _) = project();
    let library = simulated_library().unwrap();
    let at = SpacePoint::plane(30.0, 60.0);
    let axes = ["rough-smooth", "flat-bumpy"];
    for (source, is_placed) in [(LabelSource::Estimated, true), (LabelSource::HumanRatings, false)] {
        let mut entry = library.textures[0].clone();
        (entry.id, entry.attributes) = ("recorded".to_owned(), None);
        entry.place = Some(Place::new(at, source));
        let project = edited(&project, Edit::AddTextures(vec![Arc::new(entry)]));
        let list = project.textures_on(library.clone());
        let change = AxesChange::new(&project, &list, &list.positions(), &names(&axes));
        let after = edited(&project, Edit::SetAxes(Box::new(change)));
        let mean = LocalMean::new(&list.positions(), &axis_values(&list, "flat-bumpy").unwrap()).unwrap();
        let expected = SpacePoint::plane(30.0, mean.at(at));
        let placed = placed_with(&list, &names(&axes), &after.coordinates).unwrap();
        let place = placed.textures.last().unwrap().place;
        assert_eq!(place, is_placed.then(|| Place::new(expected, LabelSource::Estimated)), "{source:?}");
    }
}
