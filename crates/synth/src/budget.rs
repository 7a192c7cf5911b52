//! Thermal limit of a voice coil: the RMS drive that it tolerates continuously.

/// Thermal limit of a coil: the highest continuous RMS drive, averaged over the thermal time constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Highest RMS, in the unit of the samples; above zero.
    pub rms: f32,
    /// Time constant of the exponential mean, in seconds; above zero.
    pub time_secs: f32,
}

/// No gain reduction up to this fraction of the RMS limit.
const FREE_SHARE: f64 = 0.95;

/// Thermal limiter: estimates the running RMS drive of a coil and the gain that keeps it within its [`Budget`].
///
/// Let `e` be the running mean square divided by the squared RMS limit. The gain is 1 up to `e` = `FREE_SHARE`². Above,
/// the squared gain falls linearly and reaches zero at `e` = 1. The running RMS therefore exceeds the limit at most by
/// the samples that are still in the look-ahead, for any input. A drive whose RMS stays exactly at the limit is
/// attenuated by at most 0.4 dB.
#[derive(Clone, Debug)]
pub struct Heat {
    budget: Budget,
    forget: f64,
    share: f64,
    gain: f32,
}

impl Heat {
    /// A cold coil (running mean square of zero) at a sample rate in Hz.
    pub fn new(budget: Budget, rate_hz: f32) -> Self {
        let forget = 1.0 / (f64::from(budget.time_secs) * f64::from(rate_hz)).max(1.0);
        Self { budget, forget, share: 0.0, gain: 1.0 }
    }

    /// Current gain, 0..1.
    pub fn gain(&self) -> f32 {
        self.gain
    }

    /// Running RMS as a fraction of the RMS limit.
    pub fn used(&self) -> f32 {
        libm::sqrt(self.share) as f32
    }

    /// Updates the running mean square with samples that were sent to the coil. Call it with at most 100 samples at a
    /// time, because the gain changes once a call.
    pub fn note(&mut self, driven: &[f32]) {
        let budget = f64::from(self.budget.rms);
        if budget.is_nan() || budget <= 0.0 {
            (self.share, self.gain) = (1.0, 0.0);
            return;
        }
        for &sample in driven {
            let share = f64::from(sample) / budget;
            self.share += self.forget * (share * share - self.share);
        }
        let free = FREE_SHARE * FREE_SHARE;
        self.gain = libm::sqrt(((1.0 - self.share) / (1.0 - free)).clamp(0.0, 1.0)) as f32;
    }
}

#[cfg(test)]
mod tests {
    use super::{Budget, Heat};

    const BUDGET: Budget = Budget { rms: 0.5, time_secs: 2.0 };
    const RATE_HZ: f32 = 1000.0;

    /// Sends a square wave through the gain. Returns the RMS of the last second and the highest fraction of the limit.
    fn drive(heat: &mut Heat, amplitude: f32, secs: f32) -> (f64, f32) {
        let (mut square, mut highest) = (0.0, 0.0_f32);
        let n_blocks = (secs * RATE_HZ / 10.0) as usize;
        let n_last = n_blocks.min(100);
        for block_idx in 0..n_blocks {
            let y = amplitude * heat.gain();
            heat.note(&[y, -y, y, -y, y, -y, y, -y, y, -y]);
            highest = highest.max(heat.used());
            if n_blocks - block_idx <= n_last {
                square += f64::from(y * y) / n_last as f64;
            }
        }
        (libm::sqrt(square), highest)
    }

    #[test]
    fn short_bursts_pass_and_long_ones_come_down_to_the_budget() {
        let mut heat = Heat::new(BUDGET, RATE_HZ);
        // Four times the permitted power for 0.25 s, with a time constant of 2 s.
        let (rms, _) = drive(&mut heat, 1.0, 0.25);
        assert!(rms > 0.5 && heat.gain() == 1.0, "{rms} at {}", heat.gain());
        let (rms, highest) = drive(&mut heat, 1.0, 30.0);
        assert!((0.48..0.5).contains(&rms), "{rms}");
        assert!(highest <= 1.0, "{highest}");
    }

    #[test]
    fn what_is_within_the_budget_is_hardly_touched() {
        let mut heat = Heat::new(BUDGET, RATE_HZ);
        let (rms, _) = drive(&mut heat, 0.47, 60.0);
        assert_eq!(rms as f32, 0.47);
        let (rms, _) = drive(&mut heat, 0.5, 60.0);
        // 0.4 dB.
        assert!((0.477..0.5).contains(&rms), "{rms}");
    }

    #[test]
    fn no_drive_can_exceed_it_by_more_than_a_block() {
        for amplitude in [0.6, 1.0, 10.0, 100.0, 1e6] {
            let mut heat = Heat::new(BUDGET, RATE_HZ);
            let (_, highest) = drive(&mut heat, amplitude, 20.0);
            let block = (f64::from(amplitude) / 0.5).powi(2) * 10.0 / 2000.0;
            assert!(f64::from(highest).powi(2) <= 1.0 + block, "{highest} at {amplitude}");
        }
    }

    #[test]
    fn a_coil_cools_with_its_time_constant() {
        let mut heat = Heat::new(BUDGET, RATE_HZ);
        drive(&mut heat, 0.5, 60.0);
        let before = heat.used();
        heat.note(&[0.0; 2000]);
        let expected = before * libm::expf(-0.5);
        assert!((heat.used() - expected).abs() < 1e-3, "{} for {expected}", heat.used());
    }

    #[test]
    fn nonsense_settings_are_silence_not_noise() {
        let mut heat = Heat::new(Budget { rms: 0.0, time_secs: 0.0 }, RATE_HZ);
        heat.note(&[0.1; 10]);
        assert_eq!(heat.gain(), 0.0);
    }
}
