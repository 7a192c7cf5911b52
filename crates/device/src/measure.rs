//! Measurement of an actuator: plays a signal on an output and records a sensor at the same time.

use std::fmt::Display;
use std::time::{Duration, Instant};

use shagreen_synth::drive::{DriveConfig, Driven};

use crate::audio_input::Recorder;
use crate::engine::{ChannelMask, FADE_SECS, Handle};
use crate::error::{DeviceError, DeviceErrorKind};
use crate::output::{self, OpenOptions, Running};
use crate::sensor::Sensor;
use crate::serial::{self, ReceiverInfo, SerialOptions, SerialSensor};
use crate::signal::Signal;
use crate::status::{LinkState, Status};

impl Sensor for Recorder {
    fn rate_hz(&self) -> f64 {
        f64::from(Self::rate_hz(self))
    }

    fn read(&mut self, out: &mut Vec<f32>) {
        Self::read(self, out);
    }

    fn check(&self) -> Result<(), DeviceError> {
        Self::check(self)
    }
}

/// Sensor of a measurement.
#[derive(Clone, Debug, PartialEq)]
pub enum Listener {
    /// An audio input of the system.
    Input {
        /// Id of the input.
        id: String,
        /// Channel, counted from zero.
        channel_idx: usize,
        /// Acceleration that gives a sample value of 1.0, in m/s².
        sensitivity_mps2: f64,
    },
    /// The accelerometer of a receiver on a serial port.
    Serial {
        /// Name of the port.
        port: String,
        /// Baud rate.
        baud: u32,
    },
}

/// Result of a measurement.
#[derive(Clone, Debug)]
pub struct Heard {
    /// Recorded acceleration in m/s².
    pub mps2: Vec<f64>,
    /// Sample rate, in Hz.
    pub rate_hz: f64,
    /// Status of the output at the end. Underruns, errors and limited samples count from the start of the measurement;
    /// `heat_gain` is the lowest gain of the thermal limiter during the measurement.
    pub status: Status,
}

impl Heard {
    /// Whether the actuator's limits attenuated the signal.
    pub fn was_limited(&self) -> bool {
        self.status.limited_samples > 0 || self.status.heat_gain < 0.99
    }
}

/// Plays a drive signal on output `id`, with these limits and channels, and returns the recorded acceleration.
/// `drive_at` returns the samples of the drive signal for the output's sample rate in Hz.
///
/// `go_on` gets the completed fraction, 0..1, and returns whether to continue. If it returns false, and after every
/// error, the signal fades out before the output is closed.
///
/// # Errors
/// Those of [`crate::output::open`] and of the sensor, and:
/// - [`DeviceErrorKind::Config`] if `drive_at` fails; the message is its error.
/// - [`DeviceErrorKind::Unsupported`], before playback, if the receiver of the measurement has no sensor.
/// - [`DeviceErrorKind::Lost`] if the output or the sensor is disconnected.
/// - [`DeviceErrorKind::Canceled`] if `go_on` returns false.
/// - [`DeviceErrorKind::Unavailable`] if the output requests no samples, or the sensor sends none.
pub fn measure<E: Display>(
    id: &str,
    (drive, channels): (DriveConfig, ChannelMask),
    listener: &Listener,
    drive_at: &dyn Fn(f64) -> Result<Vec<f32>, E>,
    go_on: &mut dyn FnMut(f64) -> bool,
) -> Result<Heard, DeviceError> {
    // No texture is rendered, so the model rate and the seed have no effect.
    let options = OpenOptions {
        model_rate_hz: 1000.0,
        preferred_rate_hz: None,
        buffer_frames: None,
        seed: 1,
        drive,
        channels,
        friction: None,
        take_over: false,
    };
    let mut through = |handle: &mut Handle, running: &Running, sensor: &mut dyn Sensor| {
        let refuse = |message: String| DeviceError::new(DeviceErrorKind::Config, message);
        let rate_hz = f64::from(running.rate_hz());
        let samples = drive_at(rate_hz).map_err(|error| refuse(error.to_string()))?;
        let signal =
            Signal::new(samples, rate_hz, Driven::Drive).map_err(|error| refuse(error.to_string()))?;
        let listened = play_and_listen(handle, signal, sensor, go_on)?;
        Ok((listened, sensor.rate_hz()))
    };
    let ((Listened { samples, status }, rate_hz), scale) = match listener {
        Listener::Input { id: input, channel_idx, sensitivity_mps2 } => {
            let (mut handle, running) = output::open(id, options)?;
            let mut recorder = Recorder::open(input, *channel_idx, running.rate_hz())?;
            (through(&mut handle, &running, &mut recorder)?, *sensitivity_mps2)
        }
        Listener::Serial { port, baud } => {
            let serial = SerialOptions { baud: *baud, ..SerialOptions::default() };
            // `channels` applies to the output; a receiver that serves only as the sensor gets the default channels.
            let is_output = serial_id(id) == serial_id(port);
            let listening = OpenOptions { channels: ChannelMask::FIRST_TWO, ..options };
            let mut connection = serial::open(port, if is_output { options } else { listening }, serial)?;
            check_sensor(port, &connection.receiver)?;
            let mut sensor = SerialSensor::new(connection.heard);
            let listened = if is_output {
                through(&mut connection.handle, &connection.running, &mut sensor)?
            } else {
                let (mut handle, running) = output::open(id, options)?;
                through(&mut handle, &running, &mut sensor)?
            };
            (listened, 1.0)
        }
    };
    Ok(Heard { mps2: samples.iter().map(|x| scale * f64::from(*x)).collect(), rate_hz, status })
}

/// Name of a port without the id prefix.
fn serial_id(id: &str) -> &str {
    id.strip_prefix(serial::ID_PREFIX).unwrap_or(id)
}

/// Checks that a receiver has a sensor.
fn check_sensor(port: &str, receiver: &ReceiverInfo) -> Result<(), DeviceError> {
    if receiver.has_sensor {
        return Ok(());
    }
    let message = format!(
        "the receiver `{}` on `{port}` has no sensor; connect an accelerometer that its firmware supports, or use an \
         audio input that `shagreen devices` lists",
        receiver.name
    );
    Err(DeviceError::new(DeviceErrorKind::Unsupported, message))
}

/// Recording of a sensor during a signal.
#[derive(Clone, Debug)]
struct Listened {
    /// Samples, including the silence before and after the signal.
    samples: Vec<f32>,
    /// As [`Heard::status`].
    status: Status,
}

/// Duration of the recorded silence before and after the signal, in seconds, for background noise and decay.
pub const SILENCE_SECS: f64 = 1.0;
/// Interval between two reads of sensor and output.
const POLL: Duration = Duration::from_millis(10);
/// Time that playback may take beyond the signal's length.
const PATIENCE: Duration = Duration::from_secs(10);
/// Time that a signal may take beyond its fade to end after an aborted measurement.
const FADE_PATIENCE: Duration = Duration::from_millis(500);

/// Plays a signal through an engine and returns the sensor's recording, including silence before and after. The signal
/// has faded out when this returns, also after an error.
fn play_and_listen(
    handle: &mut Handle,
    signal: Signal,
    sensor: &mut dyn Sensor,
    go_on: &mut dyn FnMut(f64) -> bool,
) -> Result<Listened, DeviceError> {
    play_and_listen_for(handle, signal, sensor, go_on, PATIENCE)
}

/// As [`play_and_listen`], with another time limit.
fn play_and_listen_for(
    handle: &mut Handle,
    signal: Signal,
    sensor: &mut dyn Sensor,
    go_on: &mut dyn FnMut(f64) -> bool,
    patience: Duration,
) -> Result<Listened, DeviceError> {
    let listened = listen_around(handle, signal, sensor, go_on, patience);
    if listened.is_err() {
        let_fade(handle);
    }
    listened
}

/// Stops the signal and waits until its fade has been played by the device, within a time limit.
fn let_fade(handle: &mut Handle) {
    handle.stop_signal();
    let begun = Instant::now();
    let is_playing = |status: Status| status.state == LinkState::Running && status.plays_signal;
    while is_playing(handle.status()) {
        if begun.elapsed() > Duration::from_secs_f64(2.0 * FADE_SECS) + FADE_PATIENCE {
            return;
        }
        std::thread::sleep(POLL);
    }
    // Samples that the device has taken are played after its latency.
    let device_secs = handle.status().device_latency_secs;
    let device = Duration::try_from_secs_f32(device_secs).unwrap_or_default();
    std::thread::sleep(POLL + device.min(FADE_PATIENCE));
}

/// Changes of an output's status since the start of the measurement.
struct Watch {
    begin: Status,
    lowest_heat_gain: f32,
}

impl Watch {
    fn new(begin: Status) -> Self {
        Self { begin, lowest_heat_gain: f32::INFINITY }
    }

    fn note(&mut self, status: Status) {
        self.lowest_heat_gain = self.lowest_heat_gain.min(status.heat_gain);
    }

    fn until(&self, end: Status) -> Status {
        Status {
            underruns: end.underruns.saturating_sub(self.begin.underruns),
            backend_errors: end.backend_errors.saturating_sub(self.begin.backend_errors),
            limited_samples: end.limited_samples.saturating_sub(self.begin.limited_samples),
            heat_gain: end.heat_gain.min(self.lowest_heat_gain),
            ..end
        }
    }
}

fn listen_around(
    handle: &mut Handle,
    signal: Signal,
    sensor: &mut dyn Sensor,
    go_on: &mut dyn FnMut(f64) -> bool,
    patience: Duration,
) -> Result<Listened, DeviceError> {
    let signal_secs = signal.n_frames() as f64 / f64::from(handle.config().device_rate_hz);
    let mut heard = Vec::new();
    let mut listen = |handle: &mut Handle, secs_done: f64, heard: &mut Vec<f32>| {
        std::thread::sleep(POLL);
        sensor.read(heard);
        sensor.check()?;
        handle.collect();
        let status = handle.status();
        if status.state == LinkState::Lost {
            let lost = || {
                DeviceError::new(
                    DeviceErrorKind::Lost,
                    "the output is lost; open it again and repeat the measurement",
                )
            };
            return Err(handle.loss().cloned().unwrap_or_else(lost));
        }
        if !go_on(secs_done / (signal_secs + 2.0 * SILENCE_SECS)) {
            return Err(DeviceError::new(DeviceErrorKind::Canceled, "the measurement was canceled"));
        }
        Ok(status)
    };
    let started = Instant::now();
    while listen(handle, 0.0, &mut heard)?.state != LinkState::Running || heard.is_empty() {
        if started.elapsed() > patience {
            let what = if heard.is_empty() {
                "the sensor sends no samples"
            } else {
                "the output requests no samples"
            };
            let message =
                format!("{what}; check its connection, or choose another one that `shagreen devices` lists");
            return Err(DeviceError::new(DeviceErrorKind::Unavailable, message));
        }
    }
    wait(SILENCE_SECS, &mut |secs| listen(handle, secs, &mut heard).map(|_| ()))?;
    let mut watch = Watch::new(handle.status());
    if handle.play_signal(signal).is_err() {
        let message = "the output's command queue is full; try again";
        return Err(DeviceError::new(DeviceErrorKind::Unavailable, message));
    }
    let begun = Instant::now();
    let mut has_begun = false;
    loop {
        let secs = begun.elapsed().as_secs_f64();
        let status = listen(handle, SILENCE_SECS + secs.min(signal_secs), &mut heard)?;
        watch.note(status);
        let plays = status.plays_signal;
        if has_begun && !plays {
            break;
        }
        has_begun |= plays;
        if begun.elapsed() > Duration::from_secs_f64(signal_secs) + patience {
            let message =
                "the output did not play the signal to its end; open it again and repeat the measurement";
            return Err(DeviceError::new(DeviceErrorKind::Unavailable, message));
        }
    }
    wait(SILENCE_SECS, &mut |secs| {
        listen(handle, SILENCE_SECS + signal_secs + secs, &mut heard).map(|_| ())
    })?;
    Ok(Listened { samples: heard, status: watch.until(handle.status()) })
}

/// Calls `step` repeatedly for the given time, with the elapsed time in seconds.
fn wait(secs: f64, step: &mut dyn FnMut(f64) -> Result<(), DeviceError>) -> Result<(), DeviceError> {
    let begun = Instant::now();
    while begun.elapsed().as_secs_f64() < secs {
        step(begun.elapsed().as_secs_f64())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
