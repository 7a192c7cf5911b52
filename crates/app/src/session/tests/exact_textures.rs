//! Authored textures that are exactly one of the library.

use std::sync::Arc;

use shagreen_formats::library::TextureEntry;
use shagreen_formats::starter::starter_library;

use super::follow_until_ready;
use crate::session::Session;
use crate::state::edit::{Edit, edited};
use shagreen_studio::project::new_project;

/// A copy has the position of its original, whose pin would win.
#[test]
fn a_copy_at_the_position_of_its_pinned_original_is_taken_exactly() {
    let original = starter_library().unwrap().textures[3].clone();
    let (at, id, name) = (original.at().unwrap(), original.id.clone(), original.name.clone());
    let copy = TextureEntry { id: "copy".to_owned(), ..original };
    let edits = [
        Edit::AddTextures(vec![Arc::new(copy)]),
        Edit::Lock { id, name, is_locked: true },
        Edit::TakeTexture { id: "copy".to_owned(), name: "Copy".to_owned(), at },
    ];
    let project = edits.into_iter().fold(new_project(), |project, edit| edited(&project, edit));
    let mut session = Session::new(project.library.clone()).unwrap();
    follow_until_ready(&mut session, &project);
    let (texture, share) = session.authored().unwrap().lock.unwrap();
    // Textures at one position are a little apart in the triangulation.
    assert!(texture == 25 && share > 1.0 - 1e-9, "{texture}: {share}");
}
