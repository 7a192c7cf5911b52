//! Own textures in a space with more axes than the canvas, and pins without effect.

use std::sync::Arc;

use shagreen_app::command::Command;
use shagreen_app::state::edit::{Edit, edited};
use shagreen_app::strings::textures;
use shagreen_core::space::signal_axes::SignalAxis;
use shagreen_formats::library::TextureEntry;
use shagreen_formats::starter::starter_library;
use shagreen_studio::project::new_project;

use super::prompts::describe;
use super::{AXES, point, sliced, third, use_axes};
use crate::support::{Author, author_of, begin, says, wait_for_field, window};
use crate::views::carry_out;

/// The only contributing texture is this one.
fn is_all(harness: &Author, texture: usize) -> bool {
    let authored = window(harness).session().authored().expect("a texture");
    matches!(authored.parents[..], [(parent, weight)] if parent == texture && (weight - 1.0).abs() < 1e-9)
}

/// Its vibration gives it a position on the third axis, and the point goes there.
#[test]
fn a_prompt_is_its_own_texture_on_all_axes() {
    let mut harness = sliced();
    describe(&mut harness, "a coarse wooden board");
    carry_out(&mut harness, Command::Edit(Edit::Solo(None)));
    wait_for_field(&mut harness);
    let project = window(&harness).project().clone();
    let own = window(&harness).session().textures().len() - 1;
    assert_eq!(project.joined.len(), 1);
    assert_eq!(window(&harness).session().position(own), Some(point(&harness)));
    assert_eq!(Some(third(point(&harness))), SignalAxis::Centroid.of(&project.joined[0].model));
    assert!(is_all(&harness, own));
    // It stays its own texture on other axes.
    for axes in [&["hard-soft", "tap frequency", "rough-smooth", "speed exponent"][..], &AXES[..2]] {
        use_axes(&mut harness, axes);
        assert_eq!(window(&harness).session().position(own), Some(point(&harness)), "{axes:?}");
        assert!(is_all(&harness, own), "{axes:?}");
    }
}

/// Two textures at one position form no space, so that the own one has none.
#[test]
fn a_pin_without_effect_is_named() {
    let library = starter_library().unwrap();
    let cork = library.textures[library.index_of("cork").unwrap()].clone();
    let own = TextureEntry { id: "own".to_owned(), name: "Made".to_owned(), place: None, ..cork.clone() };
    let join = Edit::JoinSimulated { key: 1, entry: Arc::new(own), earlier: None };
    let edits = [Edit::MovePoint(cork.at().unwrap()), join];
    let project = edits.into_iter().fold(new_project(), |project, edit| edited(&project, edit));
    let mut harness = author_of(begin(project), [1280.0, 720.0]);
    wait_for_field(&mut harness);
    assert!(says(&harness, &textures::lost_pins(&["Made"])));
    let unpin = Edit::Lock { id: "own".to_owned(), name: "Made".to_owned(), is_locked: false };
    carry_out(&mut harness, Command::Edit(unpin));
    assert!(!says(&harness, &textures::lost_pins(&["Made"])));
}
