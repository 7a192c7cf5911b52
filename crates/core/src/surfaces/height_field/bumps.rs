//! Scattered Gaussian bumps on a tile.

use crate::maths::rng::Random;
use crate::surfaces::height_field::Tile;
use crate::surfaces::material::Bumps;
use std::f64::consts::TAU;

/// Standard deviation of the natural logarithm of bump height.
const HEIGHT_SPREAD: f64 = 0.35;

/// Standard deviation of the natural logarithm of bump radius.
const RADIUS_SPREAD: f64 = 0.25;

/// Squared distance, in standard deviations, beyond which a bump is truncated to zero: e^-6 of its height.
const REACH_SQUARED: f64 = 12.0;

/// Adds a scatter of bumps to the heights; where bumps overlap, the larger counts.
pub(super) fn add(bumps: &Bumps, tile: Tile, seed: u64, heights_m: &mut [f64]) {
    let n = tile.n_cells;
    let n_bumps = (bumps.density_per_m2 * tile.side_m().powi(2)).round() as usize;
    let mut random = Random::new(seed);
    let mut layer = vec![0.0_f64; n * n];
    for _ in 0..n_bumps {
        let center = [random.uniform() * n as f64, random.uniform() * n as f64];
        let height_m = bumps.height_m.abs() * random.log_normal(HEIGHT_SPREAD);
        let radius = bumps.radius_m * random.log_normal(RADIUS_SPREAD) / tile.spacing_m;
        let angle = TAU * 0.25 + bumps.spread_rad * (2.0 * random.uniform() - 1.0);
        stamp(&mut layer, n, center, [radius * bumps.elongation, radius], angle, height_m);
    }
    let sign = bumps.height_m.signum();
    for (height, bump) in heights_m.iter_mut().zip(&layer) {
        *height += sign * bump;
    }
}

/// Raises the layer to one bump with radii (in cells) along and across an axis at `angle` from x.
fn stamp(layer: &mut [f64], n: usize, center: [f64; 2], radii: [f64; 2], angle: f64, height_m: f64) {
    let (sin, cos) = angle.sin_cos();
    let [along, across] = radii.map(|radius| 1.0 / (radius * radius));
    // Squared distance a dx² + 2 b dx dy + c dy².
    let a = along * cos * cos + across * sin * sin;
    let b = (along - across) * sin * cos;
    let c = along * sin * sin + across * cos * cos;
    let determinant = along * across;
    let half_rows = (REACH_SQUARED * a / determinant).sqrt().min(0.5 * n as f64);
    let wrap = |cell: isize| cell.rem_euclid(n.cast_signed()).cast_unsigned();
    for row in (center[1] - half_rows).ceil() as isize..=(center[1] + half_rows).floor() as isize {
        let dy = row as f64 - center[1];
        let middle = center[0] - b * dy / a;
        let half = ((REACH_SQUARED * a - determinant * dy * dy).max(0.0).sqrt() / a).min(0.5 * n as f64);
        let row_start = wrap(row) * n;
        for column in (middle - half).ceil() as isize..=(middle + half).floor() as isize {
            let dx = column as f64 - center[0];
            let distance = a * dx * dx + 2.0 * b * dx * dy + c * dy * dy;
            let cell = &mut layer[row_start + wrap(column)];
            *cell = cell.max(height_m * (-0.5 * distance).exp());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Bumps, Tile, add, stamp};

    /// Slow oracle: the definition for every cell, over nine copies of the periodic tile.
    #[test]
    fn a_stamp_is_the_turned_gaussian_on_the_torus() {
        let n = 48;
        for (center, radii, angle) in
            [([10.3, 20.7], [3.0, 3.0], 0.4), ([1.2, 46.9], [4.0, 1.5], 0.9), ([47.5, 0.2], [5.0, 1.0], 1.55)]
        {
            let mut layer = vec![0.0; n * n];
            stamp(&mut layer, n, center, radii, angle, 2.0);
            for (i, got) in layer.iter().enumerate() {
                let mut expected = 0.0_f64;
                for shift in 0..9 {
                    let dx = (i % n) as f64 - center[0] + n as f64 * f64::from(shift % 3 - 1);
                    let dy = (i / n) as f64 - center[1] + n as f64 * f64::from(shift / 3 - 1);
                    let u = (dx * angle.cos() + dy * angle.sin()) / radii[0];
                    let v = (dy * angle.cos() - dx * angle.sin()) / radii[1];
                    expected = expected.max(2.0 * (-0.5 * (u * u + v * v)).exp());
                }
                // A bump is truncated at its reach: e^-6 of a height of 2.
                assert!((got - expected).abs() < 5.1e-3, "cell {i}: {got} is not {expected}");
            }
        }
    }

    #[test]
    fn negative_bumps_are_pits() {
        let tile = Tile { n_cells: 64, spacing_m: 40e-6 };
        let bumps =
            Bumps { height_m: -1e-5, radius_m: 2e-4, elongation: 1.0, spread_rad: 0.0, density_per_m2: 1e6 };
        let mut heights = vec![0.0; 64 * 64];
        add(&bumps, tile, 1, &mut heights);
        assert!(heights.iter().all(|h| *h <= 0.0) && heights.iter().any(|h| *h < -5e-6));
    }
}
