//! Gain ramps, and level meters for display.

/// A gain that changes linearly to any new value in a fixed number of frames.
#[derive(Clone, Debug)]
pub(super) struct Ramp {
    n_frames: u32,
    value: f32,
    target: f32,
    step: f32,
    n_left: u32,
}

impl Ramp {
    /// A ramp at zero.
    pub(super) fn new(n_frames: u32) -> Self {
        Self::at(0.0, n_frames)
    }

    /// A ramp at a value.
    pub(super) fn at(value: f32, n_frames: u32) -> Self {
        Self { n_frames: n_frames.max(1), value, target: value, step: 0.0, n_left: 0 }
    }

    /// Sets a value without a ramp.
    pub(super) fn jump(&mut self, value: f32) {
        *self = Self::at(value, self.n_frames);
    }

    /// Whether the ramp has reached a value.
    pub(super) fn is_at(&self, value: f32) -> bool {
        self.n_left == 0 && self.value == value
    }

    /// Starts a ramp to `target`, unless one to this target is already running.
    pub(super) fn aim(&mut self, target: f32) {
        if target != self.target {
            self.target = target;
            self.n_left = self.n_frames;
            self.step = (target - self.value) / self.n_frames as f32;
        }
    }

    /// Value at the end of the ramp.
    pub(super) fn target(&self) -> f32 {
        self.target
    }

    /// Value at the last frame.
    pub(super) fn value(&self) -> f32 {
        self.value
    }

    /// Value at the next frame.
    pub(super) fn next(&mut self) -> f32 {
        if self.n_left > 0 {
            self.n_left -= 1;
            // The last step sets the target exactly, whatever the rounding before.
            self.value = if self.n_left == 0 { self.target } else { self.value + self.step };
        }
        self.value
    }
}

/// Time constant of the level, in seconds.
const LEVEL_SECS: f32 = 0.05;
/// Highest mean square of the meter, in (m/s²)²: far above real signals, and safely below overflow.
const HIGHEST_SQUARE: f32 = 1e36;
/// Time constant of the peak's decay, in seconds.
const PEAK_SECS: f32 = 0.3;

/// Meter for the level of the signal and the peak of the output.
#[derive(Clone, Debug)]
pub(super) struct Meter {
    rate_hz: f32,
    mean_square: f32,
    peak: f32,
}

impl Meter {
    pub(super) fn new(rate_hz: f32) -> Self {
        Self { rate_hz, mean_square: 0.0, peak: 0.0 }
    }

    /// Updates the level with a segment of the signal in m/s².
    pub(super) fn note_signal(&mut self, samples: &[f32]) {
        let share = 1.0 - self.left_after(samples.len(), LEVEL_SECS);
        let mean = samples.iter().map(|x| x * x).sum::<f32>() / samples.len().max(1) as f32;
        // The square of a finite sample may overflow. The mean is therefore clamped, and the level recovers afterwards.
        self.mean_square += share * (mean.min(HIGHEST_SQUARE) - self.mean_square);
        // Smaller values cannot be felt, and subnormal numbers are slow.
        if self.mean_square < 1e-20 {
            self.mean_square = 0.0;
        }
    }

    /// Updates the peak with a segment of the drive signal.
    pub(super) fn note_output(&mut self, samples: &[f32]) {
        let highest = samples.iter().fold(0.0_f32, |highest, x| highest.max(x.abs()));
        let fallen = self.peak * self.left_after(samples.len(), PEAK_SECS);
        self.peak = if fallen < 1e-9 { highest } else { fallen.max(highest) };
    }

    /// RMS of the signal, in m/s².
    pub(super) fn level(&self) -> f32 {
        self.mean_square.sqrt()
    }

    /// Peak as a fraction of full scale.
    pub(super) fn peak(&self) -> f32 {
        self.peak
    }

    /// Clears level and peak.
    pub(super) fn reset(&mut self) {
        (self.mean_square, self.peak) = (0.0, 0.0);
    }

    fn left_after(&self, n_frames: usize, time_constant_secs: f32) -> f32 {
        (-(n_frames as f32) / (self.rate_hz * time_constant_secs)).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::{Meter, Ramp};

    #[test]
    fn a_ramp_is_straight_and_arrives() {
        let mut ramp = Ramp::new(4);
        ramp.aim(1.0);
        assert_eq!([ramp.next(), ramp.next()], [0.25, 0.5]);
        // The same target again does not restart the ramp.
        ramp.aim(1.0);
        assert_eq!([ramp.next(), ramp.next(), ramp.next()], [0.75, 1.0, 1.0]);
        ramp.aim(0.0);
        let _ = ramp.next();
        ramp.aim(0.35);
        assert_eq!(ramp.next(), 0.65);
        assert_eq!([ramp.next(), ramp.next(), ramp.next(), ramp.next()][2..], [0.35, 0.35]);
    }

    #[test]
    fn a_level_whose_square_overflows_is_high_and_comes_down_again() {
        let mut meter = Meter::new(48_000.0);
        for sample in [f32::MAX, -f32::MAX, 2e19, f32::NAN, f32::INFINITY] {
            for _ in 0..1000 {
                meter.note_signal(&[sample; 256]);
            }
            assert!((meter.level() / 1e18 - 1.0).abs() < 1e-3, "{} after {sample}", meter.level());
        }
        for _ in 0..2000 {
            meter.note_signal(&[0.0; 256]);
        }
        assert_eq!(meter.level(), 0.0);
    }

    #[test]
    fn level_and_peak_of_a_square_wave_in_any_blocks() {
        for block in [1, 7, 256] {
            let mut meter = Meter::new(48_000.0);
            let mut n = 0;
            while n < 48_000 {
                meter.note_signal(&vec![-2.0; block]);
                meter.note_output(&vec![-0.5; block]);
                n += block;
            }
            assert!((meter.level() - 2.0).abs() < 1e-4, "{}", meter.level());
            assert_eq!(meter.peak(), 0.5);
            for _ in 0..48_000 / block {
                meter.note_signal(&vec![0.0; block]);
                meter.note_output(&vec![0.0; block]);
            }
            // After one second, the level has decayed by exp(-10) and the peak by exp(-3.3).
            assert!(meter.level() < 1e-3 && (meter.peak() - 0.5 * (-1.0_f32 / 0.3).exp()).abs() < 1e-3);
        }
    }
}
