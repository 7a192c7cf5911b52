//! Authors a texture at a point of the starter space, and renders two seconds of acceleration at a stylus.
//!
//! Run it with `cargo run --example author_a_texture`.
#![allow(clippy::print_stdout, reason = "an example prints its results")]

use std::sync::Arc;

use shagreen_core::space::authoring::{Authoring, Blending, Layers, Models};
use shagreen_core::space::{Space, SpacePoint};
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::render::{RenderPlan, render};
use shagreen_core::units::{Contact, Hertz};
use shagreen_formats::starter::starter_library;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let library = starter_library()?;
    let space = Space::new(&library.positions())?;
    let planes: Vec<Plane> = library.textures.iter().map(|texture| Plane::new(&texture.model)).collect();
    let layers: Vec<_> =
        library.textures.iter().zip(&planes).map(|(t, plane)| Some(Layers::of(&t.model, plane))).collect();
    let models = Models::new(&space, &layers)?;
    let authoring = Authoring::new(space).with_models(Arc::new(models));

    // Rather rough (0 is roughest) and rather soft (100 is softest): a new texture, interpolated from all textures.
    let point = SpacePoint::new(30.0, 70.0)?;
    let authored = authoring.author(point, &Blending::default()).ok_or("the space has no textures")?;
    for (texture, weight) in authored.parents.iter().take(3) {
        println!("{:5.1} % {}", 100.0 * weight, library.textures[*texture].name);
    }
    let model = authored.model.as_ref().ok_or("there is no field texture at this point")?;

    // A stroke at 100 mm/s with normal force rising from 0 to 2 N.
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
        "RMS acceleration: first half second {:.2} m/s², last half second {:.2} m/s²",
        rms(&acceleration[..500]),
        rms(&acceleration[1500..])
    );
    Ok(())
}
