//! Levinson-Durbin recursion for several signals in parallel: each step depends on the previous one, so that a
//! processor has idle time for other signals.

/// Number of signals processed in parallel.
pub(crate) const SIDE_BY_SIDE: usize = 4;

/// One number for each signal.
type Each = [f64; SIDE_BY_SIDE];

/// AR coefficients as from [`levinson`](crate::dsp::ar::levinson), for several autocorrelations given lag by lag. The
/// result is NaN for a signal without power.
pub(crate) fn levinson_side_by_side(lags: &[Each]) -> [Vec<f64>; SIDE_BY_SIDE] {
    let order = lags.len().saturating_sub(1);
    let mut ar = vec![Each::default(); order];
    let mut variance = lags.first().copied().unwrap_or_default();
    for n in 0..order {
        let mut sum = lags[n + 1];
        for (a, lag) in ar[..n].iter().zip(lags[1..=n].iter().rev()) {
            for i in 0..SIDE_BY_SIDE {
                sum[i] += a[i] * lag[i];
            }
        }
        let mut reflection = Each::default();
        for i in 0..SIDE_BY_SIDE {
            reflection[i] = -sum[i] / variance[i];
            variance[i] *= 1.0 - reflection[i] * reflection[i];
        }
        // In place, from both ends: each pair depends only on itself.
        for j in 0..n.div_ceil(2) {
            let (x, y) = (ar[j], ar[n - 1 - j]);
            for i in 0..SIDE_BY_SIDE {
                (ar[j][i], ar[n - 1 - j][i]) = (x[i] + reflection[i] * y[i], y[i] + reflection[i] * x[i]);
            }
        }
        ar[n] = reflection;
    }
    std::array::from_fn(|i| ar.iter().map(|a| a[i]).collect())
}

#[cfg(test)]
mod tests {
    use super::{SIDE_BY_SIDE, levinson_side_by_side};
    use crate::dsp::ar::levinson;
    use crate::maths::rng::Random;

    #[test]
    fn each_is_as_if_it_were_alone() {
        let mut random = Random::new(1);
        for order in [0, 1, 2, 7, 20, 32] {
            // Autocorrelation of three cosines plus noise.
            let signals: [Vec<f64>; SIDE_BY_SIDE] = std::array::from_fn(|_| {
                let cosines: Vec<f64> = (0..3).map(|_| 3.0 * random.uniform()).collect();
                let lag = |k: usize| cosines.iter().map(|w| (w * k as f64).cos()).sum::<f64>();
                (0..=order).map(|k| lag(k) + if k == 0 { 0.5 } else { 0.0 }).collect()
            });
            let lags: Vec<[f64; SIDE_BY_SIDE]> =
                (0..=order).map(|k| std::array::from_fn(|i| signals[i][k])).collect();
            let together = levinson_side_by_side(&lags);
            for (signal, found) in signals.iter().zip(together) {
                let alone = levinson(signal, order).ar;
                assert_eq!(found.len(), order);
                for (a, b) in found.iter().zip(&alone) {
                    assert!((a - b).abs() < 1e-11, "order {order}: got {a}, expected {b}");
                }
            }
        }
        assert_eq!(levinson_side_by_side(&[]), <[Vec<f64>; SIDE_BY_SIDE]>::default());
    }
}
