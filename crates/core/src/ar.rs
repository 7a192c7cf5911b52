//! Autoregressive models of a stationary signal: fitting, order, power, spectrum.
//!
//! `A(z) = 1 + Σ a_k z^-k`, `x[n] = -Σ a_k x[n-k] + e[n]`, `e ~ N(0, σ²)`. Coefficient slices leave the leading one out:
//! `ar[0]` is `a_1`.

mod burg;
mod lags;
mod side_by_side;
mod varying;

use std::f64::consts::TAU;

pub use crate::ar::burg::burg;
pub(crate) use crate::ar::lags::sum_of;
pub(crate) use crate::ar::varying::{Part, burg_varying};

use crate::ar::lags::lag_sums;
pub(crate) use crate::ar::side_by_side::{SIDE_BY_SIDE, levinson_side_by_side};
use crate::units::Hertz;

/// A predictor fitted to a signal.
#[derive(Clone, Debug, PartialEq)]
pub struct ArFit {
    /// `a_1 … a_p`.
    pub ar: Vec<f64>,
    /// Variance σ² of the excitation, in the signal's unit squared.
    pub variance: f64,
    /// Residual variance of every order from 0 to p.
    pub variance_by_order: Vec<f64>,
}

/// Why a signal has no predictor.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ArError {
    /// Too short for the order.
    #[error("a model of order {order} needs more than {order} samples, got {len}")]
    TooShort {
        /// The order asked for.
        order: usize,
        /// The samples given.
        len: usize,
    },
    /// A sample is not finite.
    #[error("sample {index} is not a finite number")]
    NotFinite {
        /// Its index.
        index: usize,
    },
    /// The signal is constant: there is nothing to predict.
    #[error("the signal is constant")]
    Constant,
}

/// The predictor of order `order` by the Yule-Walker equations on the biased autocorrelation, which makes it stable.
///
/// # Errors
/// See [`ArError`].
pub fn yule_walker(signal: &[f64], order: usize) -> Result<ArFit, ArError> {
    let (x, energy) = centered(signal, order)?;
    let mut lags = lag_sums(&x, energy, order);
    let n = x.len() as f64;
    for lag in &mut lags {
        *lag /= n;
    }
    Ok(levinson(&lags, order))
}

/// The predictor of order `order` of an autocorrelation from lag 0 to at least that order, by Levinson's recursion.
pub fn levinson(r: &[f64], order: usize) -> ArFit {
    let mut ar: Vec<f64> = Vec::with_capacity(order);
    let mut variance = r[0];
    let mut variance_by_order = Vec::with_capacity(order + 1);
    variance_by_order.push(variance);
    for i in 1..=order {
        let sum = r[i] + ar.iter().zip(r[1..i].iter().rev()).map(|(a, r)| a * r).sum::<f64>();
        let reflection = -sum / variance;
        step_up(&mut ar, reflection);
        variance *= 1.0 - reflection * reflection;
        variance_by_order.push(variance);
    }
    ArFit { ar, variance, variance_by_order }
}

/// The signal without its mean, and the sum of its squares.
fn centered(signal: &[f64], order: usize) -> Result<(Vec<f64>, f64), ArError> {
    if signal.len() <= order {
        return Err(ArError::TooShort { order, len: signal.len() });
    }
    let mean = sum_of(signal, |v| v) / signal.len() as f64;
    // A sum that is finite has only finite terms.
    if !mean.is_finite()
        && let Some(index) = signal.iter().position(|v| !v.is_finite())
    {
        return Err(ArError::NotFinite { index });
    }
    let x: Vec<f64> = signal.iter().map(|v| v - mean).collect();
    let energy = sum_of(&x, |v| v * v);
    if energy == 0.0 { Err(ArError::Constant) } else { Ok((x, energy)) }
}

/// Levinson's update: a predictor of one order more from its last reflection coefficient.
fn step_up(ar: &mut Vec<f64>, reflection: f64) {
    // In place, from both ends: each pair needs only itself.
    let n = ar.len();
    for j in 0..n.div_ceil(2) {
        let (x, y) = (ar[j], ar[n - 1 - j]);
        (ar[j], ar[n - 1 - j]) = (x + reflection * y, y + reflection * x);
    }
    ar.push(reflection);
}

/// The order in `range` that the Bayesian information criterion `n ln E + p ln n` prefers.
pub fn order_by_bic(fit: &ArFit, n_samples: usize, range: std::ops::RangeInclusive<usize>) -> usize {
    let n = n_samples as f64;
    let bic = |p: usize| n * fit.variance_by_order[p].max(f64::MIN_POSITIVE).ln() + p as f64 * n.ln();
    let last = (*range.end()).min(fit.variance_by_order.len() - 1);
    (*range.start()..=last).min_by(|a, b| bic(*a).total_cmp(&bic(*b))).unwrap_or(last)
}

/// Variance of the process for an excitation of variance one, `1 / Π (1 - k_i²)`, by stepping the order down;
/// infinite where the predictor is not stable.
pub fn power_gain(ar: &[f64]) -> f64 {
    let mut a = ar.to_vec();
    let mut gain = 1.0;
    while let Some(k) = a.pop() {
        let left = 1.0 - k * k;
        if left <= 0.0 || left.is_nan() {
            return f64::INFINITY;
        }
        gain /= left;
        // In place, from both ends: each pair needs only itself.
        let n = a.len();
        for j in 0..n.div_ceil(2) {
            let (x, y) = (a[j], a[n - 1 - j]);
            (a[j], a[n - 1 - j]) = ((x - k * y) / left, (y - k * x) / left);
        }
    }
    gain
}

/// The transfer function `1 / A(e^{jω})` at each frequency, as (real, imaginary).
pub fn response(ar: &[f64], rate: Hertz, frequencies: &[Hertz]) -> Vec<(f64, f64)> {
    let one = |f: &Hertz| {
        let (sin, cos) = (TAU * f.0 / rate.0).sin_cos();
        // Horner in z^-1 = cos - j sin, from the highest coefficient down.
        let (mut re, mut im) = (0.0, 0.0);
        for a in ar.iter().rev().chain(std::iter::once(&1.0)) {
            (re, im) = (re * cos + im * sin + a, im * cos - re * sin);
        }
        let square = re * re + im * im;
        (re / square, -im / square)
    };
    frequencies.iter().map(one).collect()
}

/// One-sided power spectral density `2 σ² / (rate |A|²)` at each frequency, in the signal's unit squared per Hz: its
/// integral from zero to half the rate is the variance of the process.
pub fn psd(ar: &[f64], variance: f64, rate: Hertz, frequencies: &[Hertz]) -> Vec<f64> {
    let scale = 2.0 * variance / rate.0;
    response(ar, rate, frequencies).into_iter().map(|(re, im)| scale * (re * re + im * im)).collect()
}

/// `n` frequencies from 5 Hz to 0.999 of the Nyquist frequency: the grid on which models are compared.
pub fn comparison_frequencies(rate: Hertz, n: usize) -> Vec<Hertz> {
    let (low, high) = (5.0, 0.999 * rate.0 / 2.0);
    let step = if n > 1 { (high - low) / (n - 1) as f64 } else { 0.0 };
    (0..n).map(|i| Hertz(low + step * i as f64)).collect()
}

/// Predictors that tests know the answer for.
#[cfg(test)]
pub(crate) mod test_signals {
    use crate::units::Hertz;
    use std::f64::consts::TAU;

    /// The predictor with poles at `radius e^{±j 2π f / rate}` for each (frequency, radius).
    pub(crate) fn from_resonances(rate: Hertz, resonances: &[(Hertz, f64)]) -> Vec<f64> {
        let factor = |(f, r): &(Hertz, f64)| [1.0, -2.0 * r * (TAU * f.0 / rate.0).cos(), r * r];
        resonances.iter().map(factor).fold(vec![1.0], |poly, f| convolve(&poly, &f)).split_off(1)
    }

    /// The product of two polynomials.
    fn convolve(a: &[f64], b: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; a.len() + b.len() - 1];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate() {
                out[i + j] += x * y;
            }
        }
        out
    }
}

#[cfg(test)]
mod tests;
