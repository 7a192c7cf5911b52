//! Accelerometer of a serial receiver, as the sensor of a measurement.

use rtrb::Consumer;

use super::ReceiverEvent;
use crate::error::{DeviceError, DeviceErrorKind};
use crate::sensor::Sensor;

/// Accelerometer of a serial receiver.
#[derive(Debug)]
pub struct SerialSensor {
    heard: Consumer<ReceiverEvent>,
    rate_hz: f64,
    next_seq: Option<u16>,
    n_lost: u64,
}

impl SerialSensor {
    /// A sensor that reads a connection's messages: [`super::Connection::heard`].
    pub fn new(heard: Consumer<ReceiverEvent>) -> Self {
        Self { heard, rate_hz: 0.0, next_seq: None, n_lost: 0 }
    }
}

impl Sensor for SerialSensor {
    /// Sample rate in Hz; zero before the first block.
    fn rate_hz(&self) -> f64 {
        self.rate_hz
    }

    /// Appends samples in m/s², converted with the receiver's scale. Each lost sample is replaced by the last one
    /// before it, so that later samples keep their time; [`Sensor::check`] reports the loss.
    fn read(&mut self, out: &mut Vec<f32>) {
        while let Ok(heard) = self.heard.pop() {
            let ReceiverEvent::Sensor(block) = heard else { continue };
            if let Some(next_seq) = self.next_seq {
                let n_lost = block.seq.wrapping_sub(next_seq);
                self.n_lost += u64::from(n_lost);
                let last = out.last().copied().unwrap_or_default();
                out.extend(std::iter::repeat_n(last, usize::from(n_lost)));
            }
            self.rate_hz = f64::from(block.rate_hz);
            out.extend(block.counts.iter().map(|count| (block.scale_mps2 * f64::from(*count)) as f32));
            self.next_seq = Some(block.seq.wrapping_add(block.counts.len() as u16));
        }
    }

    fn check(&self) -> Result<(), DeviceError> {
        if self.heard.is_abandoned() {
            let message = "the receiver with the sensor is disconnected; connect it and measure again";
            return Err(DeviceError::new(DeviceErrorKind::Lost, message));
        }
        if self.n_lost > 0 {
            let message = format!(
                "{} samples of the sensor were lost on the serial line; use a higher baud rate or a shorter cable, and measure again",
                self.n_lost
            );
            return Err(DeviceError::new(DeviceErrorKind::Backend, message));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{ReceiverEvent, Sensor as _, SerialSensor};
    use crate::serial::SensorBlock;
    use rtrb::RingBuffer;

    fn block(seq: u16, counts: &[i16]) -> ReceiverEvent {
        ReceiverEvent::Sensor(SensorBlock {
            seq,
            rate_hz: 3200,
            time_us: 0,
            scale_mps2: 0.5,
            counts: counts.to_vec(),
        })
    }

    #[test]
    fn counts_become_accelerations_in_their_time_and_losses_are_said() {
        let (mut told, heard) = RingBuffer::new(8);
        let mut sensor = SerialSensor::new(heard);
        told.push(block(65_534, &[2, 4, 6])).unwrap();
        told.push(ReceiverEvent::Warning("warm".into())).unwrap();
        told.push(block(1, &[8])).unwrap();
        let mut samples = Vec::new();
        sensor.read(&mut samples);
        assert_eq!(samples, [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(sensor.rate_hz(), 3200.0);
        sensor.check().unwrap();
        told.push(block(4, &[-2])).unwrap();
        sensor.read(&mut samples);
        assert_eq!(samples[4..], [4.0, 4.0, -1.0]);
        assert!(sensor.check().unwrap_err().message().contains("2 samples"));
        drop(told);
        assert!(sensor.check().unwrap_err().message().contains("disconnected"));
    }
}
