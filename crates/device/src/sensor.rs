//! Source of a measurement's recording: an audio input or a sensor on a serial port.

use crate::error::DeviceError;

/// A recording source that produces samples continuously.
pub trait Sensor {
    /// Sample rate, in Hz.
    fn rate_hz(&self) -> f64;

    /// Appends the samples since the last call.
    fn read(&mut self, out: &mut Vec<f32>);

    /// Checks that the source is still recording and that no samples are missing.
    ///
    /// # Errors
    /// The error says what is wrong and what to do.
    fn check(&self) -> Result<(), DeviceError>;
}
