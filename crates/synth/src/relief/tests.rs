extern crate std;

use core::f64::consts::TAU;
use std::vec;
use std::vec::Vec;

use crate::contact::Place;

use super::{HIGH_PASS_HZ, LEAST_SAMPLES, Passage, Relief, ReliefError, ReliefVoice, length};

const RATE_HZ: f32 = 1000.0;
const TICK: usize = 5;
const N: usize = 1024;
const STEP_M: f32 = 1e-5;

/// A sine with the given number of periods over the whole relief, in all octaves that can represent it.
fn wave(periods: usize) -> Vec<f32> {
    let mut octaves = Vec::new();
    let mut n = N;
    while n >= LEAST_SAMPLES {
        let holds = 4 * periods <= n;
        let value = |i: usize| (TAU * (periods * i) as f64 / n as f64).sin() as f32;
        octaves.extend((0..n).map(|i| if holds { value(i) } else { 0.0 }));
        n /= 2;
    }
    octaves
}

fn relief(octaves: &[f32]) -> Relief<'_> {
    Relief::new(STEP_M, 1.0, N, octaves).unwrap()
}

/// Output for a tip at these positions, one a tick, with these normal forces.
fn played(relief: &Relief<'_>, touches: impl IntoIterator<Item = (f64, f32)>) -> Vec<f32> {
    let mut voice = ReliefVoice::new(RATE_HZ);
    let mut passage = Passage::default();
    let mut out = Vec::new();
    for (place_m, force_n) in touches {
        passage = passage.on(Place { x_m: place_m, ..Place::default() }, force_n);
        let mut tick = [0.0; TICK];
        voice.add_tick(relief, &passage, (1.0, 1.0), &mut tick);
        out.extend(tick);
    }
    out
}

/// Positions of a tip at a constant speed, one a tick.
fn at_speed(mps: f64, n_ticks: usize) -> impl Iterator<Item = (f64, f32)> {
    (0..n_ticks).map(move |i| (mps * i as f64 * TICK as f64 / f64::from(RATE_HZ), 1.0))
}

fn rms(samples: &[f32]) -> f64 {
    (samples.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>() / samples.len() as f64).sqrt()
}

/// Gain of the high-pass at a frequency in Hz.
fn high_pass(hz: f64) -> f64 {
    let tangent = (0.5 * TAU * hz / f64::from(RATE_HZ)).tan();
    tangent / tangent.hypot(0.5 * TAU * f64::from(HIGH_PASS_HZ / RATE_HZ))
}

/// A tip at speed v on a wave of length λ gives the frequency v/λ, in both directions.
#[test]
fn a_wave_sounds_at_the_speed_over_its_length() {
    let octaves = wave(16);
    let length_m = f64::from(STEP_M) * N as f64 / 16.0;
    for hz in [20.0, 80.0, 240.0] {
        for direction in [1.0, -1.0] {
            let out = played(&relief(&octaves), at_speed(direction * hz * length_m, 2000));
            let late = &out[2000..];
            let turn = |i: usize| TAU * hz * i as f64 / f64::from(RATE_HZ);
            let part = |f: fn(f64) -> f64| -> f64 {
                late.iter().enumerate().map(|(i, x)| f(turn(i)) * f64::from(*x)).sum()
            };
            let size = 2.0 * part(f64::sin).hypot(part(f64::cos)) / late.len() as f64;
            assert!((size / high_pass(hz) - 1.0).abs() < 0.01, "{hz} Hz has {size}");
            // No other component is present.
            let rest = rms(late).powi(2) - 0.5 * size * size;
            assert!(rest < 1e-4, "residual power {rest} at {hz} Hz");
        }
    }
}

#[test]
fn what_is_too_fast_for_the_rate_is_left_out() {
    let octaves = wave(200);
    let length_m = f64::from(STEP_M) * N as f64 / 200.0;
    for hz in [600.0, 700.0, 1900.0, 9000.0] {
        let out = played(&relief(&octaves), at_speed(hz * length_m, 400));
        assert!(rms(&out[500..]) < 1e-6, "{hz} Hz folds back: {}", rms(&out[500..]));
    }
    // The longest wave of the relief, at frequencies above half the sample rate.
    let once = wave(1);
    let length_m = f64::from(STEP_M) * N as f64;
    for hz in [600.0, 900.0] {
        let places = at_speed(hz * length_m, 400).map(|(place, force)| (place % (0.9 * length_m), force));
        let mut voice = ReliefVoice::new(RATE_HZ);
        let mut out = Vec::new();
        for ((place, force), n_jumps) in places.zip(0..) {
            // Every tick is a jump, so only the displacement within the tick counts.
            let begun = Passage::default().on(Place { x_m: place, y_m: 0.0, n_jumps }, force);
            let end = place + hz * length_m * TICK as f64 / f64::from(RATE_HZ);
            let passage = Passage { x_m: (place, end), ..begun };
            let mut tick = [0.0; TICK];
            voice.add_tick(&relief(&once), &passage, (1.0, 1.0), &mut tick);
            out.extend(tick);
        }
        assert!(rms(&out) < 1e-6, "{hz} Hz folds back: {}", rms(&out));
    }
    let octaves = wave(200);
    let length_m = length_m / 200.0;
    let out = played(&relief(&octaves), at_speed(380.0 * length_m, 400));
    assert!(rms(&out[500..]) > 0.6, "{}", rms(&out[500..]));
}

/// Contact onset, turning, resting, lifting and jumping: no step is larger than the steepest step of the wave itself.
#[test]
fn nothing_clicks() {
    let octaves = wave(16);
    let relief = relief(&octaves);
    let swung = |i: i32| 4e-4 * (0.05 * f64::from(i)).sin();
    let turning = (0..400).map(|i| (swung(i), 1.0));
    let standing = (0..200).map(|_| (swung(399), 1.0));
    let pressing = (0..20).map(|i| (swung(399), 1.0 - 0.05 * i as f32));
    let in_the_air = (0..20).map(|i| (swung(399) + 1e-5 * f64::from(i), 0.0));
    let elsewhere = (0..40).map(|_| (0.4, 1.0)).chain((0..40).map(|_| (0.5001, 1.0)));
    let out = played(&relief, turning.chain(standing).chain(pressing).chain(in_the_air).chain(elsewhere));
    // The bound is 2π times the highest frequency: 20 µm per tick of 5 samples on waves of 640 µm.
    let steepest = out.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max);
    assert!(steepest < 0.06, "a step of {steepest}");
    assert!(rms(&out[1000..2000]) > 0.1);
    assert!(rms(&out[2500..3000]) < 1e-3, "a tip at rest gives {}", rms(&out[2500..3000]));
    assert!(out[3125..3200].iter().all(|x| *x == 0.0), "a lifted tip gives output");
    assert!(rms(&out[3210..]) == 0.0, "a tip that touches down and rests gives output");
}

/// A jump of position produces no signal, and neither does a tip that touches down after a fast stroke and rests.
#[test]
fn jumps_and_landings_are_silent() {
    let octaves = wave(100);
    let relief = relief(&octaves);
    let mut voice = ReliefVoice::new(RATE_HZ);
    let mut passage = Passage::default();
    let mut heard = |place: Place, force_n: f32| {
        passage = passage.on(place, force_n);
        let mut tick = [0.0; TICK];
        voice.add_tick(&relief, &passage, (1.0, 1.0), &mut tick);
        rms(&tick)
    };
    let mut x_m = 0.0;
    for _ in 0..100 {
        x_m += 0.01;
        heard(Place { x_m, ..Place::default() }, 1.0);
    }
    heard(Place { x_m, ..Place::default() }, 0.0);
    for _ in 0..20 {
        assert!(heard(Place { x_m: 0.003_1, ..Place::default() }, 1.0) < 1e-6);
    }
    for n_jumps in 1..20 {
        let x_m = 0.001_3 * f64::from(n_jumps);
        assert!(heard(Place { x_m, y_m: 0.0, n_jumps }, 1.0) < 1e-6, "a jump gives output");
    }
    assert!(
        heard(Place { x_m: 0.0258, y_m: 0.0, n_jumps: 19 }, 1.0) > 1e-3,
        "a displacement gives no output"
    );
}

#[test]
fn force_and_weight_scale_it() {
    let octaves = wave(16);
    let relief = relief(&octaves);
    let once = played(&relief, at_speed(0.05, 200));
    let pressed = played(&relief, at_speed(0.05, 200).map(|(place, _)| (place, 2.5)));
    let most = played(&relief, at_speed(0.05, 200).map(|(place, _)| (place, 1e9)));
    for i in 100..1000 {
        assert!((pressed[i] - 2.5 * once[i]).abs() < 1e-5);
        assert!((most[i] - 4.0 * once[i]).abs() < 1e-5);
    }
    let mut voice = ReliefVoice::new(RATE_HZ);
    let mut passage = Passage::default();
    for (i, (place, force)) in at_speed(0.05, 200).enumerate() {
        passage = passage.on(Place { x_m: place, ..Place::default() }, force);
        let mut tick = [1.0; TICK];
        voice.add_tick(&relief, &passage, (0.5, 0.5), &mut tick);
        for (x, once) in tick.iter().zip(&once[i * TICK..]) {
            assert!((x - 1.0 - 0.5 * once).abs() < 1e-6);
        }
    }
}

#[test]
fn nonsense_stays_finite() {
    let octaves = wave(16);
    let places = [0.0, f64::NAN, 1e300, -1e300, f64::INFINITY, 0.01, 1e9, 1e9 + 0.01];
    let out = played(&relief(&octaves), places.map(|place| (place, 1.0)));
    assert!(out.iter().all(|x| x.is_finite() && x.abs() < 10.0));
}

#[test]
fn slices_that_do_not_fit_are_refused() {
    let octaves = wave(1);
    let error = |step, force, n, octaves: &[f32]| Relief::new(step, force, n, octaves).unwrap_err();
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(error(bad, 1.0, N, &octaves), ReliefError::Range);
        assert_eq!(error(STEP_M, bad, N, &octaves), ReliefError::Range);
    }
    for n in [0, 2, 1000, 2048] {
        assert_eq!(error(STEP_M, 1.0, n, &octaves), ReliefError::Length);
    }
    let mut bad = vec![0.0; length(8)];
    bad[3] = f32::NAN;
    assert_eq!(error(STEP_M, 1.0, 8, &bad), ReliefError::Number);
    // Unchecked data give silence at worst.
    let relief = Relief::checked_before(STEP_M, 1.0, 1000, &[]);
    assert!(played(&relief, at_speed(0.1, 10)).iter().all(|x| *x == 0.0));
}

#[test]
fn far_is_measured_in_the_plane() {
    let is_elsewhere = |x_m: f64, y_m: f64| {
        let begun = Passage::default().on(Place { x_m: 0.1, y_m: 0.2, n_jumps: 0 }, 1.0);
        begun.on(Place { x_m: 0.1 + x_m, y_m: 0.2 + y_m, n_jumps: 0 }, 1.0).is_elsewhere
    };
    assert!(!is_elsewhere(0.010, 0.010) && !is_elsewhere(0.0, -0.014));
    assert!(is_elsewhere(0.012, 0.012) && is_elsewhere(0.0, 0.016) && is_elsewhere(-0.016, 0.0));
    // A coordinate that is not finite stays.
    let begun = Passage::default().on(Place { x_m: 0.1, y_m: 0.2, n_jumps: 0 }, 1.0);
    let lost = begun.on(Place { x_m: 0.101, y_m: f64::NAN, n_jumps: 0 }, 1.0);
    assert_eq!((lost.x_m, lost.y_m), ((0.1, 0.101), (0.2, 0.2)));
}

/// A wave at an angle on the pad: a stroke along that angle sounds as one along x does without a rotation, and a stroke at
/// a right angle to it is silent.
#[test]
fn a_turned_relief_is_played_across_its_waves() {
    let octaves = wave(16);
    let relief = relief(&octaves);
    let straight = played(&relief, at_speed(0.05, 400));
    let (sin, cos) = 0.6_f64.sin_cos();
    let stroked = |direction: [f64; 2]| {
        let (mut voice, mut passage, mut out) = (ReliefVoice::new(RATE_HZ), Passage::default(), Vec::new());
        for (way_m, force_n) in at_speed(0.05, 400) {
            let place = Place { x_m: way_m * direction[0], y_m: way_m * direction[1], n_jumps: 0 };
            passage = passage.on(place, force_n);
            let mut tick = [0.0; TICK];
            let turned = passage.turned((cos as f32, sin as f32));
            voice.add_tick(&relief, &turned, (1.0, 1.0), &mut tick);
            out.extend(tick);
        }
        out
    };
    // A rotation in `f32` displaces the end of the stroke of 0.1 m by 1e-8 m of 640 µm.
    for (turned, straight) in stroked([cos, sin]).iter().zip(&straight) {
        assert!((turned - straight).abs() < 1e-3, "{turned} for {straight}");
    }
    assert!(rms(&stroked([-sin, cos])) < 1e-3);
}
