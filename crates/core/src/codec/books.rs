//! The tables that encoder and decoder share.

use super::bitrate::Bitrate;
use super::spectrum::Lsf;
use super::{CODES_SEED, HALF_SAMPLES, N_CODES_MOST, N_SPLITS, ORDER, SPLITS};
use crate::lsf::repair_to;
use crate::rng::lcg_noise;
use crate::statistics::dot;

/// Least distance of quantized frequencies, in radians.
const LEAST_GAP: f64 = 0.02;
/// Bits of the pairs of gains that there are tables for.
pub const GAIN_BITS: [u32; 3] = [4, 5, 6];

/// Samples of half a frame: of a signal, an excitation, a fixed code or a response.
pub(super) type HalfFrame = [f64; HALF_SAMPLES];

/// Rows that are looked at side by side: as many as a processor has registers for their sums.
pub(super) const N_BLOCK: usize = 32;
/// Such rows in singles, sample by sample.
pub(super) type Block = [[f32; N_BLOCK]; HALF_SAMPLES];

/// Tables that were trained, as numbers: what a file holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Tables {
    /// Mean of the line spectral frequencies, in radians.
    pub lsf_mean: Vec<f64>,
    /// Tables of each part of the frequencies, for each number of bits that a rate has for it.
    pub lsf: Vec<SplitTable>,
    /// For each of [`GAIN_BITS`]: pairs of the gain of the lagged excitation, and of the fixed code relative to what the energy
    /// is expected to be.
    pub gains: Vec<Vec<[f64; 2]>>,
}

/// The entries of a part of the frequencies.
#[derive(Clone, Debug, PartialEq)]
pub struct SplitTable {
    /// Which part.
    pub split: usize,
    /// Bits of an index.
    pub n_bits: u32,
    /// As many as the bits can tell apart: what is added to the mean, in radians.
    pub entries: Vec<Vec<f64>>,
}

/// Why tables are none of this codec.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BooksError {
    /// A table that is missing, or of another size.
    #[error("the tables of the codec do not fit it: {what}; install the program again")]
    Size {
        /// Which.
        what: &'static str,
    },
    /// A number that is none.
    #[error("the tables of the codec hold what is not a number; install the program again")]
    NotFinite,
}

/// The tables, checked, with the fixed codes.
#[derive(Clone, Debug)]
pub struct Codebooks {
    tables: Tables,
    pub(super) codes: Vec<HalfFrame>,
    /// The same, side by side.
    pub(super) code_blocks: Vec<Block>,
    /// Their autocorrelations, side by side.
    pub(super) correlation_blocks: Vec<Block>,
}

impl Codebooks {
    /// Checks tables and makes the fixed codes.
    ///
    /// # Errors
    /// See [`BooksError`].
    pub fn new(tables: Tables) -> Result<Self, BooksError> {
        let wrong = |what: &'static str| Err(BooksError::Size { what });
        if tables.lsf_mean.len() != ORDER {
            return wrong("the mean of the line spectral frequencies");
        }
        for rate in Bitrate::ALL {
            for (split, n_bits) in rate.allocation().lsf.into_iter().enumerate() {
                let (begin, end) = SPLITS[split];
                let is_right = |table: &SplitTable| {
                    table.split == split
                        && table.n_bits == n_bits
                        && table.entries.len() == 1 << n_bits
                        && table.entries.iter().all(|entry| entry.len() == end - begin)
                };
                if !tables.lsf.iter().any(is_right) {
                    return wrong("line spectral frequencies");
                }
            }
        }
        let is_sized = |(table, n_bits): (&Vec<[f64; 2]>, u32)| table.len() == 1 << n_bits;
        if tables.gains.len() != GAIN_BITS.len() || !tables.gains.iter().zip(GAIN_BITS).all(is_sized) {
            return wrong("gains");
        }
        let entries = tables.lsf.iter().flat_map(|table| table.entries.iter().flatten());
        let mut numbers =
            tables.lsf_mean.iter().chain(entries).chain(tables.gains.iter().flatten().flatten());
        if !numbers.all(|x| x.is_finite()) {
            return Err(BooksError::NotFinite);
        }
        let codes = fixed_codes();
        let correlations: Vec<HalfFrame> = codes.iter().map(autocorrelation).collect();
        Ok(Self { tables, code_blocks: blocks(&codes), correlation_blocks: blocks(&correlations), codes })
    }

    /// The tables.
    pub fn tables(&self) -> &Tables {
        &self.tables
    }

    /// The mean frequencies, as a frame before the first has them.
    pub(super) fn lsf_mean(&self) -> Lsf {
        std::array::from_fn(|i| self.tables.lsf_mean[i])
    }

    /// The entries of a part of the frequencies at a rate.
    pub(super) fn split(&self, rate: Bitrate, split: usize) -> &[Vec<f64>] {
        let n_bits = rate.allocation().lsf[split];
        let table = self.tables.lsf.iter().find(|table| table.split == split && table.n_bits == n_bits);
        table.map_or(&[], |table| &table.entries)
    }

    /// The pairs of gains at a rate.
    pub(super) fn gains(&self, rate: Bitrate) -> &[[f64; 2]] {
        let n_bits = rate.allocation().gain;
        let at = GAIN_BITS.iter().position(|bits| *bits == n_bits);
        at.map_or(&[], |at| &self.tables.gains[at])
    }

    /// The frequencies that entries say, in order and apart.
    pub(super) fn frequencies(&self, rate: Bitrate, indices: [u16; N_SPLITS]) -> Lsf {
        let mut lsf = self.tables.lsf_mean.clone();
        for (split, index) in indices.into_iter().enumerate() {
            let entries = self.split(rate, split);
            let entry = &entries[index as usize % entries.len()];
            for (to, from) in lsf[SPLITS[split].0..].iter_mut().zip(entry) {
                *to += from;
            }
        }
        let lsf = repair_to(lsf, LEAST_GAP);
        std::array::from_fn(|i| lsf[i])
    }
}

/// `Σ_i x[i + lag] x[i]` for every lag.
pub(super) fn autocorrelation(x: &HalfFrame) -> HalfFrame {
    std::array::from_fn(|lag| dot(&x[lag..], &x[..HALF_SAMPLES - lag]))
}

fn blocks(rows: &[HalfFrame]) -> Vec<Block> {
    let block = |rows: &[HalfFrame]| -> Block {
        std::array::from_fn(|i| std::array::from_fn(|row| rows.get(row).map_or(0.0, |row| row[i] as f32)))
    };
    rows.chunks(N_BLOCK).map(block).collect()
}

/// Noise that any language reproduces, row by row of unit length.
fn fixed_codes() -> Vec<HalfFrame> {
    let noise = lcg_noise(N_CODES_MOST * HALF_SAMPLES, CODES_SEED);
    let code = |row: &[f64]| {
        let length = dot(row, row).sqrt();
        std::array::from_fn(|i| row[i] / length)
    };
    noise.chunks_exact(HALF_SAMPLES).map(code).collect()
}
