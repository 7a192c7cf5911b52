//! `shagreen play --serial`: the real program, a real pseudo terminal, and a simulated receiver.
#![cfg(unix)]

use std::io::{Read as _, Write as _};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::support::Bench;
use serialport::{SerialPort as _, TTYPort};
use shagreen_device::serial::frame::MAX_WIRE;
use shagreen_device::serial::message::RunState;
use shagreen_device::serial::receiver::{About, Receiver};

const ABOUT: About = About { has_control: true, ..About::STREAM };

/// Behavior of the receiver.
#[derive(Clone, Copy)]
struct Manners {
    name: &'static str,
    /// Warning that it sends repeatedly while it plays.
    warning: Option<&'static str>,
    /// Number of played samples after which it stops responding.
    last_words_at: usize,
}

const GOOD: Manners = Manners { name: "test board", warning: None, last_words_at: usize::MAX };

/// Receiver whose clock waits for samples, so that a busy machine does not matter. It returns the played samples when
/// stopped.
struct Board {
    port: String,
    stop: Arc<AtomicBool>,
    thread: std::thread::JoinHandle<Vec<i16>>,
}

impl Board {
    fn new() -> Self {
        Self::with(GOOD)
    }

    fn with(manners: Manners) -> Self {
        let (mut master, slave) = TTYPort::pair().unwrap();
        let port = slave.name().unwrap();
        master.set_timeout(Duration::from_millis(1)).unwrap();
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = Arc::clone(&stop);
        let thread = std::thread::spawn(move || {
            let mut receiver = Receiver::<256>::new(About { name: manners.name, ..ABOUT });
            let (mut played, mut wire) = (Vec::new(), [0; MAX_WIRE]);
            while !stopped.load(Ordering::Relaxed) {
                if played.len() >= manners.last_words_at {
                    std::thread::sleep(Duration::from_millis(10));
                    continue;
                }
                let mut bytes = [0; 4096];
                // Zero bytes: nothing was sent, or the port is not open.
                let n = master.read(&mut bytes).unwrap_or(0);
                bytes[..n].iter().for_each(|&byte| receiver.receive(byte));
                loop {
                    let status = receiver.status();
                    let prefill = receiver.settings().map_or(u16::MAX, |settings| settings.prefill);
                    let is_ready =
                        status.queued > 0 && (status.state == RunState::Playing || status.queued >= prefill);
                    if is_ready {
                        played.push(receiver.tick(0));
                        if let Some(warning) = manners.warning.filter(|_| played.len() % 100 == 0) {
                            receiver.fault(false, warning);
                        }
                    }
                    let len = receiver.transmit(&mut wire);
                    let _ = master.write_all(&wire[..len]);
                    if len == 0 && !is_ready {
                        break;
                    }
                }
            }
            played
        });
        Self { port, stop, thread }
    }

    fn finish(self) -> Vec<i16> {
        self.stop.store(true, Ordering::Relaxed);
        self.thread.join().unwrap()
    }
}

#[test]
fn a_texture_is_played_on_a_microcontroller() {
    let board = Board::new();
    let played = Bench::new().json(&format!(
        "play --texture brick --speed 200 --force 2 --seconds 0.5 --serial {} --baud 115200",
        board.port
    ));
    assert_eq!(played["output"], format!("serial:{}", board.port));
    assert_eq!((&played["channels"], &played["rate_hz"]), (&1.into(), &4000.into()));
    assert_eq!(played["buffer_frames"], 40);
    let latency_ms = played["latency_ms"].as_f64().unwrap();
    assert!(latency_ms > 10.0 && latency_ms < 30.0, "{latency_ms}");
    assert!(played["callback_load_max"].as_f64().unwrap() > 0.0);
    assert_eq!(played["errors"], 0);
    let samples = board.finish();
    assert!(samples.len() >= 2000, "{}", samples.len());
    let highest = samples.iter().map(|x| x.unsigned_abs()).max().unwrap();
    assert!((1000..=29_491).contains(&highest), "{highest}");
}

#[test]
fn what_a_receiver_warns_of_is_told_once_by_its_name() {
    let board =
        Board::with(Manners { warning: Some("the coil\u{1b}[2J is warm"), name: "b\u{7}oard", ..GOOD });
    let said = Bench::new().run(&format!("play --texture brick --seconds 0.5 --serial {}", board.port));
    assert_eq!(said.code, 0, "{}", said.stderr);
    let told: Vec<&str> = said.stderr.lines().filter(|line| line.contains("is warm")).collect();
    let expected = format!(
        r"warning: the receiver `b\u{{7}}oard` on `serial:{}` warns: the coil\u{{1b}}[2J is warm",
        board.port
    );
    assert_eq!(told, [expected]);
    assert!(said.stderr.contains(r"note: the receiver is `b\u{7}oard`"), "{}", said.stderr);
    board.finish();
}

#[test]
fn a_receiver_that_stops_answering_is_named_while_it_is_awaited_and_not_for_ever() {
    let board = Board::with(Manners { last_words_at: 1000, ..GOOD });
    let started = std::time::Instant::now();
    let said = Bench::new().run(&format!("play --texture brick --seconds 60 --serial {}", board.port));
    assert_eq!(said.code, 1, "{}", said.stderr);
    let name = format!("the receiver `test board` on `serial:{}`", board.port);
    let lines: Vec<&str> = said.stderr.lines().filter(|line| line.contains(&name)).collect();
    assert_eq!(lines.len(), 2, "{}", said.stderr);
    assert!(lines[0].starts_with("warning: ") && lines[0].contains("requests no samples"), "{}", lines[0]);
    assert!(lines[1].starts_with("error: ") && lines[1].contains("its cable"), "{}", lines[1]);
    assert!(started.elapsed() < Duration::from_secs(20), "{:?}", started.elapsed());
    board.finish();
}

#[test]
fn what_cannot_be_is_said() {
    let bench = Bench::new();
    bench.fails("play --texture cork --serial ./no-port", 1, &["serial:./no-port", "shagreen devices"]);
    bench.fails("play --texture cork --serial x --output null", 2, &["--serial"]);
    bench.fails("play --texture cork --baud 9600", 2, &["--serial"]);
    let board = Board::new();
    let slow = format!("play --texture cork --serial {} --baud 9600", board.port);
    bench.fails(&slow, 1, &["9600 baud", "--baud"]);
    let play = "play --texture cork --channel 2 --serial";
    let calibrate = "calibrate --output-channel 2 --serial-sensor";
    for command in
        [format!("{play} {}", board.port), format!("{calibrate} {0} --output serial:{0}", board.port)]
    {
        bench.fails(&command, 1, &["has one channel", &board.port]);
    }
    let (_master, slave) = TTYPort::pair().unwrap();
    let port = slave.name().unwrap();
    drop(slave);
    bench.fails(&format!("play --texture cork --serial {port}"), 1, &[&port, "no reply within", "firmware"]);
    board.finish();
}
