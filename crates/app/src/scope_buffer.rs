//! The last seconds of what was played, thinned out for drawing.

use std::collections::VecDeque;

use shagreen_core::spectrum::welch;
use shagreen_core::units::Hertz;

/// How much is kept, in seconds.
const KEPT_SECS: f64 = 2.0;
/// Rate that is drawn, over that of the model: the signal ends at half the model's rate.
const DRAWN_SHARE: f64 = 2.0;
/// Window of the live spectrum, in samples of the drawn rate: 3.9 Hz apart.
const WINDOW: usize = 512;
/// Share of a new spectrum in the one that is shown.
const SMOOTHING: f64 = 0.25;

/// Samples in m/s² on their way to the screen.
#[derive(Clone, Debug)]
pub struct ScopeBuffer {
    rate_hz: f64,
    every: usize,
    skipped: usize,
    samples: VecDeque<f64>,
    density: Vec<(Hertz, f64)>,
    range: f64,
}

impl ScopeBuffer {
    /// An empty buffer for a device and a model of these rates, in Hz.
    pub fn new(device_rate_hz: f64, model_rate_hz: f64) -> Self {
        // The resampler leaves nothing above half the model's rate that could fold back: samples are simply left out.
        let every = (device_rate_hz / (DRAWN_SHARE * model_rate_hz)).floor().max(1.0) as usize;
        Self {
            rate_hz: device_rate_hz / every as f64,
            every,
            skipped: 0,
            samples: VecDeque::new(),
            density: Vec::new(),
            range: 1.0,
        }
    }

    /// Takes in device samples.
    pub fn push(&mut self, samples: &[f32]) {
        for sample in samples {
            if self.skipped == 0 {
                // What is no number has silenced the output already; here it would blind the spectrum for good.
                self.samples.push_back(if sample.is_finite() { f64::from(*sample) } else { 0.0 });
            }
            self.skipped = (self.skipped + 1) % self.every;
        }
        let kept = (KEPT_SECS * self.rate_hz) as usize;
        let excess = self.samples.len().saturating_sub(kept);
        self.samples.drain(..excess);
    }

    /// Works out what is shown of the samples so far: once a frame.
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
        self.range = nice_ceiling(peak);
    }

    /// The newest `secs` seconds, oldest first, and their rate in Hz.
    pub fn newest(&self, secs: f64) -> (f64, Vec<f64>) {
        let n = ((secs * self.rate_hz) as usize).min(self.samples.len());
        (self.rate_hz, self.samples.range(self.samples.len() - n..).copied().collect())
    }

    /// The smoothed power spectral density of late, in (m/s²)²/Hz.
    pub fn density(&self) -> &[(Hertz, f64)] {
        &self.density
    }

    /// A round number that no kept sample exceeds, in m/s².
    pub fn range(&self) -> f64 {
        self.range
    }

    /// Root mean square of the newest `secs` seconds, in m/s².
    pub fn rms(&self, secs: f64) -> f64 {
        shagreen_core::spectrum::rms(&self.newest(secs).1)
    }
}

/// The next of … 0.5, 1, 2, 5, 10, … that is not below `x`, at least 0.5.
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
    use super::{ScopeBuffer, nice_ceiling};

    #[test]
    fn keeps_the_newest_and_finds_a_tone() {
        let mut scope = ScopeBuffer::new(48_000.0, 1000.0);
        let tone: Vec<f32> =
            (0..48_000 * 4).map(|i| (std::f32::consts::TAU * 100.0 * i as f32 / 48_000.0).sin()).collect();
        for block in tone.chunks(700) {
            scope.push(block);
        }
        scope.update();
        assert_eq!(scope.newest(9.0).1.len(), 4000);
        assert!((scope.rms(1.0) - 0.5_f64.sqrt()).abs() < 0.01);
        let loudest = scope.density().iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        assert!((loudest.0.0 - 100.0).abs() < 4.0);
        assert_eq!(scope.range(), 1.0);
    }

    #[test]
    fn a_sample_that_is_no_number_does_not_blind_it() {
        let mut scope = ScopeBuffer::new(48_000.0, 1000.0);
        for sample in [f32::NAN, 1.0, f32::INFINITY] {
            scope.push(&vec![sample; 48_000]);
            scope.update();
        }
        assert!(scope.density().iter().all(|(_, p)| p.is_finite()) && scope.range().is_finite());
    }

    #[test]
    fn a_model_of_a_higher_rate_is_drawn_at_a_higher_rate() {
        assert_eq!(ScopeBuffer::new(48_000.0, 4000.0).newest(1.0).0, 8000.0);
        assert_eq!(ScopeBuffer::new(44_100.0, 1000.0).newest(1.0).0, 44_100.0 / 22.0);
    }

    #[test]
    fn ranges_are_round() {
        for (x, r) in [(0.0, 0.5), (0.6, 1.0), (1.2, 2.0), (2.1, 5.0), (7.0, 10.0), (11.0, 20.0)] {
            assert!((nice_ceiling(x) - r).abs() < 1e-9);
        }
    }
}
