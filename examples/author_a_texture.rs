//! Authors a texture at a point of the starter space and renders two seconds of it, as a stylus would feel it.
//!
//! Run it with `cargo run --example author_a_texture`.
#![allow(clippy::print_stdout, reason = "an example shows what it does")]

use shagreen_core::blend::{Mode, author};
use shagreen_core::plane::{Plane, Prepared};
use shagreen_core::render::{RenderPlan, render};
use shagreen_core::space::{Space, SpacePoint};
use shagreen_core::units::{Contact, Hertz};
use shagreen_formats::starter::starter_library;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let library = starter_library()?;
    let space = Space::new(&library.positions())?;

    // Rather rough (0 is roughest) and rather soft (100 is softest).
    let point = SpacePoint::new(30.0, 70.0)?;
    let authored = author(&space, point, Mode::Shared).ok_or("the space has no textures")?;
    for (texture, weight) in &authored.parents {
        println!("{:5.1} % {}", 100.0 * weight, library.textures[*texture].name);
    }

    // A stroke at 100 mm/s that presses harder and harder, up to 2 N.
    let mut contact_at = |time_secs: f64| Contact::from_mm_per_s_and_n(100.0, time_secs);
    let prepared: Vec<(Prepared, f64)> = authored
        .parents
        .iter()
        .map(|(t, w)| (Plane::new(&library.textures[*t].model).prepare(), *w))
        .collect();
    let parents: Vec<(&Prepared, f64)> = prepared.iter().map(|(p, w)| (p, *w)).collect();
    let plan =
        RenderPlan { parents: &parents, mode: authored.mode, rate: Hertz(1000.0), seconds: 2.0, seed: 1 };
    let acceleration = render(&plan, &mut contact_at)?;
    let rms = |x: &[f32]| (x.iter().map(|v| v * v).sum::<f32>() / x.len() as f32).sqrt();
    println!(
        "first half second {:.2} m/s², last {:.2} m/s²",
        rms(&acceleration[..500]),
        rms(&acceleration[1500..])
    );
    Ok(())
}
