//! Moving-average (MA) filter of the excitation, for ARMA texture models.

use crate::limits::{MAX_MA_ORDER, MAX_TICK};
use crate::lsf::ar_from_lsf;

/// Products are summed in this many lanes so that the compiler can vectorize the sum.
const LANES: usize = 8;

/// MA filter `x[t] + Σ b_j x[t-j]` with coefficients and state.
#[derive(Clone, Debug)]
pub(crate) struct MovingAverage {
    /// Coefficients `b_1 …` in reverse order, to match the order of `memory`.
    coefficients: [f32; MAX_MA_ORDER],
    order: usize,
    /// Last inputs, oldest first, followed by room for one tick.
    memory: [f32; MAX_MA_ORDER + MAX_TICK],
}

impl MovingAverage {
    /// A filter of order 0, which passes its input unchanged.
    pub(crate) fn new() -> Self {
        Self { coefficients: [0.0; MAX_MA_ORDER], order: 0, memory: [0.0; MAX_MA_ORDER + MAX_TICK] }
    }

    /// Sets the coefficients from line spectral frequencies in radians; an empty slice sets order 0.
    #[inline]
    pub(crate) fn aim(&mut self, lsf: &[f32]) {
        let order = lsf.len().min(MAX_MA_ORDER);
        if order == 0 && self.order == 0 {
            return;
        }
        let mut b = [0.0; MAX_MA_ORDER];
        ar_from_lsf(&lsf[..order], &mut b[..order]);
        b.reverse();
        self.coefficients = b;
        self.order = order;
    }

    /// Whether the filter has order 0 and changes nothing.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.order == 0
    }

    /// Clears the state; the coefficients stay.
    pub(crate) fn clear(&mut self) {
        self.memory.fill(0.0);
    }

    /// Filters at most [`MAX_TICK`] samples in place. Cost per sample: [`MAX_MA_ORDER`] multiply-adds.
    pub(crate) fn filter(&mut self, samples: &mut [f32]) {
        let n = samples.len().min(MAX_TICK);
        let m = &mut self.memory;
        m[MAX_MA_ORDER..MAX_MA_ORDER + n].copy_from_slice(&samples[..n]);
        for (i, out) in samples[..n].iter_mut().enumerate() {
            let mut sum = [0.0_f32; LANES];
            let past = m[i..i + MAX_MA_ORDER].chunks_exact(LANES);
            for (b, x) in self.coefficients.chunks_exact(LANES).zip(past) {
                for lane in 0..LANES {
                    sum[lane] += b[lane] * x[lane];
                }
            }
            *out += sum.iter().sum::<f32>();
        }
        m.copy_within(n..n + MAX_MA_ORDER, 0);
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::MovingAverage;
    use crate::limits::{MAX_MA_ORDER, MAX_TICK};
    use crate::lsf::ar_from_lsf;
    use crate::noise::{Gaussian, Noise};
    use std::vec;
    use std::vec::Vec;

    #[test]
    fn every_order_agrees_with_the_plain_sum_whatever_the_ticks() {
        let (table, mut noise) = (Gaussian::new(), Noise::new(9));
        let x: Vec<f32> = (0..300).map(|_| table.draw(&mut noise)).collect();
        for order in 0..=MAX_MA_ORDER {
            let lsf: Vec<f32> =
                (1..=order).map(|i| core::f32::consts::PI * i as f32 / (order as f32 + 1.3)).collect();
            let mut b = vec![0.0; order];
            ar_from_lsf(&lsf, &mut b);
            let mut average = MovingAverage::new();
            average.aim(&lsf);
            let mut got = x.clone();
            let mut rest = &mut got[..];
            for n in [1, 3, MAX_TICK, 7].into_iter().cycle() {
                let (tick, after) = rest.split_at_mut(n.min(rest.len()));
                average.filter(tick);
                rest = after;
                if rest.is_empty() {
                    break;
                }
            }
            for (t, y) in got.iter().enumerate() {
                let sum: f64 =
                    (1..=order.min(t)).map(|j| f64::from(b[j - 1]) * f64::from(x[t - j])).sum::<f64>();
                // The tolerance covers a sum of up to 32 products, rounded to f32.
                let (want, scale) = (f64::from(x[t]) + sum, 1.0 + b.iter().map(|b| b.abs()).sum::<f32>());
                assert!((f64::from(*y) - want).abs() < 1e-6 * f64::from(scale), "order {order}, sample {t}");
            }
        }
    }
}
