//! Autoregressive models of a stationary signal: fitting, order, power, spectrum.
//!
//! `A(z) = 1 + Σ a_k z^-k`, `x[n] = -Σ a_k x[n-k] + e[n]`, `e ~ N(0, σ²)`. Coefficient slices leave the leading one out:
//! `ar[0]` is `a_1`.

use std::f64::consts::TAU;

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
    let x = centered(signal, order)?;
    let n = x.len();
    let r: Vec<f64> = (0..=order)
        .map(|k| x[..n - k].iter().zip(&x[k..]).map(|(a, b)| a * b).sum::<f64>() / n as f64)
        .collect();
    Ok(levinson(&r, order))
}

/// The predictor of order `order` of an autocorrelation from lag 0 to at least that order, by Levinson's recursion.
pub fn levinson(r: &[f64], order: usize) -> ArFit {
    let mut ar: Vec<f64> = Vec::with_capacity(order);
    let mut variance = r[0];
    let mut variance_by_order = vec![variance];
    for i in 1..=order {
        let sum = r[i] + ar.iter().enumerate().map(|(j, a)| a * r[i - 1 - j]).sum::<f64>();
        let reflection = -sum / variance;
        step_up(&mut ar, reflection);
        variance *= 1.0 - reflection * reflection;
        variance_by_order.push(variance);
    }
    ArFit { ar, variance, variance_by_order }
}

/// The predictor of order `order` by Burg's method: stable, and truer than Yule-Walker on short segments.
///
/// # Errors
/// See [`ArError`].
pub fn burg(signal: &[f64], order: usize) -> Result<ArFit, ArError> {
    let mut forward = centered(signal, order)?;
    let mut backward = forward.clone();
    let n = forward.len();
    let mut ar: Vec<f64> = Vec::with_capacity(order);
    let mut variance = forward.iter().map(|v| v * v).sum::<f64>() / n as f64;
    let mut variance_by_order = vec![variance];
    for m in 1..=order {
        // f[i] meets b[i-1] for i in m..n; both are updated in place.
        let (mut cross, mut energy) = (0.0, 0.0);
        for i in m..n {
            cross += forward[i] * backward[i - 1];
            energy += forward[i] * forward[i] + backward[i - 1] * backward[i - 1];
        }
        let reflection = if energy > 0.0 { -2.0 * cross / energy } else { 0.0 };
        for i in (m..n).rev() {
            let (f, b) = (forward[i], backward[i - 1]);
            forward[i] = f + reflection * b;
            backward[i] = b + reflection * f;
        }
        step_up(&mut ar, reflection);
        variance *= 1.0 - reflection * reflection;
        variance_by_order.push(variance);
    }
    Ok(ArFit { ar, variance, variance_by_order })
}

/// The signal without its mean.
fn centered(signal: &[f64], order: usize) -> Result<Vec<f64>, ArError> {
    if signal.len() <= order {
        return Err(ArError::TooShort { order, len: signal.len() });
    }
    if let Some(index) = signal.iter().position(|v| !v.is_finite()) {
        return Err(ArError::NotFinite { index });
    }
    let mean = signal.iter().sum::<f64>() / signal.len() as f64;
    let x: Vec<f64> = signal.iter().map(|v| v - mean).collect();
    if x.iter().all(|v| *v == 0.0) { Err(ArError::Constant) } else { Ok(x) }
}

/// Levinson's update: a predictor of one order more from its last reflection coefficient.
fn step_up(ar: &mut Vec<f64>, reflection: f64) {
    let n = ar.len();
    let before = ar.clone();
    for (j, a) in ar.iter_mut().enumerate() {
        *a += reflection * before[n - 1 - j];
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
    use crate::lsf::convolve;
    use crate::units::Hertz;
    use std::f64::consts::TAU;

    /// The predictor with poles at `radius e^{±j 2π f / rate}` for each (frequency, radius).
    pub(crate) fn from_resonances(rate: Hertz, resonances: &[(Hertz, f64)]) -> Vec<f64> {
        let factor = |(f, r): &(Hertz, f64)| [1.0, -2.0 * r * (TAU * f.0 / rate.0).cos(), r * r];
        resonances.iter().map(factor).fold(vec![1.0], |poly, f| convolve(&poly, &f)).split_off(1)
    }
}

#[cfg(test)]
mod tests {
    use super::test_signals::from_resonances;
    use super::{ArError, burg, comparison_frequencies, order_by_bic, power_gain, psd, yule_walker};
    use crate::rng::lcg_noise;
    use crate::units::Hertz;
    use serde_json::Value;

    fn vectors() -> Value {
        serde_json::from_str(include_str!("../../../vectors/a_ar/ar_vectors.json")).unwrap()
    }

    fn floats(value: &Value) -> Vec<f64> {
        value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
    }

    #[track_caller]
    fn check(actual: &[f64], expected: &[f64], tolerance: f64) {
        assert_eq!(actual.len(), expected.len());
        for (i, (a, e)) in actual.iter().zip(expected).enumerate() {
            assert!((a - e).abs() < tolerance, "[{i}] {a} for {e}");
        }
    }

    /// The realization that the vectors were computed on.
    fn realization() -> Vec<f64> {
        let a = from_resonances(Hertz(1000.0), &[(Hertz(110.0), 0.95), (Hertz(260.0), 0.90)]);
        let e: Vec<f64> = lcg_noise(7000, 12345).iter().map(|v| v * 0.25_f64.sqrt()).collect();
        let mut x = vec![0.0; e.len()];
        for n in 0..e.len() {
            x[n] = e[n] - (1..=4.min(n)).map(|k| a[k - 1] * x[n - k]).sum::<f64>();
        }
        x.split_off(2000)
    }

    #[test]
    fn golden_true_model() {
        let v = &vectors()["true"];
        let a = from_resonances(Hertz(1000.0), &[(Hertz(110.0), 0.95), (Hertz(260.0), 0.90)]);
        check(&a, &floats(&v["a"])[1..], 1e-12);
        check(&[0.25 * power_gain(&a)], &[v["power"].as_f64().unwrap()], 1e-12);
    }

    #[test]
    fn golden_fits() {
        let (v, x) = (vectors(), realization());
        check(&x[..8], &floats(&v["x_first8"]), 1e-12);
        for (name, fit) in [("yule_walker", yule_walker as fn(&[f64], usize) -> _), ("burg", burg)] {
            // Sums of 5000 products round differently by about 1e-13; conditioning at order 20 costs two digits.
            let four = fit(&x, 4).unwrap();
            check(&four.ar, &floats(&v[format!("{name}_p4")]["a"])[1..], 1e-11);
            check(&[four.variance], &[v[format!("{name}_p4")]["s2"].as_f64().unwrap()], 1e-12);
            let twenty = fit(&x, 20).unwrap();
            let golden = &v[format!("{name}_p20")];
            check(&[twenty.variance], &[golden["s2"].as_f64().unwrap()], 1e-11);
            check(&[twenty.variance * power_gain(&twenty.ar)], &[golden["power"].as_f64().unwrap()], 1e-9);
        }
        let fit = yule_walker(&x, 30).unwrap();
        assert_eq!(order_by_bic(&fit, x.len(), 0..=30), 4);
    }

    #[test]
    fn density_integrates_to_the_power() {
        let ar =
            from_resonances(Hertz(1000.0), &[(Hertz(60.0), 0.97), (Hertz(180.0), 0.93), (Hertz(400.0), 0.8)]);
        let n = 20_000;
        let f: Vec<Hertz> = (0..n).map(|i| Hertz((f64::from(i) + 0.5) * 500.0 / f64::from(n))).collect();
        let integral = psd(&ar, 0.7, Hertz(1000.0), &f).iter().sum::<f64>() * 500.0 / f64::from(n);
        check(&[integral / (0.7 * power_gain(&ar))], &[1.0], 1e-9);
    }

    #[test]
    fn first_order_in_closed_form() {
        check(&[power_gain(&[-0.6])], &[1.0 / (1.0 - 0.36)], 1e-15);
        assert_eq!(power_gain(&[1.0]), f64::INFINITY);
        assert_eq!(power_gain(&[]), 1.0);
    }

    #[test]
    fn bad_signals_are_named() {
        assert_eq!(burg(&[1.0, 2.0], 2), Err(ArError::TooShort { order: 2, len: 2 }));
        assert_eq!(yule_walker(&[1.0, f64::NAN, 2.0], 1), Err(ArError::NotFinite { index: 1 }));
        assert_eq!(burg(&[3.0; 50], 2), Err(ArError::Constant));
    }

    #[test]
    fn frequencies_run_from_five_hertz_to_just_below_nyquist() {
        let f = comparison_frequencies(Hertz(1000.0), 256);
        assert_eq!((f.len(), f[0]), (256, Hertz(5.0)));
        check(&[f[255].0], &[499.5], 1e-9);
    }
}
