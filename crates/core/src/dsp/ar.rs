//! Autoregressive (AR) models of a stationary signal: estimation, order selection, power and spectrum.
//!
//! `A(z) = 1 + Σ a_k z^-k`, `x[n] = -Σ a_k x[n-k] + e[n]`, `e ~ N(0, σ²)`. Coefficient slices omit the leading one:
//! `ar[0]` is `a_1`.

mod burg;
mod side_by_side;
mod varying;

use std::f64::consts::TAU;

pub use crate::dsp::ar::burg::burg;
pub(crate) use crate::dsp::ar::varying::{Part, burg_varying};

pub(crate) use crate::dsp::ar::side_by_side::{SIDE_BY_SIDE, levinson_side_by_side};
use crate::maths::sums::{lag_sums, sum_of};
use crate::units::Hertz;

/// AR model fitted to a signal.
#[derive(Clone, Debug, PartialEq)]
pub struct ArFit {
    /// Linear prediction coefficients `a_1 … a_p`.
    pub ar: Vec<f64>,
    /// Excitation variance σ², in the squared unit of the signal.
    pub variance: f64,
    /// Residual variance for each order from 0 to p.
    pub variance_by_order: Vec<f64>,
}

/// Error of fitting an AR model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ArError {
    /// The signal is too short for the model order.
    #[error("an AR model of order {order} needs more than {order} samples, got {len}")]
    TooShort {
        /// Requested model order.
        order: usize,
        /// Number of samples.
        len: usize,
    },
    /// A sample is not finite.
    #[error("sample {index} is not finite; remove or correct it")]
    NotFinite {
        /// Index of the sample.
        index: usize,
    },
    /// The signal is constant, so there is nothing to predict.
    #[error("the signal is constant; an AR model needs a signal that varies")]
    Constant,
}

/// Fits an AR model by the Yule-Walker equations with the biased autocorrelation, which guarantees stability.
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

/// AR model of an autocorrelation sequence by the Levinson-Durbin recursion. `r` holds lag 0 to at least lag `order`.
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

/// Signal minus its mean, and its energy.
fn centered(signal: &[f64], order: usize) -> Result<(Vec<f64>, f64), ArError> {
    if signal.len() <= order {
        return Err(ArError::TooShort { order, len: signal.len() });
    }
    let mean = sum_of(signal, |v| v) / signal.len() as f64;
    // A finite sum has only finite terms.
    if !mean.is_finite()
        && let Some(index) = signal.iter().position(|v| !v.is_finite())
    {
        return Err(ArError::NotFinite { index });
    }
    let x: Vec<f64> = signal.iter().map(|v| v - mean).collect();
    let energy = sum_of(&x, |v| v * v);
    if energy == 0.0 { Err(ArError::Constant) } else { Ok((x, energy)) }
}

/// Levinson-Durbin update: raises the order by one with a new reflection coefficient.
fn step_up(ar: &mut Vec<f64>, reflection: f64) {
    // In place, from both ends: each pair depends only on itself.
    let n = ar.len();
    for j in 0..n.div_ceil(2) {
        let (x, y) = (ar[j], ar[n - 1 - j]);
        (ar[j], ar[n - 1 - j]) = (x + reflection * y, y + reflection * x);
    }
    ar.push(reflection);
}

/// Order within `range` that minimizes the Bayesian information criterion (BIC) `n ln E + p ln n`.
pub fn order_by_bic(fit: &ArFit, n_samples: usize, range: std::ops::RangeInclusive<usize>) -> usize {
    let n = n_samples as f64;
    let bic = |p: usize| n * fit.variance_by_order[p].max(f64::MIN_POSITIVE).ln() + p as f64 * n.ln();
    let last = (*range.end()).min(fit.variance_by_order.len() - 1);
    (*range.start()..=last).min_by(|a, b| bic(*a).total_cmp(&bic(*b))).unwrap_or(last)
}

/// Process variance for unit excitation variance, `1 / Π (1 - k_i²)`, by the step-down recursion; infinite if the
/// predictor is unstable.
pub fn power_gain(ar: &[f64]) -> f64 {
    let mut a = ar.to_vec();
    let mut gain = 1.0;
    while !a.is_empty() {
        let Some(left) = step_down(&mut a) else { return f64::INFINITY };
        gain /= left;
    }
    gain
}

/// Levinson-Durbin update in reverse: the predictor of the next lower order, which Burg's method and the Yule-Walker
/// equations would have given. Returns `1 - k²` for the reflection coefficient `k` that is removed, or `None` if the
/// predictor has order 0 or is unstable.
pub(crate) fn step_down(ar: &mut Vec<f64>) -> Option<f64> {
    let k = ar.pop()?;
    let left = 1.0 - k * k;
    if left <= 0.0 || left.is_nan() {
        return None;
    }
    // In place, from both ends: each pair depends only on itself.
    let n = ar.len();
    for j in 0..n.div_ceil(2) {
        let (x, y) = (ar[j], ar[n - 1 - j]);
        (ar[j], ar[n - 1 - j]) = ((x - k * y) / left, (y - k * x) / left);
    }
    Some(left)
}

/// Transfer function `1 / A(e^{jω})` at each frequency, as (real, imaginary).
pub fn response(ar: &[f64], rate: Hertz, frequencies: &[Hertz]) -> Vec<(f64, f64)> {
    let one = |f: &Hertz| {
        let (sin, cos) = (TAU * f.0 / rate.0).sin_cos();
        // Horner's method in z^-1 = cos - j sin, from the highest coefficient down.
        let (mut re, mut im) = (0.0, 0.0);
        for a in ar.iter().rev().chain(std::iter::once(&1.0)) {
            (re, im) = (re * cos + im * sin + a, im * cos - re * sin);
        }
        let square = re * re + im * im;
        (re / square, -im / square)
    };
    frequencies.iter().map(one).collect()
}

/// One-sided power spectral density `2 σ² / (rate |A|²)` at each frequency, in the squared unit of the signal per Hz.
/// Its integral from zero to the Nyquist frequency is the variance of the process.
pub fn psd(ar: &[f64], variance: f64, rate: Hertz, frequencies: &[Hertz]) -> Vec<f64> {
    let scale = 2.0 * variance / rate.0;
    response(ar, rate, frequencies).into_iter().map(|(re, im)| scale * (re * re + im * im)).collect()
}

/// Grid for comparing model spectra: `n` frequencies from 5 Hz to 0.999 of the Nyquist frequency.
pub fn comparison_frequencies(rate: Hertz, n: usize) -> Vec<Hertz> {
    let (low, high) = (5.0, 0.999 * rate.0 / 2.0);
    let step = if n > 1 { (high - low) / (n - 1) as f64 } else { 0.0 };
    (0..n).map(|i| Hertz(low + step * i as f64)).collect()
}

/// Predictors with known properties, for tests.
#[cfg(test)]
pub(crate) mod test_signals {
    use crate::units::Hertz;
    use std::f64::consts::TAU;

    /// Predictor with the poles `radius e^{±j 2π f / rate}` for each (frequency, radius).
    pub(crate) fn from_resonances(rate: Hertz, resonances: &[(Hertz, f64)]) -> Vec<f64> {
        let factor = |(f, r): &(Hertz, f64)| [1.0, -2.0 * r * (TAU * f.0 / rate.0).cos(), r * r];
        resonances.iter().map(factor).fold(vec![1.0], |poly, f| convolve(&poly, &f)).split_off(1)
    }

    /// Product of two polynomials.
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
