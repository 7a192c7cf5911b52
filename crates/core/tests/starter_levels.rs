//! Levels of the prepared textures in the audio callback equal those of the models, over the whole plane of every
//! starter texture. Conversion to another sample rate preserves their spectra.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a test may panic on unexpected data"
)]

use serde_json::Value;
use shagreen_core::dsp::ar::power_gain;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::rate::at_rate;
use shagreen_core::texture::{GrainNode, TextureModel};
use shagreen_core::units::{Contact, Hertz, MetersPerSecond, Newtons};
use shagreen_synth::contact::Contact as SynthContact;
use shagreen_synth::direction::Direction;
use shagreen_synth::lsf::ar_from_lsf;

const STARTER: &str = include_str!("../../../assets/starter/starter.json");

/// Reads only the models; the complete file format belongs to another crate, which depends on this one.
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

/// Compares the level of the predictor and excitation that the callback runs with the level of the model.
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
                Direction::UNKNOWN,
                &mut [0; 2],
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
        // A grid that contains no node, and the lines of the measurement grid, where the error of the quadratic is
        // largest.
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

/// Root-mean-square differences of the spectra up to 450 Hz at every node, in dB, in ascending order.
fn errors_at(rate_hz: f64) -> Vec<f64> {
    let mut errors = Vec::new();
    let f: Vec<Hertz> = (1..=90).map(|i| Hertz(5.0 * f64::from(i))).collect();
    for (id, model) in models() {
        let converted = at_rate(&model, Hertz(rate_hz)).unwrap().model;
        let (before, after) = (Plane::new(&model), Plane::new(&converted));
        for contact in model.contacts() {
            let (a, b) = (before.at(contact), after.at(contact));
            assert!((a.level_mps2 / b.level_mps2 - 1.0).abs() < 1e-9, "{id}: level");
            let squares = a.psd(&f).into_iter().zip(b.psd(&f)).map(|(a, b)| (10.0 * (a / b).log10()).powi(2));
            errors.push((squares.sum::<f64>() / f.len() as f64).sqrt());
        }
    }
    errors.sort_by(f64::total_cmp);
    errors
}

#[test]
fn starter_textures_keep_their_spectra_at_higher_rates() {
    // Measured: 0.46 dB and 2.67 dB at twice the rate; 2.01 dB and 6.41 dB at four times, where the predictor order
    // covers a band of which three quarters are empty.
    for (rate_hz, median_db, worst_db) in [(2000.0, 0.5, 3.0), (4000.0, 2.5, 7.0)] {
        let errors = errors_at(rate_hz);
        let (median, worst) = (errors[errors.len() / 2], errors[errors.len() - 1]);
        println!("at {rate_hz} Hz: median {median:.2} dB, worst {worst:.2} dB of {} nodes", errors.len());
        assert!(median < median_db && worst < worst_db, "{rate_hz}: median {median}, worst {worst}");
    }
}
