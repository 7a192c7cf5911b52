//! Weighted sums of prepared height maps, which are linear in the heights, and rotations by quarter turns.
//!
//! A map whose octave 0 has fewer samples than that of the sum has no finer octaves. There it continues as the same spline on
//! half the spacing: a B-spline of degree five is the sum of seven B-splines of half the width, with the binomial weights
//! (1, 6, 15, 20, 15, 6, 1) / 32 (the two-scale relation; C. de Boor, "A Practical Guide to Splines", 1978).

use std::sync::Arc;

use shagreen_synth::height_map::{LEAST_SIDE, PATCH_FORCES, length};

use crate::maths::sums::add_times;
use crate::texture::height_map::HeightMapOptions;
use crate::texture::height_map::levels::HeightMapLevels;
use crate::texture::height_map::quarter_turn::quarter_turned;

impl HeightMapLevels {
    /// Weighted sum of maps on one tile with this side in m and these options. Each map keeps its own contact patches.
    ///
    /// Cost: a multiplication and an addition for each sample of each map.
    pub(in crate::texture::height_map) fn sum(
        parts: &[(Arc<Self>, f32)],
        side_m: f64,
        options: &HeightMapOptions,
    ) -> Self {
        let n = parts.iter().map(|(levels, _)| levels.n).max().unwrap_or(LEAST_SIDE);
        let mut octaves = vec![0.0; PATCH_FORCES.len() * length(n)];
        for (patch, sum) in octaves.chunks_exact_mut(length(n)).enumerate() {
            for (levels, factor) in parts {
                // The coarsest octaves are the last ones.
                let own = levels.of_patch(patch);
                let finer = sum.len() - own.len();
                add_times(own, *factor, &mut sum[finer..]);
            }
            add_beyond_octave_0(parts, patch, sum);
        }
        let (force_n, speed_exponent) = (options.force.0 as f32, options.speed_exponent as f32);
        Self { side_m, force_n, speed_exponent, n, octaves }
    }

    /// The map rotated by a number of quarter turns, counterclockwise.
    pub(in crate::texture::height_map) fn turned(&self, quarter: u8) -> Self {
        let mut octaves = Vec::with_capacity(self.octaves.len());
        for patch in 0..PATCH_FORCES.len() {
            let (mut rest, mut m) = (self.of_patch(patch), self.n);
            while m >= LEAST_SIDE {
                let (octave, coarser) = rest.split_at(m * m);
                octaves.extend(quarter_turned(octave, quarter));
                (rest, m) = (coarser, m / 2);
            }
        }
        Self { octaves, ..*self }
    }

    /// Octaves of a patch, the finest one first.
    fn of_patch(&self, patch: usize) -> &[f32] {
        &self.octaves[patch * length(self.n)..][..length(self.n)]
    }
}

/// Adds the maps to the octaves of the sum that are finer than their own.
fn add_beyond_octave_0(parts: &[(Arc<HeightMapLevels>, f32)], patch: usize, sum: &mut [f32]) {
    // The sum of the maps without a finer octave, on m × m samples.
    let mut ended: Vec<f32> = Vec::new();
    let mut m = LEAST_SIDE;
    while length(m) < sum.len() {
        for (levels, factor) in parts.iter().filter(|(levels, _)| levels.n == m) {
            ended.resize(m * m, 0.0);
            add_times(&levels.of_patch(patch)[..m * m], *factor, &mut ended);
        }
        if !ended.is_empty() {
            ended = on_half_the_spacing(&ended, m);
        }
        m *= 2;
        let begin = sum.len() - length(m);
        add_times(&ended, 1.0, &mut sum[begin..]);
    }
}

/// Coefficients of a spline on 2n × 2n samples from those on n × n samples.
fn on_half_the_spacing(coefficients: &[f32], n: usize) -> Vec<f32> {
    let wide: Vec<f32> = coefficients.chunks_exact(n).flat_map(line_on_half_the_spacing).collect();
    let row = |y: usize| &wide[y % n * 2 * n..][..2 * n];
    let mut fine = Vec::with_capacity(4 * n * n);
    for y in 0..n {
        let [before, here, after, next] = [row(y + n - 1), row(y), row(y + 1), row(y + 2)];
        let around = before.iter().zip(here).zip(after).zip(next);
        let pairs: Vec<[f32; 2]> = around.map(|(((a, b), c), d)| pair([*a, *b, *c, *d])).collect();
        fine.extend(pairs.iter().map(|[at, _]| at));
        fine.extend(pairs.iter().map(|[_, between]| between));
    }
    fine
}

/// The same for one line of samples.
fn line_on_half_the_spacing(line: &[f32]) -> Vec<f32> {
    let n = line.len();
    let at = |i: usize| line[i % n];
    (0..n).flat_map(|i| pair([at(i + n - 1), at(i), at(i + 1), at(i + 2)])).collect()
}

/// The two coefficients on half the spacing at a sample and after it, from the coefficients around: one before the sample, its
/// own, and two after it.
fn pair([before, here, after, next]: [f32; 4]) -> [f32; 2] {
    [(6.0 * (before + after) + 20.0 * here) / 32.0, (before + next + 15.0 * (here + after)) / 32.0]
}

#[cfg(test)]
mod tests {
    use super::{line_on_half_the_spacing, on_half_the_spacing};

    /// The B-spline of degree d by its recursion (C. de Boor): nonzero from -(d+1)/2 to (d+1)/2.
    fn b_spline(degree: u32, x: f64) -> f64 {
        if degree == 0 {
            return f64::from(u8::from((-0.5..0.5).contains(&x)));
        }
        let (d, half) = (f64::from(degree), 0.5 * f64::from(degree + 1));
        ((half + x) * b_spline(degree - 1, x + 0.5) + (half - x) * b_spline(degree - 1, x - 0.5)) / d
    }

    /// Value of a periodic spline of degree five at a position in samples.
    fn value(coefficients: &[f32], at: f64) -> f64 {
        let n = coefficients.len() as f64;
        let near = |i: usize| {
            let apart = (at - i as f64 + 0.5 * n).rem_euclid(n) - 0.5 * n;
            f64::from(coefficients[i]) * b_spline(5, apart)
        };
        (0..coefficients.len()).map(near).sum()
    }

    #[test]
    fn a_spline_on_half_the_spacing_is_the_same_spline() {
        let coarse: Vec<f32> = (0..16).map(|i| (7.0 * i as f32).sin()).collect();
        let fine = line_on_half_the_spacing(&coarse);
        for i in 0..160 {
            let at = 0.1 * f64::from(i);
            // Coefficients of about 1 in `f32`.
            assert!((value(&coarse, at) - value(&fine, 2.0 * at)).abs() < 1e-6, "at {at}");
        }
    }

    #[test]
    fn rows_and_columns_are_treated_alike() {
        let n = 8;
        let along_x: Vec<f32> = (0..n * n).map(|i| (3.0 * (i % n) as f32).sin()).collect();
        let along_y: Vec<f32> = (0..n * n).map(|i| (3.0 * (i / n) as f32).sin()).collect();
        let (wide, high) = (on_half_the_spacing(&along_x, n), on_half_the_spacing(&along_y, n));
        let line = line_on_half_the_spacing(&along_x[..n]);
        for (i, (x, y)) in wide.iter().zip(&high).enumerate() {
            let (column, row) = (i % (2 * n), i / (2 * n));
            assert!((x - line[column]).abs() < 1e-6 && (y - line[row]).abs() < 1e-6);
        }
    }
}
