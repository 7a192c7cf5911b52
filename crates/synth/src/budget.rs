//! How much a coil may be driven before it gets too warm.

/// What a coil stands for long: the root mean square of its drive, taken over its thermal time constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Highest root mean square, in the unit of the samples; above zero.
    pub rms: f32,
    /// Time constant of the mean, in seconds; above zero.
    pub time_secs: f32,
}

/// Up to this share of the budget nothing is turned down.
const FREE_SHARE: f64 = 0.95;

/// The heat of a coil and the gain that keeps it within its [`Budget`].
///
/// With `e` the mean square over that of the budget, the gain is 1 up to `FREE_SHARE`² and falls so that its square
/// is zero at 1: the budget is never exceeded by more than what is on its way through the look-ahead, whatever the
/// input, and turned down by 0.4 dB at most while the drive stays at the budget itself.
#[derive(Clone, Debug)]
pub struct Heat {
    budget: Budget,
    forget: f64,
    share: f64,
    gain: f32,
}

impl Heat {
    /// A cold coil whose drive has so many samples a second.
    pub fn new(budget: Budget, rate_hz: f32) -> Self {
        let forget = 1.0 / (f64::from(budget.time_secs) * f64::from(rate_hz)).max(1.0);
        Self { budget, forget, share: 0.0, gain: 1.0 }
    }

    /// Gain at the moment, 0..1.
    pub fn gain(&self) -> f32 {
        self.gain
    }

    /// Share of the budget that is used: root mean square over that of the budget.
    pub fn used(&self) -> f32 {
        libm::sqrt(self.share) as f32
    }

    /// Takes the samples that the coil got. Call it for a hundred samples or fewer at a time.
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

    /// Drives with a square wave through the gain, and says the root mean square of the last second and the highest share.
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
        // Four times the power for a quarter of a second, of two.
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
