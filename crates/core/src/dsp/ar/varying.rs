//! Burg's method for nonstationary signals: reflection coefficients are linear in a quantity known at every sample,
//! such as the tip speed.

use crate::dsp::ar::{ArFit, step_up};

/// Regularization of the slopes towards zero, relative to the weight of all samples. A slope without support in the
/// samples stays zero. With half a unit of spread in the offsets, a slope is estimated to within a fifth.
const SLOPE_BELIEF: f64 = 0.05;

/// Largest magnitude of a reflection coefficient; above it the predictor rings longer than any segment lasts.
const MAX_REFLECTION: f64 = 0.9999;

/// Signal segment with the offset of each sample from the operating point at which the predictor is wanted, and a
/// weight.
pub(crate) struct Part<'a> {
    /// Samples; the mean is not removed.
    pub(crate) signal: &'a [f64],
    /// Offset of each sample, of order one.
    pub(crate) offsets: Vec<f64>,
    /// Weight of the squared errors.
    pub(crate) weight: f64,
}

/// Prediction errors of a segment in the lattice.
struct Errors<'a> {
    part: &'a Part<'a>,
    forward: Vec<f64>,
    backward: Vec<f64>,
}

/// Sums over one stage of `f² + b²` and of `2 f b`, each times powers of the offset.
#[derive(Default)]
struct Moments {
    power: [f64; 3],
    cross: [f64; 2],
}

/// AR model at offset zero of segments whose reflection coefficients are `k + k' d` at offset `d`. At every stage both
/// minimize the sum of the squared forward and backward errors. Returns `None` if all samples are zero.
///
/// Constant offsets give Burg's method. The predictor is stable. The variances by order are those of the errors of all
/// segments at their offsets.
pub(crate) fn burg_varying(parts: &[Part<'_>], order: usize) -> Option<ArFit> {
    let n: f64 = parts.iter().map(|p| p.weight * p.signal.len() as f64).sum();
    let energy: f64 = parts.iter().map(|p| p.weight * p.signal.iter().map(|x| x * x).sum::<f64>()).sum();
    let mut variance = energy / n;
    if variance.is_nan() || variance <= 0.0 {
        return None;
    }
    let mut errors: Vec<Errors<'_>> = parts
        .iter()
        .map(|part| Errors { part, forward: part.signal.to_vec(), backward: part.signal.to_vec() })
        .collect();
    let mut variance_by_order = vec![variance];
    let mut ar = Vec::with_capacity(order);
    for m in 0..order {
        let moments = moments(&errors, m);
        let (mut at_zero, mut slope) = moments.reflection();
        if at_zero.abs() > MAX_REFLECTION {
            (at_zero, slope) = (moments.constant(), 0.0);
        }
        let before = moments.power[0];
        for e in &mut errors {
            e.pass(m, at_zero, slope);
        }
        let after: f64 = errors.iter().map(|e| e.power(m + 1)).sum();
        if before > 0.0 {
            variance *= after / before;
        }
        variance_by_order.push(variance);
        step_up(&mut ar, at_zero);
    }
    Some(ArFit { ar, variance, variance_by_order })
}

fn moments(errors: &[Errors<'_>], m: usize) -> Moments {
    let mut all = Moments::default();
    for e in errors {
        let mut own = [0.0; 5];
        let late = e.forward.iter().zip(&e.part.offsets).skip(m + 1);
        for ((f, d), b) in late.zip(e.backward.iter().skip(m)) {
            let (power, cross) = (f * f + b * b, 2.0 * f * b);
            own[0] += power;
            own[1] += power * d;
            own[2] += power * d * d;
            own[3] += cross;
            own[4] += cross * d;
        }
        let own = own.map(|sum| e.part.weight * sum);
        for (sum, own) in all.power.iter_mut().chain(&mut all.cross).zip(own) {
            *sum += own;
        }
    }
    all
}

impl Moments {
    /// Reflection coefficient at offset zero, and its slope.
    fn reflection(&self) -> (f64, f64) {
        let [p0, p1, p2] = self.power;
        let [c0, c1] = self.cross;
        let p2 = p2 + SLOPE_BELIEF * p0;
        let determinant = p0 * p2 - p1 * p1;
        if determinant > 0.0 {
            ((p1 * c1 - p2 * c0) / determinant, (p1 * c0 - p0 * c1) / determinant)
        } else {
            (self.constant(), 0.0)
        }
    }

    /// Burg's reflection coefficient, without slope.
    fn constant(&self) -> f64 {
        if self.power[0] > 0.0 {
            (-self.cross[0] / self.power[0]).clamp(-MAX_REFLECTION, MAX_REFLECTION)
        } else {
            0.0
        }
    }
}

impl Errors<'_> {
    /// One lattice stage, in place: `f' = f[i] + k b[i-1]`, `b' = b[i-1] + k f[i]`.
    fn pass(&mut self, m: usize, at_zero: f64, slope: f64) {
        for i in (m + 1..self.forward.len()).rev() {
            let k = (at_zero + slope * self.part.offsets[i]).clamp(-MAX_REFLECTION, MAX_REFLECTION);
            let (f, b) = (self.forward[i], self.backward[i - 1]);
            (self.forward[i], self.backward[i]) = (f + k * b, b + k * f);
        }
    }

    /// Weighted sum of squared errors after the last stage, over the samples that the stage processed.
    fn power(&self, from: usize) -> f64 {
        let squares = |errors: &[f64]| errors.iter().skip(from).map(|e| e * e).sum::<f64>();
        self.part.weight * (squares(&self.forward) + squares(&self.backward))
    }
}

#[cfg(test)]
mod tests {
    use super::{Part, burg_varying};
    use crate::dsp::ar::burg;
    use crate::maths::rng::lcg_noise;

    fn part(signal: &[f64], offset: impl Fn(usize) -> f64) -> Part<'_> {
        Part { signal, offsets: (0..signal.len()).map(offset).collect(), weight: 1.0 }
    }

    #[test]
    fn without_offsets_it_is_burgs_method() {
        let mut x = lcg_noise(400, 3);
        for i in 2..x.len() {
            x[i] += 1.2 * x[i - 1] - 0.8 * x[i - 2];
        }
        let mean = x.iter().sum::<f64>() / x.len() as f64;
        for v in &mut x {
            *v -= mean;
        }
        let (ours, burgs) = (burg_varying(&[part(&x, |_| 0.0)], 6).unwrap(), burg(&x, 6).unwrap());
        for (a, b) in ours.ar.iter().zip(&burgs.ar) {
            // The same sums in a different order.
            assert!((a - b).abs() < 1e-10, "got {a}, expected {b}");
        }
    }

    #[test]
    fn a_reflection_that_moves_is_found_where_it_is_asked_for() {
        // a_1 moves from -0.9 to 0.9. Its mean is zero, which is the result of a stationary fit.
        let n = 40_000;
        let share = |i: usize| 2.0 * i as f64 / n as f64 - 1.0;
        let mut x = lcg_noise(n, 5);
        for i in 1..n {
            x[i] -= 0.9 * share(i) * x[i - 1];
        }
        for wanted in [-0.6, 0.0, 0.5] {
            let fit = burg_varying(&[part(&x, |i| share(i) - wanted)], 1).unwrap();
            // The regularization of the slope shifts the result by about its fraction of the spread.
            assert!((fit.ar[0] - 0.9 * wanted).abs() < 0.1, "got {} at offset {wanted}", fit.ar[0]);
        }
    }

    #[test]
    fn silence_has_no_predictor() {
        assert_eq!(burg_varying(&[part(&[0.0; 50], |_| 0.0)], 4), None);
        assert_eq!(burg_varying(&[], 4), None);
    }
}
