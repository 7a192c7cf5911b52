//! Keys, menus and comparisons, depending on what is audible.

use std::sync::Arc;

use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::command::Command;
use shagreen_app::command::relief::ReliefCommand;
use shagreen_app::state::compare::{CompareCommand, Side};
use shagreen_app::state::edit::{Edit, edited};
use shagreen_app::strings::{self, authored, compare, export, relief};
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_formats::library::{Place, TextureEntry};
use shagreen_formats::project::AuthoredTexture;
use shagreen_formats::starter::starter_library;
use shagreen_studio::export::WAV;
use shagreen_studio::project::new_project;

use crate::support::{Author, author, author_of, begin, click, says, wait, wait_for_field, window};
use crate::views::carry_out;

fn key(harness: &mut Author, modifiers: Modifiers, key: Key) {
    harness.key_press_modifiers(modifiers, key);
    harness.run_steps(3);
}

fn n_authored(harness: &Author) -> usize {
    window(harness).project().authored.len()
}

/// Delete does not remove what the user does not hear. What it removes is said, until undo brings it back.
#[test]
fn the_key_delete_is_only_for_the_audible_texture() {
    let mut harness = author();
    click(&mut harness, authored::ADD);
    let name = window(&harness).project().texture().name.clone();
    let said = authored::deleted(&name, "");
    click(&mut harness, &strings::play_texture("Glass"));
    key(&mut harness, Modifiers::NONE, Key::Delete);
    assert_eq!(n_authored(&harness), 2, "a texture of the library plays");
    key(&mut harness, Modifiers::NONE, Key::Escape);
    carry_out(&mut harness, Command::Compare(CompareCommand::Hear(Side::X)));
    key(&mut harness, Modifiers::NONE, Key::Delete);
    assert!(n_authored(&harness) == 2 && says(&harness, compare::HIDDEN), "nobody knows which plays");
    carry_out(&mut harness, Command::Compare(CompareCommand::Hear(Side::X)));
    assert!(!says(&harness, &said));
    key(&mut harness, Modifiers::NONE, Key::Delete);
    assert!(n_authored(&harness) == 1 && says(&harness, &said));
    key(&mut harness, Modifiers::COMMAND, Key::Z);
    assert!(n_authored(&harness) == 2 && !says(&harness, &said));
    // Another edit is what undo would revert.
    key(&mut harness, Modifiers::NONE, Key::Delete);
    assert!(says(&harness, &said));
    carry_out(&mut harness, Command::Edit(Edit::SetColor(3)));
    assert!(!says(&harness, &said));
}

#[test]
fn undo_of_a_deletion_restores_the_sides_of_a_comparison() {
    let mut harness = author();
    for _ in 0..2 {
        click(&mut harness, authored::ADD);
    }
    carry_out(&mut harness, Command::Edit(Edit::SetCompared([3, 1])));
    carry_out(&mut harness, Command::Edit(Edit::Remove(3)));
    key(&mut harness, Modifiers::COMMAND, Key::Z);
    let names: Vec<String> =
        window(&harness).project().authored.iter().map(|texture| texture.name.clone()).collect();
    let third = window(&harness).project().authored.iter().position(|texture| texture.key == 3).unwrap();
    let first = window(&harness).project().authored.iter().position(|texture| texture.key == 1).unwrap();
    // The inspector names the texture that a side plays, unless it is the selected one.
    carry_out(&mut harness, Command::Edit(Edit::Select(2)));
    for (side, index) in [(Side::A, third), (Side::B, first)] {
        carry_out(&mut harness, Command::Compare(CompareCommand::Hear(side)));
        assert!(says(&harness, &compare::you_hear(side.letter(), &names[index])), "{side:?}");
    }
}

/// A solo that a comparison overrides counts as little as the selection.
#[test]
fn a_relief_is_for_the_texture_that_a_comparison_plays() {
    let mut harness = author();
    let first = window(&harness).project().texture().name.clone();
    click(&mut harness, authored::ADD);
    click(&mut harness, &strings::play_texture("Glass"));
    carry_out(&mut harness, Command::Compare(CompareCommand::Hear(Side::A)));
    carry_out(&mut harness, Command::Relief(ReliefCommand::Begin(None, None)));
    assert!(says(&harness, &relief::of_authored(&first)) && !says(&harness, &relief::of_library("Glass")));
}

/// The menu of an authored texture exports it as a signal, although its models are still being computed.
#[test]
fn the_export_of_a_texture_waits_for_its_models() {
    let place = Some(Place::new(SpacePoint::new(60.0, 57.0).unwrap(), LabelSource::Estimated));
    let own = TextureEntry { id: "own".to_owned(), place, ..starter_library().unwrap().textures[3].clone() };
    let edits = [
        Edit::Author(Box::new(AuthoredTexture::new(0, "Second"))),
        Edit::JoinSimulated { key: 2, entry: Arc::new(own), earlier: None },
        Edit::Select(1),
    ];
    let project = edits.into_iter().fold(new_project(), |project, edit| edited(&project, edit));
    let mut harness = author_of(begin(project), [1280.0, 720.0]);
    wait_for_field(&mut harness);
    carry_out(&mut harness, Command::ExportAuthored(2));
    wait(&mut harness, "the sheet opens", |h| says(h, export::TITLE));
    harness.run_steps(3);
    assert!(!window(&harness).session().is_preparing());
    assert!(says(&harness, &export::subject("Second", false, None)));
    assert!(!harness.get_by_label(WAV.name).accesskit_node().is_disabled());
}

/// The stroke after a click ends by itself. The button starts one that does not, without a pause.
#[test]
fn the_stroke_after_a_click_becomes_one_that_goes_on() {
    let mut harness = author();
    wait_for_field(&mut harness);
    click(&mut harness, &strings::play_texture("Glass"));
    harness.run_steps(1);
    assert!(window(&harness).session().hand_is_running());
    assert!(harness.query_by_label(strings::HAND_START).is_some(), "the button does not flicker");
    key(&mut harness, Modifiers::NONE, Key::Space);
    assert!(window(&harness).session().hand_is_running());
    assert!(harness.query_by_label(strings::HAND_STOP).is_some());
    key(&mut harness, Modifiers::NONE, Key::Space);
    assert!(!window(&harness).session().hand_is_running());
}
