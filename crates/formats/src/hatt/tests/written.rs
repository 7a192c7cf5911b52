//! Files that are written, read again.

use std::f64::consts::PI;

use proptest::prelude::{Strategy, prop_assert, proptest};
use shagreen_core::dsp::ar::{comparison_frequencies, psd, response};
use shagreen_core::dsp::lsf::ar_from_lsf;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::stick_slip::StickSlip;
use shagreen_core::texture::{GrainNode, Interpolation, MAX_ORDER, PublishedNode, TextureModel};
use shagreen_core::units::{Contact, Hertz, MetersPerSecond, Newtons};

use super::{Spelling, file, lsf, nodes, read};
use crate::hatt::{lost_in_hatt, read_hatt, write_hatt};
use crate::library::{Provenance, TextureEntry};

/// One-sided PSD of a published node, computed from its definition.
fn density(node: &PublishedNode, frequencies: &[Hertz]) -> Vec<f64> {
    let rate = Hertz(1000.0);
    let poles = psd(&ar_from_lsf(&node.ar_lsf), node.gain * node.gain * node.variance, rate, frequencies);
    // |B|² is the reciprocal of the PSD of an AR model with the same coefficients.
    let zeros = response(&ar_from_lsf(&node.ma_lsf), rate, frequencies);
    poles.iter().zip(zeros).map(|(p, (re, im))| p / (re * re + im * im)).collect()
}

/// Largest difference of two PSDs in dB.
fn worst_db(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (10.0 * (a / b).log10()).abs()).fold(0.0, f64::max)
}

#[test]
fn published_files_are_restricted_and_ours_are_not() {
    let restricted = read(&file(&nodes(6, 4), Spelling::Spaces)).value.into_entry("a");
    assert_eq!(restricted.provenance, Provenance::Restricted);
    assert_eq!(restricted.origin, "HaTT texture 42, restricted");
    assert!(restricted.license.contains("redistribution requires written approval"));
    let again = read_hatt(&write_hatt(&restricted, "x").unwrap()).unwrap().value;
    assert_eq!(again.provenance, Provenance::Restricted, "a restricted texture stays restricted");
    let ours = TextureEntry { provenance: Provenance::Free, license: String::new(), ..restricted };
    let back = read_hatt(&write_hatt(&ours, "shagreen 0.1").unwrap()).unwrap().value;
    assert_eq!((back.provenance, back.created_by.as_deref()), (Provenance::Free, Some("shagreen 0.1")));
    assert_eq!(back.into_entry("b").origin, "A file in HaTT format by shagreen 0.1");
}

#[test]
fn a_published_texture_comes_back_as_it_was() {
    let model = TextureModel::published(Hertz(1000.0), nodes(18, 16), Some(0.5)).unwrap();
    let entry = TextureEntry::new("a", "A & <b>", model.clone());
    let imported = read_hatt(&write_hatt(&entry, "test").unwrap()).unwrap();
    assert_eq!(imported.warnings, [""; 0]);
    assert_eq!(imported.value.name, "A & <b>");
    assert_eq!(imported.value.model.friction(), Some(0.5));
    for (read, made) in imported.value.model.published_nodes().iter().zip(model.published_nodes()) {
        assert_eq!((read.ar_lsf.clone(), read.ma_lsf.clone()), (made.ar_lsf.clone(), made.ma_lsf.clone()));
        assert_eq!((read.variance, read.gain, read.force), (made.variance, made.gain, made.force));
        // Conversion to mm/s and back may change the last bit.
        assert!((read.speed.0 - made.speed.0).abs() < 1e-15);
    }
}

fn measured(order: usize, seed: u64) -> TextureModel {
    let node = |(index, (speed, force)): (u64, (f64, f64))| GrainNode {
        speed: MetersPerSecond::from_mm_per_s(speed),
        force: Newtons(force),
        lsf: lsf(order, seed + index),
        level_mps2: 0.3 + speed / 100.0,
    };
    let places = [(30.0, 0.3), (90.0, 0.4), (160.0, 2.5), (70.0, 1.5)];
    TextureModel::new(Hertz(1000.0), (0..).zip(places).map(node).collect(), Some(0.4)).unwrap()
}

#[test]
fn a_texture_of_the_highest_order_keeps_its_spectra() {
    let order = MAX_ORDER;
    let step = PI / (order + 1) as f64;
    let low = measured(1, 3);
    let nodes = low.nodes().iter().enumerate().map(|(index, node)| GrainNode {
        lsf: (1..=order).map(|k| step * (k as f64 + 0.2 * (1.7 * k as f64 + index as f64).sin())).collect(),
        ..node.clone()
    });
    let model = TextureModel::new(Hertz(1000.0), nodes.collect(), Some(0.4)).unwrap();
    let imported =
        read_hatt(&write_hatt(&TextureEntry::new("a", "A", model.clone()), "test").unwrap()).unwrap();
    assert_eq!(imported.warnings, [""; 0]);
    let read = imported.value.model;
    assert_eq!((read.order(), read.ma_order()), (order, 0));
    let frequencies = comparison_frequencies(Hertz(1000.0), 200);
    let plane = Plane::new(&model);
    for (published, node) in read.published_nodes().iter().zip(model.nodes()) {
        let grain = plane.at(Contact { speed: node.speed, force: node.force });
        let worst = worst_db(&density(published, &frequencies), &grain.psd(&frequencies));
        assert!(worst < 0.01, "{worst} dB");
    }
}

proptest! {
    #[test]
    fn a_measured_texture_keeps_its_spectra(order in 1_usize..=32, seed in (0_u64..1000).prop_map(|s| 50 * s)) {
        let model = measured(order, seed);
        let entry = TextureEntry::new("a", "A", model.clone());
        let imported = read_hatt(&write_hatt(&entry, "test").unwrap()).unwrap();
        prop_assert!(imported.warnings.is_empty(), "{:?}", imported.warnings);
        let read = imported.value.model;
        // The neutral moving average of the file is removed.
        prop_assert!(read.ma_order() == 0);
        let frequencies = comparison_frequencies(Hertz(1000.0), 200);
        let plane = Plane::new(&model);
        for (published, node) in read.published_nodes().iter().zip(model.nodes()) {
            let grain = plane.at(Contact { speed: node.speed, force: node.force });
            let expected = grain.psd(&frequencies);
            // The published accuracy is 0.1 dB. Rounding frequencies at least 0.03 rad apart to six decimals causes a
            // tenth of it.
            let worst = worst_db(&density(published, &frequencies), &expected);
            prop_assert!(worst < 0.01, "{worst} dB");
        }
    }
}

#[test]
fn a_directional_texture_keeps_its_grain_across_the_lay_and_the_rest_is_named() {
    let model = measured(4, 7);
    let along = model.nodes().iter().map(|n| GrainNode { level_mps2: 0.1, ..n.clone() }).collect();
    let stick_slip = StickSlip { static_ratio: 1.5, stribeck_speed: MetersPerSecond(0.02) };
    let layered = model.clone().with_along(Some(along)).unwrap();
    let layered = layered.with_stick_slip(Some(stick_slip)).with_turn_rad(0.5);
    let entry = |model: TextureModel| TextureEntry::new("a", "A", model);
    let (layered, plain) = (entry(layered), entry(model));
    assert_eq!(write_hatt(&layered, "test"), write_hatt(&plain, "test"));
    let lost = lost_in_hatt(&layered).join("; ");
    let named = ["the direction", "the rotation", "stick-slip friction"];
    assert!(named.iter().all(|name| lost.contains(*name)), "{lost}");
    assert_eq!(lost_in_hatt(&layered).len(), lost_in_hatt(&plain).len() + named.len());
}

#[test]
fn other_interpolations_and_rates_are_written_as_nodes() {
    let model = measured(4, 7).with_interpolation(Interpolation::RadialBasis).unwrap();
    let fast = TextureModel::new(Hertz(2000.0), model.nodes().to_vec(), None).unwrap();
    let back = |model: &TextureModel| {
        read_hatt(&write_hatt(&TextureEntry::new("a", "A", model.clone()), "test").unwrap())
            .unwrap()
            .value
            .model
    };
    assert_eq!(back(&model).published_nodes().len(), back(&measured(4, 7)).published_nodes().len());
    assert_eq!((back(&fast).rate(), back(&fast).friction()), (Hertz(2000.0), None));
}
