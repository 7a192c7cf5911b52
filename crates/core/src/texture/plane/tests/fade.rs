use proptest::prelude::{prop_assert, proptest};
use shagreen_synth::contact::Contact as SynthContact;
use shagreen_synth::direction::Direction;

use super::is_accepted;
use crate::texture::TextureModel;
use crate::texture::plane::Plane;
use crate::texture::test_textures::two_resonances;
use crate::units::Contact;

/// Shares of the lowest measured speed or force at which levels are compared.
const SHARES: [f64; 8] = [0.02, 0.1, 0.25, 0.4, 0.55, 0.7, 0.85, 0.98];

fn level(plane: &Plane, speed_mps: f64, force_n: f64) -> f64 {
    plane.at(Contact::from_mm_per_s_and_n(1e3 * speed_mps, force_n)).level_mps2
}

/// Before, these textures were exactly silent below v / 40 mm/s + f / 0.5 N = 1.
#[test]
fn below_a_regular_grid_the_level_is_that_of_its_corner_times_the_smaller_share() {
    for (speeds, forces) in [
        (&[0.05, 0.1, 0.2][..], &[0.5, 1.0, 2.0][..]),
        (&[0.05, 0.1, 0.15, 0.2], &[0.5, 1.0, 2.0]),
        (&[0.06, 0.12], &[0.8, 1.6]),
    ] {
        let plane = Plane::new(&two_resonances(speeds, forces));
        let prepared = plane.prepare();
        assert!(is_accepted(&prepared));
        let corner = level(&plane, speeds[0], forces[0]);
        for v in SHARES {
            for f in SHARES {
                let (speed_mps, force_n) = (v * speeds[0], f * forces[0]);
                let (got, expected) = (level(&plane, speed_mps, force_n), corner * v.min(f));
                assert!((got / expected - 1.0).abs() < 1e-9, "{got} for {expected} at {v}, {f}");
                let contact = SynthContact { speed_mps: speed_mps as f32, force_n: force_n as f32 };
                let played = prepared.view().evaluate(contact, Direction::UNKNOWN, &mut [0; 2]).level_mps2;
                // Weights in f32.
                assert!((f64::from(played) / expected - 1.0).abs() < 1e-3, "{played} for {expected}");
            }
        }
    }
}

/// Number of vertices below the lowest measured speed and force, without those on the axes.
fn n_fading(texture: &TextureModel) -> usize {
    let plane = Plane::new(texture);
    let [speeds, forces] = plane.measured_range();
    let lowest = [speeds.0 / speeds.1, forces.0 / forces.1];
    let is_below = |at: &&[f64; 2]| (0..2).all(|axis| at[axis] > 0.0 && at[axis] < lowest[axis]);
    plane.triangulation.points().iter().filter(is_below).count()
}

#[test]
fn a_texture_measured_near_the_origin_has_no_fading_node() {
    let near = two_resonances(&[0.03, 0.07, 0.12, 0.18, 0.25], &[0.15, 0.4, 0.8, 1.5, 3.0]);
    assert_eq!(n_fading(&near), 0);
    // The texture of the first test has one: the control.
    assert_eq!(n_fading(&two_resonances(&[0.05, 0.1, 0.2], &[0.5, 1.0, 2.0])), 1);
}

proptest! {
    /// Below the lowest speed and force of a grid, the level is above zero and never falls with speed or force.
    #[test]
    fn below_any_grid_the_level_rises_from_silence(speed_mps in 0.02_f64..0.08, force_n in 0.2_f64..1.0) {
        let times = |lowest: f64| [lowest, 2.0 * lowest, 3.0 * lowest];
        let plane = Plane::new(&two_resonances(&times(speed_mps), &times(force_n)));
        let corner = level(&plane, speed_mps, force_n);
        for fixed in SHARES {
            let (mut over_speed, mut over_force) = (0.0, 0.0);
            for share in SHARES {
                let by_speed = level(&plane, share * speed_mps, fixed * force_n);
                let by_force = level(&plane, fixed * speed_mps, share * force_n);
                let rises = |level: f64, before: f64| level > 0.0 && level >= before - 1e-9 * corner;
                prop_assert!(rises(by_speed, over_speed), "{by_speed} at {share}, {fixed}");
                prop_assert!(rises(by_force, over_force), "{by_force} at {fixed}, {share}");
                (over_speed, over_force) = (by_speed, by_force);
            }
        }
    }

    /// Wherever the lowest corner of a grid lies, no contact is silent.
    #[test]
    fn no_contact_is_silent(
        lowest in [0.015_f64..0.3, 0.2_f64..5.0],
        n in [1_usize..5, 1_usize..5],
        at in [0.01_f64..1.0, 0.01_f64..1.0],
    ) {
        let along = |axis: usize| -> Vec<f64> {
            (0..n[axis]).map(|i| lowest[axis] * (1.0 + 0.7 * i as f64)).collect()
        };
        let (speeds, forces) = (along(0), along(1));
        let plane = Plane::new(&two_resonances(&speeds, &forces));
        let highest = [speeds[speeds.len() - 1], forces[forces.len() - 1]];
        let got = level(&plane, at[0] * highest[0], at[1] * highest[1]);
        prop_assert!(got > 1e-6, "{got}");
    }
}
