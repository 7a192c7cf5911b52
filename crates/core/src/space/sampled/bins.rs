//! Spectra in equal bins from zero to half the sample rate, and their autocorrelation.

use std::f64::consts::PI;

use pulp::{Arch, Simd, WithSimd};

use crate::dsp::ar::SIDE_BY_SIDE;
use crate::space::sampled::exponential::exp;
use crate::units::Hertz;

/// Number of values processed in parallel.
const LANES: usize = 8;

/// Bins of equal width from zero to half the sample rate; each is represented by its center frequency.
#[derive(Clone, Debug)]
pub(super) struct Bins {
    rate: Hertz,
    len: usize,
    /// `cos(k ω)` of the lower half of the bins, lag by lag. The upper half has the same values, with opposite sign at
    /// odd lags.
    cosines: Vec<f64>,
    n_lags: usize,
}

impl Bins {
    /// At least `n_bins` bins (rounded up to a multiple of twice [`LANES`]), for autocorrelation lags up to `order`.
    pub(super) fn new(rate: Hertz, n_bins: usize, order: usize) -> Self {
        let n_bins = n_bins.next_multiple_of(2 * LANES);
        let angle = |lag: usize, bin: usize| PI * lag as f64 * (bin as f64 + 0.5) / n_bins as f64;
        let of_lag = |lag: usize| (0..n_bins / 2).map(move |bin| angle(lag, bin).cos());
        Self { rate, len: n_bins, cosines: (0..=order).flat_map(of_lag).collect(), n_lags: order + 1 }
    }

    /// Number of bins.
    pub(super) fn len(&self) -> usize {
        self.len
    }

    /// Center frequencies of the bins.
    pub(super) fn frequencies(&self) -> Vec<Hertz> {
        let share = |bin: usize| (bin as f64 + 0.5) / self.len as f64;
        (0..self.len).map(|bin| Hertz(0.5 * self.rate.0 * share(bin))).collect()
    }

    /// Autocorrelations in (m/s²)², from lag zero on, of signals with densities `e^ln_psd`; at most [`SIDE_BY_SIDE`]
    /// signals.
    pub(super) fn lags(&self, ln_psds: &[&[f32]]) -> Vec<[f64; SIDE_BY_SIDE]> {
        let mut lags = vec![[0.0; SIDE_BY_SIDE]; self.n_lags];
        Arch::new().dispatch(Autocorrelations { bins: self, ln_psds, lags: &mut lags });
        lags
    }
}

struct Autocorrelations<'a> {
    bins: &'a Bins,
    ln_psds: &'a [&'a [f32]],
    lags: &'a mut [[f64; SIDE_BY_SIDE]],
}

impl WithSimd for Autocorrelations<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "without inlining, the loop is compiled for the baseline CPU")]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { bins, ln_psds, lags } = self;
        let half = bins.len / 2;
        let width_hz = 0.5 * bins.rate.0 / bins.len as f64;
        let mut powers = vec![0.0; 2 * bins.len];
        let (powers, folded) = powers.split_at_mut(bins.len);
        let (sums, differences) = folded.split_at_mut(half);
        for (side, ln_psd) in ln_psds.iter().enumerate() {
            for (power, ln) in powers.iter_mut().zip(*ln_psd) {
                *power = width_hz * exp(f64::from(*ln));
            }
            let (low, high) = powers.split_at(half);
            for (i, (below, above)) in low.iter().zip(high.iter().rev()).enumerate() {
                (sums[i], differences[i]) = (below + above, below - above);
            }
            for (k, (lag, cosines)) in lags.iter_mut().zip(bins.cosines.chunks_exact(half)).enumerate() {
                let values = if k % 2 == 0 { &*sums } else { &*differences };
                let mut parts = [0.0; LANES];
                for (value, cosine) in
                    values.as_chunks::<LANES>().0.iter().zip(cosines.as_chunks::<LANES>().0)
                {
                    for i in 0..LANES {
                        parts[i] += value[i] * cosine[i];
                    }
                }
                lag[side] = parts.iter().sum();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Bins;
    use crate::maths::rng::Random;
    use crate::units::Hertz;
    use std::f64::consts::PI;

    #[test]
    fn lags_are_those_of_the_sum_of_cosines() {
        let bins = Bins::new(Hertz(2000.0), 100, 9);
        let mut random = Random::new(1);
        let ln_psd: Vec<f32> = (0..bins.len()).map(|_| (3.0 * random.normal()) as f32).collect();
        let turned: Vec<f32> = ln_psd.iter().rev().copied().collect();
        let both = bins.lags(&[&turned, &ln_psd]);
        let lags: Vec<f64> = both.iter().map(|lag| lag[1]).collect();
        assert_eq!((bins.len(), lags.len()), (112, 10));
        for (k, lag) in lags.iter().enumerate() {
            let term =
                |(f, ln): (&Hertz, &f32)| f64::from(*ln).exp() * (2.0 * PI * f.0 * k as f64 / 2000.0).cos();
            let slow: f64 = bins.frequencies().iter().zip(&ln_psd).map(term).sum::<f64>() * 1000.0 / 112.0;
            assert!((lag - slow).abs() < 1e-9 * lags[0], "{k}: {lag} for {slow}");
        }
    }
}
