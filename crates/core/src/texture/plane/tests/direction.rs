use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use proptest::prelude::{prop_assert, proptest};
use shagreen_synth::contact::Contact as SynthContact;
use shagreen_synth::direction::Direction;

use super::is_accepted;
use crate::dsp::ar::test_signals::from_resonances;
use crate::dsp::lsf::lsf_from_ar;
use crate::texture::plane::{Grain, Plane, Prepared};
use crate::texture::stick_slip::StickSlip;
use crate::texture::test_textures::{arma, two_resonances};
use crate::texture::{GrainNode, Interpolation, TextureModel};
use crate::units::{Contact, Hertz, MetersPerSecond, Radians};

const TURN_RAD: f64 = 0.4;

/// Texture whose grain along its lay has other resonances and a third of the level.
fn brushed() -> TextureModel {
    let across = two_resonances(&[0.05, 0.1, 0.2], &[0.5, 1.0, 2.0]);
    let along = across.nodes().iter().map(|node| {
        let resonances =
            [(Hertz(120.0 + 300.0 * node.speed.0), 0.85), (Hertz(260.0), 0.8), (Hertz(430.0), 0.6)];
        let lsf = lsf_from_ar(&from_resonances(Hertz(1000.0), &resonances)).unwrap();
        GrainNode { lsf, level_mps2: node.level_mps2 / 3.0, ..node.clone() }
    });
    let along = along.collect();
    across.with_along(Some(along)).unwrap().with_turn_rad(TURN_RAD)
}

/// Level, line spectral frequencies and excitation of the renderer for a stroke at an angle on the pad.
fn rendered(prepared: &Prepared, contact: Contact, on_pad: f64) -> (f64, Vec<f64>, f64) {
    let at = SynthContact { speed_mps: contact.speed.0 as f32, force_n: contact.force.0 as f32 };
    let got = prepared.view().evaluate(at, Direction::at_angle(on_pad as f32), &mut [0; 2]);
    let lsf = got.lsf[..prepared.view().order()].iter().map(|w| f64::from(*w)).collect();
    (f64::from(got.level_mps2), lsf, f64::from(got.sigma_mps2))
}

#[test]
fn the_grains_are_met_exactly_along_and_across_and_mixed_between() {
    let model = brushed();
    let plane = Plane::new(&model);
    for (across, along) in model.nodes().iter().zip(model.along().unwrap()) {
        let at = |angle| plane.at_angle(Contact { speed: across.speed, force: across.force }, Radians(angle));
        let check = |grain: &Grain, lsf: &[f64], level: f64| {
            assert!((grain.level_mps2 - level).abs() < 1e-9, "{} for {level}", grain.level_mps2);
            assert!(grain.lsf.iter().zip(lsf).all(|(a, b)| (a - b).abs() < 1e-9));
        };
        for turns in [0.0, PI, -PI] {
            check(&at(turns), &across.lsf, across.level_mps2);
            check(&at(turns + FRAC_PI_2), &along.lsf, along.level_mps2);
        }
        let middle: Vec<f64> = across.lsf.iter().zip(&along.lsf).map(|(a, b)| 0.5 * (a + b)).collect();
        // Half of the power of 1 and of 1/9.
        let level = across.level_mps2 * (5.0_f64 / 9.0).sqrt();
        check(&at(FRAC_PI_4), &middle, level);
        check(&at(-FRAC_PI_4), &middle, level);
        // The level is that of the spectrum: its integral from 0 Hz to half of the rate.
        let f: Vec<Hertz> = (0..5000).map(|i| Hertz(0.1 * (f64::from(i) + 0.5))).collect();
        let power: f64 = at(0.7).psd(&f).iter().sum::<f64>() * 0.1;
        assert!((power.sqrt() / at(0.7).level_mps2 - 1.0).abs() < 1e-6);
    }
    assert_eq!(plane.at_angle(Contact::from_mm_per_s_and_n(0.0, 1.0), Radians(1.0)).level_mps2, 0.0);
}

#[test]
fn a_direction_on_the_pad_counts_from_the_rotated_axis() {
    let plane = Plane::new(&brushed());
    let contact = Contact::from_mm_per_s_and_n(100.0, 1.0);
    let level = |on_pad: f64| plane.toward(contact, Radians(on_pad)).level_mps2;
    let across = plane.at(contact).level_mps2;
    assert!((level(TURN_RAD) - across).abs() < 1e-9);
    assert!((level(TURN_RAD + FRAC_PI_2) - across / 3.0).abs() < 1e-9);
    let prepared = plane.prepare();
    // The renderer's weights and angles are in f32.
    assert!((level(0.7) - rendered(&prepared, contact, 0.7).0).abs() < 1e-4);
}

#[test]
fn isotropic_textures_are_the_same_at_every_angle() {
    for model in [two_resonances(&[0.05, 0.1], &[0.5, 1.0]), arma(6, 4)] {
        let plane = Plane::new(&model);
        let contact = Contact::from_mm_per_s_and_n(70.0, 0.6);
        assert!(plane.along().is_none() && plane.prepare().parts().along.is_none());
        for angle in [0.0, 0.3, 1.5, 3.0] {
            assert_eq!(plane.at_angle(contact, Radians(angle)), plane.at(contact));
        }
        let turned = Plane::new(&model.clone().with_turn_rad(1.0)).prepare();
        assert_eq!(turned.parts().nodes, plane.prepare().parts().nodes);
        assert_eq!((turned.parts().turn_rad, plane.prepare().parts().turn_rad), (1.0, 0.0));
    }
}

/// Every texture with a known coefficient has friction; it sticks only with the parameters of stick-slip.
#[test]
fn friction_needs_a_coefficient() {
    let stick_slip = StickSlip { static_ratio: 1.5, stribeck_speed: MetersPerSecond(0.02) };
    let model = two_resonances(&[0.1], &[1.0]).with_stick_slip(Some(stick_slip));
    let friction = |model: &TextureModel| Plane::new(model).prepare().parts().friction;
    assert_eq!(friction(&model), Some(stick_slip.with_kinetic(0.3)));
    assert_eq!(friction(&model.clone().with_friction(None).unwrap()), None);
    assert_eq!(friction(&model.clone().with_stick_slip(None)), Some(StickSlip::NONE.with_kinetic(0.3)));
    // A coefficient that `f32` cannot hold is accepted too.
    let extreme = Plane::new(&model.with_friction(Some(1e300)).unwrap()).prepare();
    assert!(is_accepted(&extreme));
}

#[test]
fn a_radial_basis_turns_too() {
    let model = brushed().with_interpolation(Interpolation::RadialBasis).unwrap();
    let plane = Plane::new(&model);
    let prepared = plane.prepare();
    assert!(is_accepted(&prepared));
    for (mm_per_s, force) in [(60.0, 0.7), (150.0, 1.5), (220.0, 0.2)] {
        let contact = Contact::from_mm_per_s_and_n(mm_per_s, force);
        for angle in [0.0, 0.5, FRAC_PI_4, 1.2, FRAC_PI_2, 2.5] {
            let want = plane.at_angle(contact, Radians(angle));
            let (level, _, sigma) = rendered(&prepared, contact, angle + TURN_RAD);
            let errors_db = [level / want.level_mps2, sigma / want.sigma_mps2].map(|r| 20.0 * r.log10());
            // The triangles approximate the basis to 0.2 dB of the level in the measured range, and its spectrum.
            assert!(errors_db.iter().all(|e| e.abs() < 0.5), "{errors_db:?} dB at {contact:?}, {angle}");
        }
    }
}

proptest! {
    /// Renderer and plane agree at every angle, as [`super::prepared_texture_is_the_model`] tests for one grain.
    #[test]
    fn the_renderer_turns_as_the_plane(
        mm_per_s in 1.0_f64..210.0, force in 0.02_f64..2.1, on_pad in -TAU..TAU
    ) {
        let plane = Plane::new(&brushed());
        let prepared = plane.prepare();
        prop_assert!(is_accepted(&prepared));
        let contact = Contact::from_mm_per_s_and_n(mm_per_s, force);
        let want = plane.at_angle(contact, Radians(on_pad - TURN_RAD));
        let (level, lsf, sigma) = rendered(&prepared, contact, on_pad);
        prop_assert!((level - want.level_mps2).abs() < 1e-4 * (1.0 + want.level_mps2));
        for (a, b) in lsf.iter().zip(&want.lsf) {
            prop_assert!((a - b).abs() < 1e-4, "{a} for {b}");
        }
        if want.level_mps2 > 1e-3 {
            let error_db = 20.0 * (sigma / want.sigma_mps2).log10();
            prop_assert!(error_db.abs() < 0.1, "level error {error_db} dB");
        }
    }
}
