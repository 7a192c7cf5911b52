//! Shared helpers of the tests: the window on the starter library, and input of a user.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{DroppedFile, Key, Modifiers, Shape};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, HarnessBuilder, TestRenderer};
use shagreen_app::Begin;
use shagreen_app::author::blend_choice::mode_entry;
use shagreen_app::session::OutputChoice;
use shagreen_app::state::files::StoragePaths;
use shagreen_app::strings;
use shagreen_app::window::Window;
use shagreen_core::texture::blend::Mode;
use shagreen_formats::library::Library;
use shagreen_formats::project::{Project, ProjectLibrary};
use shagreen_studio::project::new_project;

/// Label of the silent output.
pub(crate) const SILENT: &str = "No output (silent, real clock)";

/// Test harness; the window exists after the first frame.
pub(crate) type Author = Harness<'static, Option<Window>>;

/// Window on the starter library with the silent output, which runs in real time.
pub(crate) fn author() -> Author {
    author_of(begin(new_project()), [1280.0, 720.0])
}

/// Window on a library with the silent output, which runs in real time; `size` is in points.
pub(crate) fn author_on(library: Library, size: [f32; 2]) -> Author {
    let library = ProjectLibrary::Inside(library.into());
    author_of(begin(Project { library, ..new_project() }), size)
}

/// Initial content with the silent output, which stores nothing.
pub(crate) fn begin(project: Project) -> Begin {
    Begin {
        project,
        file: None,
        take: None,
        output: OutputChoice::Id("null".to_owned()),
        keeping: StoragePaths::default(),
        simulation_seed: None,
    }
}

/// Window with this initial content and an open output; `size` is in points.
pub(crate) fn author_of(begin: Begin, size: [f32; 2]) -> Author {
    let mut harness = window_of(begin, size);
    wait(&mut harness, "the output opens", |h| window(h).session().status().is_some());
    harness
}

/// The same at a scale of the screen, with an open output; `size` is in points.
pub(crate) fn author_at(begin: Begin, size: [f32; 2], pixels_per_point: f32) -> Author {
    let builder = Harness::builder().with_size(size).with_pixels_per_point(pixels_per_point);
    let mut harness = opened(builder, begin);
    wait(&mut harness, "the output opens", |h| window(h).session().status().is_some());
    harness
}

/// Window after its first frame, with or without an open output; `size` is in points.
pub(crate) fn window_of(begin: Begin, size: [f32; 2]) -> Author {
    opened(Harness::builder().with_size(size), begin)
}

/// The same with a renderer.
pub(crate) fn drawn_by(renderer: impl TestRenderer + 'static, begin: Begin, size: [f32; 2]) -> Author {
    opened(Harness::builder().with_size(size).renderer(renderer), begin)
}

pub(crate) fn opened(builder: HarnessBuilder<Option<Window>>, begin: Begin) -> Author {
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

/// Index of the soloed texture.
pub(crate) fn solo(harness: &Author) -> Option<usize> {
    window(harness).session().solo(window(harness).project())
}

/// Whether the texture with this index is pinned.
pub(crate) fn is_locked(harness: &Author, texture: usize) -> bool {
    let id = &window(harness).session().textures()[texture].id;
    window(harness).project().texture().blend.is_locked(id)
}

/// Runs frames in real time until `done`. Fails after five minutes, which suffice even on a busy machine.
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

/// All texts that a screen reader finds.
pub(crate) fn shown(harness: &Author) -> Vec<String> {
    let nodes = harness.root().children_recursive();
    nodes.filter_map(|n| n.accesskit_node().value().or(n.accesskit_node().label())).collect()
}

pub(crate) fn says(harness: &Author, words: &str) -> bool {
    shown(harness).iter().any(|text| text.contains(words))
}

/// Shapes painted on the canvas with this name.
pub(crate) fn painted(harness: &Author, canvas: &str) -> Vec<Shape> {
    let canvas = harness.get_by_role_and_label(Role::Canvas, canvas).rect();
    let (mut found, mut left) = (Vec::new(), Vec::new());
    left.extend(harness.output().shapes.iter().map(|clipped| clipped.shape.clone()));
    while let Some(shape) = left.pop() {
        match shape {
            Shape::Vec(parts) => left.extend(parts),
            Shape::Noop => {}
            // The position of a text, without its size.
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

/// Content of a text shape.
pub(crate) fn words(shape: &Shape) -> Option<String> {
    if let Shape::Text(text) = shape { Some(text.galley.text().to_owned()) } else { None }
}

/// Clicks the widget with this name.
pub(crate) fn click(harness: &mut Author, name: &str) {
    harness.get_by_label(name).click();
    harness.run_steps(2);
}

/// Clicks twice at a position, within the time of a double click: both clicks are in successive frames.
pub(crate) fn double_click(harness: &mut Author, pos: egui::Pos2) {
    harness.hover_at(pos);
    harness.run_steps(2);
    for _ in 0..2 {
        let button = |pressed| egui::Event::PointerButton {
            pos,
            button: egui::PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        harness.input_mut().events.extend([button(true), button(false)]);
        harness.step();
    }
    harness.run_steps(2);
}

/// Drags from one position to another.
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

/// Opens a combo box and selects an option.
pub(crate) fn choose(harness: &mut Author, name: &str, choice: &str) {
    harness.get_by_role_and_label(Role::ComboBox, name).click();
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::Button, choice).click();
    harness.run_steps(3);
}

/// Selects an interpolation mode.
pub(crate) fn choose_mode(harness: &mut Author, mode: Mode) {
    choose(harness, strings::BLEND_MODE, &mode_entry(mode));
    assert_eq!(window(harness).project().texture().blend.mode, mode);
}

/// Waits until the field is computed.
pub(crate) fn wait_for_field(harness: &mut Author) {
    wait(harness, "the field is there", |h| !window(h).session().is_preparing());
    harness.run_steps(2);
}

/// Replaces the text in the field with this name.
pub(crate) fn write_into(harness: &mut Author, name: &str, text: &str) {
    // A closed sheet releases the keyboard focus some frames later.
    harness.run_steps(4);
    harness.get_by_role_and_label(Role::TextInput, name).focus();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.run_steps(1);
    harness.get_by_role_and_label(Role::TextInput, name).type_text(text);
    harness.run_steps(2);
}

/// Replaces the text in a field by a path and confirms it.
pub(crate) fn enter_path(harness: &mut Author, name: &str, path: &Path) {
    write_into(harness, name, &path.display().to_string());
    harness.key_press(Key::Enter);
    harness.run_steps(2);
}

/// Focusable widgets without an accessible name.
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

/// File in memory, as passed by the window system.
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

/// Drops files with these names and contents on the window.
pub(crate) fn drop_files(harness: &mut Author, files: &[(&str, &[u8])]) {
    let handles = files.iter().map(|(name, bytes)| {
        Arc::new(InMemory { path: PathBuf::from(name), bytes: bytes.to_vec() }) as egui::DroppedFileHandle
    });
    harness.input_mut().dropped_files.extend(handles);
    // A sheet that asks about them is not drawn in its first frame.
    harness.run_steps(4);
}
