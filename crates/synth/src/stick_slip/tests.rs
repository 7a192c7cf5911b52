extern crate std;
use super::{Friction, HIGHEST_SPEED_MPS, MAX_MPS2, MAX_STATIC_RATIO, StickSlip, Tip};
use crate::contact::Contact;
use std::vec;
use std::vec::Vec;

const RUBBER: Friction = Friction { kinetic: 0.8, static_ratio: 1.3, stribeck_speed_mps: 0.02 };

fn contact(speed_mps: f32, force_n: f32) -> Contact {
    Contact { speed_mps, force_n }
}

/// Two seconds of a constant contact in ticks of 5 ms.
fn stroke(rate_hz: f32, friction: Friction, contact: Contact) -> Vec<f32> {
    let mut model = StickSlip::new(rate_hz);
    let mut out = vec![0.0; 2 * rate_hz as usize];
    for tick in out.chunks_mut((0.005 * rate_hz) as usize) {
        model.add_tick(friction, (contact, contact), (1.0, 1.0), tick);
    }
    out
}

fn rms(samples: &[f32]) -> f32 {
    (samples.iter().map(|x| x * x).sum::<f32>() / samples.len() as f32).sqrt()
}

#[test]
fn what_cannot_stick_adds_exactly_nothing() {
    let pattern = [0.3_f32, -1.0, 2.0, 1e-20, 0.0];
    let moving = contact(0.01, 1.0);
    let unchanged = |friction: Friction, contacts: (Contact, Contact)| {
        let mut model = StickSlip::new(1000.0);
        let mut out = pattern;
        for _ in 0..100 {
            model.add_tick(friction, contacts, (1.0, 1.0), &mut out);
        }
        out == pattern
    };
    for static_ratio in [0.0, 0.5, 1.0, f32::NAN] {
        assert!(unchanged(Friction { static_ratio, ..RUBBER }, (moving, moving)), "{static_ratio}");
    }
    for kinetic in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(unchanged(Friction { kinetic, ..RUBBER }, (moving, moving)), "{kinetic}");
    }
    for still in [contact(0.0, 1.0), contact(0.01, 0.0), contact(f32::NAN, 1.0), contact(0.01, -1.0)] {
        assert!(unchanged(RUBBER, (still, still)), "{still:?}");
    }
    assert!(!unchanged(RUBBER, (moving, moving)));
}

#[test]
fn a_slow_tip_sticks_and_slips_and_a_fast_one_slides() {
    for speed_mps in [0.010, 0.020, 0.028] {
        let felt = rms(&stroke(1000.0, RUBBER, contact(speed_mps, 1.0))[1000..]);
        assert!(felt > 1.0, "{felt} m/s² at {speed_mps} m/s");
    }
    for speed_mps in [0.040, 0.080, 0.25, 2.0] {
        let felt = rms(&stroke(1000.0, RUBBER, contact(speed_mps, 1.0))[1000..]);
        assert!(felt < 1e-3, "{felt} m/s² at {speed_mps} m/s");
    }
    // A light touch has less friction to feed an oscillation.
    assert!(rms(&stroke(1000.0, RUBBER, contact(0.02, 0.3))[1000..]) < 0.05);
}

#[test]
fn the_vibration_does_not_depend_on_the_sample_rate() {
    let felt = |rate_hz: f32| rms(&stroke(rate_hz, RUBBER, contact(0.02, 1.0))[rate_hz as usize..]);
    let expected = felt(1000.0);
    for rate_hz in [500.0, 2000.0, 3200.0, 4000.0] {
        // A higher rate has more of the band: the edges of a slip.
        let ratio = felt(rate_hz) / expected;
        assert!((0.93..1.07).contains(&ratio), "{ratio} at {rate_hz} Hz");
    }
}

#[test]
fn the_vibration_is_that_of_far_finer_steps() {
    // Acceleration in m/s², and slips in two seconds, of a tip that slides for two seconds before.
    let felt = |friction: Friction, contact: Contact, finer: u32| {
        let (rate_hz, kinetic_n) = (1000.0, friction.kinetic * contact.force_n);
        let n_steps = finer * StickSlip::new(rate_hz).n_steps(kinetic_n);
        let mut tip = Tip::sliding(friction, contact.speed_mps, kinetic_n);
        let mut next = |_| {
            let before_mps = tip.velocity_mps;
            tip.advance(friction, contact.speed_mps, n_steps, 1.0 / (rate_hz * n_steps as f32));
            rate_hz * (tip.velocity_mps - before_mps)
        };
        let samples = (0..4000).map(&mut next).collect::<Vec<f32>>().split_off(2000);
        let felt_mps2 = rms(&samples);
        let (mut n_slips, mut is_pulled) = (0_u32, false);
        for mps2 in samples {
            if is_pulled && mps2 < -0.5 * felt_mps2 {
                (n_slips, is_pulled) = (n_slips + 1, false);
            } else if mps2 > 0.5 * felt_mps2 {
                is_pulled = true;
            }
        }
        (felt_mps2, n_slips)
    };
    let parameters = [(0.8, 1.3, 0.02), (0.4, 1.25, 0.02), (1.5, 1.5, 0.02), (0.8, 2.0, 0.005)];
    let contacts = [(0.01, 0.5), (0.01, 1.0), (0.02, 1.0), (0.02, 2.0), (0.05, 1.0), (0.05, 10.0)];
    let mut n_vibrating = 0;
    for (kinetic, static_ratio, stribeck_speed_mps) in parameters {
        let friction = Friction { kinetic, static_ratio, stribeck_speed_mps };
        for (speed_mps, force_n) in contacts {
            let contact = contact(speed_mps, force_n);
            let (coarse, fine) = (felt(friction, contact, 1), felt(friction, contact, 8));
            let case = std::format!("{friction:?} {contact:?}: {coarse:?}, finer {fine:?}");
            assert!((coarse.0 - fine.0).abs() < 0.02 + 0.04 * fine.0, "{case}");
            if fine.0 > 0.1 {
                assert!(coarse.1.abs_diff(fine.1) <= 1 + fine.1 / 20, "{case}");
                n_vibrating += 1;
            }
        }
    }
    assert!(n_vibrating >= 10, "{n_vibrating}");
}

#[test]
fn a_stronger_friction_takes_more_steps() {
    let n_steps = |rate_hz: f32, kinetic_n: f32| StickSlip::new(rate_hz).n_steps(kinetic_n);
    assert_eq!([0.0, 1.25, 5.0, 20.0].map(|kinetic_n| n_steps(1000.0, kinetic_n)), [4, 4, 8, 16]);
    assert_eq!([200.0, 3200.0, 4000.0].map(|rate_hz| n_steps(rate_hz, 20.0)), [80, 5, 4]);
}

#[test]
fn contact_and_lift_off_are_without_a_jump() {
    let mut model = StickSlip::new(1000.0);
    let (lifted, down) = (Contact::LIFTED, contact(0.02, 1.0));
    let mut ticks = vec![(lifted, lifted), (lifted, down)];
    ticks.extend([(down, down); 200]);
    ticks.extend([(down, lifted), (lifted, lifted)]);
    let mut out = vec![0.0; 5 * ticks.len()];
    for (tick, contacts) in out.chunks_mut(5).zip(&ticks) {
        model.add_tick(RUBBER, *contacts, (1.0, 1.0), tick);
    }
    let n = out.len();
    assert!(out[..5].iter().chain(&out[n - 5..]).all(|x| *x == 0.0));
    assert!(out[5].abs() < 0.1, "{}", out[5]);
    assert_eq!(out[n - 6], 0.0, "the last sample before the lifted tip");
    assert!(rms(&out[n / 2..n - 10]) > 1.0);
}

#[test]
fn weights_scale_the_output_and_not_the_motion() {
    let down = contact(0.02, 1.0);
    let run = |weight: f32| {
        let mut model = StickSlip::new(1000.0);
        let mut out = vec![0.0_f32; 1000];
        for tick in out.chunks_mut(5) {
            model.add_tick(RUBBER, (down, down), (weight, weight), tick);
        }
        out
    };
    for (whole, half) in run(1.0).iter().zip(run(0.5)) {
        assert_eq!(0.5 * whole, half);
    }
}

/// Pseudorandom numbers in 0..1.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1_u64 << 24) as f32
    }
}

#[test]
fn no_parameters_and_no_motion_make_it_grow() {
    let mut numbers = Numbers(7);
    for _ in 0..300 {
        let mut model = StickSlip::new(200.0 * 20.0_f32.powf(numbers.next()));
        let mut contacts = (Contact::LIFTED, Contact::LIFTED);
        for _ in 0..60 {
            let friction = Friction {
                kinetic: 10.0 * numbers.next().powi(3),
                static_ratio: 0.9 + 6.0 * numbers.next(),
                stribeck_speed_mps: 10.0_f32.powf(-4.0 + 5.0 * numbers.next()),
            };
            let wild = numbers.next() < 0.1;
            let to = Contact {
                speed_mps: if wild { f32::MAX } else { 10.0_f32.powf(-6.0 + 7.0 * numbers.next()) },
                force_n: if wild { 1e9 } else { 100.0 * numbers.next().powi(4) },
            };
            contacts = (contacts.1, to);
            let mut out = [0.0; 20];
            model.add_tick(friction, contacts, (1.0, 1.0), &mut out);
            if let Some(tip) = model.tip {
                // The bristle holds no more than the static friction, and the clamp never hides a growing tip.
                assert!(tip.bristle.abs() <= 1.01 * MAX_STATIC_RATIO, "{friction:?} {contacts:?} {tip:?}");
                assert!(
                    tip.velocity_mps.abs() < 10.0 * HIGHEST_SPEED_MPS,
                    "{friction:?} {contacts:?} {tip:?}"
                );
            }
            // The output of a first-order high-pass is at most twice its input.
            assert!(out.iter().all(|y| y.abs() <= 2.0 * MAX_MPS2), "{friction:?} {contacts:?} {out:?}");
        }
    }
}
