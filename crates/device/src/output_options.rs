//! Options and types of outputs, and construction of an output's engine.

use std::ops::RangeInclusive;

use shagreen_synth::drive::DriveConfig;

use crate::engine::{
    self, CARRIER_SHARE, ChannelMask, ConfigError, Engine, EngineConfig, FrictionConfig, FrictionWave, Handle,
};
use crate::error::{DeviceError, DeviceErrorKind};
use crate::link::{Reporter, link};

/// Default sample rate of audio interfaces and of the silent output, in Hz.
pub const USUAL_RATE_HZ: u32 = 48_000;

/// Acceleration at full scale without a calibrated actuator, in m/s²; the roughest real surfaces just reach it.
pub const UNCALIBRATED_FULL_SCALE_MPS2: f32 = 20.0;

/// Default ceiling of the limiter, as a fraction of full scale.
pub const USUAL_CEILING: f32 = 0.9;

/// Permitted buffer sizes in frames: systems cannot keep up with smaller ones, and larger ones delay by over a second.
pub const BUFFER_FRAMES: RangeInclusive<u32> = 16..=65_536;

/// Default buffer size in frames: 5 ms at 48 kHz.
pub const USUAL_BUFFER_FRAMES: u32 = 256;

/// Type of an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OutputKind {
    /// Silent output that runs on a real clock.
    Null,
    /// Audio output of the system.
    Audio,
    /// Microcontroller on a serial port.
    Serial,
    /// Pen that plays waveforms of its own, which approximate the signal: see [`crate::haptic_pen`].
    HapticPen,
}

/// One output of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputInfo {
    /// Stable id; opens the output.
    pub id: String,
    /// Display name.
    pub name: String,
    /// Type of the output.
    pub kind: OutputKind,
    /// Whether it is the system's default output.
    pub is_default: bool,
}

/// Options for opening an output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenOptions {
    /// Sample rate of the textures, in Hz.
    pub model_rate_hz: f32,
    /// Preferred sample rate of the device, in Hz. Audio interfaces use the closest supported rate; a serial receiver
    /// rejects a rate that it does not support. With `None`, the output chooses: usually [`USUAL_RATE_HZ`], a
    /// PulseAudio sink's own rate, or [`crate::serial::USUAL_SERIAL_RATE_HZ`].
    pub preferred_rate_hz: Option<u32>,
    /// Requested buffer size in frames, within [`BUFFER_FRAMES`]. The device may use another size, or change it between
    /// blocks.
    pub buffer_frames: Option<u32>,
    /// Seed of the noise: the same seed gives the same samples.
    pub seed: u64,
    /// Conversion of acceleration to actuator drive.
    pub drive: DriveConfig,
    /// The channels that get the signal; the others are silent.
    pub channels: ChannelMask,
    /// Channel that gets the friction, for a display that renders it. An audio output without this channel plays the
    /// vibration alone. A serial receiver has one channel: see [`crate::serial::message::Mode::Friction`].
    pub friction: Option<FrictionConfig>,
    /// Whether to take the output over from another Shagreen that plays on it.
    pub take_over: bool,
}

impl OpenOptions {
    /// Channels of vibration and friction.
    pub(crate) fn all_channels(&self) -> ChannelMask {
        let friction = self.friction.map(|friction| ChannelMask::only(friction.channel_idx));
        friction.map_or(self.channels, |friction| self.channels.and(friction))
    }

    /// Sample rate of an audio interface without a preferred one, in Hz: [`USUAL_RATE_HZ`], doubled until it carries the
    /// friction.
    pub(crate) fn usual_audio_rate_hz(&self) -> u32 {
        let carrier_hz = match self.friction {
            Some(FrictionConfig { wave: FrictionWave::Carrier { frequency_hz }, .. }) => frequency_hz,
            _ => 0.0,
        };
        let is_enough = |rate_hz: &u32| CARRIER_SHARE * *rate_hz as f32 >= carrier_hz;
        let rates_hz = [USUAL_RATE_HZ, 2 * USUAL_RATE_HZ, 4 * USUAL_RATE_HZ];
        rates_hz.into_iter().find(is_enough).unwrap_or(USUAL_RATE_HZ)
    }
}

/// An engine at the device's actual rate, with its handle and the device's side of the status link.
pub(crate) struct Made {
    pub(crate) handle: Handle,
    pub(crate) engine: Engine,
    pub(crate) reporter: Reporter,
}

pub(crate) fn make_engine(options: OpenOptions, rate_hz: u32) -> Result<Made, DeviceError> {
    let config = EngineConfig {
        model_rate_hz: options.model_rate_hz,
        device_rate_hz: rate_hz as f32,
        seed: options.seed,
        drive: options.drive,
        channels: options.channels,
        friction: options.friction,
    };
    let refuse = |error: ConfigError| {
        DeviceError::new(
            DeviceErrorKind::Config,
            format!("the output cannot be opened with these settings: {error}"),
        )
    };
    let (mut handle, engine) = engine::new(config).map_err(refuse)?;
    let (reporter, monitor) = link();
    handle.watch(monitor);
    Ok(Made { handle, engine, reporter })
}
