//! Actuators behind a microcontroller on a serial port: USB CDC or a UART.
//!
//! `docs/serial-protocol.md` is the protocol: all that firmware needs to know. [`receiver`] is the microcontroller's side
//! of it, [`open`] the host's.

mod agreement;
mod connection;
pub mod frame;
mod greeting;
mod line;
pub mod message;
mod outbox;
mod ports;
pub mod receiver;
mod sender;
mod sensor;

pub use self::agreement::{ReceiverInfo, USUAL_SERIAL_RATE_HZ};
pub use self::connection::{Heard, SensorBlock};
pub use self::ports::{ID_PREFIX, SerialPortInfo, SerialPortKind, list_serial_ports};
pub use self::sensor::SerialSensor;

use std::sync::Arc;
use std::time::Duration;

use rtrb::Consumer;

pub(crate) use self::connection::SerialOutput;
use self::line::Line;
use self::message::Mode;
use crate::engine::Handle;
use crate::error::DeviceError;
use crate::output::{Made, OpenOptions, Running, make_engine};

/// Baud rate where nobody asks for another: adapters and microcontrollers have it without rounding.
pub const USUAL_BAUD: u32 = 1_000_000;
/// Silence after this long without samples, in ms, where nobody asks for another time.
pub const USUAL_WATCHDOG_MS: u16 = 50;

/// How to open a serial output, beyond what every output is opened by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SerialOptions {
    /// Baud rate; USB CDC has none and does not care.
    pub baud: u32,
    /// Who renders.
    pub mode: Mode,
    /// The receiver is silent this long after samples or control stop, in ms, at least 10.
    pub watchdog_ms: u16,
    /// How long a receiver may take to answer: some are reset when the port is opened.
    pub patience: Duration,
}

impl Default for SerialOptions {
    /// The host renders; three seconds are enough for a boot loader.
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
    /// For whoever is in charge.
    pub handle: Handle,
    /// Plays until it is dropped.
    pub running: Running,
    /// What the receiver says of itself.
    pub receiver: ReceiverInfo,
    /// What it says beside the stream; bounded: what nobody takes is dropped.
    pub heard: Consumer<Heard>,
}

/// Opens the receiver on a serial port as an output, silent until its handle is told otherwise. The id is one of
/// [`list_serial_ports`], or any port's name; `serial:` before it may be left out. Blocks until the receiver answers.
///
/// [`OpenOptions::buffer_frames`] is the number of samples that are queued in the receiver.
///
/// # Errors
/// - [`crate::error::DeviceErrorKind::NotFound`], `Busy` or `Denied` where the port is so.
/// - [`crate::error::DeviceErrorKind::Unavailable`] where nothing answers on it.
/// - [`crate::error::DeviceErrorKind::Unsupported`] where the receiver or the line cannot do what is asked.
/// - [`crate::error::DeviceErrorKind::Config`] where the options contradict themselves.
/// - [`crate::error::DeviceErrorKind::Backend`] where the system fails.
pub fn open(id: &str, options: OpenOptions, serial: SerialOptions) -> Result<Connection, DeviceError> {
    let id = if id.starts_with(ID_PREFIX) { id.to_owned() } else { format!("{ID_PREFIX}{id}") };
    let port = ports::resolve(&id)?;
    let mut line = Line::open(&id, &port, serial.baud)?;
    let receiver = greeting::greet(&id, &mut line, serial)?;
    let plan = agreement::agree(&id, &receiver, options, serial)?;
    let rate_hz = u32::from(plan.configure.rate_hz);
    let Made { handle, engine, reporter } = make_engine(options, rate_hz)?;
    let shared = Arc::clone(&reporter.shared);
    let window_secs = f64::from(plan.configure.window) / f64::from(rate_hz);
    let engine_latency_secs = f64::from(engine.latency_secs());
    let line_latency_secs = window_secs + agreement::line_secs(plan, serial.baud);
    let line_latency = Duration::from_secs_f64(line_latency_secs);
    let (output, heard) = SerialOutput::start(&id, line, plan, engine, reporter, line_latency)?;
    let latencies_secs = (engine_latency_secs, line_latency_secs);
    let running = Running::of_serial(id, rate_hz, plan.configure.window, latencies_secs, shared, output);
    Ok(Connection { handle, running, receiver, heard })
}
