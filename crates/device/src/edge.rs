//! Adapter between a device callback and the engine: time stamps, load measurement, and sample format conversion.

use std::sync::Arc;
use std::time::{Duration, Instant};

use cpal::{FromSample, Sample};

use crate::engine::{CallbackAdapter, Engine};
use crate::link::Shared;

/// Samples converted at a time; at least one frame of the largest channel count of any device.
const SCRATCH: usize = 1024;
/// Upper limit for the latency that a device reports.
const MAX_LATENCY: Duration = Duration::from_secs(10);
/// Time constant of the displayed load, in seconds.
const LOAD_SECS: f64 = 0.5;

/// An engine driven by a device callback.
#[derive(Debug)]
pub(crate) struct Edge {
    engine: Engine,
    shared: Arc<Shared>,
    rate_hz: f64,
    load: f64,
    load_max: f64,
    scratch: [f32; SCRATCH],
}

impl Edge {
    pub(crate) fn new(engine: Engine, shared: Arc<Shared>, rate_hz: f64) -> Self {
        Self { engine, shared, rate_hz, load: 0.0, load_max: 0.0, scratch: [0.0; SCRATCH] }
    }

    /// Body of the audio callback: fills `out` with interleaved frames of `channels` samples that will be played after
    /// `device_latency`, and measures the time it takes.
    ///
    /// It reads the clock twice and does nothing else that could wait.
    pub(crate) fn fill<T: Sample + FromSample<f32>>(
        &mut self,
        out: &mut [T],
        channels: usize,
        device_latency: Duration,
    ) {
        let begun = Instant::now();
        let channels = channels.max(1);
        // A device that reconnects by itself stays silent until a person opens it again.
        if self.shared.is_lost() {
            out.fill(T::EQUILIBRIUM);
            return;
        }
        self.shared.note_callback(begun);
        let edge = CallbackAdapter {
            now: begun,
            load: self.load as f32,
            load_max: self.load_max as f32,
            device_latency_secs: device_latency.as_secs_f32(),
        };
        self.engine.begin_block(edge);
        let block = Duration::from_secs_f64((out.len() / channels) as f64 / self.rate_hz.max(1.0));
        // Published before the engine's status, so that whoever sees that frames were rendered also finds their end
        // time.
        self.shared.note_heard_by(begun + device_latency.min(MAX_LATENCY) + block);
        let at_once = (SCRATCH / channels).max(1) * channels;
        for part in out.chunks_mut(at_once.min(SCRATCH)) {
            let Some(scratch) = self.scratch.get_mut(..part.len()) else { break };
            self.engine.process(scratch, channels);
            for (out, &sample) in part.iter_mut().zip(scratch.iter()) {
                *out = T::from_sample(sample);
            }
        }
        self.note_load(begun.elapsed().as_secs_f64(), (out.len() / channels) as f64 / self.rate_hz);
    }

    /// Returns the engine in its state after the last block.
    pub(crate) fn engine(&self) -> &Engine {
        &self.engine
    }

    fn note_load(&mut self, used_secs: f64, allotted_secs: f64) {
        if allotted_secs > 0.0 {
            let load = used_secs / allotted_secs;
            self.load += (allotted_secs / LOAD_SECS).min(1.0) * (load - self.load);
            self.load_max = self.load_max.max(load);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Edge;
    use crate::controls::{Drive, Input};
    use crate::engine::{self, ChannelMask, EngineConfig};
    use crate::error::{DeviceError, DeviceErrorKind};
    use crate::hand::{Hand, Path};
    use crate::link::{Reporter, link};
    use crate::texture::tests::white;
    use crate::touch::Touch;
    use cpal::{FromSample, Sample};
    use shagreen_synth::contact::Contact;
    use shagreen_synth::drive::DriveConfig;
    use shagreen_synth::renderer::Mix;
    use std::time::{Duration, Instant};

    const HAND: Hand = Hand { path: Path::Circle, speed_mps: 0.5, force_n: 0.5, extent_m: 0.06 };

    fn edge() -> (engine::Handle, Edge, Reporter) {
        let config = EngineConfig {
            model_rate_hz: 1000.0,
            device_rate_hz: 48_000.0,
            seed: 3,
            drive: DriveConfig::proportional(2.0, 1.0),
            channels: ChannelMask::FIRST_TWO,
            friction: None,
        };
        let (mut handle, engine) = engine::new(config).unwrap();
        let (reporter, monitor) = link();
        handle.watch(monitor);
        let id = handle.load(white(1.0)).unwrap();
        handle.set_mix(Mix::solo(id)).unwrap();
        handle.set_input(Input::Hand(HAND));
        let edge = Edge::new(engine, reporter.shared.clone(), 48_000.0);
        (handle, edge, reporter)
    }

    fn played<T: Sample + FromSample<f32>>(channels: usize, block: usize) -> Vec<T> {
        let (_handle, mut edge, _reporter) = edge();
        let mut out = vec![T::from_sample(0.7_f32); 9600 * channels];
        for part in out.chunks_mut(block * channels) {
            edge.fill(part, channels, Duration::ZERO);
        }
        out
    }

    #[test]
    fn every_format_carries_the_same_signal() {
        let floats = played::<f32>(2, 480);
        assert!(floats.iter().any(|x| x.abs() > 0.1));
        for (x, y) in floats.iter().zip(played::<i16>(2, 480)) {
            assert!((x * 32_768.0 - f32::from(y)).abs() <= 1.0);
        }
        for (x, y) in floats.iter().zip(played::<u16>(2, 480)) {
            assert!((x * 32_768.0 + 32_768.0 - f32::from(y)).abs() <= 1.0);
        }
        for (x, y) in floats.iter().zip(played::<i32>(2, 480)) {
            assert!((f64::from(*x) * 2_147_483_648.0 - f64::from(y)).abs() <= 256.0);
        }
    }

    #[test]
    fn channels_and_blocks_do_not_change_the_signal() {
        let stereo = played::<f32>(2, 480);
        for channels in [1, 2, 3, 64, 600] {
            for block in [1, 256, 1000, 9600] {
                let out = played::<f32>(channels, block);
                for (frame, expected) in out.chunks(channels).zip(stereo.chunks(2)) {
                    assert!(
                        frame.iter().enumerate().all(|(c, &x)| x == if c < 2 { expected[0] } else { 0.0 })
                    );
                }
            }
        }
    }

    #[test]
    fn load_is_measured_and_shown() {
        let (mut handle, mut edge, _reporter) = edge();
        for _ in 0..100 {
            edge.fill(&mut [0.0_f32; 512], 2, Duration::ZERO);
        }
        let status = handle.status();
        assert!(status.load > 0.0 && status.load_max >= status.load, "{} {}", status.load, status.load_max);
        assert_eq!(status.frames_played, 25_600);
        let mut edge = edge;
        edge.note_load(3.0, 1.0);
        edge.fill(&mut [0.0_f32; 512], 2, Duration::ZERO);
        assert!(handle.status().load_max >= 3.0);
    }

    #[test]
    fn touches_age_on_their_way() {
        let live_speed = |time: Instant| {
            let (mut handle, mut edge, _reporter) = edge();
            handle.set_input(Input::Live);
            let mut live = handle.take_live_input().unwrap();
            let touch = Touch { contact: Contact { speed_mps: 0.4, force_n: 0.5 }, ..Touch::default() };
            edge.fill(&mut vec![0.0_f32; 4800], 2, Duration::ZERO);
            live.send(touch, time).unwrap();
            edge.fill(&mut vec![0.0_f32; 480], 2, Duration::ZERO);
            handle.status().touch.contact.speed_mps
        };
        // A time in the future has no age, however busy the machine is.
        assert_eq!(live_speed(Instant::now() + Duration::from_mins(1)), 0.4);
        // One second is much longer than hold and decay.
        assert!(live_speed(Instant::now().checked_sub(Duration::from_secs(1)).unwrap()) < 1e-9);
    }

    #[test]
    fn a_lost_device_that_comes_back_is_silent() {
        let (mut handle, mut edge, mut reporter) = edge();
        reporter.lose(DeviceError::new(DeviceErrorKind::Lost, "pulled out"));
        let mut out = [1_u16; 4096];
        edge.fill(&mut out, 2, Duration::ZERO);
        assert_eq!(out, [32_768; 4096]);
        assert_eq!(handle.loss().unwrap().message(), "pulled out");
        handle.set_drive(Drive::default());
        assert_eq!(handle.status().frames_played, 0);
    }
}
