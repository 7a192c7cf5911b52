//! What an engine is made for.

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
    /// Acceleration at which the device is at full scale, in m/s².
    pub full_scale_mps2: f32,
    /// Share of the full scale that is never exceeded, 0..1.
    pub ceiling: f32,
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
    #[error("the full scale is {full_scale_mps2} m/s²; it must be a positive number")]
    FullScale {
        /// Full scale that was asked for, in m/s².
        full_scale_mps2: f32,
    },
    /// The ceiling is not a share.
    #[error("the limiter's ceiling is {ceiling}; it must be between 0 and 1")]
    Ceiling {
        /// Ceiling that was asked for.
        ceiling: f32,
    },
}

impl EngineConfig {
    pub(super) fn check(self) -> Result<Self, ConfigError> {
        let Self { model_rate_hz, device_rate_hz, full_scale_mps2, ceiling, .. } = self;
        if !(200.0..=4000.0).contains(&model_rate_hz) {
            return Err(ConfigError::ModelRate { model_rate_hz });
        }
        if !(device_rate_hz.is_finite() && device_rate_hz >= model_rate_hz) {
            return Err(ConfigError::DeviceRate { device_rate_hz, model_rate_hz });
        }
        if !(full_scale_mps2.is_normal() && full_scale_mps2 > 0.0 && full_scale_mps2.recip().is_normal()) {
            return Err(ConfigError::FullScale { full_scale_mps2 });
        }
        if !(0.0..=1.0).contains(&ceiling) {
            return Err(ConfigError::Ceiling { ceiling });
        }
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use super::{ChannelMask, ConfigError, EngineConfig};

    const GOOD: EngineConfig = EngineConfig {
        model_rate_hz: 1000.0,
        device_rate_hz: 48_000.0,
        seed: 0,
        full_scale_mps2: 10.0,
        ceiling: 1.0,
        channels: ChannelMask::FIRST_TWO,
    };

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
            let error = EngineConfig { full_scale_mps2: bad, ..GOOD }.check().unwrap_err();
            assert!(matches!(error, ConfigError::FullScale { .. }), "{error}");
        }
        for bad in [f32::NAN, -0.1, 1.1] {
            let error = EngineConfig { ceiling: bad, ..GOOD }.check().unwrap_err();
            assert!(matches!(error, ConfigError::Ceiling { .. }), "{error}");
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
