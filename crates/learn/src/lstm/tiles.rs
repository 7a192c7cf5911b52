//! A matrix as whole numbers of 16 bits, for products with one row after another.
//!
//! Such a product waits for its matrix: the 256 units of a layer have a megabyte of weights, more than many a processor
//! has next to it, and every step of a sequence goes through all of them. Half the bytes stay near. Each row has a unit
//! of its own, half of which is the largest error of a weight: 1.5e-5 of the largest weight of the row. A network that
//! learns multiplies in full.

use pulp::{Arch, Simd, WithSimd};

/// Columns of a tile: as many sums as stay in the registers.
const WIDTH: usize = 64;
/// Largest whole number of a weight.
const LARGEST: f32 = 32_767.0;

pub(super) struct Tiles {
    /// Rows of a tile, tile after tile; what the last has beyond the matrix is zero.
    values: Vec<[i16; WIDTH]>,
    /// Unit of each row.
    units: Vec<f32>,
    /// The row that is multiplied, in these units.
    scaled: Vec<f32>,
}

impl Tiles {
    /// Those of a matrix (rows × columns). A row with something that is no finite number makes every product none.
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
    #[allow(clippy::inline_always, reason = "what is not inlined is compiled for any machine")]
    fn with_simd<S: Simd>(self, _: S) {
        let n_rows = self.units.len();
        for (index, (row, unit)) in self.matrix.chunks_exact(self.n_columns).zip(self.units).enumerate() {
            // As whole numbers their bits are in their order, and what is no number lies above all: it stays one.
            let largest = row.iter().map(|x| x.abs().to_bits()).max().unwrap_or(0);
            *unit = f32::from_bits(largest) / LARGEST;
            // Nothing is left of a row of zeros, nor of one too small to have a unit.
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
    #[allow(clippy::inline_always, reason = "what is not inlined is compiled for any machine")]
    fn with_simd<S: Simd>(self, _: S) {
        let tiles = self.values.chunks_exact(self.scaled.len());
        for (tile, sums) in tiles.zip(self.sums.chunks_mut(WIDTH)) {
            let mut added = [0.0; WIDTH];
            for (x, row) in self.scaled.iter().zip(tile) {
                for (added, value) in added.iter_mut().zip(row) {
                    let weight = f32::from(*value);
                    // Where there are vectors they multiply and add at once; elsewhere that would be a call.
                    *added = if S::IS_SCALAR { x * weight + *added } else { x.mul_add(weight, *added) };
                }
            }
            for (sum, added) in sums.iter_mut().zip(added) {
                *sum += added;
            }
        }
    }
}

/// The nearest whole number; it is within those of 16 bits.
#[inline(always)]
#[allow(clippy::inline_always, reason = "what is not inlined is compiled for any machine")]
fn rounded(x: f32) -> i16 {
    // Adding one and a half times 2^23 leaves the whole number in the last bits.
    const ROUND: f32 = 12_582_912.0;
    (x + ROUND).to_bits() as i16
}
