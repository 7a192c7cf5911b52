use std::sync::Arc;

use super::{Pasted, beside, copied, pasted};
use crate::state::edit::{Edit, edited};
use shagreen_core::space::texture_path::UserPath;
use shagreen_core::space::{SpacePoint, with_local_means};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::{Library, USUAL_AXES};
use shagreen_formats::project::clipboard::{read_copied_texture, write_copied_texture};
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
use shagreen_studio::axes::placed_on;

fn names(axes: &[&str]) -> Vec<String> {
    axes.iter().map(|name| (*name).to_owned()).collect()
}

fn axes() -> Vec<String> {
    names(&USUAL_AXES)
}

/// Positions of the textures of the starter library on axes.
fn positions(axes: &[String]) -> Vec<Option<SpacePoint>> {
    placed_on(&BuiltIn::Starter.read().unwrap(), axes).unwrap().positions()
}

fn starter() -> (Project, Library) {
    let library = BuiltIn::Starter.read().unwrap();
    (Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "Felt"), library)
}

fn pinned(id: &str) -> AuthoredTexture {
    let mut texture = AuthoredTexture::new(1, "Felt");
    texture.blend.locked.insert(id.to_owned());
    texture
}

#[test]
fn a_texture_of_the_same_project_is_pasted_beside_under_a_name_of_its_own() {
    let (mut project, library) = starter();
    for (n, name) in [(1.0, "Felt 2"), (2.0, "Felt 3")] {
        let copy = copied(&pinned("cork"), &project, &library, &axes());
        let outcome = pasted(copy, &project, &library, &axes(), &[]);
        assert_eq!((outcome.warnings, outcome.own), (Vec::new(), Vec::new()));
        let at = 50.0 + 4.0 * n;
        assert_eq!(outcome.texture.at, SpacePoint::plane(at, at));
        assert_eq!(outcome.texture.name, name);
        assert!(outcome.texture.blend.locked.contains("cork"));
        project = edited(&project, Edit::Author(Box::new(outcome.texture)));
    }
    let corner = SpacePoint::plane(100.0, 98.0);
    assert_eq!(beside(corner), SpacePoint::plane(96.0, 94.0));
}

#[test]
fn what_another_library_lacks_is_named() {
    let (project, library) = starter();
    let mut source = library.clone();
    "Woods".clone_into(&mut source.name);
    let cork = source.index_of("cork").unwrap();
    "elm".clone_into(&mut source.textures[cork].id);
    "Elm".clone_into(&mut source.textures[cork].name);
    let mut texture = pinned("elm");
    texture.blend.locked.insert("glass".to_owned());
    let copy = copied(&texture, &project, &source, &axes());
    let outcome = pasted(copy, &project, &library, &axes(), &[]);
    assert_eq!(outcome.texture.blend.locked.iter().collect::<Vec<_>>(), ["glass"]);
    let [space, pins] = &outcome.warnings[..] else { panic!("{:?}", outcome.warnings) };
    assert!(space.contains("library Woods, axes rough to smooth and hard to soft"), "{space}");
    assert!(pins.ends_with("lacks them: Elm"), "{pins}");
}

/// A texture of one project, such as a generated one, goes with the authored texture that pins it, unless it is there.
#[test]
fn a_pinned_texture_that_was_added_travels_with_the_copy() {
    let (project, library) = starter();
    let mut own = library.textures[0].clone();
    "ribs".clone_into(&mut own.id);
    (own.place, own.picture) = (None, None);
    let join = Edit::JoinSimulated { key: 1, entry: Arc::new(own.clone()), earlier: None };
    let source = edited(&project, join);
    let list = source.textures_on(library.clone());
    let copy = copied(source.texture(), &source, &list, &axes());
    assert_eq!(copy.textures, [own.clone()]);
    // A texture of the same identifier is another one.
    let mut other = own.clone();
    other.picture = library.textures[1].picture.clone();
    let target = edited(&project, Edit::AddTextures(vec![Arc::new(other)]));
    let outcome = pasted(copy.clone(), &target, &target.textures_on(library.clone()), &axes(), &[]);
    assert_eq!(outcome.warnings, Vec::<String>::new());
    let after = edited(&target, Edit::AuthorWith { texture: Box::new(outcome.texture), own: outcome.own });
    assert_eq!(after.joined[1].id, "ribs-2");
    assert!(after.own.contains("ribs-2") && !after.own.contains("ribs"));
    assert_eq!(after.texture().blend.locked.iter().collect::<Vec<_>>(), ["ribs-2"]);
    // In its own project there is nothing to add.
    assert_eq!(pasted(copy, &source, &list, &axes(), &[]).own, Vec::new());
}

/// A texture with these coordinates and a path, on its way from a space with some axes to one with others, as text.
fn sent(coordinates: &[f64], from: &[&str], to: &[&str]) -> Pasted {
    let (project, library) = starter();
    let mut texture = AuthoredTexture::new(1, "Felt");
    texture.at = SpacePoint::of(coordinates).unwrap();
    texture.path = Some(UserPath { points: vec![texture.at; 2], ..UserPath::default() });
    let text = write_copied_texture(&copied(&texture, &project, &library, &names(from)));
    let sites = positions(&axes());
    let on_axes: Vec<Option<SpacePoint>> = sites.iter().map(|at| Some((*at)?.on(to.len()))).collect();
    let outcome = pasted(read_copied_texture(&text).unwrap(), &project, &library, &names(to), &on_axes);
    assert_eq!(outcome.texture.path.as_ref().unwrap().points, [outcome.texture.at; 2]);
    outcome
}

#[test]
fn a_texture_goes_to_a_space_with_other_axes() {
    let to = names(&["hard-soft", "centroid", "rough-smooth"]);
    let (project, library) = starter();
    let mut texture = AuthoredTexture::new(1, "Felt");
    texture.at = SpacePoint::plane(20.0, 30.0);
    let copy = copied(&texture, &project, &library, &axes());
    let outcome = pasted(copy, &project, &library, &to, &positions(&to));
    let mean = with_local_means(&positions(&to), &[Some(30.0), None, Some(20.0)]);
    assert_eq!(outcome.texture.at.coordinates(), mean);
    assert!(mean[0] == 30.0 && mean[2] == 20.0 && mean[1] != 50.0, "{mean:?}");
    assert_eq!(outcome.warnings.len(), 1, "{:?}", outcome.warnings);
    let corner = SpacePoint::of(&[100.0, 10.0, 55.0]).unwrap();
    assert_eq!(beside(corner).coordinates(), [96.0, 14.0, 55.0]);
}

/// Dimensions of a perceptual space, and attributes with the name of a position.
#[test]
fn axes_are_known_by_their_names() {
    let dimensions = ["dimension 1", "dimension 2", "dimension 3"];
    let further = ["dimension 1", "dimension 2", "dimension 3", "centroid"];
    let at = sent(&[10.0, 20.0, 30.0], &dimensions, &further).texture.at;
    assert_eq!(at.coordinates()[..3], [10.0, 20.0, 30.0]);
    let shifted = sent(&[10.0, 20.0, 30.0], &dimensions, &["dimension 2", "dimension 3", "dimension 4"]);
    assert_eq!((shifted.texture.at.on(2), shifted.warnings.len()), (SpacePoint::plane(20.0, 30.0), 1));
    let positions = ["rough-smooth", "hard-soft", "centroid"];
    let attributes = ["attribute:rough-smooth", "hard-soft", "centroid"];
    let other = sent(&[99.0, 20.0, 30.0], &attributes, &positions);
    assert_eq!((other.texture.at.get(1), other.warnings.len()), (Some(20.0), 1));
    assert_ne!(other.texture.at.x(), 99.0);
    assert!(sent(&[99.0, 20.0, 30.0], &attributes, &attributes).warnings.is_empty());
    let plane = sent(&[99.0, 20.0], &["attribute:rough-smooth", "hard-soft"], &USUAL_AXES);
    assert_eq!((plane.texture.at, plane.warnings.len()), (SpacePoint::plane(99.0, 20.0), 1));
    assert_eq!(sent(&[99.0, 20.0], &USUAL_AXES, &attributes[..2]).warnings.len(), 1);
}

#[test]
fn two_axes_in_another_order_are_swapped() {
    let swapped = sent(&[20.0, 30.0], &USUAL_AXES, &["hard-soft", "rough-smooth"]);
    assert_eq!((swapped.texture.at, swapped.warnings.len()), (SpacePoint::plane(30.0, 20.0), 1));
    // Two others keep the coordinates, as without a choice of axes.
    let other = sent(&[20.0, 30.0], &USUAL_AXES, &["warm-cold", "rough-smooth"]);
    assert_eq!(other.texture.at, SpacePoint::plane(20.0, 30.0));
}
