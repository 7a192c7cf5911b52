//! Audio inputs, for the accelerometer of an actuator measurement or for a loopback.

mod sample_clock;

use std::cmp::Reverse;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use cpal::traits::{DeviceTrait as _, StreamTrait as _};
use cpal::{
    ErrorKind, FromSample, Sample as _, SampleFormat, SizedSample, StreamConfig, SupportedStreamConfigRange,
};
use rtrb::{Consumer, Producer, RingBuffer};
use triple_buffer::triple_buffer;

use crate::audio::{Listed, Way, configs_of, devices, explain, find, list_refused};
use crate::error::{DeviceError, DeviceErrorKind};
#[cfg(target_os = "linux")]
use crate::pulse::PREFIX;
#[cfg(target_os = "linux")]
use crate::pulse::record::{find_monitor, list_monitors};
#[cfg(target_os = "linux")]
use crate::pulse::stream::PulseStream;

use self::sample_clock::{SampleClock, SampleTimes};

/// Capacity in samples of the queue to the reader: more than two seconds at 192 kHz.
const WAITING: usize = 1 << 19;

/// One audio input of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputInfo {
    /// Stable id; opens the input.
    pub id: String,
    /// Display name.
    pub name: String,
    /// Id of the output whose signal it records, for the monitor of an output.
    pub monitor_of: Option<String>,
}

/// Audio inputs of this machine, those of devices first, then the monitors of outputs. None is opened.
pub fn list_inputs() -> Vec<InputInfo> {
    let input = |Listed { id, name, .. }| InputInfo { id, name, monitor_of: None };
    let inputs = devices(Way::In).into_iter().map(input);
    #[cfg(target_os = "linux")]
    let inputs = inputs.chain(list_monitors().into_iter().map(|monitor| InputInfo {
        id: monitor.id,
        name: format!("{} (monitor of {})", monitor.output_name, monitor.output_id),
        monitor_of: Some(monitor.output_id),
    }));
    inputs.collect()
}

/// Inputs of devices in [`list_inputs`] that the system does not open, by id, with the reasons. Each input of a device is
/// queried for its formats, and none records.
pub fn list_refused_inputs() -> Vec<(String, DeviceError)> {
    list_refused(Way::In)
}

/// State that the callbacks report.
#[derive(Debug, Default)]
struct Told {
    has_begun: AtomicBool,
    n_dropped: AtomicU64,
    is_lost: AtomicBool,
}

impl Told {
    /// Records an error that the system reports for the open stream.
    fn note_error(&self, kind: ErrorKind) {
        match kind {
            ErrorKind::DeviceNotAvailable
            | ErrorKind::DeviceChanged
            | ErrorKind::HostUnavailable
            | ErrorKind::PermissionDenied
            | ErrorKind::StreamInvalidated => self.is_lost.store(true, Ordering::Relaxed),
            // The stream records without real-time priority.
            ErrorKind::RealtimeDenied => {}
            // Errors before the first sample are ignored: some devices report errors when they start, and nothing is
            // missing.
            _ => {
                if self.has_begun.load(Ordering::Relaxed) {
                    self.n_dropped.fetch_add(1, Ordering::Relaxed);
                }
            }
        }
    }
}

/// An open audio input that records one channel until it is dropped.
pub struct Recorder {
    id: String,
    rate_hz: u32,
    samples: Consumer<f32>,
    told: Arc<Told>,
    opened: Instant,
    /// Times in seconds since `opened`.
    times: triple_buffer::Output<Option<SampleTimes>>,
    _stream: Stream,
}

/// The stream of the system, which ends when it is dropped.
enum Stream {
    Device(#[expect(dead_code, reason = "kept until the recorder is dropped")] cpal::Stream),
    #[cfg(target_os = "linux")]
    Monitor(#[expect(dead_code, reason = "kept until the recorder is dropped")] PulseStream),
}

impl std::fmt::Debug for Recorder {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Recorder")
            .field("id", &self.id)
            .field("rate_hz", &self.rate_hz)
            .finish_non_exhaustive()
    }
}

impl Recorder {
    /// Opens input `id` to record channel `channel_idx` (counted from zero) at the supported rate closest to
    /// `preferred_rate_hz`.
    ///
    /// # Errors
    /// - [`DeviceErrorKind::NotFound`] if there is no such input.
    /// - [`DeviceErrorKind::Busy`] or [`DeviceErrorKind::Denied`] if it is in use or access is refused.
    /// - [`DeviceErrorKind::Unsupported`] if it has no such channel in a readable format.
    /// - [`DeviceErrorKind::Unavailable`] or [`DeviceErrorKind::Backend`] if the system fails.
    pub fn open(id: &str, channel_idx: usize, preferred_rate_hz: u32) -> Result<Self, DeviceError> {
        #[cfg(target_os = "linux")]
        if id.starts_with(PREFIX) {
            return Self::open_monitor(id, channel_idx);
        }
        let device = find(Way::In, id)?;
        let configs = configs_of(Way::In, id, &device)?;
        let Some((range, rate_hz)) = choose(&configs, channel_idx, preferred_rate_hz) else {
            return Err(no_channel(id, channel_idx));
        };
        let config = StreamConfig {
            channels: range.channels(),
            sample_rate: rate_hz,
            buffer_size: cpal::BufferSize::Default,
        };
        let (intake, reader) = Reader::new(config, channel_idx);
        let stream = match range.sample_format() {
            SampleFormat::F64 => build::<f64>(id, &device, intake),
            SampleFormat::I32 => build::<i32>(id, &device, intake),
            SampleFormat::I24 => build::<cpal::I24>(id, &device, intake),
            SampleFormat::I16 => build::<i16>(id, &device, intake),
            SampleFormat::U16 => build::<u16>(id, &device, intake),
            SampleFormat::U8 => build::<u8>(id, &device, intake),
            _ => build::<f32>(id, &device, intake),
        }?;
        stream.play().map_err(|error| explain(Way::In, id, "started", &error))?;
        Ok(reader.with(id, rate_hz, Stream::Device(stream)))
    }

    /// Opens the monitor of an output at the rate of the output.
    #[cfg(target_os = "linux")]
    fn open_monitor(id: &str, channel_idx: usize) -> Result<Self, DeviceError> {
        let monitor = find_monitor(id)?;
        let (n_channels, rate_hz) = (monitor.channels(), monitor.rate_hz());
        if channel_idx >= usize::from(n_channels) {
            return Err(no_channel(id, channel_idx));
        }
        let config = StreamConfig {
            channels: u16::from(n_channels),
            sample_rate: rate_hz,
            buffer_size: cpal::BufferSize::Default,
        };
        let (mut intake, reader) = Reader::new(config, channel_idx);
        let samples_per_sec = f64::from(n_channels) * f64::from(rate_hz);
        // The last sample of a block is recorded when the block is sent.
        let take = move |block: &[f32]| {
            intake.take(block, Duration::from_secs_f64(block.len() as f64 / samples_per_sec.max(1.0)));
        };
        let told_of_loss = Arc::clone(&reader.told);
        let input = monitor.start(take, move || told_of_loss.is_lost.store(true, Ordering::Relaxed))?;
        Ok(reader.with(id, rate_hz, Stream::Monitor(input)))
    }

    /// Sample rate, in Hz.
    pub fn rate_hz(&self) -> u32 {
        self.rate_hz
    }

    /// Appends all queued samples, -1..1 of the input's full scale, oldest first.
    pub fn read(&mut self, out: &mut Vec<f32>) {
        let n_waiting = self.samples.slots();
        let begin = out.len();
        out.resize(begin + n_waiting, 0.0);
        let n_read = self.samples.pop_partial_slice(&mut out[begin..]).0.len();
        out.truncate(begin + n_read);
    }

    /// Returns the fractional number of samples recorded before a time; negative before the first sample, `None` before
    /// any sample is recorded.
    ///
    /// The value comes from a line fitted to the earliest callback time of each second of device time, so that it
    /// follows clock drift over long recordings. If callbacks are late by about 1 ms, the error is a few hundredths of
    /// a millisecond. A delay that all callbacks share is not detected.
    pub fn sample_index_at(&mut self, time: Instant) -> Option<f64> {
        let since = time.saturating_duration_since(self.opened).as_secs_f64();
        let before = self.opened.saturating_duration_since(time).as_secs_f64();
        Some(self.times.read().as_ref()?.index_at(since - before, f64::from(self.rate_hz)))
    }

    /// Number of losses: samples that were not read in time, and stream errors, each of which may have lost samples.
    pub fn n_dropped(&self) -> u64 {
        self.told.n_dropped.load(Ordering::Relaxed)
    }

    /// Checks that the input is still connected and that no samples are missing.
    ///
    /// # Errors
    /// - [`DeviceErrorKind::Lost`] if it is disconnected; the message says what to do.
    /// - [`DeviceErrorKind::Backend`] if samples are missing.
    pub fn check(&self) -> Result<(), DeviceError> {
        if self.told.is_lost.load(Ordering::Relaxed) {
            let message = format!("the input `{}` is disconnected; plug it in and measure again", self.id);
            return Err(DeviceError::new(DeviceErrorKind::Lost, message));
        }
        let n_dropped = self.n_dropped();
        if n_dropped > 0 {
            let message = format!(
                "samples of the input `{}` were lost during the measurement ({n_dropped} losses); close other programs \
                 and measure again",
                self.id
            );
            return Err(DeviceError::new(DeviceErrorKind::Backend, message));
        }
        Ok(())
    }
}

/// Side of a recorder that the caller reads.
struct Reader {
    samples: Consumer<f32>,
    told: Arc<Told>,
    opened: Instant,
    times: triple_buffer::Output<Option<SampleTimes>>,
}

impl Reader {
    /// Returns both sides of a recorder.
    fn new(config: StreamConfig, channel_idx: usize) -> (Intake, Self) {
        let told = Arc::new(Told::default());
        let opened = Instant::now();
        let (producer, samples) = RingBuffer::new(WAITING);
        let (times_in, times) = triple_buffer(&None);
        let intake = Intake::new(config, channel_idx, opened, producer, Arc::clone(&told), times_in);
        (intake, Self { samples, told, opened, times })
    }

    /// Returns the recorder of an open stream.
    fn with(self, id: &str, rate_hz: u32, stream: Stream) -> Recorder {
        let Self { samples, told, opened, times } = self;
        Recorder { id: id.to_owned(), rate_hz, samples, told, opened, times, _stream: stream }
    }
}

fn no_channel(id: &str, channel_idx: usize) -> DeviceError {
    let message = format!(
        "the input `{id}` has no channel {} in a readable format; choose another channel, or an input that \
         `shagreen devices` lists",
        channel_idx + 1
    );
    DeviceError::new(DeviceErrorKind::Unsupported, message)
}

/// Returns the stream format and the rate to open. The criteria, in order: a readable format with the wanted channel,
/// the rate closest to the preferred one, the fewest channels, the best sample format.
fn choose(
    configs: &[SupportedStreamConfigRange],
    channel_idx: usize,
    preferred_rate_hz: u32,
) -> Option<(SupportedStreamConfigRange, u32)> {
    let can_be_read = |format| {
        matches!(
            format,
            SampleFormat::F32
                | SampleFormat::F64
                | SampleFormat::I32
                | SampleFormat::I24
                | SampleFormat::I16
                | SampleFormat::U16
                | SampleFormat::U8
        )
    };
    configs
        .iter()
        .filter(|c| usize::from(c.channels()) > channel_idx && can_be_read(c.sample_format()))
        .map(|c| (*c, preferred_rate_hz.clamp(c.min_sample_rate(), c.max_sample_rate())))
        .min_by_key(|(c, rate_hz)| {
            let is_float = c.sample_format() == SampleFormat::F32;
            (
                rate_hz.abs_diff(preferred_rate_hz),
                c.channels(),
                !is_float,
                Reverse(c.sample_format().sample_size()),
            )
        })
}

/// Callback side of a recorder.
struct Intake {
    producer: Producer<f32>,
    told: Arc<Told>,
    channel_idx: usize,
    n_taken: u64,
    config: StreamConfig,
    opened: Instant,
    clock: SampleClock,
    times: triple_buffer::Input<Option<SampleTimes>>,
}

impl Intake {
    fn new(
        config: StreamConfig,
        channel_idx: usize,
        opened: Instant,
        producer: Producer<f32>,
        told: Arc<Told>,
        times: triple_buffer::Input<Option<SampleTimes>>,
    ) -> Self {
        let clock = SampleClock::new(f64::from(config.sample_rate.max(1)));
        Self { producer, told, channel_idx, n_taken: 0, config, opened, clock, times }
    }

    /// Takes a block of interleaved frames. It never allocates, locks or waits.
    fn take<T: SizedSample>(&mut self, block: &[T], since_capture: Duration)
    where
        f32: FromSample<T>,
    {
        self.clock.note(self.n_taken, self.opened.elapsed().as_secs_f64() - since_capture.as_secs_f64());
        self.times.write(self.clock.times());
        self.told.has_begun.store(true, Ordering::Relaxed);
        for frame in block.chunks_exact(usize::from(self.config.channels.max(1))) {
            let Some(sample) = frame.get(self.channel_idx) else { continue };
            if self.producer.push(f32::from_sample(*sample)).is_err() {
                self.told.n_dropped.fetch_add(1, Ordering::Relaxed);
            }
            self.n_taken += 1;
        }
    }
}

fn build<T: SizedSample>(
    id: &str,
    device: &cpal::Device,
    mut intake: Intake,
) -> Result<cpal::Stream, DeviceError>
where
    f32: FromSample<T>,
{
    let told = Arc::clone(&intake.told);
    device
        .build_input_stream::<T, _, _>(
            intake.config,
            move |block, info| {
                let times = info.timestamp();
                intake.take(block, times.callback.duration_since(times.capture));
            },
            move |error| told.note_error(error.kind()),
            Some(Duration::from_secs(1)),
        )
        .map_err(|error| explain(Way::In, id, "opened", &error))
}

#[cfg(test)]
mod tests;
