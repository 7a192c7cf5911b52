//! Strokes of the contact model over the directional materials of the starter library, at three angles to their lay.
//!
//! The table of the notes: `cargo test --release -p shagreen-formats --test directional_materials -- --nocapture`.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test may panic on an unexpected result, and prints its figures on request"
)]

use shagreen_core::dsp::spectrum::{centroid, rms, welch};
use shagreen_core::surfaces::contact_model::{
    PEN, REFERENCE_CONTACT, STARTER_PATH_M, STROKE_RATE, prepare, simulate,
};
use shagreen_core::surfaces::height_field::{STARTER_TILE, synthesize};
use shagreen_core::surfaces::material::Material;
use shagreen_core::units::{Hertz, Radians};
use shagreen_formats::starter::starter_anchors;

/// Random seed of the starter library.
const SEED: u64 = 25;

/// Materials of the starter library with a stretched surface.
const STRETCHED: [&str; 3] = ["brushed-aluminium", "sanded-wood", "rough-sawn-wood"];

/// Power in (m/s²)² and spectral centroid of four seconds at 100 mm/s and 1 N, at angles across the lay, halfway and along
/// it.
fn at_three_angles(material: &Material) -> [(f64, Hertz); 3] {
    let field = synthesize(material, STARTER_TILE, SEED);
    [0.0, 45.0, 90.0].map(|degrees| {
        let angle = Radians::from_degrees(degrees);
        let surface = prepare(material, &field, &PEN, STARTER_PATH_M, angle, SEED);
        let mut signal = Vec::new();
        for seed in 1..=4 {
            signal.extend(simulate(&surface, REFERENCE_CONTACT, 1.0, seed).unwrap());
        }
        let density = welch(&signal, STROKE_RATE, 500);
        (rms(&signal).powi(2), centroid(&density, Hertz(10.0), Hertz(450.0)))
    })
}

fn directional() -> Vec<Material> {
    let (anchors, _) = starter_anchors().unwrap();
    anchors.into_iter().map(|anchor| anchor.material).filter(Material::is_directional).collect()
}

#[test]
fn brushed_metal_and_wood_differ_along_and_across() {
    let materials = directional();
    for id in STRETCHED {
        let material = materials.iter().find(|material| material.id == id).unwrap();
        let [across, _, along] = at_three_angles(material);
        let decibels = 10.0 * (across.0 / along.0).log10();
        let shift = across.1.0 / along.1.0;
        let differs = decibels.abs() >= 6.0 || !(1.0 / 1.3..=1.3).contains(&shift);
        assert!(differs, "{id}: {decibels:.1} dB, centroids {} and {}", across.1, along.1);
    }
}

#[test]
fn halfway_the_power_is_about_the_mean_of_both_directions() {
    for material in directional() {
        let [across, halfway, along] = at_three_angles(&material);
        // The renderer weights both by cos² and sin² of the angle to the axis.
        let decibels = 10.0 * (halfway.0 / (0.5 * (across.0 + along.0))).log10();
        let level = |power: f64| 10.0 * power.log10();
        println!(
            "| {} | {:.1} | {:.1} | {:.1} | {:.0} | {:.0} | {decibels:+.1} |",
            material.name,
            level(across.0),
            level(halfway.0),
            level(along.0),
            across.1.0,
            along.1.0
        );
        // Ridges alone would be 3 dB quieter at 45°: their period is longer by √2, and the power of an acceleration falls
        // as its fourth power. A weave has other periods along its diagonals.
        let most = if STRETCHED.contains(&material.id.as_str()) { 3.0 } else { 6.0 };
        assert!(decibels.abs() < most, "{}: {decibels:.1} dB off", material.id);
    }
}

#[test]
fn the_directional_materials_are_those_that_have_a_lay() {
    let ids: Vec<String> = directional().into_iter().map(|material| material.id).collect();
    let expected = [
        "brushed-aluminium",
        "sanded-wood",
        "rough-sawn-wood",
        "cardboard",
        "bumpy-rubber",
        "cotton-weave",
        "denim",
        "coarse-canvas",
        "loop-carpet",
    ];
    assert_eq!(ids, expected);
}
