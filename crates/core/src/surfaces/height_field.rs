//! Height field of a material: one tile of surface height that repeats in both directions without a seam.
//!
//! A tile is the sum of three parts: a fractal part, a [`crate::surfaces::material::Pattern`] and scattered
//! [`crate::surfaces::material::Bumps`]. The fractal part has the two-dimensional power spectrum
//! `(1 + (q/q₀)²)^-(H+1)`; its line profiles have the spectrum `(1 + (κ/κ₀)²)^-(H+1/2)`. Vibration
//! ([`crate::surfaces::contact_model`]) and picture ([`crate::surfaces::shading`]) are computed from the same tile, so
//! that what a person sees and feels agree.

mod bumps;
mod fractal;
mod pattern;

use crate::maths::rng::derive_seed;
use crate::surfaces::height_field::fractal::Fractal;
use crate::surfaces::material::Material;

/// Point spacing of a [`profile`].
pub const PROFILE_STEP_M: f64 = 10e-6;

/// Slope of the line of a [`profile`] against the x axis.
///
/// Each lap across the tile runs next to the one before. The slope is a tenth of the inverse golden ratio, so no lap
/// returns onto an earlier one.
pub const PROFILE_SLOPE: f64 = 0.061_803_398_874_989_48;

/// The tile of the starter library: 41 mm, fine enough for the grains of P320 sandpaper.
pub const STARTER_TILE: Tile = Tile { n_cells: 1024, spacing_m: 40e-6 };

/// Size and resolution of a tile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tile {
    /// Cells per side, at least 8.
    pub n_cells: usize,
    /// Spacing of neighboring cells, above 0.
    pub spacing_m: f64,
}

impl Tile {
    /// Side length.
    pub fn side_m(&self) -> f64 {
        self.n_cells as f64 * self.spacing_m
    }
}

/// A seamless square tile of surface heights with zero mean.
#[derive(Clone, Debug)]
pub struct HeightField {
    tile: Tile,
    /// Row by row; x runs along a row.
    heights_m: Vec<f64>,
    fractal: Fractal,
}

impl HeightField {
    /// Size and resolution of the tile.
    pub fn tile(&self) -> Tile {
        self.tile
    }

    /// Heights, row by row, `n_cells` × `n_cells`.
    pub fn heights_m(&self) -> &[f64] {
        &self.heights_m
    }
}

/// Returns the tile of a material, deterministic for a seed.
///
/// `material` must pass [`crate::surfaces::material::validate`]. Takes some tenths of a second at the size of
/// [`STARTER_TILE`].
pub fn synthesize(material: &Material, tile: Tile, seed: u64) -> HeightField {
    assert!(tile.n_cells >= 8, "a tile needs 8 cells along a side, got {}", tile.n_cells);
    let seed = derive_seed(seed, &material.id);
    let fractal = Fractal::new(material, tile);
    let mut heights_m = fractal::tile_heights(&fractal, tile, derive_seed(seed, "fractal"));
    if let Some(pattern) = &material.pattern {
        pattern::add(pattern, material.stretch, tile, derive_seed(seed, "pattern"), &mut heights_m);
    }
    for (i, scatter) in material.bumps.iter().enumerate() {
        bumps::add(scatter, tile, derive_seed(seed, &format!("bumps {i}")), &mut heights_m);
    }
    let mean = heights_m.iter().sum::<f64>() / heights_m.len() as f64;
    for height in &mut heights_m {
        *height -= mean;
    }
    HeightField { tile, heights_m, fractal }
}

/// Returns the height at a position, by cubic (Catmull-Rom) interpolation on the periodic tile.
pub fn height_m(field: &HeightField, x_m: f64, y_m: f64) -> f64 {
    let n = field.tile.n_cells;
    let (columns, column_weights) = cubic_taps(x_m / field.tile.spacing_m, n);
    let (rows, row_weights) = cubic_taps(y_m / field.tile.spacing_m, n);
    rows.iter()
        .zip(row_weights)
        .map(|(row, row_weight)| {
            let cells = &field.heights_m[row * n..(row + 1) * n];
            let along: f64 = columns.iter().zip(column_weights).map(|(c, weight)| weight * cells[*c]).sum();
            row_weight * along
        })
        .sum()
}

/// Returns `n_points` heights along a line across the periodic tile, spaced by [`PROFILE_STEP_M`].
///
/// The line starts at the origin with slope [`PROFILE_SLOPE`]. Fractal detail too fine for the tile is added, so that
/// the spectrum extends to a quarter of the sampling rate. `seed` affects only that detail.
pub fn profile(field: &HeightField, n_points: usize, seed: u64) -> Vec<f64> {
    let (step_x, step_y) = {
        let along = PROFILE_STEP_M / PROFILE_SLOPE.hypot(1.0);
        (along, along * PROFILE_SLOPE)
    };
    let detail = fractal::line_detail(&field.fractal, n_points, PROFILE_STEP_M, seed);
    detail
        .iter()
        .enumerate()
        .map(|(i, detail)| detail + height_m(field, i as f64 * step_x, i as f64 * step_y))
        .collect()
}

/// The four cells around a position (in cells), and their interpolation weights.
fn cubic_taps(position: f64, n_cells: usize) -> ([usize; 4], [f64; 4]) {
    let floor = position.floor();
    let t = position - floor;
    let first = (floor as isize - 1).rem_euclid(n_cells.cast_signed()).cast_unsigned();
    let cells = [0, 1, 2, 3].map(|offset| (first + offset) % n_cells);
    let weights = [
        0.5 * t * (t * (2.0 - t) - 1.0),
        0.5 * (t * t * (3.0 * t - 5.0) + 2.0),
        0.5 * t * (t * (4.0 - 3.0 * t) + 1.0),
        0.5 * t * t * (t - 1.0),
    ];
    (cells, weights)
}

#[cfg(test)]
mod tests {
    use super::{Fractal, HeightField, PROFILE_SLOPE, PROFILE_STEP_M, Tile, height_m, profile, synthesize};
    use crate::surfaces::material::tests::plain;
    use crate::surfaces::material::{Bumps, Pattern, PatternKind};
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
        let line = profile(&field, 4096, 1);
        let other_detail = profile(&field, 4096, 2);
        let along = PROFILE_STEP_M / PROFILE_SLOPE.hypot(1.0);
        let rms = |values: Vec<f64>| (values.iter().map(|v| v * v).sum::<f64>() / 4096.0).sqrt();
        let off_tile = rms((0..4096)
            .map(|i| line[i] - height_m(&field, i as f64 * along, i as f64 * along * PROFILE_SLOPE))
            .collect());
        // Of a fractal with 1 µm RMS and 1 mm roll-off, the detail too fine for the tile is a small part.
        assert!(off_tile > 0.0 && off_tile < 0.25e-6, "detail rms {off_tile} m");
        assert_ne!(line, other_detail);
    }
}
