//! The texture of the callback has the levels of the model, over the whole plane of every texture that comes with the
//! program.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a test may stop at what it did not expect"
)]

use serde_json::Value;
use shagreen_core::ar::power_gain;
use shagreen_core::plane::Plane;
use shagreen_core::texture::{GrainNode, TextureModel};
use shagreen_core::units::{Contact, Hertz, MetersPerSecond, Newtons};
use shagreen_synth::contact::Contact as SynthContact;
use shagreen_synth::lsf::ar_from_lsf;

const STARTER: &str = include_str!("../../../assets/starter/starter.json");

/// The models alone: reading all of the file is the work of another crate, which is above this one.
fn models() -> Vec<(String, TextureModel)> {
    let number = |value: &Value| value.as_f64().expect("a number");
    let node = |anchor: &Value| GrainNode {
        speed: MetersPerSecond::from_mm_per_s(number(&anchor["speed_mm_per_s"])),
        force: Newtons(number(&anchor["force_n"])),
        lsf: anchor["lsf"].as_array().expect("frequencies").iter().map(number).collect(),
        level_mps2: number(&anchor["level_mps2"]),
    };
    let library: Value = serde_json::from_str(STARTER).expect("valid JSON");
    let textures = library["textures"].as_array().expect("textures");
    let model = |texture: &Value| {
        let nodes = texture["anchors"].as_array().expect("anchors").iter().map(node).collect();
        let model = TextureModel::new(Hertz(number(&texture["rate_hz"])), nodes, None);
        (texture["id"].as_str().expect("an id").to_owned(), model.expect("a model"))
    };
    textures.iter().map(model).collect()
}

/// The level of the very predictor and excitation that the callback would run, against the model.
#[test]
fn levels_of_the_starter_textures_are_those_of_their_models() {
    let models = models();
    assert_eq!(models.len(), 25);
    let mut worst = (0.0_f64, String::new());
    for (id, model) in &models {
        let plane = Plane::new(model);
        let prepared = plane.prepare();
        let view = prepared.view();
        let (speed_max, force_max) = (model.speed_max().0, model.force_max().0);
        let check = &mut |x: f64, y: f64| {
            let contact = Contact { speed: MetersPerSecond(x * speed_max), force: Newtons(y * force_max) };
            let got = view.evaluate(
                SynthContact { speed_mps: contact.speed.0 as f32, force_n: contact.force.0 as f32 },
                &mut 0,
            );
            let mut ar = vec![0.0; model.order()];
            ar_from_lsf(&got.lsf[..model.order()], &mut ar);
            let gain = power_gain(&ar.iter().map(|a| f64::from(*a)).collect::<Vec<_>>());
            let level = f64::from(got.sigma_mps2) * gain.sqrt();
            let error_db = 20.0 * (level / plane.at(contact).level_mps2).log10();
            if error_db.abs() > worst.0.abs() || error_db.is_nan() {
                worst = (error_db, format!("{id} at {contact:?}"));
            }
        };
        // A grid that meets no node, and the lines of the grid of measurements, where the error of a quadratic is largest.
        for i in 1..60 {
            let along = f64::from(i) / 60.0;
            for j in 1..60 {
                check(along + 0.003, f64::from(j) / 60.0 + 0.002);
            }
            for node in model.nodes() {
                check(along, node.force.0 / force_max);
                check(node.speed.0 / speed_max, along);
            }
        }
    }
    assert!(worst.0.abs() < 0.1, "{} dB: {}", worst.0, worst.1);
}
