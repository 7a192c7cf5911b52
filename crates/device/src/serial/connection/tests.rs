//! Tests with real pseudoterminals and a receiver whose clock waits for samples, so that the results do not depend on
//! the load of the machine. Timing is tested in `sender`.
#![allow(clippy::print_stdout, reason = "a test prints its measurement")]

use std::io::{Read as _, Write as _};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver as Inbox, Sender as Teller};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use serialport::{SerialPort as _, TTYPort};
use shagreen_synth::renderer::Mix;

use super::{Edge, LineEdge, ReceiverEvent, SensorBlock, SerialOutput};
use crate::controls::Input;
use crate::engine::Handle;
use crate::error::DeviceErrorKind;
use crate::hand::{Hand, Path};
use crate::measure::{Listener, measure};
use crate::output::NULL_ID;
use crate::output::tests::OPTIONS;
use crate::output_options::{Made, OpenOptions, make_engine};
use crate::serial::frame::MAX_WIRE;
use crate::serial::line::Line;
use crate::serial::message::{Control, Mode, RunState, write_sensor};
use crate::serial::receiver::{About, Receiver};
use crate::serial::{SerialOptions, handshake, negotiation, open};
use crate::status::LinkState;
use crate::texture::tests::{rubbed, white};

const ABOUT: About = About { has_control: true, has_sensor: true, name: "test board", ..About::STREAM };
const HAND: Hand = Hand { path: Path::Circle, speed_mps: 0.5, force_n: 0.5, extent_m: 0.06 };
/// Options for a host that waits almost without limit.
const PATIENT: SerialOptions = SerialOptions {
    baud: 1_000_000,
    mode: Mode::Stream,
    watchdog_ms: 60_000,
    patience: Duration::from_secs(30),
};
/// A time limit that is long enough for a busy machine.
const LONG: Duration = Duration::from_secs(30);

/// Output of the board: run number and sample.
type Played = (u8, i16);
/// Corruption of bytes in transit, in either direction.
type Spoil = Box<dyn FnMut(&mut Vec<u8>) + Send>;

/// A simulated microcontroller at the other end of a pseudoterminal.
struct Board {
    port: String,
    stop: Arc<AtomicBool>,
    /// Whether the board neither reads nor ticks.
    is_stalled: Arc<AtomicBool>,
    played: Inbox<Played>,
    thread: Option<JoinHandle<usize>>,
}

impl Board {
    fn new(first_words: Vec<u8>, spoil: Spoil) -> Self {
        Self::of(ABOUT, first_words, spoil)
    }

    fn of(about: About, first_words: Vec<u8>, spoil: Spoil) -> Self {
        let (mut master, slave) = TTYPort::pair().unwrap();
        let port = slave.name().unwrap();
        drop(slave);
        master.set_timeout(Duration::from_millis(1)).unwrap();
        let (stop, is_stalled) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicBool::new(false)));
        let (teller, played) = mpsc::channel();
        let (stopped, stalled) = (Arc::clone(&stop), Arc::clone(&is_stalled));
        let thread = std::thread::spawn(move || {
            run_board(about, &mut master, first_words, spoil, &teller, (&stopped, &stalled))
        });
        Self { port, stop, is_stalled, played, thread: Some(thread) }
    }

    fn good() -> Self {
        Self::new(Vec::new(), Box::new(|_| {}))
    }

    /// Returns the next `n` played samples.
    fn play(&self, n: usize) -> Vec<Played> {
        (0..n).map(|_| self.played.recv_timeout(LONG).expect("the board must play")).collect()
    }

    /// Unplugs the board. Returns the largest number of bytes that waited to be read.
    fn pull_out(&mut self) -> usize {
        self.stop.store(true, Ordering::Relaxed);
        self.thread.take().map_or(0, |thread| thread.join().unwrap())
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        self.pull_out();
    }
}

fn run_board(
    about: About,
    master: &mut TTYPort,
    first_words: Vec<u8>,
    mut spoil: Spoil,
    teller: &Teller<Played>,
    (stop, is_stalled): (&AtomicBool, &AtomicBool),
) -> usize {
    let mut receiver = Receiver::<256>::new(about);
    let mut words = first_words;
    let (mut most, mut n_sensor) = (0, 0_u16);
    let mut wire = [0; MAX_WIRE];
    while !stop.load(Ordering::Relaxed) {
        if is_stalled.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(1));
            continue;
        }
        most = most.max(master.bytes_to_read().unwrap_or(0) as usize);
        let mut bytes = [0; 4096];
        // Zero bytes if nothing arrived or the port is not open.
        let n = master.read(&mut bytes).unwrap_or(0);
        let mut bytes = bytes[..n].to_vec();
        spoil(&mut bytes);
        for &byte in &bytes {
            receiver.receive(byte);
        }
        loop {
            // The board's clock stops while there is nothing to play.
            let status = receiver.status();
            let prefill = receiver.settings().map_or(u16::MAX, |settings| settings.prefill);
            let is_ready = match receiver.settings().map(|settings| settings.mode) {
                Some(Mode::Stream | Mode::Friction) => {
                    status.queued > 0 && (status.state == RunState::Playing || status.queued >= prefill)
                }
                // Sixteen ticks per loop, whatever arrives.
                Some(Mode::Control) => status.clock % 16 != 15,
                None => false,
            };
            let rendered = receiver.control().map_or(0, |control| control.speed_dmmps.cast_signed());
            if is_ready {
                let sample = receiver.tick(rendered);
                let _ = teller.send((status.run, sample));
            } else if status.clock % 16 == 15 && receiver.control().is_some() {
                let _ = teller.send((status.run, receiver.tick(rendered)));
            }
            loop {
                let len = receiver.transmit(&mut wire);
                if len == 0 {
                    break;
                }
                words.extend(&wire[..len]);
            }
            if !is_ready {
                break;
            }
        }
        if receiver.settings().is_some() && n > 0 {
            let len = write_sensor((n_sensor, 3200, 7, 38_307), &[n_sensor.cast_signed(), -1], &mut wire);
            n_sensor = n_sensor.wrapping_add(2);
            words.extend(&wire[..len]);
        }
        spoil(&mut words);
        // Writing fails while the port is not open.
        let _ = master.write_all(&words);
        words.clear();
    }
    most
}

/// All steps of opening, with a texture that is loaded before the first sample.
fn start(board: &Board, serial: SerialOptions) -> (Handle, SerialOutput, rtrb::Consumer<ReceiverEvent>) {
    let id = "serial:test";
    let mut line = Line::open(id, &board.port, serial.baud).unwrap();
    let info = handshake::greet(id, &mut line, serial).unwrap();
    assert_eq!(info.name, "test board");
    let plan = negotiation::agree(id, &info, OPTIONS, serial).unwrap();
    let Made { mut handle, engine, reporter } = make_engine(OPTIONS, 4000).unwrap();
    stroke(&mut handle);
    let (output, heard) = SerialOutput::start(id, line, plan, engine, reporter, Duration::ZERO).unwrap();
    (handle, output, heard)
}

fn stroke(handle: &mut Handle) {
    let id = handle.load(white(2.0)).unwrap();
    handle.set_mix(Mix::solo(id)).unwrap();
    handle.set_input(Input::Hand(HAND));
}

/// The same samples rendered without a serial line.
fn expected(n: usize) -> Vec<i16> {
    let Made { mut handle, engine, reporter } = make_engine(OPTIONS, 4000).unwrap();
    stroke(&mut handle);
    let mut samples = vec![0_i16; n];
    Edge::new(engine, reporter.shared, 4000.0).fill(&mut samples, 1, Duration::ZERO);
    let faded = (1..).zip(samples).map(|(k, x)| (i32::from(x) * k.min(12) / 12) as i16);
    faded.collect()
}

/// Waits for a condition.
fn wait_for(what: &str, mut is_so: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !is_so() {
        assert!(begun.elapsed() < LONG, "{what}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn a_texture_arrives_bit_for_bit() {
    let mut board = Board::good();
    let (mut handle, output, mut heard) = start(&board, PATIENT);
    let begun = Instant::now();
    let played: Vec<i16> = board.play(8000).into_iter().map(|(_, sample)| sample).collect();
    println!("2 s of samples in {:.2} s", begun.elapsed().as_secs_f64());
    assert!(played == expected(8000), "the samples must be equal");
    assert!(played.iter().any(|x| x.abs() > 3000));
    let status = handle.status();
    assert_eq!((status.state, status.underruns, status.backend_errors), (LinkState::Running, 0, 0));
    assert!(status.frames_played >= 8000);
    let Ok(ReceiverEvent::Sensor(first)) = heard.pop() else { panic!("the sensor must send samples") };
    let block = SensorBlock { seq: 0, rate_hz: 3200, time_us: 7, scale_mps2: 0.038_307, counts: vec![0, -1] };
    assert_eq!(first, block);
    drop(output);
    assert!(board.pull_out() < 4096);
}

#[test]
fn a_line_that_corrupts_is_survived() {
    let mut state = 12_345_u64;
    let n_left = Arc::new(AtomicBool::new(true));
    let is_bad = Arc::clone(&n_left);
    let spoil = move |bytes: &mut Vec<u8>| {
        for i in (0..bytes.len()).rev() {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            if is_bad.load(Ordering::Relaxed) {
                match state >> 54 {
                    0..3 => bytes[i] ^= 1 << (state >> 40 & 7),
                    3..5 => drop(bytes.remove(i)),
                    5..7 => bytes.insert(i, state as u8),
                    _ => {}
                }
            }
        }
    };
    let board = Board::new(Vec::new(), Box::new(spoil));
    let (mut handle, _output, _heard) = start(&board, SerialOptions { watchdog_ms: 50, ..PATIENT });
    let played = board.play(3000);
    assert!(played.iter().all(|(_, x)| x.unsigned_abs() <= 29_491));
    assert!(handle.status().backend_errors > 10, "{:?}", handle.status());
    n_left.store(false, Ordering::Relaxed);
    board.play(1000);
    let after = handle.status();
    let played = board.play(2000);
    assert!(played.iter().any(|(_, x)| x.abs() > 3000));
    wait_for("it must run", || handle.status().state == LinkState::Running);
    assert!(handle.status().backend_errors >= after.backend_errors);
}

#[test]
fn a_stalled_reader_gets_nothing_stale() {
    let mut board = Board::good();
    let (mut handle, _output, _heard) = start(&board, SerialOptions { watchdog_ms: 50, ..PATIENT });
    board.play(2000);
    board.is_stalled.store(true, Ordering::Relaxed);
    std::thread::sleep(Duration::from_millis(100));
    let before: Vec<Played> = board.played.try_iter().collect();
    let frames = handle.status().frames_played;
    wait_for("the stall must be reported", || handle.status().state == LinkState::Stalled);
    std::thread::sleep(Duration::from_secs(1));
    assert!(handle.status().frames_played <= frames + 80, "nothing may be rendered during a stall");
    board.is_stalled.store(false, Ordering::Relaxed);
    let after = board.play(2000);
    wait_for("it must run again", || handle.status().state == LinkState::Running);
    if let Some((run, _)) = before.last() {
        assert!(after.iter().all(|(r, x)| r != run || *x == 0), "stale samples were played");
    }
    let most = board.pull_out();
    assert!(most < 4096, "{most} bytes waited to be read");
}

#[test]
fn a_plug_that_is_pulled_is_a_loss_and_stays_one() {
    let mut board = Board::good();
    let options = OpenOptions { seed: 3, ..OPTIONS };
    let mut connection = open(&board.port, options, PATIENT).unwrap();
    assert_eq!(connection.running.id(), format!("serial:{}", board.port));
    assert_eq!((connection.running.rate_hz(), connection.running.channels()), (4000, 1));
    assert_eq!(connection.running.buffer_frames(), Some(40));
    let latency_secs = connection.running.latency_secs(&connection.handle.status());
    assert!(latency_secs > 0.010 && latency_secs < 0.030, "{latency_secs}");
    assert_eq!(connection.receiver.name, "test board");
    stroke(&mut connection.handle);
    board.play(1000);
    // The port is exclusive.
    let error = open(&board.port, OPTIONS, PATIENT).unwrap_err();
    assert_eq!(error.kind(), DeviceErrorKind::Busy, "{error}");
    board.pull_out();
    wait_for("the loss must be reported", || connection.handle.status().state == LinkState::Lost);
    let loss = connection.handle.loss().unwrap();
    assert_eq!(loss.kind(), DeviceErrorKind::Lost);
    assert!(loss.message().contains(&format!("`serial:{}`", board.port)), "{loss}");
}

#[test]
fn garbage_before_hello_is_no_matter() {
    let mut garbage: Vec<u8> = (0..2000_u32).map(|i| ((i * 7919) >> 3) as u8).collect();
    garbage.extend(b"\x02\x81\nBooting...\r\n");
    let board = Board::new(garbage, Box::new(|_| {}));
    let (_handle, _output, _heard) = start(&board, PATIENT);
    board.play(1000);
}

#[test]
fn control_reaches_a_board_that_renders() {
    let board = Board::good();
    let serial = SerialOptions { mode: Mode::Control, ..PATIENT };
    let (_handle, _output, _heard) = start(&board, serial);
    // The board outputs the received speed, in units of 0.1 mm/s.
    wait_for("the speed must arrive", || board.play(1)[0].1 == 5000);
}

#[test]
fn friction_reaches_a_display_that_renders_it_and_is_refused_by_another() {
    let serial = SerialOptions { mode: Mode::Friction, ..PATIENT };
    let board = Board::of(About { has_friction: true, ..ABOUT }, Vec::new(), Box::new(|_| {}));
    let mut connection = open(&board.port, OPTIONS, serial).unwrap();
    assert_eq!(connection.running.rate_hz(), 10_000);
    let id = connection.handle.load(rubbed(white(2.0), 0.5)).unwrap();
    connection.handle.set_mix(Mix::solo(id)).unwrap();
    connection.handle.set_input(Input::Hand(HAND));
    wait_for("the level must arrive", || (board.play(1)[0].1 - 16_384).abs() < 300);
    assert!(board.play(2000).iter().all(|(_, level)| (level - 16_384).abs() < 600));
    // Firmware from before this mode.
    let board = Board::good();
    let error = open(&board.port, OPTIONS, serial).unwrap_err();
    assert_eq!(error.kind(), DeviceErrorKind::Unsupported);
    assert!(error.message().contains("cannot render friction"), "{error}");
}

#[test]
fn what_the_hand_does_is_told_in_the_units_of_the_protocol() {
    use super::Source as _;
    let Made { mut handle, engine, reporter } = make_engine(OPTIONS, 4000).unwrap();
    let edge = Edge::new(engine, reporter.shared, 4000.0);
    let mut edge = LineEdge { edge, line_latency: Duration::ZERO };
    assert_eq!(edge.control(), Control { texture: 0xFFFF, ..Control::default() });
    stroke(&mut handle);
    edge.render(&mut [0; 4000]);
    let expected = Control { speed_dmmps: 5000, force_mn: 500, texture: 0, gain_permille: 1000 };
    assert_eq!(edge.control(), expected);
}

#[test]
fn who_does_not_answer_is_told_how_to_find_out_why() {
    let impatient = SerialOptions { patience: Duration::from_millis(300), ..PATIENT };
    let (mut master, slave) = TTYPort::pair().unwrap();
    let port = slave.name().unwrap();
    drop(slave);
    let error = open(&port, OPTIONS, impatient).unwrap_err();
    assert_eq!(error.kind(), DeviceErrorKind::Unavailable);
    for words in [port.as_str(), "1000000 baud", "RX", "firmware"] {
        assert!(error.message().contains(words), "{error}");
    }
    // A board that sends unrelated text.
    let talker = std::thread::spawn(move || {
        for _ in 0..100 {
            let _ = master.write_all(b"temperature 23.4\r\n");
            std::thread::sleep(Duration::from_millis(10));
        }
    });
    let error = open(&port, OPTIONS, impatient).unwrap_err();
    assert!(error.message().contains("no valid frame"), "{error}");
    talker.join().unwrap();
}

#[test]
fn what_is_no_port_is_said() {
    let kind = |id: &str| open(id, OPTIONS, PATIENT).unwrap_err().kind();
    assert_eq!(kind("serial:/dev/no_such_port"), DeviceErrorKind::NotFound);
    assert_eq!(kind("/dev/null"), DeviceErrorKind::Unsupported);
    assert_eq!(
        crate::output::open("serial:/dev/no_such_port", OPTIONS).unwrap_err().kind(),
        DeviceErrorKind::NotFound
    );
}

#[test]
fn a_receiver_without_a_sensor_is_refused_before_anything_is_played() {
    let board = Board::of(About { has_sensor: false, ..ABOUT }, Vec::new(), Box::new(|_| {}));
    let listener = Listener::Serial { port: board.port.clone(), baud: 1_000_000 };
    let drive_at = |_: f64| -> Result<Vec<f32>, String> { panic!("nothing may be played") };
    let driven = (OPTIONS.drive, OPTIONS.channels);
    for id in [NULL_ID.to_owned(), format!("serial:{}", board.port)] {
        let error = measure(&id, driven, &listener, &drive_at, &mut |_| true).unwrap_err();
        assert_eq!(error.kind(), DeviceErrorKind::Unsupported, "{error}");
        assert!(error.message().contains("`test board`") && error.message().contains("no sensor"), "{error}");
    }
    assert!(board.played.try_iter().all(|(_, sample)| sample == 0));
}
