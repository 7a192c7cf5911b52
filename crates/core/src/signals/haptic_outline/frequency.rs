//! Spectral centroids of short windows.

use std::sync::Arc;

use realfft::{RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;

use super::windows::{LONGEST_SECS, Windows};
use crate::dsp::spectrum::{centroid, hann};
use crate::units::Hertz;

/// Band of the frequencies that skin feels.
const BAND: [Hertz; 2] = [Hertz(10.0), Hertz(1000.0)];

/// Centroids of the windows of one signal.
pub(super) struct Centroids {
    fft: Arc<dyn RealToComplex<f64>>,
    hann: Vec<f64>,
    input: Vec<f64>,
    bins: Vec<Complex<f64>>,
    /// Power of each frequency.
    power: Vec<(Hertz, f64)>,
}

impl Centroids {
    /// For signals of this length; `None` if that is too short for a spectrum.
    pub(super) fn new(n_samples: usize, rate: Hertz) -> Option<Self> {
        let n_window = ((LONGEST_SECS * rate.0).round() as usize).min(n_samples);
        if n_window < 4 {
            return None;
        }
        let fft = RealFftPlanner::<f64>::new().plan_fft_forward(n_window);
        let (input, bins) = (fft.make_input_vec(), fft.make_output_vec());
        let power = (0..bins.len()).map(|i| (Hertz(i as f64 * rate.0 / n_window as f64), 0.0)).collect();
        Some(Self { fft, hann: hann(n_window), input, bins, power })
    }

    /// Power-weighted mean frequency around a time of a signal; `None` without power in the band.
    pub(super) fn at(&mut self, signal: &Windows<'_>, time_secs: f64) -> Option<Hertz> {
        let n_window = self.hann.len();
        let window = signal.around_secs(n_window, time_secs);
        let mean = window.iter().map(|x| f64::from(*x)).sum::<f64>() / n_window as f64;
        for ((input, x), w) in self.input.iter_mut().zip(window).zip(&self.hann) {
            *input = (f64::from(*x) - mean) * w;
        }
        // The buffers have the lengths of the plan, so the transform cannot fail.
        self.fft.process(&mut self.input, &mut self.bins).ok()?;
        for ((_, power), bin) in self.power.iter_mut().zip(&self.bins) {
            *power = bin.norm_sqr();
        }
        let [low, high] = BAND;
        let found = centroid(&self.power, low, high);
        (found.0 > 0.0).then_some(found)
    }
}
