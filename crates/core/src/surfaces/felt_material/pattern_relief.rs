//! Height map of a material's pattern, as the pen of the contact model meets it.
//!
//! The map holds the heights of the ball's lowest point over the pattern alone. Simulated strokes over the same pattern give
//! the power of speed with which the vibration grows, and a factor on the heights, so that the level at 100 mm/s and 1 N is
//! that of the contact model.

use crate::dsp::spectrum::rms;
use crate::maths::rng::derive_seed;
use crate::surfaces::contact_model::following::{Following, follow};
use crate::surfaces::contact_model::{
    ACROSS, PEN, REFERENCE_CONTACT, STARTER_PATH_M, drag, patch_radius_m, prepare, press, tip_heights_m,
};
use crate::surfaces::felt_material::FeltError;
use crate::surfaces::height_field::{HeightField, Tile, synthesize};
use crate::surfaces::material::{Material, Pattern};
use crate::surfaces::stroked_grain::{GrainError, STROKE_SECS};
use crate::texture::height_map::{HeightMap, HeightMapOptions, PATCH_RADII_M};
use crate::texture::patterns::STARTER_SPEEDS_MM_PER_S;
use crate::units::MetersPerSecond;

/// Number of speeds at which the pattern is stroked.
pub(super) const N_SPEEDS: usize = STARTER_SPEEDS_MM_PER_S.len();

/// Points per period with which a map suffices: it then has half as many cells as the tile.
const ENOUGH_POINTS: f64 = 16.0;

/// Returns the pattern of a material, if it has heights.
pub(super) fn of(material: &Material) -> Option<Pattern> {
    material.pattern.filter(|pattern| pattern.amplitude_m > 0.0)
}

/// Returns the height map of the pattern of a material. `step` is called after each of the [`N_SPEEDS`].
pub(super) fn pattern_relief(
    material: &Material,
    pattern: Pattern,
    tile: Tile,
    seed: u64,
    step: &dyn Fn() -> bool,
) -> Result<HeightMap, FeltError> {
    let alone = Material { height_rms_m: 0.0, bumps: Vec::new(), ..material.clone() };
    let field = synthesize(&alone, tile, seed);
    let following = following(material, &field, seed, step)?;
    let heights_m = tip_heights_m(field.heights_m(), tile.n_cells, tile.spacing_m, &PEN);
    let is_fine = pattern.period_m < 2.0 * ENOUGH_POINTS * tile.spacing_m;
    let mut map_m = upright(&heights_m, tile.n_cells, if is_fine { 1 } else { 2 });
    let mean = map_m.iter().sum::<f64>() / map_m.len() as f64;
    for height in &mut map_m {
        *height = following.gain * (*height - mean);
    }
    let force = REFERENCE_CONTACT.force;
    let patch_m = material.patch_share * patch_radius_m(material, &PEN, force);
    let options = HeightMapOptions {
        force,
        speed_exponent: following.speed_exponent,
        patch_radius_m: patch_m.min(*PATCH_RADII_M.end()),
    };
    Ok(HeightMap::new(map_m, tile.side_m(), options)?)
}

/// Returns what the pen makes of a pattern, from strokes across it at the reference force. Friction is even, because its
/// variation belongs to the grain.
fn following(
    material: &Material,
    field: &HeightField,
    seed: u64,
    step: &dyn Fn() -> bool,
) -> Result<Following, FeltError> {
    let even = Material { friction_heterogeneity: 0.0, ..material.clone() };
    let surface = prepare(&even, field, &PEN, STARTER_PATH_M, ACROSS, seed);
    let pressed = press(&surface, REFERENCE_CONTACT.force)?;
    let seed = derive_seed(seed, &material.id);
    let mut ratios = Vec::with_capacity(N_SPEEDS);
    for speed_mm_per_s in STARTER_SPEEDS_MM_PER_S {
        let seed = derive_seed(seed, &format!("pattern at {speed_mm_per_s} mm/s"));
        let speed = MetersPerSecond::from_mm_per_s(speed_mm_per_s);
        let pen = rms(&drag(&pressed, speed, STROKE_SECS, seed)?);
        let exact = rms(&follow(&pressed, speed, STROKE_SECS, seed)?);
        ratios.push((speed, pen / exact));
        if !step() {
            return Err(GrainError::Stopped.into());
        }
    }
    Ok(Following::fitted(&ratios))
}

/// Returns every `factor`-th point of a periodic tile with y upward: the rows of a tile run downward from the upper edge of
/// its picture, those of a map upward from y = 0. With a factor above 1, points are averaged with weights of 1/4, 1/2 and
/// 1/4 along both axes, which keeps their positions.
fn upright(heights_m: &[f64], n_cells: usize, factor: usize) -> Vec<f64> {
    let weights: &[(usize, f64)] =
        if factor == 1 { &[(0, 1.0)] } else { &[(n_cells - 1, 0.25), (0, 0.5), (1, 0.25)] };
    let n = n_cells / factor;
    let at = |row: usize, column: usize| {
        let row_mean = |row: usize| {
            let cells = &heights_m[row % n_cells * n_cells..][..n_cells];
            weights.iter().map(|(shift, weight)| weight * cells[(column + shift) % n_cells]).sum::<f64>()
        };
        weights.iter().map(|(shift, weight)| weight * row_mean(row + shift)).sum::<f64>()
    };
    (0..n * n).map(|i| at(n_cells - i / n * factor, i % n * factor)).collect()
}

#[cfg(test)]
mod tests {
    use super::upright;

    #[test]
    fn the_first_row_of_the_map_is_the_upper_edge_and_the_second_the_lowest_row_of_the_tile() {
        // The upper and the lower edge of a periodic tile are the same line.
        let tile: Vec<f64> = (0..16).map(f64::from).collect();
        let map = upright(&tile, 4, 1);
        assert_eq!(map[..4], tile[..4]);
        assert_eq!(map[4..8], tile[12..]);
        assert_eq!(map[12..], tile[4..8]);
    }

    #[test]
    fn fewer_points_keep_a_wave_in_its_place() {
        let (n, k) = (64_u32, std::f64::consts::TAU / 64.0);
        let wave = |x: f64, y: f64| (k * (3.0 * x + 2.0 * y) + 0.4).cos();
        let size = n as usize;
        let tile: Vec<f64> = (0..n * n).map(|i| wave(f64::from(i % n), -f64::from(i / n))).collect();
        let map = upright(&tile, size, 2);
        assert_eq!(map.len(), 32 * 32);
        // The gain of the weights along one axis is the squared cosine of half the phase of a step.
        let gain = (1.5 * k).cos().powi(2) * k.cos().powi(2);
        for (i, got) in (0_u32..).zip(&map) {
            let expected = gain * wave(2.0 * f64::from(i % 32), 2.0 * f64::from(i / 32));
            assert!((got - expected).abs() < 1e-12, "{i}: {got} {expected}");
        }
    }
}
