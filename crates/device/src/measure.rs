//! Plays a signal on an output and listens to a sensor meanwhile: how an actuator is measured.

use std::fmt::Display;
use std::time::{Duration, Instant};

use shagreen_synth::drive::{DriveConfig, Driven};

use crate::audio_input::Recorder;
use crate::engine::{ChannelMask, FADE_SECS, Handle};
use crate::error::{DeviceError, DeviceErrorKind};
use crate::output::{self, OpenOptions, Running};
use crate::serial::{self, ReceiverInfo, SerialOptions, SerialSensor};
use crate::signal::Signal;
use crate::status::{LinkState, Status};

/// What listens: samples that come by themselves.
pub trait Sensor {
    /// Rate of the samples, in Hz.
    fn rate_hz(&self) -> f64;

    /// Appends what has come since the last call.
    fn read(&mut self, out: &mut Vec<f32>);

    /// Whether it still listens and nothing is missing.
    ///
    /// # Errors
    /// Says what is wrong and what to do.
    fn check(&self) -> Result<(), DeviceError>;
}

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

/// Who listens.
#[derive(Clone, Debug, PartialEq)]
pub enum Listener {
    /// An input of the system's sound.
    Input {
        /// Its id.
        id: String,
        /// Which of its channels, from zero.
        channel_idx: usize,
        /// Acceleration of a sample of 1.0, in m/s².
        sensitivity_mps2: f64,
    },
    /// The accelerometer of a receiver on a serial port.
    Serial {
        /// The port.
        port: String,
        /// Its baud rate.
        baud: u32,
    },
}

/// What was heard of a signal.
#[derive(Clone, Debug)]
pub struct Heard {
    /// Acceleration in m/s².
    pub mps2: Vec<f64>,
    /// Samples a second.
    pub rate_hz: f64,
    /// How the output was doing at the end, but for what counts from the beginning of the measurement on: its underruns,
    /// errors and limited samples, and the lowest gain that kept the coil cool.
    pub status: Status,
}

impl Heard {
    /// Whether the limits of the actuator turned the signal down.
    pub fn was_limited(&self) -> bool {
        self.status.limited_samples > 0 || self.status.heat_gain < 0.99
    }
}

/// Opens output `id` with these limits on these channels, plays on it the drive that `drive_at` makes for its rate in Hz, and returns what was heard.
///
/// `go_on` is told the share that is done, 0..1, and says whether to go on. Where it does not, and with every error, the
/// signal fades before the output is closed.
///
/// # Errors
/// Those of [`crate::output::open`] and of the listener, and:
/// - [`DeviceErrorKind::Config`] where `drive_at` says why there is no drive.
/// - [`DeviceErrorKind::Unsupported`], before anything is played, where the receiver that is to listen has no sensor.
/// - [`DeviceErrorKind::Lost`] where the output or the sensor goes.
/// - [`DeviceErrorKind::Canceled`] where `go_on` says so.
/// - [`DeviceErrorKind::Unavailable`] where the output asks for nothing, or the sensor says nothing.
pub fn measure<E: Display>(
    id: &str,
    (drive, channels): (DriveConfig, ChannelMask),
    listener: &Listener,
    drive_at: &dyn Fn(f64) -> Result<Vec<f32>, E>,
    go_on: &mut dyn FnMut(f64) -> bool,
) -> Result<Heard, DeviceError> {
    // Nothing is rendered here: the rate of textures and the noise say nothing.
    let options = OpenOptions {
        model_rate_hz: 1000.0,
        preferred_rate_hz: None,
        buffer_frames: None,
        seed: 1,
        drive,
        channels,
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
            // The channels are those of the output; a receiver that only listens has its own.
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

/// A port's name without what its id begins with.
fn serial_id(id: &str) -> &str {
    id.strip_prefix(serial::ID_PREFIX).unwrap_or(id)
}

/// Whether a receiver has something to listen with.
fn check_sensor(port: &str, receiver: &ReceiverInfo) -> Result<(), DeviceError> {
    if receiver.has_sensor {
        return Ok(());
    }
    let message = format!(
        "the receiver `{}` on `{port}` has no sensor; connect an accelerometer that its firmware knows, or listen with an \
         input of the system's sound: `shagreen devices` lists them",
        receiver.name
    );
    Err(DeviceError::new(DeviceErrorKind::Unsupported, message))
}

/// What a sensor said of a signal.
#[derive(Clone, Debug)]
struct Listened {
    /// Its samples, silence before and after the signal included.
    samples: Vec<f32>,
    /// As [`Heard::status`].
    status: Status,
}

/// Silence that is recorded before the signal and after it, in seconds: what the room does by itself, and what rings.
pub const SILENCE_SECS: f64 = 1.0;
/// How often both are looked at.
const POLL: Duration = Duration::from_millis(10);
/// How much longer than the signal playing may take.
const PATIENCE: Duration = Duration::from_secs(10);
/// How much longer than its fade a signal may take to end where a measurement is given up.
const FADE_PATIENCE: Duration = Duration::from_millis(500);

/// Plays a signal through an engine and returns what the sensor heard, silence before and after included. Whatever ends
/// it, the signal has faded by the time that this returns.
fn play_and_listen(
    handle: &mut Handle,
    signal: Signal,
    sensor: &mut dyn Sensor,
    go_on: &mut dyn FnMut(f64) -> bool,
) -> Result<Listened, DeviceError> {
    play_and_listen_for(handle, signal, sensor, go_on, PATIENCE)
}

/// The same, with another patience for what does not begin or end.
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

/// Ends the signal and waits until its fade has left the device, as far as that can be.
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
    // What the device has taken is heard so much later.
    let device_secs = handle.status().device_latency_secs;
    let device = Duration::try_from_secs_f32(device_secs).unwrap_or_default();
    std::thread::sleep(POLL + device.min(FADE_PATIENCE));
}

/// What an output did since a status, up to the last of those that it was told.
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
                DeviceError::new(DeviceErrorKind::Lost, "the output is lost; open it again and measure anew")
            };
            return Err(handle.loss().cloned().unwrap_or_else(lost));
        }
        if !go_on(secs_done / (signal_secs + 2.0 * SILENCE_SECS)) {
            return Err(DeviceError::new(DeviceErrorKind::Canceled, "the measurement was stopped"));
        }
        Ok(status)
    };
    let started = Instant::now();
    while listen(handle, 0.0, &mut heard)?.state != LinkState::Running || heard.is_empty() {
        if started.elapsed() > patience {
            let what =
                if heard.is_empty() { "the sensor sends nothing" } else { "the output asks for no samples" };
            let message =
                format!("{what}; look at its connection, or choose another: `shagreen devices` lists them");
            return Err(DeviceError::new(DeviceErrorKind::Unavailable, message));
        }
    }
    wait(SILENCE_SECS, &mut |secs| listen(handle, secs, &mut heard).map(|_| ()))?;
    let mut watch = Watch::new(handle.status());
    if handle.play_signal(signal).is_err() {
        let message = "the output takes no signal; try again";
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
            let message = "the output did not play the signal to its end; open it again and measure anew";
            return Err(DeviceError::new(DeviceErrorKind::Unavailable, message));
        }
    }
    wait(SILENCE_SECS, &mut |secs| {
        listen(handle, SILENCE_SECS + signal_secs + secs, &mut heard).map(|_| ())
    })?;
    Ok(Listened { samples: heard, status: watch.until(handle.status()) })
}

/// Does something for so long, told how long it has been done.
fn wait(secs: f64, step: &mut dyn FnMut(f64) -> Result<(), DeviceError>) -> Result<(), DeviceError> {
    let begun = Instant::now();
    while begun.elapsed().as_secs_f64() < secs {
        step(begun.elapsed().as_secs_f64())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
