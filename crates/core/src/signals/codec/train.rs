//! Training of the codec's tables on example signals.

use std::sync::Arc;

use super::bitrate::Bitrate;
use super::books::{Codebooks, GAIN_BITS, SplitTable, Tables};
use super::coded::of_unit_level;
use super::encoder::{Encoder, Products};
use super::spectrum::{Lsf, SpectrumMeter, WINDOW_SAMPLES};
use super::{FRAME_SAMPLES, SPLITS, least};
use crate::maths::rng::Random;

/// Iterations of Lloyd's algorithm.
const N_STEPS: usize = 30;
/// Initial range of the gains.
const LAGGED: (f64, f64) = (0.0, 1.0);
const FIXED: (f64, f64) = (0.18, 2.2);
/// Largest adaptive codebook gain: above one, decoding errors would grow.
const MOST_LAGGED: f64 = 1.0;

/// Reasons why training is not possible.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TrainError {
    /// The signals have too few frames.
    #[error("the training signals have {n_frames} frames, needs {needed}; add longer or more signals")]
    Few {
        /// Number of whole frames of all signals.
        n_frames: usize,
        /// Smallest number of frames.
        needed: usize,
    },
}

/// Smallest number of frames: several times the number of entries of the largest table.
const LEAST_FRAMES: usize = 256;

/// Returns tables trained on signals of [`super::CODEC_RATE`] at any level; deterministic for a seed.
///
/// Gains start on a grid. Each of the `n_rounds` rounds encodes with the gains of the round before and refits them.
///
/// # Errors
/// [`TrainError::Few`].
pub fn train(signals: &[Vec<f64>], n_rounds: usize, seed: u64) -> Result<Tables, TrainError> {
    let signals: Vec<Vec<f64>> = signals.iter().map(|signal| of_unit_level(signal).0).collect();
    let spectra: Vec<Lsf> = signals.iter().flat_map(|signal| spectra(signal)).collect();
    let n_frames = spectra.len();
    if n_frames < LEAST_FRAMES {
        return Err(TrainError::Few { n_frames, needed: LEAST_FRAMES });
    }
    let mut random = Random::new(seed);
    let mut lsf_mean = vec![0.0; spectra[0].len()];
    for lsf in &spectra {
        for (mean, w) in lsf_mean.iter_mut().zip(lsf) {
            *mean += w / n_frames as f64;
        }
    }
    let mut lsf: Vec<SplitTable> = Vec::new();
    for (split, (begin, end)) in SPLITS.into_iter().enumerate() {
        let parts: Vec<Vec<f64>> =
            spectra.iter().map(|lsf| (begin..end).map(|i| lsf[i] - lsf_mean[i]).collect()).collect();
        for n_bits in Bitrate::ALL.map(|rate| rate.allocation().lsf[split]) {
            if !lsf.iter().any(|table| (table.split, table.n_bits) == (split, n_bits)) {
                lsf.push(SplitTable { split, n_bits, entries: clusters(&parts, 1 << n_bits, &mut random) });
            }
        }
    }
    let mut tables = Tables { lsf_mean, lsf, gains: GAIN_BITS.map(first_gains).to_vec() };
    for _ in 0..n_rounds {
        let Ok(books) = Codebooks::new(tables.clone()) else {
            unreachable!("trained tables must have the required sizes")
        };
        let books = Arc::new(books);
        for (table, n_bits) in tables.gains.iter_mut().zip(GAIN_BITS) {
            let mut seen = Vec::new();
            for rate in Bitrate::ALL.into_iter().filter(|rate| rate.allocation().gain == n_bits) {
                for signal in &signals {
                    let look = |products: Products| seen.push(products);
                    Encoder::new(rate, Arc::clone(&books)).push_looking(signal, &mut Vec::new(), look);
                }
            }
            for _ in 0..N_STEPS {
                improve_gains(table, &seen);
            }
        }
    }
    Ok(tables)
}

/// Returns the line spectral frequencies of the whole frames of a signal.
fn spectra(signal: &[f64]) -> Vec<Lsf> {
    let meter = SpectrumMeter::new();
    let windows = signal.windows(WINDOW_SAMPLES).step_by(FRAME_SAMPLES);
    windows.filter_map(|window| window.try_into().ok()).map(|window| meter.measure(window)).collect()
}

/// Returns the centroids of `n` clusters (Lloyd's algorithm), initialized with random rows.
fn clusters(rows: &[Vec<f64>], n: usize, random: &mut Random) -> Vec<Vec<f64>> {
    let by_chance = |random: &mut Random| rows[random.below(rows.len())].clone();
    let mut means: Vec<Vec<f64>> = (0..n).map(|_| by_chance(random)).collect();
    for _ in 0..N_STEPS {
        let mut sums = vec![(vec![0.0; rows[0].len()], 0.0); n];
        for row in rows {
            let distance =
                |mean: &Vec<f64>| -> f64 { mean.iter().zip(row).map(|(m, x)| (m - x).powi(2)).sum() };
            let (sum, count) = &mut sums[least(means.iter().map(distance))];
            for (s, x) in sum.iter_mut().zip(row) {
                *s += x;
            }
            *count += 1.0;
        }
        means = sums
            .into_iter()
            .map(|(sum, count)| {
                // An empty cluster restarts at a random row.
                if count == 0.0 { by_chance(random) } else { sum.into_iter().map(|s| s / count).collect() }
            })
            .collect();
    }
    means
}

/// Returns an initial grid of gains, with fixed gains of both signs.
fn first_gains(n_bits: u32) -> Vec<[f64; 2]> {
    let n_lagged = if n_bits > 4 { 4 } else { 2 };
    let n_fixed = (1 << n_bits) / n_lagged;
    let between =
        |(low, high): (f64, f64), i: usize, n: usize| low + (high - low) * i as f64 / (n - 1) as f64;
    let mut gains = Vec::with_capacity(1 << n_bits);
    for i in 0..n_lagged {
        let lagged = between(LAGGED, i, n_lagged);
        for j in 0..n_fixed / 2 {
            let fixed = between((FIXED.0.ln(), FIXED.1.ln()), j, n_fixed / 2).exp();
            gains.extend([[lagged, fixed], [lagged, -fixed]]);
        }
    }
    gains
}

/// Replaces each gain pair by the least-squares optimum over the subframes that chose it, with equal weight at any
/// level.
fn improve_gains(gains: &mut [[f64; 2]], seen: &[Products]) {
    // Normal equations: both squares, their product, and both right-hand sides.
    let mut sums = vec![[0.0; 5]; gains.len()];
    for products in seen.iter().filter(|products| products.target > 0.0) {
        let weight = 1.0 / products.target;
        let sum = &mut sums[least(gains.iter().map(|gains| products.error(*gains)))];
        let terms =
            [products.lagged, products.both, products.fixed, products.target_lagged, products.target_fixed];
        for (s, term) in sum.iter_mut().zip(terms) {
            *s += weight * term;
        }
    }
    for (gains, [aa, ab, bb, ya, yb]) in gains.iter_mut().zip(sums) {
        let determinant = aa * bb - ab * ab;
        if determinant > 1e-9 * aa * bb {
            let lagged = ((ya * bb - yb * ab) / determinant).clamp(-MOST_LAGGED, MOST_LAGGED);
            *gains = [lagged, (yb - lagged * ab) / bb];
        } else if bb > 0.0 {
            gains[1] = (yb - gains[0] * ab) / bb;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{first_gains, improve_gains};
    use crate::maths::rng::Random;
    use crate::signals::codec::encoder::Products;
    use crate::signals::codec::least;

    /// No iteration raises the error, and the first lowers it clearly.
    #[test]
    fn gains_fit_better_step_by_step() {
        let mut random = Random::new(4);
        let mut seen = Vec::new();
        for _ in 0..400 {
            let [lagged, fixed] = [random.uniform(), random.normal()];
            let [energy, noise] = [random.log_normal(0.5), 0.1 * random.normal()];
            // A target with these gains, plus noise along both excitations.
            seen.push(Products {
                target: lagged * lagged * energy + fixed * fixed + 0.1,
                target_lagged: (lagged + noise) * energy,
                target_fixed: fixed + noise,
                lagged: energy,
                fixed: 1.0,
                both: 0.0,
            });
        }
        let left = |gains: &[[f64; 2]]| -> f64 {
            let of_one = |p: &Products| gains.iter().map(|g| p.error(*g)).fold(f64::MAX, f64::min) / p.target;
            seen.iter().map(of_one).sum()
        };
        let mut gains = first_gains(4);
        let mut before = left(&gains);
        let begun = before;
        for _ in 0..10 {
            improve_gains(&mut gains, &seen);
            let now = left(&gains);
            assert!(now <= before + 1e-9, "{now} after {before}");
            before = now;
        }
        assert!(before < 0.8 * begun, "{before} of {begun}");
        assert_eq!(least([3.0, 1.0, 1.0].into_iter()), 1);
    }
}
