//! Actuators behind a microcontroller on a serial port: USB CDC or a UART.
//!
//! `docs/serial-protocol.md` is the protocol: all that firmware needs to know.

pub mod frame;
pub mod message;
mod outbox;
mod ports;
pub mod receiver;
mod sender;

pub use self::ports::{SerialPortInfo, SerialPortKind, list_serial_ports};
