use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};
use rustfft::num_complex::Complex;
use shagreen_synth::contact::Place;
use shagreen_synth::height_map::{HeightMap as SynthHeightMap, HeightMapVoice};
use shagreen_synth::relief::{HIGH_PASS_HZ, Passage};

use super::{HeightMap, HeightMapError, HeightMapOptions, MAX_HEIGHT_M};
use crate::dsp::contact_patch::patch_gain;
use crate::dsp::spectrum::rms;
use crate::dsp::square_transform::{index_of, series};
use crate::maths::rng::Random;
use crate::units::{Hertz, Newtons};

pub(super) const SIDE_M: f64 = 0.04;
pub(super) const RATE: Hertz = Hertz(1000.0);
const TICK: usize = 5;
pub(super) const SHARP: HeightMapOptions =
    HeightMapOptions { patch_radius_m: 0.0, ..HeightMapOptions::HARD_PLASTIC };

pub(super) fn map_of(n: usize, options: HeightMapOptions, height_m: impl Fn(f64, f64) -> f64) -> HeightMap {
    let step_m = SIDE_M / n as f64;
    let heights_m = (0..n * n).map(|i| height_m((i % n) as f64 * step_m, (i / n) as f64 * step_m)).collect();
    HeightMap::new(heights_m, SIDE_M, options).unwrap()
}

/// A cosine with this amplitude and these periods along x and y.
pub(super) fn wave(n: usize, options: HeightMapOptions, [x, y]: [f64; 2], height_m: f64) -> HeightMap {
    map_of(n, options, |x_m, y_m| height_m * (TAU * (x * x_m + y * y_m) / SIDE_M).cos())
}

/// Waves of random phase and equal amplitude with these fewest and most periods on a side, in all directions.
pub(super) fn random_map(n: usize, periods: [f64; 2], options: HeightMapOptions) -> HeightMap {
    let mut random = Random::new(7);
    let mut field = vec![Complex::new(0.0, 0.0); n * n];
    let most = periods[1] as isize;
    for (x, y) in (-most..=most).flat_map(|x| (-most..=most).map(move |y| (x, y))) {
        let phase = TAU * random.uniform();
        if (periods[0]..=periods[1]).contains(&(x as f64).hypot(y as f64)) {
            field[index_of(y, n) * n + index_of(x, n)] = Complex::from_polar(1e-6, phase);
        }
    }
    series(&mut field);
    HeightMap::new(field.iter().map(|value| value.re).collect(), SIDE_M, options).unwrap()
}

/// Positions at a constant speed in a direction, one a sample.
pub(super) fn line(mps: f64, angle_rad: f64, n: usize) -> Vec<[f64; 2]> {
    let at = |i: usize| mps * i as f64 / RATE.0;
    (0..n).map(|i| [0.003 + at(i) * angle_rad.cos(), 0.021 + at(i) * angle_rad.sin()]).collect()
}

/// What the renderer plays on a path. The first tick lands; sample i is at position i + 1 - TICK of the path.
pub(super) fn played(map: &HeightMap, path_m: &[[f64; 2]], force: Newtons) -> Vec<f64> {
    let levels = map.prepare();
    let mut voice = HeightMapVoice::new(RATE.0 as f32);
    let mut passage = Passage::default();
    let mut out = Vec::new();
    for [x_m, y_m] in path_m.iter().step_by(TICK) {
        passage = passage.on(Place { x_m: *x_m, y_m: *y_m, n_jumps: 0 }, force.0 as f32);
        let mut tick = [0.0; TICK];
        voice.add_tick(&levels.view(), &passage, (1.0, 1.0), &mut tick);
        out.extend(tick.map(f64::from));
    }
    out
}

/// First-order high-pass by the bilinear transform, as that of the renderer.
fn high_passed(signal: &[f64]) -> Vec<f64> {
    let corner = PI * f64::from(HIGH_PASS_HZ) / RATE.0;
    let mut output = 0.0;
    let mut before = signal[0];
    let next = |x: &f64| {
        output = ((1.0 - corner) * output + *x - before) / (1.0 + corner);
        before = *x;
        output
    };
    signal.iter().map(next).collect()
}

/// Rms difference between the renderer and the oracle after the first half second, relative to the oracle.
fn deviation(map: &HeightMap, path_m: &[[f64; 2]], force: Newtons) -> f64 {
    let expected = high_passed(&map.acceleration(path_m, force, RATE));
    let got = played(map, path_m, force);
    let late = 500..expected.len() - TICK;
    let expected = &expected[late.clone()];
    let got = &got[late.start + TICK - 1..late.end + TICK - 1];
    let difference: Vec<f64> = got.iter().zip(expected).map(|(a, b)| a - b).collect();
    rms(&difference) / rms(expected)
}

#[test]
fn the_oracle_is_the_closed_form_of_a_wave() {
    let options = HeightMapOptions { force: Newtons(2.0), speed_exponent: 1.3, patch_radius_m: 4e-4 };
    let map = wave(32, options, [5.0, -3.0], 2e-5);
    let (sin, cos) = 0.4_f64.sin_cos();
    let (k_per_m, along_per_m) = (TAU * 34.0_f64.sqrt() / SIDE_M, TAU * (5.0 * cos - 3.0 * sin) / SIDE_M);
    for force_n in [0.1, 1.0, 5.0, 100.0] {
        let relative: f64 = force_n / 2.0;
        let patch = patch_gain(k_per_m * 4e-4 * relative.clamp(0.25, 4.0).cbrt());
        let size = 0.01 * 2.5_f64.powf(1.3) * relative.min(4.0).cbrt() * patch * along_per_m.powi(2) * 2e-5;
        let path_m = line(0.25, 0.4, 300);
        for (got, [x_m, y_m]) in map.acceleration(&path_m, Newtons(force_n), RATE).iter().zip(&path_m) {
            let expected = -size * (TAU * (5.0 * x_m - 3.0 * y_m) / SIDE_M).cos();
            assert!((got - expected).abs() < 1e-9 * size, "{got} is not {expected} at {force_n} N");
        }
    }
    assert_eq!(map.acceleration(&[[0.1, 0.2]; 4], Newtons(1.0), RATE), [0.0; 4]);
    assert_eq!(map.acceleration(&[], Newtons(1.0), RATE), [0.0; 0]);
}

/// In any direction, the renderer is within 1 % of the oracle.
#[test]
fn the_renderer_follows_the_oracle_in_any_direction() {
    let options = HeightMapOptions { force: Newtons(1.0), speed_exponent: 1.6, patch_radius_m: 1.2e-3 };
    let map = random_map(32, [1.0, 12.0], options);
    for i in 0..8 {
        let path_m = line(0.15, TAU * f64::from(i) / 8.0 + 0.2, 1200);
        let off = deviation(&map, &path_m, Newtons(1.0));
        assert!(off < 0.01, "off by {off} in direction {i}");
    }
    // The stored patches are exact. Between them, the gain of waves that are three times as long as the patch is
    // interpolated within some percent.
    for (force_n, most) in [(0.05, 0.01), (0.25, 0.01), (4.0, 0.01), (9.0, 0.01), (2.0, 0.05), (0.5, 0.05)] {
        let off = deviation(&map, &line(0.15, 0.9, 1200), Newtons(force_n));
        assert!(off < most, "off by {off} at {force_n} N");
    }
    // A curved stroke of changing speed: direction and speed change linearly within a tick of the renderer, and one tick
    // late.
    let turn = |i: usize| TAU * i as f64 / 3000.0;
    let circle: Vec<[f64; 2]> = (0..2000).map(|i| [0.03 * turn(i).cos(), 0.02 * turn(i).sin()]).collect();
    let off = deviation(&map, &circle, Newtons(1.0));
    assert!(off < 0.03, "off by {off} on an ellipse");
}

/// Ridges of 5 mm: the spectrum of a stroke across them has its peak at the speed over 5 mm, a stroke along them none.
#[test]
fn ridges_are_felt_across_and_not_along() {
    let ridges = wave(128, HeightMapOptions::HARD_PLASTIC, [8.0, 0.0], 1e-4);
    // Eight waves fit an octave of 32 samples; the map has 128.
    assert_eq!(ridges.prepare().view().n(), 32);
    for (mps, hz) in [(0.05, 10.0), (0.1, 20.0), (0.15, 30.0)] {
        let across = &played(&ridges, &line(mps, 0.0, 3000), Newtons(1.0))[1000..];
        let along = &played(&ridges, &line(mps, 0.25 * TAU, 3000), Newtons(1.0))[1000..];
        let size = |signal: &[f64], hz: f64| {
            let turn = |i: usize| TAU * hz * i as f64 / RATE.0;
            let sum: Complex<f64> =
                signal.iter().enumerate().map(|(i, x)| Complex::from_polar(*x, turn(i))).sum();
            2.0 * sum.norm() / signal.len() as f64
        };
        // The high-pass attenuates 10 Hz by 3 dB.
        let expected = (TAU * hz).powi(2) * 1e-4 / 1.0_f64.hypot(f64::from(HIGH_PASS_HZ) / hz);
        assert!((size(across, hz) / expected - 1.0).abs() < 0.02, "{} at {hz} Hz", size(across, hz));
        for other in [0.5, 0.8, 0.9, 1.1, 1.25, 2.0] {
            let surroundings = size(across, other * hz);
            assert!(surroundings < 0.316 * size(across, hz), "{surroundings} at {other} times {hz} Hz");
        }
        assert!(rms(along) < 1e-3 * rms(across), "{} along the ridges", rms(along));
    }
}

/// A round bump is the same in every direction: not only its level, but its waveform.
#[test]
fn a_round_bump_is_the_same_in_every_direction() {
    let bump = |x_m: f64, y_m: f64| {
        let distance = (x_m - 0.5 * SIDE_M).hypot(y_m - 0.5 * SIDE_M) / 1.25e-3;
        5e-5 * (-0.5 * distance * distance).exp()
    };
    let map = map_of(64, HeightMapOptions::HARD_PLASTIC, bump);
    let over = |angle: f64| {
        let at = |i: usize| 1e-4 * (i as f64 - 150.0);
        let path_m: Vec<[f64; 2]> = (0..300)
            .map(|i| [0.5 * SIDE_M + at(i) * angle.cos(), 0.5 * SIDE_M + at(i) * angle.sin()])
            .collect();
        played(&map, &path_m, Newtons(1.0))
    };
    let first = over(0.0);
    let peak = first.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(peak > 0.2, "{peak}");
    for i in 1..12 {
        for (a, b) in first.iter().zip(&over(TAU * f64::from(i) / 12.0)) {
            assert!((a - b).abs() < 0.01 * peak, "{b} is not {a} in direction {i}");
        }
    }
}

#[test]
fn octave_0_holds_what_the_smallest_patch_lets_through() {
    let n_of = |map: &HeightMap| map.prepare().view().n();
    assert_eq!(n_of(&random_map(64, [1.0, 31.0], SHARP)), 128);
    assert_eq!(n_of(&random_map(64, [1.0, 7.5], SHARP)), 32);
    assert_eq!(n_of(&map_of(16, SHARP, |_, _| 0.0)), 4);
    // A patch of 5 mm averages ripples of 1.3 mm over some waves, and leaves a swell of 40 mm.
    let soft = HeightMapOptions { patch_radius_m: 5e-3, ..SHARP };
    let ripples_on_a_swell = |options| {
        let at = |x_m: f64, periods: f64| (TAU * periods * x_m / SIDE_M).cos();
        map_of(64, options, |x_m, _| 5e-3 * at(x_m, 1.0) + 1e-7 * at(x_m, 30.0))
    };
    assert_eq!((n_of(&ripples_on_a_swell(soft)), n_of(&ripples_on_a_swell(SHARP))), (4, 128));
}

#[test]
fn what_is_no_height_map_is_named() {
    let error =
        |heights_m: Vec<f64>, side_m, options| HeightMap::new(heights_m, side_m, options).unwrap_err();
    let flat = || vec![0.0; 256];
    for n_heights in [0, 255, 64, 48 * 48, 1024 * 1024] {
        assert_eq!(error(vec![0.0; n_heights], 0.04, SHARP), HeightMapError::Shape { n_heights });
    }
    for side_m in [0.0, 9e-4, 1.1, f64::INFINITY] {
        assert_eq!(error(flat(), side_m, SHARP), HeightMapError::Side { side_m });
    }
    for bad in [0.011, -0.02, f64::NAN, f64::INFINITY] {
        let mut heights_m = flat();
        heights_m[35] = bad;
        assert!(
            matches!(error(heights_m, 0.04, SHARP), HeightMapError::Height { row: 2, column: 3, .. }),
            "{bad}"
        );
    }
    // A needle of 10 mm on a tile of 1 mm with 512 heights: 2 h (v/step)² = 52 million m/s².
    let mut needle = vec![0.0; 512 * 512];
    needle[512 + 2] = 0.01;
    let steep = error(needle, 1e-3, SHARP);
    assert!(
        matches!(steep, HeightMapError::Steep { row: 1, column: 2, mps2 } if (5.2e7..5.3e7).contains(&mps2))
    );
    let force = HeightMapOptions { force: Newtons(0.0), ..SHARP };
    assert_eq!(error(flat(), 0.04, force), HeightMapError::Force { force_n: 0.0 });
    let exponent = HeightMapOptions { speed_exponent: 2.5, ..SHARP };
    assert_eq!(error(flat(), 0.04, exponent), HeightMapError::SpeedExponent { speed_exponent: 2.5 });
    let patch = HeightMapOptions { patch_radius_m: -1e-4, ..SHARP };
    assert_eq!(error(flat(), 0.04, patch), HeightMapError::PatchRadius { patch_radius_m: -1e-4 });
    let text = HeightMapError::Side { side_m: 2.0 }.to_string();
    assert_eq!(text, "the side of a height map must be from 1 to 1000 mm, got 2000 mm");
}

#[test]
fn scaling_and_stretching_change_heights_and_side_within_the_limits() {
    let map = wave(32, SHARP, [2.0, 1.0], 1e-4);
    let twice = map.scaled(2.0);
    assert!(twice.heights_m().iter().zip(map.heights_m()).all(|(a, b)| *a == 2.0 * b));
    assert_eq!((map.scaled(1.0), map.scaled(f64::NAN)), (map.clone(), map.clone()));
    assert!(map.scaled(0.0).heights_m().iter().all(|height_m| *height_m == 0.0));
    let wide = map.stretched(1.5);
    assert_eq!((wide.side_m(), wide.heights_m()), (1.5 * SIDE_M, map.heights_m()));
    assert_eq!((map.stretched(1.0), map.stretched(-3.0)), (map.clone(), map.clone()));
    assert_eq!((map.stretched(1e9).side_m(), map.stretched(1e-9).side_m()), (1.0, 1e-3));
    for factor in [1.5, 1.0, -3.0, 1e9, 1e-9, f64::NAN] {
        assert_eq!(map.stretched_side_m(factor), map.stretched(factor).side_m(), "{factor}");
    }
    // Every result is a valid map.
    let steep = random_map(512, [1.0, 255.0], SHARP);
    for changed in [map.scaled(1e9), map.scaled(-1e9), steep.scaled(1e12), steep.stretched(1e-9)] {
        let (heights_m, side_m) = (changed.heights_m().to_vec(), changed.side_m());
        assert_eq!(HeightMap::new(heights_m, side_m, SHARP), Ok(changed));
    }
    let highest = map.scaled(-1e9).heights_m().iter().copied().fold(0.0, f64::max);
    assert!((highest / MAX_HEIGHT_M - 1.0).abs() < 0.002);
}

#[test]
fn a_map_is_prepared_once_and_its_multiples_not_at_all() {
    let made = || random_map(32, [1.0, 12.0], HeightMapOptions::HARD_PLASTIC);
    let (map, unprepared) = (made(), made());
    let levels = map.prepare();
    for same in [&map, &map.clone(), &map.scaled(1.0), &map.stretched(1.0)] {
        assert!(Arc::ptr_eq(&same.prepare(), &levels));
    }
    let scaled = map.scaled(-0.7);
    assert_eq!(scaled, unprepared.scaled(-0.7));
    assert_eq!(format!("{scaled:?}"), format!("{:?}", unprepared.scaled(-0.7)));
    let (got, expected) = (scaled.prepare(), unprepared.scaled(-0.7).prepare());
    assert_eq!(got.view().n(), expected.view().n());
    let highest = expected.view().octaves().iter().fold(0.0_f32, |most, sample| most.max(sample.abs()));
    for (got, expected) in got.view().octaves().iter().zip(expected.view().octaves()) {
        // Some roundings of `f32`.
        assert!((got - expected).abs() <= 1e-6 * highest, "{got} is not {expected}");
    }
    // The contact patch does not grow with the tile.
    assert_eq!(map.stretched(1.5).prepare(), unprepared.stretched(1.5).prepare());
}

proptest! {
    #[test]
    fn what_is_accepted_is_taken_by_the_renderer(
        heights_m in prop::collection::vec(-MAX_HEIGHT_M..MAX_HEIGHT_M, 256),
        ln_side in -4.0_f64..0.0,
        speed_exponent in 0.0_f64..2.0,
        ln_force in -13.0_f64..9.0,
        patch_radius_m in 0.0_f64..5e-3,
    ) {
        let options = HeightMapOptions { force: Newtons(ln_force.exp()), speed_exponent, patch_radius_m };
        let levels = HeightMap::new(heights_m, ln_side.exp(), options).unwrap().prepare();
        let view = levels.view();
        let checked = SynthHeightMap::new(
            view.side_m(), view.force_n(), view.speed_exponent(), view.n(), view.octaves(),
        );
        prop_assert_eq!(checked, Ok(view));
        prop_assert!(view.n() <= 32);
    }
}
