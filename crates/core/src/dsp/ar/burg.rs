//! Burg's method on sums: it needs only the autocorrelation lags and a few samples at both ends of a segment.
//!
//! Burg's reflection coefficients are quotients of quadratic forms in `R = Φ + JΦJ`. `Φ` is the covariance matrix of
//! the samples that predictor and prediction share; `J` reverses a vector. `R` of the next order follows from the
//! current one and the samples that drop out at both ends (K. Vos, "A fast implementation of Burg's method", 2013). The
//! segment is therefore read once, not once for each order.

use crate::dsp::ar::{ArError, ArFit, centered, step_up};
use crate::maths::sums::lag_sums;

/// Residual power relative to the energy, below which the sums are too inaccurate. `R` has a relative error of about
/// 1e-16, so that reflection coefficients have eight correct digits at this limit.
const RESOLVED_SHARE: f64 = 1e-8;

/// Fits an AR model of order `order` by Burg's method: stable, and more accurate than Yule-Walker for short segments.
///
/// # Errors
/// See [`ArError`].
pub fn burg(signal: &[f64], order: usize) -> Result<ArFit, ArError> {
    let (x, energy) = centered(signal, order)?;
    Ok(recursion(&x, energy, order).unwrap_or_else(|| lattice(&x, energy, order)))
}

/// Burg's recursion on sums over `x`, which has this `energy` and is longer than `order`. Returns `None` if the sums
/// are too inaccurate for the residual.
fn recursion(x: &[f64], energy: f64, order: usize) -> Option<ArFit> {
    let mut variance = energy / x.len() as f64;
    let mut variance_by_order = Vec::with_capacity(order + 1);
    variance_by_order.push(variance);
    let mut ar: Vec<f64> = Vec::with_capacity(order + 1);
    if order == 0 {
        return Some(ArFit { ar, variance, variance_by_order });
    }
    let lags = lag_sums(x, energy, order);
    let last: Vec<f64> = x.iter().rev().take(order).copied().collect();
    // `a = (1, a_1 … a_m)`, `row` is the last row of R, `g = R (a, 0)`.
    let mut a: Vec<f64> = Vec::with_capacity(order + 2);
    a.push(1.0);
    let inner = 2.0 * energy - (x[0] * x[0] + last[0] * last[0]);
    let mut row = Vec::with_capacity(order + 2);
    row.extend([2.0 * lags[1], inner]);
    let mut g = Vec::with_capacity(order + 2);
    g.extend([inner, row[0]]);
    for m in 0..order {
        let cross: f64 = a.iter().rev().zip(&g[1..]).map(|(a, g)| a * g).sum();
        let power: f64 = a.iter().zip(&g).map(|(a, g)| a * g).sum();
        if power.is_nan() || power <= RESOLVED_SHARE * energy || cross.abs() >= power {
            return None;
        }
        let reflection = -cross / power;
        step_up(&mut ar, reflection);
        variance *= 1.0 - reflection * reflection;
        variance_by_order.push(variance);
        if m + 1 == order {
            break;
        }
        a.truncate(1);
        a.extend_from_slice(&ar);
        // g + k J g, then the terms that drop out at both ends.
        for j in 0..g.len().div_ceil(2) {
            let end = g.len() - 1 - j;
            (g[j], g[end]) = (g[j] + reflection * g[end], g[end] + reflection * g[j]);
        }
        row.insert(0, 2.0 * lags[m + 2]);
        for ends in [&x[..m + 2], &last[..m + 2]] {
            let error: f64 = ends.iter().rev().zip(&a).map(|(x, a)| x * a).sum();
            for (g, x) in g.iter_mut().zip(ends.iter().rev()) {
                *g -= error * x;
            }
            let reached = ends[m + 1];
            for (row, x) in row[1..].iter_mut().zip(ends) {
                *row -= reached * x;
            }
        }
        g.push(row.iter().zip(&a).map(|(r, a)| r * a).sum());
    }
    Some(ArFit { ar, variance, variance_by_order })
}

/// Burg's recursion on the samples: slower, and accurate even for highly predictable signals.
fn lattice(x: &[f64], energy: f64, order: usize) -> ArFit {
    let (mut forward, mut backward) = (x.to_vec(), x.to_vec());
    let mut variance = energy / x.len() as f64;
    let mut ar: Vec<f64> = Vec::with_capacity(order);
    let mut variance_by_order = vec![variance];
    for m in 1..=order {
        // Pairs forward error `i` with backward error `i - 1`, which is stored at `i - m`.
        let (forward, backward) = (&mut forward[m..], &mut backward[..x.len() - m]);
        let pairs = || forward.iter().zip(backward.iter());
        let cross: f64 = pairs().map(|(f, b)| f * b).sum();
        let power: f64 = pairs().map(|(f, b)| f * f + b * b).sum();
        let reflection = if power > 0.0 { -2.0 * cross / power } else { 0.0 };
        for (f, b) in forward.iter_mut().zip(backward) {
            (*f, *b) = (*f + reflection * *b, *b + reflection * *f);
        }
        step_up(&mut ar, reflection);
        variance *= 1.0 - reflection * reflection;
        variance_by_order.push(variance);
    }
    ArFit { ar, variance, variance_by_order }
}

#[cfg(test)]
mod tests {
    use super::{burg, lattice, recursion};
    use crate::dsp::ar::{centered, power_gain};
    use crate::maths::rng::lcg_noise;
    use proptest::prelude::{any, prop_assert, proptest};

    proptest! {
        #[test]
        fn sums_give_what_the_samples_give(n in 40_usize..400, order in 1_usize..33, seed in any::<u64>(), pole in -0.95..0.95) {
            let mut x = lcg_noise(n, seed);
            for i in 1..n { x[i] += pole * x[i - 1]; }
            let (x, energy) = centered(&x, order).unwrap();
            let (fast, slow) = (recursion(&x, energy, order).unwrap(), lattice(&x, energy, order));
            for (a, b) in fast.ar.iter().zip(&slow.ar) {
                // Poles up to 0.95 make R a thousand times as ill-conditioned as white noise; short segments add a
                // factor of ten.
                prop_assert!((a - b).abs() < 1e-10, "got {a}, expected {b}");
            }
            prop_assert!(power_gain(&fast.ar).is_finite());
        }
    }

    #[test]
    fn what_is_wholly_predictable_is_left_to_the_samples() {
        let sine: Vec<f64> = (0..500).map(|i| (0.3 * f64::from(i)).sin()).collect();
        let (centered, energy) = centered(&sine, 6).unwrap();
        assert_eq!(recursion(&centered, energy, 6), None);
        let fit = burg(&sine, 2).unwrap();
        // A sine has the predictor -2 cos ω, 1; the mean of an incomplete period shifts it slightly.
        assert!((fit.ar[0] + 2.0 * 0.3_f64.cos()).abs() < 1e-3 && (fit.ar[1] - 1.0).abs() < 1e-3, "{fit:?}");
    }
}
