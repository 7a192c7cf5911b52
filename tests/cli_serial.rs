//! `shagreen play --serial`: the real program, a real pseudo terminal, and a receiver in the test.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

mod support;

use std::io::{Read as _, Write as _};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use serialport::{SerialPort as _, TTYPort};
use shagreen_device::serial::frame::MAX_WIRE;
use shagreen_device::serial::message::RunState;
use shagreen_device::serial::receiver::{About, Receiver};
use support::Bench;

const ABOUT: About = About { has_control: true, name: "test board", ..About::STREAM };

/// A receiver whose clock waits for samples, so that a busy machine changes nothing; what it played when it is stopped.
struct Board {
    port: String,
    stop: Arc<AtomicBool>,
    thread: std::thread::JoinHandle<Vec<i16>>,
}

impl Board {
    fn new() -> Self {
        let (mut master, slave) = TTYPort::pair().unwrap();
        let port = slave.name().unwrap();
        master.set_timeout(Duration::from_millis(1)).unwrap();
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = Arc::clone(&stop);
        let thread = std::thread::spawn(move || {
            let mut receiver = Receiver::<256>::new(ABOUT);
            let (mut played, mut wire) = (Vec::new(), [0; MAX_WIRE]);
            while !stopped.load(Ordering::Relaxed) {
                let mut bytes = [0; 4096];
                // Nothing came, or nobody has the port open.
                let n = master.read(&mut bytes).unwrap_or(0);
                bytes[..n].iter().for_each(|&byte| receiver.receive(byte));
                loop {
                    let status = receiver.status();
                    let prefill = receiver.settings().map_or(u16::MAX, |settings| settings.prefill);
                    let is_ready =
                        status.queued > 0 && (status.state == RunState::Playing || status.queued >= prefill);
                    if is_ready {
                        played.push(receiver.tick(0));
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
fn what_cannot_be_is_said() {
    let bench = Bench::new();
    bench.fails("play --texture cork --serial ./no-port", 1, &["serial:./no-port", "shagreen devices"]);
    bench.fails("play --texture cork --serial x --output null", 2, &["--serial"]);
    bench.fails("play --texture cork --baud 9600", 2, &["--serial"]);
    let board = Board::new();
    let slow = format!("play --texture cork --serial {} --baud 9600", board.port);
    bench.fails(&slow, 1, &["9600 baud", "--baud"]);
    let (_master, slave) = TTYPort::pair().unwrap();
    let port = slave.name().unwrap();
    drop(slave);
    bench.fails(&format!("play --texture cork --serial {port}"), 1, &[&port, "nothing answers", "firmware"]);
    board.finish();
}
