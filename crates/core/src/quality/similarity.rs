//! Measures of similarity that others use, to be compared with: the ratio of signal to noise, and ST-SIM and SPQI, as we
//! read what is published of them.
//!
//! The latter look at two signals in blocks of 64 ms, 512 samples at the 8 kHz that they were made for; here the block is as
//! long in time at every rate.

use std::sync::Arc;

use realfft::{RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
use statrs::distribution::{ContinuousCDF as _, Normal};

use crate::quality::real_transform::bins_of;
use crate::statistics::dot;
use crate::threshold::{Threshold, displacement_db_um};
use crate::units::Hertz;

/// Length of a block in s.
const BLOCK_SECS: f64 = 0.064;
/// Standard deviation of the psychometric function over level, in dB.
const SPREAD_DB: f64 = 12.0;
/// Level below which nothing is told apart from nothing, in dB re threshold.
const LEAST_DB: f64 = -100.0;

/// How far the signal lies over what another differs by, in dB: `10 log₁₀(Σ x² / Σ (x - y)²)`; infinite where they are equal, and
/// minus infinity where the signal is silent and the other is not.
///
/// # Panics
/// If the lengths differ.
pub fn snr_db(signal: &[f64], other: &[f64]) -> f64 {
    assert_eq!(signal.len(), other.len(), "signals are compared sample by sample");
    let noise: f64 = signal.iter().zip(other).map(|(x, y)| (x - y).powi(2)).sum();
    let power: f64 = signal.iter().map(|x| x * x).sum();
    if noise == 0.0 { f64::INFINITY } else { 10.0 * (power / noise).log10() }
}

/// ST-SIM `= T^(2/3) S^(1/3)`, 0 to 1: T is the mean correlation of blocks in time, S that of the chances that the level of
/// each frequency is felt. 1 for equal signals; `None` where they are shorter than a block or of different lengths.
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

/// SPQI `= mean (1 - tanh(0.3 d + 2)) / 2`, 0 to 1, where `d` is how far the spectra of a block lie apart in what is felt of
/// them, in dB relative to the reference. 1 for equal signals; `None` as for [`st_sim`].
pub fn spqi(reference: &[f64], other: &[f64], rate: Hertz, threshold: &Threshold) -> Option<f64> {
    let felt = |level: f64| level.max(0.0);
    let levels = Levels::new(rate, threshold)?;
    let (mut sum, mut n) = (0.0, 0.0);
    for (a, b) in blocks(reference, other, levels.n_block())? {
        let [x, y] = [a, b].map(|block| levels.of(block, felt));
        let apart: f64 = x.iter().zip(&y).map(|(x, y)| (x - y).powi(2)).sum();
        let all = dot(&x, &x);
        // Of silence, all that is felt is apart.
        let ratio = if apart == 0.0 { 0.0 } else { apart / all };
        sum += 0.5 * (1.0 - (0.3 * 10.0 * ratio.log10() + 2.0).tanh());
        n += 1.0;
    }
    Some(sum / n)
}

/// Whole blocks of both; `None` where there are none.
fn blocks<'a>(
    a: &'a [f64],
    b: &'a [f64],
    n_block: usize,
) -> Option<impl Iterator<Item = (&'a [f64], &'a [f64])>> {
    let is_enough = a.len() == b.len() && a.len() >= n_block;
    is_enough.then(|| a.chunks_exact(n_block).zip(b.chunks_exact(n_block)))
}

/// `Σab / √(Σa² Σb²)`; 1 of two silences, 0 of one.
fn likeness(a: &[f64], b: &[f64]) -> f64 {
    let norm = (dot(a, a) * dot(b, b)).sqrt();
    if norm > 0.0 { dot(a, b) / norm } else { f64::from(u8::from(a == b)) }
}

/// The levels of the frequencies of a block, all but zero.
struct Levels {
    forward: Arc<dyn RealToComplex<f64>>,
    /// Level of a bin of magnitude 1, in dB over the threshold.
    of_one_db: Vec<f64>,
}

impl Levels {
    /// `None` where a block is no two samples.
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

    /// Samples of a block.
    fn n_block(&self) -> usize {
        self.forward.len()
    }

    /// What is `felt` of each level in dB over the threshold.
    fn of(&self, block: &[f64], felt: impl Fn(f64) -> f64) -> Vec<f64> {
        let bins = bins_of(&*self.forward, block);
        let level = |(bin, one_db): (&Complex<f64>, &f64)| 20.0 * bin.norm().log10() + one_db;
        bins[1..].iter().zip(&self.of_one_db).map(level).map(|db| felt(db.max(LEAST_DB))).collect()
    }
}
