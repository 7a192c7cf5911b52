//! Configuration of an engine.

use shagreen_synth::budget::Budget;
use shagreen_synth::drive::{DriveConfig, Inverse, MAX_LOOK_AHEAD_SECS};
use shagreen_synth::equalizer::Resonance;

use super::friction_channel::{CARRIER_SHARE, FrictionConfig, FrictionWave, LEAST_CARRIER_HZ};

/// Set of device channels that get the signal; the others are silent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChannelMask(u64);

impl ChannelMask {
    /// The first two channels, or the only channel of a mono device.
    pub const FIRST_TWO: Self = Self(0b11);
    /// No channel.
    pub const NONE: Self = Self(0);

    /// Mask of one channel, counted from zero, below 64.
    pub fn only(channel_idx: usize) -> Self {
        Self(if channel_idx < 64 { 1 << channel_idx } else { 0 })
    }

    /// Union of this mask and `other`.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// This mask without one channel.
    #[must_use]
    pub fn without(self, channel_idx: usize) -> Self {
        Self(self.0 & !Self::only(channel_idx).0)
    }

    /// Whether a channel gets the signal.
    pub fn contains(self, channel_idx: usize) -> bool {
        channel_idx < 64 && self.0 >> channel_idx & 1 == 1
    }

    /// Channels that a device needs for the lowest channel of the mask.
    pub(crate) fn n_least(self) -> usize {
        if self.0 == 0 { 1 } else { self.0.trailing_zeros() as usize + 1 }
    }

    /// Channels that a device needs for all channels of the mask.
    pub(crate) fn n_wanted(self) -> usize {
        (64 - self.0.leading_zeros() as usize).max(1)
    }
}

/// Configuration of an engine, constant during its lifetime.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EngineConfig {
    /// Sample rate of every texture, in Hz, 200 to 4000.
    pub model_rate_hz: f32,
    /// Sample rate of the device, in Hz, at least the model's rate.
    pub device_rate_hz: f32,
    /// Seed of the noise: the same seed gives the same samples.
    pub seed: u64,
    /// Conversion of acceleration to actuator drive.
    pub drive: DriveConfig,
    /// The channels that get the signal.
    pub channels: ChannelMask,
    /// Channel that gets the friction, for a display that renders it.
    pub friction: Option<FrictionConfig>,
}

/// Reasons why a configuration is invalid.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// The model's rate is outside the renderer's range.
    #[error("the model's sample rate is {model_rate_hz} Hz; it must be 200 to 4000 Hz")]
    ModelRate {
        /// Requested rate, in Hz.
        model_rate_hz: f32,
    },
    /// The device's rate is below the model's rate.
    #[error("the device's sample rate is {device_rate_hz} Hz; it must be at least {model_rate_hz} Hz")]
    DeviceRate {
        /// Requested rate, in Hz.
        device_rate_hz: f32,
        /// The model's rate, in Hz.
        model_rate_hz: f32,
    },
    /// The full scale is not a positive number with a finite reciprocal.
    #[error("the full scale is {full_scale} {unit}; it must be a positive number")]
    FullScale {
        /// Requested full scale.
        full_scale: f32,
        /// Its unit: m/s², or V if the actuator's response is known.
        unit: &'static str,
    },
    /// The ceiling is not a fraction of full scale.
    #[error("the limiter's ceiling is {ceiling}; it must be between 0 and 1")]
    Ceiling {
        /// Requested ceiling, as a fraction of full scale.
        ceiling: f32,
    },
    /// The look-ahead is out of range.
    #[error("the limiter's look-ahead is {look_ahead_secs} s; it must be 0 to {MAX_LOOK_AHEAD_SECS} s")]
    LookAhead {
        /// Requested look-ahead, in seconds.
        look_ahead_secs: f32,
    },
    /// The coil's thermal limit is invalid.
    #[error(
        "the coil's thermal limit is {rms} of full scale (RMS) over {time_secs} s; both must be positive"
    )]
    Budget {
        /// Requested RMS, as a fraction of full scale.
        rms: f32,
        /// Thermal time constant, in seconds.
        time_secs: f32,
    },
    /// Friction shares a channel with the vibration.
    #[error("friction and vibration share channel {channel}; choose another channel for one of them")]
    FrictionChannel {
        /// Number of the channel, counted from one.
        channel: usize,
    },
    /// The device cannot play the friction carrier.
    #[error(
        "the friction carrier is {frequency_hz} Hz; at the device's sample rate of {rate_hz} Hz it must be \
         {LEAST_CARRIER_HZ} to {highest_hz} Hz"
    )]
    FrictionCarrier {
        /// Requested frequency, in Hz.
        frequency_hz: f32,
        /// Highest frequency, in Hz.
        highest_hz: f32,
        /// The device's sample rate, in Hz.
        rate_hz: f32,
    },
    /// The actuator's response cannot be inverted.
    #[error(
        "the actuator's response cannot be inverted: resonance {frequency_hz} Hz, Q {q}, gain {gain_mps2_per_volt} \
         m/s² per volt, lowest frequency {lowest_hz} Hz; all must be positive, and both frequencies below half the \
         device's {rate_hz} Hz"
    )]
    Response {
        /// Requested resonance frequency, in Hz.
        frequency_hz: f64,
        /// Requested quality factor.
        q: f64,
        /// Requested gain far above the resonance, in m/s² per volt.
        gain_mps2_per_volt: f64,
        /// Requested lowest reproduced frequency, in Hz.
        lowest_hz: f64,
        /// The device's sample rate, in Hz.
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
        if let Some(friction) = self.friction {
            check_friction(friction, self.channels, device_rate_hz)?;
        }
        Ok(self)
    }
}

fn check_friction(friction: FrictionConfig, channels: ChannelMask, rate_hz: f32) -> Result<(), ConfigError> {
    let FrictionConfig { channel_idx, wave } = friction;
    if channels.contains(channel_idx) {
        return Err(ConfigError::FrictionChannel { channel: channel_idx + 1 });
    }
    let highest_hz = CARRIER_SHARE * rate_hz;
    match wave {
        FrictionWave::Carrier { frequency_hz }
            if !(LEAST_CARRIER_HZ..=highest_hz).contains(&frequency_hz) =>
        {
            Err(ConfigError::FrictionCarrier { frequency_hz, highest_hz, rate_hz })
        }
        FrictionWave::Carrier { .. } | FrictionWave::Level => Ok(()),
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
    use super::{
        Budget, ChannelMask, ConfigError, DriveConfig, EngineConfig, FrictionConfig, FrictionWave, Inverse,
        Resonance,
    };

    const GOOD: EngineConfig = EngineConfig {
        model_rate_hz: 1000.0,
        device_rate_hz: 48_000.0,
        seed: 0,
        drive: DRIVE,
        channels: ChannelMask::FIRST_TWO,
        friction: None,
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
    fn friction_needs_a_channel_of_its_own_and_a_carrier_below_half_the_rate() {
        let check = |channel_idx, wave| {
            EngineConfig { friction: Some(FrictionConfig { channel_idx, wave }), ..GOOD }.check().map(|_| ())
        };
        let carrier = |frequency_hz| FrictionWave::Carrier { frequency_hz };
        assert_eq!(check(2, carrier(120.0)), Ok(()));
        assert_eq!(check(2, carrier(20_000.0)), Ok(()));
        assert_eq!(check(5, FrictionWave::Level), Ok(()));
        assert_eq!(check(1, carrier(120.0)), Err(ConfigError::FrictionChannel { channel: 2 }));
        for bad in [f32::NAN, 0.0, 19.0, 21_700.0, f32::INFINITY] {
            let error = check(2, carrier(bad)).unwrap_err();
            assert!(matches!(error, ConfigError::FrictionCarrier { .. }), "{error}");
        }
        let text = check(2, carrier(30_000.0)).unwrap_err().to_string();
        assert!(
            text.contains("30000 Hz") && text.contains("48000 Hz") && text.contains("20 to 21600"),
            "{text}"
        );
    }

    #[test]
    fn masks_name_channels() {
        let mask = ChannelMask::only(5).and(ChannelMask::only(2));
        assert_eq!((0..8).filter(|&c| mask.contains(c)).collect::<Vec<_>>(), [2, 5]);
        assert_eq!((mask.n_least(), mask.n_wanted()), (3, 6));
        assert!(ChannelMask::only(63).contains(63) && !ChannelMask::only(64).contains(64));
        assert_eq!(ChannelMask::FIRST_TWO.without(1), ChannelMask::only(0));
        assert_eq!(ChannelMask::only(4).without(4), ChannelMask::NONE);
        assert_eq!(ChannelMask::only(4).without(99), ChannelMask::only(4));
        assert_eq!((ChannelMask::FIRST_TWO.n_least(), ChannelMask::FIRST_TWO.n_wanted()), (1, 2));
    }
}
