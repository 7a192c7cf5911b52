//! Outputs to an actuator: which there are, and how to open one.
//!
//! An output is opened by its id and stays that one. If it goes, there is silence and [`Handle::loss`] says why; no
//! other ever takes its place, since actuator drive does not belong in someone's headphones.

use std::ops::RangeInclusive;
use std::sync::Arc;
use std::time::{Duration, Instant};

use shagreen_synth::drive::DriveConfig;

use crate::audio::AudioOutput;
use crate::engine::{self, ChannelMask, ConfigError, Engine, EngineConfig, Handle};
use crate::error::{DeviceError, DeviceErrorKind};
use crate::link::{Reporter, Shared, link};
use crate::null_output::NullOutput;
use crate::serial::{SerialOptions, SerialOutput};
use crate::status::Status;

/// The id of the output that plays to nobody.
pub const NULL_ID: &str = "null";
/// Rate of an output whose rate nobody prefers, in Hz.
pub const USUAL_RATE_HZ: u32 = 48_000;

/// Acceleration at full scale while no actuator has been calibrated, in m/s²: the roughest real surfaces just reach it.
pub const UNCALIBRATED_FULL_SCALE_MPS2: f32 = 20.0;
/// Share of the full scale that the limiter never exceeds, where nothing else is asked for.
pub const USUAL_CEILING: f32 = 0.9;

/// Frames a block that can be asked for: fewer no system keeps up with, more are over a second late.
pub const BUFFER_FRAMES: RangeInclusive<u32> = 16..=65_536;

/// Frames in a block where nobody asks for another number: 5 ms at 48 kHz.
pub const USUAL_BUFFER_FRAMES: u32 = 256;

/// How often a drain looks whether the device is still there.
const DRAIN_POLL: Duration = Duration::from_millis(20);

/// What sort of output it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OutputKind {
    /// Silent, by a real clock.
    Null,
    /// A device of the system's sound.
    Audio,
    /// A microcontroller on a serial port.
    Serial,
}

/// One output of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputInfo {
    /// Name by which it is opened, the same every time.
    pub id: String,
    /// Name to show.
    pub name: String,
    /// What sort it is.
    pub kind: OutputKind,
    /// Whether the system names it as the default.
    pub is_default: bool,
}

/// How to open an output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenOptions {
    /// Rate of the textures that will be played, in Hz.
    pub model_rate_hz: f32,
    /// Rate to ask the device for, in Hz; without it [`USUAL_RATE_HZ`]. The nearest that it has is taken.
    pub preferred_rate_hz: Option<u32>,
    /// Frames a block to ask the device for, one of [`BUFFER_FRAMES`]; it may take another number, or change it from block
    /// to block.
    pub buffer_frames: Option<u32>,
    /// What the noise depends on: same seed, same samples.
    pub seed: u64,
    /// How acceleration becomes the drive of the actuator.
    pub drive: DriveConfig,
    /// The channels that get the signal; the others are silent.
    pub channels: ChannelMask,
}

/// An open output: it plays until it is dropped.
#[derive(Debug)]
pub struct Running {
    id: String,
    rate_hz: u32,
    channels: u16,
    buffer_frames: Option<u32>,
    engine_latency_secs: f64,
    device_latency_secs: f64,
    shared: Arc<Shared>,
    #[expect(dead_code, reason = "held to be dropped")]
    device: Device,
}

#[derive(Debug)]
#[expect(dead_code, reason = "held to be dropped")]
enum Device {
    Audio(AudioOutput),
    #[cfg(target_os = "linux")]
    Pulse(crate::pulse::PulseOutput),
    Null(NullOutput),
    Serial(SerialOutput),
}

impl Running {
    /// An open serial output.
    pub(crate) fn of_serial(
        id: String,
        rate_hz: u32,
        window: u16,
        (engine_latency_secs, device_latency_secs): (f64, f64),
        shared: Arc<Shared>,
        output: SerialOutput,
    ) -> Self {
        let buffer_frames = Some(u32::from(window));
        let device = Device::Serial(output);
        Self {
            id,
            rate_hz,
            channels: 1,
            buffer_frames,
            engine_latency_secs,
            device_latency_secs,
            shared,
            device,
        }
    }

    /// Waits until what the engine has rendered by now has been heard, so that closing the output cuts nothing off, or for
    /// `patience`; says whether it has. A device that does not say how late it is is taken to be two blocks late.
    ///
    /// Wait first until [`Handle::status`] says that what is to be heard has been rendered.
    pub fn drain(&self, patience: Duration) -> bool {
        let begun = Instant::now();
        let least = Duration::from_secs_f64(self.device_latency_secs);
        let heard_by = self.shared.heard_by().max(begun + least);
        loop {
            let now = Instant::now();
            if self.shared.is_lost() {
                return false;
            }
            let left = heard_by.saturating_duration_since(now);
            let left_of_patience = patience.saturating_sub(now.saturating_duration_since(begun));
            if left.is_zero() || left_of_patience.is_zero() {
                return left.is_zero();
            }
            std::thread::sleep(left.min(left_of_patience).min(DRAIN_POLL));
        }
    }

    /// Id of the output.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Rate of the device, in Hz.
    pub fn rate_hz(&self) -> u32 {
        self.rate_hz
    }

    /// Channels of the device.
    pub fn channels(&self) -> u16 {
        self.channels
    }

    /// Frames in a block, as far as the device says.
    pub fn buffer_frames(&self) -> Option<u32> {
        self.buffer_frames
    }

    /// From a change of the contact to the actuator's terminals, in seconds: the renderer's own delay, and that of the
    /// device as far as it says, or else two of its blocks.
    pub fn latency_secs(&self, status: &Status) -> f64 {
        let told_secs = f64::from(status.device_latency_secs);
        self.engine_latency_secs + if told_secs > 0.0 { told_secs } else { self.device_latency_secs }
    }
}

/// The outputs of this machine: the silent one first. Nothing is opened to find them.
pub fn list_outputs() -> Vec<OutputInfo> {
    let null = OutputInfo {
        id: NULL_ID.into(),
        name: "No output (silent, real clock)".into(),
        kind: OutputKind::Null,
        is_default: false,
    };
    let mut outputs = vec![null];
    #[cfg(target_os = "linux")]
    outputs.extend(crate::pulse::list());
    // Where a server names its default itself, a route to it is none of ours to prefer.
    let has_default = outputs.iter().any(|output| output.is_default);
    let audio = crate::audio::list().into_iter();
    outputs.extend(audio.map(|o| OutputInfo { is_default: o.is_default && !has_default, ..o }));
    outputs
}

/// Opens output `id`, silent until its handle is told otherwise. `serial:` and a port's name opens the receiver on that
/// port by [`SerialOptions::default`].
///
/// # Errors
/// - [`DeviceErrorKind::NotFound`] where there is no such output.
/// - [`DeviceErrorKind::Busy`] where another program holds it.
/// - [`DeviceErrorKind::Denied`] where the system refuses it.
/// - [`DeviceErrorKind::Unsupported`] where it has no rate, format or channel that would do.
/// - [`DeviceErrorKind::Config`] where the options contradict themselves.
/// - [`DeviceErrorKind::Unavailable`], also where nothing answers on a serial port, or [`DeviceErrorKind::Backend`] where the system fails.
pub fn open(id: &str, options: OpenOptions) -> Result<(Handle, Running), DeviceError> {
    if id == NULL_ID {
        return open_null_with_tap(options, |_| {});
    }
    check_buffer(options)?;
    #[cfg(target_os = "linux")]
    if id.starts_with(crate::pulse::PREFIX) {
        return open_pulse(id, options);
    }
    if id.starts_with(crate::serial::ID_PREFIX) {
        let connection = crate::serial::open(id, options, SerialOptions::default())?;
        return Ok((connection.handle, connection.running));
    }
    let (handle, opened) = crate::audio::open(id, options)?;
    let buffer_frames = opened.buffer_frames;
    let running = Running {
        id: id.into(),
        rate_hz: opened.rate_hz,
        channels: opened.channels,
        buffer_frames,
        engine_latency_secs: opened.engine_latency_secs,
        device_latency_secs: 2.0 * f64::from(buffer_frames.unwrap_or(0)) / f64::from(opened.rate_hz),
        shared: opened.shared,
        device: Device::Audio(opened.output),
    };
    Ok((handle, running))
}

#[cfg(target_os = "linux")]
fn open_pulse(id: &str, options: OpenOptions) -> Result<(Handle, Running), DeviceError> {
    let (handle, opened) = crate::pulse::open(id, options)?;
    let running = Running {
        id: id.into(),
        rate_hz: opened.rate_hz,
        channels: opened.channels,
        buffer_frames: Some(opened.buffer_frames),
        engine_latency_secs: opened.engine_latency_secs,
        device_latency_secs: 2.0 * f64::from(opened.buffer_frames) / f64::from(opened.rate_hz),
        shared: opened.shared,
        device: Device::Pulse(opened.output),
    };
    Ok((handle, running))
}

/// Opens the silent output; `tap` gets every block that it plays, two channels interleaved, on the output's thread.
///
/// # Errors
/// - [`DeviceErrorKind::Config`] where the options contradict themselves.
/// - [`DeviceErrorKind::Backend`] where the system gives no thread.
pub fn open_null_with_tap(
    options: OpenOptions,
    tap: impl FnMut(&[f32]) + Send + 'static,
) -> Result<(Handle, Running), DeviceError> {
    check_buffer(options)?;
    let rate_hz = options.preferred_rate_hz.unwrap_or(USUAL_RATE_HZ);
    let frames = options.buffer_frames.unwrap_or(USUAL_BUFFER_FRAMES);
    let made = make_engine(options, rate_hz)?;
    let engine_latency_secs = f64::from(made.engine.latency_secs());
    let output = NullOutput::start(made.engine, &made.reporter, rate_hz, frames, tap)?;
    let running = Running {
        id: NULL_ID.into(),
        rate_hz,
        channels: crate::null_output::CHANNELS,
        buffer_frames: Some(frames),
        engine_latency_secs,
        device_latency_secs: f64::from(frames) / f64::from(rate_hz),
        shared: made.reporter.shared,
        device: Device::Null(output),
    };
    Ok((made.handle, running))
}

fn check_buffer(options: OpenOptions) -> Result<(), DeviceError> {
    let Some(frames) = options.buffer_frames.filter(|frames| !BUFFER_FRAMES.contains(frames)) else {
        return Ok(());
    };
    let (least, most) = (BUFFER_FRAMES.start(), BUFFER_FRAMES.end());
    let message = format!("a block may have {least} to {most} frames, not {frames}; ask for another number");
    Err(DeviceError::new(DeviceErrorKind::Config, message))
}

/// An engine at the rate that the device turned out to have, and the line between the two.
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
    };
    let refuse = |error: ConfigError| {
        DeviceError::new(DeviceErrorKind::Config, format!("the output cannot be opened like that: {error}"))
    };
    let (mut handle, engine) = engine::new(config).map_err(refuse)?;
    let (reporter, monitor) = link();
    handle.watch(monitor);
    Ok(Made { handle, engine, reporter })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::{
        BUFFER_FRAMES, ChannelMask, DeviceErrorKind, DriveConfig, Duration, Instant, NULL_ID, OpenOptions,
        list_outputs, open,
    };

    /// What nothing in a test depends on.
    pub(crate) const OPTIONS: OpenOptions = OpenOptions {
        model_rate_hz: 1000.0,
        preferred_rate_hz: None,
        buffer_frames: None,
        seed: 0,
        drive: DriveConfig::proportional(10.0, 0.9),
        channels: ChannelMask::FIRST_TWO,
    };

    #[test]
    fn the_null_output_is_always_there_and_ids_are_unique() {
        let outputs = list_outputs();
        assert_eq!((outputs[0].id.as_str(), outputs[0].is_default), (NULL_ID, false));
        let mut ids: Vec<_> = outputs.iter().map(|output| &output.id).collect();
        ids.sort();
        assert!(ids.windows(2).all(|w| w[0] != w[1]), "{ids:?}");
    }

    #[test]
    fn outputs_that_do_not_exist_are_named_with_what_to_do() {
        for id in ["", "nonsense", "alsa:no_such_pcm", "nohost:default"] {
            let error = open(id, OPTIONS).unwrap_err();
            assert_eq!(error.kind(), DeviceErrorKind::NotFound, "{error}");
            let text = error.to_string();
            assert!(text.contains(&format!("`{id}`")) && text.contains("shagreen devices"), "{text}");
        }
    }

    #[test]
    fn blocks_that_no_output_could_play_are_refused_by_every_output() {
        for frames in [0, 15, 65_537, u32::MAX] {
            for id in [NULL_ID, "alsa:no_such_pcm"] {
                let error = open(id, OpenOptions { buffer_frames: Some(frames), ..OPTIONS }).unwrap_err();
                assert_eq!(error.kind(), DeviceErrorKind::Config);
                assert!(error.message().contains("16 to 65536 frames"), "{error}");
            }
        }
        for frames in [*BUFFER_FRAMES.start(), *BUFFER_FRAMES.end()] {
            let (_handle, running) =
                open(NULL_ID, OpenOptions { buffer_frames: Some(frames), ..OPTIONS }).unwrap();
            assert_eq!(running.buffer_frames(), Some(frames));
        }
    }

    #[test]
    fn what_was_rendered_has_been_heard_after_a_drain() {
        let slow = OpenOptions { buffer_frames: Some(24_000), ..OPTIONS };
        let (mut handle, running) = open(NULL_ID, slow).unwrap();
        while handle.status().frames_played == 0 {
            std::thread::yield_now();
        }
        // Half a second is on its way; the thread may have begun a moment ago.
        let begun = Instant::now();
        assert!(!running.drain(Duration::from_millis(100)));
        assert!(begun.elapsed() >= Duration::from_millis(100));
        let heard_by = running.shared.heard_by();
        assert!(heard_by > begun, "what was handed over is on its way");
        assert!(running.drain(Duration::from_secs(10)));
        assert!(Instant::now() >= heard_by);
        assert!(begun.elapsed() < Duration::from_secs(5), "not until everything ends");
    }

    #[test]
    fn contradicting_options_are_refused() {
        let error =
            open(NULL_ID, OpenOptions { drive: DriveConfig { full_scale: 0.0, ..OPTIONS.drive }, ..OPTIONS })
                .unwrap_err();
        assert_eq!(error.kind(), DeviceErrorKind::Config);
        assert!(error.message().contains("0 m/s²"), "{error}");
        let error = open(NULL_ID, OpenOptions { preferred_rate_hz: Some(0), ..OPTIONS }).unwrap_err();
        assert_eq!(error.kind(), DeviceErrorKind::Config);
    }
}
