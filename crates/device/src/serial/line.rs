//! Open serial port with a short read timeout and non-blocking writes.

use std::io;
use std::time::Duration;

use serialport::SerialPort;

use crate::error::{DeviceError, DeviceErrorKind};

/// Read timeout, which is also the largest delay of timed actions.
const READ_WAIT: Duration = Duration::from_millis(2);

/// A serial port that is open exclusively.
pub(super) struct Line {
    port: Box<dyn SerialPort>,
    /// The same port, opened for non-blocking writes; a write to `port` may block indefinitely.
    #[cfg(unix)]
    writer: std::fs::File,
}

impl Line {
    /// Opens a port by its system name.
    ///
    /// # Errors
    /// - [`DeviceErrorKind::NotFound`], [`DeviceErrorKind::Busy`] or [`DeviceErrorKind::Denied`] if the port is
    ///   missing, in use or refused.
    /// - [`DeviceErrorKind::Unsupported`] if it is not a serial port or does not support the baud rate.
    pub(super) fn open(id: &str, port: &str, baud: u32) -> Result<Self, DeviceError> {
        #[cfg(unix)]
        let writer = open_writer(port).map_err(|error| explain_io(id, &error))?;
        // Pseudoterminals of macOS reject every baud rate.
        let baud_to_set = if cfg!(target_os = "macos") && port.starts_with("/dev/ttys") { 0 } else { baud };
        let builder = serialport::new(port, baud_to_set).timeout(READ_WAIT).dtr_on_open(true);
        let mut port = builder.open().map_err(|error| explain(id, baud, &error))?;
        // Failures are ignored: a pseudoterminal has no RTS wire, and some ports have no buffers to clear.
        let _ = port.write_request_to_send(true);
        let _ = port.clear(serialport::ClearBuffer::All);
        Ok(Self {
            port,
            #[cfg(unix)]
            writer,
        })
    }

    /// Reads the available bytes, or none after a short timeout.
    ///
    /// # Errors
    /// The system's error if the port is disconnected.
    pub(super) fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        match self.port.read(bytes) {
            // Data was signaled but none is there: the port was disconnected.
            Ok(0) => Err(io::ErrorKind::UnexpectedEof.into()),
            Err(error) if super::write_queue::is_no_room(&error) => Ok(0),
            read => read,
        }
    }

    /// Writes as many bytes as the port accepts.
    ///
    /// # Errors
    /// As for [`Line::read`]. If the port accepts none, one of the kinds that [`super::write_queue::WriteQueue::flush`] expects.
    pub(super) fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        #[cfg(unix)]
        return io::Write::write(&mut self.writer, bytes);
        #[cfg(not(unix))]
        io::Write::write(&mut self.port, bytes)
    }
}

#[cfg(unix)]
fn open_writer(port: &str) -> io::Result<std::fs::File> {
    use rustix::fs::OFlags;
    use std::os::unix::fs::OpenOptionsExt as _;
    let flags = OFlags::NONBLOCK | OFlags::NOCTTY;
    std::fs::OpenOptions::new().read(true).write(true).custom_flags(flags.bits().cast_signed()).open(port)
}

#[cfg(unix)]
fn explain_io(id: &str, error: &io::Error) -> DeviceError {
    let (kind, advice) = advice_on(error.kind());
    DeviceError::new(kind, format!("the serial port `{id}` cannot be opened: {error}; {advice}"))
}

fn explain(id: &str, baud: u32, error: &serialport::Error) -> DeviceError {
    let (kind, advice) = match error.kind() {
        // On Unix the port was opened once already, so it exists and is in use.
        serialport::ErrorKind::NoDevice if cfg!(unix) => advice_on(io::ErrorKind::ResourceBusy),
        serialport::ErrorKind::NoDevice => advice_on(io::ErrorKind::NotFound),
        serialport::ErrorKind::Io(kind) => advice_on(kind),
        serialport::ErrorKind::InvalidInput | serialport::ErrorKind::Unknown => {
            advice_on(io::ErrorKind::Other)
        }
    };
    let message = format!("the serial port `{id}` cannot be opened at {baud} baud: {error}; {advice}");
    DeviceError::new(kind, message)
}

fn advice_on(kind: io::ErrorKind) -> (DeviceErrorKind, &'static str) {
    match kind {
        io::ErrorKind::NotFound => {
            (DeviceErrorKind::NotFound, "plug it in, or choose another one that `shagreen devices` lists")
        }
        io::ErrorKind::ResourceBusy => {
            (DeviceErrorKind::Busy, "close the program that uses it and try again")
        }
        io::ErrorKind::PermissionDenied => (
            DeviceErrorKind::Denied,
            "grant yourself access to it (on Linux: join the group that owns it, often dialout, and log in again)",
        ),
        _ => (
            DeviceErrorKind::Unsupported,
            "choose a serial port that `shagreen devices` lists and a baud rate that it supports",
        ),
    }
}
