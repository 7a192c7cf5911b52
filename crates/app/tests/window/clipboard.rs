//! Copying authored textures to the clipboard and pasting them.

use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, OutputCommand};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::strings::{self, authored as words, clipboard};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::project::{AuthoredTexture, Project};
use shagreen_studio::project::new_project;

use crate::support::{Author, author, author_of, author_on, begin, click, says, window};

const SIZE: [f32; 2] = [1280.0, 720.0];

/// Text that the last frame put on the clipboard.
pub(crate) fn on_clipboard(harness: &Author) -> Option<String> {
    harness.output().platform_output.commands.iter().find_map(|command| match command {
        OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    })
}

/// Sends an event of the clipboard shortcuts; returns the text that is on the clipboard then.
fn send(harness: &mut Author, event: Event) -> Option<String> {
    harness.event(event);
    harness.step();
    let text = on_clipboard(harness);
    harness.run_steps(2);
    text
}

fn names(harness: &Author) -> Vec<String> {
    window(harness).project().authored.iter().map(|texture| texture.name.clone()).collect()
}

fn undo(harness: &mut Author) {
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
}

#[test]
fn each_paste_is_one_step_and_gets_a_name_of_its_own() {
    let mut harness = author();
    let text = send(&mut harness, Event::Copy).expect("a copied texture");
    assert!(text.contains("\"shagreen\": \"authored texture\""), "{text}");
    assert!(says(&harness, &clipboard::copied("New texture")));
    for n in [2, 3] {
        send(&mut harness, Event::Paste(text.clone()));
        assert_eq!(names(&harness).len(), n);
        let name = format!("New texture {n}");
        assert_eq!(window(&harness).project().texture().name, name);
        assert!(says(&harness, &clipboard::pasted(&name)));
    }
    let places: Vec<f64> = window(&harness).project().authored.iter().map(|texture| texture.at.x()).collect();
    assert!(places.windows(2).all(|pair| pair[0] != pair[1]), "they do not cover each other: {places:?}");
    undo(&mut harness);
    assert_eq!(names(&harness), ["New texture", "New texture 2"]);
    undo(&mut harness);
    assert_eq!(names(&harness), ["New texture"]);
}

/// The copy keeps its settings, and the window says which pinned textures the other library lacks.
#[test]
fn a_texture_goes_from_one_project_to_another() {
    let mut texture = AuthoredTexture::new(1, "Handle");
    texture.notes = "for the handle".to_owned();
    texture.at = texture.at.with(0, 31.25);
    texture.blend.locked.extend(["cork".to_owned(), "glass".to_owned()]);
    let authored = vec![Arc::new(texture.clone())];
    let mut source = author_of(begin(Project { authored, ..new_project() }), SIZE);
    let text = send(&mut source, Event::Copy).expect("a copied texture");
    drop(source);

    let mut library = BuiltIn::Starter.read().unwrap();
    "Woods".clone_into(&mut library.name);
    let cork = library.index_of("cork").unwrap();
    library.textures.remove(cork);
    let mut harness = author_on(library, SIZE);
    send(&mut harness, Event::Paste(text));
    let pasted = window(&harness).project().texture();
    assert_eq!((&pasted.name, &pasted.notes, pasted.at), (&texture.name, &texture.notes, texture.at));
    assert_eq!(pasted.blend.locked.iter().collect::<Vec<_>>(), ["glass"]);
    assert!(says(&harness, &clipboard::not_pinned(&["Cork".to_owned()])));
    assert!(says(&harness, "its position was chosen in another space (library "));
}

#[test]
fn other_text_is_not_pasted() {
    let mut harness = author();
    send(&mut harness, Event::Paste("Oak".to_owned()));
    assert_eq!(names(&harness), ["New texture"]);
    assert!(says(&harness, "the clipboard contains no authored texture"));
}

#[test]
fn a_text_field_with_the_focus_keeps_the_shortcuts() {
    let mut harness = author();
    let text = send(&mut harness, Event::Copy).expect("a copied texture");
    harness.get_by_role_and_label(Role::TextInput, strings::NAME).focus();
    harness.run_steps(2);
    let copied = send(&mut harness, Event::Copy);
    assert!(copied.is_none_or(|text| !text.contains("shagreen")), "at most the name is copied");
    send(&mut harness, Event::Paste("Oak".to_owned()));
    assert!(names(&harness)[0].contains("Oak"), "{:?}", names(&harness));
    send(&mut harness, Event::Paste(text));
    assert_eq!(names(&harness).len(), 1);
}

#[test]
fn the_last_texture_is_copied_but_not_cut() {
    let mut harness = author();
    assert!(send(&mut harness, Event::Cut).is_some());
    assert_eq!(names(&harness).len(), 1);
    assert!(says(&harness, clipboard::CANNOT_CUT));
    click(&mut harness, words::ADD);
    // The text field of its name would be cut from.
    harness.get_by_label(strings::POINT).focus();
    harness.run_steps(2);
    let text = send(&mut harness, Event::Cut).expect("the selected texture");
    assert_eq!(names(&harness), ["New texture"]);
    send(&mut harness, Event::Paste(text));
    assert_eq!(names(&harness), ["New texture", "New texture 2"]);
}

/// The menu of a texture copies that texture, selected or not.
#[test]
fn a_menu_copies_the_texture_that_it_belongs_to() {
    let mut harness = author();
    click(&mut harness, words::ADD);
    harness.get_by_label(&words::select("New texture")).click_secondary();
    harness.run_steps(3);
    harness.get_by_label(clipboard::COPY).click();
    harness.step();
    let text = on_clipboard(&harness).expect("a copied texture");
    assert!(text.contains("\"name\":\"New texture\""), "{text}");
    assert_eq!(window(&harness).project().selected, 1, "nothing is selected by copying");
}
