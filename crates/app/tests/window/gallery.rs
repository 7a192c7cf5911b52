//! Gallery: pictures of the projects, playing under the pointer, and what an opened project keeps.

use egui::accesskit::Role;
use egui::{Key, Shape};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::command::{Command, FileCommand};
use shagreen_app::strings::{document, gallery};
use shagreen_formats::gallery::GALLERY;
use shagreen_formats::project::Project;

use crate::support::{Author, author, click, says, wait, wait_for_field, window, write_into};
use crate::views::carry_out;

/// Window with the open gallery.
fn opened() -> Author {
    let mut harness = author();
    wait_for_field(&mut harness);
    carry_out(&mut harness, Command::File(FileCommand::OpenGallery));
    harness
}

fn project(title: &str) -> Project {
    GALLERY.iter().find(|each| each.title == title).unwrap().read().unwrap()
}

/// Number of pictures in the left column of the card with this title. The window below the sheet has no pictures at that
/// place and of that width.
fn n_pictures(harness: &Author, title: &str) -> usize {
    let card = harness.get_by_label(&gallery::open(title)).rect();
    let left = card.left() + 10.0;
    let is_picture = |shape: &Shape| {
        let Shape::Mesh(mesh) = shape else { return false };
        let area = mesh.calc_bounds();
        card.contains_rect(area) && (area.left() - left).abs() < 0.5 && (area.width() - 84.0).abs() < 0.5
    };
    harness.output().shapes.iter().filter(|clipped| is_picture(&clipped.shape)).count()
}

#[test]
fn every_project_shows_the_surfaces_of_its_textures() {
    let mut harness = opened();
    wait(&mut harness, "the pictures are made", |h| !says(h, gallery::MAKING));
    harness.run_steps(2);
    for each in GALLERY {
        let n_authored = each.read().unwrap().authored.len();
        assert_eq!(n_pictures(&harness, each.title), n_authored.min(6), "{}", each.title);
    }
    // They are made once.
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    carry_out(&mut harness, Command::File(FileCommand::OpenGallery));
    assert!(!says(&harness, gallery::MAKING) && n_pictures(&harness, "Garden") > 2);
}

#[test]
fn a_project_plays_while_the_pointer_rests_on_it() {
    let mut harness = opened();
    let before = window(&harness).project().clone();
    let at = |h: &Author| window(h).session().authored().unwrap().location.at;
    let own = at(&harness);
    assert!(!window(&harness).session().hand_is_running());
    harness.hover_at(harness.get_by_label(&gallery::open("Garden")).rect().center());
    wait(&mut harness, "it plays", |h| window(h).session().hand_is_running());
    harness.run_steps(2);
    // Points may lie two points of the axes outside the convex hull.
    let of_garden = project("Garden").texture().at;
    assert!(at(&harness).distance(of_garden) < 2.5 && own.distance(of_garden) > 10.0);
    assert_eq!(window(&harness).project(), &before);
    harness.key_press(Key::Escape);
    wait(&mut harness, "it is silent", |h| !window(h).session().hand_is_running());
    harness.run_steps(2);
    assert_eq!((at(&harness), window(&harness).project()), (own, &before));
}

#[test]
fn an_opened_project_keeps_its_name_and_its_text() {
    let mut harness = opened();
    click(&mut harness, &gallery::open("Couch fabrics"));
    harness.run_steps(3);
    assert_eq!(window(&harness).document().name(), "Couch fabrics");
    assert!(window(&harness).document().path().is_none() && !window(&harness).document().is_changed());
    let notes = project("Couch fabrics").notes;
    assert!(!notes.is_empty() && window(&harness).project().notes == notes);
    harness.run_steps(4);
    click(&mut harness, "Couch fabrics");
    harness.run_steps(2);
    let field = harness.get_by_role_and_label(Role::MultilineTextInput, document::PROJECT_NOTES);
    field.focus();
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::MultilineTextInput, document::PROJECT_NOTES).type_text("Mine. ");
    harness.run_steps(2);
    let changed = window(&harness).project().notes.clone();
    assert_eq!(changed.replacen("Mine. ", "", 1), notes, "{changed}");
    assert!(window(&harness).document().is_changed());
    harness.key_press(Key::Escape);
    harness.run_steps(4);
    // It has no file: saving asks where, and suggests its name.
    carry_out(&mut harness, Command::File(FileCommand::Save));
    let field = harness.get_by_role_and_label(Role::TextInput, document::SAVE_PATH);
    let path = field.accesskit_node().value().unwrap();
    assert!(path.ends_with("Couch fabrics.shagreen"), "{path}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("Sofa.shagreen");
    write_into(&mut harness, document::SAVE_PATH, &path.display().to_string());
    harness.key_press(Key::Enter);
    wait(&mut harness, "it is saved", |h| !window(h).document().is_changed());
    assert_eq!(window(&harness).document().name(), "Sofa");
}
