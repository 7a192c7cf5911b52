//! Burg's method on sums: lags, and a few samples at both ends, are all that it needs of a segment.
//!
//! Burg's reflection coefficients are quotients of quadratic forms in `R = Φ + JΦJ`, where `Φ` is the covariance matrix of
//! the samples that predictor and predicted share and `J` turns a vector around. `R` of the next order follows from that
//! of this one by the samples that drop out at both ends (K. Vos, "A fast implementation of Burg's method", 2013), so a
//! segment is passed over once, not once an order.

use crate::ar::lags::lag_sums;
use crate::ar::{ArError, ArFit, centered, step_up};

/// Share of the energy below which sums no longer resolve what is left to predict: `R` is known to about 1e-16 of it, so
/// that reflections still have eight digits here.
const RESOLVED_SHARE: f64 = 1e-8;

/// The predictor of order `order` by Burg's method: stable, and truer than Yule-Walker on short segments.
///
/// # Errors
/// See [`ArError`].
pub fn burg(signal: &[f64], order: usize) -> Result<ArFit, ArError> {
    let (x, energy) = centered(signal, order)?;
    Ok(recursion(&x, energy, order).unwrap_or_else(|| lattice(&x, energy, order)))
}

/// Burg's recursion on sums over `x`, whose squares add up to `energy`, or `None` where they do not resolve what is left
/// to predict. `x` is longer than `order`.
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
    // `a = (1, a_1 … a_m)`, `row` the last row of R, `g = R (a, 0)`.
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
        // g + k J g, then what drops out at both ends.
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

/// Burg's recursion on the samples: slower, and exact however predictable they are.
fn lattice(x: &[f64], energy: f64, order: usize) -> ArFit {
    let (mut forward, mut backward) = (x.to_vec(), x.to_vec());
    let mut variance = energy / x.len() as f64;
    let mut ar: Vec<f64> = Vec::with_capacity(order);
    let mut variance_by_order = vec![variance];
    for m in 1..=order {
        // Forward error `i` meets backward error `i - 1`, which is kept at `i - m`.
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
    use crate::ar::{centered, power_gain};
    use crate::rng::lcg_noise;
    use proptest::prelude::{any, prop_assert, proptest};

    proptest! {
        #[test]
        fn sums_give_what_the_samples_give(n in 40_usize..400, order in 1_usize..33, seed in any::<u64>(), pole in -0.95..0.95) {
            let mut x = lcg_noise(n, seed);
            for i in 1..n { x[i] += pole * x[i - 1]; }
            let (x, energy) = centered(&x, order).unwrap();
            let (fast, slow) = (recursion(&x, energy, order).unwrap(), lattice(&x, energy, order));
            for (a, b) in fast.ar.iter().zip(&slow.ar) {
                // Poles up to 0.95 make R a thousand times as ill-conditioned as noise; short segments ten times more.
                prop_assert!((a - b).abs() < 1e-10, "{a} for {b}");
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
        // A sine is -2 cos ω, 1; the mean of a part of a period shifts it a little.
        assert!((fit.ar[0] + 2.0 * 0.3_f64.cos()).abs() < 1e-3 && (fit.ar[1] - 1.0).abs() < 1e-3, "{fit:?}");
    }
}
