//! A sweep that is played on an output while a sensor listens.

use anyhow::Context as _;
use shagreen_core::actuator::{Actuator, Drive, Limits, limited_drive};
use shagreen_core::calibration::Sweep;
use shagreen_core::units::Hertz;
use shagreen_device::audio_input::Recorder;
use shagreen_device::engine::{ChannelMask, Handle};
use shagreen_device::measure::{SILENCE_SECS, Sensor, play_and_listen};
use shagreen_device::output::{OpenOptions, Running, open};
use shagreen_device::serial::{self, SerialOptions, SerialSensor};
use shagreen_device::signal::Signal;
use shagreen_device::synth::drive::Driven;

use crate::cli::calibrate_recording::Recorded;
use crate::cli::output::{self, Progress};

/// Who listens.
pub(crate) enum Listener<'a> {
    /// An input of the system's sound.
    Input {
        /// Its id.
        id: &'a str,
        /// Which of its channels, from zero.
        channel_idx: usize,
        /// Acceleration of a sample of 1.0, in m/s².
        sensitivity_mps2: f64,
    },
    /// The accelerometer of a receiver on a serial port.
    Serial {
        /// The port.
        port: &'a str,
        /// Its baud rate.
        baud: u32,
    },
}

/// Rate that textures would have: nothing is rendered here.
const MODEL_RATE_HZ: f32 = 1000.0;

/// Plays the sweep on output `id` and records what the sensor hears. The limits of an actuator that is known hold.
pub(crate) fn record_live(
    id: &str,
    listener: &Listener<'_>,
    sweep: &Sweep,
    actuator: Option<&Actuator>,
    drive: Drive,
) -> anyhow::Result<Recorded> {
    let options = OpenOptions {
        model_rate_hz: MODEL_RATE_HZ,
        preferred_rate_hz: None,
        buffer_frames: None,
        seed: 1,
        drive: limited_drive(&actuator.map_or(Limits::default(), |actuator| actuator.limits), drive),
        channels: ChannelMask::FIRST_TWO,
    };
    match listener {
        Listener::Input { id: input, channel_idx, sensitivity_mps2 } => {
            let (mut handle, running) = open(id, options).context("cannot calibrate")?;
            let mut recorder =
                Recorder::open(input, *channel_idx, running.rate_hz()).context("cannot calibrate")?;
            let heard = sweep_through(&mut handle, &running, sweep, &mut recorder)?;
            Ok(Recorded {
                acceleration_mps2: heard.iter().map(|x| sensitivity_mps2 * f64::from(*x)).collect(),
                rate: Hertz(f64::from(recorder.rate_hz())),
                channel: channel_idx + 1,
            })
        }
        Listener::Serial { port, baud } => {
            let serial = SerialOptions { baud: *baud, ..SerialOptions::default() };
            let connection = serial::open(port, options, serial).context("cannot calibrate")?;
            let mut sensor = SerialSensor::new(connection.heard);
            let mut own = (connection.handle, connection.running);
            let heard = if id == own.1.id() {
                sweep_through(&mut own.0, &own.1, sweep, &mut sensor)?
            } else {
                let (mut handle, running) = open(id, options).context("cannot calibrate")?;
                sweep_through(&mut handle, &running, sweep, &mut sensor)?
            };
            Ok(Recorded {
                acceleration_mps2: heard.iter().map(|x| f64::from(*x)).collect(),
                rate: Hertz(sensor.rate_hz()),
                channel: 1,
            })
        }
    }
}

fn sweep_through(
    handle: &mut Handle,
    running: &Running,
    sweep: &Sweep,
    sensor: &mut dyn Sensor,
) -> anyhow::Result<Vec<f32>> {
    let samples = sweep.signal(Hertz(f64::from(running.rate_hz())))?;
    let signal = Signal::new(samples.iter().map(|x| *x as f32).collect(), Driven::Drive)?;
    let secs = signal.n_frames() as f64 / f64::from(running.rate_hz()) + 2.0 * SILENCE_SECS;
    let progress = Progress::new("ms measured", output::in_ms(secs));
    let before = handle.status().limited_samples;
    let heard = play_and_listen(handle, signal, sensor, &mut |share| {
        progress.set_secs(share * secs);
        true
    });
    progress.finish();
    let status = handle.status();
    if status.limited_samples > before || status.heat_gain < 0.99 {
        output::warn("the limits of the actuator turned the sweep down: measure with a lower --amplitude");
    }
    if status.underruns > 0 {
        output::warn(&format!(
            "the output dropped out {} times while it was measured: close other programs and measure again",
            status.underruns
        ));
    }
    Ok(heard?)
}
