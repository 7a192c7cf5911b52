//! Activation of the frequency channels of the skin (Bensmaïa's minichannels).

use std::f64::consts::TAU;

use rustfft::num_complex::Complex;

use crate::dsp::threshold::Threshold;
use crate::signals::quality::features::size;
use crate::units::Hertz;

/// Relative bandwidth α of a channel: not published, chosen here.
const SMOOTHING: f64 = 0.2;
/// Number of channels, and their frequency range in Hz.
const N_CHANNELS: usize = 100;
const BAND_HZ: (f64, f64) = (40.0, 1000.0);
/// Exponents a over frequency in Hz, linear in ln frequency: half of Stevens's exponents for amplitude.
const EXPONENTS: [(f64, f64); 2] = [(60.0, 0.475), (250.0, 0.30)];
/// Channel weights below this fraction of the maximum are omitted.
const LEAST_WEIGHT: f64 = 1e-12;

/// Channels for the spectral bins of a segment.
#[derive(Clone, Debug)]
pub(super) struct Channels {
    /// Spectral bins within the channels' frequency range.
    bins: std::ops::Range<usize>,
    /// Per bin: factor from bin magnitude to displacement relative to threshold, and exponent.
    scales: Vec<(f64, f64)>,
    /// Per channel: its first bin (counted from `bins.start`) and its weights.
    weights: Vec<(usize, Vec<f64>)>,
}

impl Channels {
    pub(super) fn new(n_segment: usize, rate: Hertz, threshold: &Threshold) -> Self {
        let hz = |bin: usize| bin as f64 * rate.0 / n_segment as f64;
        let heard: Vec<usize> =
            (1..=n_segment / 2).filter(|bin| (BAND_HZ.0..=BAND_HZ.1).contains(&hz(*bin))).collect();
        let bins = heard.first().map_or(0..0, |first| *first..first + heard.len());
        let scale = |bin: usize| {
            let f = hz(bin);
            let threshold_um = 10.0_f64.powf(threshold.displacement_db_um(Hertz(f)) / 20.0);
            // Peak displacement in µm of a tone with unit bin magnitude.
            let um = 1e6 * 2.0 / (n_segment as f64 * (TAU * f).powi(2));
            (um / threshold_um, exponent(f))
        };
        let weights = (0..N_CHANNELS).map(|channel| {
            let center = BAND_HZ.0 * (BAND_HZ.1 / BAND_HZ.0).powf(channel as f64 / (N_CHANNELS - 1) as f64);
            let weight = |bin: usize| (-0.5 * ((hz(bin) - center) / (SMOOTHING * center)).powi(2)).exp();
            let is_heard = |bin: &usize| weight(*bin) > LEAST_WEIGHT;
            let first = bins.clone().find(is_heard).unwrap_or(bins.end);
            (first - bins.start, (first..bins.end).take_while(is_heard).map(weight).collect())
        });
        Self { scales: bins.clone().map(scale).collect(), weights: weights.collect(), bins }
    }

    /// Returns the distances of two spectra by power and by amplitude: `Σ |Z₁ - Z₂|` over channels.
    ///
    /// By power, `Z = Σ (A/T)^(2a) exp(-(f - f_c)² / 2(αf_c)²)`; by amplitude, `(A/T)^a` replaces `(A/T)^(2a)`.
    pub(super) fn distances(&self, a: &[Complex<f64>], b: &[Complex<f64>]) -> [f64; 2] {
        let felt = |bin: &Complex<f64>, (scale, exponent): (f64, f64)| (size(bin) * scale).powf(exponent);
        let bins = a[self.bins.clone()].iter().zip(&b[self.bins.clone()]).zip(&self.scales);
        let apart: Vec<(f64, f64)> = bins
            .map(|((x, y), scale)| (felt(x, *scale), felt(y, *scale)))
            .map(|(x, y)| (x * x - y * y, x - y))
            .collect();
        let mut sums = [0.0; 2];
        for (first, weights) in &self.weights {
            let (mut power, mut amplitude) = (0.0, 0.0);
            for (w, (p, q)) in weights.iter().zip(&apart[*first..]) {
                power += w * p;
                amplitude += w * q;
            }
            sums[0] += power.abs();
            sums[1] += amplitude.abs();
        }
        sums
    }
}

/// Exponent a at a frequency in Hz.
fn exponent(hz: f64) -> f64 {
    let [low, high] = EXPONENTS;
    let share = (hz / low.0).ln() / (high.0 / low.0).ln();
    low.1 + (high.1 - low.1) * share.clamp(0.0, 1.0)
}
