//! Authored textures with other spaces than the audible one.

use std::sync::Arc;

use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_formats::library::{Place, TextureEntry};
use shagreen_formats::project::{AuthoredTexture, Project};
use shagreen_formats::starter::starter_library;

use super::follow_until_ready;
use crate::session::Session;
use crate::state::edit::{Edit, edited};
use shagreen_studio::project::new_project;

/// Added textures that belong to the authored textures with the keys 1 and 2. The first one is selected.
fn two() -> Project {
    let join = |key: u32, id: &str, rs: f64| {
        let place = Some(Place::new(SpacePoint::new(rs, 57.0).unwrap(), LabelSource::Estimated));
        let base = starter_library().unwrap().textures[3].clone();
        let entry = TextureEntry { id: id.to_owned(), place, ..base };
        Edit::JoinSimulated { key, entry: Arc::new(entry), earlier: None }
    };
    let edits = [
        Edit::Author(Box::new(AuthoredTexture::new(0, "Second"))),
        join(1, "first", 40.0),
        join(2, "second", 60.0),
        Edit::Select(1),
    ];
    edits.into_iter().fold(new_project(), |project, edit| edited(&project, edit))
}

/// The window shows maps of the selected texture while another one plays.
#[test]
fn the_space_of_the_selected_texture_is_kept_while_another_one_plays() {
    let ctx = egui::Context::default();
    let project = two();
    let heard = Arc::clone(&project.authored[1]);
    let mut session = Session::new(project.library.clone()).unwrap();
    session.follow(&project, Some(&heard), &ctx);
    assert!(session.space().position(26).is_some() && session.space().position(25).is_none());
    let selected = project.texture();
    let begun = session.generation_of(selected);
    assert_ne!(begun, session.generation_of(&heard));
    let start = std::time::Instant::now();
    while !session.found(selected).is_done {
        assert!(start.elapsed().as_secs() < 300, "its models are computed");
        session.begin_work(&ctx);
        session.follow(&project, Some(&heard), &ctx);
        std::thread::yield_now();
    }
    assert_ne!(session.generation_of(selected), begun);
    assert!(session.authoring_of(selected).space().position(25).is_some());
    // With other textures, its generation changes.
    let done = session.generation_of(selected);
    let lock = Edit::Lock { id: "second".to_owned(), name: "Second".to_owned(), is_locked: true };
    let pinned = edited(&project, lock);
    session.follow(&pinned, Some(&heard), &ctx);
    assert_ne!(session.generation_of(pinned.texture()), done);
    assert!(session.authoring_of(pinned.texture()).space().position(26).is_some());
    session.follow(&project, Some(&heard), &ctx);
    assert_eq!(session.generation_of(selected), done, "undone");
}

/// The previous texture would tell which of the two is hidden.
#[test]
fn a_hidden_texture_does_not_begin_with_the_previous_one() {
    let ctx = egui::Context::default();
    let project = two();
    let heard = Arc::clone(&project.authored[1]);
    let mut session = Session::new(project.library.clone()).unwrap();
    follow_until_ready(&mut session, &project);
    assert!(!session.sound.heard.voices.is_empty());
    session.set_hidden(true);
    session.follow(&project, Some(&heard), &ctx);
    assert!(session.is_preparing() && session.sound.heard.voices.is_empty());
    session.set_hidden(false);
    session.follow(&project, None, &ctx);
    assert!(!session.is_preparing() && !session.sound.heard.voices.is_empty());
    // Outside blind comparisons, the previous one plays on.
    session.follow(&project, Some(&heard), &ctx);
    assert!(session.is_preparing() && !session.sound.heard.voices.is_empty());
    session.fall_silent();
    assert!(session.sound.heard.voices.is_empty());
}
