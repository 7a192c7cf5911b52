//! Changes of the axes: other choices, libraries and spaces, and what points, snapshots and own textures do.

use std::sync::Arc;

use serde_json::json;
use shagreen_core::space::signal_axes::SignalAxis;
use shagreen_core::space::texture_path::UserPath;
use shagreen_core::space::{LabelSource, SpacePoint, with_local_means};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::{Library, Place, TextureEntry};
use shagreen_formats::placed_space::{PlacedSpace, PlacedTexture};
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
use shagreen_formats::starter::starter_library;
use shagreen_studio::project::{textures_of, textures_on_axes};

use super::{after, project};
use crate::state::axes_change::AxesChange;
use crate::state::edit::{Edit, PathChange};

fn names(axes: &[&str]) -> Vec<String> {
    axes.iter().map(|name| (*name).to_owned()).collect()
}

/// The project with another choice of axes.
fn with_axes(project: &Project, axes: &[&str]) -> Project {
    let list = textures_of(project).unwrap();
    let positions = textures_on_axes(project).unwrap().positions();
    let change = AxesChange::new(project, &list, &positions, &names(axes));
    after(project, [Edit::SetAxes(Box::new(change))])
}

fn open(library: BuiltIn) -> Edit {
    Edit::OpenLibrary(ProjectLibrary::BuiltIn(library))
}

/// Project on these axes, whose texture is at 20 on rough-smooth and at 30 on hard-soft, with a path.
fn on_axes(axes: &[&str]) -> Project {
    let at = SpacePoint::plane(20.0, 30.0);
    let path = UserPath { points: vec![at, SpacePoint::plane(60.0, 70.0)], ..UserPath::default() };
    let placed = after(&project(), [Edit::MovePoint(at), Edit::ChangePath(PathChange::Draw, Some(path))]);
    with_axes(&placed, axes)
}

/// Position of the texture, and the last point of its path.
fn points(project: &Project) -> [SpacePoint; 2] {
    let texture = project.texture();
    [texture.at, *texture.path.as_ref().unwrap().points.last().unwrap()]
}

/// A space of the textures of the starter library, without attributes.
fn space(axes: Option<&[&str]>) -> Edit {
    let n_axes = axes.map_or(2, <[&str]>::len);
    let placed = |texture: TextureEntry| {
        let place = texture.place?;
        let place = Place { at: place.at.on(n_axes), ..place };
        Some(PlacedTexture { id: texture.id, place, attributes: None })
    };
    let textures = starter_library().unwrap().textures.into_iter().filter_map(placed).collect();
    Edit::UseSpace(Arc::new(PlacedSpace { textures, axes: axes.map(names), report: json!({}) }))
}

#[test]
fn chosen_axes_stay_where_the_new_textures_have_them() {
    let five = ["hard-soft", "centroid", "rough-smooth", "speed exponent", "tap frequency"];
    for axes in [&five[..], &["hard-soft", "rough-smooth"]] {
        let chosen = on_axes(axes);
        for edit in [open(BuiltIn::Simulated), space(None)] {
            let now = after(&chosen, [edit]);
            assert_eq!((&now.axes, points(&now)), (&chosen.axes, points(&chosen)));
        }
    }
    let simulated = after(&project(), [open(BuiltIn::Simulated)]);
    let chosen = with_axes(&simulated, &["hard-soft", "flat-bumpy", "rough-smooth"]);
    let now = after(&chosen, [open(BuiltIn::Starter)]);
    assert_eq!((now.axes, now.authored[0].at), (None, simulated.texture().at));
    // The axes of the new positions are no choice.
    let same = after(&chosen, [space(Some(&["hard-soft", "flat-bumpy", "rough-smooth"]))]);
    assert_eq!((&same.axes, same.texture().at), (&None, chosen.texture().at));
}

#[test]
fn points_keep_their_axes_when_a_choice_of_axes_ends() {
    let usual = [SpacePoint::plane(20.0, 30.0), SpacePoint::plane(60.0, 70.0)];
    let nothing =
        || Edit::UseSpace(Arc::new(PlacedSpace { textures: Vec::new(), axes: None, report: json!({}) }));
    for axes in [&["hard-soft", "rough-smooth"][..], &["hard-soft", "centroid", "rough-smooth"]] {
        let chosen = on_axes(axes);
        let ended = after(&chosen, [nothing()]);
        assert_eq!((points(&ended), &ended.axes), (usual, &None));
        let other = after(&chosen, [space(Some(&["rough-smooth", "warm-cold"]))]);
        assert_eq!((points(&other)[0], &other.axes), (SpacePoint::plane(20.0, 50.0), &None));
    }
    // As before there were other axes, coordinates keep their order if no name is common.
    let swapped = on_axes(&["hard-soft", "rough-smooth"]);
    let other = after(&swapped, [space(Some(&["warm-cold", "flat-bumpy"]))]);
    assert_eq!(points(&other)[0], SpacePoint::plane(30.0, 20.0));
}

#[test]
fn a_snapshot_keeps_its_coordinates_and_is_moved_when_it_is_restored() {
    let chosen = on_axes(&["rough-smooth", "hard-soft", "centroid"]);
    let at = SpacePoint::of(&[75.2, 8.2, 71.3]).unwrap();
    let elsewhere = Edit::MovePoint(SpacePoint::of(&[1.0, 2.0, 3.0]).unwrap());
    let taken = after(&chosen, [Edit::MovePoint(at), Edit::KeepSnapshot, elsewhere]);
    let path = taken.texture().path.clone().unwrap().points;
    let two = with_axes(&taken, &["tap frequency", "speed exponent"]);
    let placed = with_axes(&two, &["rough-smooth", "hard-soft"]);
    for project in [&two, &placed] {
        assert_eq!((project.snapshots[0].at, project.snapshots[0].axes.as_ref()), (at, taken.axes.as_ref()));
    }
    let restore = [Edit::RestoreSnapshot(0)];
    let restored = after(&placed, restore.clone());
    let texture = restored.texture();
    assert_eq!((texture.at, &texture.axes), (at.on(2), &None));
    assert_eq!(texture.path.as_ref().unwrap().points, [path[0].on(2), path[1].on(2)]);
    // Local means take the place of what it does not state.
    let other = with_axes(&taken, &["tap frequency", "rough-smooth"]);
    let positions = textures_on_axes(&other).unwrap().positions();
    let mean = |rough: f64| with_local_means(&positions, &[None, Some(rough)]);
    let restored = after(&other, restore.clone());
    assert_eq!(restored.texture().at.coordinates(), mean(75.2));
    assert_eq!(restored.texture().path.as_ref().unwrap().points[1].coordinates(), mean(path[1].x()));
    // So does a texture that is added from it, and one that was deleted.
    let added = after(&other, [Edit::Author(Box::new(AuthoredTexture::clone(&other.snapshots[0])))]);
    let deleted = after(&added, [Edit::Remove(other.texture().key), restore[0].clone()]);
    for texture in [added.texture(), deleted.texture()] {
        assert_eq!((texture.at, &texture.axes), (restored.texture().at, &None));
    }
    // On its own axes, it is as it was taken.
    let back = with_axes(&placed, &["rough-smooth", "hard-soft", "centroid"]);
    assert_eq!(back.snapshots, taken.snapshots);
    assert_eq!(after(&back, restore).texture().at, at);
}

/// Project on the simulated library with an own texture, which was made for the authored texture and pinned by it.
fn with_own(axes: &[&str], at: &[f64]) -> Project {
    let begun = after(&project(), [open(BuiltIn::Simulated)]);
    let chosen = with_axes(&begun, axes);
    let glass = starter_library().unwrap().textures.swap_remove(0);
    let entry = Arc::new(TextureEntry { id: "own".to_owned(), place: None, attributes: None, ..glass });
    let join = Edit::JoinSimulated { key: 1, entry, earlier: None };
    after(&chosen, [Edit::MovePoint(SpacePoint::of(at).unwrap()), join])
}

/// Position of the own texture.
fn own(project: &Project) -> Place {
    let list = textures_on_axes(project).unwrap();
    list.textures[list.index_of("own").unwrap()].place.unwrap()
}

#[test]
fn a_point_and_its_own_texture_stay_together() {
    let five = ["rough-smooth", "hard-soft", "flat-bumpy", "sticky-slippery", "centroid"];
    let begun = with_own(&five, &[20.0, 30.0, 40.0, 55.0, 10.0]);
    let centroid = SignalAxis::Centroid.of(&begun.joined[0].model).unwrap();
    let at = SpacePoint::of(&[20.0, 30.0, 40.0, 55.0, centroid]).unwrap();
    assert_eq!((begun.texture().at, own(&begun)), (at, Place::new(at, LabelSource::Estimated)));
    let kept = after(&begun, [Edit::KeepSnapshot]);
    let mut project = kept.clone();
    for axes in [
        &["rough-smooth", "hard-soft"][..],
        &["irritating-pleasant", "sticky-slippery", "centroid"],
        &["tap frequency"],
        &["flat-bumpy", "rough-smooth", "irritating-pleasant"],
    ] {
        project = with_axes(&project, axes);
        assert_eq!(project.texture().at, own(&project).at, "{axes:?}");
        assert_eq!(project.texture().at.n_axes(), axes.len());
        let restored = after(&project, [Edit::RestoreSnapshot(0)]);
        if axes.len() > 1 {
            assert_eq!(restored.texture().at, own(&project).at, "{axes:?}");
        }
    }
    // What was known of it on an axis comes back.
    assert_eq!(project.texture().at.on(2), SpacePoint::plane(40.0, 20.0));
    let back = with_axes(&project, &five);
    assert_eq!((own(&back).at, back.texture().at), (at, at));
    // So it does with another library and a built space.
    for (edit, expected) in [(open(BuiltIn::Starter), [20.0, 30.0]), (space(None), [20.0, 30.0])] {
        let now = after(&kept, [edit]);
        assert_eq!((now.texture().at, own(&now).at), (SpacePoint::of(&expected).unwrap(), now.texture().at));
        assert!(now.texture().blend.locked.contains("own"));
    }
    assert!(after(&kept, [Edit::RemoveTexture(0)]).coordinates.is_empty());
}

/// The library file has got a third axis, or lost it, since the points were set.
#[test]
fn a_moved_point_takes_its_path_to_the_axes_of_the_space() {
    let library =
        Library { axes: Some(names(&["rough-smooth", "hard-soft", "centroid"])), ..Library::default() };
    let changed = Project {
        library: ProjectLibrary::Inside(Arc::new(library)),
        ..on_axes(&["rough-smooth", "hard-soft"])
    };
    assert_eq!(points(&changed).map(SpacePoint::n_axes), [2, 2]);
    let at = SpacePoint::of(&[1.0, 2.0, 3.0]).unwrap();
    let picture = Arc::new(starter_library().unwrap().textures[0].picture.clone().unwrap());
    let mut mixed = changed.texture().path.clone().unwrap();
    mixed.points.push(at);
    let edits = [
        (Edit::MovePoint(at), at),
        (Edit::Remake { at, picture, notes: String::new() }, at),
        (Edit::ChangePath(PathChange::AddPoint, Some(mixed)), SpacePoint::of(&[20.0, 30.0, 50.0]).unwrap()),
    ];
    for (edit, expected) in edits {
        let edited = after(&changed, [edit.clone()]);
        let texture = edited.texture();
        let mut all = texture.path.iter().flat_map(|path| &path.points).chain([&texture.at]);
        assert!(texture.at == expected && all.all(|point| point.n_axes() == 3), "{edit:?}");
        // With two axes, it has two coordinates again.
        let back = Project { library: project().library, ..edited.clone() };
        let back = after(&back, [Edit::MovePoint(at)]);
        assert!(points(&back).iter().all(|point| point.n_axes() == 2), "{edit:?}");
    }
    let fresh = after(&changed, [Edit::Author(Box::new(AuthoredTexture::new(0, "Felt")))]);
    assert_eq!(fresh.texture().at.coordinates(), [50.0; 3]);
}
