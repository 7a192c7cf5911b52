//! Thread between the engine and a serial line.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use rtrb::{Consumer, Producer, RingBuffer};

use crate::edge::Edge;
use crate::engine::Engine;
use crate::error::{DeviceError, DeviceErrorKind};
use crate::link::Reporter;
use crate::serial::handshake::lost;
use crate::serial::line::Line;
use crate::serial::message::{Control, DeviceMessage, MAX_FAULT, MAX_SENSOR_SAMPLES, NO_TEXTURE};
use crate::serial::sender::{Counts, Plan, Sender, Source};
use crate::serial::write_queue::WriteQueue;
use crate::urgency::run_before_others;

/// Capacity of the queue of messages: four seconds of a sensor at 3.2 kHz.
const HEARD: usize = 128;

/// Message of a receiver that does not concern the stream.
#[derive(Clone, Debug, PartialEq)]
pub enum ReceiverEvent {
    /// Accelerometer samples.
    Sensor(SensorBlock),
    /// A fault of the receiver, which continues.
    Warning(String),
}

/// A block of accelerometer samples of a receiver.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorBlock {
    /// Index of the first sample, modulo 65536; a gap between two blocks is a loss.
    pub seq: u16,
    /// Sample rate, in Hz.
    pub rate_hz: u16,
    /// Time of the first sample, in µs of the receiver's clock, modulo 2³².
    pub time_us: u32,
    /// Acceleration per count, in m/s².
    pub scale_mps2: f64,
    /// Samples, in counts.
    pub counts: Vec<i16>,
}

/// A thread that plays to a receiver until it is dropped.
#[derive(Debug)]
pub(crate) struct SerialOutput {
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl SerialOutput {
    /// Starts playback.
    pub(super) fn start(
        id: &str,
        line: Line,
        plan: Plan,
        engine: Engine,
        reporter: Reporter,
        line_latency: Duration,
    ) -> Result<(Self, Consumer<ReceiverEvent>), DeviceError> {
        let stop = Arc::new(AtomicBool::new(false));
        let (heard_in, heard_out) = RingBuffer::new(HEARD);
        let edge = Edge::new(engine, Arc::clone(&reporter.shared), f64::from(plan.configure.rate_hz));
        let edge = LineEdge { edge, line_latency };
        let mut player = Player {
            id: id.to_owned(),
            line,
            edge,
            reporter,
            heard: heard_in,
            counts: Counts::default(),
            outbox: WriteQueue::new(),
        };
        let stopped = Arc::clone(&stop);
        let thread = std::thread::Builder::new()
            .name("serial output".into())
            .spawn(move || {
                run_before_others();
                player.play(plan, &stopped);
            })
            .map_err(|error| {
                let message =
                    format!("the serial output cannot start: the system cannot start a thread ({error})");
                DeviceError::new(DeviceErrorKind::Backend, message)
            })?;
        Ok((Self { stop, thread: Some(thread) }, heard_out))
    }
}

impl Drop for SerialOutput {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            thread.join().ok(); // A panic of the thread has been printed already.
        }
    }
}

struct Player {
    id: String,
    line: Line,
    edge: LineEdge,
    reporter: Reporter,
    heard: Producer<ReceiverEvent>,
    counts: Counts,
    outbox: WriteQueue,
}

impl Player {
    /// Plays until it is stopped or the port is lost. A lost port stays silent and is not reopened.
    fn play(&mut self, plan: Plan, stop: &AtomicBool) {
        let begun = Instant::now();
        let mut sender = Sender::new(plan, Duration::ZERO);
        let mut bytes = [0; 1024];
        while !stop.load(Ordering::Relaxed) {
            let n = match self.line.read(&mut bytes) {
                Ok(n) => n,
                Err(error) => return self.reporter.lose(lost(&self.id, &error)),
            };
            let now = begun.elapsed();
            let (heard, id) = (&mut self.heard, &self.id);
            let mut end = None;
            sender.receive(&bytes[..n], now, &mut |message| end = end.take().or(hear(id, message, heard)));
            if let Some(end) = end {
                return self.reporter.lose(end);
            }
            sender.poll(now, &mut self.edge, &mut self.outbox);
            self.note(sender.counts());
            let line = &mut self.line;
            if let Err(error) = self.outbox.flush(now, &mut |bytes| line.write(bytes)) {
                return self.reporter.lose(lost(&self.id, &error));
            }
        }
        // If this stop message is lost, the receiver's watchdog silences it.
        Sender::say_goodbye(&mut self.outbox);
        let line = &mut self.line;
        let _ = self.outbox.flush(begun.elapsed(), &mut |bytes| line.write(bytes));
    }

    fn note(&mut self, counts: Counts) {
        let shared = &self.reporter.shared;
        shared.note_underruns(counts.underruns - self.counts.underruns);
        shared.note_errors(counts.bad_frames - self.counts.bad_frames);
        self.counts = counts;
    }
}

/// Queues messages that do not concern the stream. Returns the error if the message ends the output.
fn hear(id: &str, message: DeviceMessage<'_>, heard: &mut Producer<ReceiverEvent>) -> Option<DeviceError> {
    let told = match message {
        DeviceMessage::Sensor { seq, rate_hz, time_us, scale_umps2, samples } => {
            ReceiverEvent::Sensor(SensorBlock {
                seq,
                rate_hz,
                time_us,
                scale_mps2: 1e-6 * f64::from(scale_umps2),
                counts: samples.iter().take(MAX_SENSOR_SAMPLES).collect(),
            })
        }
        DeviceMessage::Fault { has_stopped, text } => {
            let text = String::from_utf8_lossy(&text[..text.len().min(MAX_FAULT)]).into_owned();
            if has_stopped {
                let message =
                    format!("the receiver on `{id}` has stopped: {text}; fix this and open the output again");
                return Some(DeviceError::new(DeviceErrorKind::Lost, message));
            }
            ReceiverEvent::Warning(text)
        }
        DeviceMessage::HelloReply(_) | DeviceMessage::Status(_) => return None,
    };
    heard.push(told).ok(); // Full: the newest messages are dropped.
    None
}

/// An engine adapter with the latency of its serial line.
struct LineEdge {
    edge: Edge,
    /// Latency of the line and the receiver's queue.
    line_latency: Duration,
}

impl Source for LineEdge {
    fn render(&mut self, out: &mut [i16]) {
        self.edge.fill(out, 1, self.line_latency);
    }

    fn control(&self) -> Control {
        let (touch, texture, gain) = self.edge.engine().now();
        let contact = touch.contact.sanitized();
        Control {
            speed_dmmps: (1e4_f32 * contact.speed_mps).round() as u16,
            force_mn: (1e3_f32 * contact.force_n).round() as u16,
            texture: texture.unwrap_or(NO_TEXTURE),
            gain_permille: (1e3 * gain).round() as u16,
        }
    }
}

#[cfg(all(test, unix))]
mod tests;
