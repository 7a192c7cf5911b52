use std::cell::Cell;

use super::{
    GrainError, MAX_ORDER, MIN_ORDER, N_STROKES, Stroked, fit, n_strokes, prepare_strokes, stroked_grain,
};
use crate::dsp::ar::test_signals::from_resonances;
use crate::dsp::spectrum::rms;
use crate::maths::rng::lcg_noise;
use crate::surfaces::height_field::{Tile, synthesize};
use crate::surfaces::material::Material;
use crate::surfaces::material::tests::plain;
use crate::units::Hertz;

const TILE: Tile = Tile { n_cells: 128, spacing_m: 40e-6 };

fn stroked(resonances: &[(Hertz, f64)], level: f64, seed: u64) -> Stroked {
    let ar = from_resonances(Hertz(1000.0), resonances);
    let mut x = lcg_noise(2000, seed);
    for n in 0..x.len() {
        x[n] -= (1..=ar.len().min(n)).map(|k| ar[k - 1] * x[n - k]).sum::<f64>();
    }
    let accel_mps2 = x.split_off(1000).into_iter().map(|v| level * v).collect();
    // Two nodes at the same speed and force are an error.
    Stroked { speed_mm_per_s: 100.0 + seed as f64, force_n: 1.0, accel_mps2 }
}

fn rich(seed: u64) -> Stroked {
    let resonances: Vec<(Hertz, f64)> = (1..8).map(|i| (Hertz(60.0 * f64::from(i)), 0.97)).collect();
    stroked(&resonances, 1.0, seed)
}

#[test]
fn order_is_common_and_within_its_range() {
    let simple: Vec<Stroked> = (0..5).map(|i| stroked(&[(Hertz(100.0), 0.95)], 1.0, i)).collect();
    assert_eq!(fit(&simple, None, 0.3).unwrap().order(), MIN_ORDER);
    let rich: Vec<Stroked> = (0..5).map(rich).collect();
    let order = fit(&rich, None, 0.3).unwrap().order();
    assert!((14..=MAX_ORDER).contains(&order), "{order}");
}

#[test]
fn both_directions_have_one_order() {
    let simple: Vec<Stroked> = (0..5).map(|i| stroked(&[(Hertz(100.0), 0.95)], 1.0, i)).collect();
    let rich: Vec<Stroked> = (0..5).map(rich).collect();
    for (across, along) in [(&simple, &rich), (&rich, &simple)] {
        let model = fit(across, Some(along), 0.3).unwrap();
        // The grain across is the same as without a direction.
        assert_eq!(model.nodes(), fit(across, None, 0.3).unwrap().nodes());
        let along = model.along().unwrap();
        assert!(along.len() == 5 && along.iter().all(|node| node.lsf.len() == model.order()));
    }
}

#[test]
fn level_is_that_of_the_signal() {
    let stroke = stroked(&[(Hertz(100.0), 0.9)], 0.25, 3);
    let rms = rms(&stroke.accel_mps2);
    let model = fit(&[stroke], None, 0.3).unwrap();
    assert!((model.nodes()[0].level_mps2 - rms).abs() < 1e-12);
    assert_eq!(model.friction(), Some(0.3));
    assert_eq!(model.along(), None);
}

#[test]
fn a_stroke_without_vibration_is_named() {
    let still = Stroked { speed_mm_per_s: 70.0, force_n: 0.4, accel_mps2: vec![0.0; 1000] };
    let message = fit(&[still], None, 0.3).unwrap_err().to_string();
    assert!(message.contains("70 mm/s and 0.4 N"), "{message}");
}

#[test]
fn a_directional_material_is_stroked_twice_and_can_be_stopped() {
    let brushed = Material { stretch: 20.0, ..plain() };
    assert_eq!((n_strokes(&plain()), n_strokes(&brushed)), (N_STROKES, 2 * N_STROKES));
    let surfaces = prepare_strokes(&brushed, &synthesize(&brushed, TILE, 1), 1);
    let n_done = Cell::new(0);
    let step = || {
        n_done.set(n_done.get() + 1);
        true
    };
    let model = stroked_grain(&brushed, &surfaces, 1, &step).unwrap();
    assert_eq!(n_done.get(), 2 * N_STROKES);
    let along = model.along().unwrap();
    // Above the roll-off, power falls as the elongation to the power of -2H: 18 dB.
    for (across, along) in model.nodes().iter().zip(along) {
        assert_eq!((across.speed, across.force), (along.speed, along.force));
        assert!(along.level_mps2 < 0.5 * across.level_mps2, "{along:?}");
    }
    n_done.set(0);
    let stopping = || {
        n_done.set(n_done.get() + 1);
        n_done.get() < 3
    };
    assert_eq!(stroked_grain(&brushed, &surfaces, 1, &stopping), Err(GrainError::Stopped));
    assert_eq!(n_done.get(), 3);
}
