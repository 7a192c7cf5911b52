//! Autocorrelation and cross-correlation of segments by FFT.

use std::fmt;
use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;

use crate::signals::quality::real_transform::{bins_of, samples_of};

/// Correlates segments of one length up to a maximum lag.
#[derive(Clone)]
pub(super) struct Correlator {
    furthest: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
}

impl fmt::Debug for Correlator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Correlator").field("furthest", &self.furthest).finish_non_exhaustive()
    }
}

impl Correlator {
    /// Returns a correlator for segments of `n_samples`, with lags up to `furthest`.
    pub(super) fn new(n_samples: usize, furthest: usize) -> Self {
        // Zero-padding prevents circular wrap-around at any lag.
        let n = transform_length(n_samples + furthest);
        let mut planner = RealFftPlanner::new();
        Self { furthest, forward: planner.plan_fft_forward(n), backward: planner.plan_fft_inverse(n) }
    }

    /// Returns the autocorrelation `Σ_i x[i + lag] x[i]` for lags from 0 to the maximum.
    pub(super) fn with_itself(&self, x: &[f64]) -> Vec<f64> {
        let mut bins = bins_of(&*self.forward, x);
        for bin in &mut bins {
            *bin = Complex::new(bin.norm_sqr(), 0.0);
        }
        let mut sums = self.turned_back(bins);
        sums.truncate(self.furthest + 1);
        sums
    }

    /// Returns the maximum cross-correlation `Σ_i x[i + shift] y[i]` over all positive and negative lags.
    pub(super) fn highest(&self, x: &[f64], y: &[f64]) -> f64 {
        let mut bins = bins_of(&*self.forward, x);
        for (x, y) in bins.iter_mut().zip(bins_of(&*self.forward, y)) {
            *x *= y.conj();
        }
        let sums = self.turned_back(bins);
        let (later, earlier) = (&sums[..=self.furthest], &sums[sums.len() - self.furthest..]);
        later.iter().chain(earlier).copied().fold(f64::MIN, f64::max)
    }

    fn turned_back(&self, mut bins: Vec<Complex<f64>>) -> Vec<f64> {
        // The DC and Nyquist bins of a real signal are real; the product leaves round-off.
        let last = bins.len() - 1;
        (bins[0].im, bins[last].im) = (0.0, 0.0);
        let mut sums = samples_of(&*self.backward, bins);
        let share = 1.0 / sums.len() as f64;
        for sum in &mut sums {
            *sum *= share;
        }
        sums
    }
}

/// Smallest even length of at least `n_samples` with no prime factors but 2, 3 and 5, which makes the FFT fast.
fn transform_length(n_samples: usize) -> usize {
    let is_smooth = |n: &usize| {
        let mut rest = *n;
        for factor in [2, 3, 5] {
            while rest.is_multiple_of(factor) {
                rest /= factor;
            }
        }
        rest == 1
    };
    let least = n_samples.max(2).next_multiple_of(2);
    (least..=least.next_power_of_two()).step_by(2).find(is_smooth).unwrap_or(least)
}

#[cfg(test)]
mod tests {
    use super::{Correlator, transform_length};
    use crate::maths::rng::lcg_noise;
    use crate::maths::statistics::dot;

    #[test]
    fn sums_are_those_worked_out_one_by_one() {
        for (n, furthest) in [(2, 0), (2, 1), (31, 30), (200, 7), (2240, 140)] {
            let (x, y) = (lcg_noise(n, 1), lcg_noise(n, 2));
            let correlator = Correlator::new(n, furthest);
            let sum = |x: &[f64], y: &[f64], shift: usize| dot(&x[shift..], &y[..n - shift]);
            let sums = correlator.with_itself(&x);
            assert_eq!(sums.len(), furthest + 1);
            let close = |got: f64, wanted: f64| assert!((got - wanted).abs() < 1e-10, "{got}, not {wanted}");
            sums.iter().enumerate().for_each(|(lag, got)| close(*got, sum(&x, &x, lag)));
            let both = (0..=furthest).flat_map(|shift| [sum(&x, &y, shift), sum(&y, &x, shift)]);
            close(correlator.highest(&x, &y), both.fold(f64::MIN, f64::max));
        }
    }

    #[test]
    fn lengths_are_even_and_smooth() {
        for (n, wanted) in [(0, 2), (7, 8), (2, 2), (11, 12), (2380, 2400), (4097, 4320)] {
            assert_eq!(transform_length(n), wanted);
        }
    }
}
