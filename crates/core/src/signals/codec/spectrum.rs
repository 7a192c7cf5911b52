//! LPC analysis of a frame: its spectral envelope as line spectral frequencies.

use std::f64::consts::{PI, TAU};

use super::{CODEC_RATE, FRAME_SAMPLES, LOOK_AHEAD_SAMPLES, ORDER};
use crate::dsp::ar::levinson;
use crate::dsp::lsf::lsf_from_ar;
use crate::maths::statistics::dot;

/// Samples of the analysis window: a frame plus the look-ahead on both sides.
pub(super) const WINDOW_SAMPLES: usize = FRAME_SAMPLES + 2 * LOOK_AHEAD_SAMPLES;
/// Lag window width in Hz, and the white-noise correction factor.
const SMOOTHING_HZ: f64 = 15.0;
const WHITE: f64 = 1.0001;
/// Bandwidth expansion: the k-th coefficient is scaled by this to the power of k.
const WIDENING: f64 = 0.985;
/// Energy below which a window counts as silent.
const SILENCE: f64 = 1e-9;

/// One set of line spectral frequencies, in radians per sample.
pub(super) type Lsf = [f64; ORDER];

/// Frequencies of a flat spectrum, used for silence: evenly spaced.
pub(super) fn flat() -> Lsf {
    std::array::from_fn(|i| PI * (i + 1) as f64 / (ORDER + 1) as f64)
}

/// Bandwidth expansion `A(z/factor)`.
pub(super) fn widen(ar: &mut [f64], factor: f64) {
    let mut power = 1.0;
    for a in ar {
        power *= factor;
        *a *= power;
    }
}

/// Measures the line spectral frequencies of frames.
#[derive(Clone, Debug)]
pub(super) struct SpectrumMeter {
    hamming: [f64; WINDOW_SAMPLES],
    lag_window: [f64; ORDER + 1],
}

impl SpectrumMeter {
    pub(super) fn new() -> Self {
        let angle = |i: usize| TAU * i as f64 / (WINDOW_SAMPLES - 1) as f64;
        let smoothed = |k: usize| (-0.5 * (TAU * SMOOTHING_HZ * k as f64 / CODEC_RATE.0).powi(2)).exp();
        let mut lag_window: [f64; ORDER + 1] = std::array::from_fn(smoothed);
        lag_window[0] = WHITE;
        Self { hamming: std::array::from_fn(|i| 0.54 - 0.46 * angle(i).cos()), lag_window }
    }

    /// Returns the frequencies of the frame at the center of a window.
    pub(super) fn measure(&self, window: &[f64; WINDOW_SAMPLES]) -> Lsf {
        let shaped: [f64; WINDOW_SAMPLES] = std::array::from_fn(|i| window[i] * self.hamming[i]);
        let r: [f64; ORDER + 1] =
            std::array::from_fn(|k| self.lag_window[k] * dot(&shaped[..WINDOW_SAMPLES - k], &shaped[k..]));
        if r[0] < SILENCE {
            return flat();
        }
        let mut ar = levinson(&r, ORDER).ar;
        widen(&mut ar, WIDENING);
        match lsf_from_ar(&ar).and_then(|lsf| lsf.try_into().ok()) {
            Some(lsf) => lsf,
            // Numerically at the limit of stability: a flat spectrum is safer than a wrong one.
            None => flat(),
        }
    }
}
