//! The self-affine fractal part of a tile, and the profile detail that is too fine for the tile.

use crate::maths::rng::Random;
use crate::surfaces::height_field::Tile;
use crate::surfaces::material::Material;
use realfft::RealFftPlanner;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;
use std::f64::consts::PI;

/// Upper band limit of the tile's fractal, relative to the tile's Nyquist frequency: up to there interpolation is
/// accurate.
const TILE_BAND: f64 = 0.5;

/// Upper band limit of profile detail, relative to the profile's sampling rate.
const LINE_BAND: f64 = 0.25;

/// Quadrature nodes of the integral over wave numbers along y outside the tile's band.
const N_NODES: usize = 24;

/// Power spectrum `C (1 + (q_x² + (s q_y)²)/q₀²)^-(H+1)`, two-sided, in m⁴ over wave numbers in 1/m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fractal {
    level_m4: f64,
    hurst: f64,
    roll_off_per_m: f64,
    stretch: f64,
    /// Largest |q_x| and |q_y| in the tile.
    tile_band_per_m: f64,
}

impl Fractal {
    pub(super) fn new(material: &Material, tile: Tile) -> Self {
        let roll_off_per_m = 1.0 / material.roll_off_m;
        // The integral of the shape over both wave numbers is π q₀² / (H s).
        let level_m4 = material.height_rms_m.powi(2) * material.hurst * material.stretch
            / (PI * roll_off_per_m * roll_off_per_m);
        Self {
            level_m4,
            hurst: material.hurst,
            roll_off_per_m,
            stretch: material.stretch,
            tile_band_per_m: TILE_BAND * 0.5 / tile.spacing_m,
        }
    }

    fn density_m4(&self, qx_per_m: f64, qy_per_m: f64) -> f64 {
        let q = (qx_per_m * qx_per_m + (self.stretch * qy_per_m).powi(2)) / self.roll_off_per_m.powi(2);
        self.level_m4 * (1.0 + q).powf(-self.hurst - 1.0)
    }

    /// Two-sided spectrum of a line along x, in m³, minus the part within the tile's band.
    fn line_residual_m3(&self, qx_per_m: f64) -> f64 {
        let from = if qx_per_m > self.tile_band_per_m { 0.0 } else { self.tile_band_per_m };
        // Integral over q_y upward from `from`: q_y = from + scale (1-t)/t maps the infinite tail to a bounded range of
        // t.
        let scale = (qx_per_m.hypot(self.roll_off_per_m) / self.stretch).max(from);
        let integral: f64 = (0..N_NODES)
            .map(|node| {
                let t = (node as f64 + 0.5) / N_NODES as f64;
                self.density_m4(qx_per_m, from + scale * (1.0 - t) / t) * scale / (t * t)
            })
            .sum();
        2.0 * integral / N_NODES as f64
    }
}

/// Heights of the fractal on a tile, row by row.
pub(super) fn tile_heights(fractal: &Fractal, tile: Tile, seed: u64) -> Vec<f64> {
    let band = fractal.tile_band_per_m;
    gaussian_tile(tile, seed, |qx, qy| {
        if qx.abs() <= band && qy.abs() <= band { fractal.density_m4(qx, qy) } else { 0.0 }
    })
    .into_iter()
    .map(|value| value.re)
    .collect()
}

/// Two smooth random fields of unit variance as real and imaginary parts.
///
/// Correlation length: about `scale_m` along x and `stretch` times that along y.
pub(super) fn smooth_pair(tile: Tile, scale_m: f64, stretch: f64, seed: u64) -> Vec<Complex<f64>> {
    let mut pair = gaussian_tile(tile, seed, |qx, qy| {
        (-2.0 * ((qx * scale_m).powi(2) + (qy * scale_m * stretch).powi(2))).exp()
    });
    let power: f64 = pair.iter().map(|value| value.re * value.re).sum();
    let scale = (pair.len() as f64 / power.max(f64::MIN_POSITIVE)).sqrt();
    for value in &mut pair {
        *value *= scale;
    }
    pair
}

/// Complex field whose real and imaginary parts are independent, each with this two-sided power spectrum.
///
/// The density is in m² per squared unit of wave number.
fn gaussian_tile(tile: Tile, seed: u64, density: impl Fn(f64, f64) -> f64) -> Vec<Complex<f64>> {
    let n = tile.n_cells;
    let unit = 1.0 / tile.side_m();
    let wave_number = |i: usize| if i <= n / 2 { i as f64 * unit } else { (i as f64 - n as f64) * unit };
    let mut random = Random::new(seed);
    // Filled column by column in the spectrum, so that one transposition leaves rows of the tile.
    let mut field = vec![Complex::new(0.0, 0.0); n * n];
    for (i, column) in field.chunks_exact_mut(n).enumerate() {
        let qx = wave_number(i);
        for (j, value) in column.iter_mut().enumerate() {
            let power = density(qx, wave_number(j)) * unit * unit;
            if power > 0.0 && (i, j) != (0, 0) {
                *value = power.sqrt() * Complex::new(random.normal(), random.normal());
            }
        }
    }
    let inverse = FftPlanner::new().plan_fft_inverse(n);
    inverse.process(&mut field);
    transpose(&mut field, n);
    inverse.process(&mut field);
    field
}

fn transpose(values: &mut [Complex<f64>], n: usize) {
    const BLOCK: usize = 32;
    for row_block in (0..n).step_by(BLOCK) {
        for column_block in (row_block..n).step_by(BLOCK) {
            for row in row_block..(row_block + BLOCK).min(n) {
                for column in column_block.max(row + 1)..(column_block + BLOCK).min(n) {
                    values.swap(row * n + column, column * n + row);
                }
            }
        }
    }
}

/// Detail along a line of `n_points` that is too fine for the tile.
pub(super) fn line_detail(fractal: &Fractal, n_points: usize, step_m: f64, seed: u64) -> Vec<f64> {
    // An even length keeps the Nyquist bin out of the band. A length without large prime factors keeps the FFT fast.
    let n = n_points.next_multiple_of(256).max(256);
    let unit = 1.0 / (n as f64 * step_m);
    let mut planner = RealFftPlanner::<f64>::new();
    let inverse = planner.plan_fft_inverse(n);
    let mut spectrum = inverse.make_input_vec();
    let mut random = Random::new(seed);
    for (i, value) in spectrum.iter_mut().enumerate().skip(1) {
        let q = i as f64 * unit;
        if q > LINE_BAND / step_m {
            break;
        }
        let power = fractal.line_residual_m3(q) * unit;
        *value = (0.5 * power).sqrt() * Complex::new(random.normal(), random.normal());
    }
    let mut detail = inverse.make_output_vec();
    let outcome = inverse.process(&mut spectrum, &mut detail);
    assert!(outcome.is_ok(), "the transform's buffers come from its own plan: {outcome:?}");
    detail.truncate(n_points);
    detail
}

#[cfg(test)]
mod tests {
    use super::{Fractal, PI, RealFftPlanner, Tile, tile_heights};
    use crate::surfaces::material::tests::plain;

    const TILE: Tile = Tile { n_cells: 256, spacing_m: 40e-6 };

    fn check_variance(hurst: f64, stretch: f64, tolerance: f64) {
        let mut material = plain();
        material.hurst = hurst;
        material.stretch = stretch;
        material.roll_off_m = 0.6e-3;
        let fractal = Fractal::new(&material, TILE);
        let heights = tile_heights(&fractal, TILE, 3);
        let variance = heights.iter().map(|h| h * h).sum::<f64>() / heights.len() as f64;
        let detail: f64 = (1..200_000).map(|i| 2.0 * fractal.line_residual_m3(f64::from(i)) * 1.0).sum();
        let ratio = (variance + detail) / material.height_rms_m.powi(2);
        assert!((ratio - 1.0).abs() < tolerance, "H {hurst}, stretch {stretch}: {ratio}");
    }

    #[test]
    fn tile_and_detail_share_the_whole_variance() {
        // About 200 independent patches of roll-off size give a sample variance within 4 × 10 %; a stretched tile has
        // fewer.
        check_variance(0.5, 1.0, 0.2);
        check_variance(0.8, 1.0, 0.2);
        check_variance(0.7, 4.0, 0.4);
    }

    /// Closed form: a line through a two-dimensional spectrum of exponent H+1 has exponent H+1/2.
    #[test]
    fn mean_spectrum_of_the_rows_is_the_closed_form() {
        let mut material = plain();
        material.roll_off_m = 0.6e-3;
        let fractal = Fractal::new(&material, TILE);
        let n = TILE.n_cells;
        let mut planner = RealFftPlanner::<f64>::new();
        let forward = planner.plan_fft_forward(n);
        let mut power = vec![0.0; n / 2 + 1];
        let n_tiles = 8;
        for seed in 0..n_tiles {
            for row in tile_heights(&fractal, TILE, seed).chunks_exact_mut(n) {
                let mut spectrum = forward.make_output_vec();
                forward.process(row, &mut spectrum).expect("own plan");
                for (power, value) in power.iter_mut().zip(&spectrum) {
                    *power += value.norm_sqr() * TILE.spacing_m / (n * n) as f64 / n_tiles as f64;
                }
            }
        }
        let h = material.hurst;
        // Γ(H+1/2)/Γ(H+1) for H = 0.7 is 0.918169/0.908639.
        let gamma_ratio = 0.918_168_742_4 / 0.908_638_732_9;
        let at_zero = h * material.roll_off_m * material.height_rms_m.powi(2) / PI.sqrt() * gamma_ratio;
        // Octave bands from 0.6 to 5 per mm: tens of bins × many rows, but neighboring rows are correlated.
        for band in [6..12, 12..24, 24..50] {
            let n_bins = band.len() as f64;
            let (mut got, mut expected) = (0.0, 0.0);
            for i in band.clone() {
                let q = i as f64 / TILE.side_m();
                got += (power[i] + fractal.line_residual_m3(q)) / n_bins;
                expected += at_zero * (1.0 + (q * material.roll_off_m).powi(2)).powf(-h - 0.5) / n_bins;
            }
            assert!((got / expected - 1.0).abs() < 0.1, "bins {band:?}: {}", got / expected);
        }
    }

    #[test]
    fn beyond_the_tile_the_detail_is_the_whole_line_spectrum() {
        let material = plain();
        let fractal = Fractal::new(&material, TILE);
        let gamma_ratio = 0.918_168_742_4 / 0.908_638_732_9;
        let at_zero =
            material.hurst * material.roll_off_m * material.height_rms_m.powi(2) / PI.sqrt() * gamma_ratio;
        for q in [7e3, 1e4, 2e4] {
            let expected = at_zero * (1.0 + (q * material.roll_off_m).powi(2)).powf(-material.hurst - 0.5);
            let ratio = fractal.line_residual_m3(q) / expected;
            // The midpoint rule with these nodes is accurate to 1 %.
            assert!((ratio - 1.0).abs() < 0.01, "at {q} per m: {ratio}");
        }
    }
}
