//! Frame time of the window with many textures and a running scope, without drawing on the screen.
//!
//! `cargo run --release -p shagreen-app --example frame_time -- 1000` prints the median and the 95th percentile over
//! two hundred frames, for the layout and for the tessellation into triangles. Three cases are measured: an automatic
//! stroke, the same with the pointer moving over the canvas, and the same with the point being dragged, whose textures a
//! worker makes beside the frames. Rasterization of the triangles by a graphics card or by software is not included.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "an example panics on errors")]
#![allow(clippy::print_stdout, reason = "an example prints its results")]

use std::cell::RefCell;
use std::rc::Rc;
use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use shagreen_app::Begin;
use shagreen_app::session::OutputChoice;
use shagreen_app::state::files::StoragePaths;
use shagreen_app::strings;
use shagreen_app::window::Window;
use shagreen_core::maths::rng::Random;
use shagreen_core::space::SpacePoint;
use shagreen_formats::library::Library;
use shagreen_formats::project::{Project, ProjectLibrary};
use shagreen_formats::starter::starter_library;
use shagreen_studio::project::new_project;

/// Number of measured frames.
const N_FRAMES: usize = 200;
/// Size of the window, in points.
const SIZE: Vec2 = vec2(1280.0, 720.0);

/// Window, created in the first frame.
type Shared = Rc<RefCell<Option<Window>>>;

fn main() {
    let n_textures = std::env::args().nth(1).map_or(1000, |n| n.parse().expect("a number of textures"));
    let library = ProjectLibrary::Inside(crowded(n_textures).into());
    let begin = Begin {
        project: Project { library, ..new_project() },
        file: None,
        take: None,
        output: OutputChoice::Id("null".to_owned()),
        keeping: StoragePaths::default(),
        simulation_seed: None,
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
    println!(
        "simulated library of {n_textures} textures (copies of the starter textures at random positions), ready \
         after {:.1} s",
        start.elapsed().as_secs_f64()
    );
    harness.get_by_label(strings::HAND_START).click();
    harness.run_steps(30);
    std::thread::sleep(Duration::from_secs(1));
    let canvas = harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect();

    // The harness always requests the accessibility tree. It is disabled from here on, as on a machine without a screen
    // reader.
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

/// Prints the frame times with the given input events.
fn measure(what: &str, ctx: &Context, window: &Shared, events: impl Fn(usize) -> Vec<Event>) {
    let times: Vec<(Duration, Duration)> = (0..N_FRAMES)
        .map(|i| {
            // Time for new samples in the scope.
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

/// Duration of the layout of one frame, and of its tessellation.
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

/// Copies of the textures of the starter library, at random positions.
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
                place.at = SpacePoint::plane(100.0 * random.uniform(), 100.0 * random.uniform());
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
