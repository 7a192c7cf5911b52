//! `shagreen latency` on a sound server: missed onsets are counted, and too few onsets are an error.
#![cfg(target_os = "linux")]

use crate::guard::have;
use crate::sound::{SoundServer, shagreen};

const SERVER: &[&str] = &["pulseaudio", "pactl"];
const WORDS: [&str; 5] = ["latency", "--input", "alsa:pulse", "--strokes", "3"];

/// The input records the monitor of the output's sink.
#[test]
fn onsets_that_were_missed_are_counted() {
    if !have(SERVER) {
        return;
    }
    let server = SoundServer::new();
    let told = shagreen(&server, &[&WORDS[..], &["--output", "pulse:ci"]].concat());
    println!("{told}");
    for kind in ["taps", "strokes"] {
        let (n, missed) = (told[kind]["n"].as_u64().unwrap(), told[kind]["missed"].as_u64().unwrap());
        assert!(n >= 2 && n + missed == 3, "{kind}: {told}");
    }
    let output = server
        .command(env!("CARGO_BIN_EXE_shagreen"))
        .args(WORDS)
        .args(["--output", "pulse:ci"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(said.matches(" missed)").count(), 2, "{said}");
}

#[test]
fn the_monitor_of_an_output_is_listed_and_recorded() {
    if !have(SERVER) {
        return;
    }
    let server = SoundServer::new();
    let listed = shagreen(&server, &["devices"]);
    let inputs = listed["inputs"].as_array().unwrap();
    let monitor = inputs.iter().find(|input| input["monitor_of"] == "pulse:ci").unwrap();
    assert_eq!(monitor["id"], "pulse:ci.monitor");
    assert!(monitor["name"].as_str().unwrap().ends_with(" (monitor of pulse:ci)"), "{monitor}");
    let words = ["latency", "--input", "pulse:ci.monitor", "--output", "pulse:ci", "--strokes", "3"];
    let told = shagreen(&server, &words);
    for kind in ["taps", "strokes"] {
        let (n, missed) = (told[kind]["n"].as_u64().unwrap(), told[kind]["missed"].as_u64().unwrap());
        assert!(n >= 2 && n + missed == 3, "{kind}: {told}");
        let median_ms = told[kind]["median_ms"].as_f64().unwrap();
        assert!((0.0..200.0).contains(&median_ms), "{kind}: {told}");
    }
}

#[test]
fn an_input_that_does_not_hear_the_output_is_an_error() {
    if !have(SERVER) {
        return;
    }
    let server = SoundServer::new();
    let output = server
        .command(env!("CARGO_BIN_EXE_shagreen"))
        .args(WORDS)
        .args(["--output", "pulse:other"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.code() == Some(1) && said.contains("records nothing of the output"), "{said}");
    assert!(output.stdout.is_empty());
}
