//! Published similarity measures for comparison: signal-to-noise ratio, ST-SIM and SPQI.
//!
//! ST-SIM and SPQI are implemented as we read their publications. They use blocks of 64 ms, which are 512 samples at
//! their original rate of 8 kHz. Here a block has the same duration at every rate.

use std::sync::Arc;

use realfft::{RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
use statrs::distribution::{ContinuousCDF as _, Normal};

use crate::dsp::threshold::{Threshold, displacement_db_um};
use crate::maths::statistics::dot;
use crate::signals::quality::real_transform::bins_of;
use crate::units::Hertz;

/// Duration of a block, in s.
const BLOCK_SECS: f64 = 0.064;
/// Standard deviation of the psychometric function over level, in dB.
const SPREAD_DB: f64 = 12.0;
/// Floor of levels, in dB re threshold; it keeps the level of silence finite.
const LEAST_DB: f64 = -100.0;

/// Returns the signal-to-noise ratio in dB: `10 log₁₀(Σ x² / Σ (x - y)²)`.
///
/// It is infinite if both signals are equal, and minus infinity if `signal` is silent and `other` is not.
///
/// # Panics
/// If the lengths differ.
pub fn snr_db(signal: &[f64], other: &[f64]) -> f64 {
    assert_eq!(signal.len(), other.len(), "both signals must have the same length");
    let noise: f64 = signal.iter().zip(other).map(|(x, y)| (x - y).powi(2)).sum();
    let power: f64 = signal.iter().map(|x| x * x).sum();
    if noise == 0.0 { f64::INFINITY } else { 10.0 * (power / noise).log10() }
}

/// Returns ST-SIM `= T^(2/3) S^(1/3)`, from 0 to 1 (equal signals).
///
/// T is the mean correlation of blocks in time. S is the mean correlation of detection probabilities over frequency.
/// `None` if the signals are shorter than a block or differ in length.
pub fn st_sim(reference: &[f64], other: &[f64], rate: Hertz, threshold: &Threshold) -> Option<f64> {
    let normal = Normal::standard();
    let felt = |level: f64| normal.cdf(level / SPREAD_DB);
    let levels = Levels::new(rate, threshold)?;
    let (mut time, mut spectrum, mut n) = (0.0, 0.0, 0.0);
    for (a, b) in blocks(reference, other, levels.n_block())? {
        let [x, y] = [a, b].map(|block| levels.of(block, felt));
        time += likeness(a, b).max(0.0);
        spectrum += likeness(&x, &y);
        n += 1.0;
    }
    Some((time / n).powf(2.0 / 3.0) * (spectrum / n).cbrt())
}

/// Returns SPQI `= mean (1 - tanh(0.3 d + 2)) / 2`, from 0 to 1 (equal signals).
///
/// `d` is the distance in dB of the block spectra above threshold, relative to the reference. `None` if the signals are
/// shorter than a block or differ in length.
pub fn spqi(reference: &[f64], other: &[f64], rate: Hertz, threshold: &Threshold) -> Option<f64> {
    let felt = |level: f64| level.max(0.0);
    let levels = Levels::new(rate, threshold)?;
    let (mut sum, mut n) = (0.0, 0.0);
    for (a, b) in blocks(reference, other, levels.n_block())? {
        let [x, y] = [a, b].map(|block| levels.of(block, felt));
        let apart: f64 = x.iter().zip(&y).map(|(x, y)| (x - y).powi(2)).sum();
        let all = dot(&x, &x);
        // For a silent reference the ratio is infinite.
        let ratio = if apart == 0.0 { 0.0 } else { apart / all };
        sum += 0.5 * (1.0 - (0.3 * 10.0 * ratio.log10() + 2.0).tanh());
        n += 1.0;
    }
    Some(sum / n)
}

/// Returns the whole blocks of both signals; `None` if there are none or the lengths differ.
fn blocks<'a>(
    a: &'a [f64],
    b: &'a [f64],
    n_block: usize,
) -> Option<impl Iterator<Item = (&'a [f64], &'a [f64])>> {
    let is_enough = a.len() == b.len() && a.len() >= n_block;
    is_enough.then(|| a.chunks_exact(n_block).zip(b.chunks_exact(n_block)))
}

/// Returns `Σab / √(Σa² Σb²)`; 1 if both are equal and silent, 0 if only one is silent.
fn likeness(a: &[f64], b: &[f64]) -> f64 {
    let norm = (dot(a, a) * dot(b, b)).sqrt();
    if norm > 0.0 { dot(a, b) / norm } else { f64::from(u8::from(a == b)) }
}

/// Levels of the spectral bins of a block, without DC.
struct Levels {
    forward: Arc<dyn RealToComplex<f64>>,
    /// Level of a bin of unit magnitude, in dB re threshold.
    of_one_db: Vec<f64>,
}

impl Levels {
    /// Returns `None` if a block has fewer than two samples.
    fn new(rate: Hertz, threshold: &Threshold) -> Option<Self> {
        let n = (BLOCK_SECS * rate.0).round() as usize;
        if n < 2 {
            return None;
        }
        let of_one_db = |k: usize| {
            let frequency = Hertz(k as f64 * rate.0 / n as f64);
            displacement_db_um(frequency, 2.0 / n as f64) - threshold.displacement_db_um(frequency)
        };
        Some(Self {
            forward: RealFftPlanner::new().plan_fft_forward(n),
            of_one_db: (1..=n / 2).map(of_one_db).collect(),
        })
    }

    /// Returns the samples per block.
    fn n_block(&self) -> usize {
        self.forward.len()
    }

    /// Returns `felt` of each level, in dB re threshold.
    fn of(&self, block: &[f64], felt: impl Fn(f64) -> f64) -> Vec<f64> {
        let bins = bins_of(&*self.forward, block);
        let level = |(bin, one_db): (&Complex<f64>, &f64)| 20.0 * bin.norm().log10() + one_db;
        bins[1..].iter().zip(&self.of_one_db).map(level).map(|db| felt(db.max(LEAST_DB))).collect()
    }
}
