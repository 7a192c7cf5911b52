use super::{
    Fractal, HeightField, PROFILE_SLOPE, PROFILE_STEP_M, Tile, elongation, height_m, profile, synthesize,
};
use crate::surfaces::material::tests::plain;
use crate::surfaces::material::{Bumps, Material, Pattern, PatternKind};
use crate::units::Radians;
use std::f64::consts::{FRAC_PI_2, TAU};

const SMALL: Tile = Tile { n_cells: 128, spacing_m: 40e-6 };

fn sine_field() -> HeightField {
    let n = SMALL.n_cells;
    let heights_m = (0..n * n)
        .map(|i| {
            let (row, column) = (i / n, i % n);
            (TAU * 3.0 * column as f64 / n as f64).sin() * (TAU * 2.0 * row as f64 / n as f64).cos()
        })
        .collect();
    HeightField { tile: SMALL, heights_m, fractal: Fractal::new(&plain(), SMALL) }
}

#[test]
fn interpolation_follows_a_sine_across_the_seam() {
    let field = sine_field();
    let side = SMALL.side_m();
    for i in 0..500 {
        let (x, y) = (side * (0.0071 * f64::from(i) - 1.5), side * 0.0153 * f64::from(i));
        let expected = (TAU * 3.0 * x / side).sin() * (TAU * 2.0 * y / side).cos();
        // Catmull-Rom errs by at most about (2π/43)³/10 at 43 cells per period, plus half of that along y.
        assert!((height_m(&field, x, y) - expected).abs() < 4e-4, "at {x}, {y}");
    }
}

#[test]
fn same_seed_same_tile_and_other_seed_or_material_another() {
    let mut material = plain();
    let a = synthesize(&material, SMALL, 1);
    assert_eq!(a.heights_m(), synthesize(&material, SMALL, 1).heights_m());
    assert_ne!(a.heights_m(), synthesize(&material, SMALL, 2).heights_m());
    material.id = "other".to_owned();
    assert_ne!(a.heights_m(), synthesize(&material, SMALL, 1).heights_m());
}

#[test]
fn every_pattern_and_scatter_gives_a_finite_tile_of_its_scale() {
    let kinds = [
        PatternKind::Ridges,
        PatternKind::PlainWeave,
        PatternKind::Twill,
        PatternKind::Domes,
        PatternKind::Loops,
        PatternKind::Pebbles,
        PatternKind::Cells,
    ];
    for kind in kinds {
        let mut material = plain();
        material.height_rms_m = 0.0;
        material.pattern = Some(Pattern { kind, period_m: 0.8e-3, amplitude_m: 1e-5, jitter: 0.2 });
        let field = synthesize(&material, SMALL, 4);
        let heights = field.heights_m();
        let mean = heights.iter().sum::<f64>() / heights.len() as f64;
        let rms = (heights.iter().map(|h| h * h).sum::<f64>() / heights.len() as f64).sqrt();
        assert!(mean.abs() < 1e-12, "{kind:?} mean {mean}");
        assert!((0.2e-5..1.2e-5).contains(&rms), "{kind:?} rms {rms}");
    }
}

#[test]
fn a_profile_rides_on_the_tile() {
    let mut material = plain();
    material.bumps.push(Bumps {
        height_m: 2e-5,
        radius_m: 3e-4,
        elongation: 1.0,
        spread_rad: FRAC_PI_2,
        density_per_m2: 1e6,
    });
    let field = synthesize(&material, SMALL, 8);
    let line = profile(&field, 4096, Radians(0.0), 1);
    let other_detail = profile(&field, 4096, Radians(0.0), 2);
    let along = PROFILE_STEP_M / PROFILE_SLOPE.hypot(1.0);
    let rms = |values: Vec<f64>| (values.iter().map(|v| v * v).sum::<f64>() / 4096.0).sqrt();
    let off_tile = rms((0..4096)
        .map(|i| line[i] - height_m(&field, i as f64 * along, i as f64 * along * PROFILE_SLOPE))
        .collect());
    // Of a fractal with 1 µm RMS and 1 mm roll-off, the detail too fine for the tile is a small part.
    assert!(off_tile > 0.0 && off_tile < 0.25e-6, "detail rms {off_tile} m");
    assert_ne!(line, other_detail);
}

#[test]
fn a_stroke_at_an_angle_rides_on_the_tile_in_steps_of_equal_length() {
    let field = sine_field();
    let side = SMALL.side_m();
    for degrees in [0.0_f64, 30.0, 45.0, 90.0, 200.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (x, y) = (cos - PROFILE_SLOPE * sin, sin + PROFILE_SLOPE * cos);
        // Several laps around the tile of 5 mm. Without a fractal there is no detail.
        let mut smooth = field.clone();
        smooth.fractal = Fractal::new(&Material { height_rms_m: 0.0, ..plain() }, SMALL);
        let line = profile(&smooth, 4096, Radians::from_degrees(degrees), 1);
        for (i, height) in line.iter().enumerate() {
            let along = i as f64 * PROFILE_STEP_M / x.hypot(y);
            let expected = (TAU * 3.0 * along * x / side).sin() * (TAU * 2.0 * along * y / side).cos();
            assert!((height - expected).abs() < 4e-4, "{degrees}°, point {i}");
        }
    }
}

#[test]
fn along_the_lay_a_stretched_surface_is_smooth() {
    let material = Material { stretch: 20.0, roll_off_m: 0.3e-3, ..plain() };
    let field = synthesize(&material, SMALL, 3);
    let slope = |degrees: f64| {
        let line = profile(&field, 8192, Radians::from_degrees(degrees), 1);
        let steps: f64 = line.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
        (steps / 8191.0).sqrt()
    };
    // Above the roll-off, slopes along a line fall as the elongation to the power of -H, here 0.7.
    let expected = elongation(20.0, Radians(FRAC_PI_2)).powf(-0.7);
    let ratio = slope(90.0) / slope(0.0);
    assert!((0.6..1.6).contains(&(ratio / expected)), "{ratio} for {expected}");
    assert_eq!(elongation(20.0, Radians(0.0)), 1.0);
}
