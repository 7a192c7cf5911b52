mod other_axes;

use std::collections::BTreeSet;
use std::sync::Arc;

use super::{Edit, edited};
use shagreen_core::space::SpacePoint;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::shape::{Shape, ShapeControl};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
use shagreen_formats::starter::starter_library;

fn project() -> Project {
    Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "Oak copy")
}

fn lock(id: &str, is_locked: bool) -> Edit {
    Edit::Lock { id: id.to_owned(), name: "Oak".to_owned(), is_locked }
}

fn after(project: &Project, edits: impl IntoIterator<Item = Edit>) -> Project {
    edits.into_iter().fold(project.clone(), |project, edit| edited(&project, edit))
}

#[test]
fn edits_are_named() {
    let at = SpacePoint::plane(1.0, 2.0);
    assert_eq!(Edit::MovePoint(at).label(&project()), "Move Oak copy");
    assert_eq!(lock("oak", true).label(&project()), "Pin Oak");
    assert_eq!(lock("oak", false).label(&project()), "Unpin Oak");
    assert_eq!(Edit::Remove(1).label(&project()), "Delete Oak copy");
}

#[test]
fn a_material_moves_the_texture_and_changes_nothing_else() {
    let starter = starter_library().unwrap();
    let picture = Arc::new(starter.textures[0].picture.clone().unwrap());
    let take = |material: Option<&str>| Edit::TakeMaterial {
        material: material.map(str::to_owned),
        at: SpacePoint::plane(29.0, 89.0),
        picture: Arc::clone(&picture),
        notes: "carpet".to_owned(),
    };
    assert_eq!(take(Some("carpet")).label(&project()), "Move Oak copy to carpet");
    assert_eq!(take(None).label(&project()), "Move Oak copy to estimate from picture");
    let solo = after(&project(), [Edit::Solo(Some("cork".to_owned())), lock("oak", true)]);
    let taken = after(&solo, [take(Some("carpet"))]);
    let texture = taken.texture();
    assert_eq!((texture.at.y(), texture.notes.as_str(), &taken.solo), (89.0, "carpet", &None));
    assert!(texture.picture.as_ref().is_some_and(|of| Arc::ptr_eq(of, &picture)));
    assert!(texture.blend.is_locked("oak"));
}

#[test]
fn a_texture_becomes_exactly_one_of_the_library() {
    let at = SpacePoint::plane(1.0, 2.0);
    let before = after(
        &project(),
        [
            lock("oak", true),
            Edit::SetMode(Mode::Shared),
            Edit::SetShape(ShapeControl::Grain, 2.0),
            Edit::Solo(Some("cork".to_owned())),
        ],
    );
    let take = Edit::TakeTexture { id: "cork".to_owned(), name: "Cork".to_owned(), at };
    assert_eq!(take.label(&before), "Make Oak copy exactly Cork");
    let taken = after(&before, [take]);
    let texture = taken.texture();
    assert_eq!((texture.at, texture.blend.mode, &taken.solo), (at, Mode::Field, &None));
    assert!(texture.shape.is_neutral());
    assert_eq!(texture.blend.locked.iter().collect::<Vec<_>>(), ["cork"], "no other pin may win");
}

#[test]
fn a_lock_ends_with_its_library() {
    let project = project();
    let locked = after(&project, [lock("oak", true), lock("oak", true)]);
    assert_eq!(locked.texture().blend.locked.len(), 1);
    assert_eq!(after(&locked, [lock("oak", false)]), project);
    let opened = after(&locked, [Edit::OpenLibrary(ProjectLibrary::BuiltIn(BuiltIn::Simulated))]);
    assert!(opened.texture().blend.locked.is_empty());
    let same = after(&locked, [Edit::OpenLibrary(locked.library.clone())]);
    assert_eq!(same, locked, "opening what is open changes nothing");
}

/// The opened library has a texture with the same identifier.
#[test]
fn pins_of_own_textures_follow_into_another_library() {
    let mut library = starter_library().unwrap();
    let glass = Arc::new(library.textures[0].clone());
    assert_eq!(glass.id, "glass");
    library.textures.retain(|texture| texture.id != "glass");
    let without = Project::new(ProjectLibrary::Inside(Arc::new(library)), "Pane");
    let join = Edit::JoinSimulated { key: 1, entry: Arc::clone(&glass), earlier: None };
    let mine = after(&without, [join, lock("oak", true), Edit::KeepSnapshot]);
    let open = Edit::OpenLibrary(ProjectLibrary::BuiltIn(BuiltIn::Starter));
    let opened = after(&mine, [open, Edit::AddTextures(vec![glass])]);
    let only = |id: &str| BTreeSet::from([id.to_owned()]);
    let ids: Vec<&str> = opened.joined.iter().map(|entry| &*entry.id).collect();
    assert_eq!((ids, &opened.own), (vec!["glass-2", "glass-3"], &only("glass-2")));
    assert_eq!(opened.texture().blend.locked, only("glass-2"), "not the glass of the library");
    assert!(opened.snapshots[0].blend.locked.contains("glass-2"));
    let list = opened.textures_on(starter_library().unwrap());
    assert!(opened.left_out(&list.textures, |id| opened.texture().blend.locked.contains(id)).is_empty());
    // The other glass leaves without the mark of the first.
    assert_eq!(after(&opened, [Edit::RemoveTexture(1)]).own, only("glass-2"));
    assert!(after(&opened, [Edit::RemoveTexture(0)]).own.is_empty());
}

#[test]
fn a_shape_is_limited_to_its_ranges_and_reset_at_once() {
    let project = after(&project(), [Edit::Solo(Some("oak".to_owned()))]);
    let edits = [Edit::SetShape(ShapeControl::Grain, 2.0), Edit::SetShape(ShapeControl::Level, 99.0)];
    let shaped = after(&project, edits);
    let expected = Shape { grain: 2.0, level_db: 12.0, ..Shape::default() };
    assert_eq!((shaped.texture().shape, &shaped.solo), (expected, &None));
    assert_eq!(Edit::SetShape(ShapeControl::Grain, 2.0).label(&project), "Change grain size of Oak copy");
    assert_eq!(Edit::ResetShape.label(&project), "Reset shape of Oak copy");
    let kinds = [ShapeControl::Grain, ShapeControl::Level].map(|of| Edit::SetShape(of, 1.0).kind());
    assert_ne!(kinds[0], kinds[1], "two controls are two steps");
    let kept = after(&shaped, [Edit::KeepSnapshot, Edit::ResetShape]);
    assert!(kept.texture().shape.is_neutral());
    assert_eq!(after(&kept, [Edit::RestoreSnapshot(0)]).texture().shape, expected);
}

#[test]
fn authored_textures_come_and_go() {
    let one = project();
    let two = after(&one, [Edit::Author(Box::new(AuthoredTexture::new(0, "Felt")))]);
    assert_eq!((two.authored.len(), two.texture().name.as_str(), two.texture().key), (2, "Felt", 2));
    let first = after(&two, [Edit::Select(1)]);
    assert_eq!(first.texture().name, "Oak copy");
    let left = after(&two, [Edit::Remove(2)]);
    assert_eq!(left, one);
    assert_eq!(after(&left, [Edit::Remove(1)]), left, "the last one stays");
    let gone = after(&first, [Edit::Remove(1)]);
    assert_eq!((gone.selected, gone.texture().key), (0, 2));
}

#[test]
fn a_snapshot_brings_a_state_back_but_not_its_name() {
    let at = SpacePoint::plane(1.0, 2.0);
    let kept = after(&project(), [Edit::KeepSnapshot]);
    let moved = after(&kept, [Edit::MovePoint(at), Edit::Rename("New".to_owned()), Edit::RestoreSnapshot(0)]);
    assert_eq!((moved.texture().at, moved.texture().name.as_str()), (project().texture().at, "New"));
    assert_eq!(after(&kept, [Edit::RemoveSnapshot(0)]), project());
    assert_eq!(after(&kept, [Edit::RestoreSnapshot(9), Edit::RemoveSnapshot(9)]), kept);
}

#[test]
fn a_snapshot_restores_its_own_texture_and_no_other() {
    let at = SpacePoint::plane(1.0, 2.0);
    let first = project().texture().clone();
    let kept = after(&project(), [Edit::KeepSnapshot, Edit::MovePoint(at)]);
    let two =
        after(&kept, [Edit::Author(Box::new(AuthoredTexture { at, ..AuthoredTexture::new(0, "Felt") }))]);
    assert_eq!(Edit::RestoreSnapshot(0).label(&two), "Restore snapshot of Oak copy");
    let restored = after(&two, [Edit::RestoreSnapshot(0)]);
    assert_eq!((restored.texture(), &restored.authored[1]), (&first, &two.authored[1]));
    let without = after(&two, [Edit::Remove(first.key)]);
    let again = after(&without, [Edit::RestoreSnapshot(0)]);
    assert_eq!((again.authored.len(), again.texture()), (2, &first), "it comes back");
    assert_eq!(again.authored[0].at, at, "beside the other one");
}
