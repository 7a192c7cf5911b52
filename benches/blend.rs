//! Blending: what a drag costs, mode by mode, in spaces of 25 and 1,000 textures, up to what the renderer takes.
#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a benchmark stops at what it did not expect, and prints"
)]

#[path = "common/measure.rs"]
mod measure;

use std::hint::black_box;
use std::sync::Arc;

use measure::bench;
use shagreen_core::authoring::{Authored, Authoring, Blending, Layers, Models, Outside, Weights};
use shagreen_core::blend::Mode;
use shagreen_core::lsf::repair;
use shagreen_core::plane::Plane;
use shagreen_core::rng::Random;
use shagreen_core::space::{Space, SpacePoint};
use shagreen_core::texture::{GrainNode, TextureModel};
use shagreen_formats::starter::starter_library;

fn main() {
    for n in [25, 1000] {
        let authoring = authoring(n);
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
        bench(&format!("re-blend to what the renderer takes, {n} textures, field"), 100.0, "drag", || {
            for i in 0..100 {
                let authored = authoring.author(dragged(i), &Blending::default()).expect("a texture");
                black_box(Plane::new(model(&authored)).prepare());
            }
        });
    }
}

fn model(authored: &Authored) -> &TextureModel {
    authored.model.as_ref().expect("a texture that was made")
}

/// A point on its way through the whole square, corners and all.
fn dragged(i: u32) -> SpacePoint {
    let t = f64::from(i) * 1e-2;
    SpacePoint { rough_smooth: 50.0 + 49.0 * (1.9 * t).sin(), hard_soft: 50.0 + 49.0 * (3.0 * t).cos() }
}

/// The starter library, or changed copies of its textures at random places: no two are alike.
fn authoring(n: usize) -> Authoring {
    let library = starter_library().expect("the starter library");
    let mut random = Random::new(7);
    let models: Vec<TextureModel> = (0..n)
        .map(|i| {
            let model = &library.textures[i % library.textures.len()].model;
            if i < library.textures.len() { model.clone() } else { changed(model, &mut random) }
        })
        .collect();
    let place = |i: usize| match library.textures.get(i) {
        Some(texture) => texture.at(),
        None => SpacePoint::new(100.0 * random.uniform(), 100.0 * random.uniform()).ok(),
    };
    let space = Space::new(&(0..n).map(place).collect::<Vec<_>>()).expect("a space");
    let planes: Vec<Plane> = models.iter().map(Plane::new).collect();
    let layers = models.iter().zip(&planes).map(|(model, plane)| Some(Layers::of(model, plane)));
    let models = Models::new(&space, &layers.collect::<Vec<_>>()).expect("textures of one rate");
    Authoring::new(space).with_models(Arc::new(models))
}

/// The same texture with its frequencies bent and its levels changed, alike at all speeds and forces.
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
    TextureModel::new(model.rate(), nodes.collect(), friction).expect("a texture").with_tap(model.tap())
}
