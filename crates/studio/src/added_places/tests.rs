use std::sync::Arc;

use serde_json::json;
use shagreen_core::space::authoring::Authored;
use shagreen_core::space::signal_axes::SignalAxis;
use shagreen_core::space::{LabelSource, SpacePoint, with_local_means};
use shagreen_core::texture::blend::Mode;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::{Place, TextureEntry};
use shagreen_formats::placed_space::{PlacedSpace, PlacedTexture};
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};

use super::{OwnPlaces, complete_estimates, place_made, place_pinned};
use crate::authoring::authoring;
use crate::axes::placed_on;
use crate::felt::join_felt;
use crate::project::textures_on_axes;
use crate::report::Warnings;

const AXES: [&str; 4] = ["rough-smooth", "hard-soft", "sticky-slippery", "centroid"];

fn named(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// Project on the simulated library with these axes, whose authored texture lies at a point.
fn project(axes: &[&str], at: &[f64]) -> Project {
    let mut project = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Simulated), "Board");
    project.axes = Some(named(axes));
    Arc::make_mut(&mut project.authored[0]).at = SpacePoint::of(at).unwrap();
    project
}

/// Texture with the vibration of glass, and nothing else.
fn entry(place: Option<Place>) -> Arc<TextureEntry> {
    let library = BuiltIn::Simulated.read().unwrap();
    let texture = library.textures[library.index_of("glass").unwrap()].clone();
    Arc::new(TextureEntry { id: "board".to_owned(), place, attributes: None, ..texture })
}

/// Position of the added texture, as the command line and the window find it.
fn place(project: &Project) -> Option<Place> {
    let list = textures_on_axes(project).unwrap();
    list.textures[list.index_of("board").unwrap()].place
}

/// The authored texture of a project.
fn authored(project: &Project) -> Authored {
    let list = textures_on_axes(project).unwrap();
    let AuthoredTexture { at, blend, .. } = project.texture();
    let used = project.with_places_of(&list, |id| blend.locked.contains(id));
    let blending = blend.blending(|id| list.index_of(id));
    authoring(&used, Mode::Field, &Warnings::default()).unwrap().author(*at, &blending).unwrap()
}

#[test]
fn a_texture_that_was_made_for_a_point_is_all_of_it() {
    let mut project = project(&AXES, &[20.0, 30.0, 40.0, 20.0]);
    join_felt(&mut project, 1, entry(None), None);
    assert_eq!(place(&project), None);
    place_made(&mut project, 1, "board");
    let centroid = SignalAxis::Centroid.of(&entry(None).model).unwrap();
    let at = SpacePoint::of(&[20.0, 30.0, 40.0, centroid]).unwrap();
    assert_eq!(place(&project), Some(Place::new(at, LabelSource::Estimated)));
    // The point goes where the vibration is.
    assert!(project.texture().at == at && (centroid - 20.0).abs() > 1.0);
    assert_eq!(project.coordinates.get("board", "centroid"), None, "its vibration gives it");
    let found = authored(&project);
    let board = textures_on_axes(&project).unwrap().index_of("board").unwrap();
    assert!(found.parents.len() == 1 && found.parents[0].0 == board, "{:?}", found.parents);
    assert!((found.parents[0].1 - 1.0).abs() < 1e-9, "{:?}", found.parents);
    // Once it is placed, it stays where the point leaves it.
    Arc::make_mut(&mut project.authored[0]).at = at.with(0, 90.0);
    place_pinned(&mut project, 0..1);
    assert_eq!(place(&project).unwrap().at, at);
}

#[test]
fn a_texture_gets_no_position_where_another_one_lies() {
    let library = placed_on(&BuiltIn::Simulated.read().unwrap(), &named(&AXES[..3])).unwrap();
    let cork = library.textures[library.index_of("cork").unwrap()].at().unwrap();
    let mut project = project(&AXES[..3], cork.coordinates());
    join_felt(&mut project, 1, entry(None), None);
    place_made(&mut project, 1, "board");
    assert!(place(&project).is_none() && project.coordinates.is_empty());
    assert_eq!(project.texture().at, cork);
    // Beside it, it gets one, and the point does not move.
    let beside = cork.with(2, cork.get(2).unwrap() - 3.0);
    Arc::make_mut(&mut project.authored[0]).at = beside;
    place_pinned(&mut project, 0..1);
    assert_eq!((place(&project).unwrap().at, project.texture().at), (beside, beside));
}

#[test]
fn an_estimate_is_completed_by_the_local_mean() {
    let at = SpacePoint::plane(30.0, 60.0);
    let mut begun = project(&AXES[..3], &[50.0; 3]);
    let library = placed_on(&BuiltIn::Simulated.read().unwrap(), &named(&AXES[..3])).unwrap();
    for (source, expected) in [
        (LabelSource::HumanRatings, None),
        (
            LabelSource::Estimated,
            Some(with_local_means(&library.positions(), &[Some(30.0), Some(60.0), None])),
        ),
    ] {
        begun.joined = vec![entry(Some(Place::new(at, source)))];
        let mut project = begun.clone();
        complete_estimates(&mut project, 0..1);
        let found = place(&project).map(|place| place.at.coordinates().to_vec());
        assert_eq!(found, expected, "{source:?}");
    }
    // Positions of the library need no further coordinate.
    begun.axes = None;
    let before = begun.clone();
    complete_estimates(&mut begun, 0..1);
    assert_eq!(begun, before);
}

/// A space that was built in the project, with these axes, of the textures of the simulated library.
fn built(axes: &[&str]) -> Arc<PlacedSpace> {
    let library = placed_on(&BuiltIn::Simulated.read().unwrap(), &named(axes)).unwrap();
    let placed = |texture: TextureEntry| {
        Some(PlacedTexture { id: texture.id, place: texture.place?, attributes: texture.attributes })
    };
    let textures = library.textures.into_iter().filter_map(placed).collect();
    Arc::new(PlacedSpace { textures, axes: Some(named(axes)), report: json!({}) })
}

/// Textures outside a built space lose their positions, but not those that belong to an authored texture.
#[test]
fn own_textures_follow_into_a_built_space() {
    let at = SpacePoint::plane(30.0, 60.0);
    let mut project = project(&AXES[..2], at.coordinates());
    project.axes = None;
    join_felt(&mut project, 1, entry(Some(Place::new(at, LabelSource::Estimated))), None);
    for axes in [&["hard-soft", "rough-smooth"][..], &["hard-soft", "rough-smooth", "flat-bumpy"]] {
        let mut project = project.clone();
        let own = OwnPlaces::of(&project);
        project.space = Some(built(axes));
        project.follow_axes(&named(&AXES[..2]));
        assert_eq!(place(&project), None);
        own.follow(&mut project);
        let Place { at, source, .. } = place(&project).unwrap();
        assert_eq!((at.x(), at.y(), source), (60.0, 30.0, LabelSource::Estimated));
        assert_eq!(project.texture().at, at, "the point moves with it");
        if let Some(third) = at.get(2) {
            let positions = textures_on_axes(&project).unwrap().positions();
            let n = positions.len() - 1;
            let mean = with_local_means(&positions[..n], &[Some(60.0), Some(30.0), None])[2];
            assert!((third - mean).abs() < 1e-9 && third != 50.0, "{third} and {mean}");
        }
    }
    // A point beside it stays beside it.
    let beside = SpacePoint::plane(31.0, 60.0);
    Arc::make_mut(&mut project.authored[0]).at = beside;
    let own = OwnPlaces::of(&project);
    project.space = Some(built(&AXES[..2]));
    own.follow(&mut project);
    assert_eq!((place(&project).unwrap().at, project.texture().at), (at, beside));
}
