//! Plays a signal on an output and listens to a sensor meanwhile: how an actuator is measured.

use std::time::{Duration, Instant};

use shagreen_synth::drive::{DriveConfig, Driven};

use crate::audio_input::Recorder;
use crate::engine::{ChannelMask, Handle};
use crate::error::{DeviceError, DeviceErrorKind};
use crate::output::{self, OpenOptions, Running};
use crate::serial::{self, SerialOptions, SerialSensor};
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
        Self::check(self)?;
        if self.n_dropped() > 0 {
            let message = "samples of the input were lost while it was measured; close other programs and measure again";
            return Err(DeviceError::new(DeviceErrorKind::Backend, message));
        }
        Ok(())
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
    /// How the output was doing at the end: whether it was limited, or dropped out.
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
/// # Errors
/// Those of [`crate::output::open`], of the listener and of [`play_and_listen`]; [`DeviceErrorKind::Config`] where
/// `drive_at` says why there is no drive.
pub fn measure(
    id: &str,
    (drive, channels): (DriveConfig, ChannelMask),
    listener: &Listener,
    drive_at: &dyn Fn(f64) -> Result<Vec<f32>, String>,
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
        let samples = drive_at(f64::from(running.rate_hz())).map_err(refuse)?;
        let signal = Signal::new(samples, Driven::Drive).map_err(|error| refuse(error.to_string()))?;
        let heard = play_and_listen(handle, signal, sensor, go_on)?;
        Ok((heard, sensor.rate_hz(), handle.status()))
    };
    let ((heard, rate_hz, status), scale) = match listener {
        Listener::Input { id: input, channel_idx, sensitivity_mps2 } => {
            let (mut handle, running) = output::open(id, options)?;
            let mut recorder = Recorder::open(input, *channel_idx, running.rate_hz())?;
            (through(&mut handle, &running, &mut recorder)?, *sensitivity_mps2)
        }
        Listener::Serial { port, baud } => {
            let serial = SerialOptions { baud: *baud, ..SerialOptions::default() };
            let mut connection = serial::open(port, options, serial)?;
            let mut sensor = SerialSensor::new(connection.heard);
            let heard = if id == connection.running.id() {
                through(&mut connection.handle, &connection.running, &mut sensor)?
            } else {
                let (mut handle, running) = output::open(id, options)?;
                through(&mut handle, &running, &mut sensor)?
            };
            (heard, 1.0)
        }
    };
    Ok(Heard { mps2: heard.iter().map(|x| scale * f64::from(*x)).collect(), rate_hz, status })
}

/// Silence that is recorded before the signal and after it, in seconds: what the room does by itself, and what rings.
pub const SILENCE_SECS: f64 = 1.0;
/// How often both are looked at.
const POLL: Duration = Duration::from_millis(10);
/// How much longer than the signal playing may take.
const PATIENCE: Duration = Duration::from_secs(10);

/// Plays a signal through an engine and returns what the sensor heard, silence before and after included.
///
/// `go_on` is told the share that is done, 0..1, and says whether to go on; the signal fades where it does not.
///
/// # Errors
/// - [`DeviceErrorKind::Lost`] where the output or the sensor goes.
/// - [`DeviceErrorKind::Canceled`] where `go_on` says so.
/// - [`DeviceErrorKind::Unavailable`] where the output asks for nothing, or the sensor says nothing.
pub fn play_and_listen(
    handle: &mut Handle,
    signal: Signal,
    sensor: &mut dyn Sensor,
    go_on: &mut dyn FnMut(f64) -> bool,
) -> Result<Vec<f32>, DeviceError> {
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
            handle.stop_signal();
            return Err(DeviceError::new(DeviceErrorKind::Canceled, "the measurement was stopped"));
        }
        Ok(status)
    };
    let started = Instant::now();
    while listen(handle, 0.0, &mut heard)?.state != LinkState::Running || heard.is_empty() {
        if started.elapsed() > PATIENCE {
            let what =
                if heard.is_empty() { "the sensor sends nothing" } else { "the output asks for no samples" };
            let message =
                format!("{what}; look at its connection, or choose another: `shagreen devices` lists them");
            return Err(DeviceError::new(DeviceErrorKind::Unavailable, message));
        }
    }
    wait(SILENCE_SECS, &mut |secs| listen(handle, secs, &mut heard).map(|_| ()))?;
    if handle.play_signal(signal).is_err() {
        let message = "the output takes no signal; try again";
        return Err(DeviceError::new(DeviceErrorKind::Unavailable, message));
    }
    let begun = Instant::now();
    let mut has_begun = false;
    loop {
        let secs = begun.elapsed().as_secs_f64();
        let plays = listen(handle, SILENCE_SECS + secs.min(signal_secs), &mut heard)?.plays_signal;
        if has_begun && !plays {
            break;
        }
        has_begun |= plays;
        if begun.elapsed() > Duration::from_secs_f64(signal_secs) + PATIENCE {
            let message = "the output did not play the signal to its end; open it again and measure anew";
            return Err(DeviceError::new(DeviceErrorKind::Unavailable, message));
        }
    }
    wait(SILENCE_SECS, &mut |secs| {
        listen(handle, SILENCE_SECS + signal_secs + secs, &mut heard).map(|_| ())
    })?;
    Ok(heard)
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
mod tests {
    use super::{DeviceError, DeviceErrorKind, Sensor, play_and_listen};
    use crate::engine::Handle;
    use crate::output::tests::OPTIONS;
    use crate::output::{Running, open_null_with_tap};
    use crate::signal::Signal;
    use shagreen_synth::drive::Driven;
    use std::sync::mpsc::{Receiver, channel};

    /// A sensor on the silent output itself.
    struct Wire(Receiver<Vec<f32>>);

    impl Sensor for Wire {
        fn rate_hz(&self) -> f64 {
            48_000.0
        }

        fn read(&mut self, out: &mut Vec<f32>) {
            self.0.try_iter().for_each(|block| out.extend(block.iter().step_by(2)));
        }

        fn check(&self) -> Result<(), DeviceError> {
            Ok(())
        }
    }

    fn wired() -> (Handle, Running, Wire) {
        let (sender, receiver) = channel();
        // The other end has gone when a test ends first.
        let (handle, running) =
            open_null_with_tap(OPTIONS, move |block| drop(sender.send(block.to_vec()))).unwrap();
        (handle, running, Wire(receiver))
    }

    fn signal() -> Signal {
        Signal::new((1..=4800).map(|i| i as f32 * 1e-4).collect(), Driven::Drive).unwrap()
    }

    #[test]
    fn what_is_played_is_heard_with_silence_around_it() {
        let (mut handle, _running, mut wire) = wired();
        let mut shares = Vec::new();
        let heard = play_and_listen(&mut handle, signal(), &mut wire, &mut |share| {
            shares.push(share);
            true
        })
        .unwrap();
        let begin = heard.iter().position(|x| *x != 0.0).unwrap();
        assert!(begin > 40_000 && heard.len() > begin + 4800 + 40_000, "{begin} of {}", heard.len());
        assert!(heard[begin..begin + 4800] == *signal().part(0, 4800));
        assert!(heard[begin + 4800..].iter().all(|x| *x == 0.0));
        assert!(shares.windows(2).all(|w| w[0] <= w[1]) && shares.iter().all(|s| (0.0..=1.0).contains(s)));
    }

    #[test]
    fn it_can_be_stopped_and_a_dead_sensor_is_named() {
        let (mut handle, _running, mut wire) = wired();
        let error = play_and_listen(&mut handle, signal(), &mut wire, &mut |share| share < 0.1).unwrap_err();
        assert_eq!(error.kind(), DeviceErrorKind::Canceled);
        let (_silent, receiver) = channel();
        let error = play_and_listen(&mut handle, signal(), &mut Wire(receiver), &mut |_| true).unwrap_err();
        assert!(error.message().contains("the sensor sends nothing"), "{error}");
    }
}
