//! Sums of the filters over the power spectra of many short frames, by their autocorrelations.
//!
//! The power of a frame `y` of `n` samples at the angle `ω` is `r₀ + 2 Σ r_l cos(ω l)` with `r_l = Σ y[t] y[t + l]`, so a
//! sum over bins is a weighted sum over the `n` lags, and no bin is ever worked out. For 25 samples that are 325 products
//! for the lags and 25 for a filter, where a transform of 256 samples takes thousands.

use std::f64::consts::TAU;

use ndarray::linalg::general_mat_mul;
use ndarray::{Array2, ArrayView1, ArrayView2, ArrayViewMut2, Axis, Slice};
use pulp::{Arch, Simd, WithSimd};

/// Longest frame for which this way is faster than a transform.
pub(super) const MAX_FRAME: usize = 48;

/// Frames whose products are formed side by side, and frames whose lags are kept at once.
const LANES: usize = 16;
pub(super) const BLOCK: usize = 16 * LANES;

/// The least sum that is trusted, as a share of what the terms that it is the sum of could add up to: their roundings of
/// about 1e-16 are then at most 1e-10 of it. Frames with less in a filter are left to the transform, which adds squares.
const TRUSTED_SHARE: f64 = 1e-6;

/// Weights of the lags.
#[derive(Clone)]
pub(super) struct LagFilters {
    window: Vec<f64>,
    /// `lags × filters`.
    weights: Array2<f64>,
    /// Least trusted sum of each filter for a frame of energy one.
    trusted: Vec<f64>,
}

impl LagFilters {
    /// The same as `filters`, one row of weights for the bins of a transform each.
    pub(super) fn new(window: &[f64], n_transform: usize, filters: &Array2<f64>) -> Self {
        let cosines: Vec<f64> =
            (0..n_transform).map(|i| (TAU * i as f64 / n_transform as f64).cos()).collect();
        // Most bins count for none but two of the filters.
        let counting = |row: ArrayView1<'_, f64>| -> Vec<(usize, f64)> {
            row.iter().copied().enumerate().filter(|(_, w)| *w != 0.0).collect()
        };
        let counting: Vec<_> = filters.rows().into_iter().map(counting).collect();
        let weight = |(lag, filter): (usize, usize)| {
            let term = |(bin, w): &(usize, f64)| w * cosines[bin * lag % n_transform];
            let sum: f64 = counting[filter].iter().map(term).sum();
            if lag == 0 { sum } else { 2.0 * sum }
        };
        let weights = Array2::from_shape_fn((window.len(), filters.nrows()), weight);
        let largest = |column: ArrayView1<'_, f64>| column.iter().map(|w| w.abs()).sum::<f64>();
        let trusted = weights.columns().into_iter().map(|c| TRUSTED_SHARE * largest(c)).collect();
        Self { window: window.to_vec(), weights, trusted }
    }

    /// Fills `sums` (`frames × filters`, rows one after the other) for the frames that begin every `hop` samples of
    /// `signal`, and gives back the indices of those frames that it cannot be trusted with.
    pub(super) fn fill(&self, signal: &[f64], hop: usize, sums: &mut ArrayViewMut2<'_, f64>) -> Vec<usize> {
        let n_lags = self.window.len();
        let mut lags = vec![0.0; n_lags * BLOCK];
        let mut windowed = vec![[0.0; LANES]; n_lags];
        let arch = Arch::new();
        let mut doubtful = Vec::new();
        for (block_idx, mut block) in sums.axis_chunks_iter_mut(Axis(0), BLOCK).enumerate() {
            let first = block_idx * BLOCK;
            let n_block = block.nrows();
            let from = &signal[first * hop..];
            arch.dispatch(Products {
                signal: from,
                hop,
                n_block,
                window: &self.window,
                windowed: &mut windowed,
                lags: &mut lags,
            });
            let Ok(of_block) = ArrayView2::from_shape((n_lags, BLOCK), &lags) else {
                unreachable!("the lags were made for this shape")
            };
            let of_block = of_block.slice_axis_move(Axis(1), Slice::from(..n_block));
            general_mat_mul(1.0, &of_block.t(), &self.weights, 0.0, &mut block);
            let Some(block) = block.as_slice() else {
                unreachable!("rows of a matrix in its standard order follow each other")
            };
            let rows = block.chunks_exact(self.trusted.len());
            for (i, (row, energy)) in rows.zip(&lags[..n_block]).enumerate() {
                let is_doubtful = |(sum, least): (&f64, &f64)| *sum < energy * least;
                // Counted to the end: a loop that may stop early is not worked on several values at once.
                let n_doubtful: u32 =
                    row.iter().zip(&self.trusted).map(|pair| u32::from(is_doubtful(pair))).sum();
                if n_doubtful > 0 {
                    doubtful.push(first + i);
                }
            }
        }
        doubtful
    }
}

/// The lags of the `n_block` frames that begin every `hop` samples of `signal`: `lags × BLOCK`.
struct Products<'a> {
    signal: &'a [f64],
    hop: usize,
    n_block: usize,
    window: &'a [f64],
    /// Room for the samples of [`LANES`] frames.
    windowed: &'a mut [[f64; LANES]],
    lags: &'a mut [f64],
}

impl WithSimd for Products<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "what is not inlined is compiled for any machine")]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { signal, hop, n_block, window, windowed, lags } = self;
        for offset in (0..n_block).step_by(LANES) {
            for lane in 0..LANES.min(n_block - offset) {
                let frame = &signal[(offset + lane) * hop..][..window.len()];
                for ((samples, x), w) in windowed.iter_mut().zip(frame).zip(window) {
                    samples[lane] = w * x;
                }
            }
            for (lag, row) in lags.chunks_exact_mut(BLOCK).enumerate() {
                // `Σ y[t] y[t + lag]` of every lane.
                let mut sums = [0.0; LANES];
                for (now, later) in windowed.iter().zip(&windowed[lag..]) {
                    for (sum, (a, b)) in sums.iter_mut().zip(now.iter().zip(later)) {
                        *sum += a * b;
                    }
                }
                row[offset..offset + LANES].copy_from_slice(&sums);
            }
        }
    }
}
