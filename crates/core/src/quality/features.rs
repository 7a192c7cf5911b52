//! Features of one signal, piece by piece.

use std::fmt;
use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use crate::quality::correlation::Correlator;
use crate::quality::real_transform::{bins_of, samples_of};
use crate::statistics::{centered, dot, is_constant, mean};
use crate::units::Hertz;

/// Lags at which a signal is compared with itself, in s.
const LAGS_SECS: (f64, f64) = (0.002, 0.05);
/// Highest frequency of an envelope, in Hz.
const ENVELOPE_HZ: f64 = 20.0;
/// How far envelopes are shifted against each other, in s.
const SHIFT_SECS: f64 = 0.05;
/// Mean power in (m/s²)² below which nothing is felt, and what is less counts as this: silence has no logarithm.
const LEAST_POWER: f64 = 1e-10;

/// The features that a signal has by itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Features {
    /// `log₁₀` of the mean power in (m/s²)².
    pub roughness: f64,
    /// `Σ f|X| / Σ |X|` in Hz; 0 of silence.
    pub brightness_hz: f64,
    /// Highest unbiased autocorrelation at lags of 2 to 50 ms, relative to that at none; 0 of silence.
    pub regularity: f64,
    /// Skewness; 0 of silence.
    pub asymmetry: f64,
}

impl Features {
    pub(super) fn add(&mut self, other: &Self, share: f64) {
        self.roughness += share * other.roughness;
        self.brightness_hz += share * other.brightness_hz;
        self.regularity += share * other.regularity;
        self.asymmetry += share * other.asymmetry;
    }
}

/// What is needed of a piece to compare it.
#[derive(Clone, Debug)]
pub(super) struct Measured {
    pub(super) features: Features,
    /// Without its mean, from zero to half the rate, not scaled.
    pub(super) spectrum: Vec<Complex<f64>>,
    /// Without its mean.
    pub(super) envelope: Vec<f64>,
}

/// Measures pieces of one length.
#[derive(Clone)]
pub(super) struct FeatureMeter {
    rate: Hertz,
    /// Shortest lag of the regularity, in samples.
    least_lag: usize,
    /// To the longest lag of the regularity, and to the furthest shift of envelopes.
    lags: Correlator,
    shifts: Correlator,
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
    analytic: Arc<dyn Fft<f64>>,
}

impl fmt::Debug for FeatureMeter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FeatureMeter").field("rate", &self.rate).finish_non_exhaustive()
    }
}

impl FeatureMeter {
    pub(super) fn new(n_segment: usize, rate: Hertz) -> Self {
        let mut planner = RealFftPlanner::new();
        let samples = |secs: f64| (secs * rate.0) as usize;
        let correlator = |secs: f64| Correlator::new(n_segment, samples(secs));
        Self {
            rate,
            least_lag: samples(LAGS_SECS.0).max(1),
            lags: correlator(LAGS_SECS.1),
            shifts: correlator(SHIFT_SECS),
            forward: planner.plan_fft_forward(n_segment),
            backward: planner.plan_fft_inverse(n_segment),
            analytic: FftPlanner::new().plan_fft_inverse(n_segment),
        }
    }

    /// The features, the spectrum and the envelope of a piece.
    pub(super) fn measure(&self, piece: &[f64]) -> Measured {
        let signal = centered(piece);
        let mut spectrum = bins_of(&*self.forward, &signal);
        let mut envelope = self.envelope(&spectrum, mean(piece));
        // What is left of a constant is round-off, and below what is felt at all nothing has features.
        let is_silent = is_constant(piece) || dot(&signal, &signal) < LEAST_POWER * piece.len() as f64;
        if is_silent {
            spectrum.fill(Complex::ZERO);
            envelope.fill(0.0);
        }
        let roughness = (dot(piece, piece) / piece.len() as f64).max(LEAST_POWER).log10();
        let features = if is_silent {
            Features { roughness, ..Features::default() }
        } else {
            Features {
                roughness,
                brightness_hz: self.brightness_hz(&spectrum, piece.len()),
                regularity: self.regularity(&signal),
                asymmetry: asymmetry(&signal),
            }
        };
        Measured { features, spectrum, envelope }
    }

    /// One less the highest correlation of two envelopes within the furthest shift; 0 of two that do not vary, 1 where only
    /// one does.
    pub(super) fn envelope_distance(&self, a: &[f64], b: &[f64]) -> f64 {
        if a == b {
            return 0.0;
        }
        let norm = (dot(a, a) * dot(b, b)).sqrt();
        if norm == 0.0 { 1.0 } else { (1.0 - self.shifts.highest(a, b) / norm).max(0.0) }
    }

    /// The magnitude of the analytic signal up to 20 Hz, without its mean, of a signal's spectrum and its mean.
    fn envelope(&self, spectrum: &[Complex<f64>], mean: f64) -> Vec<f64> {
        let n = self.analytic.len();
        let mut analytic = vec![Complex::ZERO; n];
        analytic[0] = Complex::new(mean, 0.0);
        for (k, (to, from)) in analytic.iter_mut().zip(spectrum).enumerate().skip(1) {
            *to = *from * if 2 * k == n { 1.0 } else { 2.0 } / n as f64;
        }
        self.analytic.process(&mut analytic);
        let magnitude: Vec<f64> = analytic.iter().map(size).collect();
        if is_constant(&magnitude) {
            return vec![0.0; n];
        }
        let mut bins = bins_of(&*self.forward, &magnitude);
        bins[0] = Complex::ZERO;
        for (k, bin) in bins.iter_mut().enumerate() {
            let is_slow = k as f64 * self.rate.0 <= ENVELOPE_HZ * n as f64;
            *bin *= if is_slow { 1.0 / n as f64 } else { 0.0 };
        }
        samples_of(&*self.backward, bins)
    }

    fn brightness_hz(&self, spectrum: &[Complex<f64>], n_samples: usize) -> f64 {
        let (mut moment, mut sum) = (0.0, 0.0);
        for (k, bin) in spectrum.iter().enumerate() {
            moment += k as f64 * size(bin);
            sum += size(bin);
        }
        self.rate.0 / n_samples as f64 * moment / sum
    }

    fn regularity(&self, signal: &[f64]) -> f64 {
        let n = signal.len();
        let power = dot(signal, signal);
        let sums = self.lags.with_itself(signal);
        let unbiased = |(lag, sum): (usize, &f64)| sum / power * n as f64 / (n - lag) as f64;
        sums.iter().enumerate().skip(self.least_lag).map(unbiased).fold(f64::MIN, f64::max)
    }
}

/// The magnitude of a bin. `norm` is many times slower, for magnitudes whose squares are no numbers: no touch has these.
pub(super) fn size(bin: &Complex<f64>) -> f64 {
    bin.norm_sqr().sqrt()
}

/// `mean(x³) / mean(x²)^1.5` of a signal without its mean.
fn asymmetry(signal: &[f64]) -> f64 {
    let n = signal.len() as f64;
    let cubes: f64 = signal.iter().map(|x| x * x * x).sum();
    cubes / n / (dot(signal, signal) / n).powf(1.5)
}
