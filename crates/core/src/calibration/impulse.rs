//! A recording divided by the sweep.

use std::f64::consts::{PI, TAU};

use realfft::RealFftPlanner;
use realfft::num_complex::Complex;

use crate::actuator::Drive;
use crate::calibration::sweep::Sweep;
use crate::filter::{butterworth_high_pass, decimate, filter_zero_phase};
use crate::units::Hertz;

/// The rate that is worked at, over the highest frequency of the sweep: room for harmonics.
const RATE_RATIO: f64 = 8.0;
/// Below this share of the sweep's beginning there is only drift.
const DRIFT_SHARE: f64 = 1.0 / 3.0;
/// Where the edges of the band end that is divided, as shares of the ends of the sweep: closer to them there is too little
/// of it.
pub(super) const LOW_EDGE: f64 = 1.15;
pub(super) const HIGH_EDGE: f64 = 1.0 / 1.05;

/// The recording at a rate that is worked at, without gravity and drift.
pub(super) fn prepare(recording: &[f64], rate: Hertz, sweep: &Sweep) -> (Vec<f64>, Hertz) {
    let factor = ((rate.0 / (RATE_RATIO * sweep.high.0)) as usize).max(1);
    let mean = recording.iter().sum::<f64>() / recording.len() as f64;
    // Without its mean the recording begins and ends near zero, which is what the filters take it for beyond its ends.
    let centered: Vec<f64> = recording.iter().map(|sample| sample - mean).collect();
    let mut signal = decimate(&centered, factor);
    let rate = Hertz(rate.0 / factor as f64);
    filter_zero_phase(&butterworth_high_pass(4, Hertz(DRIFT_SHARE * sweep.low.0), rate), &mut signal);
    (signal, rate)
}

/// What an actuator does for an impulse of voltage, harmonics ahead of it: over time, in a circle.
pub(super) struct Impulse {
    /// Samples a second.
    pub(super) rate: Hertz,
    /// The response, in (m/s²)/V a sample; what comes before zero stands at the end.
    pub(super) samples: Vec<f64>,
    /// Its transform, from zero to half the rate.
    pub(super) bins: Vec<Complex<f64>>,
    /// Magnitudes of the sweep's transform, in V.
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
            assert!(done.is_ok(), "the lengths are those that the plan asked for: {done:?}");
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
        // Numbers at the ends of the band have no imaginary part.
        bins[0] = Complex::default();
        bins[n / 2].im = 0.0;
        let (mut spectrum, mut samples) = (bins.clone(), back.make_output_vec());
        let done = back.process(&mut spectrum, &mut samples);
        assert!(done.is_ok(), "the lengths are those that the plan asked for: {done:?}");
        for sample in &mut samples {
            *sample /= n as f64;
        }
        Self { rate, samples, bins, sweep_bins: played.iter().map(|bin| bin.norm()).collect() }
    }

    /// Width of a bin in Hz.
    pub(super) fn bin_hz(&self) -> f64 {
        self.rate.0 / self.samples.len() as f64
    }

    /// Magnitude of the sweep's transform at a frequency, in V a sample.
    pub(super) fn sweep_at(&self, frequency: Hertz) -> f64 {
        self.sweep_bins[((frequency.0 / self.bin_hz()).round() as usize).min(self.sweep_bins.len() - 1)]
    }

    /// What a window keeps of the response.
    pub(super) fn windowed(&self, window: &Window) -> Vec<f64> {
        let n = self.samples.len();
        let first =
            ((window.at_secs - window.before_secs) * self.rate.0).round().rem_euclid(n as f64) as usize;
        let sample = |(i, share): (usize, f64)| share * self.samples[(first + i) % n];
        window.shape().into_iter().enumerate().map(sample).collect()
    }
}

/// A stretch of the impulse response with soft edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    /// Samples a second.
    pub(super) rate: Hertz,
    /// What it is about, in seconds.
    pub(super) at_secs: f64,
    /// Where it begins, in seconds before that.
    pub(super) before_secs: f64,
    /// Where it ends, in seconds behind that.
    pub(super) after_secs: f64,
}

/// The share of a window's parts before and behind its center over which it rises and falls.
const EDGE_SHARE: f64 = 0.4;

impl Window {
    /// Its weights, 0 to 1.
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

/// Magnitude of the transform of `signal` at a frequency.
pub(super) fn magnitude_at(signal: &[f64], frequency: Hertz, rate: Hertz) -> f64 {
    let step = Complex::from_polar(1.0, -TAU * frequency.0 / rate.0);
    // Blocks keep rounding from adding up along the circle.
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

/// How much of a frequency is divided: all of it within the sweep, nothing outside, with soft edges in between.
fn band_share(hz: f64, sweep: &Sweep) -> f64 {
    let rise = |from: f64, to: f64| {
        let share = (hz / from).ln() / (to / from).ln();
        0.5 - 0.5 * (PI * share.clamp(0.0, 1.0)).cos()
    };
    rise(sweep.low.0, LOW_EDGE * sweep.low.0) * rise(sweep.high.0, HIGH_EDGE * sweep.high.0)
}
