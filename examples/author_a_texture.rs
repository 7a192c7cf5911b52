//! Authors a texture at a point of the starter space and renders two seconds of it, as a stylus would feel it.
//!
//! Run it with `cargo run --example author_a_texture`.
#![allow(clippy::print_stdout, reason = "an example shows what it does")]

use std::sync::Arc;

use shagreen_core::authoring::{Authoring, Blending, Layers, Models};
use shagreen_core::plane::Plane;
use shagreen_core::render::{RenderPlan, render};
use shagreen_core::space::{Space, SpacePoint};
use shagreen_core::units::{Contact, Hertz};
use shagreen_formats::starter::starter_library;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let library = starter_library()?;
    let space = Space::new(&library.positions())?;
    let planes: Vec<Plane> = library.textures.iter().map(|texture| Plane::new(&texture.model)).collect();
    let layers: Vec<_> = library
        .textures
        .iter()
        .zip(&planes)
        .map(|(t, plane)| Some(Layers { plane, friction: t.model.friction(), tap: t.model.tap() }))
        .collect();
    let models = Models::new(&space, &layers)?;
    let authoring = Authoring::new(space).with_models(Arc::new(models));

    // Rather rough (0 is roughest) and rather soft (100 is softest): a texture like any other, from a field over all.
    let point = SpacePoint::new(30.0, 70.0)?;
    let authored = authoring.author(point, &Blending::default()).ok_or("the space has no textures")?;
    for (texture, weight) in authored.parents.iter().take(3) {
        println!("{:5.1} % {}", 100.0 * weight, library.textures[*texture].name);
    }
    let model = authored.model.as_ref().ok_or("the field has no texture there")?;

    // A stroke at 100 mm/s that presses harder and harder, up to 2 N.
    let mut contact_at = |time_secs: f64| Contact::from_mm_per_s_and_n(100.0, time_secs);
    let prepared = Plane::new(model).prepare();
    let plan = RenderPlan {
        parents: &[(&prepared, 1.0)],
        mode: authored.mixing(),
        rate: Hertz(1000.0),
        seconds: 2.0,
        seed: 1,
    };
    let acceleration = render(&plan, &mut contact_at)?;
    let rms = |x: &[f32]| (x.iter().map(|v| v * v).sum::<f32>() / x.len() as f32).sqrt();
    println!(
        "first half second {:.2} m/s², last {:.2} m/s²",
        rms(&acceleration[..500]),
        rms(&acceleration[1500..])
    );
    Ok(())
}
