//! Tests of both sides on a simulated line with simulated time. A step is a tick of the receiver's clock, so results do
//! not depend on the machine or its load.
#![allow(clippy::print_stdout, reason = "a test prints its measurement")]

use std::collections::VecDeque;
use std::time::Duration;

use super::{Configure, Control, DeviceStatus, Mode, Plan, RunState, Sender, Source};
use crate::serial::frame::MAX_WIRE;
use crate::serial::message::tests::CONFIGURE;
use crate::serial::message::{DeviceMessage, write_to_host};
use crate::serial::receiver::{About, Receiver};
use crate::serial::write_queue::WriteQueue;
use proptest::prelude::{any, prop, proptest};

const PLAN: Plan = Plan { configure: CONFIGURE, block: 16, stall: Duration::from_millis(25) };
/// Duration of a tick at 4 kHz.
const TICK: Duration = Duration::from_micros(250);
/// Transit time of a frame in ticks, in either direction.
const DELAY: u64 = 4;
const ABOUT: About = About { has_control: true, ..About::STREAM };
/// Ticks in a second, and in the 50 ms within which a stream must recover.
const SECOND: u64 = 4000;
const RESYNC: u64 = 200;
/// Largest number of ticks from rendering to playback: window, transit and a block.
const OLDEST: u64 = 40 + DELAY + 16;

/// Source whose samples encode the tick of their rendering, so that stale samples are recognized.
struct Stamps {
    tick: u64,
    n_rendered: u64,
}

impl Source for Stamps {
    fn render(&mut self, out: &mut [i16]) {
        out.fill(stamp(self.tick));
        self.n_rendered += out.len() as u64;
    }

    fn control(&self) -> Control {
        Control { speed_dmmps: self.tick as u16, force_mn: 500, texture: 1, gain_permille: 1000 }
    }
}

fn stamp(tick: u64) -> i16 {
    1 + (tick % 30_000) as i16
}

/// Simulated transmission of a frame.
enum Fate {
    Arrives,
    Lost,
    Twice,
    /// Arrives after the next frame.
    Later,
    /// One byte is changed: its index and the changed bits.
    Corrupted(usize, u8),
}

type Fates = Box<dyn FnMut(u64) -> Fate>;

/// One direction of the line.
struct Way {
    on_it: VecDeque<(u64, Vec<u8>)>,
    held: Option<Vec<u8>>,
    fates: Fates,
    /// Whether frames are held back without loss.
    is_stuck: bool,
    most: usize,
}

impl Way {
    fn new() -> Self {
        Self {
            on_it: VecDeque::new(),
            held: None,
            fates: Box::new(|_| Fate::Arrives),
            is_stuck: false,
            most: 0,
        }
    }

    fn put(&mut self, tick: u64, mut frame: Vec<u8>) {
        let due = tick + DELAY;
        match (self.fates)(tick) {
            Fate::Arrives => self.on_it.push_back((due, frame)),
            Fate::Lost => {}
            Fate::Twice => {
                self.on_it.push_back((due, frame.clone()));
                self.on_it.push_back((due, frame));
            }
            Fate::Later => {
                if let Some(held) = self.held.replace(frame) {
                    self.on_it.push_back((due, held));
                }
                return;
            }
            Fate::Corrupted(at, mask) => {
                let at = at % frame.len();
                frame[at] ^= mask;
                self.on_it.push_back((due, frame));
            }
        }
        if let Some(held) = self.held.take() {
            self.on_it.push_back((due, held));
        }
        self.most = self.most.max(self.on_it.iter().map(|(_, frame)| frame.len()).sum());
    }

    fn take(&mut self, tick: u64) -> Vec<u8> {
        let mut bytes = Vec::new();
        while !self.is_stuck && self.on_it.front().is_some_and(|(due, _)| *due <= tick) {
            bytes.extend(self.on_it.pop_front().unwrap().1);
        }
        bytes
    }
}

struct Bench {
    tick: u64,
    sender: Sender,
    outbox: WriteQueue,
    source: Stamps,
    receiver: Receiver<256>,
    down: Way,
    up: Way,
    /// Whether the receiver's clock is halted.
    is_halted: bool,
    played: Vec<i16>,
    /// Ticks with output at full gain, and the age of that output in ticks.
    ages: Vec<(u64, u64)>,
}

impl Bench {
    fn new(mode: Mode) -> Self {
        let plan = Plan { configure: Configure { mode, ..PLAN.configure }, ..PLAN };
        Self {
            tick: 0,
            sender: Sender::new(plan, Duration::ZERO),
            outbox: WriteQueue::new(),
            source: Stamps { tick: 0, n_rendered: 0 },
            receiver: Receiver::new(ABOUT),
            down: Way::new(),
            up: Way::new(),
            is_halted: false,
            played: Vec::new(),
            ages: Vec::new(),
        }
    }

    fn now(&self) -> Duration {
        TICK * self.tick as u32
    }

    fn step(&mut self) {
        self.tick += 1;
        if !self.is_halted {
            for byte in self.down.take(self.tick) {
                self.receiver.receive(byte);
            }
            let rendered =
                self.receiver.control().map_or(0, |control| control.speed_dmmps.cast_signed() & 0x3FFF);
            let sample = self.receiver.tick(rendered);
            assert!(sample.unsigned_abs() <= CONFIGURE.ceiling, "output above the ceiling");
            self.played.push(sample);
            let mut wire = [0; MAX_WIRE];
            loop {
                let len = self.receiver.transmit(&mut wire);
                if len == 0 {
                    break;
                }
                self.up.put(self.tick, wire[..len].to_vec());
            }
        }
        self.source.tick = self.tick;
        let (bytes, now) = (self.up.take(self.tick), self.now());
        self.sender.receive(&bytes, now, &mut |_| {});
        self.sender.poll(now, &mut self.source, &mut self.outbox);
        let (down, tick) = (&mut self.down, self.tick);
        let mut write = |bytes: &[u8]| {
            for frame in bytes.split_inclusive(|&byte| byte == 0) {
                down.put(tick, frame.to_vec());
            }
            Ok(bytes.len())
        };
        self.outbox.flush(now, &mut write).unwrap();
    }

    /// Advances time. Records the age of the output whenever two successive samples at full gain are equal.
    fn run(&mut self, n_ticks: u64) {
        for _ in 0..n_ticks {
            self.step();
            if let [.., a, b] = self.played[..]
                && a == b
                && b != 0
                && self.receiver.status().state == RunState::Playing
            {
                let age = (0..30_000).find(|age| self.tick > *age && stamp(self.tick - age) == b);
                self.ages.push((self.tick, age.unwrap_or(u64::MAX)));
            }
        }
    }

    /// Returns the number of ticks until current samples are played again.
    fn until_heard(&mut self) -> u64 {
        let begin = self.tick;
        while self.tick < begin + SECOND {
            self.run(1);
            if self.ages.last().is_some_and(|(tick, _)| *tick == self.tick && *tick > begin + 1) {
                return self.tick - begin;
            }
        }
        panic!("there is no output: {:?} {:?}", self.sender, self.receiver.status());
    }

    #[track_caller]
    fn check_ages(&self) {
        self.check_ages_within(OLDEST);
    }

    /// Checks the largest age of the output, in ticks.
    #[track_caller]
    fn check_ages_within(&self, most: u64) {
        let (tick, age) = self.ages.iter().max_by_key(|(_, age)| *age).unwrap();
        assert!(*age <= most, "{age} ticks old at tick {tick}");
    }

    fn counts(&self) -> (u64, u64) {
        (self.sender.counts().underruns, self.sender.counts().bad_frames)
    }
}

/// Pseudorandom numbers from a seed.
fn numbers(seed: u64) -> impl FnMut() -> u64 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state
    }
}

#[test]
fn a_good_line_plays_without_a_gap_and_never_late() {
    let mut bench = Bench::new(Mode::Stream);
    assert!(bench.until_heard() < RESYNC);
    bench.run(2 * SECOND);
    bench.check_ages();
    assert_eq!(bench.counts(), (0, 0));
    assert_eq!(bench.receiver.status().dropped, 0);
    // The stamps change by one block at a time, so no samples are missing.
    let begun = bench.played.iter().position(|&x| x != 0).unwrap() + 16;
    assert!(bench.played[begun..].windows(2).all(|w| w[0] != 0 && (w[1] - w[0]).abs() < 64));
    assert!(bench.down.most < 256 && bench.up.most < 256);
}

#[test]
fn a_bad_line_is_survived_and_the_stream_stands_again_within_50_ms() {
    let mut slowest = 0;
    for seed in 1..=40 {
        let mut bench = Bench::new(Mode::Stream);
        let ends = 2 * SECOND;
        let fates = |salt: u64| -> Fates {
            let mut next = numbers(seed + 1000 * salt);
            Box::new(move |tick| {
                let (kind, detail) = (next() % 100, next());
                match kind {
                    _ if tick >= ends => Fate::Arrives,
                    0..10 => Fate::Lost,
                    10..20 => Fate::Corrupted(detail as usize, 1 << (detail >> 32 & 7)),
                    20..30 => Fate::Twice,
                    30..40 => Fate::Later,
                    _ => Fate::Arrives,
                }
            })
        };
        (bench.down.fates, bench.up.fates) = (fates(1), fates(2));
        bench.run(ends);
        assert!(bench.counts().1 > 50, "{:?}", bench.counts());
        assert!(bench.ages.len() > 1000, "there must be output despite the errors: {}", bench.ages.len());
        // A frame that is held back waits for the next one, which bounds its age.
        bench.check_ages_within(OLDEST + RESYNC);
        bench.ages.clear();
        slowest = slowest.max(bench.until_heard());
        bench.run(2 * RESYNC);
        let good = bench.ages.iter().filter(|(tick, _)| *tick > bench.tick - RESYNC).count() as u64;
        // All samples count except those at changes of the stamp.
        assert!(good > RESYNC * 8 / 10, "seed {seed}: {good} of {RESYNC}");
        bench.check_ages();
    }
    println!("a bad line: output again after at most {} ms", slowest as f64 / 4.0);
    assert!(slowest <= RESYNC);
}

/// Fault of the line that lasts two seconds.
#[derive(Clone, Copy, Debug)]
enum Ailment {
    DeadBoth,
    DeadDown,
    DeadUp,
    StuckDown,
    StuckUp,
    Stalled,
    Halted,
}

#[test]
fn a_line_that_was_away_plays_what_is_current_within_50_ms() {
    use Ailment::{DeadBoth, DeadDown, DeadUp, Halted, Stalled, StuckDown, StuckUp};
    let mut slowest = 0;
    for ailment in [DeadBoth, DeadDown, DeadUp, StuckDown, StuckUp, Stalled, Halted] {
        for shift in (0..60).step_by(4) {
            let mut bench = Bench::new(Mode::Stream);
            bench.run(SECOND / 2 + shift);
            let (begins, ends) = (bench.tick, bench.tick + 2 * SECOND + shift * 7 % 41);
            let dead = move |tick| if (begins..ends).contains(&tick) { Fate::Lost } else { Fate::Arrives };
            match ailment {
                DeadBoth => (bench.down.fates, bench.up.fates) = (Box::new(dead), Box::new(dead)),
                DeadDown => bench.down.fates = Box::new(dead),
                DeadUp => bench.up.fates = Box::new(dead),
                StuckDown => bench.down.is_stuck = true,
                StuckUp => bench.up.is_stuck = true,
                Stalled => (bench.down.is_stuck, bench.up.is_stuck) = (true, true),
                Halted => bench.is_halted = true,
            }
            let rendered = bench.source.n_rendered;
            bench.run(ends - begins);
            // At most a window and the samples in transit.
            let n_rendered = bench.source.n_rendered - rendered;
            assert!(n_rendered <= 120, "{ailment:?} {shift}: {n_rendered} samples rendered during the fault");
            assert!(bench.down.most <= 4096 && bench.up.most <= 1 << 16, "{ailment:?}: {}", bench.down.most);
            let silent = bench.played.iter().rev().take_while(|&&x| x == 0).count() as u64;
            assert!(matches!(ailment, Halted) || silent > 2 * SECOND - 200, "{ailment:?} {shift}: {silent}");
            (bench.down.is_stuck, bench.up.is_stuck, bench.is_halted) = (false, false, false);
            bench.ages.clear();
            let after = bench.until_heard();
            slowest = slowest.max(after);
            assert!(after <= RESYNC, "{ailment:?} {shift}: output again after {} ms", after as f64 / 4.0);
            bench.run(SECOND);
            bench.check_ages();
        }
    }
    println!("a line that was interrupted: output again after at most {} ms", slowest as f64 / 4.0);
}

#[test]
fn a_receiver_that_resets_is_configured_and_plays_again_within_50_ms() {
    let mut slowest = 0;
    for shift in (0..60).step_by(4) {
        for is_hello_lost in [false, true] {
            let mut bench = Bench::new(Mode::Stream);
            bench.run(SECOND / 2 + shift);
            bench.receiver = Receiver::new(ABOUT);
            bench.ages.clear();
            if is_hello_lost {
                bench.receiver.transmit(&mut [0; MAX_WIRE]);
            }
            slowest = slowest.max(bench.until_heard());
            bench.run(SECOND);
            bench.check_ages();
            assert_eq!(bench.receiver.status().config, 2);
        }
    }
    println!("a receiver that was reset: output again after at most {} ms", slowest as f64 / 4.0);
    assert!(slowest <= RESYNC);
}

#[test]
fn control_follows_the_hand_and_stops_with_it() {
    let mut bench = Bench::new(Mode::Control);
    bench.run(SECOND);
    let control = bench.receiver.control().unwrap();
    let age = bench.tick - u64::from(control.speed_dmmps);
    assert!(age <= 16 + 8 + 2 * DELAY + 1, "{age} ticks old");
    assert_eq!(control.texture, 1);
    // The engine runs on the receiver's clock.
    let n_played = bench.receiver.status().clock;
    assert!(u64::from(n_played).abs_diff(bench.source.n_rendered) <= 40);
    bench.down.is_stuck = true;
    bench.run(SECOND);
    assert_eq!(bench.receiver.control(), None);
    assert_eq!(bench.played.last(), Some(&0));
    bench.down.is_stuck = false;
    let begin = bench.tick;
    while bench.receiver.control().is_none_or(|control| u64::from(control.speed_dmmps) < begin) {
        bench.run(1);
        assert!(bench.tick < begin + RESYNC);
    }
}

fn status_bytes(status: DeviceStatus) -> Vec<u8> {
    let mut wire = [0; MAX_WIRE];
    let len = write_to_host(DeviceMessage::Status(status), &mut wire);
    wire[..len].to_vec()
}

/// A receiver that claims unlimited room and a new run each time gets only what its clock could play.
#[test]
fn infinite_credit_is_no_credit() {
    let mut source = Stamps { tick: 0, n_rendered: 0 };
    let mut sender = Sender::new(PLAN, Duration::ZERO);
    let mut n_bytes = 0;
    for step in 0..10_000_u32 {
        let now = Duration::from_micros(100) * step;
        let status = DeviceStatus {
            seq: (step * 7919) as u16,
            config: 1,
            run: step as u8,
            state: if step % 3 == 0 { RunState::Playing } else { RunState::Armed },
            free: 65_535,
            clock: step,
            ..DeviceStatus::default()
        };
        sender.receive(&status_bytes(status), now, &mut |_| {});
        let mut outbox = WriteQueue::new();
        sender.poll(now, &mut source, &mut outbox);
        let mut write = |bytes: &[u8]| {
            n_bytes += bytes.len();
            Ok(bytes.len())
        };
        outbox.flush(now, &mut write).unwrap();
    }
    // 4000 samples for one second, a quarter more, and two windows.
    assert!(source.n_rendered <= 5000 + 80, "{}", source.n_rendered);
    assert!(n_bytes < 100_000, "{n_bytes}");
}

proptest! {
    #[test]
    fn arbitrary_bytes_from_a_receiver_never_panic(
        acts in prop::collection::vec((prop::collection::vec(any::<u8>(), 0..20), any::<u16>(), any::<[u8; 4]>(), 0_u32..100), 0..60),
        is_control in any::<bool>(),
    ) {
        let mode = if is_control { Mode::Control } else { Mode::Stream };
        let mut bench = Bench::new(mode);
        bench.run(100);
        for (bytes, number, [kind, a, b, c], n_ticks) in acts {
            let now = bench.now();
            let state = [RunState::Unconfigured, RunState::Armed, RunState::Filling, RunState::Playing][usize::from(a % 4)];
            let bytes = if kind % 2 == 0 { bytes } else {
                let clock = u32::from(number) << (b % 17);
                let status = DeviceStatus { seq: number, config: c % 3, run: b, state, free: number, clock, ..DeviceStatus::default() };
                status_bytes(status)
            };
            bench.sender.receive(&bytes, now, &mut |_| {});
            bench.run(u64::from(n_ticks));
        }
        bench.sender.receive(&[0], bench.now(), &mut |_| {});
        // No input prevents the stream from recovering.
        bench.ages.clear();
        bench.run(RESYNC);
        if mode == Mode::Stream {
            bench.until_heard();
        }
    }
}
