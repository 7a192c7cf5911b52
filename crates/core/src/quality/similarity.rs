//! Measures of similarity that others use, to be compared with: ST-SIM and SPQI, as their published code computes them.
//!
//! Both are facts about two signals in blocks of 64 ms, 512 samples at the 8 kHz that they were made for; here the block
//! is as long in time at every rate.

use realfft::RealFftPlanner;
use statrs::distribution::{ContinuousCDF as _, Normal};

use crate::statistics::dot;
use crate::threshold::{Threshold, displacement_db_um};
use crate::units::Hertz;

/// Length of a block in s.
const BLOCK_SECS: f64 = 0.064;
/// Standard deviation of the psychometric function over level, in dB.
const SPREAD_DB: f64 = 12.0;
/// Level below which nothing is told apart from nothing, in dB re threshold.
const LEAST_DB: f64 = -100.0;

/// ST-SIM `= T^(2/3) S^(1/3)`, 0 to 1: T is the mean correlation of blocks in time, S that of the chances that the level of
/// each frequency is felt. 1 for equal signals; `None` where they are shorter than a block or of different lengths.
pub fn st_sim(reference: &[f64], other: &[f64], rate: Hertz, threshold: &Threshold) -> Option<f64> {
    let normal = Normal::standard();
    let felt = |level: &f64| normal.cdf(level / SPREAD_DB);
    let (mut time, mut spectrum, mut n) = (0.0, 0.0, 0.0);
    for (a, b) in blocks(reference, other, rate)? {
        let [x, y] =
            [a, b].map(|block| levels(block, rate, threshold).iter().map(felt).collect::<Vec<f64>>());
        time += likeness(a, b).max(0.0);
        spectrum += likeness(&x, &y);
        n += 1.0;
    }
    Some((time / n).powf(2.0 / 3.0) * (spectrum / n).cbrt())
}

/// SPQI `= mean (1 - tanh(0.3 d + 2)) / 2`, 0 to 1, where `d` is how far the spectra of a block lie apart in what is felt of
/// them, in dB relative to the reference. 1 for equal signals; `None` as for [`st_sim`].
pub fn spqi(reference: &[f64], other: &[f64], rate: Hertz, threshold: &Threshold) -> Option<f64> {
    let felt = |level: &f64| level.max(0.0);
    let (mut sum, mut n) = (0.0, 0.0);
    for (a, b) in blocks(reference, other, rate)? {
        let [x, y] =
            [a, b].map(|block| levels(block, rate, threshold).iter().map(felt).collect::<Vec<f64>>());
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
    rate: Hertz,
) -> Option<impl Iterator<Item = (&'a [f64], &'a [f64])>> {
    let n_block = (BLOCK_SECS * rate.0).round() as usize;
    let is_enough = n_block >= 2 && a.len() == b.len() && a.len() >= n_block;
    is_enough.then(|| a.chunks_exact(n_block).zip(b.chunks_exact(n_block)))
}

/// `Σab / √(Σa² Σb²)`; 1 of two silences, 0 of one.
fn likeness(a: &[f64], b: &[f64]) -> f64 {
    let norm = (dot(a, a) * dot(b, b)).sqrt();
    if norm > 0.0 { dot(a, b) / norm } else { f64::from(u8::from(a == b)) }
}

/// Level of each frequency but zero, in dB over the threshold.
fn levels(block: &[f64], rate: Hertz, threshold: &Threshold) -> Vec<f64> {
    let n = block.len();
    let forward = RealFftPlanner::<f64>::new().plan_fft_forward(n);
    let (mut samples, mut bins) = (block.to_vec(), forward.make_output_vec());
    let done = forward.process(&mut samples, &mut bins);
    debug_assert!(done.is_ok(), "the lengths are those of the plan");
    let level = |(k, bin): (usize, &rustfft::num_complex::Complex<f64>)| {
        let frequency = Hertz(k as f64 * rate.0 / n as f64);
        let db = displacement_db_um(frequency, 2.0 * bin.norm() / n as f64);
        (db - threshold.displacement_db_um(frequency)).max(LEAST_DB)
    };
    bins.iter().enumerate().skip(1).map(level).collect()
}
