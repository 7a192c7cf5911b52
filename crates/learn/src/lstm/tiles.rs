//! Weight matrix quantized to 16-bit integers, for products with one row vector at a time.
//!
//! Such a product is limited by memory bandwidth. A layer of 256 units has 1 MB of recurrent weights, more than the
//! fast cache of many CPUs, and every time step reads all of them. At half the size they stay in cache. Each row has
//! its own quantization step. The largest weight error is half a step, or 1.5e-5 of the largest weight of the row.
//! Training uses full precision.

use pulp::{Arch, Simd, WithSimd};

/// Columns per tile: as many sums as fit in registers.
const WIDTH: usize = 64;
/// Largest quantized weight.
const LARGEST: f32 = 32_767.0;

pub(super) struct Tiles {
    /// Rows of each tile, tile by tile; the last tile is padded with zeros.
    values: Vec<[i16; WIDTH]>,
    /// Quantization step of each row.
    units: Vec<f32>,
    /// The multiplied row vector, scaled by the quantization steps.
    scaled: Vec<f32>,
}

impl Tiles {
    /// Returns the tiles of a matrix (rows × columns). A value that is not finite makes all products not finite.
    pub(super) fn of(matrix: &[f32], n_columns: usize) -> Self {
        let n_rows = matrix.len() / n_columns;
        let mut values = vec![[0; WIDTH]; n_rows * n_columns.div_ceil(WIDTH)];
        let mut units = vec![0.0; n_rows];
        Arch::new().dispatch(Cut { matrix, n_columns, values: &mut values, units: &mut units });
        Self { values, units, scaled: vec![0.0; n_rows] }
    }

    /// Adds `row × matrix` to the sums.
    pub(super) fn add_product(&mut self, row: &[f32], sums: &mut [f32]) {
        for ((scaled, value), unit) in self.scaled.iter_mut().zip(row).zip(&self.units) {
            *scaled = value * unit;
        }
        Arch::new().dispatch(AddProduct { scaled: &self.scaled, values: &self.values, sums });
    }
}

struct Cut<'a> {
    matrix: &'a [f32],
    n_columns: usize,
    values: &'a mut [[i16; WIDTH]],
    units: &'a mut [f32],
}

struct AddProduct<'a> {
    scaled: &'a [f32],
    values: &'a [[i16; WIDTH]],
    sums: &'a mut [f32],
}

impl WithSimd for Cut<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
    fn with_simd<S: Simd>(self, _: S) {
        let n_rows = self.units.len();
        for (index, (row, unit)) in self.matrix.chunks_exact(self.n_columns).zip(self.units).enumerate() {
            // The bits of magnitudes sort like the magnitudes, with infinity and NaN above all, so these propagate.
            let largest = row.iter().map(|x| x.abs().to_bits()).max().unwrap_or(0);
            *unit = f32::from_bits(largest) / LARGEST;
            // Rows of zeros, or of values too small for a quantization step, become zero.
            let in_units = Some(unit.recip()).filter(|x| x.is_finite()).unwrap_or(0.0);
            let tiles = self.values.iter_mut().skip(index).step_by(n_rows);
            for (tile, row) in tiles.zip(row.chunks(WIDTH)) {
                for (value, x) in tile.iter_mut().zip(row) {
                    *value = rounded(x * in_units);
                }
            }
        }
    }
}

impl WithSimd for AddProduct<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
    fn with_simd<S: Simd>(self, _: S) {
        let tiles = self.values.chunks_exact(self.scaled.len());
        for (tile, sums) in tiles.zip(self.sums.chunks_mut(WIDTH)) {
            let mut added = [0.0; WIDTH];
            for (x, row) in self.scaled.iter().zip(tile) {
                for (added, value) in added.iter_mut().zip(row) {
                    let weight = f32::from(*value);
                    // Fused multiply-add needs SIMD; in scalar code it would be a function call.
                    *added = if S::IS_SCALAR { x * weight + *added } else { x.mul_add(weight, *added) };
                }
            }
            for (sum, added) in sums.iter_mut().zip(added) {
                *sum += added;
            }
        }
    }
}

/// Returns the nearest integer; it must fit 16 bits.
#[inline(always)]
#[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
fn rounded(x: f32) -> i16 {
    // Adding 1.5 · 2^23 leaves the integer in the low bits.
    const ROUND: f32 = 12_582_912.0;
    (x + ROUND).to_bits() as i16
}
