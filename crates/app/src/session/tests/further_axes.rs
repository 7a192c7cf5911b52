//! Spaces with more axes than the canvas.

use std::sync::Arc;

use super::{follow_until_ready, set_axes, starter};
use crate::session::Session;
use crate::state::edit::{Edit, edited};
use shagreen_core::space::authoring::Outside;
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::texture::blend::Mode;
use shagreen_formats::library::TextureEntry;
use shagreen_formats::project::Project;
use shagreen_formats::starter::starter_library;
use shagreen_studio::project::new_project;

const AXES: [&str; 3] = ["rough-smooth", "hard-soft", "centroid"];

/// Session with three axes, whose field is computed, and its project.
fn three_axes(before: &Project) -> (Session, Project) {
    let mut session = Session::new(starter()).unwrap();
    let project = edited(before, set_axes(before, &session, &AXES));
    follow_until_ready(&mut session, &project);
    (session, project)
}

#[test]
fn every_mode_is_the_field_and_the_chosen_one_comes_back() {
    let paper = edited(&new_project(), Edit::SetMode(Mode::Paper));
    let (mut session, project) = three_axes(&paper);
    assert_eq!(
        (session.n_axes(), session.is_sliced(), session.axes()),
        (3, true, &AXES.map(str::to_owned)[..])
    );
    assert_eq!(session.space().triangles().count(), 0);
    assert_eq!(project.texture().blend.mode, Mode::Paper);
    let authored = session.authored().unwrap();
    assert!(authored.mode == Mode::Field && authored.model.is_some());
    assert_eq!(authored.location.at.n_axes(), 3);
    // Options of the field apply.
    let beyond = edited(&project, Edit::SetOutside(Outside::Extrapolated));
    assert_eq!(session.blending(&beyond.texture().blend).outside, Outside::Extrapolated);
    session.follow(&paper, None, &egui::Context::default());
    assert!(!session.is_sliced() && session.authored().unwrap().mode == Mode::Paper);
}

/// Also after the coordinates of a texture have changed, and nothing else.
#[test]
fn own_textures_have_a_position_on_every_axis() {
    let (mut session, project) = three_axes(&new_project());
    let entry =
        TextureEntry { id: "own".to_owned(), place: None, ..starter_library().unwrap().textures[3].clone() };
    let join = Edit::JoinSimulated { key: 1, entry: Arc::new(entry), earlier: None };
    let joined = edited(&edited(&project, join), Edit::Solo(None));
    follow_until_ready(&mut session, &joined);
    let own = session.index_of("own").unwrap();
    assert_eq!((session.position(own), session.is_own(own)), (Some(joined.texture().at), true));
    assert_eq!(session.place_source(own), Some(LabelSource::Estimated));
    let parents = session.parents();
    assert!(parents.len() == 1 && parents[0].0 == own && (parents[0].1 - 1.0).abs() < 1e-9, "{parents:?}");
    let mut moved = joined.clone();
    moved.coordinates.set("own", "hard-soft", 1.0);
    session.follow(&moved, None, &egui::Context::default());
    assert_eq!(session.position(own), Some(joined.texture().at.with(1, 1.0)));
    moved.coordinates.remove("own");
    session.follow(&moved, None, &egui::Context::default());
    assert_eq!(session.position(own), None);
}

#[test]
fn an_axis_that_is_not_told_is_at_the_local_mean() {
    let (session, project) = three_axes(&new_project());
    let at = session.fitted(project.texture().at);
    let mean = session.completed(&[Some(at.x()), Some(at.y()), None]);
    assert_eq!((mean.x(), mean.y(), session.at_local_mean(at.with(2, 100.0), 2)), (at.x(), at.y(), mean));
    assert!(mean.distance(at) < 1e-6, "a new axis begins there: {at} and {mean}");
    // Without any coordinate, each axis has the mean of all textures.
    let all: Vec<f64> = session.placed().map(|(_, site)| site.x()).collect();
    let middle = session.completed(&[None; 3]);
    assert!((middle.x() - all.iter().sum::<f64>() / all.len() as f64).abs() < 1e-9);
    assert_eq!(session.fitted(SpacePoint::plane(1.0, 2.0)).coordinates(), [1.0, 2.0, 50.0]);
}
