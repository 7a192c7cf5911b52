//! Spectrum of strokes in a direction that was not measured, from those that were.
//!
//! Power over direction follows the law of [`PowerLaw`](super::power_law::PowerLaw) at every frequency. So the spectrum
//! in any direction is a weighted sum of the measured ones, and some weights are negative: they remove from a measured
//! direction what it has of the grain across it.

use std::f64::consts::PI;

use crate::dsp::ar::{levinson, power_gain, response};
use crate::dsp::lsf::{ar_from_lsf, lsf_from_ar, repair};
use crate::texture::GrainNode;
use crate::units::Hertz;

/// Number of frequencies of the spectrum.
const N_POINTS: usize = 1024;

/// Lowest density of the result relative to the quietest measured direction at the same frequency: negative densities,
/// from random errors of the measured ones, do not occur in a spectrum.
const LEAST_SHARE: f64 = 0.1;

/// Line spectral frequencies of the spectrum `Σ share · spectrum`, with as many coefficients as the nodes have. `None`
/// if the predictor of this spectrum is at the limit of stability.
pub(super) fn lsf(measured: &[GrainNode], shares: &[f64]) -> Option<Vec<f64>> {
    let order = measured.first()?.lsf.len();
    let spectra: Vec<Vec<f64>> = measured.iter().map(density).collect();
    let unmixed = |point: usize| {
        let sum: f64 = spectra.iter().zip(shares).map(|(spectrum, share)| share * spectrum[point]).sum();
        let quietest = spectra.iter().map(|spectrum| spectrum[point]).fold(f64::INFINITY, f64::min);
        sum.max(LEAST_SHARE * quietest)
    };
    let spectrum: Vec<f64> = (0..N_POINTS).map(unmixed).collect();
    lsf_of(&spectrum, order)
}

/// Line spectral frequencies of the predictor of a spectrum. The transform of the spectrum is its autocorrelation.
fn lsf_of(spectrum: &[f64], order: usize) -> Option<Vec<f64>> {
    let lag = |k: usize| -> f64 {
        let terms = spectrum.iter().enumerate();
        terms.map(|(point, density)| density * (PI * place(point) * k as f64).cos()).sum()
    };
    let lags: Vec<f64> = (0..=order).map(lag).collect();
    Some(repair(&lsf_from_ar(&levinson(&lags, order).ar)?))
}

/// Density of a node at every point, with a mean that is the power of the node.
fn density(node: &GrainNode) -> Vec<f64> {
    let ar = ar_from_lsf(&node.lsf);
    let scale = node.level_mps2.powi(2) / power_gain(&ar);
    // In units of the sample rate.
    let frequencies: Vec<Hertz> = (0..N_POINTS).map(|point| Hertz(0.5 * place(point))).collect();
    let gains = response(&ar, Hertz(1.0), &frequencies);
    gains.into_iter().map(|(re, im)| scale * (re * re + im * im)).collect()
}

/// Frequency of a point relative to the Nyquist frequency: the middle of one of [`N_POINTS`] bands.
fn place(point: usize) -> f64 {
    (point as f64 + 0.5) / N_POINTS as f64
}

#[cfg(test)]
mod tests {
    use super::{density, lsf, lsf_of};
    use crate::dsp::ar::test_signals::from_resonances;
    use crate::dsp::lsf::lsf_from_ar;
    use crate::dsp::spectrum::goodness_of_fit;
    use crate::recording::fit::directional::power_law::PowerLaw;
    use crate::texture::GrainNode;
    use crate::units::{Hertz, MetersPerSecond, Newtons};
    use std::f64::consts::FRAC_PI_2;

    fn node(lsf: Vec<f64>, level_mps2: f64) -> GrainNode {
        GrainNode { speed: MetersPerSecond(0.1), force: Newtons(1.0), lsf, level_mps2 }
    }

    fn resonances(hz: [f64; 2], level_mps2: f64) -> GrainNode {
        let ar = from_resonances(Hertz(1000.0), &hz.map(|hz| (Hertz(hz), 0.9)));
        node(lsf_from_ar(&ar).unwrap(), level_mps2)
    }

    #[test]
    fn one_direction_is_itself() {
        let node = resonances([90.0, 230.0], 3.0);
        let same = lsf(std::slice::from_ref(&node), &[2.0]).unwrap();
        for (same, own) in same.iter().zip(&node.lsf) {
            // The sum over 1024 bands is exact up to lags that have decayed to 0.9^2000.
            assert!((same - own).abs() < 1e-9, "got {same}, expected {own}");
        }
    }

    #[test]
    fn what_a_direction_has_of_another_is_removed() {
        let (across, along) = (resonances([90.0, 230.0], 1.0), resonances([160.0, 320.0], 0.5));
        let across_rad = 25_f64.to_radians();
        let axes = [0.0, 45.0, 90.0, 135.0].map(f64::to_radians);
        let measured = axes.map(|axis| {
            let share = (axis - across_rad).sin().powi(2);
            let mix = |(a, b): (f64, f64)| (1.0 - share) * a + share * b;
            let spectrum: Vec<f64> = density(&across).into_iter().zip(density(&along)).map(mix).collect();
            node(lsf_of(&spectrum, 16).unwrap(), mix((1.0, 0.25)).sqrt())
        });
        let powers = measured.each_ref().map(|node| node.level_mps2.powi(2));
        let law = PowerLaw::fit_across(&axes, &powers, across_rad).unwrap();
        let shares = law.shares(&axes, across_rad, across_rad + FRAC_PI_2).unwrap();
        let fit = |lsf: &[f64]| goodness_of_fit(&density(&node(lsf.to_vec(), 1.0)), &density(&along));
        let unmixed = fit(&lsf(&measured, &shares).unwrap());
        // Predictors of order 16 do not hold the mixtures exactly; a computation with the reference formulas gives 0.998.
        assert!(unmixed > 0.99, "{unmixed}");
        // Negative control: the nearest measured direction is not the grain along the lay.
        let nearest = fit(&measured[3].lsf);
        assert!(nearest < 0.95, "{nearest}");
    }
}
