//! Tests that the receivers in C and in Rust agree: the same bytes and ticks give the same samples and frames.
#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests may panic and print what they skip")]

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use shagreen_device::serial::frame::MAX_WIRE;
use shagreen_device::serial::message::{
    Configure, Control, HostMessage, Mode, write_samples, write_to_device,
};
use shagreen_device::serial::receiver::{About, Receiver};

const CONFIGURE: Configure = Configure {
    config: 1,
    mode: Mode::Stream,
    rate_hz: 4000,
    ceiling: 20_000,
    watchdog_ms: 50,
    window: 40,
    prefill: 24,
    report: 8,
    fade: 12,
    full_scale_cmps2: 2000,
};
const ABOUT: About = About { has_control: true, has_friction: true, name: "C receiver", ..About::STREAM };

/// Received bytes, followed by ticks of the sample clock.
struct Step {
    bytes: Vec<u8>,
    n_ticks: u8,
}

/// Compiles the C receiver, with every warning as an error. Returns `None` and prints a message if there is no
/// compiler.
fn compile(folder: &Path) -> Option<PathBuf> {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/serial-receiver-c");
    let program = folder.join("receiver");
    let flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-O2", "-o"];
    let done = Command::new("cc")
        .args(flags)
        .arg(&program)
        .args([sources.join("shagreen_serial.c"), sources.join("main.c")])
        .output();
    match done {
        Ok(output) => {
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            Some(program)
        }
        Err(error) => {
            println!("skipped: no C compiler is available ({error})");
            None
        }
    }
}

/// Output of the C receiver for these steps.
fn played_by_c(program: &Path, steps: &[Step]) -> Vec<u8> {
    let mut child = Command::new(program).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let mut script = Vec::new();
    for step in steps {
        script.push(step.bytes.len() as u8);
        script.extend(&step.bytes);
        script.push(step.n_ticks);
    }
    let mut stdin = child.stdin.take().unwrap();
    let writer = std::thread::spawn(move || stdin.write_all(&script).unwrap());
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    assert!(output.status.success());
    output.stdout
}

/// Output of the Rust receiver for these steps, with the number of nonzero samples.
fn played_by_rust(steps: &[Step]) -> (Vec<u8>, usize) {
    let mut receiver = Receiver::<256>::new(ABOUT);
    let (mut said, mut n_heard) = (Vec::new(), 0);
    let mut wire = [0; MAX_WIRE];
    // The C receiver uses the control of the last run until there is a new one.
    let mut speed = 0;
    for step in steps {
        for &byte in &step.bytes {
            receiver.receive(byte);
            speed = receiver.control().map_or(speed, |control| control.speed_dmmps);
        }
        for _ in 0..step.n_ticks {
            let sample = receiver.tick((speed & 0x7FFF).cast_signed());
            n_heard += usize::from(sample != 0);
            said.extend(sample.to_le_bytes());
        }
        loop {
            let len = receiver.transmit(&mut wire);
            said.push(len as u8);
            if len == 0 {
                break;
            }
            said.extend(&wire[..len]);
        }
    }
    (said, n_heard)
}

/// Pseudorandom numbers from a seed.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, n: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) % n
    }

    fn is(&mut self, percent: u64) -> bool {
        self.below(100) < percent
    }
}

/// A stream, or controls, over a line that loses, repeats, reorders and corrupts `percent` of the frames each.
fn steps(seed: u64, mode: Mode, percent: u64) -> Vec<Step> {
    let mut numbers = Numbers(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let mut wire = [0; MAX_WIRE];
    // A copy of the receiver provides the run number that a host would know.
    let mut mirror = Receiver::<256>::new(ABOUT);
    let mut seq = numbers.below(65_536) as u16;
    let mut held: Option<Vec<u8>> = None;
    let mut steps = Vec::new();
    for i in 0..1500 {
        let run = mirror.status().run;
        let len = match numbers.below(200) {
            _ if i == 1 => {
                write_to_device(HostMessage::Configure(Configure { mode, ..CONFIGURE }), &mut wire)
            }
            0 => write_to_device(HostMessage::Hello { nonce: seq, version: 1 }, &mut wire),
            1 => write_to_device(HostMessage::Stop, &mut wire),
            2..4 => write_to_device(HostMessage::Ping { id: seq }, &mut wire),
            4..8 => write_to_device(
                HostMessage::Configure(Configure {
                    config: numbers.below(4) as u8,
                    mode,
                    rate_hz: [4000, 4000, 999, 8000][numbers.below(4) as usize],
                    window: numbers.below(300) as u16,
                    prefill: numbers.below(50) as u16,
                    ..CONFIGURE
                }),
                &mut wire,
            ),
            _ if mirror.settings().is_none() => {
                write_to_device(HostMessage::Configure(Configure { mode, ..CONFIGURE }), &mut wire)
            }
            _ if mode == Mode::Control => {
                seq = seq.wrapping_add(1);
                let control = Control { speed_dmmps: numbers.below(65_536) as u16, ..Control::default() };
                write_to_device(HostMessage::Control { seq, run, control }, &mut wire)
            }
            _ => {
                let samples: Vec<i16> =
                    (0..16).map(|_| (numbers.below(65_536) as i32 - 32_768) as i16).collect();
                let len = write_samples(seq, run, &samples, &mut wire);
                seq = seq.wrapping_add(16);
                len
            }
        };
        let mut bytes = wire[..len].to_vec();
        if numbers.is(percent) {
            let at = numbers.below(len as u64) as usize;
            bytes[at] ^= 1 + numbers.below(255) as u8;
        }
        if numbers.is(percent) {
            bytes.clear();
        }
        if numbers.is(percent) {
            bytes.extend(bytes.clone());
        }
        if numbers.is(percent) {
            if let Some(earlier) = held.replace(bytes.clone()) {
                bytes = earlier;
            } else {
                bytes.clear();
            }
        } else if let Some(earlier) = held.take() {
            bytes.extend(earlier);
        }
        if numbers.is(percent) {
            bytes.extend((0..numbers.below(300)).map(|_| numbers.below(256) as u8));
        }
        let n_ticks = if numbers.is(2) { numbers.below(256) } else { 14 + numbers.below(5) };
        // A step holds at most 255 bytes; further bytes follow without ticks in between.
        let mut parts: Vec<Step> =
            bytes.chunks(255).map(|part| Step { bytes: part.to_vec(), n_ticks: 0 }).collect();
        match parts.last_mut() {
            Some(last) => last.n_ticks = n_ticks as u8,
            None => parts.push(Step { bytes, n_ticks: n_ticks as u8 }),
        }
        for part in &parts {
            part.bytes.iter().for_each(|&byte| mirror.receive(byte));
            for _ in 0..part.n_ticks {
                mirror.tick(0);
            }
        }
        steps.extend(parts);
    }
    steps
}

#[test]
fn both_say_and_play_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let Some(program) = compile(folder.path()) else { return };
    let mut n_heard_of_all = 0;
    for seed in 1..=30 {
        for mode in [Mode::Stream, Mode::Control, Mode::Friction] {
            for percent in [0, 3, 20] {
                let steps = steps(seed, mode, percent);
                let (expected, n_heard) = played_by_rust(&steps);
                let found = played_by_c(&program, &steps);
                let differs = found.iter().zip(&expected).position(|(a, b)| a != b);
                assert!(
                    found == expected,
                    "{mode:?}, {percent} %, seed {seed}: outputs differ at byte {differs:?}"
                );
                n_heard_of_all += n_heard;
            }
        }
    }
    println!("{n_heard_of_all} nonzero samples, all equal");
    assert!(n_heard_of_all > 500_000, "{n_heard_of_all}");
}

/// Negative control: the comparison detects a single additional sample.
#[test]
fn the_comparison_can_fail() {
    let folder = tempfile::tempdir().unwrap();
    let Some(program) = compile(folder.path()) else { return };
    let mut steps = steps(1, Mode::Stream, 0);
    let (expected, _) = played_by_rust(&steps);
    steps[700].n_ticks += 1;
    assert!(played_by_c(&program, &steps) != expected);
}
