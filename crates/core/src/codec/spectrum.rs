//! The spectrum of a frame as line spectral frequencies.

use std::f64::consts::{PI, TAU};

use super::{CODEC_RATE, FRAME_SAMPLES, LOOK_AHEAD_SAMPLES, ORDER};
use crate::ar::levinson;
use crate::lsf::lsf_from_ar;
use crate::statistics::dot;

/// Samples of the window around a frame: as many before it as are looked ahead.
pub(super) const WINDOW_SAMPLES: usize = FRAME_SAMPLES + 2 * LOOK_AHEAD_SAMPLES;
/// Width in Hz of what smooths the spectrum, and the share of white noise that is added.
const SMOOTHING_HZ: f64 = 15.0;
const WHITE: f64 = 1.0001;
/// How much resonances are widened: the k-th coefficient by this to the power of k.
const WIDENING: f64 = 0.985;
/// Power of a window below which it is silence.
const SILENCE: f64 = 1e-9;

/// One set of line spectral frequencies.
pub(super) type Lsf = [f64; ORDER];

/// The frequencies of silence, which has none: evenly spaced.
pub(super) fn flat() -> Lsf {
    std::array::from_fn(|i| PI * (i + 1) as f64 / (ORDER + 1) as f64)
}

/// `A(z/factor)`: resonances are widened.
pub(super) fn widen(ar: &mut [f64], factor: f64) {
    let mut power = 1.0;
    for a in ar {
        power *= factor;
        *a *= power;
    }
}

/// Finds the frequencies of frames.
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

    /// The frequencies of the frame in the middle of a window.
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
            // So nearly unstable that digits do not tell: no spectrum is better than a wrong one.
            None => flat(),
        }
    }
}
