//! Tests of choosing, opening and reading an input.

use super::{
    Arc, DeviceErrorKind, Duration, ErrorKind, Instant, Intake, Ordering, Recorder, RingBuffer, SampleFormat,
    StreamConfig, SupportedStreamConfigRange, Told, choose, list_inputs, list_refused_inputs, triple_buffer,
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
fn an_input_that_is_refused_cannot_be_opened_either() {
    let listed = list_inputs();
    for (id, error) in list_refused_inputs() {
        assert!(error.message().contains(&format!("the input `{id}`")), "{error}");
        assert!(listed.iter().any(|input| input.id == id && input.monitor_of.is_none()), "{id}");
        assert!(Recorder::open(&id, 0, 48_000).is_err(), "{id}");
    }
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
    let told = Arc::new(Told::default());
    let (producer, mut samples) = RingBuffer::new(5);
    let config = StreamConfig { channels: 3, sample_rate: 1000, buffer_size: cpal::BufferSize::Default };
    let (times_in, mut times) = triple_buffer(&None);
    let opened = Instant::now();
    let mut intake = Intake::new(config, 1, opened, producer, Arc::clone(&told), times_in);
    // The block has two complete frames and the start of a third.
    intake.take(&[0_i16, 16_384, 0, 0, -16_384, 0, 7], Duration::from_millis(2));
    let first_secs = times.read().unwrap().first_secs;
    assert!((-0.002..opened.elapsed().as_secs_f64() - 0.002).contains(&first_secs), "{first_secs}");
    intake.take(&[0.0_f32, 0.25, 0.0].repeat(4), Duration::ZERO);
    let read: Vec<f32> = std::iter::from_fn(|| samples.pop().ok()).collect();
    assert_eq!(read, [0.5, -0.5, 0.25, 0.25, 0.25]);
    assert_eq!(told.n_dropped.load(Ordering::Relaxed), 1);
}

#[test]
fn what_the_stream_reports_is_counted_once_there_is_something_to_miss() {
    let told = Told::default();
    let n_dropped = || told.n_dropped.load(Ordering::Relaxed);
    told.note_error(ErrorKind::Xrun);
    assert_eq!(n_dropped(), 0);
    told.has_begun.store(true, Ordering::Relaxed);
    told.note_error(ErrorKind::RealtimeDenied);
    assert_eq!(n_dropped(), 0);
    told.note_error(ErrorKind::Xrun);
    told.note_error(ErrorKind::Other);
    assert_eq!((n_dropped(), told.is_lost.load(Ordering::Relaxed)), (2, false));
    for kind in [ErrorKind::DeviceNotAvailable, ErrorKind::DeviceChanged, ErrorKind::StreamInvalidated] {
        let told = Told::default();
        told.note_error(kind);
        assert!(told.is_lost.load(Ordering::Relaxed), "{kind:?}");
    }
}
