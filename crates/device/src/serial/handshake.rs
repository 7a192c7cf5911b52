//! Handshake with a receiver on a serial line.

use std::io;
use std::time::{Duration, Instant, SystemTime};

use crate::error::{DeviceError, DeviceErrorKind};
use crate::serial::SerialOptions;
use crate::serial::frame::{Decoder, MAX_WIRE};
use crate::serial::line::Line;
use crate::serial::message::{DeviceMessage, HostMessage, VERSION, from_device, write_to_device};
use crate::serial::negotiation::ReceiverInfo;
use crate::serial::write_queue::WriteQueue;

/// Interval between two hello messages.
const AGAIN: Duration = Duration::from_millis(100);

/// Sends hello messages until the receiver replies. Returns its capabilities.
///
/// # Errors
/// - [`DeviceErrorKind::Unavailable`] if there is no reply in time.
/// - [`DeviceErrorKind::Lost`] if the port is disconnected.
pub(super) fn greet(id: &str, line: &mut Line, serial: SerialOptions) -> Result<ReceiverInfo, DeviceError> {
    let begun = Instant::now();
    // The nonce is new at each opening and never 0, so replies to earlier hosts are ignored.
    let since_epoch = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    let nonce = (since_epoch.as_micros() as u16) | 1;
    let mut outbox = WriteQueue::new();
    let mut decoder = Decoder::new();
    let (mut n_bytes, mut n_frames, mut next_hello) = (0_usize, 0_usize, Duration::ZERO);
    loop {
        let now = begun.elapsed();
        if now >= serial.patience {
            return Err(nobody(id, serial, n_bytes, n_frames));
        }
        if now >= next_hello {
            next_hello = now + AGAIN;
            let mut wire = [0; MAX_WIRE];
            let len = write_to_device(HostMessage::Hello { nonce, version: VERSION }, &mut wire);
            outbox.push(&wire[..len]);
        }
        outbox.flush(now, &mut |bytes| line.write(bytes)).map_err(|error| lost(id, &error))?;
        let mut bytes = [0; 256];
        let n = line.read(&mut bytes).map_err(|error| lost(id, &error))?;
        n_bytes += n;
        for &byte in &bytes[..n] {
            let Some(frame) = decoder.push(byte) else { continue };
            n_frames += 1;
            if let Ok(Some(DeviceMessage::HelloReply(reply))) = from_device(frame)
                && reply.nonce == nonce
            {
                return Ok(ReceiverInfo::of(reply));
            }
        }
    }
}

fn nobody(id: &str, serial: SerialOptions, n_bytes: usize, n_frames: usize) -> DeviceError {
    let secs = serial.patience.as_secs_f64();
    let baud = serial.baud;
    let why = if n_bytes == 0 {
        format!(
            "no reply within {secs:.1} s: check that this is the right port, that the microcontroller has power and \
             runs firmware for this protocol, that its RX is connected to the host's TX, that both share a ground, \
             and that it runs at {baud} baud"
        )
    } else if n_frames == 0 {
        format!(
            "{n_bytes} bytes arrived, but no valid frame: check that both sides use {baud} baud, and that the firmware \
             implements this protocol and prints nothing else"
        )
    } else {
        format!(
            "it sends frames but no reply in {secs:.1} s: check its firmware and the wire from the host's TX to its RX"
        )
    };
    DeviceError::new(DeviceErrorKind::Unavailable, format!("no receiver on the serial port `{id}`: {why}"))
}

pub(super) fn lost(id: &str, error: &io::Error) -> DeviceError {
    let message = format!(
        "the serial output `{id}` is lost: {error}; plug it in and open it again, or open another that `shagreen devices` lists"
    );
    DeviceError::new(DeviceErrorKind::Lost, message)
}
