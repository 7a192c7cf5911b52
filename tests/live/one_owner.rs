//! An output has one owner: two programs together never exceed the ceiling of one. After lift-off the output is silent.
#![cfg(target_os = "linux")]

use std::process::{Child, Output, Stdio};
use std::time::Duration;

use crate::guard::have;
use crate::sound::{RATE_HZ, SoundServer, shagreen};
use shagreen_core::texture::tap::{MAX_TAP_ENERGY, Tap};
use shagreen_core::units::Hertz;
use shagreen_formats::library::write_library;
use shagreen_formats::starter::starter_library;

const SERVER: &[&str] = &["pulseaudio", "pactl", "parec"];
/// Ceiling of the limiter, as a fraction of full scale.
const CEILING: f64 = 0.9;
/// A texture far above full scale.
const LOUD: [&str; 9] = ["play", "--at", "10,10", "--speed", "200", "--force", "2", "--full-scale", "0.01"];

/// Starts a loud texture on an output.
fn loud(server: &SoundServer, more: &[&str]) -> Child {
    let mut command = server.command(env!("CARGO_BIN_EXE_shagreen"));
    command.args(LOUD).args(more).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn peak(frames: &[[f64; 2]]) -> f64 {
    frames.iter().flatten().fold(0.0, |peak, x| x.abs().max(peak))
}

#[test]
fn a_second_program_on_an_output_is_refused_or_takes_over() {
    if !have(SERVER) {
        return;
    }
    let server = SoundServer::new();
    let recorded = server.record(|server| {
        let first = loud(server, &["--seconds", "30", "--output", "pulse:ci"]);
        std::thread::sleep(Duration::from_secs(2));
        // The route through ALSA leads to the same sink.
        for output in ["pulse:ci", "alsa:default"] {
            let refused = loud(server, &["--seconds", "1", "--output", output]).wait_with_output().unwrap();
            assert_eq!(refused.status.code(), Some(1));
            let process = format!("another Shagreen (process {}) plays on the output", first.id());
            let text = said(&refused);
            assert!(text.contains(&process) && text.contains("take the output over"), "{text}");
        }
        let second = loud(server, &["--seconds", "2", "--output", "pulse:ci", "--take-over"]);
        let first = first.wait_with_output().unwrap();
        assert_eq!(first.status.code(), Some(1));
        assert!(said(&first).contains("taken over by another Shagreen"), "{}", said(&first));
        let second = second.wait_with_output().unwrap();
        assert_eq!(second.status.code(), Some(0), "{}", said(&second));
    });
    let peak = peak(&recorded);
    println!("peak of two programs: {peak:.3} of full scale");
    assert!(peak > 0.8 && peak <= CEILING + 1e-3, "{peak}");
}

/// The strongest and longest tap transient that a library may contain.
#[test]
fn the_output_is_silent_soon_after_lift_off() {
    if !have(SERVER) {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let (library, stroke) = (folder.path().join("tap.json"), folder.path().join("tap.csv"));
    let mut textures = starter_library().unwrap();
    let amplitude_mps2 = 0.999 * (4.0 * 5.0 * MAX_TAP_ENERGY).sqrt();
    let tap = Tap { frequency: Hertz(150.0), decay_per_sec: 5.0, amplitude_mps2 };
    textures.textures.truncate(4);
    let glass = textures.textures[0].clone();
    textures.textures[0].model = glass.model.with_tap(Some(tap.checked().unwrap()));
    std::fs::write(&library, write_library(&textures)).unwrap();
    let id = textures.textures[0].id.clone();
    // The tip touches for 0.4 s without moving, so that only the tap sounds.
    let touch_secs = 0.4;
    let table = format!(
        "t,speed,force\n0,0,0\n0.49,0,0\n0.5,0,1\n{0},0,1\n{1},0,0\n3,0,0\n",
        0.5 + touch_secs,
        0.51 + touch_secs
    );
    std::fs::write(&stroke, table).unwrap();
    let server = SoundServer::new();
    let recorded = server.record(|server| {
        let files =
            ["--library", library.to_str().unwrap(), "--texture", &id, "--stroke", stroke.to_str().unwrap()];
        shagreen(server, &[&["play"], &files[..], &["--output", "pulse:ci", "--full-scale", "20"]].concat());
    });
    let first = recorded.iter().position(|f| f[0].abs() > 1e-4).expect("the tap sounds");
    let last = recorded.iter().rposition(|f| f[0] != 0.0).unwrap();
    let after_secs = (last - first) as f64 / RATE_HZ - touch_secs;
    println!("silent {after_secs:.3} s after lift-off, peak {:.3}", peak(&recorded));
    assert!(after_secs < 0.3, "{after_secs} s");
    assert!(peak(&recorded) <= CEILING + 1e-3);
}
