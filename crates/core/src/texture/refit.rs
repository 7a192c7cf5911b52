//! Refit of a filter: its spectrum on a grid of frequencies, and the lags of the spectrum, from which a predictor is
//! fitted.
//!
//! The grid covers zero to half of a rate that may differ from the filter's own. The spectrum up to the old Nyquist
//! frequency is kept, and the density above it falls steeply. The Fourier transform of the spectrum is its
//! autocorrelation (Wiener-Khinchin theorem).

use std::f64::consts::PI;

use crate::dsp::arma;
use crate::units::Hertz;

/// Lowest order of a refitted predictor. A texture of a higher order keeps its order, and with it its sharp peaks.
pub(super) const LEAST_ORDER: usize = 32;
/// Number of spectral points between zero and the new Nyquist frequency.
const N_POINTS: usize = 2048;
/// Width of the transition above the old Nyquist frequency, relative to that frequency, and density above the
/// transition. The density is relative to the smaller of the density at the old Nyquist frequency and the mean density.
///
/// A steeper or deeper transition makes the predictor spend its order on the transition; a gentler one leaves audible
/// content above. These two values minimize the error over the starter library from 1 to 2 kHz.
const FALL: f64 = 0.4;
const FLOOR: f64 = 1e-4;
/// Lowest density relative to the mean; deeper notches make the equations ill-conditioned.
pub(super) const FAINTEST: f64 = 1e-8;

/// Frequencies between zero and half of a new rate, shared by all nodes of a texture.
pub(super) struct SpectrumGrid {
    own: Hertz,
    rate: Hertz,
    /// Points of the new spectrum below the old Nyquist frequency.
    below: Vec<Hertz>,
    /// Progress of the transition at each point above the old Nyquist frequency, 0 to 1.
    fall: Vec<f64>,
    /// `cos(2π f k / rate)`: for each point `f`, one for each lag `k` up to the order.
    cosines: Vec<f64>,
    n_lags: usize,
}

impl SpectrumGrid {
    /// Grid up to half of `rate`, for filters of the rate `own` that become predictors of this order.
    pub(super) fn new(own: Hertz, rate: Hertz, order: usize) -> Self {
        let nyquist = 0.5 * own.0;
        let (below, above): (Vec<f64>, Vec<f64>) =
            (0..N_POINTS).map(|i| point(i, rate).0).partition(|f| *f < nyquist);
        let fall = |f: f64| {
            let t = ((f - nyquist) / (FALL * nyquist)).min(1.0);
            0.5 - 0.5 * (PI * t).cos()
        };
        // Angles are in steps of π / 2N.
        let period = 4 * N_POINTS;
        let cosines: Vec<f64> = (0..period).map(|m| (PI * m as f64 / (2 * N_POINTS) as f64).cos()).collect();
        Self {
            own,
            rate,
            below: below.into_iter().map(Hertz).collect(),
            fall: above.into_iter().map(fall).collect(),
            cosines: (0..N_POINTS)
                .flat_map(|i| (0..=order).map(move |k| (2 * i + 1) * k % period))
                .map(|angle| cosines[angle])
                .collect(),
            n_lags: order + 1,
        }
    }

    /// Frequencies of the points, from zero to half of the new rate.
    pub(super) fn frequencies(&self) -> impl Iterator<Item = Hertz> {
        let rate = self.rate;
        (0..N_POINTS).map(move |i| point(i, rate))
    }

    /// Density of a filter (AR and moving-average part) at every point, relative to its mean up to the old Nyquist
    /// frequency.
    pub(super) fn spectrum(&self, filter: &[Vec<f64>; 2]) -> Vec<f64> {
        let mut spectrum = relative_density(filter, self.own, &self.below);
        let edge = spectrum.last().copied().unwrap_or_default().max(FAINTEST);
        // A straight line in decibels with rounded ends.
        let floor = FLOOR * edge.min(1.0);
        spectrum.extend(self.fall.iter().map(|fallen| edge * (floor / edge).powf(*fallen)));
        spectrum
    }

    /// Share of the power of a filter that lies below the new Nyquist frequency, from its [`SpectrumGrid::spectrum`]:
    /// exactly 1 unless the new rate is lower.
    pub(super) fn kept_power(&self, spectrum: &[f64]) -> f64 {
        if self.rate.0 >= self.own.0 {
            return 1.0;
        }
        let mean = spectrum.iter().sum::<f64>() / N_POINTS as f64;
        (mean * self.rate.0 / self.own.0).clamp(0.0, 1.0)
    }

    /// Order of the predictors.
    pub(super) fn order(&self) -> usize {
        self.n_lags - 1
    }

    /// Autocorrelation of a density at the points, up to the lag of the order: `r_k = Σ S(f_i) cos(2π f_i k / rate)`.
    pub(super) fn lags(&self, spectrum: &[f64]) -> Vec<f64> {
        let mut lags = vec![0.0; self.n_lags];
        for (density, cosines) in spectrum.iter().zip(self.cosines.chunks_exact(self.n_lags)) {
            for (lag, cosine) in lags.iter_mut().zip(cosines) {
                *lag += density * cosine;
            }
        }
        lags
    }
}

/// Frequency of a point of the grid up to half of `rate`.
fn point(index: usize, rate: Hertz) -> Hertz {
    Hertz((index as f64 + 0.5) * 0.5 * rate.0 / N_POINTS as f64)
}

/// Power spectral density of a filter (AR and moving-average part) at each frequency, relative to its mean.
pub(super) fn relative_density(filter: &[Vec<f64>; 2], rate: Hertz, frequencies: &[Hertz]) -> Vec<f64> {
    let power = arma::power_gain(&filter[0], &filter[1]);
    let response = arma::response(&filter[0], &filter[1], rate, frequencies);
    response.into_iter().map(|(re, im)| (re * re + im * im) / power).collect()
}

#[cfg(test)]
mod tests {
    use super::{LEAST_ORDER, SpectrumGrid};
    use crate::dsp::ar::levinson;
    use crate::dsp::ar::test_signals::from_resonances;
    use crate::units::Hertz;

    /// At its own rate, a predictor is fitted to itself, with zeros behind it.
    #[test]
    fn a_predictor_is_its_own_fit() {
        let rate = Hertz(1000.0);
        let ar = from_resonances(rate, &[(Hertz(70.0), 0.95), (Hertz(230.0), 0.9)]);
        for order in [LEAST_ORDER, 64] {
            let grid = SpectrumGrid::new(rate, rate, order);
            let spectrum = grid.spectrum(&[ar.clone(), Vec::new()]);
            assert_eq!(grid.kept_power(&spectrum), 1.0);
            let fit = levinson(&grid.lags(&spectrum), grid.order()).ar;
            assert_eq!(fit.len(), order);
            for (i, a) in fit.iter().enumerate() {
                let expected = ar.get(i).copied().unwrap_or_default();
                assert!((a - expected).abs() < 1e-8, "coefficient {i} is {a}, expected {expected}");
            }
        }
    }

    /// A narrower band keeps the power that lies in it, in closed form for white noise.
    #[test]
    fn what_leaves_the_band_is_counted() {
        let white = [vec![0.0], Vec::new()];
        for (rate_hz, kept) in [(250.0, 0.25), (900.0, 0.9), (1000.0, 1.0), (4000.0, 1.0)] {
            let grid = SpectrumGrid::new(Hertz(1000.0), Hertz(rate_hz), LEAST_ORDER);
            assert!((grid.kept_power(&grid.spectrum(&white)) - kept).abs() < 1e-12);
        }
    }
}
