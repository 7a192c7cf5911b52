extern crate std;

use core::f32::consts::{FRAC_PI_2, PI};
use core::f64::consts::{PI as WIDE_PI, TAU};
use std::vec::Vec;

use proptest::prelude::{prop_assert, proptest};

use super::{Direction, DirectionMean};
use crate::contact::Place;
use crate::noise::{Gaussian, Noise};
use crate::relief::Passage;

const TICK_SECS: f64 = 0.005;

/// Directions of a pressed tip at these positions, one a tick.
fn followed(places_m: impl IntoIterator<Item = [f64; 2]>) -> Vec<Direction> {
    let (mut mean, mut passage) = (DirectionMean::default(), Passage::default());
    let next = |[x_m, y_m]: [f64; 2]| {
        passage = passage.on(Place { x_m, y_m, n_jumps: 0 }, 1.0);
        mean.follow(&passage, TICK_SECS as f32)
    };
    places_m.into_iter().map(next).collect()
}

/// Axis of a direction in rad, -π/2 to π/2.
fn axis_rad(direction: Direction) -> f64 {
    let (cos, sin) = direction.double.unwrap();
    0.5 * f64::from(sin).atan2(f64::from(cos))
}

/// Angle from one axis to another in rad, -π/2 to π/2.
fn between_rad(from: f64, to: f64) -> f64 {
    let turns = (to - from) / WIDE_PI;
    WIDE_PI * (turns - turns.round())
}

fn straight(mps: f64, angle_rad: f64, n_ticks: u32) -> impl Iterator<Item = [f64; 2]> {
    let (sin, cos) = angle_rad.sin_cos();
    (0..n_ticks).map(move |i| {
        let way_m = mps * TICK_SECS * f64::from(i);
        [way_m * cos, way_m * sin]
    })
}

#[test]
fn shares_are_the_squared_sine() {
    for (angle, turn, share) in [
        (0.0, 0.0, 0.0),
        (FRAC_PI_2, 0.0, 1.0),
        (FRAC_PI_2 / 2.0, 0.0, 0.5),
        (PI, 0.0, 0.0),
        (0.3, 0.3, 0.0),
        (0.3, 0.3 - FRAC_PI_2, 1.0),
        (0.0, PI / 6.0, 0.25),
    ] {
        let got = Direction::at_angle(angle).share_along(turn);
        assert!((got - share).abs() < 1e-6, "{got} for {share}");
    }
    assert_eq!(Direction::UNKNOWN.share_along(1.0), 0.0);
    assert_eq!(Direction::at_angle(f32::NAN), Direction::UNKNOWN);
}

/// A stroke along x is exactly across the lay, so that a stroke without positions feels no grain along it.
#[test]
fn a_stroke_along_an_axis_is_exactly_that_axis() {
    let shares = |angle| followed(straight(0.1, angle, 50)).into_iter().skip(1).map(|d| d.share_along(0.0));
    assert!(shares(0.0).all(|share| share == 0.0));
    assert!(shares(TAU / 4.0).all(|share| share == 1.0));
    assert!(shares(TAU / 8.0).all(|share| (share - 0.5).abs() < 1e-6));
}

/// The first displacement gives the direction at once, at any speed; before it there is none.
#[test]
fn the_first_displacement_decides() {
    for mps in [0.003, 0.02, 0.5] {
        let directions = followed(straight(mps, 1.2, 100));
        assert_eq!(directions[0], Direction::UNKNOWN);
        let known: Vec<Direction> = directions.into_iter().filter(|d| d.double.is_some()).collect();
        assert!(known.len() > 10);
        for direction in known {
            assert!(between_rad(1.2, axis_rad(direction)).abs() < 1e-4);
        }
    }
}

/// A full turn in 2 s: the lag is at most atan(π/10) / 2 and half a displacement, 9.7° in all, and a tick changes a share
/// by less than 0.04.
#[test]
fn a_turning_stroke_is_followed_without_a_jump() {
    for mps in [0.01, 0.02, 0.1, 0.3] {
        let radius_m = mps / WIDE_PI;
        let at = |i: u32| {
            let (sin, cos) = (WIDE_PI * TICK_SECS * f64::from(i)).sin_cos();
            [radius_m * cos, radius_m * sin]
        };
        let directions = followed((0..800).map(at));
        for (i, pair) in directions.windows(2).enumerate().skip(100) {
            let tangent = WIDE_PI * (TICK_SECS * (i + 1) as f64 + 0.5);
            let lag = between_rad(axis_rad(pair[1]), tangent).to_degrees();
            assert!((0.0..9.8).contains(&lag), "{lag}° at {mps} m/s");
            let change = (pair[1].share_along(0.4) - pair[0].share_along(0.4)).abs();
            assert!(change < 0.04, "a tick changes the share by {change} at {mps} m/s");
        }
        let shares = || directions[100..].iter().map(|d| d.share_along(0.4));
        let (lowest, highest) = (shares().fold(1.0, f32::min), shares().fold(0.0, f32::max));
        assert!(lowest < 0.001 && highest > 0.999, "{lowest} to {highest}");
    }
}

#[test]
fn a_reversed_stroke_keeps_its_axis() {
    let there: Vec<[f64; 2]> = straight(0.08, 0.7, 100).collect();
    let back = there.iter().rev().copied();
    for direction in followed(there.iter().copied().chain(back)).into_iter().skip(1) {
        assert!(between_rad(0.7, axis_rad(direction)).abs() < 1e-4);
    }
}

/// Position noise of 0.02 mm on a stroke at 20 mm/s turns the axis by 1.3° (root mean square) and 6° at most in 60 s.
#[test]
fn noise_hardly_turns_it() {
    let (gaussian, mut noise) = (Gaussian::new(), Noise::new(1));
    let mut draw = || 2e-5 * f64::from(gaussian.draw(&mut noise));
    let noisy: Vec<[f64; 2]> = straight(0.02, 0.0, 12_000).map(|[x, y]| [x + draw(), y + draw()]).collect();
    let angles: Vec<f64> = followed(noisy).into_iter().skip(50).map(|d| axis_rad(d).to_degrees()).collect();
    let rms = (angles.iter().map(|a| a * a).sum::<f64>() / angles.len() as f64).sqrt();
    let most = angles.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
    assert!(rms < 2.0 && most < 9.0, "{rms}° and at most {most}°");
}

/// At rest, with the 10 µm of noise that are left after the positions of a pen are smoothed, nothing changes.
#[test]
fn a_tip_at_rest_keeps_its_direction() {
    let (gaussian, mut noise) = (Gaussian::new(), Noise::new(2));
    let mut draw = || 1e-5 * f64::from(gaussian.draw(&mut noise));
    let end_m = 0.02 * TICK_SECS * 199.0;
    let resting: Vec<[f64; 2]> = (0..2000).map(|_| [end_m + draw(), draw()]).collect();
    let directions = followed(straight(0.02, 0.0, 200).chain(resting));
    let turned = directions[200..].iter().map(|d| axis_rad(*d).abs()).fold(0.0, f64::max);
    // One displacement may end in the noise.
    assert!(turned.to_degrees() < 2.0, "{turned}");
}

#[test]
fn a_landing_and_a_jump_begin_anew() {
    let (mut mean, mut passage) = (DirectionMean::default(), Passage::default());
    let mut at = |x_m: f64, y_m: f64, n_jumps: u32, force_n: f32| {
        passage = passage.on(Place { x_m, y_m, n_jumps }, force_n);
        mean.follow(&passage, TICK_SECS as f32)
    };
    for i in 0..100 {
        at(5e-4 * f64::from(i), 0.0, 0, 1.0);
    }
    // In the air it stays, however the tip moves.
    for i in 0..20 {
        assert_eq!(at(0.05, 1e-3 * f64::from(i), 0, 0.0).share_along(0.0), 0.0, "tick {i} in the air");
    }
    assert_eq!(at(0.01, 0.01, 0, 1.0).share_along(0.0), 0.0);
    assert_eq!(at(0.01, 0.011, 0, 1.0).share_along(0.0), 1.0);
    // A jump up is not a stroke up.
    assert_eq!(at(0.01, 0.012, 1, 1.0).share_along(0.0), 1.0);
    assert_eq!(at(0.011, 0.012, 1, 1.0).share_along(0.0), 0.0);
}

proptest! {
    /// Whatever the positions are, a share lies between 0 and 1, and a texture at a right angle has the rest.
    #[test]
    fn shares_stay_in_range(
        steps in proptest::collection::vec((-0.02_f64..0.02, -0.02_f64..0.02), 1..60),
        turn in -4.0_f32..4.0,
    ) {
        let mut at = [0.0, 0.0];
        let places: Vec<[f64; 2]> = steps
            .into_iter()
            .map(|(x, y)| { at = [at[0] + x, at[1] + y]; at })
            .collect();
        for direction in followed(places) {
            let share = direction.share_along(turn);
            prop_assert!((0.0..=1.0).contains(&share), "{share}");
            if direction != Direction::UNKNOWN {
                let rest = 1.0 - direction.share_along(turn + FRAC_PI_2);
                prop_assert!((share - rest).abs() < 1e-5, "{share} and {rest}");
            }
        }
    }
}
