//! What the tests of the window share: the window on the starter library, and a person's moves.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{DroppedFile, Key, Modifiers, Shape};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, HarnessBuilder, TestRenderer};
use shagreen_app::Begin;
use shagreen_app::blend_choice::mode_entry;
use shagreen_app::files::Keeping;
use shagreen_app::session::OutputChoice;
use shagreen_app::strings;
use shagreen_app::window::{Window, new_project};
use shagreen_core::blend::Mode;
use shagreen_formats::library::Library;
use shagreen_formats::project::{Project, ProjectLibrary};

/// The silent output, as people choose it.
pub(crate) const SILENT: &str = "No output (silent, real clock)";

/// The program under test; there is a window after the first frame.
pub(crate) type Author = Harness<'static, Option<Window>>;

/// The window on the starter library, playing to the silent output with a real clock.
pub(crate) fn author() -> Author {
    author_of(begin(new_project()), [1280.0, 720.0])
}

/// The window on a library, of this size in points, playing to the silent output with a real clock.
pub(crate) fn author_on(library: Library, size: [f32; 2]) -> Author {
    let library = ProjectLibrary::Inside(library.into());
    author_of(begin(Project { library, ..new_project() }), size)
}

/// What a window opens with that keeps nothing and plays to the silent output.
pub(crate) fn begin(project: Project) -> Begin {
    Begin { project, path: None, output: OutputChoice::Id("null".to_owned()), keeping: Keeping::default() }
}

/// The window that opens with this, of this size in points.
pub(crate) fn author_of(begin: Begin, size: [f32; 2]) -> Author {
    let mut harness = window_of(begin, size);
    wait(&mut harness, "the output opens", |h| window(h).session().status().is_some());
    harness
}

/// The same after its first frame, whether or not an output opens.
pub(crate) fn window_of(begin: Begin, size: [f32; 2]) -> Author {
    opened(Harness::builder().with_size(size), begin)
}

/// The same, drawn by a renderer.
pub(crate) fn drawn_by(renderer: impl TestRenderer + 'static, begin: Begin, size: [f32; 2]) -> Author {
    opened(Harness::builder().with_size(size).renderer(renderer), begin)
}

fn opened(builder: HarnessBuilder<Option<Window>>, begin: Begin) -> Author {
    builder.build_ui_state(
        move |ui, window: &mut Option<Window>| {
            let window =
                window.get_or_insert_with(|| Window::new(ui.ctx(), begin.clone()).expect("a window"));
            window.frame_ui(ui);
        },
        None,
    )
}

pub(crate) fn window(harness: &Author) -> &Window {
    harness.state().as_ref().expect("a window after the first frame")
}

/// The texture that is heard alone, by its place in the list.
pub(crate) fn solo(harness: &Author) -> Option<usize> {
    window(harness).session().solo(window(harness).project())
}

/// Whether the texture at this place of the list is locked.
pub(crate) fn is_locked(harness: &Author, texture: usize) -> bool {
    let id = &window(harness).session().textures()[texture].id;
    window(harness).project().texture().blend.is_locked(id)
}

/// Runs frames in real time until `done`; what takes five minutes will not come, however busy the machine.
#[track_caller]
pub(crate) fn wait(harness: &mut Author, what: &str, done: impl Fn(&Author) -> bool) {
    let start = Instant::now();
    loop {
        harness.step();
        if done(harness) {
            return;
        }
        assert!(start.elapsed() < Duration::from_mins(5), "waited in vain: {what}");
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// All words on the screen that a screen reader finds.
pub(crate) fn shown(harness: &Author) -> Vec<String> {
    let nodes = harness.root().children_recursive();
    nodes.filter_map(|n| n.accesskit_node().value().or(n.accesskit_node().label())).collect()
}

pub(crate) fn says(harness: &Author, words: &str) -> bool {
    shown(harness).iter().any(|text| text.contains(words))
}

/// What is painted on the canvas of this name.
pub(crate) fn painted(harness: &Author, canvas: &str) -> Vec<Shape> {
    let canvas = harness.get_by_role_and_label(Role::Canvas, canvas).rect();
    let (mut found, mut left) = (Vec::new(), Vec::new());
    left.extend(harness.output().shapes.iter().map(|clipped| clipped.shape.clone()));
    while let Some(shape) = left.pop() {
        match shape {
            Shape::Vec(parts) => left.extend(parts),
            Shape::Noop => {}
            // Where text stands, not how far it reaches.
            shape => {
                let at = if let Shape::Text(text) = &shape {
                    text.pos
                } else {
                    shape.visual_bounding_rect().center()
                };
                if canvas.contains(at) {
                    found.push(shape);
                }
            }
        }
    }
    found
}

/// The words of a shape, where it is text.
pub(crate) fn words(shape: &Shape) -> Option<String> {
    if let Shape::Text(text) = shape { Some(text.galley.text().to_owned()) } else { None }
}

/// Presses the control of this name.
pub(crate) fn click(harness: &mut Author, name: &str) {
    harness.get_by_label(name).click();
    harness.run_steps(2);
}

/// Presses at one place, moves and lets go at another.
pub(crate) fn drag(harness: &mut Author, from: egui::Pos2, to: egui::Pos2) {
    harness.hover_at(from);
    harness.run_steps(2);
    harness.drag_at(from);
    harness.run_steps(2);
    for i in 1..=5 {
        harness.hover_at(from.lerp(to, i as f32 / 5.0));
        harness.run_steps(1);
    }
    harness.drop_at(to);
    harness.run_steps(2);
}

/// Opens a choice and takes one of it.
pub(crate) fn choose(harness: &mut Author, name: &str, choice: &str) {
    harness.get_by_role_and_label(Role::ComboBox, name).click();
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::Button, choice).click();
    harness.run_steps(3);
}

/// Takes a mode in the menu of modes.
pub(crate) fn choose_mode(harness: &mut Author, mode: Mode) {
    choose(harness, strings::BLEND_MODE, &mode_entry(mode));
    assert_eq!(window(harness).project().texture().blend.mode, mode);
}

/// Waits until the field is there.
pub(crate) fn wait_for_field(harness: &mut Author) {
    wait(harness, "the field is there", |h| !window(h).session().is_preparing());
    harness.run_steps(2);
}

/// Types into the field of this name instead of what it says.
pub(crate) fn write_into(harness: &mut Author, name: &str, text: &str) {
    // A sheet that was just closed lets go of the keyboard some frames later.
    harness.run_steps(4);
    harness.get_by_role_and_label(Role::TextInput, name).focus();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run_steps(1);
    harness.get_by_role_and_label(Role::TextInput, name).type_text(text);
    harness.run_steps(2);
}

/// The same with a path, and takes it.
pub(crate) fn enter_path(harness: &mut Author, name: &str, path: &Path) {
    write_into(harness, name, &path.display().to_string());
    harness.key_press(Key::Enter);
    harness.run_steps(2);
}

/// Controls that a keyboard or screen reader reaches but that have no name.
pub(crate) fn unnamed_controls<State>(harness: &Harness<'_, State>) -> Vec<String> {
    let is_control = |role: Role| {
        matches!(
            role,
            Role::Button
                | Role::Slider
                | Role::SpinButton
                | Role::TextInput
                | Role::ComboBox
                | Role::CheckBox
                | Role::Canvas
        )
    };
    let nodes = harness.root().children_recursive();
    let unnamed = nodes.filter(|n| {
        let node = n.accesskit_node();
        is_control(node.role()) && node.label().is_none_or(|l| l.trim().is_empty())
    });
    unnamed.map(|n| format!("{:?} at {:?}", n.accesskit_node().role(), n.rect())).collect()
}

/// A file in memory, as a windowing system would hand it over.
#[derive(Debug)]
struct InMemory {
    path: PathBuf,
    bytes: Vec<u8>,
}

impl DroppedFile for InMemory {
    fn path(&self) -> &Path {
        &self.path
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Ok(self.bytes.clone())
    }
}

/// Drops files of these names and bytes on the window.
pub(crate) fn drop_files(harness: &mut Author, files: &[(&str, &[u8])]) {
    let handles = files.iter().map(|(name, bytes)| {
        Arc::new(InMemory { path: PathBuf::from(name), bytes: bytes.to_vec() }) as egui::DroppedFileHandle
    });
    harness.input_mut().dropped_files.extend(handles);
    harness.run_steps(2);
}
