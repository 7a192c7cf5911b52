//! How long a frame of the window takes with many textures while the scope runs, without drawing it.
//!
//! `cargo run --release -p shagreen-app --example frame_time -- 1000` prints the median and the 95th percentile over two
//! hundred frames or more, in which the point is dragged: of the frame itself, and of making triangles of it. What a graphics card,
//! or a program in its place, does with these is not in it.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "an example may stop at what it did not expect")]
#![allow(clippy::print_stdout, reason = "it is run to be read")]

use std::cell::RefCell;
use std::rc::Rc;
use std::time::{Duration, Instant};

use egui::accesskit::Role;
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

fn main() {
    let n_textures = std::env::args().nth(1).map_or(1000, |n| n.parse().expect("a number of textures"));
    let library = ProjectLibrary::Inside(crowded(n_textures).into());
    let begin = Begin {
        project: Project { library, ..new_project() },
        path: None,
        output: OutputChoice::Id("null".to_owned()),
        keeping: Keeping::default(),
    };
    let frames = Rc::new(RefCell::new(Vec::new()));
    let measured = Rc::clone(&frames);
    let mut harness = Harness::builder().with_size([1280.0, 720.0]).build_ui_state(
        move |ui, window: &mut Option<Window>| {
            let window =
                window.get_or_insert_with(|| Window::new(ui.ctx(), begin.clone()).expect("a window"));
            let start = Instant::now();
            window.frame_ui(ui);
            measured.borrow_mut().push(start.elapsed());
        },
        None,
    );
    let start = Instant::now();
    let is_ready = |window: &Window| window.session().status().is_some() && !window.session().is_preparing();
    while !is_ready(harness.state().as_ref().unwrap()) && start.elapsed() < Duration::from_mins(2) {
        harness.step();
        std::thread::sleep(Duration::from_millis(20));
    }
    println!("{n_textures} textures, ready after {:.1} s", start.elapsed().as_secs_f64());
    harness.get_by_label(strings::HAND_START).click();
    harness.run_steps(30);
    std::thread::sleep(Duration::from_secs(1));

    let canvas = harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect();
    let mut tessellations = Vec::new();
    frames.borrow_mut().clear();
    harness.drag_at(canvas.center());
    for i in 0..N_FRAMES {
        let angle = std::f32::consts::TAU * i as f32 / 100.0;
        harness.hover_at(canvas.center() + 80.0 * egui::vec2(angle.cos(), angle.sin()));
        harness.step();
        let shapes = harness.output().shapes.clone();
        let start = Instant::now();
        let n_primitives = harness.ctx.tessellate(shapes, 1.0).len();
        tessellations.push(start.elapsed());
        assert!(n_primitives > 0);
        // The scope gets something to show between frames.
        std::thread::sleep(Duration::from_millis(8));
    }
    harness.drop_at(canvas.center());
    for (what, times) in [("frame", frames.take()), ("triangles", tessellations)] {
        let (median, late) = quantiles(times);
        println!("{what}: median {median:.2} ms, 95th percentile {late:.2} ms");
    }
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
