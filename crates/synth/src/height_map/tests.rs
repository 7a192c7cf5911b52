extern crate std;

use core::f64::consts::{FRAC_1_SQRT_2, TAU};
use std::vec;
use std::vec::Vec;

use crate::contact::Place;
use crate::relief::{HIGH_PASS_HZ, Passage};

use super::{HeightMap, HeightMapError, HeightMapVoice, LEAST_SIDE, PATCH_FORCES, length};

const RATE_HZ: f32 = 1000.0;
const TICK: usize = 5;
const SIDE_M: f64 = 0.04;

/// A cosine with whole numbers of periods along x and y, and an amplitude in m.
type Wave = (i32, i32, f64);

/// Coefficients of a sum of waves in all octaves that can represent them, times a gain of each patch. In closed form:
/// the spline of degree five has the gain sinc⁶ along each axis.
fn coefficients(n: usize, waves: &[Wave], gains: [f64; 3]) -> Vec<f32> {
    let mut octaves = Vec::new();
    for gain in gains {
        let mut m = n;
        while m >= LEAST_SIDE {
            let spline = |k: i32| {
                let angle = 0.5 * TAU * f64::from(k) / m as f64;
                if k == 0 { 1.0 } else { (angle.sin() / angle).powi(6) }
            };
            let held = |(x, y, _): &Wave| 4.0 * f64::from(*x).hypot(f64::from(*y)) <= m as f64;
            let held: Vec<Wave> = waves.iter().filter(|wave| held(wave)).copied().collect();
            let value = |i: usize| {
                let wave = |(x, y, height_m): &Wave| {
                    let turn = (f64::from(*x) * (i % m) as f64 + f64::from(*y) * (i / m) as f64) / m as f64;
                    height_m * (TAU * turn).cos() / (spline(*x) * spline(*y))
                };
                gain * held.iter().map(wave).sum::<f64>()
            };
            octaves.extend((0..m * m).map(|i| value(i) as f32));
            m /= 2;
        }
    }
    octaves
}

fn map(n: usize, speed_exponent: f32, octaves: &[f32]) -> HeightMap<'_> {
    HeightMap::new(SIDE_M, 1.0, speed_exponent, n, octaves).unwrap()
}

/// Output for a tip at these positions, one a tick, with these normal forces.
fn played(map: &HeightMap<'_>, touches: impl IntoIterator<Item = ([f64; 2], f32)>) -> Vec<f32> {
    let mut voice = HeightMapVoice::new(RATE_HZ);
    let mut passage = Passage::default();
    let mut out = Vec::new();
    for ([x_m, y_m], force_n) in touches {
        passage = passage.on(Place { x_m, y_m, n_jumps: 0 }, force_n);
        let mut tick = [0.0; TICK];
        voice.add_tick(map, &passage, (1.0, 1.0), &mut tick);
        out.extend(tick);
    }
    out
}

/// Positions of a tip at a constant speed in a direction, one a tick, with 1 N.
fn at_speed(mps: f64, angle_rad: f64, n_ticks: usize) -> impl Iterator<Item = ([f64; 2], f32)> {
    let (sin, cos) = angle_rad.sin_cos();
    (0..n_ticks).map(move |i| {
        let way_m = mps * (i * TICK) as f64 / f64::from(RATE_HZ);
        ([0.013 + way_m * cos, way_m * sin - 0.007], 1.0)
    })
}

fn rms(samples: &[f32]) -> f64 {
    (samples.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>() / samples.len() as f64).sqrt()
}

/// Gain of the high-pass at a frequency in Hz.
fn high_pass(hz: f64) -> f64 {
    let tangent = (0.5 * TAU * hz / f64::from(RATE_HZ)).tan();
    tangent / tangent.hypot(0.5 * TAU * f64::from(HIGH_PASS_HZ / RATE_HZ))
}

/// Amplitude of a tip that follows a wave of this height at this frequency.
fn followed(hz: f64, height_m: f64) -> f64 {
    (TAU * hz).powi(2) * height_m * high_pass(hz)
}

/// Ridges of 5 mm at 50, 100 and 150 mm/s give 10, 20 and 30 Hz across them, and nothing along them.
#[test]
fn ridges_sound_at_the_speed_over_their_distance_and_only_across() {
    let octaves = coefficients(64, &[(8, 0, 5e-5)], [1.0; 3]);
    let ridges = map(64, 2.0, &octaves);
    for (mps, hz) in [(0.05, 10.0), (0.1, 20.0), (0.15, 30.0)] {
        let across = played(&ridges, at_speed(mps, 0.0, 600));
        // The last 2 s contain whole periods.
        let late = &across[1000..];
        let amplitude = |hz: f64| {
            let part = |f: fn(f64) -> f64| -> f64 {
                let turn = |i: usize| TAU * hz * i as f64 / f64::from(RATE_HZ);
                late.iter().enumerate().map(|(i, x)| f(turn(i)) * f64::from(*x)).sum()
            };
            2.0 * part(f64::sin).hypot(part(f64::cos)) / late.len() as f64
        };
        assert!((amplitude(hz) / followed(hz, 5e-5) - 1.0).abs() < 0.01, "{} at {hz} Hz", amplitude(hz));
        // No other component: 10 dB is a tenth of the power, and there is a thousandth at most.
        let rest = rms(late).powi(2) - 0.5 * amplitude(hz).powi(2);
        assert!(rest < 1e-3 * rms(late).powi(2), "residual power {rest} at {hz} Hz");
        let along = played(&ridges, at_speed(mps, 0.25 * TAU, 600));
        // Rounding of heights of 50 µm to `f32`.
        assert!(rms(&along) < 2e-3 * rms(late), "{} along the ridges at {mps} m/s", rms(&along));
    }
}

/// In every direction, a wave has the frequency v k·u and the acceleration of its second derivative.
#[test]
fn a_wave_is_followed_in_any_direction() {
    for (x, y) in [(6, 0), (4, -5), (0, 7)] {
        let octaves = coefficients(32, &[(x, y, 2e-5)], [1.0; 3]);
        let wave = map(32, 2.0, &octaves);
        for i in 0..16 {
            let angle = TAU * f64::from(i) / 16.0 + 0.1;
            let hz = 0.25 / SIDE_M * (f64::from(x) * angle.cos() + f64::from(y) * angle.sin()).abs();
            if hz < 12.0 {
                continue;
            }
            let expected = FRAC_1_SQRT_2 * followed(hz, 2e-5);
            let got = rms(&played(&wave, at_speed(0.25, angle, 1000))[1000..]);
            // The 4 s do not contain whole periods: up to 1 in 4π periods of 12 Hz or more.
            let error = (got / expected - 1.0).abs();
            assert!(error < 0.01, "{got} is not {expected} at {angle} rad, ({x}, {y})");
        }
    }
}

/// The curvature of a wave is -k² times its height, and the mean over directions is half of that along the wave.
#[test]
fn the_mean_acceleration_is_that_of_both_second_derivatives() {
    let octaves = coefficients(32, &[(3, -5, 1e-5)], [2.0, 1.0, 0.5]);
    let wave = map(32, 2.0, &octaves);
    let highest = 0.5 * 0.01 * 34.0 * (TAU / SIDE_M).powi(2) * 1e-5;
    for (x_m, y_m) in [(0.0, 0.0), (0.013, 0.007), (-0.101, 0.33)] {
        let expected = -highest * (TAU * (3.0 * x_m - 5.0 * y_m) / SIDE_M).cos();
        let got = f64::from(wave.mean_acceleration_mps2([x_m, y_m], 0.0));
        // A wave of 5.5 samples: the error is below 1 % of its largest value.
        assert!((got - expected).abs() < 0.01 * highest, "{got} is not {expected}");
    }
    assert_eq!(wave.mean_acceleration_mps2([f64::NAN, 0.0], 0.0), wave.mean_acceleration_mps2([0.0; 2], 0.0));
    // A displacement of half a wave and more averages it out.
    assert_eq!(wave.mean_acceleration_mps2([0.013, 0.007], SIDE_M), 0.0);
}

/// The tile repeats without a seam: a stroke over any other copy of the tile is the same.
#[test]
fn a_tile_repeats_without_a_seam() {
    let octaves = coefficients(32, &[(3, 1, 1e-5), (-2, 4, 2e-5), (6, 5, 1e-5)], [1.0; 3]);
    let tile = map(32, 2.0, &octaves);
    let here = played(&tile, at_speed(0.2, 0.7, 400));
    let moved = |(columns, rows): (f64, f64)| {
        let touches = at_speed(0.2, 0.7, 400);
        played(&tile, touches.map(|([x, y], n)| ([x + columns * SIDE_M, y + rows * SIDE_M], n)))
    };
    for copy in [(1.0, 0.0), (0.0, -3.0), (25.0, 40.0)] {
        for (a, b) in here.iter().zip(&moved(copy)) {
            assert!((a - b).abs() < 1e-4, "{a} is not {b} at {copy:?}");
        }
    }
    // Over a seam, no step is larger than the fastest wave allows: 2π times 39 Hz for 8 waves at 0.2 m/s.
    let steepest = here.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max);
    let strongest = here.iter().fold(0.0_f32, |most, x| most.max(x.abs()));
    assert!(steepest < 0.3 * strongest && rms(&here) > 0.2 * f64::from(strongest));
}

/// A tip so fast that a wave would exceed half the sample rate does not play it, in any direction.
#[test]
fn what_is_too_fast_for_the_rate_is_left_out() {
    let octaves = coefficients(256, &[(60, 0, 1e-6), (42, 42, 1e-6)], [1.0; 3]);
    let fine = map(256, 2.0, &octaves);
    for (angle, waves) in [(0.0, 60.0), (0.125 * TAU, 59.4)] {
        let heard = |hz: f64| rms(&played(&fine, at_speed(hz * SIDE_M / waves, angle, 400))[500..]);
        for hz in [800.0, 1900.0, 3000.0] {
            assert!(heard(hz) < 1e-3, "{hz} Hz folds back: {}", heard(hz));
        }
        // At 380 Hz the wave is played; the other wave has a lower frequency in this direction.
        assert!(heard(380.0) > 0.9 * FRAC_1_SQRT_2 * followed(380.0, 1e-6), "{}", heard(380.0));
    }
    // The longest wave, of a tile of 2 mm, at frequencies above half the sample rate.
    let once = coefficients(16, &[(1, 0, 1e-6)], [1.0; 3]);
    let small = HeightMap::new(2e-3, 1.0, 2.0, 16, &once).unwrap();
    for mps in [1.2, 1.9, 2.9] {
        assert_eq!(rms(&played(&small, at_speed(mps, 0.0, 200))), 0.0, "{mps} m/s");
    }
    assert!(rms(&played(&small, at_speed(0.7, 0.0, 200))) > 0.5 * followed(350.0, 1e-6));
}

#[test]
fn the_level_follows_the_power_of_speed() {
    let octaves = coefficients(64, &[(12, 0, 2e-5)], [1.0; 3]);
    for exponent in [0.0, 0.5, 1.0, 1.7, 2.0] {
        let map = map(64, exponent, &octaves);
        for mps in [0.05, 0.1, 0.3] {
            let hz = 12.0 * mps / SIDE_M;
            let at_reference = (TAU * 12.0 * 0.1 / SIDE_M).powi(2) * 2e-5 * high_pass(hz);
            let expected = FRAC_1_SQRT_2 * at_reference * (mps / 0.1).powf(f64::from(exponent));
            let got = rms(&played(&map, at_speed(mps, 0.0, 1000))[1000..]);
            assert!((got / expected - 1.0).abs() < 0.01, "{got} is not {expected}: {exponent}, {mps} m/s");
        }
    }
}

/// The contact patch grows with force, and so does the level by the cube root, up to four times the reference force.
#[test]
fn force_scales_the_patch_and_the_level() {
    let octaves = coefficients(32, &[(8, 0, 2e-5)], [1.0, 0.5, 0.25]);
    let map = map(32, 2.0, &octaves);
    let at = |force_n: f32| {
        let touches = at_speed(0.1, 0.0, 400).map(|(place, _)| (place, force_n));
        rms(&played(&map, touches)[1000..])
    };
    // At 2 N the squared radius is 1.587 times that at 1 N, at 4 N 2.520 times: a share of 0.3865.
    let between = 0.5 - 0.3865 * 0.25;
    let expected = [(0.1, 1.0), (0.25, 1.0), (1.0, 0.5), (2.0, between), (4.0, 0.25), (1e9, 0.25)];
    for (force_n, gain) in expected {
        let wanted = FRAC_1_SQRT_2 * followed(20.0, 2e-5) * gain * f64::from(force_n).min(4.0).cbrt();
        let got = at(force_n);
        assert!((got / wanted - 1.0).abs() < 0.01, "{got} is not {wanted} at {force_n} N");
    }
    // Weights multiply the signal and are added to what is there.
    let mut voice = HeightMapVoice::new(RATE_HZ);
    let mut passage = Passage::default();
    let once = played(&map, at_speed(0.1, 0.3, 100));
    for (i, ([x_m, y_m], force_n)) in at_speed(0.1, 0.3, 100).enumerate() {
        passage = passage.on(Place { x_m, y_m, n_jumps: 0 }, force_n);
        let mut tick = [1.0; TICK];
        voice.add_tick(&map, &passage, (0.5, 0.5), &mut tick);
        for (x, once) in tick.iter().zip(&once[i * TICK..]) {
            assert!((x - 1.0 - 0.5 * once).abs() < 1e-6);
        }
    }
}

/// Landing, turning at corners, resting, lifting and jumping: no step is larger than the waves themselves give.
#[test]
fn nothing_clicks() {
    let octaves = coefficients(64, &[(8, 3, 1e-4), (-5, 9, 1e-4)], [1.0; 3]);
    let map = map(64, 2.0, &octaves);
    // A square of 20 mm at 80 mm/s: at every corner the direction turns by 90° within a tick.
    let corner = |i: usize| {
        let (side, done) = (i / 50 % 4, (i % 50) as f64 / 50.0);
        let [x, y] = [[done, 0.0], [1.0, done], [1.0 - done, 1.0], [0.0, 1.0 - done]][side];
        ([0.02 * x, 0.02 * y], 1.0)
    };
    let moving = (0..400).map(corner);
    let resting = (0..200).map(|_| corner(399));
    let lifting = (0..20).map(|i| (corner(399 + i).0, 0.0));
    let landing = (0..20).map(|_| ([0.4, 0.3], 1.0));
    let jumping = (0..40).map(|i| ([0.9 + 4e-4 * f64::from(i), 0.3], 1.0));
    let jumped = (0..40).map(|_| ([0.5, 0.8], 1.0));
    let touches = moving.chain(resting).chain(lifting).chain(landing).chain(jumping).chain(jumped);
    let out = played(&map, touches);
    let strongest = out.iter().fold(0.0_f32, |most, x| most.max(x.abs()));
    // 80 mm/s over 10.3 waves on 40 mm is 21 Hz, so that a step is 0.13 of the amplitude; a tick of 5 samples turns,
    // starts or ends the whole signal.
    let steepest = out.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max);
    assert!(steepest < 0.35 * strongest, "a step of {steepest} of {strongest}");
    assert!(rms(&out[500..2000]) > 0.2 * f64::from(strongest));
    assert_eq!(rms(&out[2010..3000]), 0.0, "a tip at rest gives output");
    assert_eq!(rms(&out[3005..3200]), 0.0, "a lifted tip, or one that lands and rests, gives output");
    assert!(rms(&out[3210..3395]) > 0.05 * f64::from(strongest), "a tip that moves again gives none");
    assert_eq!(rms(&out[3410..]), 0.0, "a tip at rest after a jump gives output");
}

#[test]
fn nonsense_stays_finite() {
    let octaves = coefficients(16, &[(2, 1, 1e-5)], [1.0; 3]);
    let map = map(16, 0.0, &octaves);
    let numbers = [0.0, f64::NAN, 1e300, -1e300, f64::INFINITY, 0.01, 1e9, 1e9 + 0.01];
    let out = played(&map, numbers.map(|x| ([x, 0.5 * x], 1.0)));
    assert!(out.iter().all(|x| x.is_finite() && x.abs() < 10.0));
    let mut voice = HeightMapVoice::new(RATE_HZ);
    for a in numbers {
        for b in numbers {
            for force_n in [1.0, f32::NAN, f32::INFINITY, -1.0] {
                let mut passage = Passage::default().on(Place::default(), 1.0);
                (passage.x_m, passage.y_m, passage.forces_n) = ((a, b), (b, a), (1.0, force_n));
                let mut tick = [0.0; 64];
                voice.add_tick(&map, &passage, (1.0, 1.0), &mut tick);
                assert!(tick.iter().all(|x| x.is_finite() && x.abs() < 1e3), "{passage:?}");
                voice.add_tick(&map, &passage, (1.0, 1.0), &mut []);
            }
        }
    }
}

#[test]
fn slices_that_do_not_fit_are_refused() {
    let octaves = coefficients(16, &[(1, 0, 1e-5)], [1.0; 3]);
    assert_eq!(octaves.len(), PATCH_FORCES.len() * length(16));
    let error = |side_m, force_n, exponent, n, octaves: &[f32]| {
        HeightMap::new(side_m, force_n, exponent, n, octaves).unwrap_err()
    };
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(error(f64::from(bad), 1.0, 2.0, 16, &octaves), HeightMapError::Range);
        assert_eq!(error(0.04, bad, 2.0, 16, &octaves), HeightMapError::Range);
    }
    for bad in [-0.1, 2.1, f32::NAN] {
        assert_eq!(error(0.04, 1.0, bad, 16, &octaves), HeightMapError::Range);
    }
    for n in [0, 2, 8, 15, 32, 2048, usize::MAX] {
        assert_eq!(error(0.04, 1.0, 2.0, n, &octaves), HeightMapError::Length);
    }
    let mut bad = vec![0.0; 3 * length(4)];
    bad[40] = f32::NAN;
    assert_eq!(error(0.04, 1.0, 2.0, 4, &bad), HeightMapError::Number);
    // Unchecked data give silence at worst.
    let empty = HeightMap::checked_before(0.04, 1.0, 2.0, 1000, &[]);
    assert_eq!(rms(&played(&empty, at_speed(0.1, 0.0, 20))), 0.0);
}
