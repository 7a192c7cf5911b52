//! Impulse response: the recording divided by the sweep in the frequency domain.

use std::f64::consts::{PI, TAU};

use realfft::RealFftPlanner;
use realfft::num_complex::Complex;

use crate::actuator::Drive;
use crate::actuator::calibration::sweep::Sweep;
use crate::dsp::filter::{butterworth_high_pass, decimate, filter_zero_phase};
use crate::units::Hertz;

/// Ratio of the analysis sample rate to the highest frequency of the sweep; leaves room for harmonics.
const RATE_RATIO: f64 = 8.0;
/// Fraction of the sweep's start frequency below which the recording contains only drift.
const DRIFT_SHARE: f64 = 1.0 / 3.0;
/// Ends of the band edges, relative to the ends of the sweep; closer to the ends the sweep has too little energy.
pub(super) const LOW_EDGE: f64 = 1.15;
pub(super) const HIGH_EDGE: f64 = 1.0 / 1.05;

/// Recording at the analysis sample rate, without gravity and drift.
pub(super) fn prepare(recording: &[f64], rate: Hertz, sweep: &Sweep) -> (Vec<f64>, Hertz) {
    let factor = ((rate.0 / (RATE_RATIO * sweep.high.0)) as usize).max(1);
    let mean = recording.iter().sum::<f64>() / recording.len() as f64;
    // Without its mean the recording starts and ends near zero, as the filters assume.
    let centered: Vec<f64> = recording.iter().map(|sample| sample - mean).collect();
    let mut signal = decimate(&centered, factor);
    let rate = Hertz(rate.0 / factor as f64);
    filter_zero_phase(&butterworth_high_pass(4, Hertz(DRIFT_SHARE * sweep.low.0), rate), &mut signal);
    (signal, rate)
}

/// Circular impulse response of an actuator to a voltage, preceded by its harmonics.
pub(super) struct Impulse {
    /// Sample rate.
    pub(super) rate: Hertz,
    /// Impulse response in (m/s²)/V per sample; negative times are at the end.
    pub(super) samples: Vec<f64>,
    /// Transform of the impulse response, from zero to the Nyquist frequency.
    pub(super) bins: Vec<Complex<f64>>,
    /// Magnitude of the sweep's transform, in V.
    sweep_bins: Vec<f64>,
}

impl Impulse {
    /// Divides a prepared recording by the sweep.
    pub(super) fn new(signal: &[f64], rate: Hertz, sweep: &Sweep, drive: Drive) -> Self {
        let played = sweep.samples(rate);
        let n = (signal.len() + played.len()).next_power_of_two();
        let mut planner = RealFftPlanner::<f64>::new();
        let (forward, back) = (planner.plan_fft_forward(n), planner.plan_fft_inverse(n));
        let transform = |values: &[f64], scale: f64| {
            let (mut input, mut bins) = (forward.make_input_vec(), forward.make_output_vec());
            for (to, from) in input.iter_mut().zip(values) {
                *to = scale * from;
            }
            let done = forward.process(&mut input, &mut bins);
            assert!(done.is_ok(), "the buffers have the lengths of the plan: {done:?}");
            bins
        };
        let recorded = transform(signal, 1.0);
        let played = transform(&played, drive.full_scale.0);
        let bin_hz = rate.0 / n as f64;
        let divided = |(k, (y, x)): (usize, (&Complex<f64>, &Complex<f64>))| {
            let share = band_share(k as f64 * bin_hz, sweep);
            if share > 0.0 { y / x * share } else { Complex::default() }
        };
        let mut bins: Vec<Complex<f64>> = recorded.iter().zip(&played).enumerate().map(divided).collect();
        // The bins at zero and at the Nyquist frequency are real.
        bins[0] = Complex::default();
        bins[n / 2].im = 0.0;
        let (mut spectrum, mut samples) = (bins.clone(), back.make_output_vec());
        let done = back.process(&mut spectrum, &mut samples);
        assert!(done.is_ok(), "the buffers have the lengths of the plan: {done:?}");
        for sample in &mut samples {
            *sample /= n as f64;
        }
        Self { rate, samples, bins, sweep_bins: played.iter().map(|bin| bin.norm()).collect() }
    }

    /// Bin width in Hz.
    pub(super) fn bin_hz(&self) -> f64 {
        self.rate.0 / self.samples.len() as f64
    }

    /// Magnitude of the sweep's transform at a frequency, in V per sample.
    pub(super) fn sweep_at(&self, frequency: Hertz) -> f64 {
        self.sweep_bins[((frequency.0 / self.bin_hz()).round() as usize).min(self.sweep_bins.len() - 1)]
    }

    /// Impulse response multiplied by a window.
    pub(super) fn windowed(&self, window: &Window) -> Vec<f64> {
        let n = self.samples.len();
        let first =
            ((window.at_secs - window.before_secs) * self.rate.0).round().rem_euclid(n as f64) as usize;
        let sample = |(i, share): (usize, f64)| share * self.samples[(first + i) % n];
        window.shape().into_iter().enumerate().map(sample).collect()
    }
}

/// Window with soft edges on the impulse response.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    /// Sample rate.
    pub(super) rate: Hertz,
    /// Center, in seconds.
    pub(super) at_secs: f64,
    /// Duration before the center, in seconds.
    pub(super) before_secs: f64,
    /// Duration after the center, in seconds.
    pub(super) after_secs: f64,
}

/// Fraction of the parts before and after the center over which the window rises and falls.
const EDGE_SHARE: f64 = 0.4;

impl Window {
    /// Window weights, 0 to 1.
    pub(super) fn shape(&self) -> Vec<f64> {
        let n = ((self.before_secs + self.after_secs) * self.rate.0).round() as usize;
        let soft = |share: f64| 0.5 - 0.5 * (PI * (share / EDGE_SHARE).clamp(0.0, 1.0)).cos();
        let weight = |i: usize| {
            let t = i as f64 / self.rate.0;
            let left = self.before_secs + self.after_secs - t;
            soft(t / self.before_secs) * soft(left / self.after_secs)
        };
        (0..n).map(weight).collect()
    }
}

/// Magnitude of the Fourier transform of `signal` at a frequency.
pub(super) fn magnitude_at(signal: &[f64], frequency: Hertz, rate: Hertz) -> f64 {
    let step = Complex::from_polar(1.0, -TAU * frequency.0 / rate.0);
    // Blocks limit the accumulation of rounding errors in the rotation.
    let sum: Complex<f64> = signal
        .chunks(256)
        .enumerate()
        .map(|(block, samples)| {
            let mut turn = Complex::from_polar(1.0, -TAU * frequency.0 / rate.0 * (256 * block) as f64);
            let mut sum = Complex::default();
            for sample in samples {
                sum += turn * *sample;
                turn *= step;
            }
            sum
        })
        .sum();
    sum.norm()
}

/// Weight of a frequency in the division: one within the sweep, zero outside, with soft edges.
fn band_share(hz: f64, sweep: &Sweep) -> f64 {
    let rise = |from: f64, to: f64| {
        let share = (hz / from).ln() / (to / from).ln();
        0.5 - 0.5 * (PI * share.clamp(0.0, 1.0)).cos()
    };
    rise(sweep.low.0, LOW_EDGE * sweep.low.0) * rise(sweep.high.0, HIGH_EDGE * sweep.high.0)
}
