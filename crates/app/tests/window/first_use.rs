//! What was found when the program was first tried (docs/notes/first-use.md), as far as no other test shows the answer.

use std::time::Duration;

use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect, Shape, ViewportId};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::Begin;
use shagreen_app::choices::signals::Slot;
use shagreen_app::command::Command;
use shagreen_app::session::OutputChoice;
use shagreen_app::strings::{self, document, help, import as import_words, path, signals};
use shagreen_app::workspace::Workspace;
use shagreen_core::units::Hertz;
use shagreen_formats::picture::{Rgb, decode, encode_png};
use shagreen_formats::project::write_project;
use shagreen_formats::starter::starter_library;
use shagreen_studio::project::new_project;

use crate::import::recording;
use crate::projects::open;
use crate::support::{
    Author, author, author_of, begin, click, enter_path, painted, shown, wait, wait_for_field, window,
    window_of, words,
};
use crate::views::carry_out;

const SIZE: [f32; 2] = [1280.0, 720.0];

fn area(harness: &Author, name: &str) -> Rect {
    harness.get_by_label(name).rect()
}

/// Areas of the widgets with these names.
fn areas(harness: &Author, names: &[String]) -> Vec<Rect> {
    names.iter().map(|name| area(harness, name)).collect()
}

/// A photo whose path is typed into the import sheet becomes a texture, and a recording that the program is started with is
/// imported.
#[test]
fn a_file_is_taken_for_what_it_is_however_it_comes() {
    let folder = tempfile::tempdir().unwrap();
    let library = starter_library().unwrap();
    let texture = &library.textures[library.index_of("brick").unwrap()];
    let Rgb { width, height, pixels } = decode(texture.picture.as_ref().unwrap()).unwrap();
    let photo = folder.path().join("a wall.png");
    std::fs::write(&photo, encode_png(&Rgb { width, height, pixels }).unwrap()).unwrap();
    let mut harness = author();
    carry_out(&mut harness, Command::OpenImport);
    enter_path(&mut harness, import_words::PATHS, &photo);
    wait(&mut harness, "it landed", |h| window(h).project().authored.len() == 2);
    assert_eq!(window(&harness).project().texture().name, "a wall");

    let stroke = folder.path().join("cork.csv");
    std::fs::write(&stroke, recording("cork", 3.0, Hertz(1000.0))).unwrap();
    let mut harness = author_of(Begin { take: Some(stroke), ..begin(new_project()) }, SIZE);
    wait(&mut harness, "it is imported", |h| window(h).import().is_some());
}

/// Each photo of a folder becomes a texture, whatever else lies in the folder. A folder without any file of use is reported.
#[test]
fn a_folder_of_photos_is_imported() {
    let folder = tempfile::tempdir().unwrap();
    let library = starter_library().unwrap();
    for id in ["brick", "cork"] {
        let texture = &library.textures[library.index_of(id).unwrap()];
        let Rgb { width, height, pixels } = decode(texture.picture.as_ref().unwrap()).unwrap();
        let photo = encode_png(&Rgb { width, height, pixels }).unwrap();
        std::fs::write(folder.path().join(format!("my {id}.png")), photo).unwrap();
    }
    std::fs::write(folder.path().join("README.md"), "# Photos").unwrap();
    let empty = folder.path().join("empty");
    std::fs::create_dir(&empty).unwrap();
    let mut harness = author();
    carry_out(&mut harness, Command::OpenImport);
    enter_path(&mut harness, import_words::PATHS, &empty);
    wait(&mut harness, "it is reported", |h| {
        shown(h).iter().any(|text| text.contains("has no file that can be imported"))
    });
    carry_out(&mut harness, Command::CloseSheet);
    harness.run_steps(4);
    carry_out(&mut harness, Command::OpenImport);
    enter_path(&mut harness, import_words::PATHS, folder.path());
    wait(&mut harness, "both landed", |h| window(h).project().authored.len() == 3);
    let mut names: Vec<&str> =
        window(&harness).project().authored[1..].iter().map(|texture| texture.name.as_str()).collect();
    names.sort_unstable();
    assert_eq!(names, ["my brick", "my cork"]);
}

/// Neither a long name of the project nor a signal in A moves a button.
#[test]
fn buttons_stay_where_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(format!("{}.shagreen", "a very long name of a project ".repeat(4)));
    std::fs::write(&file, write_project(&new_project(), folder.path(), "test")).unwrap();
    let mut harness = author();
    let mut names: Vec<String> =
        Workspace::ALL.iter().map(|workspace| workspace.info().name.to_owned()).collect();
    names
        .extend([document::FILE, strings::UNDO, strings::REDO, strings::MUTE, help::HELP].map(str::to_owned));
    let before = areas(&harness, &names);
    open(&mut harness, &file);
    assert_eq!(window(&harness).document().path(), Some(&*file));
    harness.run_steps(3);
    assert_eq!(areas(&harness, &names), before);

    carry_out(&mut harness, Command::Show(Workspace::Signals));
    wait_for_field(&mut harness);
    let mut names = vec![signals::COPY_OF_A.to_owned(), signals::CODEC.to_owned()];
    for slot in Slot::ALL {
        names.extend([
            signals::take_heard(slot),
            signals::open(slot),
            signals::feel(slot),
            signals::play(slot),
        ]);
    }
    let before = areas(&harness, &names);
    click(&mut harness, &signals::take_heard(Slot::A));
    wait(&mut harness, "a signal is there", |h| window(h).signals().signal(Slot::A).is_some());
    harness.run_steps(4);
    assert_eq!(areas(&harness, &names), before);
}

#[test]
fn a_larger_window_has_larger_pictures_and_a_larger_pad() {
    let sizes = [SIZE, [2560.0, 1440.0]].map(|size| {
        let harness = author_of(begin(new_project()), size);
        let pad = harness.get_by_role_and_label(Role::Canvas, strings::PAD).rect();
        (area(&harness, &strings::play_texture("Cork")).width(), pad.size())
    });
    let [(usual, usual_pad), (large, large_pad)] = sizes;
    assert!(large > 1.5 * usual, "{large} and {usual}");
    assert!(
        large_pad.x > 1.5 * usual_pad.x && large_pad.y > 1.5 * usual_pad.y,
        "{large_pad} and {usual_pad}"
    );
}

#[test]
fn the_path_tool_says_how_a_path_is_drawn() {
    let mut harness = author();
    let is_said = |harness: &Author| {
        painted(harness, strings::CANVAS).iter().filter_map(words).any(|text| text == path::DRAW_ONE)
    };
    assert!(!is_said(&harness));
    carry_out(&mut harness, Command::TogglePathTool);
    assert!(is_said(&harness));
    click(&mut harness, &strings::play_texture("Brick"));
    harness.run_steps(2);
    assert!(!is_said(&harness), "a path has begun");
}

#[test]
fn the_source_of_the_positions_is_stated_once() {
    let mut harness = author();
    wait_for_field(&mut harness);
    let source = window(&harness).session().label_source();
    let n_stated = shown(&harness).iter().filter(|text| text.contains(source)).count();
    assert_eq!((source, n_stated), ("physical labels", 1));
}

#[test]
fn control_and_d_duplicate_the_texture() {
    let mut harness = author();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::D);
    harness.run_steps(3);
    assert_eq!(window(&harness).project().authored.len(), 2);
}

/// Without input and signal, the window waits seconds for its next frame.
#[test]
fn an_idle_window_rests() {
    let output = OutputChoice::Id("none".to_owned());
    let mut harness = window_of(Begin { output, ..begin(new_project()) }, SIZE);
    wait_for_field(&mut harness);
    harness.remove_cursor();
    wait(&mut harness, "it rests", |h| {
        let root = h.output().viewport_output.get(&ViewportId::ROOT).expect("a window");
        root.repaint_delay >= Duration::from_secs(3)
    });
}

/// While the pointer rests on a texture of the canvas, it plays alone if the user wants that, and its tooltip shows its
/// picture.
#[test]
fn a_texture_under_the_pointer_is_seen_and_heard() {
    let mut harness = author();
    wait_for_field(&mut harness);
    wait(&mut harness, "the pictures are there", |h| {
        (0..window(h).session().textures().len())
            .all(|texture| window(h).pictures().thumbnail(texture).is_some())
    });
    carry_out(&mut harness, Command::ToggleHover);
    let cork = window(&harness).session().textures().iter().position(|texture| texture.id == "cork").unwrap();
    harness.hover_at(area(&harness, &strings::play_texture("Cork")).center());
    wait(&mut harness, "it plays alone", |h| window(h).session().shown_parents() == [(cork, 1.0)]);
    wait(&mut harness, "it is stroked", |h| window(h).session().hand_is_running());
    let picture = window(&harness).pictures().thumbnail(cork).unwrap().id();
    let is_large = |shape: &Shape| match shape {
        Shape::Rect(rect) => {
            rect.brush.as_ref().is_some_and(|brush| brush.fill_texture_id == picture)
                && rect.rect.width() > 90.0
        }
        _ => false,
    };
    let shows_it = |h: &Author| h.output().shapes.iter().any(|clipped| is_large(&clipped.shape));
    wait(&mut harness, "the tooltip shows it", shows_it);
    harness.remove_cursor();
    wait(&mut harness, "it is silent", |h| !window(h).session().hand_is_running());
    assert_eq!(window(&harness).project(), &new_project());
}
