//! Silent output that runs on a real clock, for work without an actuator and for tests.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use crate::edge::Edge;
use crate::engine::Engine;
use crate::error::{DeviceError, DeviceErrorKind};
use crate::link::{Reporter, Shared};
use crate::urgency::run_before_others;

/// Number of channels of the silent output.
pub(crate) const CHANNELS: u16 = 2;
/// Delay behind the clock above which the computer is assumed to have been suspended. The missed time is skipped and
/// counted as one underrun.
const SUSPENDED: Duration = Duration::from_secs(1);

/// A thread that requests samples from the engine like a device.
#[derive(Debug)]
pub(crate) struct NullOutput {
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl NullOutput {
    /// Starts playback in blocks of `frames`.
    pub(crate) fn start(
        engine: Engine,
        reporter: &Reporter,
        rate_hz: u32,
        frames: u32,
        tap: impl FnMut(&[f32]) + Send + 'static,
    ) -> Result<Self, DeviceError> {
        let stop = Arc::new(AtomicBool::new(false));
        let shared = Arc::clone(&reporter.shared);
        let edge = Edge::new(engine, Arc::clone(&shared), f64::from(rate_hz));
        let stopped = Arc::clone(&stop);
        let clock = Clock { begun: Instant::now(), rate_hz, block_frames: frames, blocks_done: 0 };
        let thread = std::thread::Builder::new()
            .name("null output".into())
            .spawn(move || {
                run_before_others();
                play(edge, clock, &shared, &stopped, tap);
            })
            .map_err(|error| {
                let message =
                    format!("the silent output cannot start: the system cannot start a thread ({error})");
                DeviceError::new(DeviceErrorKind::Backend, message)
            })?;
        Ok(Self { stop, thread: Some(thread) })
    }
}

impl Drop for NullOutput {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            thread.thread().unpark();
            thread.join().ok(); // The panic of a tap has been printed already.
        }
    }
}

/// Clock of the blocks. Due times count from the start, so that delays do not accumulate.
struct Clock {
    begun: Instant,
    rate_hz: u32,
    block_frames: u32,
    blocks_done: u64,
}

impl Clock {
    /// Time from the start until block `block_idx` is due.
    fn due(&self, block_idx: u64) -> Duration {
        let nanos =
            u128::from(block_idx) * u128::from(self.block_frames) * 1_000_000_000 / u128::from(self.rate_hz);
        Duration::from_nanos(nanos as u64)
    }

    /// Time until the next block is due; `None` if it is due already.
    fn wait(&self, now: Instant) -> Option<Duration> {
        let wait = self.due(self.blocks_done).saturating_sub(now.saturating_duration_since(self.begun));
        (!wait.is_zero()).then_some(wait)
    }

    /// Restarts the clock after a suspension. Returns whether there was one.
    fn skip_suspension(&mut self, now: Instant) -> bool {
        let behind = now.saturating_duration_since(self.begun).saturating_sub(self.due(self.blocks_done));
        let was_suspended = behind > SUSPENDED;
        if was_suspended {
            (self.begun, self.blocks_done) = (now, 0);
        }
        was_suspended
    }
}

fn play(mut edge: Edge, mut clock: Clock, shared: &Shared, stop: &AtomicBool, mut tap: impl FnMut(&[f32])) {
    let channels = usize::from(CHANNELS);
    let mut block = vec![0.0_f32; clock.block_frames as usize * channels];
    while !stop.load(Ordering::Relaxed) {
        let now = Instant::now();
        if clock.skip_suspension(now) {
            shared.note_underrun();
        }
        if let Some(wait) = clock.wait(now) {
            std::thread::park_timeout(wait);
            continue;
        }
        // A block is due at the moment of its playback, so its latency is zero.
        edge.fill(&mut block, channels, Duration::ZERO);
        tap(&block);
        clock.blocks_done += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::{Clock, Duration, Instant};
    use crate::controls::Input;
    use crate::engine::ChannelMask;
    use crate::hand::{Hand, Path};
    use crate::output::{OpenOptions, open_null_with_tap};
    use crate::status::LinkState;
    use crate::texture::tests::white;
    use shagreen_synth::drive::DriveConfig;
    use shagreen_synth::renderer::Mix;
    use std::sync::mpsc;

    const OPTIONS: OpenOptions = OpenOptions {
        model_rate_hz: 1000.0,
        preferred_rate_hz: Some(48_000),
        buffer_frames: Some(256),
        seed: 5,
        drive: DriveConfig::proportional(4.0, 1.0),
        channels: ChannelMask::FIRST_TWO,
        friction: None,
        take_over: false,
    };

    #[test]
    fn plays_by_the_clock() {
        let (sender, blocks) = mpsc::channel();
        let begun = Instant::now();
        let tap = move |block: &[f32]| sender.send(block.to_vec()).unwrap();
        let (mut handle, running) = open_null_with_tap(OPTIONS, tap).unwrap();
        assert_eq!((running.rate_hz(), running.channels(), running.buffer_frames()), (48_000, 2, Some(256)));
        assert!((256.0 / 48_000.0..0.03).contains(&running.latency_secs(&handle.status())));
        let id = handle.load(white(1.0)).unwrap();
        handle.set_mix(Mix::solo(id)).unwrap();
        handle.set_input(Input::Hand(Hand {
            path: Path::Line,
            speed_mps: 0.5,
            force_n: 0.5,
            extent_m: 0.06,
        }));
        std::thread::sleep(Duration::from_millis(300));
        // The output is never ahead of the clock by more than a block, and soon within two blocks of it, though not at
        // every moment on a busy machine.
        let mut tries = 0;
        loop {
            let since = begun.elapsed().as_secs_f64() * 48_000.0;
            let status = handle.status();
            let until = begun.elapsed().as_secs_f64() * 48_000.0;
            assert!(status.frames_played as f64 <= until + 256.0);
            // The thread started slightly after the test.
            if status.frames_played as f64 >= since - 2.0 * 256.0 {
                break;
            }
            tries += 1;
            assert!(tries < 10_000, "the output does not catch up: {status:?} after {since} frames");
            std::thread::sleep(Duration::from_millis(1));
        }
        drop(running);
        let status = handle.status();
        assert!(status.load > 0.0 && status.load_max >= status.load, "{status:?}");
        assert_eq!((status.state, status.underruns), (LinkState::Running, 0));
        let played: Vec<f32> = blocks.iter().flatten().collect();
        assert_eq!(played.len() as u64, 2 * status.frames_played);
        assert!(played.iter().any(|x| x.abs() > 0.05));
        assert!(played.chunks(2).all(|frame| frame[0] == frame[1]));
    }

    #[test]
    fn stops_without_waiting_for_the_next_block() {
        let slow = OpenOptions { buffer_frames: Some(65_536), preferred_rate_hz: Some(8000), ..OPTIONS };
        let (mut handle, running) = open_null_with_tap(slow, |_| {}).unwrap();
        while handle.status().frames_played == 0 {
            std::thread::yield_now();
        }
        let stopping = Instant::now();
        drop(running);
        // The next block is due eight seconds after the first one.
        assert!(stopping.elapsed() < Duration::from_secs(4));
    }

    #[test]
    fn the_clock_does_not_drift_and_skips_a_suspension() {
        let begun = Instant::now();
        let mut clock = Clock { begun, rate_hz: 44_100, block_frames: 256, blocks_done: 0 };
        assert_eq!(clock.wait(begun), None);
        // The clock has run for ten hours.
        clock.blocks_done = 36_000 * 44_100 / 256;
        let due = clock.due(clock.blocks_done).as_secs_f64();
        assert!((due - clock.blocks_done as f64 * 256.0 / 44_100.0).abs() < 1e-6);
        let on_time = begun + clock.due(clock.blocks_done);
        assert_eq!(clock.wait(on_time), None);
        clock.begun += Duration::from_millis(2);
        assert_eq!(clock.wait(on_time), Some(Duration::from_millis(2)));
        clock.begun = begun;
        assert!(!clock.skip_suspension(on_time + Duration::from_millis(900)));
        let woken = on_time + Duration::from_hours(1);
        assert!(clock.skip_suspension(woken));
        assert_eq!((clock.begun, clock.blocks_done), (woken, 0));
    }
}
