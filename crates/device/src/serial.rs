//! Actuators driven by a microcontroller on a serial port (USB CDC or UART).
//!
//! `docs/serial-protocol.md` specifies the protocol for firmware authors. [`receiver`] implements the microcontroller's
//! side, [`open`] the host's.

mod connection;
pub mod frame;
mod handshake;
mod line;
pub mod message;
mod negotiation;
mod ports;
pub mod receiver;
mod sender;
mod sensor;
mod write_queue;

pub use self::connection::{ReceiverEvent, SensorBlock};
pub use self::negotiation::{ReceiverInfo, USUAL_SERIAL_RATE_HZ};
pub use self::ports::{ID_PREFIX, SerialPortInfo, SerialPortKind, list_serial_ports};
pub use self::sensor::SerialSensor;

use std::sync::Arc;
use std::time::Duration;

use rtrb::Consumer;

pub(crate) use self::connection::SerialOutput;
use self::line::Line;
use self::message::Mode;
use crate::engine::{ChannelMask, FrictionConfig, FrictionWave, Handle};
use crate::error::DeviceError;
use crate::output_options::{Made, OpenOptions, make_engine};
use crate::running::{Running, RunningFacts};

/// Default baud rate, which adapters and microcontrollers can generate exactly.
pub const USUAL_BAUD: u32 = 1_000_000;
/// Default watchdog time, in ms: without samples for this time, the receiver becomes silent.
pub const USUAL_WATCHDOG_MS: u16 = 50;

/// Options for a serial output, in addition to [`OpenOptions`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SerialOptions {
    /// Baud rate; USB CDC ignores it.
    pub baud: u32,
    /// Mode: rendering by the host or by the receiver, or friction.
    pub mode: Mode,
    /// Time after the last samples or controls at which the receiver becomes silent, in ms, at least 10.
    pub watchdog_ms: u16,
    /// Time limit for the receiver's first reply; some receivers reset when the port is opened.
    pub patience: Duration,
}

impl Default for SerialOptions {
    /// Rendering by the host, and a time limit of three seconds, which suffices for a boot loader.
    fn default() -> Self {
        Self {
            baud: USUAL_BAUD,
            mode: Mode::Stream,
            watchdog_ms: USUAL_WATCHDOG_MS,
            patience: Duration::from_secs(3),
        }
    }
}

/// An open serial output.
#[derive(Debug)]
pub struct Connection {
    /// Handle of the engine.
    pub handle: Handle,
    /// The open output; it plays until it is dropped.
    pub running: Running,
    /// Capabilities that the receiver declares.
    pub receiver: ReceiverInfo,
    /// Sensor data and events from the receiver, in a bounded queue; if it is full, new ones are dropped.
    pub heard: Consumer<ReceiverEvent>,
}

/// Options with the vibration or the friction on the only channel of a receiver.
fn on_the_channel(options: OpenOptions, mode: Mode) -> OpenOptions {
    match mode {
        Mode::Stream | Mode::Control => OpenOptions { friction: None, ..options },
        Mode::Friction => {
            let friction = Some(FrictionConfig { channel_idx: 0, wave: FrictionWave::Level });
            OpenOptions { channels: ChannelMask::NONE, friction, ..options }
        }
    }
}

/// Opens the receiver on a serial port as an output, which is silent until its handle sets controls. The id is one of
/// [`list_serial_ports`] or any port name; the prefix `serial:` is optional. Blocks until the receiver replies.
///
/// [`OpenOptions::buffer_frames`] is the number of samples that are queued in the receiver.
///
/// # Errors
/// - [`crate::error::DeviceErrorKind::NotFound`], `Busy` or `Denied` if the port is missing, in use or refused.
/// - [`crate::error::DeviceErrorKind::Unavailable`] if there is no reply.
/// - [`crate::error::DeviceErrorKind::Unsupported`] if the receiver or the connection does not support the options.
/// - [`crate::error::DeviceErrorKind::Config`] if the options are contradictory.
/// - [`crate::error::DeviceErrorKind::Backend`] if the system fails.
pub fn open(id: &str, options: OpenOptions, serial: SerialOptions) -> Result<Connection, DeviceError> {
    let id = if id.starts_with(ID_PREFIX) { id.to_owned() } else { format!("{ID_PREFIX}{id}") };
    let port = ports::resolve(&id)?;
    let mut line = Line::open(&id, &port, serial.baud)?;
    let receiver = handshake::greet(&id, &mut line, serial)?;
    let plan = negotiation::agree(&id, &receiver, options, serial)?;
    let rate_hz = u32::from(plan.configure.rate_hz);
    let Made { handle, engine, reporter } = make_engine(on_the_channel(options, serial.mode), rate_hz)?;
    let shared = Arc::clone(&reporter.shared);
    let window_secs = f64::from(plan.configure.window) / f64::from(rate_hz);
    let engine_latency_secs = f64::from(engine.latency_secs());
    let line_latency_secs = window_secs + negotiation::line_secs(plan, serial.baud);
    let line_latency = Duration::from_secs_f64(line_latency_secs);
    let (output, heard) = SerialOutput::start(&id, line, plan, engine, reporter, line_latency)?;
    let latencies_secs = (engine_latency_secs, line_latency_secs);
    let (engine_latency_secs, device_latency_secs) = latencies_secs;
    let facts = RunningFacts {
        id,
        rate_hz,
        channels: 1,
        buffer_frames: Some(u32::from(plan.configure.window)),
        engine_latency_secs,
        device_latency_secs,
    };
    let running = Running::new(facts, shared, output);
    Ok(Connection { handle, running, receiver, heard })
}
