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
use crate::surfaces::height_field::fractal::{Fractal, Line};
use crate::surfaces::material::Material;
use crate::units::Radians;

/// Point spacing of a [`profile`].
pub const PROFILE_STEP_M: f64 = 10e-6;

/// Slope of the line of a [`profile`] against the direction of the stroke.
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
/// The line starts at the origin. `angle` is that of the stroke, from the x axis of the tile toward its y axis: 0 is
/// across the lay, π/2 along it. The line leaves this angle by [`PROFILE_SLOPE`], less where the stroke runs along the
/// lay: its drift along x is divided by the stretch of the material, because features are narrow there. Fractal detail too
/// fine for the tile is added, so that the spectrum extends to a quarter of the sampling rate. `seed` affects only that
/// detail.
pub fn profile(field: &HeightField, n_points: usize, angle: Radians, seed: u64) -> Vec<f64> {
    let (sin, cos) = angle.0.sin_cos();
    let (step_x, step_y) = {
        let (x, y) = (cos - PROFILE_SLOPE * sin / field.fractal.stretch(), sin + PROFILE_SLOPE * cos);
        let along = PROFILE_STEP_M / y.hypot(x);
        (along * x, along * y)
    };
    let detail = fractal::line_detail(&field.fractal, Line { cos, sin }, n_points, PROFILE_STEP_M, seed);
    detail
        .iter()
        .enumerate()
        .map(|(i, detail)| detail + height_m(field, i as f64 * step_x, i as f64 * step_y))
        .collect()
}

/// Returns the ratio of feature length along a stroke to that along x, for a field with this stretch: 1 at the angle 0,
/// the stretch at π/2.
pub fn elongation(stretch: f64, angle: Radians) -> f64 {
    let (sin, cos) = angle.0.sin_cos();
    Line { cos, sin }.elongation(stretch)
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
mod tests;
