//! The open port: reading waits a little, writing never does.

use std::io;
use std::time::Duration;

use serialport::SerialPort;

use crate::error::{DeviceError, DeviceErrorKind};

/// How long reading waits for a byte: how late what is due by time may be.
const READ_WAIT: Duration = Duration::from_millis(2);

/// A serial port that is ours.
pub(super) struct Line {
    port: Box<dyn SerialPort>,
    /// The same port, opened so that it takes what it has room for: a write to `port` may wait for ever.
    #[cfg(unix)]
    writer: std::fs::File,
}

impl Line {
    /// Opens a port by the system's name.
    ///
    /// # Errors
    /// - [`DeviceErrorKind::NotFound`], [`DeviceErrorKind::Busy`], [`DeviceErrorKind::Denied`] where it is so.
    /// - [`DeviceErrorKind::Unsupported`] where it is no serial port, or has no such baud rate.
    pub(super) fn open(id: &str, port: &str, baud: u32) -> Result<Self, DeviceError> {
        #[cfg(unix)]
        let writer = open_writer(port).map_err(|error| explain_io(id, &error))?;
        // The pseudo terminals of macOS refuse every rate.
        let baud_to_set = if cfg!(target_os = "macos") && port.starts_with("/dev/ttys") { 0 } else { baud };
        let builder = serialport::new(port, baud_to_set).timeout(READ_WAIT).dtr_on_open(true);
        let mut port = builder.open().map_err(|error| explain(id, baud, &error))?;
        // What is not there on every port: a pseudo terminal has no such wires, and some have no buffers to clear.
        let _ = port.write_request_to_send(true);
        let _ = port.clear(serialport::ClearBuffer::All);
        Ok(Self {
            port,
            #[cfg(unix)]
            writer,
        })
    }

    /// Reads what there is, or nothing after a short wait.
    ///
    /// # Errors
    /// What the system says of a port that is gone.
    pub(super) fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        match self.port.read(bytes) {
            // There was something to read, and then there was not: so does a line that has been cut.
            Ok(0) => Err(io::ErrorKind::UnexpectedEof.into()),
            Err(error) if super::outbox::is_no_room(&error) => Ok(0),
            read => read,
        }
    }

    /// Writes what there is room for.
    ///
    /// # Errors
    /// As for [`Line::read`]; without room, one of the kinds that [`super::outbox::Outbox::flush`] takes for that.
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
        // On a system with files it has been opened once already, so it is there.
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
            (DeviceErrorKind::NotFound, "plug it in, or take another: `shagreen devices` lists them")
        }
        io::ErrorKind::ResourceBusy => {
            (DeviceErrorKind::Busy, "close the program that uses it and try again")
        }
        io::ErrorKind::PermissionDenied => (
            DeviceErrorKind::Denied,
            "give yourself the right to it (on Linux: join the group that owns it, often dialout, and log in again)",
        ),
        _ => (
            DeviceErrorKind::Unsupported,
            "name a serial port (`shagreen devices` lists them) and a baud rate that it has",
        ),
    }
}
