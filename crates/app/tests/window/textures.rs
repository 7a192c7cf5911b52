//! The list of textures: filters, stars, details, renaming, duplicating and deleting.

use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::choices::textures::{End, Region};
use shagreen_app::look::theme::{LIBRARY_WIDTH, STAGE_HEIGHTS};
use shagreen_app::state::edit::{Edit, edited};
use shagreen_app::strings::edits::starred;
use shagreen_app::strings::{self, import, textures as words};
use shagreen_core::space::LabelSource;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::{Attribute, Attributes, Provenance};
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
use shagreen_studio::project::new_project;

use crate::support::{
    Author, author, author_of, author_on, begin, click, says, shown, solo, unnamed_controls, window,
};

const SIZE: [f32; 2] = [1280.0, 720.0];
/// Height of the status bar, in points.
const STATUS: f32 = 32.0;
/// Margin around the window's content in the test harness, in points; a real window has this additional room.
const AROUND: f32 = 8.0;

/// Names of the listed textures, from top to bottom.
fn listed(harness: &Author) -> Vec<String> {
    let textures = window(harness).session().textures().iter();
    let row = |name: &str| Some(harness.query_by_label(&strings::texture(name))?.rect().top());
    let mut rows: Vec<(f32, String)> =
        textures.filter_map(|t| Some((row(&t.name)?, t.name.clone()))).collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    rows.into_iter().map(|(_, name)| name).collect()
}

/// Names of the textures that fulfill a condition, in the order of the library.
fn with(harness: &Author, is_meant: impl Fn(usize) -> bool) -> Vec<String> {
    let textures = window(harness).session().textures().iter().enumerate();
    textures.filter(|(i, _)| is_meant(*i)).map(|(_, texture)| texture.name.clone()).collect()
}

/// Toggles a filter while `n_on` filters are on: opens the menu, clicks an entry and closes the menu.
fn filter(harness: &mut Author, n_on: usize, entry: &str) {
    click(harness, &words::filter(n_on));
    harness.run_steps(3);
    assert_eq!(unnamed_controls(harness), Vec::<String>::new());
    click(harness, entry);
    key(harness, Modifiers::NONE, Key::Escape);
    assert!(harness.query_by_label(entry).is_none(), "the menu closes");
}

/// Opens the menu of a texture by its button and clicks an entry.
fn take(harness: &mut Author, texture: &str, entry: &str) {
    click(harness, &words::more(texture));
    harness.run_steps(3);
    assert_eq!(unnamed_controls(harness), Vec::<String>::new());
    click(harness, entry);
    harness.run_steps(3);
}

fn key(harness: &mut Author, modifiers: Modifiers, key: Key) {
    harness.key_press_modifiers(modifiers, key);
    harness.run_steps(3);
}

fn undo(harness: &mut Author) {
    key(harness, Modifiers::COMMAND, Key::Z);
}

fn search(harness: &mut Author, text: &str) {
    harness.get_by_role_and_label(Role::TextInput, strings::SEARCH).focus();
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::TextInput, strings::SEARCH).type_text(text);
    harness.run_steps(3);
}

#[test]
fn tags_narrow_the_list_and_are_counted() {
    let mut harness = author();
    let has = |harness: &Author, tags: &[&str]| {
        let textures = window(harness).session().textures();
        with(harness, |i| tags.iter().all(|tag| textures[i].tags.iter().any(|other| other == tag)))
    };
    let (fabric, both) = (has(&harness, &["fabric"]), has(&harness, &["fabric", "directional"]));
    filter(&mut harness, 0, &words::tag("fabric", fabric.len()));
    assert_eq!(listed(&harness), fabric);
    assert!(says(&harness, &words::count(fabric.len(), 25)));
    // Only textures with all selected tags are listed.
    let directional = has(&harness, &["directional"]).len();
    filter(&mut harness, 1, &words::tag("directional", directional));
    assert_eq!(listed(&harness), both);
    filter(&mut harness, 2, words::CLEAR);
    assert_eq!(listed(&harness).len(), 25);
    assert!(harness.get_by_label(strings::UNDO).accesskit_node().is_disabled(), "a filter is no edit");
}

#[test]
fn parts_of_the_space_narrow_the_list() {
    let mut harness = author();
    let poles = window(&harness).session().poles().to_vec();
    let hard_rough = words::region(Region::Quarter([End::Low, End::Low]), &poles);
    assert_eq!(hard_rough, "rough and hard");
    let space = window(&harness).session().space().clone();
    let at = |i: usize| space.position(i).expect("all are placed");
    let expected = with(&harness, |i| at(i).x() < 50.0 && at(i).y() < 50.0);
    filter(&mut harness, 0, &hard_rough);
    assert_eq!(listed(&harness), expected);

    let point = window(&harness).project().texture().at;
    let near = with(&harness, |i| at(i).distance(point) <= 25.0);
    assert!(!near.is_empty() && near.len() < 25);
    filter(&mut harness, 1, words::NEAR_POINT);
    assert_eq!(listed(&harness), near);
    // The filter follows the point.
    harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).set_value_accesskit(95.0);
    harness.run_steps(3);
    let point = window(&harness).project().texture().at;
    assert_eq!(listed(&harness), with(&harness, |i| at(i).distance(point) <= 25.0));

    filter(&mut harness, 1, words::NOT_PLACED);
    assert!(listed(&harness).is_empty() && says(&harness, words::NONE_PASSES));
    filter(&mut harness, 1, words::ANYWHERE);
    assert_eq!(listed(&harness).len(), 25);
}

#[test]
fn a_star_brings_a_texture_to_the_top_and_can_be_undone() {
    let mut harness = author();
    let before = listed(&harness);
    click(&mut harness, &starred(&before[2], true));
    let mut after = before.clone();
    after[..3].rotate_right(1);
    assert_eq!(listed(&harness), after);
    take(&mut harness, &before[1], words::STAR);
    assert_eq!(listed(&harness)[..2], before[1..3], "their order is kept");
    filter(&mut harness, 0, words::ONLY_STARRED);
    assert_eq!(listed(&harness), before[1..3]);
    undo(&mut harness);
    assert_eq!(listed(&harness), before[2..3]);
    click(&mut harness, &starred(&before[2], false));
    assert!(window(&harness).project().starred.is_empty());
    assert!(says(&harness, words::NONE_PASSES));
}

#[test]
fn what_matches_nothing_can_be_cleared() {
    let mut harness = author();
    search(&mut harness, "zebra");
    assert!(says(&harness, strings::NO_MATCH) && says(&harness, &words::count(0, 25)));
    filter(&mut harness, 0, words::ONLY_STARRED);
    assert!(says(&harness, words::NONE_FOUND));
    click(&mut harness, words::SHOW_ALL);
    assert_eq!(listed(&harness).len(), 25);
    assert!(harness.query_by_label(&words::filter(0)).is_some() && says(&harness, &words::count(25, 25)));
}

/// Typing a name is one undo step, and an invalid name is refused with a message.
#[test]
fn a_texture_is_renamed_in_one_step() {
    let mut harness = author();
    take(&mut harness, "Glass", words::RENAME);
    assert!(harness.get_by_role_and_label(Role::TextInput, words::NAME).is_focused());
    // The old name is selected, so that typing replaces it.
    for letters in ["Glass", " pa", "ne"] {
        harness.get_by_role_and_label(Role::TextInput, words::NAME).type_text(letters);
        harness.run_steps(2);
    }
    assert_eq!(window(&harness).session().textures()[0].name, "Glass pane");
    key(&mut harness, Modifiers::COMMAND, Key::A);
    key(&mut harness, Modifiers::NONE, Key::Backspace);
    assert!(says(&harness, words::NAME_NEEDED));
    assert_eq!(window(&harness).session().textures()[0].name, "Glass pane");
    click(&mut harness, strings::help::CLOSE);
    assert!(harness.query_by_label(&strings::texture("Glass pane")).is_some());
    assert!(harness.query_by_label(&strings::play_texture("Glass pane")).is_some(), "on the canvas too");
    undo(&mut harness);
    assert_eq!(window(&harness).session().textures()[0].name, "Glass");
    assert!(window(&harness).project().renamed.is_empty());
}

#[test]
fn a_texture_is_duplicated_and_its_copy_removed() {
    let mut harness = author();
    let hard_smooth =
        words::region(Region::Quarter([End::High, End::Low]), window(&harness).session().poles());
    filter(&mut harness, 0, &hard_smooth);
    harness.get_by_label(&strings::texture("Glass")).click_secondary();
    harness.run_steps(3);
    assert!(harness.get_by_label(words::REMOVE).accesskit_node().is_disabled(), "the library stays whole");
    click(&mut harness, words::DUPLICATE);
    // The list shows all textures again and scrolls to the new one.
    harness.run_steps(60);
    assert_eq!(listed(&harness).len(), 26);
    let (original, copy) = {
        let textures = window(&harness).session().textures();
        (textures[0].clone(), textures[25].clone())
    };
    assert_eq!((copy.name.as_str(), copy.id.as_str()), ("Glass copy", "glass-copy"));
    assert_eq!((copy.place, &copy.model), (original.place, &original.model));
    assert_eq!(copy.license, window(&harness).session().library().license, "under the terms of the library");
    filter(&mut harness, 0, words::ONLY_JOINED);
    assert_eq!(listed(&harness), ["Glass copy"]);

    take(&mut harness, "Glass copy", words::REMOVE);
    assert!(window(&harness).project().joined.is_empty());
    undo(&mut harness);
    assert_eq!(listed(&harness), ["Glass copy"]);
    undo(&mut harness);
    assert_eq!(window(&harness).session().textures().len(), 25);
}

#[test]
fn the_details_say_what_is_known_and_draw_it() {
    let mut library = BuiltIn::Starter.read().unwrap();
    let glass = &mut library.textures[0];
    glass.provenance = Provenance::Restricted;
    "CC-BY-4.0".clone_into(&mut glass.license);
    let values = vec![Attribute { name: "warm-cold".to_owned(), value: 71.0 }];
    glass.attributes = Some(Attributes { source: LabelSource::HumanRatings, values });
    let mut harness = author_on(library, SIZE);
    take(&mut harness, "Glass", words::DETAILS);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    let shown = shown(&harness);
    for expected in
        ["glass", "CC-BY-4.0", import::RESTRICTED, "physical labels", "Warm to cold", "71", "1000 Hz"]
    {
        assert!(shown.iter().any(|text| text == expected), "nothing says {expected}: {shown:?}");
    }
    for plot in [words::LEVELS, words::SPECTRA] {
        let images = harness.get_all_by_role(Role::Image);
        let labels: Vec<String> = images.filter_map(|n| n.accesskit_node().label()).collect();
        assert!(labels.iter().any(|label| label.starts_with(plot)), "no plot of {plot}: {labels:?}");
    }
    let window_area = egui::Rect::from_min_size(egui::Pos2::ZERO, SIZE.into());
    for button in [words::HEAR_ALONE, words::DUPLICATE, words::REMOVE, strings::help::CLOSE] {
        assert!(window_area.contains_rect(harness.get_by_label(button).rect()), "{button} is not seen");
    }
    click(&mut harness, words::HEAR_ALONE);
    assert_eq!(solo(&harness), Some(0));
    click(&mut harness, words::DUPLICATE);
    assert!(harness.query_by_label(words::TITLE).is_none(), "the sheet makes way for the list");
    let copy = window(&harness).session().textures().last().unwrap();
    assert_eq!((copy.license.as_str(), copy.provenance), ("CC-BY-4.0", Provenance::Restricted));
}

/// Deleting a texture closes its details. Positions from simulated raters are labeled as simulated.
#[test]
fn the_details_of_a_simulated_place_say_so() {
    let library = ProjectLibrary::BuiltIn(BuiltIn::Simulated);
    let mut harness = author_of(begin(Project { library, ..new_project() }), SIZE);
    let first = window(&harness).session().textures()[0].name.clone();
    take(&mut harness, &first, words::DUPLICATE);
    harness.run_steps(60);
    let copy = window(&harness).session().textures().last().unwrap().name.clone();
    take(&mut harness, &copy, words::DETAILS);
    let said = words::place_from(LabelSource::SimulatedRaters);
    assert!(said.starts_with("simulated") && shown(&harness).contains(&said), "{:?}", shown(&harness));
    click(&mut harness, words::REMOVE);
    harness.run_steps(2);
    assert!(harness.query_by_label(words::TITLE).is_none());
    assert!(window(&harness).project().joined.is_empty());
}

/// Everything is possible without a right click: the keyboard reaches the button of a row, and its menu has all
/// entries.
#[test]
fn the_menu_of_a_texture_is_reached_by_the_keyboard() {
    let mut harness = author();
    harness.get_by_label(&strings::texture("Glass")).focus();
    harness.run_steps(2);
    key(&mut harness, Modifiers::NONE, Key::Tab);
    assert!(harness.get_by_label(&words::more("Glass")).is_focused());
    key(&mut harness, Modifiers::NONE, Key::Enter);
    for entry in [words::DETAILS, words::STAR, words::RENAME, words::DUPLICATE, words::REMOVE] {
        assert!(harness.query_by_label(entry).is_some(), "no entry {entry}");
    }
    assert!(harness.query_by_label(&strings::lock("Glass", true)).is_some());
    click(&mut harness, words::HEAR_ALONE);
    assert_eq!(solo(&harness), Some(0));
    harness.get_by_label(&words::more("Glass")).focus();
    harness.run_steps(2);
    key(&mut harness, Modifiers::NONE, Key::Tab);
    key(&mut harness, Modifiers::NONE, Key::Enter);
    assert!(window(&harness).project().starred.contains("glass"));
}

/// With five authored textures, at least five textures of the list are visible, and no label of the column is cut off.
#[test]
fn five_textures_are_seen_beside_five_authored_ones() {
    let authored = (1..=5).map(|key| Arc::new(AuthoredTexture::new(key, &format!("Mine {key}")))).collect();
    let harness = author_of(begin(Project { authored, ..new_project() }), SIZE);
    let end = SIZE[1] - AROUND - STATUS - STAGE_HEIGHTS.start();
    let rows = window(&harness).session().textures().iter();
    let seen = rows.filter(|t| harness.get_by_label(&strings::texture(&t.name)).rect().bottom() <= end);
    assert!(seen.count() >= 5);
    for button in [strings::LIBRARIES, strings::IMPORT, strings::SAVE_LIBRARY, words::FILTER] {
        let area = harness.get_by_label(button).rect();
        assert!(area.left() >= 0.0 && area.right() <= LIBRARY_WIDTH, "{button} at {area:?}");
    }
}

#[test]
fn an_added_texture_gets_an_estimated_position() {
    let mut entry = BuiltIn::Starter.read().unwrap().textures.swap_remove(0);
    "mine".clone_into(&mut entry.id);
    "Mine".clone_into(&mut entry.name);
    (entry.place, entry.physical, entry.attributes) = (None, None, None);
    let project = edited(&new_project(), Edit::AddTextures(vec![Arc::new(entry)]));
    let mut harness = author_of(begin(project), SIZE);
    let mine = window(&harness).session().textures().len() - 1;
    assert_eq!(window(&harness).session().position(mine), None);
    filter(&mut harness, 0, words::ONLY_JOINED);
    take(&mut harness, "Mine", words::ESTIMATE_PLACE);
    assert!(window(&harness).session().position(mine).is_some());
    assert_eq!(window(&harness).session().place_source(mine), Some(LabelSource::Estimated));
    click(&mut harness, strings::UNDO);
    assert_eq!(window(&harness).session().position(mine), None);
}
