use std::cell::Cell;
use std::sync::Arc;

use super::{felt, n_steps, pattern_relief};
use crate::dsp::spectrum::{median, rms, welch};
use crate::surfaces::contact_model::landing::{REFERENCE_LANDING, landing};
use crate::surfaces::contact_model::{ACROSS, PEN, STARTER_PATH_M, STROKE_RATE, drag, prepare, press};
use crate::surfaces::height_field::{HeightField, Tile, synthesize};
use crate::surfaces::material::tests::plain;
use crate::surfaces::material::{Material, Pattern, PatternKind};
use crate::texture::blend::Mode;
use crate::texture::height_map::HeightMap;
use crate::texture::plane::Plane;
use crate::texture::render::{RenderPlan, render};
use crate::texture::{GrainNode, TextureModel};
use crate::units::{Contact, MetersPerSecond, Newtons};

/// A tile of 10.24 mm.
const TILE: Tile = Tile { n_cells: 256, spacing_m: 40e-6 };

fn ridged(period_m: f64) -> Material {
    let pattern = Pattern { kind: PatternKind::Ridges, period_m, amplitude_m: 10e-6, jitter: 0.02 };
    Material { pattern: Some(pattern), ..plain() }
}

/// Renders a stroke across a texture, along x at y = 0.
fn stroked(model: &TextureModel, speed_mps: f64) -> Vec<f64> {
    let prepared = Plane::new(model).prepare();
    let plan = RenderPlan {
        parents: &[(&prepared, 1.0)],
        mode: Mode::Field,
        rate: STROKE_RATE,
        seconds: 2.0,
        seed: 1,
    };
    let contact = Contact { speed: MetersPerSecond(speed_mps), force: Newtons(1.0) };
    let rendered = render(&plan, &mut |_: f64| contact).unwrap();
    rendered.into_iter().map(f64::from).collect()
}

/// A texture of a height map alone.
fn of_map(map: HeightMap) -> TextureModel {
    let node =
        GrainNode { speed: MetersPerSecond(0.1), force: Newtons(1.0), lsf: vec![1.0, 2.0], level_mps2: 0.0 };
    TextureModel::new(STROKE_RATE, vec![node], None).unwrap().with_height_map(Some(Arc::new(map)))
}

fn relief_of(material: &Material) -> HeightMap {
    pattern_relief(material, material.pattern.unwrap(), TILE, 3, &|| true).unwrap()
}

#[test]
fn a_pattern_is_felt_where_the_tip_is_and_not_in_the_grain() {
    let n_done = Cell::new(0);
    let step = || {
        n_done.set(n_done.get() + 1);
        true
    };
    let flat = felt(&plain(), TILE, 3, &step).unwrap();
    assert_eq!((n_done.get(), flat.n_nodes()), (n_steps(&plain()), 25));
    assert!(flat.height_map().is_none() && flat.along().is_none());
    assert_eq!(flat.tap(), Some(landing(&plain(), &PEN, REFERENCE_LANDING)));
    assert_eq!(flat.friction(), Some(plain().friction_coefficient));

    n_done.set(0);
    let material = ridged(2e-3);
    let model = felt(&material, TILE, 3, &step).unwrap();
    assert_eq!(n_done.get(), n_steps(&material));
    // Ridges on an isotropic surface: only the height map has a direction.
    assert_eq!((model.nodes(), model.along()), (flat.nodes(), None));
    let map = model.height_map().unwrap();
    assert_eq!(map.n(), 128);
    assert!((map.side_m() - TILE.side_m()).abs() < 1e-9);
    // A window of a second resolves 1 Hz.
    let density = welch(&stroked(&model, 0.1), STROKE_RATE, 1000);
    let near = |low: f64, high: f64| density.iter().filter(move |(at, _)| (low..=high).contains(&at.0));
    let peak = near(35.0, 70.0).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    // Five periods on a tile of 10.24 mm.
    let expected_hz = 0.1 / 2.048e-3;
    assert!((peak.0.0 / expected_hz - 1.0).abs() < 0.05, "{} Hz", peak.0.0);
    let around = median(near(25.0, 90.0).map(|(_, power)| *power).collect());
    assert!(peak.1 > 10.0 * around, "{} over {around}", peak.1);
}

#[test]
fn the_height_map_has_the_level_of_the_contact_model_at_every_speed() {
    for (youngs_modulus_pa, period_m) in [(2e9, 2e-3), (5e6, 3e-3)] {
        let material = Material { youngs_modulus_pa, contact_damping_ratio: 0.5, ..ridged(period_m) };
        let model = of_map(relief_of(&material));
        let even = Material { height_rms_m: 0.0, friction_heterogeneity: 0.0, ..material };
        let surface = prepare(&even, &synthesize(&even, TILE, 3), &PEN, STARTER_PATH_M, ACROSS, 3);
        let pressed = press(&surface, Newtons(1.0)).unwrap();
        for speed_mps in [0.07, 0.12, 0.25] {
            let expected = rms(&drag(&pressed, MetersPerSecond(speed_mps), 1.0, 1).unwrap());
            let decibels = 20.0 * (rms(&stroked(&model, speed_mps)) / expected).log10();
            // One exponent for all harmonics: some decibels of the level that the dynamics of the pen give.
            assert!(decibels.abs() < 4.0, "{youngs_modulus_pa} Pa, {speed_mps} m/s: {decibels} dB");
        }
    }
}

#[test]
fn the_map_and_the_picture_come_from_one_field() {
    let material = ridged(2e-3);
    let map = relief_of(&material);
    let field = synthesize(&Material { height_rms_m: 0.0, ..material }, TILE, 3);
    // A map has half as many points as the tile. Its y runs upward from the lower edge, the rows of the tile downward.
    let (n, m) = (TILE.n_cells, map.n());
    let at_map: Vec<f64> = (0..m * m).map(|i| tile_height(&field, 2 * (i % m), n - 2 * (i / m))).collect();
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let correlation = product(map.heights_m(), &at_map)
        / (product(map.heights_m(), map.heights_m()) * product(&at_map, &at_map)).sqrt();
    // The ball reaches the valleys, so that only the averaging of points differs.
    assert!(correlation > 0.98, "{correlation}");
}

fn tile_height(field: &HeightField, column: usize, row: usize) -> f64 {
    let n = field.tile().n_cells;
    field.heights_m()[row % n * n + column]
}

#[test]
fn a_simulation_stops_between_strokes() {
    let n_done = Cell::new(0);
    let step = || {
        n_done.set(n_done.get() + 1);
        n_done.get() < 3
    };
    let error = felt(&ridged(2e-3), TILE, 3, &step).unwrap_err();
    assert!(error.is_stop() && n_done.get() == 3, "{error}");
    let error = pattern_relief(&ridged(2e-3), ridged(2e-3).pattern.unwrap(), TILE, 3, &|| false).unwrap_err();
    assert!(error.is_stop(), "{error}");
    let material = Material { hurst: f64::NAN, ..plain() };
    assert!(!felt(&material, TILE, 3, &|| true).unwrap_err().is_stop());
}
