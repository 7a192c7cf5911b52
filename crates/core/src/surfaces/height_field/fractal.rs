//! The self-affine fractal part of a tile, and the profile detail that is too fine for the tile.

use crate::dsp::square_transform::{self, transpose};
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

/// Direction of a line across a tile: cosine and sine of its angle from the x axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) cos: f64,
    pub(super) sin: f64,
}

impl Line {
    /// Ratio of feature length along the line to that along x, 1 to `stretch`.
    pub(super) fn elongation(self, stretch: f64) -> f64 {
        1.0 / self.cos.hypot(self.sin / stretch)
    }
}

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

    /// Ratio of feature length along y to that along x.
    pub(super) fn stretch(&self) -> f64 {
        self.stretch
    }

    /// Two-sided spectrum of a line, in m³, minus the part within the tile's band.
    ///
    /// A line with the elongation λ has λ times the spectrum of a line along x, at λ times the wave number. The density
    /// across the line is symmetric about one offset, where features lie along the lay, and falls on both sides.
    fn line_residual_m3(&self, line: Line, q_per_m: f64) -> f64 {
        let elongation = line.elongation(self.stretch);
        let q_along_x_per_m = elongation * q_per_m;
        // Integral over the wave number across from `from` to infinity: from + scale (1-t)/t maps it to a bounded range
        // of t.
        let beyond = |from: f64| {
            let scale = (q_along_x_per_m.hypot(self.roll_off_per_m) / self.stretch).max(from);
            let integral: f64 = (0..N_NODES)
                .map(|node| {
                    let t = (node as f64 + 0.5) / N_NODES as f64;
                    self.density_m4(q_along_x_per_m, from + scale * (1.0 - t) / t) * scale / (t * t)
                })
                .sum();
            integral / N_NODES as f64
        };
        let Some((low, high)) = self.in_band(line, q_per_m) else {
            return elongation * 2.0 * beyond(0.0);
        };
        let per_stretch = elongation / self.stretch;
        let middle =
            -q_per_m * line.sin * line.cos * (self.stretch * self.stretch - 1.0) * per_stretch * per_stretch;
        // From `from` to infinity, on the side where the distance from the middle is positive.
        let outside = |from: f64| {
            if from >= 0.0 {
                beyond(from / elongation)
            } else {
                2.0 * beyond(0.0) - beyond(-from / elongation)
            }
        };
        elongation * (outside(middle - low) + outside(high - middle))
    }

    /// Wave numbers across a line, from lowest to highest, that lie in the tile's band together with `q_per_m` along the
    /// line; `None` if there are none.
    fn in_band(&self, line: Line, q_per_m: f64) -> Option<(f64, f64)> {
        let band = self.tile_band_per_m;
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        for (along, per_across) in [(q_per_m * line.cos, -line.sin), (q_per_m * line.sin, line.cos)] {
            if per_across == 0.0 {
                if along.abs() > band {
                    return None;
                }
            } else {
                let [a, b] = [-band, band].map(|edge| (edge - along) / per_across);
                low = low.max(a.min(b));
                high = high.min(a.max(b));
            }
        }
        (low <= high).then_some((low, high))
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
    let wave_number = |i: usize| square_transform::wave_number(i, n) as f64 * unit;
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

/// Detail along a line of `n_points` that is too fine for the tile.
pub(super) fn line_detail(
    fractal: &Fractal,
    line: Line,
    n_points: usize,
    step_m: f64,
    seed: u64,
) -> Vec<f64> {
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
        let power = fractal.line_residual_m3(line, q) * unit;
        *value = (0.5 * power).sqrt() * Complex::new(random.normal(), random.normal());
    }
    let mut detail = inverse.make_output_vec();
    let outcome = inverse.process(&mut spectrum, &mut detail);
    assert!(outcome.is_ok(), "the transform's buffers come from its own plan: {outcome:?}");
    detail.truncate(n_points);
    detail
}

#[cfg(test)]
mod tests;
