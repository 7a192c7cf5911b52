//! Features of one signal, segment by segment.

use std::fmt;
use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use crate::maths::statistics::{centered, dot, is_constant, mean};
use crate::signals::quality::correlation::Correlator;
use crate::signals::quality::real_transform::{bins_of, samples_of};
use crate::units::Hertz;

/// Range of autocorrelation lags for regularity, in s.
const LAGS_SECS: (f64, f64) = (0.002, 0.05);
/// Upper band limit of the envelope, in Hz.
const ENVELOPE_HZ: f64 = 20.0;
/// Largest lag between two envelopes, in s.
const SHIFT_SECS: f64 = 0.05;
/// Floor of the mean power in (m/s²)², below which nothing is perceptible; it keeps the logarithm of silence finite.
pub(super) const LEAST_POWER: f64 = 1e-10;

/// Features of a single signal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Features {
    /// Log₁₀ of the mean power in (m/s²)².
    pub roughness: f64,
    /// Spectral centroid `Σ f|X| / Σ |X|` in Hz; 0 for silence.
    pub brightness_hz: f64,
    /// Largest unbiased autocorrelation at lags of 2 to 50 ms, relative to lag 0; 0 for silence.
    pub regularity: f64,
    /// Skewness of the samples; 0 for silence.
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

/// Features, spectrum and envelope of a segment, for comparison.
#[derive(Clone, Debug)]
pub(super) struct Measured {
    pub(super) features: Features,
    /// Spectrum after mean removal, from DC to Nyquist, not normalized.
    pub(super) spectrum: Vec<Complex<f64>>,
    /// Envelope after mean removal.
    pub(super) envelope: Vec<f64>,
}

/// Measures segments of one length.
#[derive(Clone)]
pub(super) struct FeatureMeter {
    rate: Hertz,
    /// Shortest lag for regularity, in samples.
    least_lag: usize,
    /// Correlators up to the longest lag for regularity, and up to the largest lag between envelopes.
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

    /// Returns the features, spectrum and envelope of a segment.
    pub(super) fn measure(&self, piece: &[f64]) -> Measured {
        let signal = centered(piece);
        let mut spectrum = bins_of(&*self.forward, &signal);
        let mut envelope = self.envelope(&spectrum, mean(piece));
        // A constant leaves only round-off, and a signal below the power floor has no features.
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

    /// Returns 1 minus the largest correlation of two envelopes within the lag range.
    ///
    /// It is 0 if both are constant, and 1 if only one is.
    pub(super) fn envelope_distance(&self, a: &[f64], b: &[f64]) -> f64 {
        if a == b {
            return 0.0;
        }
        let norm = (dot(a, a) * dot(b, b)).sqrt();
        if norm == 0.0 { 1.0 } else { (1.0 - self.shifts.highest(a, b) / norm).max(0.0) }
    }

    /// Returns the magnitude of the analytic signal, low-passed at 20 Hz, with its mean removed.
    ///
    /// Inputs are the spectrum of the signal without its mean, and the mean.
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

/// Magnitude of a bin. `Complex::norm` is much slower; it guards against overflow, which touch signals do not reach.
pub(super) fn size(bin: &Complex<f64>) -> f64 {
    bin.norm_sqr().sqrt()
}

/// Skewness `mean(x³) / mean(x²)^1.5` of a signal with zero mean.
fn asymmetry(signal: &[f64]) -> f64 {
    let n = signal.len() as f64;
    let cubes: f64 = signal.iter().map(|x| x * x * x).sum();
    cubes / n / (dot(signal, signal) / n).powf(1.5)
}
