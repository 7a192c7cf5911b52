//! Inputs of the system's sound: the accelerometer that an actuator is measured with, or a loop back.

use std::cmp::Reverse;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use cpal::traits::{DeviceTrait as _, StreamTrait as _};
use cpal::{FromSample, Sample as _, SampleFormat, SizedSample, StreamConfig, SupportedStreamConfigRange};
use rtrb::{Consumer, Producer, RingBuffer};

use crate::audio::{Listed, Way, devices, explain, find};
use crate::error::{DeviceError, DeviceErrorKind};

/// Samples that can wait to be read: more than two seconds at 192 kHz.
const WAITING: usize = 1 << 19;

/// One input of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputInfo {
    /// Name by which it is opened, the same every time.
    pub id: String,
    /// Name to show.
    pub name: String,
}

/// The inputs of this machine. None is opened.
pub fn list_inputs() -> Vec<InputInfo> {
    devices(Way::In).into_iter().map(|Listed { id, name, .. }| InputInfo { id, name }).collect()
}

/// What the callback tells.
#[derive(Debug)]
struct Told {
    opened: Instant,
    /// When the first sample was taken: nanoseconds after `opened`, the earliest that any block says.
    first_nanos: AtomicI64,
    n_dropped: AtomicU64,
    is_lost: AtomicBool,
}

/// An open input: it records one channel until it is dropped.
pub struct Recorder {
    id: String,
    rate_hz: u32,
    samples: Consumer<f32>,
    told: Arc<Told>,
    _stream: cpal::Stream,
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
    /// Opens input `id` to record channel `channel_idx`, counted from zero, at `preferred_rate_hz` or the rate nearest to it.
    ///
    /// # Errors
    /// - [`DeviceErrorKind::NotFound`] where there is no such input.
    /// - [`DeviceErrorKind::Busy`] or [`DeviceErrorKind::Denied`] where it cannot be had.
    /// - [`DeviceErrorKind::Unsupported`] where it has no such channel.
    /// - [`DeviceErrorKind::Unavailable`] or [`DeviceErrorKind::Backend`] where the system fails.
    pub fn open(id: &str, channel_idx: usize, preferred_rate_hz: u32) -> Result<Self, DeviceError> {
        let device = find(Way::In, id)?;
        let configs: Vec<SupportedStreamConfigRange> = device
            .supported_input_configs()
            .map_err(|error| explain(Way::In, id, "asked what it can do", &error))?
            .collect();
        let Some((range, rate_hz)) = choose(&configs, channel_idx, preferred_rate_hz) else {
            let message = format!(
                "the input `{id}` has no channel {} in a format that can be read; choose another channel or input: \
                 `shagreen devices` lists them",
                channel_idx + 1
            );
            return Err(DeviceError::new(DeviceErrorKind::Unsupported, message));
        };
        let config = StreamConfig {
            channels: range.channels(),
            sample_rate: rate_hz,
            buffer_size: cpal::BufferSize::Default,
        };
        let told = Arc::new(Told {
            opened: Instant::now(),
            first_nanos: AtomicI64::new(i64::MAX),
            n_dropped: AtomicU64::new(0),
            is_lost: AtomicBool::new(false),
        });
        let (producer, samples) = RingBuffer::new(WAITING);
        let intake = Intake { producer, told: Arc::clone(&told), channel_idx, n_taken: 0, config };
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
        Ok(Self { id: id.to_owned(), rate_hz, samples, told, _stream: stream })
    }

    /// Rate of the samples, in Hz.
    pub fn rate_hz(&self) -> u32 {
        self.rate_hz
    }

    /// Appends the samples that wait, -1..1 of the input's full scale, oldest first.
    pub fn read(&mut self, out: &mut Vec<f32>) {
        let n_waiting = self.samples.slots();
        let begin = out.len();
        out.resize(begin + n_waiting, 0.0);
        let n_read = self.samples.pop_partial_slice(&mut out[begin..]).0.len();
        out.truncate(begin + n_read);
    }

    /// When the first sample was taken, as far as the device says; none before the first.
    pub fn first_sample_at(&self) -> Option<Instant> {
        let nanos = self.told.first_nanos.load(Ordering::Relaxed);
        if nanos == i64::MAX {
            return None;
        }
        let offset = Duration::from_nanos(nanos.unsigned_abs());
        // The device may say that it took a sample before it was opened.
        if nanos < 0 { self.told.opened.checked_sub(offset) } else { self.told.opened.checked_add(offset) }
    }

    /// Samples that nobody read in time, and the ring had no room for.
    pub fn n_dropped(&self) -> u64 {
        self.told.n_dropped.load(Ordering::Relaxed)
    }

    /// Whether the input is gone.
    ///
    /// # Errors
    /// - [`DeviceErrorKind::Lost`] where it is, with what to do.
    pub fn check(&self) -> Result<(), DeviceError> {
        if !self.told.is_lost.load(Ordering::Relaxed) {
            return Ok(());
        }
        let message = format!("the input `{}` is lost; plug it in and measure again", self.id);
        Err(DeviceError::new(DeviceErrorKind::Lost, message))
    }
}

/// The kind of stream and the rate to open: fewest channels that hold the wanted one, the rate nearest to the preferred.
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

/// The callback's half.
struct Intake {
    producer: Producer<f32>,
    told: Arc<Told>,
    channel_idx: usize,
    n_taken: u64,
    config: StreamConfig,
}

impl Intake {
    /// Takes a block: never allocates, locks or waits.
    fn take<T: SizedSample>(&mut self, block: &[T], since_capture: Duration)
    where
        f32: FromSample<T>,
    {
        let begun = nanos(self.told.opened.elapsed()) - nanos(since_capture);
        let taken = Duration::from_secs_f64(self.n_taken as f64 / f64::from(self.config.sample_rate.max(1)));
        self.told.first_nanos.fetch_min(begun - nanos(taken), Ordering::Relaxed);
        for frame in block.chunks_exact(usize::from(self.config.channels.max(1))) {
            let Some(sample) = frame.get(self.channel_idx) else { continue };
            if self.producer.push(f32::from_sample(*sample)).is_err() {
                self.told.n_dropped.fetch_add(1, Ordering::Relaxed);
            }
            self.n_taken += 1;
        }
    }
}

/// Nanoseconds of a time that is no more than centuries.
fn nanos(time: Duration) -> i64 {
    i64::try_from(time.as_nanos()).unwrap_or(i64::MAX)
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
            move |error| {
                if matches!(
                    error.kind(),
                    cpal::ErrorKind::DeviceNotAvailable | cpal::ErrorKind::StreamInvalidated
                ) {
                    told.is_lost.store(true, Ordering::Relaxed);
                }
            },
            Some(Duration::from_secs(1)),
        )
        .map_err(|error| explain(Way::In, id, "opened", &error))
}

#[cfg(test)]
mod tests {
    use super::{
        Arc, AtomicBool, AtomicI64, AtomicU64, DeviceErrorKind, Duration, Instant, Intake, Ordering,
        Recorder, RingBuffer, SampleFormat, StreamConfig, SupportedStreamConfigRange, Told, choose,
    };
    use cpal::SupportedBufferSize;

    fn range(channels: u16, low_hz: u32, high_hz: u32, format: SampleFormat) -> SupportedStreamConfigRange {
        SupportedStreamConfigRange::new(channels, low_hz, high_hz, SupportedBufferSize::Unknown, format)
    }

    #[test]
    fn the_channel_and_then_the_rate_decide() {
        let configs = [
            range(1, 8000, 48_000, SampleFormat::I16),
            range(2, 8000, 96_000, SampleFormat::F32),
            range(8, 44_100, 44_100, SampleFormat::I32),
            range(2, 8000, 96_000, SampleFormat::DsdU8),
        ];
        let of = |channel, hz| choose(&configs, channel, hz).map(|(c, hz)| (c.channels(), hz));
        assert_eq!(of(0, 48_000), Some((1, 48_000)));
        assert_eq!(of(1, 48_000), Some((2, 48_000)));
        assert_eq!(of(0, 96_000), Some((2, 96_000)));
        assert_eq!(of(5, 48_000), Some((8, 44_100)));
        assert_eq!(of(8, 48_000), None);
    }

    #[test]
    fn inputs_that_do_not_exist_are_named_with_what_to_do() {
        for id in ["", "nonsense", "alsa:no_such_pcm", "alsa:hw:CARD=0,DEV=0"] {
            let error = Recorder::open(id, 0, 48_000).unwrap_err();
            assert_eq!(error.kind(), DeviceErrorKind::NotFound, "{error}");
            let text = error.to_string();
            assert!(
                text.contains(&format!("the input `{id}`")) || text.contains(&format!("no input `{id}`")),
                "{text}"
            );
        }
    }

    #[test]
    fn takes_its_channel_says_when_and_drops_what_nobody_reads() {
        let told = Arc::new(Told {
            opened: Instant::now(),
            first_nanos: AtomicI64::new(i64::MAX),
            n_dropped: AtomicU64::new(0),
            is_lost: AtomicBool::new(false),
        });
        let (producer, mut samples) = RingBuffer::new(5);
        let config = StreamConfig { channels: 3, sample_rate: 1000, buffer_size: cpal::BufferSize::Default };
        let mut intake = Intake { producer, told: Arc::clone(&told), channel_idx: 1, n_taken: 0, config };
        // Two frames and the beginning of a third.
        intake.take(&[0_i16, 16_384, 0, 0, -16_384, 0, 7], Duration::from_millis(2));
        let first = told.first_nanos.load(Ordering::Relaxed);
        assert!(first < super::nanos(told.opened.elapsed()) - 2_000_000);
        intake.take(&[0.0_f32, 0.25, 0.0].repeat(4), Duration::ZERO);
        let read: Vec<f32> = std::iter::from_fn(|| samples.pop().ok()).collect();
        assert_eq!(read, [0.5, -0.5, 0.25, 0.25, 0.25]);
        assert_eq!(told.n_dropped.load(Ordering::Relaxed), 1);
    }
}
