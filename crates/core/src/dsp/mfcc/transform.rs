//! Filter bank outputs from the Fourier transform of each frame; valid for every frame length and spectrum type.

use std::sync::Arc;

use ndarray::{Array2, ArrayView1};
use realfft::num_complex::Complex;
use realfft::{RealFftPlanner, RealToComplex};

/// Window, Fourier transform and filter bank for one frame.
#[derive(Clone)]
pub(super) struct Transform {
    fft: Arc<dyn RealToComplex<f64>>,
    window: Vec<f64>,
    /// Index of the first non-zero bin of each filter, and the weights from that bin on.
    filters: Vec<(usize, Vec<f64>)>,
    is_magnitude: bool,
}

/// Work buffers for one transform.
pub(super) struct Scratch {
    input: Vec<f64>,
    bins: Vec<Complex<f64>>,
    work: Vec<Complex<f64>>,
    spectrum: Vec<f64>,
}

impl Transform {
    /// `filters` has one row of bin weights for each filter.
    pub(super) fn new(window: &[f64], n_transform: usize, filters: &Array2<f64>, is_magnitude: bool) -> Self {
        let weights = |row: ArrayView1<'_, f64>| {
            let all = row.to_vec();
            let first = all.iter().position(|w| *w != 0.0).unwrap_or(0);
            let end = all.iter().rposition(|w| *w != 0.0).map_or(first, |last| last + 1);
            (first, all[first..end].to_vec())
        };
        Self {
            fft: RealFftPlanner::new().plan_fft_forward(n_transform),
            window: window.to_vec(),
            filters: filters.rows().into_iter().map(weights).collect(),
            is_magnitude,
        }
    }

    pub(super) fn scratch(&self) -> Scratch {
        let bins = self.fft.make_output_vec();
        Scratch {
            input: self.fft.make_input_vec(),
            spectrum: vec![0.0; bins.len()],
            bins,
            work: self.fft.make_scratch_vec(),
        }
    }

    /// Writes each filter's output for the spectrum of `frame` to `sums`. The frame must have the length of the window.
    pub(super) fn sums(&self, frame: &[f64], scratch: &mut Scratch, sums: &mut [f64]) {
        let Scratch { input, bins, work, spectrum } = scratch;
        let (head, tail) = input.split_at_mut(self.window.len());
        for ((x, s), w) in head.iter_mut().zip(frame).zip(&self.window) {
            *x = s * w;
        }
        tail.fill(0.0);
        if let Err(error) = self.fft.process_with_scratch(input, bins, work) {
            unreachable!("the buffers have the lengths that the plan requires: {error}");
        }
        for (value, bin) in spectrum.iter_mut().zip(bins.iter()) {
            *value = bin.norm_sqr();
        }
        if self.is_magnitude {
            for value in spectrum.iter_mut() {
                *value = value.sqrt();
            }
        }
        for (sum, (first, weights)) in sums.iter_mut().zip(&self.filters) {
            *sum = spectrum[*first..].iter().zip(weights).map(|(s, w)| s * w).sum();
        }
    }
}
