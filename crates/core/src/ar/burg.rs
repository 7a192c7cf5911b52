//! Burg's method on sums: lags, and a few samples at both ends, are all that it needs of a segment.
//!
//! Burg's reflection coefficients are quotients of quadratic forms in `R = Φ + JΦJ`, where `Φ` is the covariance matrix of
//! the samples that predictor and predicted share and `J` turns a vector around. `R` of the next order follows from that
//! of this one by the samples that drop out at both ends (K. Vos, "A fast implementation of Burg's method", 2013), so a
//! segment is passed over once, not once an order, and the sums of several segments may be added: a predictor that fits
//! all of them without joining their ends.

use crate::ar::lags::{lag_sums, sum_of};
use crate::ar::{ArError, ArFit, centered, step_up};

/// Share of the energy below which sums no longer resolve what is left to predict: `R` is known to about 1e-16 of it, so
/// that reflections still have eight digits here.
const RESOLVED_SHARE: f64 = 1e-8;

/// What Burg's method needs of a segment, for every order up to one.
#[derive(Clone, Debug, PartialEq)]
pub struct BurgSums {
    /// `Σ x[i] x[i + k]` of every lag.
    lags: Vec<f64>,
    /// The first samples, as many as the order.
    first: Vec<f64>,
    /// The last samples, as many as the order, the last one first.
    last: Vec<f64>,
    len: usize,
}

impl BurgSums {
    /// The sums of a segment as it is: its mean is not taken out.
    ///
    /// # Errors
    /// See [`ArError`].
    pub fn new(segment: &[f64], order: usize) -> Result<Self, ArError> {
        if segment.len() <= order {
            return Err(ArError::TooShort { order, len: segment.len() });
        }
        let energy = sum_of(segment, |v| v * v);
        if !energy.is_finite()
            && let Some(index) = segment.iter().position(|v| !v.is_finite())
        {
            return Err(ArError::NotFinite { index });
        }
        Ok(Self::of_finite(segment, energy, order))
    }

    fn of_finite(segment: &[f64], energy: f64, order: usize) -> Self {
        Self {
            lags: lag_sums(segment, energy, order),
            first: segment[..order].to_vec(),
            last: segment.iter().rev().take(order).copied().collect(),
            len: segment.len(),
        }
    }

    /// Samples of the segment.
    pub fn n_samples(&self) -> usize {
        self.len
    }

    /// Mean square of the segment.
    pub fn mean_square(&self) -> f64 {
        self.lags[0] / self.len as f64
    }

    fn order(&self) -> usize {
        self.first.len()
    }
}

/// The predictor of order `order` by Burg's method: stable, and truer than Yule-Walker on short segments.
///
/// # Errors
/// See [`ArError`].
pub fn burg(signal: &[f64], order: usize) -> Result<ArFit, ArError> {
    let (x, energy) = centered(signal, order)?;
    let sums = BurgSums::of_finite(&x, energy, order);
    let fit = recursion(&[(&sums, 1.0)], order);
    Ok(fit.unwrap_or_else(|| lattice(&x, energy, order)))
}

/// One predictor for several segments, each with the weight that its squares get.
///
/// Where the segments are so predictable that their sums do not tell what is left, the higher coefficients are zero.
///
/// # Errors
/// [`ArError::TooShort`] where sums were made for a lower order, [`ArError::Constant`] where all is zero or nothing given.
pub fn burg_of_many(segments: &[(&BurgSums, f64)], order: usize) -> Result<ArFit, ArError> {
    if let Some((sums, _)) = segments.iter().find(|(sums, _)| sums.order() < order) {
        return Err(ArError::TooShort { order, len: sums.order() });
    }
    if segments.iter().map(|(sums, weight)| weight * sums.lags[0]).sum::<f64>() <= 0.0 {
        return Err(ArError::Constant);
    }
    let resolved = (0..=order).rev().find_map(|m| recursion(segments, m));
    let Some(mut fit) = resolved else { return Err(ArError::Constant) };
    fit.ar.resize(order, 0.0);
    fit.variance_by_order.resize(order + 1, fit.variance);
    Ok(fit)
}

/// Burg's recursion on sums, or `None` where they do not resolve what is left to predict.
fn recursion(segments: &[(&BurgSums, f64)], order: usize) -> Option<ArFit> {
    let total = |value: &dyn Fn(&BurgSums) -> f64| segments.iter().map(|(s, w)| w * value(s)).sum::<f64>();
    let energy = total(&|s| s.lags[0]);
    let mut variance = energy / total(&|s| s.len as f64);
    let mut variance_by_order = Vec::with_capacity(order + 1);
    variance_by_order.push(variance);
    let mut ar: Vec<f64> = Vec::with_capacity(order + 1);
    if order == 0 {
        return Some(ArFit { ar, variance, variance_by_order });
    }
    // `a = (1, a_1 … a_m)`, `row` the last row of R, `g = R (a, 0)`.
    let mut a: Vec<f64> = Vec::with_capacity(order + 2);
    a.push(1.0);
    let inner = 2.0 * energy - total(&|s| s.first[0] * s.first[0] + s.last[0] * s.last[0]);
    let mut row = Vec::with_capacity(order + 2);
    row.extend([2.0 * total(&|s| s.lags[1]), inner]);
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
        // g + k J g, then what drops out at both ends of each segment.
        for j in 0..g.len().div_ceil(2) {
            let end = g.len() - 1 - j;
            (g[j], g[end]) = (g[j] + reflection * g[end], g[end] + reflection * g[j]);
        }
        row.insert(0, 2.0 * total(&|s| s.lags[m + 2]));
        for (s, weight) in segments {
            for (ends, reached) in [(&s.first, s.first[m + 1]), (&s.last, s.last[m + 1])] {
                let ends = &ends[..m + 2];
                let error = weight * ends.iter().rev().zip(&a).map(|(x, a)| x * a).sum::<f64>();
                for (g, x) in g.iter_mut().zip(ends.iter().rev()) {
                    *g -= error * x;
                }
                let reached = weight * reached;
                for (row, x) in row[1..].iter_mut().zip(ends) {
                    *row -= reached * x;
                }
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
    use super::{BurgSums, burg, burg_of_many, lattice, recursion};
    use crate::ar::{ArError, centered, power_gain};
    use crate::rng::lcg_noise;
    use proptest::prelude::{any, prop_assert, proptest};

    proptest! {
        #[test]
        fn sums_give_what_the_samples_give(n in 40_usize..400, order in 1_usize..33, seed in any::<u64>(), pole in -0.95..0.95) {
            let mut x = lcg_noise(n, seed);
            for i in 1..n { x[i] += pole * x[i - 1]; }
            let (x, energy) = centered(&x, order).unwrap();
            let sums = BurgSums::of_finite(&x, energy, order);
            let (fast, slow) = (recursion(&[(&sums, 1.0)], order).unwrap(), lattice(&x, energy, order));
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
        let sums = BurgSums::new(&sine, 6).unwrap();
        assert_eq!(recursion(&[(&sums, 1.0)], 6), None);
        let fit = burg(&sine, 2).unwrap();
        // A sine is -2 cos ω, 1; the mean of a part of a period shifts it a little.
        assert!((fit.ar[0] + 2.0 * 0.3_f64.cos()).abs() < 1e-3 && (fit.ar[1] - 1.0).abs() < 1e-3, "{fit:?}");
        let many = burg_of_many(&[(&sums, 1.0)], 6).unwrap();
        assert_eq!(many.ar.len(), 6);
        assert!(many.ar[5] == 0.0 && many.ar[0] != 0.0);
    }

    #[test]
    fn many_segments_are_one_long_one_without_its_seams() {
        // The quadratic forms add, so a segment beside itself, or at another weight, is itself.
        let (x, y) = (lcg_noise(300, 1), lcg_noise(120, 2));
        let [one, other] = [&x, &y].map(|x| BurgSums::new(x, 8).unwrap());
        let alone = burg_of_many(&[(&one, 1.0)], 8).unwrap();
        let twice = burg_of_many(&[(&one, 0.4), (&one, 2.0)], 8).unwrap();
        assert!(alone.ar.iter().zip(&twice.ar).all(|(a, b)| (a - b).abs() < 1e-12));
        assert_eq!(burg_of_many(&[(&one, 1.0), (&other, 0.0)], 8).unwrap().ar, alone.ar);
        assert_eq!(burg_of_many(&[], 8), Err(ArError::Constant));
        assert_eq!(burg_of_many(&[(&one, 1.0)], 9), Err(ArError::TooShort { order: 9, len: 8 }));
    }
}
