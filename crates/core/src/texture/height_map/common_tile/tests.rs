use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use proptest::prelude::{ProptestConfig, prop, prop_assert, prop_assert_eq, proptest};
use shagreen_synth::height_map::HeightMap as SynthHeightMap;

use super::{CommonTile, TilePart, copies_on};
use crate::dsp::spectrum::rms;
use crate::texture::height_map::tests::{RATE, SHARP, SIDE_M, line, map_of, played, random_map, wave};
use crate::texture::height_map::{HeightMap, HeightMapOptions};
use crate::units::Newtons;

fn tile(maps: &[&HeightMap]) -> CommonTile {
    let maps: Vec<Option<Arc<HeightMap>>> = maps.iter().map(|map| Some(Arc::new((*map).clone()))).collect();
    CommonTile::new(&maps).unwrap()
}

/// Parts with these weights, without rotation.
fn parts(weights: &[f64]) -> Vec<TilePart> {
    let part = |(map, weight): (usize, &f64)| TilePart { map, weight: *weight, turn_rad: 0.0 };
    weights.iter().enumerate().map(part).collect()
}

fn blended(maps: &[&HeightMap], weights: &[f64]) -> Option<HeightMap> {
    tile(maps).blended(&parts(weights))
}

/// Rms difference of two signals, relative to the second one.
fn deviation(found: &[f64], expected: &[f64]) -> f64 {
    let difference: Vec<f64> = found.iter().zip(expected).map(|(a, b)| a - b).collect();
    rms(&difference) / rms(expected)
}

#[test]
fn a_blend_of_equal_tiles_is_the_sum_by_weight() {
    let a = wave(32, HeightMapOptions { force: Newtons(8.0), ..SHARP }, [2.0, 1.0], 1e-4);
    let b = wave(32, HeightMapOptions { speed_exponent: 1.0, ..SHARP }, [0.0, 3.0], 1e-4);
    let blend = blended(&[&a, &b], &[0.5, 0.25]).unwrap();
    assert_eq!((blend.n(), blend.side_m()), (32, SIDE_M));
    let options = blend.options();
    assert!((options.force.0 - 17.0 / 3.0).abs() < 1e-12);
    assert!((options.speed_exponent - 5.0 / 3.0).abs() < 1e-12);
    // At the same force, a map with eight times the reference force has half the acceleration.
    let path_m = line(0.1, 0.7, 50);
    let [all, of_a, of_b] = [&blend, &a, &b].map(|map| map.acceleration(&path_m, Newtons(2.0), RATE));
    for ((all, of_a), of_b) in all.iter().zip(of_a).zip(of_b) {
        assert!((all - 0.5 * of_a - 0.25 * of_b).abs() < 1e-9);
    }
    // A map of another resolution is resampled to the finer one.
    let fine = wave(128, SHARP, [5.0, 0.0], 1e-4);
    let both = blended(&[&b, &fine], &[0.6, 0.4]).unwrap();
    assert_eq!((both.n(), both.side_m()), (128, SIDE_M));
    let expected = wave(128, SHARP, [0.0, 3.0], 6e-5);
    for (i, got) in both.heights_m().iter().enumerate() {
        assert!((got - expected.heights_m()[i] - 0.4 * fine.heights_m()[i]).abs() < 1e-15);
    }
    // Weights of a field sum to one, and some are negative.
    let field = blended(&[&b, &b], &[1.25, -0.25]).unwrap();
    for (got, expected) in field.heights_m().iter().zip(b.heights_m()) {
        assert!((got - expected).abs() < 1e-15);
    }
}

#[test]
fn a_map_that_contributes_alone_stays_as_it_is() {
    let a = wave(32, SHARP, [2.0, 1.0], 1e-4);
    let b = wave(64, SHARP, [1.0, 0.0], 1e-4).stretched(2.3);
    assert_eq!(blended(&[&a, &b], &[1.0, 0.0]), Some(a.clone()));
    assert_eq!(blended(&[&a, &b], &[0.0, -0.7]), Some(b.scaled(-0.7)));
    assert_eq!(blended(&[&a, &b], &[0.0, f64::NAN]), None);
    assert_eq!(blended(&[&a, &b], &[]), None);
    // Surfaces without heights have no map.
    let beside_flat = CommonTile::new(&[None, Some(Arc::new(a.clone()))]).unwrap();
    assert_eq!(beside_flat.blended(&parts(&[0.5, 0.5, 0.1])), Some(a.scaled(0.5)));
    assert_eq!(beside_flat.blended(&parts(&[1.0, 0.0])), None);
    assert!(CommonTile::new(&[]).is_none() && CommonTile::new(&[None]).is_none());
}

#[test]
fn every_map_is_repeated_on_the_tile() {
    for (own_mm, copies) in
        [(40.0, 1), (39.0, 1), (29.0, 1), (28.0, 2), (20.0, 2), (16.4, 2), (16.2, 3), (1.0, 40)]
    {
        assert_eq!(copies_on(0.04, 1e-3 * own_mm), copies, "{own_mm} mm");
    }
    // Two copies of 0.7 m would not be a valid tile.
    assert_eq!((copies_on(1.0, 0.7), copies_on(1.0, 0.5)), (1, 2));
    let a = wave(64, SHARP, [3.0, 2.0], 1e-4);
    // Two copies have 1.06 times the side.
    let b = wave(64, SHARP, [1.0, 0.0], 1e-4).stretched(0.53);
    let both = blended(&[&a, &b], &[0.6, 0.4]).unwrap();
    assert_eq!(both.n(), 128);
    assert!((both.side_m() / (SIDE_M * 1.06_f64.powf(0.4)) - 1.0).abs() < 1e-12);
    let expected = map_of(128, SHARP, |x_m, y_m| {
        let turn = |x: f64, y: f64| (TAU * (x * x_m + y * y_m) / SIDE_M).cos();
        6e-5 * turn(3.0, 2.0) + 4e-5 * turn(2.0, 0.0)
    });
    for (got, expected) in both.heights_m().iter().zip(expected.heights_m()) {
        assert!((got - expected).abs() < 1e-15);
    }
    // Tiles of 1.5 times the side: two copies of the smaller one are 4/3 as large.
    let both = blended(&[&a, &a.stretched(1.5)], &[0.6, 0.4]).unwrap();
    assert_eq!(both.n(), 128);
    assert!((both.side_m() / (SIDE_M * 2.0_f64.powf(0.6) * 1.5_f64.powf(0.4)) - 1.0).abs() < 1e-12);
}

/// Octaves of the prepared sum and sums of the octaves of the prepared maps differ by roundings of `f32` only.
#[test]
fn the_sum_of_prepared_maps_is_the_prepared_sum() {
    let a = random_map(32, [1.0, 12.0], HeightMapOptions::HARD_PLASTIC);
    let b = random_map(32, [9.0, 12.0], HeightMapOptions::HARD_PLASTIC);
    let blend = blended(&[&a, &b], &[1.3, -0.3]).unwrap();
    assert!(blend.is_prepared() && !a.is_prepared());
    let again = HeightMap::new(blend.heights_m().to_vec(), SIDE_M, blend.options()).unwrap();
    let (found, expected) = (blend.prepare(), again.prepare());
    assert_eq!((found.view().n(), found.view().side_m()), (expected.view().n(), SIDE_M));
    let highest = expected.view().octaves().iter().fold(0.0_f32, |most, sample| most.max(sample.abs()));
    for (found, expected) in found.view().octaves().iter().zip(expected.view().octaves()) {
        assert!((found - expected).abs() <= 2e-6 * highest, "{found} is not {expected}");
    }
}

/// A map with few waves has no fine octaves of its own.
#[test]
fn a_smooth_map_is_felt_under_a_fine_one() {
    let fine = random_map(64, [20.0, 24.0], HeightMapOptions::HARD_PLASTIC).scaled(0.02);
    let smooth = random_map(64, [1.0, 5.0], HeightMapOptions::HARD_PLASTIC);
    assert!(smooth.prepare().view().n() < fine.prepare().view().n());
    let blend = blended(&[&fine, &smooth], &[0.5, 0.5]).unwrap();
    let again = HeightMap::new(blend.heights_m().to_vec(), SIDE_M, blend.options()).unwrap();
    for mps in [0.02, 0.1, 0.4] {
        let path_m = line(mps, 0.7, 1000);
        let [found, expected, without] =
            [&blend, &again, &fine.scaled(0.5)].map(|map| played(map, &path_m, Newtons(1.0)));
        // Waves of four samples in the finest octave of the smooth map are accurate within 1.3 %.
        assert!(deviation(&found, &expected) < 0.01, "{} at {mps} m/s", deviation(&found, &expected));
        assert!(deviation(&without, &expected) > 0.1, "the smooth map is felt at {mps} m/s");
    }
}

#[test]
fn a_map_is_rotated_by_quarter_turns() {
    let map = random_map(32, [1.0, 12.0], HeightMapOptions::HARD_PLASTIC);
    let tile = tile(&[&map]);
    for (quarter, angle_rad) in [(1, FRAC_PI_2), (2, 2.0 * FRAC_PI_2), (3, -FRAC_PI_2)] {
        let turned = tile.blended(&[TilePart { map: 0, weight: 0.8, turn_rad: angle_rad }]).unwrap();
        let path_m = line(0.1, 0.4, 400);
        // The map under a rotated path is the rotated map under the path.
        let (sin, cos) = angle_rad.sin_cos();
        let own_m: Vec<[f64; 2]> =
            path_m.iter().map(|[x, y]| [cos * x + sin * y, cos * y - sin * x]).collect();
        let expected = map.scaled(0.8).acceleration(&own_m, Newtons(1.0), RATE);
        let found = turned.acceleration(&path_m, Newtons(1.0), RATE);
        assert!(deviation(&found, &expected) < 1e-9, "{quarter} quarter turns");
        let expected = played(&map.scaled(0.8), &own_m, Newtons(1.0));
        let found = played(&turned, &path_m, Newtons(1.0));
        // Roundings of `f32`.
        assert!(deviation(&found, &expected) < 1e-4, "{quarter} quarter turns in the renderer");
    }
}

#[test]
fn a_map_much_smaller_than_the_tile_keeps_its_long_waves() {
    let large = wave(16, SHARP, [1.0, 2.0], 1e-4).stretched(5.0);
    let small = wave(16, SHARP, [1.0, 2.0], 1e-7).stretched(0.125);
    let both = blended(&[&large, &small], &[1e-2, 0.99]).unwrap();
    // 40 copies of 16 heights would need more than the limit.
    assert_eq!(both.n(), 512);
    let path_m = line(0.5, 0.3, 20);
    let [found, expected] =
        [&both, &small.scaled(0.99)].map(|map| map.acceleration(&path_m, Newtons(1.0), RATE));
    assert!((rms(&found) / rms(&expected) - 1.0).abs() < 0.05);
}

/// 250 copies with nine periods each have more periods than any tile holds.
#[test]
fn a_map_much_larger_than_the_others_leaves_them_as_they_are() {
    let small = wave(64, SHARP, [0.0, 9.0], 1e-6).stretched(4e-3 / SIDE_M);
    let like_it = wave(64, SHARP, [5.0, 1.0], 1e-6).stretched(5e-3 / SIDE_M);
    let large = wave(16, SHARP, [1.0, 2.0], 1e-3).stretched(1.0 / SIDE_M);
    assert_eq!((small.side_m(), large.side_m()), (4e-3, 1.0));
    let maps = [&small, &large, &like_it];
    // Without the large map.
    let expected = blended(&[&small, &like_it], &[0.4, 0.5]).unwrap();
    assert_eq!(blended(&maps, &[0.4, 0.1, 0.5]), Some(expected));
    assert_eq!(blended(&maps, &[0.6, 0.4, 0.0]), Some(small.scaled(0.6)));
    assert_eq!(blended(&maps, &[0.25, 0.75, 0.0]), None);
    // Where it contributes alone, the large map is exact, also in other axes.
    assert_eq!(blended(&maps, &[0.0, 0.8, 5e-4]), Some(large.scaled(0.8)));
    let turned = tile(&maps).blended(&[TilePart { map: 1, weight: 1.0, turn_rad: FRAC_PI_2 }]).unwrap();
    assert_eq!((turned.n(), turned.side_m()), (16, 1.0));
    // A small map beside many large ones is the one that stays apart.
    let other = large.scaled(0.5);
    let maps = [&small, &large, &other];
    assert_eq!(blended(&maps, &[0.3, 0.4, 0.3]), blended(&[&large, &other], &[0.4, 0.3]));
    assert_eq!(blended(&maps, &[1.0, 0.0, 0.0]), Some(small.clone()));
}

#[test]
fn a_map_that_stays_apart_begins_and_ends_without_a_step() {
    let small = wave(64, SHARP, [0.0, 9.0], 1e-6).stretched(4e-3 / SIDE_M);
    let large = wave(16, SHARP, [1.0, 2.0], 1e-3).stretched(1.0 / SIDE_M);
    let tile = tile(&[&small, &large]);
    let own = rms(&felt(Some(small.clone()))) + rms(&felt(Some(large.clone())));
    for (from, to) in [(0.0, 1.0), (0.45, 0.76), (0.74, 1.0)] {
        let signal = |t: f64| {
            let weight = from + t * (to - from);
            felt(tile.blended(&parts(&[1.0 - weight, weight])))
        };
        let step = largest_step(signal);
        assert!(step < 1e-5 * own, "{step} of {own} between {from} and {to}");
    }
}

/// Rms of a difference after bisecting the line between two sets of weights, always toward the half with the larger change.
fn largest_step(signal: impl Fn(f64) -> Vec<f64>) -> f64 {
    let apart = |a: &[f64], b: &[f64]| rms(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<f64>>());
    let (mut low, mut high) = ((0.0, signal(0.0)), (1.0, signal(1.0)));
    for _ in 0..30 {
        let t = 0.5 * (low.0 + high.0);
        let middle = (t, signal(t));
        if apart(&low.1, &middle.1) > apart(&middle.1, &high.1) {
            high = middle;
        } else {
            low = middle;
        }
    }
    apart(&low.1, &high.1)
}

/// Signal of a stroke over 40 mm, and zero without a map.
fn felt(map: Option<HeightMap>) -> Vec<f64> {
    let path_m: Vec<[f64; 2]> = (0..14).map(|i| [3e-3 * f64::from(i), 1e-3 * f64::from(i)]).collect();
    let still = vec![0.0; path_m.len()];
    map.map_or(still, |map| map.acceleration(&path_m, Newtons(1.0), RATE))
}

/// Negative control: a jump is found.
#[test]
fn a_step_stays_a_step_however_often_its_line_is_bisected() {
    let map = wave(16, SHARP, [1.0, 2.0], 1e-4);
    let other = map.stretched(1.1);
    let step = largest_step(|t| felt(Some(if t < 0.3 { map.clone() } else { other.clone() })));
    assert!(step > 0.1 * rms(&felt(Some(map))), "{step}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// What is felt at a place is a continuous function of the weights, also where another map becomes the heaviest, where a
    /// map begins to contribute, and at a single map.
    #[test]
    fn blends_are_continuous_in_the_weights(
        from in prop::collection::vec(0.0_f64..1.0, 3),
        to in prop::collection::vec(-0.3_f64..1.0, 3),
        begins_alone in prop::bool::ANY,
        ln_stretches in prop::collection::vec(-0.7_f64..0.7, 3),
        turns_rad in prop::collection::vec(-0.1_f64..3.2, 3),
    ) {
        let shapes = [([1.0, 2.0], 0.0), ([2.0, -1.0], 1.0), ([0.0, 3.0], 2.0)];
        let maps: Vec<Option<Arc<HeightMap>>> = shapes.iter().zip(&ln_stretches).map(|((periods, exponent), ln)| {
            let options = HeightMapOptions { speed_exponent: *exponent, ..HeightMapOptions::HARD_PLASTIC };
            Some(Arc::new(wave(16, options, *periods, 1e-4).stretched(ln.exp())))
        }).collect();
        let tile = CommonTile::new(&maps).unwrap();
        let from = if begins_alone { vec![1.0, 0.0, 0.0] } else { from };
        let signal = |t: f64| {
            let part = |map: usize| TilePart {
                map,
                weight: from[map] + t * (to[map] - from[map]),
                // The axes of the sum turn with the weights, and the first map has them at the begin.
                turn_rad: if map == 0 { t * turns_rad[0] } else { turns_rad[map] },
            };
            felt(tile.blended(&[0, 1, 2].map(part)))
        };
        let own: f64 = maps.iter().flatten().map(|map| rms(&felt(Some(HeightMap::clone(map))))).sum();
        let step = largest_step(signal);
        prop_assert!(step < 1e-5 * own, "{} of {}", step, own);
    }

    /// Sums of any maps are valid, and the side lies between those of the repeated maps.
    #[test]
    fn blends_are_valid_maps(
        weights in prop::collection::vec(-1.5_f64..1.5, 3),
        ln_stretches in prop::collection::vec(-0.7_f64..0.7, 3),
        turn_rad in -3.2_f64..3.2,
    ) {
        let map = wave(16, HeightMapOptions::HARD_PLASTIC, [1.0, 2.0], 1e-4);
        let maps: Vec<HeightMap> = ln_stretches.iter().map(|ln| map.stretched(ln.exp())).collect();
        let largest_m = maps.iter().map(HeightMap::side_m).fold(0.0, f64::max);
        let mut parts = parts(&weights);
        parts[1].turn_rad = turn_rad;
        let maps: Vec<&HeightMap> = maps.iter().collect();
        if let Some(blend) = tile(&maps).blended(&parts) {
            let side = blend.side_m() / largest_m;
            prop_assert!((0.7..1.42).contains(&side), "{}", side);
            let again = HeightMap::new(blend.heights_m().to_vec(), blend.side_m(), blend.options());
            let levels = blend.prepare();
            let view = levels.view();
            let checked = SynthHeightMap::new(
                view.side_m(), view.force_n(), view.speed_exponent(), view.n(), view.octaves(),
            );
            prop_assert_eq!(checked, Ok(view));
            prop_assert_eq!(again, Ok(blend));
        }
    }
}
