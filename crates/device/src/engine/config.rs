//! What an engine is made for.

use shagreen_synth::budget::Budget;
use shagreen_synth::drive::{DriveConfig, Inverse, MAX_LOOK_AHEAD_SECS};
use shagreen_synth::equalizer::Resonance;

/// The channels of a device that get the signal; the others are silent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChannelMask(u64);

impl ChannelMask {
    /// The first two, or the only one of a device with one.
    pub const FIRST_TWO: Self = Self(0b11);

    /// One channel, counted from zero, below 64.
    pub fn only(channel_idx: usize) -> Self {
        Self(if channel_idx < 64 { 1 << channel_idx } else { 0 })
    }

    /// These channels and those of `other`.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether a channel gets the signal.
    pub fn contains(self, channel_idx: usize) -> bool {
        channel_idx < 64 && self.0 >> channel_idx & 1 == 1
    }

    /// Channels that a device must have for the lowest of these.
    pub(crate) fn n_least(self) -> usize {
        if self.0 == 0 { 1 } else { self.0.trailing_zeros() as usize + 1 }
    }

    /// Channels that a device must have for all of these.
    pub(crate) fn n_wanted(self) -> usize {
        (64 - self.0.leading_zeros() as usize).max(1)
    }
}

/// What an engine is made for: it does not change while it lives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EngineConfig {
    /// Rate of every texture, in Hz, 200 to 4000.
    pub model_rate_hz: f32,
    /// Rate of the device, in Hz, at least the model's.
    pub device_rate_hz: f32,
    /// What the noise depends on: same seed, same samples.
    pub seed: u64,
    /// How acceleration becomes the drive of the actuator.
    pub drive: DriveConfig,
    /// The channels that get the signal.
    pub channels: ChannelMask,
}

/// Why there can be no such engine.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// The renderer has no such rate.
    #[error("the model's rate is {model_rate_hz} Hz; it must be 200 to 4000 Hz")]
    ModelRate {
        /// Rate that was asked for, in Hz.
        model_rate_hz: f32,
    },
    /// The device is slower than the model.
    #[error("the device's rate is {device_rate_hz} Hz; it must be at least the model's {model_rate_hz} Hz")]
    DeviceRate {
        /// Rate that was asked for, in Hz.
        device_rate_hz: f32,
        /// The model's rate, in Hz.
        model_rate_hz: f32,
    },
    /// The full scale is not a positive number with a finite inverse.
    #[error("the full scale is {full_scale} {unit}; it must be a positive number")]
    FullScale {
        /// Full scale that was asked for.
        full_scale: f32,
        /// Its unit: that of acceleration, or of voltage where the actuator's response is known.
        unit: &'static str,
    },
    /// The ceiling is not a share.
    #[error("the limiter's ceiling is {ceiling}; it must be between 0 and 1")]
    Ceiling {
        /// Ceiling that was asked for.
        ceiling: f32,
    },
    /// The limiter cannot see so far.
    #[error("the limiter's look-ahead is {look_ahead_secs} s; it must be 0 to {MAX_LOOK_AHEAD_SECS} s")]
    LookAhead {
        /// Look-ahead that was asked for, in seconds.
        look_ahead_secs: f32,
    },
    /// The budget of the coil's heat has no meaning.
    #[error(
        "the coil stands a share of {rms} of the full scale over {time_secs} s; both must be positive numbers"
    )]
    Budget {
        /// Root mean square that was asked for, as a share of the full scale.
        rms: f32,
        /// Its time constant, in seconds.
        time_secs: f32,
    },
    /// The actuator's response cannot be undone.
    #[error(
        "the actuator's response cannot be undone: resonance {frequency_hz} Hz, Q {q}, gain {gain_mps2_per_volt} m/s² for \
         a volt, from {lowest_hz} Hz on; all must be positive, and the frequencies below half the device's {rate_hz} Hz"
    )]
    Response {
        /// Resonance that was asked for, in Hz.
        frequency_hz: f64,
        /// Its quality.
        q: f64,
        /// Gain far above it, in m/s² for a volt.
        gain_mps2_per_volt: f64,
        /// Lowest frequency to be reproduced, in Hz.
        lowest_hz: f64,
        /// The device's rate, in Hz.
        rate_hz: f32,
    },
}

impl EngineConfig {
    pub(super) fn check(self) -> Result<Self, ConfigError> {
        let Self { model_rate_hz, device_rate_hz, .. } = self;
        if !(200.0..=4000.0).contains(&model_rate_hz) {
            return Err(ConfigError::ModelRate { model_rate_hz });
        }
        if !(device_rate_hz.is_finite() && device_rate_hz >= model_rate_hz) {
            return Err(ConfigError::DeviceRate { device_rate_hz, model_rate_hz });
        }
        check_drive(self.drive, device_rate_hz)?;
        Ok(self)
    }
}

fn check_drive(drive: DriveConfig, rate_hz: f32) -> Result<(), ConfigError> {
    let DriveConfig { inverse, full_scale, ceiling, look_ahead_secs, budget } = drive;
    if !(full_scale.is_normal() && full_scale > 0.0 && full_scale.recip().is_normal()) {
        let unit = if inverse.is_some() { "V" } else { "m/s²" };
        return Err(ConfigError::FullScale { full_scale, unit });
    }
    if !(0.0..=1.0).contains(&ceiling) {
        return Err(ConfigError::Ceiling { ceiling });
    }
    if !(0.0..=MAX_LOOK_AHEAD_SECS).contains(&look_ahead_secs) {
        return Err(ConfigError::LookAhead { look_ahead_secs });
    }
    if let Some(Budget { rms, time_secs }) = budget
        && ![rms, time_secs].iter().all(|x| x.is_normal() && *x > 0.0)
    {
        return Err(ConfigError::Budget { rms, time_secs });
    }
    if let Some(Inverse { resonance: Resonance { frequency_hz, q, gain_mps2_per_volt }, lowest_hz }) = inverse
    {
        let are_numbers =
            [frequency_hz, q, gain_mps2_per_volt, lowest_hz].iter().all(|x| x.is_normal() && *x > 0.0);
        if !(are_numbers && 2.0 * frequency_hz.max(lowest_hz) < f64::from(rate_hz)) {
            return Err(ConfigError::Response { frequency_hz, q, gain_mps2_per_volt, lowest_hz, rate_hz });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{Budget, ChannelMask, ConfigError, DriveConfig, EngineConfig, Inverse, Resonance};

    const GOOD: EngineConfig = EngineConfig {
        model_rate_hz: 1000.0,
        device_rate_hz: 48_000.0,
        seed: 0,
        drive: DRIVE,
        channels: ChannelMask::FIRST_TWO,
    };
    const RESONANCE: Resonance = Resonance { frequency_hz: 65.0, q: 4.0, gain_mps2_per_volt: 2.0 };
    const DRIVE: DriveConfig = DriveConfig {
        inverse: Some(Inverse { resonance: RESONANCE, lowest_hz: 20.0 }),
        full_scale: 5.0,
        ceiling: 1.0,
        look_ahead_secs: 0.002,
        budget: Some(Budget { rms: 0.3, time_secs: 10.0 }),
    };

    fn refusal(drive: DriveConfig) -> ConfigError {
        EngineConfig { drive, ..GOOD }.check().unwrap_err()
    }

    #[test]
    fn contradictions_are_named() {
        assert_eq!(GOOD.check(), Ok(GOOD));
        for bad in [f32::NAN, 100.0, 8000.0] {
            let error = EngineConfig { model_rate_hz: bad, ..GOOD }.check().unwrap_err();
            assert!(matches!(error, ConfigError::ModelRate { .. }), "{error}");
        }
        for bad in [f32::NAN, f32::INFINITY, 999.0] {
            let error = EngineConfig { device_rate_hz: bad, ..GOOD }.check().unwrap_err();
            assert!(matches!(error, ConfigError::DeviceRate { .. }), "{error}");
        }
        for bad in [f32::NAN, f32::INFINITY, 0.0, -1.0, f32::from_bits(1), f32::MAX] {
            let error = refusal(DriveConfig { full_scale: bad, ..DRIVE });
            assert!(matches!(error, ConfigError::FullScale { unit: "V", .. }), "{error}");
            let error = refusal(DriveConfig::proportional(bad, 0.9));
            assert!(matches!(error, ConfigError::FullScale { unit: "m/s²", .. }), "{error}");
        }
        for bad in [f32::NAN, -0.1, 1.1] {
            let error = refusal(DriveConfig { ceiling: bad, ..DRIVE });
            assert!(matches!(error, ConfigError::Ceiling { .. }), "{error}");
        }
        for bad in [f32::NAN, -0.001, 0.0021] {
            let error = refusal(DriveConfig { look_ahead_secs: bad, ..DRIVE });
            assert!(matches!(error, ConfigError::LookAhead { .. }), "{error}");
        }
        for bad in [f32::NAN, f32::INFINITY, 0.0, -1.0] {
            for budget in [Budget { rms: bad, time_secs: 1.0 }, Budget { rms: 1.0, time_secs: bad }] {
                let error = refusal(DriveConfig { budget: Some(budget), ..DRIVE });
                assert!(matches!(error, ConfigError::Budget { .. }), "{error}");
            }
        }
        for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0, 24_000.0] {
            let of = |resonance, lowest_hz| Some(Inverse { resonance, lowest_hz });
            for inverse in [
                of(Resonance { frequency_hz: bad, ..RESONANCE }, 20.0),
                of(Resonance { q: if bad > 1.0 { f64::NAN } else { bad }, ..RESONANCE }, 20.0),
                of(RESONANCE, bad),
            ] {
                let error = refusal(DriveConfig { inverse, ..DRIVE });
                assert!(matches!(error, ConfigError::Response { .. }), "{error}");
            }
        }
    }

    #[test]
    fn masks_name_channels() {
        let mask = ChannelMask::only(5).and(ChannelMask::only(2));
        assert_eq!((0..8).filter(|&c| mask.contains(c)).collect::<Vec<_>>(), [2, 5]);
        assert_eq!((mask.n_least(), mask.n_wanted()), (3, 6));
        assert!(ChannelMask::only(63).contains(63) && !ChannelMask::only(64).contains(64));
        assert_eq!((ChannelMask::FIRST_TWO.n_least(), ChannelMask::FIRST_TWO.n_wanted()), (1, 2));
    }
}
