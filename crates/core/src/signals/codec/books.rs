//! Codebooks shared by encoder and decoder.

use super::bitrate::Bitrate;
use super::spectrum::Lsf;
use super::{CODES_SEED, HALF_SAMPLES, N_CODES_MOST, N_SPLITS, ORDER, SPLITS};
use crate::dsp::lsf::repair_to;
use crate::maths::rng::lcg_noise;
use crate::maths::statistics::dot;

/// Minimum spacing of quantized line spectral frequencies, in radians per sample.
const LEAST_GAP: f64 = 0.02;
/// Index sizes of the gain codebooks, in bits.
pub const GAIN_BITS: [u32; 3] = [4, 5, 6];

/// Samples of a subframe: signal, excitation, fixed codebook entry or impulse response.
pub(super) type HalfFrame = [f64; HALF_SAMPLES];

/// Rows processed side by side (SIMD): their sums fit the processor's registers.
pub(super) const N_BLOCK: usize = 32;
/// [`N_BLOCK`] rows in single precision, stored sample by sample.
pub(super) type Block = [[f32; N_BLOCK]; HALF_SAMPLES];

/// Trained tables as plain numbers: the content of a table file.
#[derive(Clone, Debug, PartialEq)]
pub struct Tables {
    /// Mean line spectral frequencies, in radians per sample.
    pub lsf_mean: Vec<f64>,
    /// Split VQ tables: one for each part and each index size that any rate uses.
    pub lsf: Vec<SplitTable>,
    /// Gain codebooks, one for each of [`GAIN_BITS`].
    ///
    /// Each entry is the adaptive codebook gain and the fixed codebook gain. The fixed gain is relative to the
    /// predicted excitation level.
    pub gains: Vec<Vec<[f64; 2]>>,
}

/// VQ codebook of one part of the line spectral frequencies.
#[derive(Clone, Debug, PartialEq)]
pub struct SplitTable {
    /// Index of the part.
    pub split: usize,
    /// Bits per index.
    pub n_bits: u32,
    /// Entries, 2 to the power of `n_bits`: offsets from the mean, in radians per sample.
    pub entries: Vec<Vec<f64>>,
}

/// Reasons why tables do not fit this codec.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BooksError {
    /// A table is missing or has the wrong size.
    #[error("codec tables do not fit: {what} missing or of the wrong size; install the program again")]
    Size {
        /// Name of the table.
        what: &'static str,
    },
    /// A value is not finite.
    #[error("codec tables contain a value that is not finite; install the program again")]
    NotFinite,
}

/// Validated tables and the fixed codebook.
#[derive(Clone, Debug)]
pub struct Codebooks {
    tables: Tables,
    pub(super) codes: Vec<HalfFrame>,
    /// Fixed codebook in blocks for SIMD.
    pub(super) code_blocks: Vec<Block>,
    /// Autocorrelations of the fixed codebook in blocks for SIMD.
    pub(super) correlation_blocks: Vec<Block>,
}

impl Codebooks {
    /// Validates tables and generates the fixed codebook.
    ///
    /// # Errors
    /// [`BooksError`] if a table is missing, has the wrong size or is not finite.
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

    /// Returns the validated tables.
    pub fn tables(&self) -> &Tables {
        &self.tables
    }

    /// Returns the mean frequencies, which also stand in before the first frame.
    pub(super) fn lsf_mean(&self) -> Lsf {
        std::array::from_fn(|i| self.tables.lsf_mean[i])
    }

    /// Returns the VQ entries of a part of the frequencies at a rate.
    pub(super) fn split(&self, rate: Bitrate, split: usize) -> &[Vec<f64>] {
        let n_bits = rate.allocation().lsf[split];
        let table = self.tables.lsf.iter().find(|table| table.split == split && table.n_bits == n_bits);
        table.map_or(&[], |table| &table.entries)
    }

    /// Returns the gain pairs at a rate.
    pub(super) fn gains(&self, rate: Bitrate) -> &[[f64; 2]] {
        let n_bits = rate.allocation().gain;
        let at = GAIN_BITS.iter().position(|bits| *bits == n_bits);
        at.map_or(&[], |at| &self.tables.gains[at])
    }

    /// Returns the decoded frequencies of codebook indices, sorted and with minimum spacing.
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

/// Returns `Σ_i x[i + lag] x[i]` for every lag.
pub(super) fn autocorrelation(x: &HalfFrame) -> HalfFrame {
    std::array::from_fn(|lag| dot(&x[lag..], &x[..HALF_SAMPLES - lag]))
}

fn blocks(rows: &[HalfFrame]) -> Vec<Block> {
    let block = |rows: &[HalfFrame]| -> Block {
        std::array::from_fn(|i| std::array::from_fn(|row| rows.get(row).map_or(0.0, |row| row[i] as f32)))
    };
    rows.chunks(N_BLOCK).map(block).collect()
}

/// Reproducible LCG noise (the same in any language), in rows of unit length.
fn fixed_codes() -> Vec<HalfFrame> {
    let noise = lcg_noise(N_CODES_MOST * HALF_SAMPLES, CODES_SEED);
    let code = |row: &[f64]| {
        let length = dot(row, row).sqrt();
        std::array::from_fn(|i| row[i] / length)
    };
    noise.chunks_exact(HALF_SAMPLES).map(code).collect()
}
