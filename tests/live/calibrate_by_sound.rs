//! `calibrate` on a sound server: a simulated voice coil connects two sinks. One drives it, the other receives its
//! acceleration.
#![cfg(target_os = "linux")]

use std::io::{Read, Write};
use std::process::Stdio;

use crate::guard::{Guard, have};
use crate::sound::{RATE_HZ, SoundServer, shagreen};

const SERVER: &[&str] = &["pulseaudio", "pactl", "parec", "pacat"];
/// Resonance in Hz, Q, and gain in (m/s²)/V; full scale is 1 V.
const COIL: (f64, f64, f64) = (65.0, 4.09, 2.13);
/// Acceleration of a sample of 1.0 from the simulated accelerometer, in m/s².
const SENSITIVITY: f64 = 10.0;
const STREAM: [&str; 4] = ["--format=float32le", "--rate=48000", "--channels=2", "--raw"];

/// Simulates a coil with the equation of motion `x'' = K V - (ω/Q) x' - ω² x`, in steps of a quarter of a sample, from
/// one stream to the other until one of them ends.
fn coil(mut input: impl Read, mut output: impl Write) {
    let (hz, q, gain) = COIL;
    let w = std::f64::consts::TAU * hz;
    let h = 1.0 / (4.0 * RATE_HZ);
    let (mut x, mut v) = (0.0, 0.0);
    let mut block = [0_u8; 8 * 240];
    while input.read_exact(&mut block).is_ok() {
        for frame in block.chunks_exact_mut(8) {
            let volts = f64::from(f32::from_le_bytes([frame[0], frame[1], frame[2], frame[3]]));
            let mut a = 0.0;
            for _ in 0..4 {
                a = gain * volts - w / q * v - w * w * x;
                v += h * a;
                x += h * v;
            }
            let sample = ((a / SENSITIVITY) as f32).to_le_bytes();
            frame[..4].copy_from_slice(&sample);
            frame[4..].copy_from_slice(&sample);
        }
        if output.write_all(&block).is_err() {
            break;
        }
    }
}

/// Runs the coil between the two sinks until the guards are dropped.
fn hang_coil(server: &SoundServer) -> [Guard; 2] {
    let set = server.command("pactl").args(["set-default-source", "other.monitor"]).status().unwrap();
    assert!(set.success());
    let mut driven = server
        .command("parec")
        .args(["-d", "ci.monitor", "--latency-msec=20"])
        .args(STREAM)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut felt = server
        .command("pacat")
        .args(["-d", "other", "--latency-msec=50"])
        .args(STREAM)
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    let (input, output) = (driven.stdout.take().unwrap(), felt.stdin.take().unwrap());
    std::thread::spawn(move || coil(input, output));
    [Guard(driven), Guard(felt)]
}

fn words(out: &str) -> Vec<String> {
    ["calibrate", "--output", "pulse:ci", "--input", "alsa:pulse", "--sensitivity", "10", "--seconds", "8"]
        .into_iter()
        .chain(["--load-g", "100", "--full-scale-volts", "1", "--out", out])
        .map(ToOwned::to_owned)
        .collect()
}

#[test]
fn a_coil_between_two_sinks_is_measured() {
    if !have(SERVER) {
        return;
    }
    let server = SoundServer::new();
    let folder = tempfile::tempdir().unwrap();
    let profile = folder.path().join("coil.toml");
    let profile = profile.to_str().unwrap();
    let words = words(profile);
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let _coil = hang_coil(&server);
    // A shared machine sometimes stalls and cuts a piece out of the sweep; the measurement is then repeated.
    let is_right = |told: &serde_json::Value| {
        let near = |field: &str, expected: f64, share: f64| {
            told[field].as_f64().is_some_and(|got| (got / expected - 1.0).abs() < share)
        };
        let is_fitted = told["fit_error_db"].as_f64().is_some_and(|db| db < 0.5);
        near("f0_hz", COIL.0, 0.01) && near("q", COIL.1, 0.03) && near("gain", COIL.2, 0.03) && is_fitted
    };
    let measured = (0..4).map(|_| {
        let told = shagreen(&server, &words);
        println!("{} {} {} {}", told["f0_hz"], told["q"], told["gain"], told["fit_error_db"]);
        told
    });
    assert!(measured.into_iter().any(|told| is_right(&told)));
    // The profile can drive an output immediately.
    let played = shagreen(
        &server,
        &["play", "--at", "40,60", "--seconds", "1", "--actuator", profile, "--full-scale-volts", "1"],
    );
    assert_eq!(played["output"], "null");
}

#[test]
fn a_wire_is_no_actuator() {
    if !have(SERVER) {
        return;
    }
    // The monitor of the driven sink itself: no resonance, and no profile.
    let server = SoundServer::new();
    let folder = tempfile::tempdir().unwrap();
    let profile = folder.path().join("wire.toml");
    let words = words(profile.to_str().unwrap());
    let output = server.command(env!("CARGO_BIN_EXE_shagreen")).args(words).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("resonance") && !profile.exists(), "{said}");
}
