//! The last seconds of the output signal, downsampled for drawing, with level, spectrum and contact over time.

use std::collections::VecDeque;

use shagreen_core::dsp::spectrum::{rms, welch};
use shagreen_core::dsp::threshold::Threshold;
use shagreen_core::units::Hertz;
use shagreen_device::synth::contact::Contact;

/// Duration of the kept samples, in seconds.
const KEPT_SECS: f64 = 2.0;
/// Ratio of the drawn sample rate to the model rate. The signal has no content above half the model rate.
const DRAWN_SHARE: f64 = 2.0;
/// Window of the live spectrum in samples of the drawn rate, for a resolution of 3.9 Hz at a model rate of 1 kHz.
const WINDOW: usize = 512;
/// Weight of a new spectrum in the exponential average.
const SMOOTHING: f64 = 0.25;
/// Duration of the kept moments, in seconds.
pub const MOMENTS_SECS: f64 = 5.0;
/// Largest magnitude that counts as silence, in m/s².
const SILENT_MPS2: f64 = 1e-3;
/// Interval between moments, in seconds.
const HOP_SECS: f64 = 0.032;
/// Window of a moment's spectrum, in seconds.
const MOMENT_SECS: f64 = 4.0 * HOP_SECS;

/// Level, spectrum and contact at one time.
#[derive(Clone, Debug)]
pub struct Moment {
    /// Root mean square of the acceleration in m/s².
    pub level_mps2: f64,
    /// One-sided power spectral density in (m/s²)²/Hz, from 0 Hz in steps of [`ScopeBuffer::moment_step_hz`].
    pub density: Vec<f32>,
    /// Tip speed in m/s; 0 without contact.
    pub speed_mps: f64,
    /// Normal force in N.
    pub force_n: f64,
}

/// Buffer of the output signal in m/s², for the scope.
#[derive(Clone, Debug)]
pub struct ScopeBuffer {
    rate_hz: f64,
    every: usize,
    skipped: usize,
    samples: VecDeque<f64>,
    density: Vec<(Hertz, f64)>,
    range: f64,
    /// Whether all kept samples were silent at the last update.
    is_silent: bool,
    moments: VecDeque<Moment>,
    /// Number of samples since the last moment.
    n_since: usize,
}

impl Moment {
    /// Ratio of the amplitude to the detection threshold, which is given by [`ScopeBuffer::weights`].
    pub fn multiple(&self, weights: &[f64]) -> f64 {
        self.density
            .iter()
            .zip(weights)
            .map(|(density, weight)| f64::from(*density) * weight)
            .sum::<f64>()
            .sqrt()
    }
}

impl ScopeBuffer {
    /// Creates an empty buffer for a device rate and a model rate, in Hz.
    pub fn new(device_rate_hz: f64, model_rate_hz: f64) -> Self {
        // The resampler leaves no content above half the model rate that could alias, so samples are skipped without a
        // filter.
        let every = (device_rate_hz / (DRAWN_SHARE * model_rate_hz)).floor().max(1.0) as usize;
        Self {
            rate_hz: device_rate_hz / every as f64,
            every,
            skipped: 0,
            samples: VecDeque::new(),
            density: Vec::new(),
            range: 1.0,
            is_silent: true,
            moments: VecDeque::new(),
            n_since: 0,
        }
    }

    /// Adds samples at the device rate, which were played with the given contact.
    pub fn push(&mut self, samples: &[f32], contact: Contact) {
        let hop = self.hop();
        for sample in samples {
            if self.skipped == 0 {
                // A non-finite sample has already silenced the output. Here it would make the average of the spectrum
                // non-finite forever.
                self.samples.push_back(if sample.is_finite() { f64::from(*sample) } else { 0.0 });
                self.n_since += 1;
                if self.n_since == hop {
                    self.keep_moment(contact);
                }
            }
            self.skipped = (self.skipped + 1) % self.every;
        }
        let kept = (KEPT_SECS * self.rate_hz) as usize;
        let excess = self.samples.len().saturating_sub(kept);
        self.samples.drain(..excess);
    }

    fn keep_moment(&mut self, contact: Contact) {
        self.n_since = 0;
        let window = self.moment_window();
        let Some(first) = self.samples.len().checked_sub(window) else { return };
        let newest: Vec<f64> = self.samples.range(first..).copied().collect();
        let density = welch(&newest, Hertz(self.rate_hz), window);
        if self.moments.len() == self.n_moments() {
            self.moments.pop_front();
        }
        let touches = contact.force_n > 0.0;
        self.moments.push_back(Moment {
            level_mps2: rms(&newest[window - self.hop()..]),
            density: density.iter().map(|(_, density)| *density as f32).collect(),
            speed_mps: if touches { f64::from(contact.speed_mps) } else { 0.0 },
            force_n: f64::from(contact.force_n.max(0.0)),
        });
    }

    /// Deletes all samples, moments and spectra.
    pub fn clear(&mut self) {
        self.samples.clear();
        self.moments.clear();
        self.density.clear();
        self.is_silent = true;
        self.n_since = 0;
    }

    /// Updates the spectrum and the range, once a frame.
    pub fn update(&mut self) {
        let newest: Vec<f64> = self.newest(0.75).1;
        let density = welch(&newest, Hertz(self.rate_hz), WINDOW);
        if self.density.len() == density.len() {
            for (shown, new) in self.density.iter_mut().zip(&density) {
                shown.1 += SMOOTHING * (new.1 - shown.1);
            }
        } else {
            self.density = density;
        }
        let peak = self.samples.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if peak > SILENT_MPS2 {
            let needed = nice_ceiling(peak);
            self.range = if self.is_silent { needed } else { self.range.max(needed) };
        }
        self.is_silent = peak <= SILENT_MPS2;
    }

    /// Sample rate in Hz, and the samples of the last `secs` seconds, oldest first.
    pub fn newest(&self, secs: f64) -> (f64, Vec<f64>) {
        let n = ((secs * self.rate_hz) as usize).min(self.samples.len());
        (self.rate_hz, self.samples.range(self.samples.len() - n..).copied().collect())
    }

    /// Exponentially averaged power spectral density, in (m/s²)²/Hz.
    pub fn density(&self) -> &[(Hertz, f64)] {
        &self.density
    }

    /// Round number in m/s² that no kept sample exceeds in magnitude. It grows when it must. It becomes smaller only when
    /// a signal begins after silence, so that the axis does not change during a stroke.
    pub fn range(&self) -> f64 {
        self.range
    }

    /// Root mean square of the last `secs` seconds, in m/s².
    pub fn rms(&self, secs: f64) -> f64 {
        rms(&self.newest(secs).1)
    }

    /// Moments of the last [`MOMENTS_SECS`] seconds, oldest first.
    pub fn moments(&self) -> impl ExactSizeIterator<Item = &Moment> + DoubleEndedIterator {
        self.moments.iter()
    }

    /// Number of moments of a full buffer.
    pub fn n_moments(&self) -> usize {
        (MOMENTS_SECS / self.hop_secs()).round() as usize
    }

    /// Interval between moments, in s.
    pub fn hop_secs(&self) -> f64 {
        self.hop() as f64 / self.rate_hz
    }

    /// Frequency step of a moment's density, in Hz.
    pub fn moment_step_hz(&self) -> f64 {
        self.rate_hz / self.moment_window() as f64
    }

    /// Weights of the frequencies of a moment's density relative to a detection threshold, for [`Moment::multiple`].
    pub fn weights(&self, threshold: &Threshold) -> Vec<f64> {
        let step = Hertz(self.moment_step_hz());
        (0..=self.moment_window() / 2).map(|i| threshold.weight(Hertz(i as f64 * step.0), step)).collect()
    }

    fn hop(&self) -> usize {
        ((HOP_SECS * self.rate_hz) as usize).max(1)
    }

    fn moment_window(&self) -> usize {
        // An even window has a bin at half the sample rate.
        2 * (0.5 * MOMENT_SECS * self.rate_hz) as usize
    }
}

/// Smallest of … 0.5, 1, 2, 5, 10, … that is at least `x`, and at least 0.5.
fn nice_ceiling(x: f64) -> f64 {
    let mut step = 0.5;
    for factor in [2.0, 2.0, 2.5].into_iter().cycle().take(30) {
        if step >= x {
            break;
        }
        step *= factor;
    }
    step
}

#[cfg(test)]
mod tests {
    use super::{MOMENTS_SECS, ScopeBuffer, nice_ceiling};
    use shagreen_device::synth::contact::Contact;

    const STILL: Contact = Contact { speed_mps: 0.0, force_n: 0.0 };

    #[test]
    fn keeps_the_newest_and_finds_a_tone() {
        let mut scope = ScopeBuffer::new(48_000.0, 1000.0);
        let tone: Vec<f32> =
            (0..48_000 * 4).map(|i| (std::f32::consts::TAU * 100.0 * i as f32 / 48_000.0).sin()).collect();
        for block in tone.chunks(700) {
            scope.push(block, STILL);
        }
        scope.update();
        assert_eq!(scope.newest(9.0).1.len(), 4000);
        assert!((scope.rms(1.0) - 0.5_f64.sqrt()).abs() < 0.01);
        let loudest = scope.density().iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        assert!((loudest.0.0 - 100.0).abs() < 4.0);
        assert_eq!(scope.range(), 1.0);
    }

    /// The range grows at once, stays while the signal becomes weaker, and is chosen anew after silence.
    #[test]
    fn the_range_is_constant_until_it_must_grow() {
        let mut scope = ScopeBuffer::new(1000.0, 500.0);
        let mut range_after = |peak: f32, n: usize| {
            for _ in 0..n {
                scope.push(&[peak; 100], STILL);
                scope.update();
            }
            scope.range()
        };
        assert_eq!(range_after(0.3, 1), 0.5);
        assert_eq!(range_after(4.0, 1), 5.0);
        assert_eq!(range_after(0.3, 50), 5.0, "the weaker signal fills the buffer");
        assert_eq!(range_after(0.0, 50), 5.0, "silence changes nothing");
        assert_eq!(range_after(0.3, 1), 0.5);
    }

    #[test]
    fn a_sample_that_is_no_number_does_not_blind_it() {
        let mut scope = ScopeBuffer::new(48_000.0, 1000.0);
        for sample in [f32::NAN, 1.0, f32::INFINITY] {
            scope.push(&vec![sample; 48_000], STILL);
            scope.update();
        }
        assert!(scope.density().iter().all(|(_, p)| p.is_finite()) && scope.range().is_finite());
        assert!(scope.moments().all(|moment| moment.level_mps2.is_finite()));
    }

    #[test]
    fn a_model_of_a_higher_rate_is_drawn_at_a_higher_rate() {
        assert_eq!(ScopeBuffer::new(48_000.0, 4000.0).newest(1.0).0, 8000.0);
        assert_eq!(ScopeBuffer::new(44_100.0, 1000.0).newest(1.0).0, 44_100.0 / 22.0);
    }

    /// Block size and rates do not affect the interval between moments, and the last five seconds are kept.
    #[test]
    fn moments_are_kept_as_they_were() {
        for (device_rate, model_rate, block) in
            [(48_000.0, 1000.0, 4096), (44_100.0, 1000.0, 333), (96_000.0, 2000.0, 64)]
        {
            let mut scope = ScopeBuffer::new(device_rate, model_rate);
            let n = (8.0 * device_rate) as usize;
            let samples: Vec<f32> = (0..n).map(|i| if i < n / 2 { 0.0 } else { 0.5 }).collect();
            for (i, block) in samples.chunks(block).enumerate() {
                let touch =
                    if (i * block.len()) < n / 2 { STILL } else { Contact { speed_mps: 0.2, force_n: 1.0 } };
                scope.push(block, touch);
            }
            assert_eq!(scope.moments().len(), scope.n_moments());
            assert!((scope.n_moments() as f64 * scope.hop_secs() - MOMENTS_SECS).abs() < scope.hop_secs());
            let n_loud = scope.moments().filter(|moment| moment.level_mps2 > 0.25).count();
            let n_touched = scope.moments().filter(|moment| moment.force_n > 0.0).count();
            let expected = 4.0 / scope.hop_secs();
            assert!((n_loud as f64 - expected).abs() <= 3.0, "{n_loud} for {expected}");
            assert!((n_touched as f64 - expected).abs() <= 5.0, "{n_touched} for {expected}");
            assert!((scope.moment_step_hz() - 7.8).abs() < 0.2);
        }
    }

    #[test]
    fn ranges_are_round() {
        for (x, r) in [(0.0, 0.5), (0.6, 1.0), (1.2, 2.0), (2.1, 5.0), (7.0, 10.0), (11.0, 20.0)] {
            assert!((nice_ceiling(x) - r).abs() < 1e-9);
        }
    }
}
