//! A computer in place of a microcontroller: plays the samples of a serial port at the rate of the computer's clock.
//!
//! `cargo run --example serial_receiver -- --pty --wav out.wav` creates a pseudo terminal and prints its name. Then
//! `shagreen play --at 30,70 --serial NAME` plays to it. Give the name of a serial port instead of `--pty` to play what
//! arrives there. Options: `--seconds N` sets the duration (default: until the sender disconnects), `--wav FILE` saves
//! the played samples (default: print levels).
#![allow(clippy::print_stdout, reason = "an example prints its results")]

use std::time::{Duration, Instant};

use serialport::SerialPort;
use shagreen_device::serial::USUAL_BAUD;
use shagreen_device::serial::frame::MAX_WIRE;
use shagreen_device::serial::receiver::{About, Receiver};

const ABOUT: About = About { name: "Example receiver", ..About::STREAM };
/// A clock that lags more than this was suspended.
const SUSPENDED: Duration = Duration::from_millis(100);

type Error = Box<dyn std::error::Error>;

fn main() -> Result<(), Error> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value_of =
        |name: &str| arguments.iter().position(|a| a == name).and_then(|i| arguments.get(i + 1)).cloned();
    let seconds = value_of("--seconds").map(|secs| secs.parse::<f64>()).transpose()?;
    let mut port = open(&arguments)?;
    port.set_timeout(Duration::from_millis(1))?;
    let mut receiver = Receiver::<256>::new(ABOUT);
    let played = play(port.as_mut(), &mut receiver, seconds, value_of("--wav").is_none())?;
    let status = receiver.status();
    println!(
        "{} samples played, {} underruns, {} bad frames, {} samples dropped",
        played.samples.len(),
        status.underruns,
        status.bad_frames,
        status.dropped
    );
    if let Some(file) = value_of("--wav") {
        let spec = hound::WavSpec {
            channels: 1,
            sample_rate: u32::from(played.rate_hz),
            bits_per_sample: 16,
            sample_format: hound::SampleFormat::Int,
        };
        let mut writer = hound::WavWriter::create(&file, spec)?;
        played.samples.iter().try_for_each(|&sample| writer.write_sample(sample))?;
        writer.finalize()?;
        println!("saved as {file}");
    }
    Ok(())
}

#[cfg(unix)]
fn pseudo_terminal() -> Result<Box<dyn SerialPort>, Error> {
    let (master, slave) = serialport::TTYPort::pair()?;
    println!("{}", slave.name().ok_or("the pseudo terminal has no name; name a serial port instead")?);
    Ok(Box::new(master))
}

#[cfg(not(unix))]
fn pseudo_terminal() -> Result<Box<dyn SerialPort>, Error> {
    Err("this system has no pseudo terminals; give the name of a serial port".into())
}

fn open(arguments: &[String]) -> Result<Box<dyn SerialPort>, Error> {
    if arguments.iter().any(|a| a == "--pty") {
        return pseudo_terminal();
    }
    let port = arguments
        .first()
        .filter(|a| !a.starts_with("--"))
        .ok_or("give the name of a serial port, or --pty")?;
    Ok(serialport::new(port, USUAL_BAUD).open()?)
}

/// Played samples and their rate.
struct Played {
    rate_hz: u16,
    samples: Vec<i16>,
}

fn play(
    port: &mut dyn SerialPort,
    receiver: &mut Receiver<256>,
    seconds: Option<f64>,
    shows_levels: bool,
) -> Result<Played, Error> {
    let begun = Instant::now();
    let mut played = Played { rate_hz: 4000, samples: Vec::new() };
    // Start of the clock for this configuration, and the ticks since.
    let mut clock: Option<(Instant, u64)> = None;
    let (mut wire, mut bytes) = ([0; MAX_WIRE], [0; 1024]);
    loop {
        let n = match port.read(&mut bytes) {
            Ok(n) => n,
            Err(error) if error.kind() == std::io::ErrorKind::TimedOut => 0,
            // The other end is closed: not yet open, or closed again.
            Err(_) if seconds.is_none() && !played.samples.is_empty() => return Ok(played),
            Err(_) => {
                std::thread::sleep(Duration::from_millis(1));
                0
            }
        };
        bytes[..n].iter().for_each(|&byte| receiver.receive(byte));
        match receiver.settings() {
            None => clock = None,
            Some(settings) => {
                played.rate_hz = settings.rate_hz;
                let (since, n_ticks) = clock.get_or_insert((Instant::now(), 0));
                let due = (since.elapsed().as_secs_f64() * f64::from(settings.rate_hz)) as u64;
                if due - *n_ticks > (SUSPENDED.as_secs_f64() * f64::from(settings.rate_hz)) as u64 {
                    *n_ticks = due;
                    receiver.skip();
                }
                for tick in *n_ticks..due {
                    played.samples.push(receiver.tick(0));
                    if shows_levels && tick % u64::from(settings.rate_hz / 4).max(1) == 0 {
                        show_level(&played);
                    }
                }
                *n_ticks = due;
            }
        }
        loop {
            let len = receiver.transmit(&mut wire);
            // Unsent frames are dropped; the next status frame reports the current state.
            if len == 0 || port.write_all(&wire[..len]).is_err() {
                break;
            }
        }
        if seconds.is_some_and(|seconds| begun.elapsed().as_secs_f64() > seconds) {
            return Ok(played);
        }
    }
}

/// Prints the RMS level of the last quarter of a second.
fn show_level(played: &Played) {
    let n = usize::from(played.rate_hz / 4).max(1);
    let last = &played.samples[played.samples.len().saturating_sub(n)..];
    let mean_square = last.iter().map(|&x| f64::from(x) * f64::from(x)).sum::<f64>() / last.len() as f64;
    let level = mean_square.sqrt() / 32_768.0;
    println!("{:6.2} % {}", 100.0 * level, "#".repeat((200.0 * level) as usize));
}
