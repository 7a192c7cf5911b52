//! Benchmark of texture interpolation: cost of one drag step per mode, with 25 and 1,000 textures, up to a renderable
//! texture; on two and on five axes.
#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a benchmark panics on errors and prints results"
)]

#[path = "common/measure.rs"]
mod measure;

use std::hint::black_box;
use std::sync::Arc;

use measure::bench;
use shagreen_core::dsp::lsf::repair;
use shagreen_core::maths::rng::Random;
use shagreen_core::space::authoring::{Authored, Authoring, Blending, Layers, Models, Outside, Weights};
use shagreen_core::space::{Space, SpacePoint};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::height_map::{HeightMap, HeightMapOptions};
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::{GrainNode, TextureModel};
use shagreen_formats::library::TextureEntry;
use shagreen_formats::starter::starter_library;

fn main() {
    for n in [25, 1000] {
        let authoring = authoring(n, 2);
        let cases = [
            ("field", Blending::from(Mode::Field)),
            ("field, extrapolated", Blending { outside: Outside::Extrapolated, ..Mode::Field.into() }),
            ("parametric", Mode::Parametric.into()),
            ("parametric, natural", Blending { weights: Weights::Natural, ..Mode::Parametric.into() }),
            ("shared", Mode::Shared.into()),
        ];
        for (name, blending) in cases {
            let drags = if n > 25 { 300 } else { 3000 };
            bench(&format!("re-blend, {n} textures, {name}"), f64::from(drags), "drag", || {
                for i in 0..drags {
                    black_box(authoring.author(dragged(i), &blending));
                }
            });
        }
        bench(&format!("re-blend and prepare for rendering, {n} textures, field"), 100.0, "drag", || {
            for i in 0..100 {
                let authored = authoring.author(dragged(i), &Blending::default()).expect("no texture");
                black_box(Plane::new(model(&authored)).prepare());
            }
        });
    }
    for n in [25, 1000] {
        let authoring = authoring(n, 5);
        for (name, outside) in [("field", Outside::Clamped), ("field, extrapolated", Outside::Extrapolated)] {
            let drags = if n > 25 { 300 } else { 3000 };
            let blending = Blending { outside, ..Mode::Field.into() };
            bench(&format!("re-blend, {n} textures on five axes, {name}"), f64::from(drags), "drag", || {
                for i in 0..drags {
                    black_box(authoring.author(dragged_on_five(i), &blending));
                }
            });
        }
    }
    let authoring = with_height_maps();
    bench(
        "re-blend with two height maps and prepare for rendering, 25 textures, field",
        100.0,
        "drag",
        || {
            for i in 0..100 {
                let authored = authoring.author(dragged(i), &Blending::default()).expect("no texture");
                black_box(Plane::new(model(&authored)).prepare());
            }
        },
    );
}

fn model(authored: &Authored) -> &TextureModel {
    authored.model.as_ref().expect("no model")
}

/// A point on a path through the whole square, corners included.
fn dragged(i: u32) -> SpacePoint {
    let t = f64::from(i) * 1e-2;
    SpacePoint::plane(50.0 + 49.0 * (1.9 * t).sin(), 50.0 + 49.0 * (3.0 * t).cos())
}

/// A point on a path through the whole cube of five dimensions, corners included.
fn dragged_on_five(i: u32) -> SpacePoint {
    let t = f64::from(i) * 1e-2;
    let coordinates = [1.9, 3.0, 2.3, 0.7, 1.3].map(|rate: f64| 50.0 + 49.0 * (rate * t + rate).sin());
    SpacePoint::of(&coordinates).expect("no point")
}

/// The starter library, followed by modified copies of its textures at random positions, all different. The textures have
/// random coordinates on axes beyond the second.
fn authoring(n: usize, n_axes: usize) -> Authoring {
    let library = starter_library().expect("no starter library");
    let mut random = Random::new(7);
    let models: Vec<TextureModel> = (0..n)
        .map(|i| {
            let model = &library.textures[i % library.textures.len()].model;
            if i < library.textures.len() { model.clone() } else { changed(model, &mut random) }
        })
        .collect();
    let place = |i: usize| {
        let mut at = match library.textures.get(i) {
            Some(texture) => texture.at()?,
            None => SpacePoint::new(100.0 * random.uniform(), 100.0 * random.uniform()).ok()?,
        };
        at = at.on(n_axes);
        for axis in 2..n_axes {
            at = at.with(axis, 100.0 * random.uniform());
        }
        Some(at)
    };
    authoring_of(&models, &(0..n).map(place).collect::<Vec<_>>())
}

/// The starter library with height maps of different sides on two of its textures, of 256 heights along a side that need all
/// octaves.
fn with_height_maps() -> Authoring {
    let library = starter_library().expect("no starter library");
    let mut models: Vec<TextureModel> =
        library.textures.iter().map(|texture| texture.model.clone()).collect();
    let mut random = Random::new(9);
    for (model, side_m) in models.iter_mut().zip([0.02, 0.023]) {
        let heights_m = (0..256 * 256).map(|_| 1e-6 * random.normal()).collect();
        let map = HeightMap::new(heights_m, side_m, HeightMapOptions::HARD_PLASTIC).expect("no height map");
        *model = model.clone().with_height_map(Some(Arc::new(map)));
    }
    let places: Vec<Option<SpacePoint>> = library.textures.iter().map(TextureEntry::at).collect();
    authoring_of(&models, &places)
}

/// Interpolation between textures at these positions, with prepared height maps.
fn authoring_of(models: &[TextureModel], places: &[Option<SpacePoint>]) -> Authoring {
    let space = Space::new(places).expect("no space");
    let planes: Vec<Plane> = models.iter().map(Plane::new).collect();
    let layers = models.iter().zip(&planes).map(|(model, plane)| Some(Layers::of(model, plane)));
    let models = Models::new(&space, &layers.collect::<Vec<_>>()).expect("textures differ in rate");
    models.prepare_height_maps();
    Authoring::new(space).with_models(Arc::new(models))
}

/// A copy with shifted line spectral frequencies and changed levels, by the same amounts at all speeds and forces.
fn changed(model: &TextureModel, random: &mut Random) -> TextureModel {
    let order = model.nodes()[0].lsf.len();
    let bends: Vec<f64> = (0..order).map(|_| 0.03 * random.normal()).collect();
    let gain = (0.3 * random.normal()).exp();
    let nodes = model.nodes().iter().map(|node| GrainNode {
        lsf: repair(&node.lsf.iter().zip(&bends).map(|(w, bend)| w + bend).collect::<Vec<_>>()),
        level_mps2: gain * node.level_mps2,
        ..node.clone()
    });
    let friction = model.friction().map(|friction| friction * (0.2 * random.normal()).exp());
    TextureModel::new(model.rate(), nodes.collect(), friction).expect("no model").with_layers_of(model)
}
