//! Filter bank outputs of many short frames, computed from their autocorrelations.
//!
//! The power of a frame `y` of `n` samples at the angular frequency `ω` is `r₀ + 2 Σ r_l cos(ω l)` with
//! `r_l = Σ y[t] y[t + l]`. A sum over bins is therefore a weighted sum over the `n` lags, and no spectrum is computed.
//! For 25 samples this takes 325 products for the lags and 25 for each filter; a transform of 256 samples takes
//! thousands.

use std::f64::consts::TAU;

use ndarray::linalg::general_mat_mul;
use ndarray::{Array2, ArrayView1, ArrayView2, ArrayViewMut2, Axis, Slice};
use pulp::{Arch, Simd, WithSimd};

/// Longest frame for which this method is faster than a Fourier transform.
pub(super) const MAX_FRAME: usize = 48;

/// Number of frames whose products are computed in parallel, and number of frames in one block.
const LANES: usize = 16;
pub(super) const BLOCK: usize = 16 * LANES;

/// Smallest filter output that is accurate enough, relative to the largest possible sum of its terms. Rounding errors
/// of about 1e-16 are then at most 1e-10 of the output. Frames below this limit in any filter are recomputed by the
/// Fourier transform, which adds squares.
const TRUSTED_SHARE: f64 = 1e-6;

/// Filter bank as weights of autocorrelation lags.
#[derive(Clone)]
pub(super) struct LagFilters {
    window: Vec<f64>,
    /// `lags × filters`.
    weights: Array2<f64>,
    /// Smallest accurate output of each filter for a frame of unit energy.
    trusted: Vec<f64>,
}

impl LagFilters {
    /// Converts `filters`, one row of bin weights for each filter, to lag weights.
    pub(super) fn new(window: &[f64], n_transform: usize, filters: &Array2<f64>) -> Self {
        let cosines: Vec<f64> =
            (0..n_transform).map(|i| (TAU * i as f64 / n_transform as f64).cos()).collect();
        // Most bins belong to at most two filters.
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

    /// Fills `sums` (`frames × filters`, contiguous rows) for the frames that start every `hop` samples of `signal`.
    /// Returns the indices of the frames whose outputs are not accurate enough.
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
                unreachable!("the lag buffer has this shape")
            };
            let of_block = of_block.slice_axis_move(Axis(1), Slice::from(..n_block));
            general_mat_mul(1.0, &of_block.t(), &self.weights, 0.0, &mut block);
            let Some(block) = block.as_slice() else {
                unreachable!("a matrix in standard layout is contiguous")
            };
            let rows = block.chunks_exact(self.trusted.len());
            for (i, (row, energy)) in rows.zip(&lags[..n_block]).enumerate() {
                let is_doubtful = |(sum, least): (&f64, &f64)| *sum < energy * least;
                // Counts all values: a loop with an early exit is not vectorized.
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

/// Autocorrelation lags, `lags × BLOCK`, of the `n_block` frames that start every `hop` samples of `signal`.
struct Products<'a> {
    signal: &'a [f64],
    hop: usize,
    n_block: usize,
    window: &'a [f64],
    /// Buffer for the windowed samples of [`LANES`] frames.
    windowed: &'a mut [[f64; LANES]],
    lags: &'a mut [f64],
}

impl WithSimd for Products<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "code that is not inlined is compiled for the baseline CPU")]
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
                // `Σ y[t] y[t + lag]` for each lane.
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
