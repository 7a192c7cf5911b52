//! Listening edits nothing: clicks on library textures, the strip below the map, Escape, notices, and borders that move no
//! texture.

use egui::accesskit::Role;
use egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::command::Command;
use shagreen_app::look::theme::LIBRARY_WIDTH;
use shagreen_app::state::compare::{CompareCommand, Side};
use shagreen_app::state::edit::Edit;
use shagreen_app::strings::{self, authored, prompt, textures};
use shagreen_core::texture::blend::Mode;
use shagreen_formats::project::Project;

use crate::menus::empty_place;
use crate::support::{
    Author, author, click, double_click, drag, is_locked, says, shown, solo, wait, wait_for_field, window,
    write_into,
};
use crate::views::carry_out;

fn project(harness: &Author) -> Project {
    window(harness).project().clone()
}

fn key(harness: &mut Author, key: Key) {
    harness.key_press(key);
    harness.run_steps(3);
}

fn undo(harness: &mut Author) {
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
}

fn center(harness: &Author, name: &str) -> Pos2 {
    harness.get_by_label(name).rect().center()
}

/// A click in the map and one in the list give the same: the texture plays alone at once, and the authored texture stays.
#[test]
fn a_click_on_a_texture_listens_in_the_map_and_in_the_list() {
    let mut harness = author();
    let before = project(&harness);
    let glass = window(&harness).session().textures().iter().position(|t| t.name == "Glass").unwrap();
    for name in [strings::play_texture("Glass"), strings::texture("Glass")] {
        click(&mut harness, &name);
        harness.run_steps(1);
        assert_eq!(solo(&harness), Some(glass), "{name}");
        assert_eq!(window(&harness).session().authored().unwrap().parents, [(glass, 1.0)]);
        assert_eq!(project(&harness).authored, before.authored);
        assert!(window(&harness).session().hand_is_running(), "it sounds at once");
        assert!(says(&harness, &strings::plays_alone("Glass")));
        key(&mut harness, Key::Escape);
        assert_eq!(project(&harness), before);
        assert!(!says(&harness, &strings::plays_alone("Glass")));
        wait(&mut harness, "it is silent", |h| !window(h).session().hand_is_running());
    }
    click(&mut harness, &strings::play_texture("Brick"));
    click(&mut harness, textures::BACK_NAME);
    assert_eq!(project(&harness), before);
}

/// A double click, in the map or in the list, and the button of the strip keep what is heard, as one step.
#[test]
fn what_is_heard_is_kept_exactly() {
    let mut harness = author();
    wait_for_field(&mut harness);
    carry_out(&mut harness, Command::Edit(Edit::SetMode(Mode::Shared)));
    let glass = window(&harness).session().textures().iter().position(|t| t.name == "Glass").unwrap();
    let place = window(&harness).session().space().position(glass).unwrap();
    let check = |harness: &mut Author| {
        let texture = window(harness).project().texture();
        assert_eq!((texture.at, texture.blend.mode, solo(harness)), (place, Mode::Field, None));
        assert!(is_locked(harness, glass));
        wait_for_field(harness);
        let lock = window(harness).session().authored().unwrap().lock;
        assert_eq!(lock, Some((glass, 1.0)), "it is what was heard");
        undo(harness);
        assert_eq!(solo(harness), Some(glass), "one step: it plays alone again");
        key(harness, Key::Escape);
        assert_ne!(window(harness).project().texture().at, place);
    };
    for name in [strings::play_texture("Glass"), strings::texture("Glass")] {
        let at = center(&harness, &name);
        double_click(&mut harness, at);
        check(&mut harness);
    }
    click(&mut harness, &strings::play_texture("Glass"));
    click(&mut harness, textures::CHOOSE);
    check(&mut harness);
}

#[test]
fn a_comparison_shows_no_solo() {
    let mut harness = author();
    click(&mut harness, authored::ADD);
    click(&mut harness, &strings::play_texture("Glass"));
    let said = strings::plays_alone("Glass");
    let is_solo = |harness: &Author| shown(harness).iter().any(|text| text == strings::HEARD_ALONE);
    assert!(says(&harness, &said) && is_solo(&harness));
    for side in Side::ALL {
        carry_out(&mut harness, Command::Compare(CompareCommand::Hear(side)));
        assert!(!says(&harness, &said) && !is_solo(&harness), "{side:?}");
    }
    // A click on a texture leaves the comparison.
    click(&mut harness, &strings::play_texture("Glass"));
    assert!(says(&harness, &said));
}

#[test]
fn the_sides_of_a_comparison_belong_to_the_project() {
    let mut harness = author();
    for _ in 0..2 {
        click(&mut harness, authored::ADD);
    }
    carry_out(&mut harness, Command::Edit(Edit::SetCompared([1, 3])));
    assert_eq!(window(&harness).project().compared, Some([1, 3]));
    undo(&mut harness);
    assert_eq!(window(&harness).project().compared, None);
}

/// Escape brings the point back to where the drag began, and leaves no step. The rest of the drag does nothing.
#[test]
fn escape_during_a_drag_restores_the_start() {
    let mut harness = author();
    wait_for_field(&mut harness);
    let before = project(&harness);
    let from = center(&harness, strings::POINT);
    harness.hover_at(from);
    harness.drag_at(from);
    for step in [20.0, 40.0, 60.0] {
        harness.hover_at(from + vec2(step, -10.0));
        harness.run_steps(1);
    }
    assert_ne!(project(&harness), before);
    key(&mut harness, Key::Escape);
    assert_eq!(project(&harness), before);
    harness.hover_at(from + vec2(90.0, -40.0));
    harness.run_steps(1);
    harness.drop_at(from + vec2(90.0, -40.0));
    harness.run_steps(3);
    assert_eq!(project(&harness), before);
    undo(&mut harness);
    assert_eq!(project(&harness), before, "there is no step");
}

#[test]
fn the_selected_texture_is_renamed_and_deleted_by_keys() {
    let mut harness = author();
    key(&mut harness, Key::Delete);
    assert_eq!(project(&harness).authored.len(), 1, "the last one stays");
    click(&mut harness, authored::ADD);
    key(&mut harness, Key::F2);
    assert!(harness.get_by_role_and_label(Role::TextInput, strings::NAME).is_focused());
    key(&mut harness, Key::Delete);
    assert_eq!(project(&harness).authored.len(), 2, "a key of the text field");
    harness.get_by_label(strings::POINT).focus();
    harness.run_steps(2);
    key(&mut harness, Key::Delete);
    assert_eq!(project(&harness).authored.len(), 1);
    undo(&mut harness);
    let name = project(&harness).authored[0].name.clone();
    harness.get_by_label(&authored::select(&name)).focus();
    harness.run_steps(2);
    key(&mut harness, Key::Delete);
    assert_eq!(project(&harness).authored.len(), 1);
    assert_ne!(project(&harness).authored[0].name, name, "the one with the focus");
}

/// The card of a result lies over the map, which does not move, and closing it by a double click changes nothing else.
#[test]
fn the_card_of_a_prompt_moves_nothing() {
    let mut harness = author();
    let canvas = |h: &Author| h.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect();
    let before = canvas(&harness);
    write_into(&mut harness, prompt::FIELD, "a warm, soft fabric");
    harness.key_press(Key::Enter);
    wait(&mut harness, "it was made", |h| window(h).project().authored.len() == 2);
    wait(&mut harness, "it was simulated", |h| !window(h).prompts().is_simulating());
    harness.run_steps(4);
    assert_eq!(canvas(&harness), before);
    assert!(says(&harness, "Temperature is not rendered"));
    let name = window(&harness).project().texture().name.clone();
    let near: Vec<String> =
        shown(&harness).iter().filter_map(|text| Some(text.split_once(" · near ")?.1.to_owned())).collect();
    assert!(near.len() == 1 && !near[0].contains(&name), "{near:?}");
    let texture = project(&harness);
    let close = center(&harness, prompt::DISMISS);
    double_click(&mut harness, close);
    assert!(!says(&harness, "Temperature is not rendered"));
    assert_eq!((project(&harness), canvas(&harness)), (texture, before));
    undo(&mut harness);
    assert_eq!((project(&harness).authored.len(), project(&harness).joined.len()), (1, 0), "one step");
}

/// A click on empty space says that it has moved the texture. A press beside the map, and a drag of a border, move none.
#[test]
fn a_moved_texture_is_said_and_a_border_moves_none() {
    let mut harness = author();
    wait_for_field(&mut harness);
    let before = project(&harness);
    let canvas = harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect();
    let press = |harness: &mut Author, pos: Pos2| {
        harness.hover_at(pos);
        harness.drag_at(pos);
        harness.drop_at(pos);
        harness.run_steps(3);
    };
    press(&mut harness, canvas.left_bottom() + vec2(4.0, -4.0));
    assert_eq!(project(&harness), before, "beside the map");
    let edge = canvas.left_top() + vec2(-4.0, 200.0);
    drag(&mut harness, edge, edge + vec2(60.0, 0.0));
    harness.run_steps(2);
    let wider = harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect();
    assert!(wider.left() > canvas.left() + 30.0, "{wider:?} for {canvas:?}");
    assert_eq!(project(&harness), before);
    assert!(harness.get_by_label(strings::SAVE_LIBRARY).rect().right() > LIBRARY_WIDTH);
    let edge = wider.left_top() + vec2(-4.0, 200.0);
    double_click(&mut harness, edge);
    harness.run_steps(2);
    assert_eq!(harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect(), canvas, "as before");
    let said = strings::moved_by_click(&before.texture().name, "");
    assert!(!says(&harness, &said));
    let place = empty_place(&harness);
    press(&mut harness, place);
    assert_ne!(project(&harness), before);
    assert!(says(&harness, &said));
    undo(&mut harness);
    assert_eq!(project(&harness), before);
    assert!(!says(&harness, &said));
}
