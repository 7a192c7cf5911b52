//! How long a frame of the window takes with many textures while the scope runs, without drawing it.
//!
//! `cargo run --release -p shagreen-app --example frame_time -- 1000` prints the median and the 95th percentile over two
//! hundred frames: of the frame itself, and of making triangles of it; while a hand strokes, while the pointer passes over
//! the canvas as well, and while it drags the point. What a graphics card, or a program in its place, does with these is not
//! in it.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "an example may stop at what it did not expect")]
#![allow(clippy::print_stdout, reason = "it is run to be read")]

use std::cell::RefCell;
use std::rc::Rc;
use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use shagreen_app::Begin;
use shagreen_app::files::Keeping;
use shagreen_app::session::OutputChoice;
use shagreen_app::strings;
use shagreen_app::window::{Window, new_project};
use shagreen_core::rng::Random;
use shagreen_formats::library::Library;
use shagreen_formats::project::{Project, ProjectLibrary};
use shagreen_formats::starter::starter_library;

/// Frames that are measured.
const N_FRAMES: usize = 200;
/// The window, in points.
const SIZE: Vec2 = vec2(1280.0, 720.0);

/// The window, made in the first frame.
type Shared = Rc<RefCell<Option<Window>>>;

fn main() {
    let n_textures = std::env::args().nth(1).map_or(1000, |n| n.parse().expect("a number of textures"));
    let library = ProjectLibrary::Inside(crowded(n_textures).into());
    let begin = Begin {
        project: Project { library, ..new_project() },
        path: None,
        output: OutputChoice::Id("null".to_owned()),
        keeping: Keeping::default(),
    };
    let window: Shared = Shared::default();
    let shared = Rc::clone(&window);
    let mut harness = Harness::builder().with_size(SIZE).build_ui(move |ui| {
        let mut window = shared.borrow_mut();
        let window = window.get_or_insert_with(|| Window::new(ui.ctx(), begin.clone()).expect("a window"));
        window.frame_ui(ui);
    });
    let start = Instant::now();
    let is_ready = |window: &Window| window.session().status().is_some() && !window.session().is_preparing();
    while !window.borrow().as_ref().is_some_and(is_ready) && start.elapsed() < Duration::from_mins(2) {
        harness.step();
        std::thread::sleep(Duration::from_millis(20));
    }
    println!("{n_textures} textures, ready after {:.1} s", start.elapsed().as_secs_f64());
    harness.get_by_label(strings::HAND_START).click();
    harness.run_steps(30);
    std::thread::sleep(Duration::from_secs(1));
    let canvas = harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect();

    // From here on as on a machine without a screen reader, whose tree the harness always asks for.
    let ctx = harness.ctx.clone();
    ctx.disable_accesskit();
    let button = |pos: Pos2, pressed: bool| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    let center = canvas.center();
    let around = |i: usize| {
        let angle = std::f32::consts::TAU * i as f32 / 100.0;
        center + 80.0 * vec2(angle.cos(), angle.sin())
    };
    let moved = |i: usize| vec![Event::PointerMoved(around(i))];
    measure("stroked", &ctx, &window, |_| Vec::new());
    measure("pointed at", &ctx, &window, moved);
    let press = vec![Event::PointerMoved(around(0)), button(around(0), true)];
    frame(&ctx, &window, press);
    measure("dragged", &ctx, &window, moved);
}

/// Prints how long frames take in which these things happen.
fn measure(what: &str, ctx: &Context, window: &Shared, events: impl Fn(usize) -> Vec<Event>) {
    let times: Vec<(Duration, Duration)> = (0..N_FRAMES)
        .map(|i| {
            // The scope gets something to show between frames.
            std::thread::sleep(Duration::from_millis(8));
            frame(ctx, window, events(i))
        })
        .collect();
    let (median, late) = quantiles(times.iter().map(|(frame, _)| *frame).collect());
    let (triangles, late_triangles) = quantiles(times.iter().map(|(_, triangles)| *triangles).collect());
    println!(
        "{what}: frame {median:.2} ms (95th percentile {late:.2}), triangles {triangles:.2} ms ({late_triangles:.2})"
    );
}

/// One frame, and its triangles: how long each took.
fn frame(ctx: &Context, window: &Shared, events: Vec<Event>) -> (Duration, Duration) {
    let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, SIZE));
    let input = RawInput { screen_rect, events, ..RawInput::default() };
    let start = Instant::now();
    let output = ctx.run_ui(input, |ui| window.borrow_mut().as_mut().expect("a window").frame_ui(ui));
    let made = start.elapsed();
    let start = Instant::now();
    let n_primitives = ctx.tessellate(output.shapes, output.pixels_per_point).len();
    assert!(n_primitives > 0);
    (made, start.elapsed())
}

/// The starter library over and over, at places by chance.
fn crowded(n_textures: usize) -> Library {
    let mut library = starter_library().expect("the program is whole");
    let mut random = Random::new(1);
    let models = library.textures.clone();
    library.textures = (0..n_textures)
        .map(|i| {
            let mut texture = models[i % models.len()].clone();
            texture.id = format!("{}-{i}", texture.id);
            texture.name = format!("{} {i}", texture.name);
            if let Some(place) = &mut texture.place {
                (place.at.rough_smooth, place.at.hard_soft) =
                    (100.0 * random.uniform(), 100.0 * random.uniform());
            }
            texture
        })
        .collect();
    library
}

/// Median and 95th percentile, in ms.
fn quantiles(mut times: Vec<Duration>) -> (f64, f64) {
    times.sort();
    let at = |share: f64| 1e3 * times[((times.len() - 1) as f64 * share) as usize].as_secs_f64();
    (at(0.5), at(0.95))
}
