use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use shagreen_synth::budget::Budget;
use shagreen_synth::drive::{DriveConfig, Driven};

use super::{DeviceError, DeviceErrorKind, Heard, Sensor, play_and_listen, play_and_listen_for};
use crate::engine::Handle;
use crate::output::tests::OPTIONS;
use crate::output::{OpenOptions, Running, open_null_with_tap};
use crate::signal::Signal;

/// A sensor that records the silent output itself.
struct Wire {
    blocks: Receiver<Vec<f32>>,
    /// Level at which the sensor fails.
    breaks_at: f32,
    is_broken: bool,
}

impl Sensor for Wire {
    fn rate_hz(&self) -> f64 {
        48_000.0
    }

    fn read(&mut self, out: &mut Vec<f32>) {
        for block in self.blocks.try_iter() {
            self.is_broken |= block.iter().any(|x| x.abs() >= self.breaks_at);
            out.extend(block.iter().step_by(2));
        }
    }

    fn check(&self) -> Result<(), DeviceError> {
        let error = DeviceError::new(DeviceErrorKind::Lost, "broken");
        if self.is_broken { Err(error) } else { Ok(()) }
    }
}

fn wired(options: OpenOptions) -> (Handle, Running, Wire, Receiver<Vec<f32>>) {
    let (sender, blocks) = channel();
    let (recorder, recorded) = channel();
    // The receivers may be dropped when a test ends early.
    let tell = |sender: &Sender<Vec<f32>>, block: &[f32]| drop(sender.send(block.to_vec()));
    let tap = move |block: &[f32]| {
        tell(&sender, block);
        tell(&recorder, block);
    };
    let (handle, running) = open_null_with_tap(options, tap).unwrap();
    (handle, running, Wire { blocks, breaks_at: f32::INFINITY, is_broken: false }, recorded)
}

fn signal() -> Signal {
    Signal::new((1..=4800).map(|i| i as f32 * 1e-4).collect(), 48_000.0, Driven::Drive).unwrap()
}

fn constant(level: f32, secs: f64) -> Signal {
    Signal::new(vec![level; (48_000.0 * secs) as usize], 48_000.0, Driven::Drive).unwrap()
}

#[test]
fn what_is_played_is_heard_with_silence_around_it() {
    let (mut handle, _running, mut wire, _) = wired(OPTIONS);
    let mut shares = Vec::new();
    let heard = play_and_listen(&mut handle, signal(), &mut wire, &mut |share| {
        shares.push(share);
        true
    })
    .unwrap()
    .samples;
    let begin = heard.iter().position(|x| *x != 0.0).unwrap();
    assert!(begin > 40_000 && heard.len() > begin + 4800 + 40_000, "{begin} of {}", heard.len());
    assert!(heard[begin..begin + 4800] == *signal().part(0, 4800));
    assert!(heard[begin + 4800..].iter().all(|x| *x == 0.0));
    assert!(shares.windows(2).all(|w| w[0] <= w[1]) && shares.iter().all(|s| (0.0..=1.0).contains(s)));
}

/// Checks that the played signal ends in silence, and without a jump.
#[track_caller]
fn check_faded(running: Running, recorded: &Receiver<Vec<f32>>, level: f32) {
    drop(running);
    let played: Vec<f32> = recorded.iter().flatten().step_by(2).collect();
    let end = played.iter().rposition(|x| *x != 0.0).unwrap();
    assert!(played[..end].contains(&level) && end + 1 < played.len());
    // The signal starts at full level and fades within 960 frames.
    let steps = played[end - 960..].windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f32::max);
    assert!(steps < 1.1 * level / 960.0, "{steps}");
}

#[test]
fn whatever_ends_it_the_signal_has_faded() {
    let (mut handle, running, mut wire, recorded) = wired(OPTIONS);
    let stop = &mut |share: f64| share < 0.5;
    let error = play_and_listen(&mut handle, constant(0.5, 2.0), &mut wire, stop).unwrap_err();
    assert_eq!(error.kind(), DeviceErrorKind::Canceled);
    drop(handle);
    check_faded(running, &recorded, 0.5);
    // A sensor that fails during the recording.
    let (mut handle, running, mut wire, recorded) = wired(OPTIONS);
    wire.breaks_at = 0.25;
    let error = play_and_listen(&mut handle, constant(0.25, 2.0), &mut wire, &mut |_| true).unwrap_err();
    assert_eq!(error.message(), "broken");
    drop(handle);
    check_faded(running, &recorded, 0.25);
}

#[test]
fn it_can_be_stopped_before_it_plays_and_a_dead_sensor_is_named() {
    let (mut handle, _running, mut wire, _) = wired(OPTIONS);
    let error = play_and_listen(&mut handle, signal(), &mut wire, &mut |share| share < 0.1).unwrap_err();
    assert_eq!(error.kind(), DeviceErrorKind::Canceled);
    let (_silent, blocks) = channel();
    let mut dead = Wire { blocks, breaks_at: f32::INFINITY, is_broken: false };
    let begun = Instant::now();
    let patience = Duration::from_millis(300);
    let error = play_and_listen_for(&mut handle, signal(), &mut dead, &mut |_| true, patience).unwrap_err();
    assert!(error.message().contains("the sensor sends no samples"), "{error}");
    assert!(begun.elapsed() >= patience && begun.elapsed() < Duration::from_secs(5));
}

#[test]
fn what_the_limits_did_while_it_played_is_told_although_it_is_over() {
    // The coil has a thermal time constant of 0.2 s.
    let budget = Some(Budget { rms: 0.2, time_secs: 0.2 });
    let options = OpenOptions { drive: DriveConfig { budget, ..OPTIONS.drive }, ..OPTIONS };
    let (mut handle, _running, mut wire, _) = wired(options);
    let mut heard = |level: f32| {
        let listened = play_and_listen(&mut handle, constant(level, 1.0), &mut wire, &mut |_| true).unwrap();
        let now = handle.status();
        assert!(now.heat_gain > 0.99, "it must have cooled: {}", now.heat_gain);
        Heard { mps2: Vec::new(), rate_hz: 48_000.0, status: listened.status }
    };
    let hot = heard(0.5);
    assert!(hot.was_limited() && hot.status.heat_gain < 0.6, "{}", hot.status.heat_gain);
    assert_eq!(hot.status.limited_samples, 0);
    // First a level above the limiter's knee, then one without limiting, whatever was before.
    assert!(heard(0.85).status.limited_samples > 0);
    let cool = heard(0.1);
    assert!(!cool.was_limited() && cool.status.underruns == 0, "{:?}", cool.status);
}
